"""Scenes of two spheres, or of a sphere and a wall, for LIGGGHTS and LAMMPS, and the exact contact law.

Units are dimensionless. Spheres have diameter 1 and density 1.
"""
import math
import os
import re
import subprocess
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np


@dataclass(frozen=True)
class JKR:
    """Exact law of one contact, IIHR Report 459, eqs (38)-(41), by bisection."""

    R: float        # effective radius
    E: float        # effective modulus
    gamma: float    # surface energy per surface

    @property
    def a0(self):
        return (9 * math.pi * self.gamma * self.R**2 / self.E) ** (1 / 3)

    @property
    def F_C(self):
        return 3 * math.pi * self.gamma * self.R

    @property
    def delta_C(self):
        return self.a0**2 / (2 * 6 ** (1 / 3) * self.R)

    def radius(self, overlap):
        """Contact radius over a0 on the stable branch."""
        low, high = 6.0 ** (-2 / 3), 100.0
        for _ in range(200):
            h = 0.5 * (low + high)
            at_h = 6 ** (1 / 3) * (2 * h**2 - 4 / 3 * math.sqrt(h)) * self.delta_C
            low, high = (h, high) if at_h < overlap else (low, h)
        return h

    def force(self, overlap):
        """Elastic force, > 0 repels."""
        h = self.radius(overlap)
        return 4 * self.F_C * (h**3 - h**1.5)

    def overlap_at(self, force):
        """Overlap at a force between -F_C and 0 on the branch that is stable under load."""
        low, high = -(9 ** (-1 / 3)) * self.delta_C, 2 * self.delta_C
        for _ in range(200):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.force(middle) < force else (low, middle)
        return middle


REST = (0.0, 0.0, 0.0)
DIALECT = {    # velocities of ghosts; spin of spheres
    "LIGGGHTS": ("communicate single vel yes", "omegax {:.17g} omegay {:.17g} omegaz {:.17g}"),
    "LAMMPS": ("comm_modify vel yes", "omega {:.17g} {:.17g} {:.17g}"),
}


def scene(dialect, spheres, laws, boundary="p p p"):
    """Head of a script: spheres, each of (position, velocity, spin), and the commands of their laws."""
    ghosts, spin = DIALECT[dialect]
    lines = [
        "units lj", "atom_style sphere", "atom_modify map array sort 0 0", ghosts, "newton off",
        f"boundary {boundary}",
        "region box block 0 8 0 8 0 8 units box", "create_box 1 box",
        "neighbor 0.1 bin", "neigh_modify delay 0 every 1 check no", laws,
    ]
    for n, (x, _, _) in enumerate(spheres, 1):
        lines += ["create_atoms 1 single {:.17g} {:.17g} {:.17g} units box".format(*x),
                  f"group g{n} id {n}"]
    lines += ["set group all diameter 1 density 1"]
    for n, (_, v, w) in enumerate(spheres, 1):
        lines += ["velocity g{} set {:.17g} {:.17g} {:.17g} units box".format(n, *v),
                  f"set group g{n} " + spin.format(*w)]
    return "\n".join(lines) + "\n"


def run(program, script, ranks=1):
    """Runs a script; returns the output, and the rows of its thermo tables."""
    env = dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
               OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "in.scene"
        path.write_text(script)
        command = [program, "-in", path, "-log", "none"]
        if ranks > 1:
            command = ["mpirun", "-np", str(ranks), *command]
        done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True,
                              errors="replace")
    number = r"[-+]?\d+\.?\d*(?:[eE][-+]?\d+)?"
    rows = [[float(word) for word in line.split()] for line in done.stdout.splitlines()
            if re.fullmatch(rf"\s*\d+(?:\s+{number})+\s*", line)]
    return done.stdout + done.stderr, rows


def table(program, script, ranks=1):
    """Thermo rows of a run as an array; an error stops with the program's own words."""
    text, rows = run(program, script, ranks)
    if "ERROR" in text or not rows:
        raise RuntimeError(f"{program} failed:\n" + "\n".join(text.splitlines()[-15:]))
    width = len(rows[0])
    return np.array([row for row in rows if len(row) == width])


def thermo(*variables):
    """Commands that print variables (an expression each) with all digits, after the step."""
    lines = [f"variable c{n} equal {text}" for n, text in enumerate(variables)]
    names = " ".join(f"v_c{n}" for n in range(len(variables)))
    return "\n".join([*lines, f"thermo_style custom step {names}",
                      "thermo_modify lost ignore norm no format float %.16g"])
