#!/usr/bin/python3
"""Draws what has settled where, from what in.radiator wrote, and compares:   plot.py [DIR] [--keep]

Writes deposit.png, figure40.png (a slice before the bar) and compare.txt to DIR, from all radiator-*.captured there.
"""
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.append(str(HERE.parent))
from report import Run, arguments, conclude, draw_pictures, read_runs, values_by_run

ZONES = {"front": "front of the bar", "edges": "edges of the fins", "channels": "walls of the channels"}
# areas in mm^2: the front with its round corners; the fins behind their round edges, 1.8 mm long, both faces
AREA = {"front": 1.2 * (0.6 + np.pi * 0.2), "channels": 2 * 2 * 1.0 * 1.8}


def words(run):
    """The run in words."""
    phi, _, wet = run.name.split("-")[:3]
    return f"phi = {phi[3:]}, {'moist' if wet == 'yes' else 'dry'}"


def values_of(run):
    """The quantities of report.csv."""
    zones = run.history
    per_area = {zone: zones[zone][-1] / area for zone, area in AREA.items()}
    half = zones["all"][run.t <= run.t[-1] / 2][-1]
    pairs = {"deposited per area: front / channels": (per_area["front"], per_area["channels"]),
             "deposited late / half-time": (zones["all"][-1], half)}
    return {key: above / below if below else np.nan for key, (above, below) in pairs.items()}


def draw(runs, path):
    """What settles where, over time."""
    figure, axes = plt.subplots(1, len(runs), figsize=(5.5 * len(runs), 3.8), layout="constrained",
                                squeeze=False, sharey=True)
    for axis, run in zip(axes[0], runs):
        for zone, label in ZONES.items():
            axis.plot(run.t, run.history[zone], linewidth=1, label=label)
        axis.set(xlabel="t  [L/U]", ylabel="deposited particles", title=words(run))
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder, out, kept = arguments(__doc__, HERE)
    runs = read_runs(folder, "radiator-*.captured", lambda path: Run(path, "radiator-"))
    draw(runs, out / "deposit.png")
    ends = [(f"{words(run)}, t = {times[-1]:g} L/U", paths[-1]) for run in runs
            for times, paths in [run.pictures(".slice")] if paths]
    if ends:
        draw_pictures(ends, 2, out / "figure40.png", (6, 3.2))
    conclude(HERE, values_by_run(runs, values_of),
             [run.cost(f"{run.history['entered'][-1]:.0f} entered") for run in runs], out, kept)


if __name__ == "__main__":
    main()
