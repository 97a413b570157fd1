#!/usr/bin/python3
"""Draws the report's figures from what in.fiber wrote, and compares:   plot.py [DIR] [--keep]

Writes fiber.png (figures 32, 33, 34) and compare.txt to DIR, from all fiber-*.captured there.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from report import Ours, Run, arguments, conclude, read_report, read_runs


def around(run, key, t):
    """Mean of a column over 20 L/U around t; nan if the run has not got there."""
    return run.history[key][abs(run.t - t) <= 10].mean() if run.t[-1] >= t else np.nan


def values_of(run):
    """The quantities of report.csv."""
    dendrite, late, end = run.history["dendrite"], run.t > 150, run.t > 700
    tce = [around(run, "TCE", t) for t in (150, 800)]
    captured = [around(run, "captured", t) for t in (400, 800)]
    return {"efficiency at t = 150 [%]": tce[0], "efficiency at 800 / at 150": tce[1] / tce[0],
            "captured at 800 / at 400": captured[1] / captured[0],
            "mean dendrite length for t > 150 [um]": dendrite[late].mean() if any(late) else np.nan,
            "largest dendrite length for t > 700 [um]": dendrite[end].max() if any(end) else np.nan}


def draw(runs, path):
    """Particles on the fiber, efficiency and dendrites over time (figures 32 to 34)."""
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    for run in runs:
        for axis, key in zip(axes, ("captured", "TCE", "dendrite")):
            axis.plot(run.t[1:], run.history[key][1:], linewidth=1, label=run.name)
    axes[1].plot(150, 1.0, "kx", markersize=9, label="report, phi = 100, 500")
    axes[1].axhline(0.080, color="0.5", linestyle=":", label="clean fiber, Kuwabara")
    axes[2].axhline(4, color="k", linestyle="--", linewidth=0.8, label="report, phi = 500")
    axes[2].plot(800, 20, "kx", markersize=9, label="report, phi = 2500")
    for axis, words in zip(axes, ("particles on the fiber", "total capture efficiency [%]",
                                  "longest dendrite [um]")):
        axis.set(xlabel="t  [L/U]", ylabel=words)
        axis.legend(fontsize=7)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = sorted(read_runs(folder, "fiber-*.captured", lambda path: Run(path, "fiber-")),
                  key=lambda run: (len(run.name), run.name))
    draw(runs, out / "fiber.png")
    values = {(run.name, key): Ours(value, t=run.t[-1]) for run in runs for key, value in values_of(run).items()}
    conclude(HERE, read_report(HERE / "report.csv"), values,
             [run.cost(f"{run.history['entered'][-1]:.0f} entered") for run in runs], out, kept)


if __name__ == "__main__":
    main()
