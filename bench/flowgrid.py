#!/usr/bin/python3
"""How long flowgrid takes for a million nodes from a mesh of 1e5 distorted hexahedra, and its memory.

    flowgrid.py [--quick] [--rounds N] [--flowgrid FILE] [--results DIR]

Prints, and writes to results/flowgrid.txt, the times of its stages: for a file of VTK with values at
points, for an OpenFOAM case with values in cells, and for each further time of that case. README.md
says more. Needs Debian's python3-numpy.
"""
import argparse
import os
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

from lammps_runs import HERE, Failure, count, keep_table, parse, processor, results_option, stop

CELLS = (50, 50, 40)                # along x, y, z
NODES = (100, 100, 100)
LENGTHS = (1.0, 1.0, 0.8)
SERIES = 9                          # times of the longer series
STAGES = ("reading", "mapping", "writing", "whole")


def mesh_points():
    """Corners of the bent bricks, x fastest: the box stays one, cells are up to a third out of shape."""
    along = [np.linspace(0.0, length, n + 1) for n, length in zip(CELLS, LENGTHS)]
    z, y, x = np.meshgrid(*along[::-1], indexing="ij")
    wave = [np.sin(np.pi * s / length) for s, length in zip((x, y, z), LENGTHS)]
    bent = 0.06 * wave[0] * wave[1] * wave[2]
    return np.stack((x + bent * np.cos(9 * y), y + bent * np.sin(11 * z), z + bent * np.cos(8 * x)),
                    axis=-1).reshape(-1, 3)


def mesh_cells():
    """Points of each cell in VTK's order."""
    nx, ny, nz = CELLS
    k, j, i = (a.ravel() for a in np.meshgrid(*(np.arange(n) for n in (nz, ny, nx)), indexing="ij"))
    steps = ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1))
    return np.stack([i + a + (nx + 1) * (j + b + (ny + 1) * (k + c)) for a, b, c in steps], axis=1)


def velocity(x):
    """At rest on the faces y = 0 and y = 1, as a channel."""
    return np.stack((np.sin(np.pi * x[:, 1]), 0.1 * np.sin(np.pi * x[:, 1]) * x[:, 0],
                     0.2 * np.sin(np.pi * x[:, 1]) * np.cos(x[:, 2])), axis=1)


def write_vtk(path):
    """The mesh as an unstructured one, in the legacy format."""
    points, cells = mesh_points(), mesh_cells()
    with open(path, "wb") as file:
        def block(head, numbers, kind):
            file.write(head.encode() + b"\n" + numbers.astype(kind).tobytes() + b"\n")
        file.write(b"# vtk DataFile Version 3.0\nmesh\nBINARY\nDATASET UNSTRUCTURED_GRID\n")
        block(f"POINTS {len(points)} double", points, ">f8")
        block(f"CELLS {len(cells)} {9 * len(cells)}",
              np.column_stack((np.full(len(cells), 8), cells)), ">i4")
        block(f"CELL_TYPES {len(cells)}", np.full(len(cells), 12), ">i4")
        block(f"POINT_DATA {len(points)}\nVECTORS U double", velocity(points), ">f8")


def foam(path, kind, name, body):
    """A file of OpenFOAM."""
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text("FoamFile { version 2.0; format ascii; class " + kind + "; object " + name
                    + "; }\n" + body)


def rows(table, form):
    """A list of OpenFOAM."""
    return f"{len(table)}\n(\n" + "\n".join(form % tuple(row) for row in table) + "\n)\n"


