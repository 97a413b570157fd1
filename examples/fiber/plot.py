#!/usr/bin/python3
"""Draws the report's figures from what in.fiber wrote, and compares:   plot.py [DIR] [--keep]

Writes fiber.png (figures 32, 33, 34), figure30.png (the ends) and compare.txt to DIR, from all fiber-*.captured there.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from report import Run, arguments, conclude, draw_pictures, read_runs, values_by_run


def mean(run, key, start, end):
    """Mean of a column between two times: deposits grow and tear off, so that one time says little; nan if not reached."""
    inside = (run.t > start) & (run.t <= end)
    return run.history[key][inside].mean() if run.t[-1] >= end else np.nan


def values_of(run):
    """The quantities of report.csv."""
    dendrite, end = run.history["dendrite"], run.t > 700
    early, late = mean(run, "TCE", 140, 160), mean(run, "TCE", 600, 800)
    return {"captured at t = 150": mean(run, "captured", 140, 160), "efficiency at t = 150 [%]": early,
            "efficiency after 600 / at 150": late / early,
            "captured after 600 / from 400 to 600": mean(run, "captured", 600, 800) / mean(run, "captured", 400, 600),
            "mean dendrite length for t > 150 [um]": mean(run, "dendrite", 150, 800),
            "largest dendrite length for t > 700 [um]": dendrite[end].max() if any(end) else np.nan}


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
    for axis, key, label in zip(axes, ("captured", "TCE", "dendrite"), (
            "particles on the fiber, 2 L of it", "total capture efficiency [%]", "longest dendrite [um]")):
        lines = [axis.plot(run.t[1:], run.history[key][1:], linewidth=1, linestyle="-" if parts(run)[0] == 8 else ":")[0]
                 for run in runs]
        axis.set(xlabel="t  [L/U]", ylabel=label)
    axes[1].plot(150, 1.0, "kx", markersize=9, label="report, W = 8, phi = 100, 500")
    axes[1].axhline(0.080, color="0.5", linestyle="--", label="clean fiber, Kuwabara, W = 8")
    axes[2].axhline(4, color="k", linestyle="--", linewidth=0.8, label="report, W = 8, phi = 500")
    axes[2].plot(800, 20, "kx", markersize=9, label="report, W = 8, phi = 2500")
    for axis in axes[1:]:
        axis.legend(fontsize=8, loc="lower center", bbox_to_anchor=(0.5, 1), frameon=False)
    figure.legend(lines, [words(run) for run in runs], loc="lower center", ncols=6, fontsize=9, frameon=False)
    figure.subplots_adjust(left=0.06, right=0.99, bottom=0.2, wspace=0.2)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = sorted(read_runs(folder, "fiber-*.captured", lambda path: Run(path, "fiber-")), key=parts)
    draw(runs, out / "fiber.png")
    draw_pictures([(f"{words(run)}, t = {run.pictures()[0][-1]:g} L/U", run.pictures()[1][-1]) for run in runs], 3,
                  out / "figure30.png")
    conclude(HERE, values_by_run(runs, values_of),
             [run.cost(f"{run.history['entered'][-1]:.0f} entered") for run in runs], out, kept)


if __name__ == "__main__":
    main()
