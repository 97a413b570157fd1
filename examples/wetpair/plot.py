#!/usr/bin/python3
"""Force of a liquid bridge over the gap: the two laws of in.wetpair beside exact profiles (exact.csv).

plot.py [FOLDER]: where in.wetpair wrote wetpair-*.txt; writes wetpair.png there.
"""

import csv
import pathlib
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

folder = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")
with open(pathlib.Path(__file__).parent / "exact.csv") as file:
    rows = [[float(word) for word in row] for row in list(csv.reader(file))[1:]]
end = max(range(len(rows)), key=lambda n: rows[n][0])
figure, axes = plt.subplots(figsize=(6, 4))
axes.plot(*zip(*rows[: end + 1]), "k", label="exact (Young-Laplace)")
axes.plot(*zip(*rows[end:]), "k:", label="exact, unstable")
for law in ("maugis", "willett"):
    with open(folder / f"wetpair-{law}.txt") as file:
        curve = [[float(word) for word in line.split()] for line in file if not line.startswith("#")]
    axes.plot(*zip(*curve), "--", label=law)
axes.set(xlabel="gap / r", ylabel="force / (2 pi r sigma)", xlim=(0, 0.2), ylim=(0, 1))
axes.legend()
figure.tight_layout()
figure.savefig(folder / "wetpair.png", dpi=120)
