#!/usr/bin/python3
"""Adds the exact distance to the fiber, radius 1e-5 around z, to a file of flowgrid:  distance.py FILE"""
import sys

import h5py
import numpy as np

with h5py.File(sys.argv[1], "r+") as file:
    grid = file["VTKHDF"]
    shape = grid["PointData/velocity"].shape[:3]
    x, y = (grid.attrs["Origin"][k] + grid.attrs["Spacing"][k] * np.arange(shape[2 - k]) for k in (0, 1))
    r = np.hypot(x, y[:, None])
    grid["PointData"].create_dataset("distance", data=np.broadcast_to(r - 1e-5, shape), compression="gzip")
