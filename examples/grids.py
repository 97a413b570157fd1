"""Flows and distances to walls on grids, for plot.py of the examples: what flowgrid wrote.

Needs Debian's python3-h5py and python3-numpy.
"""
import h5py
import numpy as np
from report import stop


class Grid:
    """Nodes x, y, z [m] of a file, and its arrays by name, [iz, iy, ix]; every `stride`-th node along each axis."""

    def __init__(self, path, names, stride=1):
        """Reads these arrays; ends the program if there is none of the name."""
        with h5py.File(path) as file:
            group = file["VTKHDF"]
            extent = group.attrs["WholeExtent"].reshape(3, 2)
            self.x, self.y, self.z = (
                (origin + spacing * np.arange(last - first + 1))[::stride] for origin, spacing, (first, last)
                in zip(group.attrs["Origin"], group.attrs["Spacing"], extent))
            missing = [name for name in names if name not in group["PointData"]]
            if missing:
                stop(path, f"has no array {missing[0]}; it has {' '.join(group['PointData'])}")
            self.arrays = {name: group["PointData"][name][::stride, ::stride, ::stride] for name in names}

    def __getitem__(self, name):
        return self.arrays[name]

    def fluid(self, values):
        """Values with nan inside walls."""
        return np.where(self["inside"] > 0, values, np.nan)


def find(name, *folders):
    """The file in the first of the folders that has it; None if none has."""
    return next((folder / name for folder in folders if (folder / name).is_file()), None)
