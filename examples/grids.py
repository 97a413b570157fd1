"""Flows and distances to walls on grids, for plot.py of the examples: what flowgrid wrote.

Needs Debian's python3-h5py and python3-numpy.
"""
import sys

import numpy as np
from report import stop

try:
    import h5py
except ImportError:
    h5py = None


class Grid:
    """Nodes x, y, z [m] of a file, and its arrays by name, [iz, iy, ix]."""

    def __init__(self, path, names):
        """Reads these arrays; ends the program if there is none of the name."""
        with h5py.File(path) as file:
            group = file["VTKHDF"]
            extent = group.attrs["WholeExtent"].reshape(3, 2)
            self.x, self.y, self.z = (
                origin + spacing * np.arange(last - first + 1) for origin, spacing, (first, last)
                in zip(group.attrs["Origin"], group.attrs["Spacing"], extent))
            missing = [name for name in names if name not in group["PointData"]]
            if missing:
                stop(path, f"has no array {missing[0]}; it has {' '.join(group['PointData'])}")
            self.arrays = {name: group["PointData"][name][()] for name in names}

    def __getitem__(self, name):
        return self.arrays[name]

    def fluid(self, values):
        """Values with nan inside walls."""
        return np.where(self["inside"] > 0, values, np.nan)


def read_grid(file, names, *folders):
    """The grid in the first of the folders that has the file; else None, and a line that tells so."""
    path = next((folder / file for folder in folders if (folder / file).is_file()), None)
    if path and h5py:
        return Grid(path, names)
    reason = "python3-h5py is missing" if path else f"not in {' or '.join(map(str, folders))}"
    print(f"{file}: {reason}; no figure of it", file=sys.stderr)
    return None
