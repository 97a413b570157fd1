#!/usr/bin/python3
"""Writes two structured blocks with a linear flow, without VTK and without the CGNS library.

    write_blocks.py plot3d GRID SOLUTION ascii|binary|fortran
    write_blocks.py cgns FILE Vertex|CellCenter

PLOT3D: several blocks, in double precision; binary as C writes it, or with Fortran's record marks.
CGNS: the nodes of the SIDS in HDF5, https://cgns.github.io/CGNS_docs_current/hdf5/. Needs h5py.
The blocks are bent, 0 to 1 and 1 to 2 along x, and share the points where they meet.
"""
import struct
import sys

import h5py
import numpy as np

SHAPES = ((6, 5, 4), (4, 5, 4))    # points of the blocks along i, j, k
KINDS = {"i1": "C1", "i4": "I4", "f4": "R4", "f8": "R8"}    # CGNS's names of numpy's


def block(shape, shift):
    """Coordinates of a block's points, arrays [i, j, k]."""
    s = np.meshgrid(*(np.linspace(0.0, 1.0, n) for n in shape), indexing="ij")
    bend = 0.06 * np.sin(np.pi * s[0])
    return (s[0] + shift + 0.3 * bend * np.sin(2 * np.pi * s[1]),
            s[1] + bend * np.sin(np.pi * s[1]) * np.cos(np.pi * s[2]),
            s[2] + bend * np.sin(np.pi * s[2]) * np.cos(np.pi * s[1]))


def velocity(x):
    """As velocity() of test_program.cpp."""
    return 1.0 + x[1], 0.5 * x[2] - x[0], np.full_like(x[0], 0.25)


def pressure(x):
    """As pressure() of test_program.cpp."""
    return 3.0 - x[0] + 2.0 * x[1]


class Plot3d:
    """A file of PLOT3D: records of numbers of one kind."""

    def __init__(self, path, how):
        self.file, self.how = open(path, "wb"), how

    def record(self, kind, numbers):
        """kind: i or d, as in module struct."""
        if self.how == "ascii":
            text = " ".join(str(n) if kind == "i" else f"{n:.17g}" for n in numbers)
            self.file.write(text.encode() + b"\n")
            return
        data = struct.pack(f"<{len(numbers)}{kind}", *numbers)
        mark = struct.pack("<i", len(data)) if self.how == "fortran" else b""
        self.file.write(mark + data + mark)


def flat(arrays):
    """One after the other, i fastest."""
    return np.concatenate([np.ravel(a, order="F") for a in arrays])


def write_plot3d(grid, solution, how):
    """Density 1 + x, so that velocity is not momentum; gamma = 1.4."""
    blocks = [block(shape, b) for b, shape in enumerate(SHAPES)]
    xyz, q = Plot3d(grid, how), Plot3d(solution, how)
    for file in (xyz, q):
        file.record("i", [len(blocks)])
        file.record("i", np.ravel(SHAPES).tolist())
    for x in blocks:
        density, u = 1.0 + x[0], velocity(x)
        energy = pressure(x) / 0.4 + 0.5 * density * sum(c * c for c in u)
        xyz.record("d", flat(x))
        q.record("d", [0.5, 0.0, 100.0, 0.0])    # Mach number, angle, Reynolds number, time
        q.record("d", flat((density, *(density * c for c in u), energy)))


def node(parent, name, label, data=None):
    """A node of CGNS."""
    kind = "MT" if data is None else KINDS[data.dtype.str[1:]]
    group = parent.create_group(name, track_order=True)
    for key, word, size in (("name", name, 33), ("label", label, 33), ("type", kind, 3)):
        group.attrs.create(key, np.array(word.encode(), dtype=f"S{size}"))
    group.attrs.create("flags", np.array([1], dtype=np.int32))
    if data is not None:
        group.create_dataset(" data", data=data)
    return group


def text(words):
    """Characters, as CGNS has them."""
    return np.frombuffer(words.encode(), dtype=np.int8)


def write_cgns(path, location):
    """One base of two zones."""
    with h5py.File(path, "w", track_order=True) as file:
        for key, word, size in (("name", "HDF5 MotherNode", 33),
                                ("label", "Root Node of HDF5 File", 33), ("type", "MT", 3)):
            file.attrs.create(key, np.array(word.encode(), dtype=f"S{size}"))
        file.create_dataset(" format", data=text("IEEE_LITTLE_32\0"))
        file.create_dataset(" hdf5version", data=text(h5py.version.hdf5_version.ljust(33, "\0")))
        node(file, "CGNSLibraryVersion", "CGNSLibraryVersion_t", np.array([3.4], np.float32))
        base = node(file, "Base", "CGNSBase_t", np.array([3, 3], np.int32))
        for b, shape in enumerate(SHAPES):
            sizes = np.array([shape, np.array(shape) - 1, (0, 0, 0)], np.int32)
            zone = node(base, f"Zone{b + 1}", "Zone_t", sizes)
            node(zone, "ZoneType", "ZoneType_t", text("Structured"))
            x = block(shape, b)
            places = node(zone, "GridCoordinates", "GridCoordinates_t")
            for name, values in zip("XYZ", x):
                node(places, f"Coordinate{name}", "DataArray_t", values.T.copy())
            if location == "CellCenter":
                x = [sum(a[i:a.shape[0] - 1 + i, j:a.shape[1] - 1 + j, k:a.shape[2] - 1 + k]
                         for i in (0, 1) for j in (0, 1) for k in (0, 1)) / 8 for a in x]
            flow = node(zone, "Solution", "FlowSolution_t")
            node(flow, "GridLocation", "GridLocation_t", text(location))
            for name, values in zip(("VelocityX", "VelocityY", "VelocityZ", "Pressure"),
                                    (*velocity(x), pressure(x))):
                node(flow, name, "DataArray_t", values.T.copy())


if __name__ == "__main__":
    {"plot3d": write_plot3d, "cgns": write_cgns}[sys.argv[1]](*sys.argv[2:])
