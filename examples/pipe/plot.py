#!/usr/bin/python3
"""Draws the report's figures from what in.pipe wrote, and compares:   plot.py [DIR] [--keep]

Writes particles.png (ends of the runs: figure 23a and with adhesion), figure23.png (no adhesion), figure25.png, figure26.png,
figure27.png (adhesion), figure24.png and compare.txt to DIR, from all pipe-*.aggregates there.
"""
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import LogLocator

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from report import Run, arguments, conclude, draw_pictures, read_runs, those_with, values_by_run

VARIANTS = {"plain": "drag alone", "nolift": "no lift, no Magnus force", "e09": "e = 0.9", "soft": "lambda = 1.76e4"}    # names -phiPHI-VARIANT
EARLY = {False: 3, True: 2}    # time of the report's first profile, dry and with adhesion [L/U]
STEP, VOLUME = 0.00263, np.pi / 6 * 0.04**3    # particle step, volume of a particle; as in in.pipe


def joined(values):
    """Sums over rings, the last two of which become one."""
    return np.append(values[:-2], values[-2:].sum())


class Pipe(Run):
    """One run, with concentration c and velocity v over r at times (none before 1 L/U), and sizes at the end.

    A sphere on the wall has its center at r = 0.98, where two rings meet: the last two are one, 0.96 < r < 1.
    """

    def __init__(self, path):
        super().__init__(path, "pipe-", 1 / STEP)
        self.adhesive = not self.name.startswith("phi0")
        phi, *variant = self.name.split("-")
        self.words = ", ".join([f"phi = {phi[3:]}", *(VARIANTS.get(word, word) for word in variant)])
        self.times, blocks = self.blocks(".profiles")
        rings = np.linspace(0, 1, len(blocks[0]) + 1) if blocks else np.zeros(2)
        area = np.pi * np.diff(rings**2)
        edges = np.delete(rings, -2)
        self.r, self.area = (edges[1:] + edges[:-1]) / 2, joined(area)
        self.c = np.array([joined(rows[:, 4] * area) * VOLUME / self.area for rows in blocks])
        number = np.array([joined(rows[:, 3]) for rows in blocks])
        moved = np.array([joined(rows[:, 3] * rows[:, 5]) for rows in blocks])
        self.v = np.divide(moved, number, out=np.full(number.shape, np.nan), where=number > 0)
        found = re.findall(r"^region +box block 0 ([\d.]+) ", self.log(), re.M)
        self.length = float(found[-1]) if found else 4.0
        self.size, self.in_size = self.blocks(".sizes")[1][-1][:, 1:3].T
        self.largest = self.totals(".sizes")[-1]

    def profile(self, t, width=3):
        """c and v at the time next to t, the mean of `width` blocks."""
        k = np.argsort(abs(self.times - t))[:width]
        count = (~np.isnan(self.v[k])).sum(axis=0)
        v = np.divide(np.nansum(self.v[k], axis=0), count, out=np.full(len(self.r), np.nan), where=count > 0)
        return self.c[k].mean(axis=0), v


def blocks_of(run, span):
    """Middles of spans of time [L/U], and the means of particles in aggregates and of aggregates in them."""
    n = max(1, int(run.t[-1] / span + 0.05))    # a history ends a little before its run
    inside = [(run.t > span * k) & (run.t <= span * (k + 1)) for k in range(n)]
    means = [[run.history[key][part].mean() for part in inside] for key in ("in_aggregates", "aggregates")]
    return span * (np.arange(n) + 0.5), *np.array(means)


def dry_values(run, c, mean):
    """The quantities of report.csv for a dry run."""
    after = run.t > 1
    inside, count = (run.history[key][after] for key in ("in_aggregates", "aggregates"))
    first, middle, last = blocks_of(run, run.t[-1] / 3)[1]
    return {"size of collision clusters": inside.sum() / count.sum(), "c at r = 0.2": c[abs(run.r - 0.2) < 0.05].mean(),
            "largest c for 0.05 < r < 0.9": c[(run.r > 0.05) & (run.r < 0.9)].max(),
            "c at r = 0.95": c[(run.r > 0.94) & (run.r < 0.96)].mean(),
            "c for r > 0.96 / mean c": c[-1] / mean,
            "particles in collisions: middle / first third": middle / first if first else np.nan,
            "particles in collisions: last / middle third": last / middle if middle else np.nan}


def adhesive_values(run, c, v, total):
    """The same for a run with adhesion, of `total` particles."""
    inside, count = run.last("in_aggregates")[0], run.last("aggregates")[0]
    still = run.r[v > 0.05]
    number = np.divide(run.in_size, run.size)[run.size > 1]
    core, rest = (c[part] @ run.area[part] / run.area[part].sum() for part in (run.r < 0.5, (run.r > 0.5) & (run.r < 0.8)))
    return {"mean size": inside / count, "particles in aggregates": inside / total, "number of aggregates": count,
            "number of aggregates: end / largest": count / run.history["aggregates"].max(),
            "largest number of aggregates": run.history["aggregates"].max(),
            "share of aggregates with fewer than 10": number[run.size[run.size > 1] < 10].sum() / number.sum(),
            "largest aggregate": run.largest,
            "c for r < 0.5 / c for 0.5 < r < 0.8": core / rest,
            "radius of the peak of c": run.r[c.argmax()],
            "radius beyond which v < 0.05 U": still.max() if len(still) else 0.0}


