#!/usr/bin/python3
"""The physics that LIGGGHTS and our pair style share, each scene run by both and compared with closed
forms: Hertz's impact, restitution, and oblique impacts with Coulomb friction.

    cross_check.py [--lmp LAMMPS with APF] [--liggghts LIGGGHTS] [--csv FILE]

Prints a table and, with --csv, writes it for doc/src/liggghts.rst. A figure outside its bounds is marked
and makes the exit code 1. Exit code 77: skipped, because one of the programs is missing.
"""
import argparse
import csv
import math
import shutil
import sys

import numpy as np

from scenes import REST, scene, table, thermo

E, NU, R, MASS = 1.0e6, 0.25, 0.25, math.pi / 6
E_EFF = 0.5 * E / (1 - NU**2)
SPEED = 0.02    # of approach along the normal; slow, so that the normal hardly turns in oblique impacts
DEEPEST = (15 * 0.5 * MASS * SPEED**2 / (16 * E_EFF * math.sqrt(R))) ** 0.4
DURATION = 2.9432 * DEEPEST / SPEED
PEAK = 4 / 3 * E_EFF * math.sqrt(R) * DEEPEST**1.5
STEPS = 2000    # of an impact


def laws(dialect, restitution, mu):
    """Commands of the contact law."""
    if dialect == "LAMMPS":
        sliding = f"sliding {mu}" if mu else ""
        return (f"pair_style granular/adhesive\npair_coeff 1 1 jkr {E} {NU} 0.0 "
                f"damping tsuji {restitution} {sliding}")
    return "\n".join([
        f"fix m1 all property/global youngsModulus peratomtype {E}",
        f"fix m2 all property/global poissonsRatio peratomtype {NU}",
        f"fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution}",
        f"fix m4 all property/global coefficientFriction peratomtypepair 1 {mu}",
        f"pair_style gran model hertz tangential {'history' if mu else 'off'}",
        "pair_coeff * *",
    ])


def impact(dialect, program, restitution=1.0, mu=0.0, angle=0.0):
    """Rows of overlap, normal force, relative velocity along and across, and spin, per step."""
    half = 0.5 * SPEED * np.array([1.0, math.tan(math.radians(angle)), 0.0])
    gap = 0.01 * DEEPEST
    # the line of centres is x at first touch
    back = gap / SPEED * math.tan(math.radians(angle)) * 0.5 * SPEED
    step = DURATION / STEPS
    script = scene(dialect, [((3, 4 - back, 4), half, REST), ((4 + gap, 4 + back, 4), -half, REST)],
                   laws(dialect, restitution, mu))
    return table(program, script + "fix move all nve/sphere\ncompute spins g1 property/atom omegaz\n"
                 "compute spin g1 reduce sum c_spins\n"
                 f"timestep {step:.17g}\nthermo 1\n" +
                 thermo("x[2]-x[1]", "y[2]-y[1]", "fx[2]", "vx[2]-vx[1]", "vy[2]-vy[1]",
                        "c_spin") + f"\nrun {3 * STEPS}\n")


def hertz(dialect, program):
    """Duration and peak force of an elastic impact, by the closed forms."""
    rows = impact(dialect, program)
    touching = np.count_nonzero(rows[:, 3])
    return touching / STEPS, rows[:, 3].max() / PEAK


def restitution(dialect, program, e):
    """Coefficient of restitution measured."""
    return impact(dialect, program, restitution=e)[-1, 4] / SPEED


def oblique(dialect, program, angle, mu=0.3):
    """Relative tangential velocity and spin after an impact at an angle, by the normal speed."""
    last = impact(dialect, program, mu=mu, angle=angle)[-1]
    # along and across the line of centres of the impact, x; the approach was -tan(angle) across
    return -last[5] / SPEED, last[6] * 0.5 / SPEED


def sliding_throughout(angle, mu=0.3):
    """What Coulomb friction leaves where the surfaces slide from first to last touch."""
    return math.tan(math.radians(angle)) - 2 * mu, -2.5 * mu


def lines(programs):
    """Rows of (quantity, exact or None, LAMMPS, LIGGGHTS, bound)."""
    def both(measure, *words):
        return [measure(dialect, program, *words) for dialect, program in programs.items()]

    ours, theirs = both(hertz)
    yield "duration of an elastic impact / Hertz's", 1.0, ours[0], theirs[0], 0.002
    yield "largest force / Hertz's", 1.0, ours[1], theirs[1], 0.001
    for e in (0.9, 0.7, 0.5, 0.2):
        yield f"restitution, e = {e}", e, *both(restitution, e), 0.005 * e
    for angle in (10, 30, 45, 60, 70, 75):
        exact = sliding_throughout(angle) if angle >= 70 else (None, None)
        ours, theirs = both(oblique, angle)
        yield f"tangential velocity after {angle} degrees", exact[0], ours[0], theirs[0], 0.01
        yield f"spin after {angle} degrees", exact[1], ours[1], theirs[1], 0.01


def report(programs, path):
    """Prints and writes the table; returns whether all is within the bounds."""
    print(f"{'':42}{'exact':>10}{'APF':>10}{'LIGGGHTS':>10}{'bound':>8}")
    passed = True
    rows = []
    for name, exact, ours, theirs, bound in lines(programs):
        values = [ours, theirs] + ([] if exact is None else [exact])
        inside = max(values) - min(values) <= bound
        passed = passed and inside
        text = "" if exact is None else f"{exact:.4f}"
        print(f"{name:42}{text:>10}{ours:>10.4f}{theirs:>10.4f}{bound:>8.4f}"
              f"{'' if inside else '   OUTSIDE'}", flush=True)
        rows.append([name, text, f"{ours:.4f}", f"{theirs:.4f}", f"{bound:g}"])
    if path:
        with open(path, "w", newline="") as out:
            csv.writer(out).writerows([["quantity", "exact", "APF", "LIGGGHTS", "bound"], *rows])
    return passed


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description="Compares APF with LIGGGHTS.")
    parser.add_argument("--lmp", default="lmp", help="LAMMPS that loads APF (default lmp)")
    parser.add_argument("--liggghts", default="liggghts", help="default liggghts")
    parser.add_argument("--csv", help="file for the table")
    args = parser.parse_args()
    programs = {"LAMMPS": shutil.which(args.lmp), "LIGGGHTS": shutil.which(args.liggghts)}
    for name, program in programs.items():
        if not program:
            print(f"skipped: no {name} here (Debian's package: {name.lower()})")
            sys.exit(77)
    sys.exit(0 if report(programs, args.csv) else 1)


if __name__ == "__main__":
    main()
