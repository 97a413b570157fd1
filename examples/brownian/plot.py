#!/usr/bin/python3
"""Draws msd.png from what in.brownian wrote: plot.py [DIR], DIR holds msd-*.txt (default .).

Needs Debian's python3-numpy and python3-matplotlib.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
figure, (top, bottom) = plt.subplots(2, 1, figsize=(6, 5.6), height_ratios=(2, 1), sharex=True,
                                     layout="constrained")
t = np.geomspace(0.05, 1e5, 300)
top.plot(t, t + np.expm1(-t), color="0.3", label=r"$6D\,(t - \tau (1 - e^{-t/\tau}))$")
top.plot(t, t, ":", color="0.3", label=r"$6 D t$")
for step, colour, marker in (("0.01", "#0072B2", "o"), ("1", "#E69F00", "s"), ("100", "#D55E00", "^")):
    time, measured, exact = np.loadtxt(folder / f"msd-{step}.txt")[1:].T
    some = np.unique(np.geomspace(1, len(time), 14).astype(int)) - 1
    top.plot(time[some], measured[some], marker, mfc="none", color=colour,
             label=rf"steps of {step} $\tau$")
    bottom.plot(time, measured / exact, color=colour)
bottom.axhline(1, color="0.3", lw=0.8)
top.set(xscale="log", yscale="log", ylabel=r"$\langle r^2 \rangle / 6 D \tau$")
bottom.set(xlabel=r"$t / \tau$", ylabel="measured / exact", ylim=(0.9, 1.1))
for axes in (top, bottom):
    axes.grid(alpha=0.3)
top.legend(fontsize=8)
figure.savefig(folder / "msd.png", dpi=100)
