#!/usr/bin/python3
"""Draws the report's figures from what in.fiber wrote, and compares:   plot.py [DIR]

Writes fiber.png (figures 32, 33, 34) and compare.txt to DIR, from all fiber-*.captured there.
"""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent))
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from report import read_history, read_report, table

HERE = Path(__file__).resolve().parent


def around(run, key, t):
    """Mean of a column over 20 L/U around t; nan if the run has not got there."""
    return run[key][abs(run["t"] - t) <= 10].mean() if run["t"][-1] >= t else np.nan


def values_of(run):
    """The quantities of report.csv."""
    late, end = run["t"] > 150, run["t"] > 700
    tce = [around(run, "TCE", t) for t in (150, 800)]
    captured = [around(run, "captured", t) for t in (400, 800)]
    return {"efficiency at t = 150 [%]": tce[0], "efficiency at 800 / at 150": tce[1] / tce[0],
            "captured at 800 / at 400": captured[1] / captured[0],
            "mean dendrite length for t > 150 [um]":
                run["dendrite"][late].mean() if any(late) else np.nan,
            "largest dendrite length for t > 700 [um]":
                run["dendrite"][end].max() if any(end) else np.nan}


def main():
    """Reads, draws, compares."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    paths = sorted(folder.glob("fiber-w*-phi*.captured"),
                   key=lambda path: float(path.stem.split("phi")[1]))
    if not paths:
        sys.exit(f"{folder}/fiber-*.captured: missing; run in.fiber with -var dir first")
    figure, axes = plt.subplots(1, 3, figsize=(13, 3.8), layout="constrained")
    values, runs = {}, {}
    for path in paths:
        run, (fibers, phi) = read_history(path), path.stem[6:].split("-phi")
        label = f"W = {fibers[1:]}, phi = {phi}" if "w" in fibers else path.stem
        for axis, key in zip(axes, ("captured", "TCE", "dendrite")):
            axis.plot(run["t"][1:], run[key][1:], linewidth=1, label=label)
        if fibers == "w8":
            values.update({(phi, key): value for key, value in values_of(run).items()})
        runs[path.stem] = (f"t = {run['t'][-1]:.0f}, {run['entered'][-1]:.0f} entered",
                           path.with_suffix(".log"))
    axes[1].plot(150, 1.0, "kx", markersize=9, label="report, phi = 100, 500")
    axes[1].axhline(0.080, color="0.5", linestyle=":", label="clean fiber, Kuwabara")
    axes[2].axhline(4, color="k", linestyle="--", linewidth=0.8, label="report, phi = 500")
    axes[2].plot(800, 20, "kx", markersize=9, label="report, phi = 2500")
    for axis, words in zip(axes, ("particles on the fiber", "total capture efficiency [%]",
                                  "longest dendrite [um]")):
        axis.set(xlabel="t  [L/U]", ylabel=words)
        axis.legend(fontsize=7)
    figure.savefig(folder / "fiber.png", dpi=150)
    table(read_report(HERE / "report.csv"), values, runs, folder / "compare.txt")


if __name__ == "__main__":
    main()
