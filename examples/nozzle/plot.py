#!/usr/bin/python3
"""Draws the report's figures from what in.nozzle wrote, and compares:   plot.py [DIR] [--keep]

Writes figure13.png (water), figure14.png (distance to the walls), figure15.png and figure19.png (particles, by
length and by phi), figure16.png (sizes over time), figure17.png (along the axis, by length), figure20.png (by phi),
figure21.png and figure22.png (clogs) and compare.txt to DIR, from all nozzle-*.aggregates there, and from the flows
nozzle-LENGTH.vtkhdf there or here.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from grids import read_grid
from report import Ours, Run, arguments, conclude, draw_pictures, read_runs, those_with, values_by_run

CHANNEL = 5e-4    # width of the channel [m], as in in.nozzle
LENGTHS = ("0", "0.5", "1")    # of the contraction [widths of the channel]
TRANSIT = 10 / 1.5    # from the exit to the outlet, 10 D at the largest velocity there [D/U]


def parts(run):
    """Length of the contraction, phi, whether walls adhere, whether it has clogged; by the run's name."""
    length, phi, _, wall = run.name.split("-")[:4]
    ending = run.ending()
    return length, float(phi.removeprefix("phi")), wall == "yes", float("clogged" in ending) if ending else np.nan


def kind(run):
    """Words for what is not the usual: particles of a fiftieth of the exit."""
    return ", d = D/50" if run.name.endswith("ratio50") else ""


def size_along(run):
    """Mean size of free aggregates over x [widths of the channel] after a quarter of the run."""
    times, blocks = run.blocks(".profile")
    blocks = [rows for t, rows in zip(times, blocks) if t >= 0.25 * run.t[-1]]
    free, share = (sum(rows[:, 2] * rows[:, k] for rows in blocks) for k in (3, 4))
    return blocks[0][:, 1] / CHANNEL, np.divide(free, share, out=np.full(len(free), np.nan), where=share > 0)


def values_of(run):
    """The quantities of report.csv."""
    return {"mean size of aggregates": Ours(*run.last("mean_size", 0.75), run.t[-1]),
            "clogs: 1 or 0": Ours(parts(run)[3], t=run.t[-1])}


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
        words = f"length {length}, $\\phi$ = {phi:g}, walls {'adhere' if adhere else 'do not adhere'}, t = {times[-1]:.0f} D/U"
        ends.append((words + (", clogged" if clogged == 1 else ""), paths[-1]))
    draw_pictures(ends, columns, path, (4.6, 1), trim=True)


def draw_history(runs, path):
    """Mean size of all aggregates over time, phi = 50, without and with adhesion of the walls."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    for axis, wall in zip(axes, (False, True)):
        for run in runs:
            length, phi, adhere, clogged = parts(run)
            if phi == 50 and adhere == wall:
                axis.plot(run.t, run.history["mean_size"], linewidth=1,
                          label=f"length {length}" + kind(run) + (", clogs" if clogged == 1 else ""))
        axis.set(xlabel="t  [D/U]", ylabel="mean size of aggregates",
                 title=f"phi = 50, walls {'adhere' if wall else 'do not adhere'}")
        axis.axhline(2.4, color="k", linestyle="--", linewidth=0.8, label="report, walls do not adhere")
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_profiles(groups, path):
    """Mean size of free aggregates along the axis; groups are (title, runs, label of a run)."""
    figure, axes = plt.subplots(1, len(groups), figsize=(4.5 * len(groups), 3.6), layout="constrained",
                                squeeze=False)
    for axis, (title, runs, label) in zip(axes[0], groups):
        for run in runs:
            axis.plot(*size_along(run), linewidth=1, label=label(run))
        for x in {0.0, float(parts(runs[0])[0])}:
            axis.axvline(x, color="0.6", linestyle="--", linewidth=0.8)
        axis.set(xlabel="x / width of the channel", ylabel="mean size of free aggregates", title=title)
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_clogs(runs, out):
    """The end of each run that clogged (figure 21), and how a bridge forms (figure 22) in the one with most pictures."""
    clogged = sorted((run for run in runs if parts(run)[3] == 1 and run.pictures(".close")[1]), key=parts)
    if not clogged:
        return
    ends = [(f"length {parts(run)[0]}, phi = {parts(run)[1]:g}, t = {run.t[-1]:.0f} D/U", run.pictures(".close")[1][-1])
            for run in clogged]
    draw_pictures(ends, min(4, len(ends)), out / "figure21.png")
    run = max(clogged, key=lambda run: len(run.pictures(".close")[1]) / run.t[-1])
    times, paths = run.pictures(".close")
    left = run.history["left"]
    closed = run.t[left >= left[-1] - 0.5][0] - TRANSIT + 1
    last = next(k for k, t in enumerate(times) if t >= closed or t == times[-1])
    first = max(0, last - 7)
    draw_pictures([(f"t = {t:g} D/U", path) for t, path in zip(times[first:last + 1], paths[first:last + 1])], 4,
                  out / "figure22.png")


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = read_runs(folder, "nozzle-*.aggregates", lambda path: Run(path, "nozzle-"))
    flows = read_flows((folder, HERE))
    if flows:
        draw_entrance(flows, lambda grid: grid.fluid(grid["velocity"][..., 0]), np.linspace(0, 1.5, 16),
                      "u / U, Re = 100", out / "figure13.png")
        draw_entrance(flows, lambda grid: grid["distance"] / CHANNEL, np.linspace(-0.15, 0.15, 13),
                      "distance to the walls / width", out / "figure14.png")
    usual = [run for run in runs if not kind(run) and run.pictures()[1]]
    by_length = sorted((run for run in usual if parts(run)[1] == 50), key=lambda run: (parts(run)[0], parts(run)[2]))
    if by_length:
        draw_particles(by_length, 2, out / "figure15.png")
    draw_history(runs, out / "figure16.png")
    profiled = those_with(runs, lambda run: run.blocks(".profile")[1], "profile", "figure17.png, figure20.png")
    lengths = [(f"length {length}", [run for run in profiled if parts(run)[:2] == (length, 50)],
                lambda run: ("walls adhere" if parts(run)[2] else "walls do not adhere") + kind(run))
               for length in LENGTHS]
    lengths = [group for group in lengths if group[1]]
    if lengths:
        draw_profiles(lengths, out / "figure17.png")
    phis = sorted((run for run in runs if parts(run)[0] == "1" and parts(run)[2]), key=lambda run: parts(run)[1])
    pictured, along = ([run for run in phis if run in some] for some in (usual, profiled))
    if pictured:
        draw_particles(pictured, 1, out / "figure19.png")
    if along:
        draw_profiles([("length 1, walls adhere", along, lambda run: f"phi = {parts(run)[1]:g}")], out / "figure20.png")
    draw_clogs(runs, out)
    costs = [run.cost(f"{run.history['entered'][-1]:.0f} entered, {run.history['left'][-1]:.0f} left")
             for run in runs]
    conclude(HERE, values_by_run(runs, values_of), costs, out, kept)


if __name__ == "__main__":
    main()
