#!/usr/bin/python3
"""Draws the report's figures from what in.nozzle wrote, and compares:   plot.py [DIR] [--keep]

Writes figure13.png (water), figure14.png (distance to the walls), figure15.png and figure19.png (particles, by
length and by phi), figure16.png (sizes over time), figure17.png (along the axis, by length), figure20.png (by phi),
figure21.png and figure22.png (clogs) and compare.txt to DIR, from all nozzle-*.aggregates there, and from the flows
nozzle-LENGTH.vtkhdf there or here. An exit has closed when the last particle that left has passed it; a run notices
that when nothing has left for 20 D/U, and ends.
"""
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from grids import read_grid
from report import Ours, Run, arguments, conclude, draw_pictures, read_runs, those_with, values_by_run

CHANNEL = 5e-4    # width of the channel [m], as in in.nozzle
DENSITY, SPEED = 2600, 1.0    # of particles, and mean of the water in the exit; as there
LENGTHS = ("0", "0.5", "1")    # of the contraction [widths of the channel]
KINDS = {"": "", "ratio50": ", d = D/50", "c0.02": ", c0 = 0.02"}    # by the end of a run's name
LINES = dict(zip(KINDS.values(), ("-", ":", "-.")))
TRANSIT = 10 / 1.5    # from the exit to the outlet, 10 D at the largest velocity there [D/U]


def parts(run):
    """Length of the contraction, phi, whether walls adhere, whether it has clogged; by the run's name."""
    length, phi, _, wall = run.name.split("-")[:4]
    ending = run.ending()
    return length, float(phi.removeprefix("phi")), wall == "yes", float("clogged" in ending) if ending else np.nan


def kind(run):
    """Words for what is not the usual: particles of a fiftieth of the exit, or fewer of them."""
    return KINDS["".join(run.name.split("-")[4:])]


def order(run):
    """Sorts by length, kind, phi, walls."""
    return parts(run)[0], kind(run), parts(run)[1:3]


def closed(run):
    """When the last particle that left has passed the exit [D/U]."""
    left = run.history["left"]
    return run.t[left >= left[-1] - 0.5][0] - TRANSIT


def end_of(run):
    """When its exit closes, or else its end [D/U]."""
    return closed(run) if parts(run)[3] == 1 else run.t[-1]


def size_along(run):
    """Mean size of free aggregates over x [widths of the channel] from a quarter of the run on, and before it closes if it does."""
    times, blocks = run.blocks(".profile")
    end = end_of(run)
    blocks = [rows for t, rows in zip(times, blocks) if end / 4 <= t <= end + 0.5]    # the last t is the middle of the last D/U
    free, share = (sum(rows[:, 2] * rows[:, k] for rows in blocks) for k in (3, 4))
    return blocks[0][:, 1] / CHANNEL, np.divide(free, share, out=np.full(len(free), np.nan), where=share > 0)


def growth(run):
    """Mean size of free aggregates in 0.2 widths behind the contraction over that in 0.2 widths before it."""
    if not run.blocks(".profile")[1]:
        return np.nan
    length = float(parts(run)[0])
    x, size = size_along(run)
    before, behind = (size[(x > low) & (x < low + 0.2)] for low in (-0.2, length))
    return behind.mean() / before.mean()


def swing(run):
    """Standard deviation of the mean size over time, from a quarter of the run on, and before it closes if it does."""
    end = end_of(run)
    return run.history["mean_size"][(run.t >= end / 4) & (run.t <= end)].std(ddof=1)


def late_growth(run):
    """Particles in wall aggregates in the last tenth of a run over those in its fifth tenth; nan if there are none."""
    share = run.t / run.t[-1]
    middle, end = (run.history["wall_in_aggregates"][(share > low) & (share <= low + 0.1)].mean() for low in (0.4, 0.9))
    return end / middle if middle else np.nan


