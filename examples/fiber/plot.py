#!/usr/bin/python3
"""Draws the report's figures from what in.fiber wrote, and compares:   plot.py [DIR] [--keep]

Writes fiber.png (figures 32, 33, 34), ends.png (all runs), figure30.png and figure31.png (particles in a layer,
along the fiber and from its side), figure35.png (dendrites, phi = 1000) and compare.txt to DIR, from all
fiber-*.captured there; figure29.png (streamlines) from fiber-w8.vtkhdf there or here. The front is what is captured
before the middle of the fiber, x < 0: the report measures dendrites on the face of the fiber.
"""
import re
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from grids import read_grid
from report import Run, arguments, conclude, draw_pictures, read_runs, trimmed, values_by_run

RADIUS = 1e-5    # of the fiber [m], as in in.fiber
PIXEL = 2 * 8e-5 / (700 * 1.6)    # size of one in the pictures of layers [m]: dump image, zoom 1.6, 700 for twice the box
TIMES = (100, 300, 400, 500)  # of the report's figures 30 and 31


def mean(run, key, start, end):
    """Mean of a column between two times: deposits grow and tear off, so that one time says little; nan if not reached."""
    inside = (run.t > start) & (run.t <= end)
    return run.history[key][inside].mean() if run.t[-1] >= end else np.nan


def values_of(run, runs):
    """The quantities of report.csv, of one of the runs."""
    early, middle, late = (mean(run, "TCE", *span) for span in ((140, 160), (400, 600), (600, 800)))
    captured = [mean(other, "captured", 140, 160) for other in runs if parts(other)[0] == parts(run)[0]]
    values = {"captured at t = 150": mean(run, "captured", 140, 160),
              "captured at t = 150 / mean over phi": mean(run, "captured", 140, 160) / np.mean(captured) if len(captured) > 1 else np.nan,
              "efficiency at t = 150 [%]": early, "efficiency after 600 [%]": late, "efficiency after 600 / at 150": late / early,
              "efficiency after 600 / from 400 to 600": late / middle,
              "largest efficiency [%]": run.history["TCE"][run.t > 20].max() if run.t[-1] > 20 else np.nan,
              "captured after 600 / from 400 to 600": mean(run, "captured", 600, 800) / mean(run, "captured", 400, 600),
              "share of the front after 600": mean(run, "front", 600, 800) / mean(run, "captured", 600, 800)}
    for key, where in (("dendrite", ""), ("front_dendrite", ", front")):
        end = run.history[key][run.t > 700]
        values[f"mean dendrite length for 90 < t < 110{where} [um]"] = mean(run, key, 90, 110)
        values[f"mean dendrite length for t > 150{where} [um]"] = mean(run, key, 150, 800)
        values[f"largest dendrite length for t > 700{where} [um]"] = end.max() if len(end) else np.nan
        values[f"largest dendrite length{where} [um]"] = run.history[key].max()
    return values


def air(run):
    """Words for the grid of the air that a run had; none where its file is not to be found."""
    found = re.findall(r"^fix +air all flow/field file ([^$\s]+)", run.log(), re.M)
    grid = read_grid(Path(found[-1]).name, [], Path(found[-1]).parent, HERE) if found else None
    return f"air on a grid of {(grid.x[1] - grid.x[0]) / RADIUS:.4g} L" if grid else "air on a grid"


def parts(run):
    """Distance of the fibers and phi, by the run's name."""
    distance, phi = run.name.split("-")[:2]
    return float(distance[1:]), float(phi[3:])


def words(run):
    """The run in words."""
    return "W = {:g}, phi = {:g}".format(*parts(run))


