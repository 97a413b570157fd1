#!/usr/bin/python3
"""Draws the report's figures from what in.channel wrote, and puts our numbers beside the report's.

    plot.py [DIR] [--keep]    DIR holds channel-phi*.aggregates, .profiles, .overlaps, .*.png (default .)

Writes figure09.png, figure10.png, figure11.png (close-ups), figure12.png, figure13.png, overlaps.png and compare.txt to DIR.
Any number of phi will do. The report's numbers and their reading errors are in report.csv.
"""
import re
import sys
import textwrap
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import LinearSegmentedColormap, Normalize

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from report import Ours, Run, arguments, conclude, draw_pictures, read_report, read_runs, stop, those_with

COLOURS = ["#0072B2", "#E69F00", "#009E73", "#D55E00", "#CC79A7", "#56B4E9", "#000000"]
DASHES = ["-", "--", "-.", (0, (1, 1.2))]
PARTICLES = 8000    # as in in.channel, which loses none


# ---------------------------------------------------------------------- reading


def read_input():
    """Numbers of in.channel, in SI: dict of its literal variables, and the words after `amap`."""
    text = (HERE / "in.channel").read_text()
    found = re.findall(r"^variable +(\w+) +(?:equal|index) +(\d[\d.]*(?:e[+-]?\d+)?)\s", text, re.M)
    return {name: float(value) for name, value in found}, re.search(r"amap ([^\"\n]*)", text)[1].split()


class Channel(Run):
    """One run. Times in L/U, y in L, v in U, c as area fraction, overlaps in r. A run shorter than 1 L/U has no profile yet."""

    def __init__(self, path, si):
        super().__init__(path, "channel-phi")
        self.phi = f"{float(self.name):g}"
        times, blocks = self.blocks(".profiles")
        profiles = [profile(rows, si) for rows in blocks]
        if profiles:
            self.y, self.c, self.v = profiles[-1]
        series = [(c[abs(y) < 0.1].mean() / c.mean(), (c[0] + c[-1]) / 2 / c.mean(),
                   still_layer(v, y[1] - y[0])) for y, c, v in profiles]
        self.profiles = {"t": times, **dict(zip(("centre", "at_wall", "still_layer"), np.reshape(series, (-1, 3)).T))}
        for name in ("in_aggregates", "wall_in_aggregates"):
            self.history[name] = self.history[name] / PARTICLES
        self.overlaps = read_overlaps(self, si)
        self.picture = read_picture(self)


def profile(rows, si):
    """y [L], area fraction c and streamwise velocity v [U] of one block; v is nan in empty bins."""
    y = rows[:, 1] / si["L"]
    c = rows[:, 3] * np.pi / 4 * si["d"]**2
    v = np.where(rows[:, 2] > 0, rows[:, 4] / si["U"], np.nan)
    return y, c, v


def still_layer(v, width):
    """Thickness of the layer with v < 0.05 U, mean of both walls, in the unit of the bin width."""
    moving = np.flatnonzero(~(v < 0.05))
    return width * (len(v) if len(moving) == 0 else (moving[0] + len(v) - 1 - moving[-1]) / 2)


def read_overlaps(run, si):
    """Time [L/U], bin edges [r] and share of contacts per bin of the last histogram."""
    times, blocks = run.blocks(".overlaps")
    centres = blocks[-1][:, 1] / (si["d"] / 2)
    edges = np.append(centres, 2 * centres[-1] - centres[-2]) - (centres[1] - centres[0]) / 2
    return times[-1], edges, blocks[-1][:, 3]


def read_picture(run):
    """Time [L/U] and pixels of the last picture."""
    times, paths = run.pictures()
    if not paths:
        stop(run.path.with_suffix(".*.png"), "missing; in.channel writes them")
    try:
        return times[-1], plt.imread(paths[-1])
    except (OSError, SyntaxError, ValueError) as error:
        stop(paths[-1], f"not a whole picture: {error}")


# ---------------------------------------------------------------------- comparing


