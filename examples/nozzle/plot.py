#!/usr/bin/python3
"""Draws the report's figures from what in.nozzle wrote, and compares:   plot.py [DIR]

Writes figure16.png (sizes over time), figure17.png (along the axis, by length), figure20.png (by phi)
and compare.txt to DIR, from all nozzle-*.aggregates there.
"""
import sys
from pathlib import Path

sys.path.append(str(Path(__file__).resolve().parent.parent))
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from report import read_blocks, read_history, read_report, table

HERE = Path(__file__).resolve().parent
ONE, CHANNEL = 100, 5e-4    # steps in D/U, width of the channel [m], as in in.nozzle


class Run:
    """One run: history over t, and the mean size of free aggregates over x after a quarter of it."""

    def __init__(self, path):
        self.name = path.stem.removeprefix("nozzle-")
        self.length, phi, _, wall = self.name.split("-")
        self.phi, self.wall = float(phi.removeprefix("phi")), wall == "yes"
        self.history = read_history(path)
        self.t = self.history["step"] / ONE
        blocks = [rows for step, rows in read_blocks(path.with_suffix(".profile"))
                  if step >= 0.25 * self.history["step"][-1]]
        self.x = blocks[0][:, 1] / CHANNEL
        free, share = (sum(rows[:, 2] * rows[:, k] for rows in blocks) for k in (3, 4))
        self.size = np.divide(free, share, out=np.full(len(free), np.nan), where=share > 0)
        self.log = path.with_suffix(".log")
        ends = [line for line in self.log.read_text().split("\n") if line[:5] in ("pass:", "FAIL:")]
        self.clogged = float("clogged" in ends[-1]) if ends else np.nan

    def values(self):
        """The quantities of report.csv."""
        late = self.t > 0.25 * self.t[-1]
        return {"mean size of aggregates": self.history["mean_size"][late].mean(),
                "clogs: 1 or 0": self.clogged}


def draw_history(runs, path):
    """Mean size of all aggregates over time, phi = 50, without and with adhesion of the walls."""
    figure, axes = plt.subplots(1, 2, figsize=(11, 3.8), layout="constrained")
    for axis, wall in zip(axes, (False, True)):
        for run in runs:
            if run.phi == 50 and run.wall == wall:
                axis.plot(run.t, run.history["mean_size"], linewidth=1,
                          label=f"length {run.length}" + (", clogs" if run.clogged == 1 else ""))
        axis.set(xlabel="t  [D/U]", ylabel="mean size of aggregates",
                 title="walls adhere" if wall else "walls do not adhere")
    axes[0].axhline(2.4, color="k", linestyle="--", linewidth=0.8, label="report")
    for axis in axes:
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_profiles(groups, path):
    """Mean size of free aggregates along the axis; groups are (title, runs, label of a run)."""
    figure, axes = plt.subplots(1, len(groups), figsize=(4.5 * len(groups), 3.6), layout="constrained",
                                squeeze=False)
    for axis, (title, runs, label) in zip(axes[0], groups):
        for run in runs:
            axis.plot(run.x, run.size, linewidth=1, label=label(run))
        for x in {0.0, float(runs[0].length)}:
            axis.axvline(x, color="0.6", linestyle="--", linewidth=0.8)
        axis.set(xlabel="x / width of the channel", ylabel="mean size of free aggregates", title=title)
        axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    runs = [Run(path) for path in sorted(folder.glob("nozzle-*.aggregates"))]
    if not runs:
        sys.exit(f"{folder}/nozzle-*.aggregates: missing; run in.nozzle with -var dir first")
    draw_history(runs, folder / "figure16.png")
    lengths = [(f"length {length}", [run for run in runs if run.length == length and run.phi == 50],
                lambda run: "walls adhere" if run.wall else "walls do not")
               for length in ("0", "0.5", "1")]
    lengths = [group for group in lengths if group[1]]
    if lengths:
        draw_profiles(lengths, folder / "figure17.png")
    long = sorted((run for run in runs if run.length == "1" and run.wall), key=lambda run: run.phi)
    if long:
        draw_profiles([("length 1, walls adhere", long, lambda run: f"phi = {run.phi:g}")],
                      folder / "figure20.png")
    values = {(run.name, key): value for run in runs for key, value in run.values().items()}
    words = {run.name: (f"t = {run.t[-1]:.0f}, {run.history['entered'][-1]:.0f} entered, "
                        f"{run.history['left'][-1]:.0f} left", run.log) for run in runs}
    table(read_report(HERE / "report.csv"), values, words, folder / "compare.txt")


if __name__ == "__main__":
    main()