def values_of(run):
    """The quantities of report.csv, at the end of the run; none before its first profile."""
    if len(run.times) == 0:
        return {}
    c, v = run.profile(run.times[-1])
    amount = c * run.area
    shares = {"share of particles within r < 0.5": amount[run.r < 0.5].sum() / amount.sum(),
              "share of particles beyond r > 0.9": amount[run.r > 0.9].sum() / amount.sum()}
    early = EARLY[run.adhesive]
    if run.t[-1] > early:
        first = run.profile(early)[0]
        shares[f"c for r > 0.96 / mean c at t = {early}"] = first[-1] * run.area.sum() / (first @ run.area)
    if run.adhesive:
        return {**shares, **adhesive_values(run, c, v, amount.sum() * run.length / VOLUME)}
    return {**shares, **dry_values(run, c, amount.sum() / run.area.sum())}


def draw_profiles(runs, early, path, marks=(), peak=None, still=None):
    """c and v over r at an early time (dashed) and at the end (solid), beside what the report says.

    That is points (r, c), the radius of a peak of c, the radius beyond which particles are at rest. With a peak c is on a
    logarithmic axis.
    """
    runs = those_with(runs, lambda run: len(run.times), "profile", path.name)
    if not runs:
        return
    figure, axes = plt.subplots(1, 2, figsize=(10, 4.6), layout="constrained")
    for k, run in enumerate(runs):
        for t, line in ((early, "--"), (run.times[-1], "-")):
            c, v = run.profile(t)
            axes[0].plot(run.r, c, line, color=f"C{k}", label=f"{run.words}, t = {t:.0f}")
            axes[1].plot(run.r, v, line, color=f"C{k}")
    if marks:
        axes[0].plot(*zip(*marks), "kx", markersize=9, label="report, t = 100")
    if peak:
        axes[0].axvline(peak, color="k", linestyle=":", linewidth=0.8, label="report's peak")
        axes[1].axvspan(still, 1, color="0.9", zorder=0, label="report: at rest")
    axes[1].plot(runs[0].r, 1 - runs[0].r**2, ":", color="0.5", label="fluid")
    axes[0].set(xlabel="r / L", ylabel="c", xlim=(0, 1))
    axes[0].set(**({"yscale": "log", "ylim": (1e-4, 1)} if peak else {"ylim": (0, None)}))
    axes[1].set(xlabel="r / L", ylabel="v / U", xlim=(0, 1))
    axes[1].legend(fontsize=8)
    figure.legend(*axes[0].get_legend_handles_labels(), fontsize=8, frameon=False, ncol=3, loc="lower center")
    figure.get_layout_engine().set(rect=(0, 0.17, 1, 0.83))
    figure.savefig(path, dpi=150)


def draw_history(runs, path, said, span=None):
    """Particles in aggregates, their number and mean size over time; the report's values dashed.

    With `span` the means over spans of that length, the first two on logarithmic axes.
    """
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for run in runs:
        t, n, count = blocks_of(run, span) if span else (run.t, run.history["in_aggregates"], run.history["aggregates"])
        size = np.divide(n, count, out=np.full_like(n, np.nan), where=count > 0)
        for axis, values in zip(axes, (n, count, size)):
            axis.plot(t, values, linewidth=1, marker="." if span else "", label=run.words)
    for axis, value, label in zip(axes, said, ("particles in aggregates", "aggregates", "mean size")):
        axis.set(xlabel="t  [L/U]", ylabel=label)
        if value:
            axis.axhline(value, color="k", linestyle="--", linewidth=0.8, label="report")
    for axis in axes[:2] if span else ():
        axis.set_yscale("log")
        axis.yaxis.set_minor_locator(LogLocator(subs=(2, 5)))
        for set_formatter in (axis.yaxis.set_major_formatter, axis.yaxis.set_minor_formatter):
            set_formatter("{x:g}")
    figure.legend(*axes[2].get_legend_handles_labels(), fontsize=8, frameon=False, ncol=len(runs) + 1, loc="lower center")
    figure.get_layout_engine().set(rect=(0, 0.06, 1, 0.94))
    figure.savefig(path, dpi=150)


def draw_sizes(runs, path):
    """Particles in aggregates of each size at the end."""
    figure, axis = plt.subplots(figsize=(6, 3.6), layout="constrained")
    for run in runs:
        axis.plot(run.size[run.in_size > 0], run.in_size[run.in_size > 0], ".", label=f"{run.words}, largest {run.largest:.0f}")
    axis.axvline(60, color="k", linestyle="--", linewidth=0.8, label="report's largest")
    axis.set(xlabel="particles in the aggregate", ylabel="particles in aggregates of this size",
             xlim=(0, 1.03 * max(60, *(run.largest for run in runs))), ylim=(10, 1000), yscale="log")
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = sorted(read_runs(folder, "pipe-*.aggregates", Pipe, kept and HERE), key=lambda run: float(run.name.split("-")[0][3:]))
    ends = [(f"{run.words}, t = {times[-1]:.0f} L/U", paths[-1]) for run in runs for times, paths in [run.pictures()] if paths]
    if ends:
        draw_pictures(ends, 3, out / "particles.png", (3.3, 1.7), trim=True)
    dry, adhesive = ([run for run in runs if run.adhesive == kind] for kind in (False, True))
    if dry:
        draw_profiles(dry, EARLY[False], out / "figure23.png", [(0.2, 0.03), (0.95, 0.008)])
        draw_history(dry, out / "figure24.png", (None, None, 2.02), span=5)
    if adhesive:
        draw_history(adhesive, out / "figure25.png", (0.8 * 5080, 700, 5.5))
        draw_sizes(adhesive, out / "figure26.png")
        draw_profiles(adhesive, EARLY[True], out / "figure27.png", peak=0.95, still=0.85)
    conclude(HERE, values_by_run(runs, values_of), [run.cost(f"{1270 * run.length:.0f} particles") for run in runs], out, kept)


if __name__ == "__main__":
    main()
