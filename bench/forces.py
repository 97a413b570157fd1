#!/usr/bin/python3
"""What the forces of fix flow/force cost, beside the drag that stock LAMMPS can have.

    forces.py [--quick] [--rounds N] [--steps N] [--lmp FILE] [--keep DIR] [--results DIR]

Prints, and writes to results/forces.txt with a plot in results/forces.png, the time per particle and
step of each set of forces, for a flow given by a formula and for gridded ones. README.md says more.
Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import re
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from lammps_runs import (HERE, Failure, parse_rounds, processor, rounds_parser, run_lammps,
                         stop)

PARTICLES = 10000
L, U = 1e-3, 0.5    # box and largest velocity, as in in.forces
SETS = {
    "stock": "stock: drag by fix addforce",
    "stokes": "drag stokes",
    "schiller": "drag schiller",
    "difelice": "drag difelice",
    "torque": "drag, torque",
    "lift": "drag, lift",
    "usual": "drag, torque, lift, magnus",
    "bare": "the same, peratom no",
    "all": "the four, added_mass, pressure, gravity",
    "brownian": "drag, torque, brownian, cunningham",
    "feedback": "drag, feedback on 20 cells along each axis",
}
TARGET = 25.0       # ns, of the sets "usual" and "bare" in gridded flows
TARGET_RATIO = 4.0  # of stock's drag to that


@dataclass(frozen=True)
class Flow:
    """What the fluid is; cells: of its grid, along each axis; 0 for a formula."""

    dim: int
    cells: int

    @property
    def name(self):
        grid = f"grid {self.cells}^{self.dim}" if self.cells else "formula"
        return f"{self.dim}-D {grid}"


FLOWS = [Flow(2, 0), Flow(2, 128), Flow(3, 0), Flow(3, 32), Flow(3, 64)]
COLOURS = dict(zip(FLOWS, ("#56B4E9", "#0072B2", "#F0C040", "#E69F00", "#D55E00")))


def write_flow(path, flow):
    """Writes the vortices of Taylor and Green, periodic, in a file for fix flow/field."""
    n, h = flow.cells, L / flow.cells
    along = 2 * np.pi * np.arange(n) / n
    x, y = along, along[:, None]
    velocity = np.zeros((n, n, 3))
    velocity[..., 0], velocity[..., 1] = U * np.sin(x) * np.cos(y), -U * np.cos(x) * np.sin(y)
    if flow.dim == 3:
        velocity = velocity * np.cos(along)[:, None, None, None]
    with h5py.File(path, "w") as file:
        grid = file.create_group("VTKHDF")
        grid.attrs["Version"], grid.attrs["Type"] = (2, 0), np.bytes_("ImageData")
        grid.attrs["WholeExtent"] = (0, n - 1, 0, n - 1, 0, n - 1 if flow.dim == 3 else 0)
        grid.attrs["Origin"] = (0.0, 0.0, -L / 2 if flow.dim == 3 else 0.0)
        grid.attrs["Spacing"] = (h, h, h)
        grid.create_group("PointData")["velocity"] = velocity


def measure(args, folder):
    """Times per particle and step [ns] of each round, by (flow, set), less those without a force."""
    times = {}
    for flow in FLOWS:
        print(f"  {flow.name}", file=sys.stderr, flush=True)
        variables = {"dim": flow.dim, "rounds": args.rounds, "steps": args.steps, "N": PARTICLES}
        if flow.cells:
            write_flow(folder / "flow.vtkhdf", flow)
            variables |= {"flow": "file", "file": folder / "flow.vtkhdf"}
        text = run_lammps(args.lmp, HERE / "in.forces", variables, folder)
        found = {}
        for name, modify in re.findall(r"^CASE (\w+)\n.*?^Modify +\| (\S+)", text, re.M | re.S):
            found.setdefault(name, []).append(1e9 * float(modify) / (PARTICLES * args.steps))
        alone = np.array(found.pop("none"))
        for name, values in found.items():
            times[flow, name] = np.array(values) - alone
    return times


def table(times, args):
    """The result as lines."""
    lines = [f"{processor()}, one core; {PARTICLES} particles, sorted, without contacts",
             f"median of {args.rounds} rounds of {args.steps} steps, smallest .. largest; time per "
             "particle and step in ns,",
             "of LAMMPS's breakdown (Modify) less that of the same round without forces", "",
             f"{'forces':44}" + "".join(f"{flow.name:>24}" for flow in FLOWS)]
    for name, words in SETS.items():
        cells = (f"{np.median(t):7.1f}  {t.min():5.1f} .. {t.max():5.1f}" if t is not None else "-"
                 for t in (times.get((flow, name)) for flow in FLOWS))
        lines.append(f"{words:44}" + "".join(f"{cell:>24}" for cell in cells))
    lines += ["", f"{SETS['usual']}: at most {TARGET:g} ns wanted in gridded flows, and "
              f"{TARGET_RATIO:g} times as fast as stock's drag alone"]
    for name, words in (("usual", ""), ("bare", ", peratom no")):
        for flow in FLOWS:
            cost = np.median(times[flow, name])
            ratio = np.median(times[Flow(flow.dim, 0), "stock"]) / cost
            met = [what for what, good in ((f"{TARGET:g} ns", cost <= TARGET),
                                           (f"{TARGET_RATIO:g} times", ratio >= TARGET_RATIO)) if good]
            lines.append(f"  {flow.name + words:28}{cost:6.1f} ns, {ratio:4.1f} times as fast"
                         + ("" if not flow.cells else f": {', '.join(met) or 'none'} met"))
    return lines


def plot(times, path):
    """Bars of all medians, spreads as lines."""
    figure, axes = plt.subplots(figsize=(8, 5.5), layout="constrained")
    width = 0.8 / len(FLOWS)
    for k, flow in enumerate(FLOWS):
        rows = [(n, times[flow, name]) for n, name in enumerate(SETS) if (flow, name) in times]
        at = np.array([n for n, _ in rows]) + (k - (len(FLOWS) - 1) / 2) * width
        middle = np.array([np.median(t) for _, t in rows])
        spread = np.array([(np.median(t) - t.min(), t.max() - np.median(t)) for _, t in rows]).T
        axes.barh(at, middle, width, xerr=spread, color=COLOURS[flow], label=flow.name,
                  error_kw={"lw": 0.7})
    axes.set_yticks(range(len(SETS)), SETS.values())
    axes.invert_yaxis()
    axes.axvline(TARGET, color="0.3", ls=":", lw=1)
    axes.set_xlabel("time per particle and step [ns]")
    axes.grid(alpha=0.3, axis="x")
    axes.legend()
    figure.savefig(path, dpi=90)


def main():
    """Parses the command line, measures and writes."""
    parser = rounds_parser("Measures what forces of a fluid cost.", rounds=9, steps=100)
    parser.add_argument("--keep", type=Path, help="folder for the last flow and log")
    args = parse_rounds(parser)
    with tempfile.TemporaryDirectory() as scratch:
        folder = args.keep or Path(scratch)
        folder.mkdir(parents=True, exist_ok=True)
        try:
            times = measure(args, folder.resolve())
        except Failure as failure:
            stop(failure)
    text = "\n".join(table(times, args)) + "\n"
    print(text, end="")
    (args.results / "forces.txt").write_text(text)
    plot(times, args.results / "forces.png")


if __name__ == "__main__":
    main()
