#!/usr/bin/env python3
"""First inputs of the fuzzers that take words, or several files in one, and the way back.

    seeds.py DATA BUILD             DATA: tools/flowgrid/test; writes into BUILD/foam and so on,
                                    after seeds_vtk
    seeds.py --apart ENDING FILE FOLDER    puts the files of an input into FOLDER, as fuzz_mesh.cpp does
"""
import gzip
import os
import re
import subprocess
import sys

blocks = ("input.vtm", "input/input_0.vts", "input/input_1.vti")
case = ("system/controlDict", "constant/polyMesh/boundary", "constant/polyMesh/points", "constant/polyMesh/faces",
        "constant/polyMesh/owner", "constant/polyMesh/neighbour", "4/U", "4/p")
shapes = ("a: box(-1,-1,-1, 1,1,1)", "b: difference(box(0,0,0, 9,2,1), cylinder(4,2,0, 4,2,1, 0.5))",
          "c: inside(sphere(0,0,0, 1.5))", "d: polygon(0,0, 1,0, 1,1, 0.5,0.3)", "e: plane(0,0,0, 0,1,1)",
          "f: extrude(-1,1, union(rectangle(0,0, 1,1), disc(1,0, 0.5)))",
          "g: intersection(box(-1,-1,-1, 1,1,1), sphere(0.5,0,0, 1))")


def together(parts):
    return b"\n".join(b"//// " + name.encode() + b"\n" + text for name, text in parts)


def apart(ending, path, folder):
    with open(path, "rb") as file:
        data = file.read()
    parts = {"input." + ending: data}
    if ending in ("foam", "xyz", "vtm"):
        pieces = re.split(rb"(?:^|\n)//// ([^\n]*)\n", data)
        parts = {name.decode(errors="replace"): text for name, text in zip(pieces[1::2], pieces[2::2])}
    known = case + blocks + ("input.foam", "input.xyz", "input.q")
    for name, text in parts.items():
        if name not in known and name != "input." + ending:
            continue
        os.makedirs(os.path.dirname(f"{folder}/{name}") or ".", exist_ok=True)
        with open(f"{folder}/{name}", "wb") as file:
            file.write(text)
    if ending == "foam" and not os.path.exists(folder + "/input.foam"):
        open(folder + "/input.foam", "w").close()


def contents(path):
    if os.path.exists(path):
        with open(path, "rb") as file:
            return file.read()
    with gzip.open(path + ".gz") as file:
        return file.read()


def write(path, data):
    with open(path, "wb") as file:
        file.write(data)


def main(data, build):
    for k, shape in enumerate(shapes):
        write(f"{build}/shape/{k}", shape.encode())
    for name in ("poiseuille", "binary"):
        write(f"{build}/foam/{name}",
              together([("input.foam", b"")] + [(f, contents(f"{data}/data/{name}/{f}")) for f in case]))
    write(f"{build}/vtkhdf_parts/right", bytes(300))
    if os.path.exists(build + "/blocks"):    # where VTK is
        write(f"{build}/vtm/blocks", together([(f, contents(f"{build}/blocks/{f}")) for f in blocks]))
    maker = data + "/write_blocks.py"
    grid, solution = build + "/grid", build + "/solution"
    for kind in ("ascii", "binary", "fortran"):
        subprocess.run(["/usr/bin/python3", maker, "plot3d", grid, solution, kind], check=True)
        write(f"{build}/xyz/{kind}", together([("input.xyz", contents(grid)), ("input.q", contents(solution))]))
        if kind == "ascii":
            write(f"{build}/plot3d/blocks", contents(grid))
    write(build + "/plot3d/planar", b"2 3\n0 1 0 1 0 1\n0 0 1 1 2 2\n")
    write(build + "/plot3d/marks", b"1\n2 1 1\n0 1\n0 0\n0 0\n1 0\n")
    for where in ("Vertex", "CellCenter"):
        subprocess.run(["/usr/bin/python3", maker, "cgns", f"{build}/cgns/{where}", where], check=True)


if sys.argv[1] == "--apart":
    apart(*sys.argv[2:])
else:
    main(*sys.argv[1:])