def average(run, quantity, end):
    """Mean and standard deviation over the last fifth of 0 < t < end; of P/Q too."""
    if "/" in quantity:
        return divide(*(average(run, part, end) for part in quantity.split("/")))
    t, values = ((run.t, run.history[quantity]) if quantity in run.history
                 else (run.profiles["t"], run.profiles[quantity]))
    known = t <= end + 1e-6
    recent = known & (t >= 0.8 * end - 1e-6)
    values = values[recent] if any(recent) else values[known][-1:]
    if len(values) == 0:
        return np.nan, np.nan
    return values.mean(), values.std(ddof=1) if len(values) > 1 else np.nan


def divide(a, b):
    """Ratio of two (mean, standard deviation), taken as independent; nan if b is 0."""
    if b[0] == 0 or a[0] == 0:
        return (np.nan if b[0] == 0 else 0.0), np.nan
    return a[0] / b[0], abs(a[0] / b[0]) * np.hypot(a[1] / a[0], b[1] / b[0])


def values_of(report, runs):
    """Our number for each row of report.csv whose phi, or pair of them, have been run."""
    by_phi, values = {run.phi: run for run in runs}, {}
    for row in report:
        if all(phi in by_phi for phi in row["case"].split("/")):
            parts = [by_phi[phi] for phi in row["case"].split("/")]
            reached = min(run.t[-1] for run in parts)
            means = [average(run, row["quantity"], reached) for run in parts]
            values[row["case"], row["quantity"]] = Ours(*(means[0] if len(means) == 1 else divide(*means)),
                                                        reached)
    return values


# ---------------------------------------------------------------------- drawing


def style(phi):
    """Colour and dash of a phi; those of the report's four never change."""
    cases = ["1.5", "15", "50", "150"]
    k = cases.index(phi) if phi in cases else 4 + round(float(phi)) % 3
    return {"color": COLOURS[k], "linestyle": DASHES[k % 4]}


def save(figure, path, dpi=200):
    """Writes a figure."""
    figure.savefig(path, dpi=dpi, bbox_inches="tight", facecolor="white")
    plt.close(figure)


