#!/usr/bin/python3
"""What walls from a file cost, beside planes and cylinders in closed form.

    walls.py [--quick] [--rounds N] [--steps N] [--lmp FILE] [--results DIR]

Prints, and writes to results/walls.txt, the time per particle and step of a wall in space: of
particles in contact, of those that come near, and of those that are far. README.md says more.
Needs Debian's python3-numpy and python3-h5py.
"""
import re
import sys
import tempfile
from pathlib import Path

import h5py
import numpy as np

from lammps_runs import (HERE, Failure, parse_rounds, processor, rounds_parser, run_lammps,
                         stop)

AROUND, ALONG, R = 33, 99, 19.0    # spheres of diameter 1; radius of the cylinder
LAW = "jkr 1e6 0.25 10 damping tsuji 0.3 sliding 0.3 rolling 0.01"
STATES = {"touching": -0.0029, "near": 0.02, "far": 8.0}    # gap between sphere and wall
WALLS = {
    "plane": "plane",
    "cylinder": "cylinder",
    "grid_plane": "file, a plane",
    "grid_cylinder": "file, the cylinder",
    "grid_bent": "file, the cylinder with waves",
}


def write_walls(folder):
    """Distances on 161 x 161 x 31 nodes: to a plane, a cylinder, and one with flat waves."""
    across, along = np.linspace(-20, 20, 161), np.linspace(0, 120, 31)
    _, y, x = np.meshgrid(along, across, across, indexing="ij")
    rho, angle = np.hypot(x, y), np.arctan2(y, x)
    # waves whose curvature is not the same everywhere; to first order in their height
    waves = 0.003 * np.cos(6 * angle) * rho / R
    walls = {"plane": y + R, "cylinder": R - rho, "bent": R - rho + waves}
    for name, distance in walls.items():
        with h5py.File(folder / f"{name}.vtkhdf", "w") as file:
            grid = file.create_group("VTKHDF")
            grid.attrs["Version"], grid.attrs["Type"] = (2, 0), np.bytes_("ImageData")
            grid.attrs["WholeExtent"] = (0, 160, 0, 160, 0, 30)
            grid.attrs["Origin"], grid.attrs["Spacing"] = (-20.0, -20.0, 0.0), (0.25, 0.25, 4.0)
            grid.create_group("PointData")["distance"] = distance


def write_spheres(folder):
    """Rows along the plane and along an arc of the cylinder, at each gap."""
    n = np.arange(AROUND * ALONG)
    s, z = 1.1 * (n % AROUND - AROUND // 2), 1.1 * (n // AROUND) + 0.6
    for state, gap in STATES.items():
        rho = R - 0.5 - gap
        places = {"plane": (s, -rho + 0 * s),
                  "arc": (rho * np.sin(s / R), -rho * np.cos(s / R))}
        for name, (x, y) in places.items():
            rows = "\n".join(f"{i + 1} 1 1.0 1.0 {a:.15g} {b:.15g} {c:.15g}"
                             for i, (a, b, c) in enumerate(zip(x, y, z)))
            (folder / f"{name}.{state}").write_text(
                f"spheres\n\n{len(n)} atoms\n1 atom types\n\n-20 20 xlo xhi\n-20 20 ylo yhi\n"
                f"0 120 zlo zhi\n\nAtoms # sphere\n\n{rows}\n")


def measure(args, folder):
    """Times per particle and step [ns] of each round by (wall, state), less those without."""
    write_walls(folder)
    write_spheres(folder)
    variables = {"rounds": args.rounds, "steps": args.steps, "law": LAW}
    text = run_lammps(args.lmp, HERE / "in.walls", variables, folder)
    found = {}
    for wall, state, modify in re.findall(r"^CASE (\w+) (\w+)\n.*?^Modify +\| (\S+)", text,
                                          re.M | re.S):
        found.setdefault((wall, state), []).append(
            1e9 * float(modify) / (AROUND * ALONG * args.steps))
    return {key: np.array(t) - np.array(found["none", key[1]])
            for key, t in found.items() if key[0] != "none"}


def table(times, args):
    """The result as lines."""
    lines = [f"{processor()}, one core; {AROUND * ALONG} spheres at rest, in space",
             f"median of {args.rounds} rounds of {args.steps} steps, smallest .. largest; time per "
             "particle and step in ns,",
             "of LAMMPS's breakdown (Modify) less that of the same round without a wall;",
             "ratio: of the medians, to the plane or cylinder in closed form", "",
             f"{'wall':40}" + "".join(f"{state:>32}" for state in STATES)]
    for wall, words in WALLS.items():
        beside = "plane" if "plane" in wall else "cylinder"
        cells = []
        for state in STATES:
            t = times[wall, state]
            ratio = np.median(t) / np.median(times[beside, state])
            cells.append(f"{np.median(t):7.1f}  {t.min():6.1f} .. {t.max():6.1f} {ratio:6.2f}")
        lines.append(f"{words:40}" + "".join(f"{cell:>32}" for cell in cells))
    return lines


def main():
    """Parses the command line, measures and writes."""
    args = parse_rounds(rounds_parser("Measures what walls cost.", rounds=5, steps=200))
    with tempfile.TemporaryDirectory() as scratch:
        try:
            times = measure(args, Path(scratch).resolve())
        except Failure as failure:
            stop(failure)
    text = "\n".join(table(times, args)) + "\n"
    print(text, end="")
    (args.results / "walls.txt").write_text(text)


if __name__ == "__main__":
    main()