def draw(runs, path):
    """Particles on the fiber, efficiency and dendrites over time (figures 32 to 34)."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 4.3))
    for axis, key, label in zip(axes, ("captured", "TCE", "front_dendrite"), (
            "particles on the fiber, 2 L of it", "total capture efficiency [%]", "longest dendrite on the front [um]")):
        lines = [axis.plot(run.t[1:], run.history[key][1:], linewidth=1, linestyle="-" if parts(run)[0] == 8 else ":")[0]
                 for run in runs]
        axis.set(xlabel="t  [L/U]", ylabel=label)
    axes[1].plot(150, 1.0, "kx", markersize=9, label="report, W = 8, phi = 100, 500")
    axes[1].axhline(0.080, color="0.5", linestyle="--", label="clean fiber, Kuwabara, W = 8")
    axes[2].plot((150, 800), (4, 4), color="k", linestyle="--", linewidth=0.8, label="report, W = 8, phi = 500, t > 150")
    axes[2].plot(800, 20, "kx", markersize=9, label="report, W = 8, phi = 2500")
    for axis in axes[1:]:
        axis.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), frameon=False)
    figure.legend(lines, [words(run) for run in runs], loc="lower center", ncols=6, fontsize=9, frameon=False)
    figure.subplots_adjust(left=0.06, right=0.99, bottom=0.2, wspace=0.2)
    figure.savefig(path, dpi=150)


def draw_streamlines(grid, path):
    """Streamlines past the fiber in the box of the particles (figure 29)."""
    x, y = grid.x / RADIUS, grid.y / RADIUS
    u, v = (grid.fluid(grid["velocity"][..., k])[0] for k in (0, 1))
    figure, axis = plt.subplots(figsize=(5, 5), layout="constrained")
    places = np.linspace(y[0] + 0.02, y[-1] - 0.02, 33)
    axis.streamplot(x, y, u, v, start_points=[(x[0] + 0.01, place) for place in places], density=20, linewidth=0.7,
                    arrowsize=0.6, broken_streamlines=False)
    axis.add_patch(plt.Circle((0, 0), 1, color="0.7"))
    axis.set(aspect="equal", xlim=x[[0, -1]], ylim=y[[0, -1]], xlabel="x / L   (air flows to the right)", ylabel="y / L",
             title="W = 8, Re = 0.178")
    figure.savefig(path, dpi=120)


def draw_layers(runs, layer, path, size, circle=None):
    """Particles in a layer, a row for each run, at the report's times or a run's end next to them (figures 30, 31).

    `circle`: with the fiber in whole pictures, its radius in pixels; without it white margins are taken off.
    """
    pictures = []
    for run in runs:
        times, paths = run.pictures(layer)
        near = sorted({int(np.argmin(abs(np.array(times) - t))) for t in TIMES if times})
        row = [(f"{words(run)}, t = {times[k]:g} L/U", paths[k]) for k in near]
        pictures += row + [None] * (len(TIMES) - len(row))
    if any(pictures):
        draw_pictures(pictures, len(TIMES), path, size, trim=not circle, circle=circle)


def draw_dendrites(run, path):
    """The longest dendrite over time, the stages of the report, and the fiber at the end (figure 35)."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.8), width_ratios=(3, 2), layout="constrained")
    axes[0].plot(run.t[1:], run.history["front_dendrite"][1:], linewidth=1, label=words(run))
    for t in (200, 600):
        axes[0].axvline(t, color="0.6", linestyle="--", linewidth=0.8)
    for t, stage in ((100, "capture by\nthe fiber"), (400, "by fiber\nand dendrites"), (700, "by dendrites")):
        axes[0].text(t, 1.02, f"report:\n{stage}", ha="center", fontsize=8, transform=axes[0].get_xaxis_transform())
    axes[0].set(xlabel="t  [L/U]", ylabel="longest dendrite on the front [um]", ylim=(0, None), xlim=(0, 800))
    axes[0].legend(loc="lower right", fontsize=8)
    times, paths = run.pictures()
    axes[1].imshow(trimmed(plt.imread(paths[-1])))
    axes[1].set_title(f"t = {times[-1]:g} L/U, along the fiber, air from above", fontsize=9)
    axes[1].axis("off")
    figure.savefig(path, dpi=130)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = sorted(read_runs(folder, "fiber-*.captured", lambda path: Run(path, "fiber-"), kept and HERE), key=parts)
    draw(runs, out / "fiber.png")
    flow = read_grid("fiber-w8.vtkhdf", ["velocity", "inside"], folder, HERE)
    if flow:
        draw_streamlines(flow, out / "figure29.png")
    draw_pictures([(f"{words(run)}, t = {run.pictures()[0][-1]:g} L/U", run.pictures()[1][-1]) for run in runs], 3,
                  out / "ends.png")
    middle = [run for run in runs if parts(run)[1] == 1000]
    draw_layers(middle, ".xy", out / "figure30.png", (3, 3), RADIUS / PIXEL)
    draw_layers(middle, ".xz", out / "figure31.png", (5, 1.5))
    for run in middle:
        if parts(run)[0] == 8:
            draw_dendrites(run, out / "figure35.png")
    conclude(HERE, values_by_run(runs, lambda run: values_of(run, runs)),
             [run.cost(f"{run.history['entered'][-1]:.0f} entered; {air(run)}") for run in runs], out, kept)


if __name__ == "__main__":
    main()
