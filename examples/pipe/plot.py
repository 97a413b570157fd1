#!/usr/bin/python3
"""Draws the report's figures from what in.pipe wrote, and compares:   plot.py [DIR]

Writes figure23.png (no adhesion), figure25.png, figure26.png, figure27.png (adhesion), figure24.png and
compare.txt to DIR, from all pipe-*.aggregates there.
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
STEP, VOLUME = 0.00263, np.pi / 6 * 0.04**3    # particle step, volume of a particle; as in in.pipe
BINS = {"r": 1, "count": 3, "density": 4, "v": 5}    # columns of the profiles


class Run:
    """One run: history over t, concentration c and velocity v over r at times, sizes at the end."""

    def __init__(self, path):
        self.name = path.stem.removeprefix("pipe-")
        self.adhesive = not self.name.startswith("phi0")
        self.history = read_history(path)
        self.t = self.history["step"] * STEP
        blocks = read_blocks(path.with_suffix(".profiles"))
        self.times = np.array([step * STEP for step, _ in blocks])
        self.r = blocks[0][1][:, BINS["r"]]
        self.c = np.array([rows[:, BINS["density"]] * VOLUME for _, rows in blocks])
        self.v = np.array([np.where(rows[:, BINS["count"]] > 0, rows[:, BINS["v"]], np.nan) for _, rows in blocks])
        sizes = read_blocks(path.with_suffix(".sizes"))[-1][1]
        self.size, self.in_size = sizes[:, 1], sizes[:, 2]
        self.log = path.with_suffix(".log")

    def late(self, key):
        """Mean of a column over the last fifth of the run."""
        return self.history[key][self.t > 0.8 * self.t[-1]].mean()

    def profile(self, t, width=3):
        """c and v at the time next to t, the mean of `width` blocks."""
        k = np.argsort(abs(self.times - t))[:width]
        count = (~np.isnan(self.v[k])).sum(axis=0)
        v = np.divide(np.nansum(self.v[k], axis=0), count, out=np.full(len(self.r), np.nan), where=count > 0)
        return self.c[k].mean(axis=0), v


def values_of(run):
    """The quantities of report.csv, at the end of the run."""
    c, v = run.profile(run.times[-1])
    volume = run.r * (run.r[1] - run.r[0])
    size = run.late("in_aggregates") / run.late("aggregates")
    if not run.adhesive:
        early = run.history["in_aggregates"][(run.t > 1) & (run.t < 10)].mean()
        return {"size of collision clusters": size, "c at r = 0.2": c[abs(run.r - 0.2) < 0.05].mean(),
                "largest c for 0.05 < r < 0.9": c[(run.r > 0.05) & (run.r < 0.9)].max(),
                "c at r = 0.95": c[(run.r > 0.94) & (run.r < 0.96)].mean(),
                "c at the wall / mean c": c[-1] / (c @ volume / volume.sum()),
                "particles in collisions late / early": run.late("in_aggregates") / early}
    still = run.r[v > 0.05]
    total = (c @ volume) * 2 * np.pi * 4 / VOLUME
    return {"mean size": size, "particles in aggregates": run.late("in_aggregates") / total,
            "number of aggregates": run.late("aggregates"),
            "largest aggregate": run.size[run.in_size > 0].max(),
            "radius of the peak of c": run.r[c.argmax()],
            "radius beyond which v < 0.05 U": still.max() if len(still) else 0.0}


def draw_profiles(runs, early, path, marks):
    """c and v over r at an early time (dashed) and at the end (solid), beside the report's points."""
    figure, axes = plt.subplots(1, 2, figsize=(10, 3.8), layout="constrained")
    for k, run in enumerate(runs):
        for t, line in ((early, "--"), (run.times[-1], "-")):
            c, v = run.profile(t)
            axes[0].plot(run.r, c, line, color=f"C{k}", label=f"{run.name}, t = {t:.0f}")
            axes[1].plot(run.r, v, line, color=f"C{k}")
    for r, c in marks:
        axes[0].plot(r, c, "kx", markersize=9)
    axes[1].plot(runs[0].r, 1 - runs[0].r**2, ":", color="0.5", label="fluid")
    axes[0].plot([], [], "kx", label="report, t = 100")
    axes[0].set(xlabel="r / L", ylabel="c", ylim=(0, 0.1), xlim=(0, 1))
    axes[1].set(xlabel="r / L", ylabel="v / U", xlim=(0, 1))
    axes[0].legend(fontsize=8)
    axes[1].legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_history(runs, path, said):
    """Particles in aggregates, their number and mean size over time; the report's values dashed."""
    figure, axes = plt.subplots(1, 3, figsize=(12, 3.6), layout="constrained")
    for run in runs:
        n, count = run.history["in_aggregates"], run.history["aggregates"]
        size = np.divide(n, count, out=np.full_like(n, np.nan), where=count > 0)
        for axis, values in zip(axes, (n, count, size)):
            axis.plot(run.t, values, linewidth=1, label=run.name)
    for axis, value, label in zip(axes, said, ("particles in aggregates", "aggregates", "mean size")):
        axis.set(xlabel="t  [L/U]", ylabel=label)
        if value:
            axis.axhline(value, color="k", linestyle="--", linewidth=0.8, label="report")
    axes[2].legend(fontsize=8)
    figure.savefig(path, dpi=150)


def draw_sizes(runs, path):
    """Particles in aggregates of each size at the end."""
    figure, axis = plt.subplots(figsize=(6, 3.6), layout="constrained")
    for run in runs:
        axis.step(run.size, run.in_size, where="mid", label=run.name)
    axis.axvline(60, color="k", linestyle="--", linewidth=0.8, label="report's largest")
    axis.set(xlabel="particles in the aggregate", ylabel="particles in aggregates of this size",
             xlim=(1.5, 100), yscale="log")
    axis.legend(fontsize=8)
    figure.savefig(path, dpi=150)


def main():
    """Reads, draws, compares."""
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    runs = [Run(path) for path in sorted(folder.glob("pipe-*.aggregates"))]
    if not runs:
        sys.exit(f"{folder}/pipe-*.aggregates: missing; run in.pipe with -var dir first")
    dry, adhesive = ([run for run in runs if run.adhesive == kind] for kind in (False, True))
    if dry:
        draw_profiles(dry, 3, folder / "figure23.png", [(0.2, 0.03), (0.95, 0.008)])
        draw_history(dry, folder / "figure24.png", (None, None, 2.02))
    if adhesive:
        draw_history(adhesive, folder / "figure25.png", (0.8 * 5080, 700, 5.5))
        draw_sizes(adhesive, folder / "figure26.png")
        draw_profiles(adhesive, 2, folder / "figure27.png", [])
    report, rows, values = read_report(HERE / "report.csv"), [], {}
    for run in runs:
        kind = "adhesive" if run.adhesive else "dry"
        rows += [{**row, "case": run.name} for row in report if row["case"] == kind]
        values.update({(run.name, key): value for key, value in values_of(run).items()})
    table(rows, values, {run.name: (f"t = {run.t[-1]:.0f}", run.log) for run in runs},
          folder / "compare.txt")


if __name__ == "__main__":
    main()