def values_of(run, runs):
    """The quantities of report.csv, of one of the runs."""
    length, phi, adhere, clogged = parts(run)
    low = [other for other in runs if (*parts(other)[:3], kind(other)) == (length, 25, adhere, kind(run))]
    attached, groups = (run.last(key, 0.25)[0] for key in ("wall_in_aggregates", "wall_aggregates"))
    return {"mean size of aggregates": Ours(*run.last("mean_size", 0.5), run.t[-1]),
            "clogs: 1 or 0": Ours(clogged, t=run.t[-1]),
            "closed at t": Ours(closed(run) if clogged == 1 else np.nan, t=run.t[-1]),
            "wall aggregates: mean size": Ours(attached / groups if groups else np.nan, t=run.t[-1]),
            "particles on walls: last tenth / fifth tenth": Ours(late_growth(run), t=run.t[-1]),
            "size behind / before the contraction": Ours(growth(run), t=run.t[-1]),
            "fluctuation of mean size / that at phi = 25": Ours(swing(run) / swing(low[0]) if low and phi > 25 else np.nan, t=run.t[-1])}


def scene(run):
    """Words for particles, and for the elasticity number by the law of the log."""
    text = f"{run.history['entered'][-1]:.0f} entered, {run.history['left'][-1]:.0f} left"
    modulus = re.findall(r"^pair_coeff +1 1 jkr (\d\S*) (0\.\d+) ", run.log(), re.M)
    if modulus:
        E, nu = map(float, modulus[-1])
        text += f"; lambda {E / (2 * (1 - nu**2) * DENSITY * SPEED**2):.3g}"
    return text


def read_flows(folders):
    """Water and distance to the walls by length, of those files that there are."""
    grids = {length: read_grid(f"nozzle-{length}.vtkhdf", ["velocity", "inside", "distance"], *folders) for length in LENGTHS}
    return {length: grid for length, grid in grids.items() if grid}


def draw_entrance(flows, values_of_grid, levels, label, path):
    """A field near the contraction for each length, in coloured steps, and the walls (figures 13, 14)."""
    figure, axes = plt.subplots(1, len(flows), figsize=(4 * len(flows) + 0.8, 3.2), layout="constrained",
                                squeeze=False, sharey=True)
    for axis, (length, grid) in zip(axes[0], flows.items()):
        x, y = grid.x / CHANNEL, grid.y / CHANNEL
        image = axis.contourf(x, y, values_of_grid(grid)[0], levels, cmap="viridis", extend="both")
        axis.contour(x, y, grid["distance"][0], [0], colors="k", linewidths=1)
        axis.set(aspect="equal", xlim=(float(length) - 1.2, float(length) + 0.4), ylim=(-0.52, 0.52),
                 xlabel="x / width of the channel", title=f"length {length}")
    axes[0, 0].set_ylabel("y / width of the channel")
    figure.colorbar(image, ax=axes, label=label, shrink=0.8)
    figure.savefig(path, dpi=120)


def draw_particles(runs, columns, path):
    """Particles at the end of each run (figures 15, 19)."""
    ends = []
    for run in runs:
        length, phi, adhere, clogged = parts(run)
        times, paths = run.pictures()
        words = f"length {length}, $\\phi$ = {phi:g}{kind(run)}, walls {'adhere' if adhere else 'do not adhere'}, t = {times[-1]:.0f} D/U"
        ends.append((words + (", clogged" if clogged == 1 else ""), paths[-1]))
    draw_pictures(ends, columns, path, (4.6, 1), trim=True)