def foam_faces():
    """Corners, owners and neighbours (-1: none) of all faces, those within in the order of owners."""
    cells, number = mesh_cells(), np.arange(np.prod(CELLS))
    index = np.stack((number % CELLS[0], number // CELLS[0] % CELLS[1],
                      number // (CELLS[0] * CELLS[1])))
    step = (1, CELLS[0], CELLS[0] * CELLS[1])
    upper = ((1, 2, 6, 5), (3, 7, 6, 2), (4, 5, 6, 7))    # outward corners of the faces +x, +y, +z
    lower = ((0, 4, 7, 3), (0, 1, 5, 4), (0, 3, 2, 1))
    within, border = [], []
    for axis in range(3):
        last = index[axis] == CELLS[axis] - 1
        within.append((cells[~last][:, upper[axis]], number[~last], number[~last] + step[axis]))
        first = index[axis] == 0
        border += [(cells[first][:, lower[axis]], number[first]),
                   (cells[last][:, upper[axis]], number[last])]
    corners, owner, neighbour = (np.concatenate(a) for a in zip(*within))
    order = np.lexsort((neighbour, owner))
    return corners[order], owner[order], neighbour[order], border


def write_case(folder):
    """The mesh and its velocity at the centres of cells as a case with SERIES times."""
    corners, owner, neighbour, border = foam_faces()
    mesh = folder / "constant/polyMesh"
    foam(folder / "system/controlDict", "dictionary", "controlDict", "application icoFoam;\n")
    points = mesh_points()
    foam(mesh / "points", "vectorField", "points", rows(points, "(%.9g %.9g %.9g)"))
    foam(mesh / "faces", "faceList", "faces",
         rows(np.concatenate([corners] + [f for f, _ in border]), "4(%d %d %d %d)"))
    foam(mesh / "owner", "labelList", "owner",
         rows(np.concatenate([owner] + [o for _, o in border])[:, None], "%d"))
    foam(mesh / "neighbour", "labelList", "neighbour", rows(neighbour[:, None], "%d"))
    names = ("inlet", "outlet", "below", "above", "left", "right")
    start, patches, values = len(neighbour), "", ""
    for name, (faces, _) in zip(names, border):
        wall = name in ("below", "above")
        patches += (f"{name} {{ type {'wall' if wall else 'patch'}; nFaces {len(faces)}; "
                    f"startFace {start}; }}\n")
        values += f"{name} {{ type {'noSlip' if wall else 'zeroGradient'}; }}\n"
        start += len(faces)
    foam(mesh / "boundary", "polyBoundaryMesh", "boundary", f"6\n(\n{patches})\n")
    u = velocity(points[mesh_cells()].mean(axis=1))
    for n in range(1, SERIES + 1):
        foam(folder / str(n) / "U", "volVectorField", "U",
             "dimensions [0 1 -1 0 0 0 0];\ninternalField nonuniform List<vector>\n"
             + rows(u * (1 + 0.1 * n), "(%.9g %.9g %.9g)") + ";\nboundaryField\n{\n" + values + "}\n")


def run(program, words, out):
    """Times of the stages [s], and the largest memory [MB]."""
    spacing = [str(length / (n - 1)) for length, n in zip(LENGTHS, NODES)]
    begin = time.perf_counter()
    with subprocess.Popen([program, *words, out, "--spacing", *spacing], stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, text=True) as process:
        text = process.stdout.read()
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
    whole = time.perf_counter() - begin
    found = [re.search(stage + r" in ([\d.]+) s", text) for stage in ("read", "mapped", "written")]
    if process.returncode or not all(found):
        raise Failure(f"exit code {process.returncode}: {text[-300:]}")
    if f"{NODES[0]} x {NODES[1]} x {NODES[2]} nodes, {np.prod(NODES)} inside" not in text:
        raise Failure(f"not all nodes are inside: {text[-600:]}")
    return np.array([float(f[1]) for f in found] + [whole]), usage.ru_maxrss / 1024


def measure(args, folder):
    """Times (rounds x stages) and memory by what is read; the mean of a further time of the case."""
    write_vtk(folder / "mesh.vtk")
    write_case(folder / "case")
    inputs = {"file of VTK, values at points": [str(folder / "mesh.vtk")],
              "OpenFOAM case, values in cells": [str(folder / "case")],
              f"the case, {SERIES} times": [str(folder / "case"), "--times", "all"]}
    times, memory = {name: [] for name in inputs}, {}
    for _ in range(args.rounds):
        for name, words in inputs.items():
            seconds, memory[name] = run(args.flowgrid, words, folder / "out.vtkhdf")
            times[name].append(seconds)
    times = {name: np.array(t) for name, t in times.items()}
    one, all_of_them = list(inputs)[1:]
    further = (times[all_of_them] - times[one]) / (SERIES - 1)
    times["each further time of the case"] = further.round(2) + 0.0    # no -0.00
    return times, memory


def table(times, memory, args):
    """The result as lines."""
    lines = [f"{processor()}, one core; mesh of {CELLS[0]} x {CELLS[1]} x {CELLS[2]} = "
             f"{np.prod(CELLS)} distorted hexahedra,",
             f"grid of {NODES[0]} x {NODES[1]} x {NODES[2]} = {np.prod(NODES)} nodes; median of "
             f"{args.rounds} runs, smallest .. largest; time in s,",
             "peak memory in MB; `writing` includes reading the field and, in cells, the fit to points",
             "", f"{'':32}" + "".join(f"{stage:>22}" for stage in STAGES) + "    memory"]
    for name, rounds in times.items():
        cells = "".join(f"{np.median(t):8.2f}  {t.min():4.2f} .. {t.max():4.2f}" for t in rounds.T)
        lines.append(f"{name:32}{cells}" + (f"{memory[name]:10.0f}" if name in memory else ""))
    return lines


def main():
    """Parses the command line, measures and writes."""
    parser = argparse.ArgumentParser(description="Measures flowgrid.")
    parser.add_argument("--quick", action="store_true", help="two rounds")
    parser.add_argument("--rounds", type=count, default=5, help="runs of each case (default 5)")
    parser.add_argument("--flowgrid", default=HERE.parent / "flowgrid",
                        help="the program (default ../flowgrid)")
    results_option(parser)
    args = parse(parser)
    if args.quick:
        args.rounds = 2
    with tempfile.TemporaryDirectory() as scratch:
        try:
            times, memory = measure(args, Path(scratch))
        except Failure as failure:
            stop(failure)
    text = "\n".join(table(times, memory, args)) + "\n"
    keep_table(text, args.results, "flowgrid")


if __name__ == "__main__":
    main()
