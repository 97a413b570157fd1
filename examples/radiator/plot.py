#!/usr/bin/python3
"""Draws what has settled where, from what in.radiator wrote, and compares:   plot.py [DIR]

Writes deposit.png and compare.txt to DIR, from all radiator-*.captured there.
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
ZONES = {"front": "front of the bar", "edges": "edges of the fins", "channels": "walls of the channels"}
# areas in mm^2: the front with its round corners; the fins behind their round edges, 1.8 mm long, both faces
AREA = {"front": 1.2 * (0.6 + np.pi * 0.2), "channels": 2 * 2 * 1.0 * 1.8}


def values_of(run):
    """The quantities of report.csv."""
    per_area = {zone: run[zone][-1] / area for zone, area in AREA.items()}
    half = run["all"][run["t"] <= run["t"][-1] / 2][-1]
    pairs = {"deposited per area: front / channels": (per_area["front"], per_area["channels"]),
             "deposited late / half-time": (run["all"][-1], half)}
    return {key: above / below if below else np.nan for key, (above, below) in pairs.items()}


def main():
    """Reads, draws, compares."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    paths = sorted(folder.glob("radiator-*.captured"))
    if not paths:
        sys.exit(f"{folder}/radiator-*.captured: missing; run in.radiator with -var dir first")
    figure, axes = plt.subplots(1, len(paths), figsize=(5.5 * len(paths), 3.8), layout="constrained",
                                squeeze=False, sharey=True)
    rows, values, runs = [], {}, {}
    for axis, path in zip(axes[0], paths):
        run, name = read_history(path), path.stem.removeprefix("radiator-")
        for zone, words in ZONES.items():
            axis.plot(run["t"], run[zone], linewidth=1, label=words)
        axis.set(xlabel="t  [L/U]", ylabel="deposited particles", title=name)
        axis.legend(fontsize=8)
        rows += [{**row, "case": name} for row in read_report(HERE / "report.csv") if row["case"] in name]
        values.update({(name, key): value for key, value in values_of(run).items()})
        runs[name] = (f"t = {run['t'][-1]:.0f}, {run['entered'][-1]:.0f} entered", path.with_suffix(".log"))
    figure.savefig(folder / "deposit.png", dpi=150)
    table(rows, values, runs, folder / "compare.txt")


if __name__ == "__main__":
    main()
