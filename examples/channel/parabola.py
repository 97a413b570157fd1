#!/usr/bin/python3
"""Writes the air of the channel as a gridded flow: parabola.py FILE [cells across the channel].

The grid is 2-D and half a cell wider than the channel on either side, so that no node lies on a wall.
Nodes outside get no velocity; the distance to the walls says where they are. Opens in ParaView.
"""
import sys

import h5py
import numpy as np

L, U = 1e-3, 0.5                                   # width, largest velocity, as in in.channel
n = int(sys.argv[2]) if len(sys.argv) > 2 else 40
h = L / n
y = (np.arange(n + 2) - 0.5) * h - L / 2
x = np.arange(11) * L / 2                          # periodic: the last layer is the first one
distance = np.broadcast_to(L / 2 - abs(y)[:, None], (y.size, x.size))
velocity = np.zeros((y.size, x.size, 3))
velocity[..., 0] = np.where(distance > 0, U * (1 - 4 * (y[:, None] / L) ** 2), 0)

with h5py.File(sys.argv[1], "w") as file:
    grid = file.create_group("VTKHDF")
    grid.attrs["Version"] = (2, 0)
    grid.attrs["Type"] = np.bytes_("ImageData")
    grid.attrs["WholeExtent"] = (0, x.size - 1, 0, y.size - 1, 0, 0)
    grid.attrs["Origin"] = (x[0], y[0], 0.0)
    grid.attrs["Spacing"] = (L / 2, h, h)
    grid.attrs["Direction"] = np.eye(3).ravel()
    points = grid.create_group("PointData")
    points["velocity"], points["distance"] = velocity, distance
