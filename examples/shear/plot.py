#!/usr/bin/python3
"""Draws drift.png from what in.shear wrote: plot.py [DIR], DIR holds shear.txt (default .).

Needs Debian's python3-numpy and python3-matplotlib.
"""
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
rate, saffman, _, magnus, _ = np.loadtxt(folder / "shear.txt").T
x = np.geomspace(0.6 * abs(rate).min(), 1.6 * abs(rate).max(), 100)

figure, axes = plt.subplots(figsize=(5.6, 4.2), layout="constrained")
axes.plot(x, 0.17136 * np.sqrt(x), "-", color="#0072B2",
          label=r"Saffman, $0.17136\,(|G| d^2/\nu)^{1/2}$")
axes.plot(x, x / 24, "-", color="#E69F00", label=r"Magnus, $\Omega d^2 / 24 \nu$")
for sign, marker, size in ((1, "o", 9), (-1, "x", 6)):
    mine = np.sign(rate) == sign
    word = ">" if sign > 0 else "<"
    axes.plot(sign * rate[mine], -sign * saffman[mine], marker, ms=size, mfc="none", color="#0072B2",
              label=f"measured, $G {word} 0$: towards {'-y' if sign > 0 else '+y'}")
    axes.plot(sign * rate[mine], sign * magnus[mine], marker, ms=size, mfc="none", color="#E69F00",
              label=rf"measured, $\Omega {word} 0$: towards {'+y' if sign > 0 else '-y'}")
axes.set(xscale="log", yscale="log", ylabel="drift across the stream / slip",
         xlabel=r"$|G|\,d^2/\nu$ of shear, $|\Omega|\,d^2/\nu$ of spin")
axes.grid(alpha=0.3)
axes.legend(fontsize=8)
figure.savefig(folder / "drift.png", dpi=100)
