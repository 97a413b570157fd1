#!/usr/bin/python3
"""Draws settling.png from what in.settling wrote: plot.py [DIR], DIR holds settling-*.txt (default .).

Needs Debian's python3-numpy and python3-matplotlib.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
start, hindered, slip = (np.loadtxt(folder / f"settling-{name}.txt").T
                         for name in ("start", "hindered", "slip"))
figure, (left, middle, right) = plt.subplots(1, 3, figsize=(10.5, 3.4), layout="constrained")
line, dots = {"color": "#0072B2"}, {"marker": "o", "ls": "", "mfc": "none", "color": "#D55E00"}

t = np.linspace(0, 5, 200)
left.plot(t, 1 - np.exp(-t), label=r"$1 - e^{-t/\tau}$", **line)
left.plot(start[0][::2], start[1][::2], label=r"steps of $\tau/20$", **dots)
left.set(title="10 um in air, from rest", xlabel=r"$t / \tau$", ylabel="velocity / terminal velocity")

c = np.linspace(0, 0.35, 100)
middle.plot(c, (1 - c) ** 3.7, label="$(1 - c)^{3.7}$", **line)
middle.plot(hindered[0], hindered[2], label="measured", **dots)
middle.set(title="hindered", xlabel="volume fraction $c$", ylabel="velocity / that of one alone")

d = np.geomspace(0.8e-7, 1.25e-5, 200)
alone = (1000 - 1.2) * d**2 * 9.81 / (18 * 1.81e-5)
knudsen = 2 * 6.6e-8 / d
cunningham = 1 + knudsen * (1.257 + 0.4 * np.exp(-1.1 / knudsen))
right.plot(1e6 * d, 1e6 * alone * cunningham, label="with Cunningham's slip", **line)
right.plot(1e6 * d, 1e6 * alone, "--", label="Stokes", **line)
right.plot(1e6 * slip[0], 1e6 * slip[1], label="measured", **dots)
right.set(title="fine dust in air", xscale="log", yscale="log", xlabel="diameter [um]",
          ylabel="terminal velocity [um/s]")
for axes in (left, middle, right):
    axes.grid(alpha=0.3)
    axes.legend(fontsize=8)
figure.savefig(folder / "settling.png", dpi=90)