def draw_history(runs, path):
    """Mean size of all aggregates over time, phi = 50, without and with adhesion of the walls; below 2 there were none yet."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    for axis, wall in zip(axes, (False, True)):
        for run in runs:
            length, phi, adhere, clogged = parts(run)
            if phi == 50 and adhere == wall:
                size = run.history["mean_size"]
                axis.plot(run.t, np.where(size < 2, np.nan, size), linewidth=1,
                          label=f"length {length}" + kind(run) + (", clogs" if clogged == 1 else ""))
        axis.set(xlabel="t  [D/U]", ylabel="mean size of aggregates",
                 title=f"phi = 50, walls {'adhere' if wall else 'do not adhere'}")
        axis.axhline(2.4, color="k", linestyle="--", linewidth=0.8, label="report, walls do not adhere")
        low, high = axis.get_ylim()
        axis.set_ylim(low, high + 0.4 * (high - low))    # room for the legend
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_profiles(groups, path):
    """Mean size of free aggregates along the axis; groups are (title, runs, label of a run).

    Colours are those of phi where there are several, every other one dashed, else of the walls; small particles are dotted,
    few of them dash-dotted.
    """
    figure, axes = plt.subplots(1, len(groups), figsize=(4.5 * len(groups), 3.6), layout="constrained",
                                squeeze=False, sharey=True)
    for axis, (title, runs, label) in zip(axes[0], groups):
        phis = sorted({parts(run)[1] for run in runs})
        for run in runs:
            colour = f"C{phis.index(parts(run)[1])}" if len(phis) > 1 else "C1" if parts(run)[2] else "C0"
            dashed = len(phis) > 1 and phis.index(parts(run)[1]) % 2 and not kind(run)
            axis.plot(*size_along(run), linewidth=1, linestyle="--" if dashed else LINES[kind(run)], color=colour, label=label(run))
        for x in {0.0, float(parts(runs[0])[0])}:
            axis.axvline(x, color="0.6", linestyle="--", linewidth=0.8)
        axis.set(xlabel="x / width of the channel", title=title)
        axis.legend(fontsize=8)
    axes[0, 0].set_ylabel("mean size of free aggregates")
    figure.savefig(path, dpi=150)


def draw_clogs(runs, out):
    """The end of each run that clogged (figure 21), and how a bridge forms (figure 22) in the one with most pictures."""
    clogged = sorted((run for run in runs if parts(run)[3] == 1 and run.pictures(".close")[1]), key=order)
    if not clogged:
        return
    ends = [(f"length {parts(run)[0]}, phi = {parts(run)[1]:g}{kind(run)}, t = {run.t[-1]:.0f} D/U", run.pictures(".close")[1][-1])
            for run in clogged]
    draw_pictures(ends, min(4, len(ends)), out / "figure21.png")
    run = max(clogged, key=lambda run: len(run.pictures(".close")[1]) / run.t[-1])
    times, paths = run.pictures(".close")
    last = next(k for k, t in enumerate(times) if t >= closed(run) + 1 or t == times[-1])
    first = max(0, last - 7)
    draw_pictures([(f"t = {t:g} D/U", path) for t, path in zip(times[first:last + 1], paths[first:last + 1])], 4,
                  out / "figure22.png")


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = read_runs(folder, "nozzle-*.aggregates", lambda path: Run(path, "nozzle-"), kept and HERE)
    flows = read_flows((folder, HERE))
    if flows:
        draw_entrance(flows, lambda grid: grid.fluid(grid["velocity"][..., 0]), np.linspace(0, 1.5, 16),
                      "u / U, Re = 100", out / "figure13.png")
        draw_entrance(flows, lambda grid: grid["distance"] / CHANNEL, np.linspace(-0.15, 0.15, 13),
                      "distance to the walls / width", out / "figure14.png")
    pictured = [run for run in runs if run.pictures()[1]]
    by_length = sorted((run for run in pictured if parts(run)[1] == 50), key=order)
    if by_length:
        draw_particles(by_length, 2, out / "figure15.png")
    draw_history(runs, out / "figure16.png")
    profiled = those_with(runs, lambda run: run.blocks(".profile")[1], "profile", "figure17.png, figure20.png")
    lengths = [(f"length {length}", sorted((run for run in profiled if parts(run)[:2] == (length, 50)), key=order),
                lambda run: ("walls adhere" if parts(run)[2] else "walls do not adhere") + kind(run))
               for length in LENGTHS]
    lengths = [group for group in lengths if group[1]]
    if lengths:
        draw_profiles(lengths, out / "figure17.png")
    phis = sorted((run for run in runs if parts(run)[0] == "1" and parts(run)[2]), key=lambda run: (parts(run)[1], kind(run)))
    ends, along = ([run for run in phis if run in some] for some in (pictured, profiled))
    if ends:
        draw_particles(ends, len({kind(run) for run in ends}), out / "figure19.png")
    if along:
        draw_profiles([("length 1, walls adhere", along, lambda run: f"phi = {parts(run)[1]:g}" + kind(run))], out / "figure20.png")
    draw_clogs(runs, out)
    conclude(HERE, values_by_run(runs, lambda run: values_of(run, runs)), [run.cost(scene(run)) for run in runs], out, kept)


if __name__ == "__main__":
    main()