def picture_extent(image):
    """Extent of the picture in L, from its walls: grey bars over 0 < x < 5 L at y = +-L/2."""
    inked = image[..., :3].min(axis=2) < 0.9
    rows = np.flatnonzero(inked.mean(axis=1) > 0.9)
    if len(rows) == 0:
        return None
    columns = np.flatnonzero(inked[rows[len(rows) // 4]])
    low, high = (part.mean() for part in np.split(rows, [np.argmax(np.diff(rows)) + 1]))
    scale, middle = 5 / (columns[-1] - columns[0] + 1), (low + high) / 2
    return (-columns[0] * scale, (image.shape[1] - columns[0]) * scale,
            (middle - image.shape[0]) * scale, middle * scale)


def size_colours(words):
    """Colour map and norm of the pictures, from the words after `amap` in in.channel."""
    low, high = float(words[0]), float(words[1])
    ends = {"min": low, "max": high}
    stops = [((ends[at] if at in ends else float(at)) - low) / (high - low) for at in words[5::2]]
    colours = LinearSegmentedColormap.from_list("size", list(zip(stops, words[6::2])))
    return plt.cm.ScalarMappable(Normalize(low, high), colours)


def draw_ends(runs, amap, path):
    """Figure 9: particles at the last time of each phi, coloured by aggregate size."""
    figure, axes = plt.subplots(len(runs), 1, figsize=(10, 2.25 * len(runs) + 0.9), squeeze=False,
                                layout="constrained", sharex=True)
    for axis, run in zip(axes[:, 0], runs):
        t, image = run.picture
        extent = picture_extent(image)
        axis.imshow(image, extent=extent, aspect="equal", interpolation="antialiased")
        axis.set_title(rf"$\phi$ = {run.phi},  t = {t:g} L/U", loc="left")
        axis.set_yticks([-0.5, 0, 0.5] if extent else [])
        axis.set_ylabel("y / L")
        axis.spines[:].set_visible(False)
    axes[-1, 0].set_xlabel("x / L   (air flows to the right)")
    bar = figure.colorbar(size_colours(amap), ax=axes, location="bottom", shrink=0.5, aspect=40,
                          pad=0.02, extend="max", ticks=[1, 4, 8, 12, 16, 20])
    bar.set_label("particles in the aggregate")
    save(figure, path, 90)


def draw_close_ups(runs, path):
    """Figure 11: the lower wall in a series of times, a column for each run, of the report's two phi."""
    series = [[(rf"$\phi$ = {run.phi}, t = {t:.2f} L/U", picture) for t, picture in zip(*run.pictures(".close"))]
              for run in runs]
    draw_pictures([picture for row in zip(*series) for picture in row], len(runs), path, (4, 1.1))


def draw_profile(axes, run, words):
    """One row of figure 10: c on the left, v on the right."""
    look = {"color": style(run.phi)["color"], "linewidth": 1.3}
    y = np.linspace(-0.5, 0.5, 201)
    axes[0].plot(run.y, run.c, **look)
    axes[0].axhline(run.c.mean(), color="0.5", linewidth=0.9, linestyle=":", label="mean")
    axes[1].plot(y, 1 - 4 * y**2, "--", color="0.45", linewidth=1, label="air, 1 - 4 (y/L)$^2$")
    axes[1].plot(run.y, run.v, **look, label="particles")
    axes[0].set_title(rf"$\phi$ = {run.phi},  t = {run.profiles['t'][-1]:g} L/U", loc="left")
    axes[0].text(0.5, 0.95, textwrap.fill(words, 48), transform=axes[0].transAxes, ha="center",
                 va="top", fontsize=9, style="italic")


def draw_profiles(runs, report, path):
    """Figure 10: area fraction and mean streamwise velocity across the channel."""
    runs = those_with(runs, lambda run: len(run.profiles["t"]), "profile", path.name)
    if not runs:
        return
    figure, axes = plt.subplots(len(runs), 2, figsize=(9, 2.15 * len(runs) + 0.5), sharex=True,
                                sharey="col", squeeze=False, layout="constrained")
    for row, run in zip(axes, runs):
        said = [r for r in report if r["figure"] == "10" and r["case"].split("/")[0] == run.phi]
        stills = [r for r in said if r["quantity"] == "still_layer"]
        words = "; ".join(r["words"] for r in said if r not in stills)
        draw_profile(row, run, f"report, t {said[0]['for_t']}: {words}" if words else "")
        for r in stills:
            label = f"report, t {r['for_t']}:\n{r['words'].replace('of', 'L of')}"
            row[1].axvspan(-0.5, r["value"] - 0.5, color="0.87", zorder=0, label=label)
            row[1].axvspan(0.5 - r["value"], 0.5, color="0.87", zorder=0)
        row[0].set_ylabel("c (area fraction)")
        row[1].set_ylabel("v / U")
        row[1].legend(fontsize=8, loc="lower center", frameon=False)
    top = max(run.c.max() for run in runs)
    axes[0, 0].set(xlim=(-0.5, 0.5), ylim=(0, max(0.5, 1.05 * top)))
    axes[0, 1].set_ylim(-0.05, 1.15)
    for axis in axes[-1]:
        axis.set_xlabel("y / L")
    save(figure, path)


def draw_values(axis, rows, scale):
    """The report's values: dashed lines labelled at the right, in the colour of their phi."""
    rows = sorted((row for row in rows if not np.isnan(row["value"])), key=lambda row: row["value"])
    for row in rows:
        value, look = row["value"] * scale, style(row["case"])["color"]
        axis.axhline(value, color=look, linewidth=0.9, linestyle=(0, (6, 3)))
        axis.text(1.02, value, f"{100 * row['value']:g} %", color=look, fontsize=9,
                  va="bottom" if row is rows[-1] else "top", transform=axis.get_yaxis_transform())
    return f"report, t {rows[0]['for_t']}" if rows else ""


def draw_ranges(axis, rows):
    """The report's ranges: bars at the right, in the colour of their phi."""
    rows = [row for row in rows if np.isnan(row["value"])]
    for k, row in enumerate(rows):
        axis.plot([1.03 + 0.035 * k] * 2, [row["low"], row["high"]], clip_on=False, linewidth=4,
                  solid_capstyle="butt", color=style(row["case"])["color"],
                  transform=axis.get_yaxis_transform())
    return f"report's range, t {rows[0]['for_t']}" if rows else ""


def draw_aggregates(runs, report, figure_number, names, tops, path):
    """Figures 12, 13: particles in aggregates, number of aggregates, mean size, over time.

    `names` are the three quantities, `tops` the ends of the report's axes.
    """
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.9), layout="constrained")
    for axis, name, top, scale in zip(axes, names, tops, (PARTICLES, 1, 1)):
        for run in runs:
            axis.plot(run.t, scale * run.history[name], linewidth=1.5, **style(run.phi),
                      label=rf"$\phi$ = {run.phi}")
            top = max(top, 1.05 * scale * run.history[name].max())
        rows = [row for row in report if row["figure"] == figure_number and row["quantity"] == name
                and row["case"] in [run.phi for run in runs]]
        words = draw_values(axis, rows, scale) or draw_ranges(axis, rows)
        axis.text(1.14, 0.5, words, rotation=90, transform=axis.transAxes, va="center", fontsize=9)
        axis.set(xlabel="t  [L/U]", title=f"({'abc'[names.index(name)]})", ylim=(0, top),
                 xlim=(0, max(run.t[-1] for run in runs)))
    wall = "wall " if figure_number == "13" else ""
    axes[0].set_ylabel(rf"$n_P$, particles in {wall}aggregates, of {PARTICLES}")
    axes[1].set_ylabel(rf"$N_A$, number of {wall}aggregates")
    axes[2].set_ylabel(rf"$n_{{P/A}}$, particles per {wall}aggregate")
    axes[1].legend(loc="lower center", bbox_to_anchor=(0.5, 1.05), ncols=len(runs), frameon=False,
                   handlelength=2.6)
    save(figure, path)


def draw_overlaps(runs, stiffness, path):
    """Overlaps of pairs that touch, in particle radii, and the JKR overlap of a pair at rest."""
    runs = those_with(runs, lambda run: any(run.overlaps[2]), "contact in a histogram", path.name)
    if not runs:
        return
    figure, axis = plt.subplots(figsize=(7, 4), layout="constrained")
    end = 0
    for run in runs:
        t, edges, share = run.overlaps
        look, rest = style(run.phi), 2 / 3 * (9 * np.pi * float(run.phi) / (4 * stiffness))**(2 / 3)
        axis.stairs(share, edges, fill=True, alpha=0.6, color=look["color"],
                    label=rf"$\phi$ = {run.phi}, t = {t:g} L/U")
        axis.axvline(rest, color=look["color"], linewidth=0.9, linestyle=":")
        end = max(end, rest, edges[np.flatnonzero(share)[-1] + 1])
    axis.plot([], [], ":", color="0.3", linewidth=0.9,
              label=rf"JKR pair at rest, $\lambda$ = $10^{{{np.log10(stiffness):g}}}$")
    axis.set(yscale="log", ylim=(1e-5, 2), xlim=(0, 1.2 * end), ylabel="share of contacts per bin",
             xlabel="overlap / particle radius (two particles that touch)")
    axis.legend(loc="lower center", bbox_to_anchor=(0.5, 1), fontsize=9, frameon=False, ncols=3)
    save(figure, path)


def main():
    """Reads the folder, draws, prints and writes the table."""
    folder, out, kept = arguments("Draws the report's figures of the channel, and compares.", HERE)
    si, amap = read_input()
    report = read_report(HERE / "report.csv")
    runs = sorted(read_runs(folder, "channel-phi*.aggregates", lambda path: Channel(path, si), kept and HERE),
                  key=lambda run: float(run.phi))
    plt.rcParams.update({"font.size": 10, "axes.titlesize": 10, "axes.grid": False})
    draw_ends(runs, amap, out / "figure09.png")
    draw_profiles(runs, report, out / "figure10.png")
    close = [run for run in runs if run.phi in ("1.5", "150") and run.pictures(".close")[1]]
    if close:
        draw_close_ups(close, out / "figure11.png")
    names = ["in_aggregates", "aggregates", "mean_size"]
    draw_aggregates(runs, report, "12", names, (8800, 2000, 25), out / "figure12.png")
    draw_aggregates(runs, report, "13", ["wall_" + name for name in names], (2200, 200, 25),
                    out / "figure13.png")
    draw_overlaps(runs, si["lambda"], out / "overlaps.png")
    conclude(HERE, values_of(report, runs), [run.cost(f"{PARTICLES} particles") for run in runs], out, kept)


if __name__ == "__main__":
    main()
