#!/usr/bin/python3
"""Draws the air behind the step and the particles of in.step:  plot.py [DIR]"""
import sys

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

where = sys.argv[1] if len(sys.argv) > 1 else "."
with h5py.File(f"{where}/step.vtkhdf") as file:
    group = file["VTKHDF"]
    u = group["PointData/velocity"][0]
    inside = group["PointData/inside"][0]
    origin, spacing = group.attrs["Origin"], group.attrs["Spacing"]
x = (origin[0] + spacing[0] * np.arange(u.shape[1])) * 1e3
y = (origin[1] + spacing[1] * np.arange(u.shape[0])) * 1e3
lines = open(f"{where}/step.particles").read().split("ITEM: ATOMS")[-1].splitlines()[1:]
particles = np.array([line.split() for line in lines], dtype=float).reshape(-1, 6)

figure, axes = plt.subplots(figsize=(10, 2.6), constrained_layout=True)
speed = np.ma.masked_where(inside == 0, u[..., 0])
image = axes.pcolormesh(x, y, speed, cmap="viridis", shading="nearest")
axes.contour(x, y, np.where(inside > 0, u[..., 0], np.nan), levels=[-1e-3], colors="white",
             linewidths=0.8)
axes.plot(particles[:, 1] * 1e3, particles[:, 2] * 1e3, "o", color="#D55E00", markersize=1.5)
axes.set_aspect("equal")
axes.set_xlabel("x [mm]")
axes.set_ylabel("y [mm]")
axes.set_facecolor("0.85")
figure.colorbar(image, label="velocity of the air along x [m/s]")
axes.set_title("white: where the air turns back; dots: particles of 10 um")
figure.savefig(f"{where}/step.png", dpi=110)
