#!/usr/bin/python3
"""Speed against error of a flow that changes in time: grid spacing, fluid step f1, particle step f2.

    flow_error.py [--quick] [--rounds N] [--lmp FILE] [--keep DIR] [--results DIR]

Spheres with Stokes's drag that touch nothing, in vortices that swell and fade, given by frames of a
series in a file, and in a parabola that does the same, whose velocity is a variable that keyword
fluid of fix nve/sphere/mts has evaluated at every Nth particle step. Both flows have closed forms,
in which a Runge-Kutta integrator here follows the same spheres. Prints, and writes to
results/flow_error.txt with a plot in results/flow_error.png, rms errors of positions and velocities,
time and memory. The files of the flow take 300 MB in DIR (default: a temporary folder).
Needs Debian's python3-numpy, python3-matplotlib and python3-h5py.
"""
import sys
import tempfile
from itertools import product
from dataclasses import dataclass
from pathlib import Path

import h5py
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from bars import Spread
from lammps_runs import (HERE, Failure, keep_table, parse_rounds, processor, prose, read_log,
                         rounds_parser, run_lammps, stop)

PARTICLES = 2000
D, RHO, U, L, MU = 1e-5, 2600.0, 0.5, 1e-3, 2e-5    # as in examples/channel/in.channel, in SI
TAU = RHO * D**2 / (18 * MU)                        # relaxation time                  [s]
UNIT = L / U                                        # of time                          [s]
SWING = 0.5                                         # part of U that comes and goes, once in UNIT
END = 1.25                                          # of the runs, when the flow is strongest [L/U]
CELLS = (16, 32, 64, 128)                           # of the grid, in L
F1 = (0.001, 0.01, 0.05, 0.1)                       # fluid steps                      [L/U]
F2 = (0.1, 0.5, 2.5)                                # particle steps                   [d/U]
BYTES = 2 * 32                                      # of a node: two frames, see fix flow/field


# ---------------------------------------------------------------------- flows and exact motion


def strength(t):
    """What both flows swell and fade with."""
    return 1 + SWING * np.sin(2 * np.pi * t / UNIT)


def vortices(x, y):
    """Vortices of Taylor and Green, velocities at points [...][2]; periodic in L."""
    x, y = 2 * np.pi * x / L, 2 * np.pi * y / L
    return U * np.stack([np.sin(x) * np.cos(y), -np.cos(x) * np.sin(y)], -1)


def parabola(x, y):
    """Velocities between walls at y = 0 and L."""
    s = y / L
    return U * np.stack([4 * s * (1 - s), 0 * x], -1)


SHAPES = {"vortices": vortices, "parabola": parabola}


def first_state(flow):
    """Positions and velocities of the spheres [n][2]."""
    random = np.random.default_rng(4711)
    x = random.uniform(0, L, (PARTICLES, 2))
    v = np.zeros_like(x)
    if flow == "parabola":    # they cross some of it, and reach no wall
        x[:, 1] = L * random.uniform(0.1, 0.9, PARTICLES)
        v[:, 1] = U * random.uniform(-0.1, 0.1, PARTICLES)
    return x, v


def runge_kutta(flow, steps):
    """Positions and velocities at END in the closed form, by the classical method of fourth order."""
    (x, v), h, shape = first_state(flow), END * UNIT / steps, SHAPES[flow]

    def rate(x, v, t):
        return (strength(t) * shape(x[:, 0], x[:, 1]) - v) / TAU

    for n in range(steps):
        t = n * h
        a1 = rate(x, v, t)
        v2 = v + h / 2 * a1
        a2 = rate(x + h / 2 * v, v2, t + h / 2)
        v3 = v + h / 2 * a2
        a3 = rate(x + h / 2 * v2, v3, t + h / 2)
        v4 = v + h * a3
        a4 = rate(x + h * v3, v4, t + h)
        x, v = x + h / 6 * (v + 2 * v2 + 2 * v3 + v4), v + h / 6 * (a1 + 2 * a2 + 2 * a3 + a4)
    return x, v


@dataclass(frozen=True)
class Exact:
    """Where the spheres are at END, and how far two step lengths agree [L]."""

    x: np.ndarray
    v: np.ndarray
    agree: float

    @classmethod
    def of(cls, flow):
        """In that flow."""
        x, v = runge_kutta(flow, 500)
        return cls(x, v, rms(x - runge_kutta(flow, 250)[0]) / L)


def rms(vectors):
    """Root of the mean square length."""
    return float(np.sqrt(np.mean(np.sum(vectors**2, axis=1))))


# ---------------------------------------------------------------------- runs


@dataclass(frozen=True)
class Case:
    """One way to have the flow."""

    flow: str
    cells: int    # of the grid, in L; 0 for a formula
    f1: float     # fluid step          [L/U]
    f2: float     # particle step       [d/U]

    step = property(lambda self: self.f2 * D / U)                          # [s]
    steps = property(lambda self: round(END * UNIT / self.step))
    every = property(lambda self: round(self.f1 * UNIT / self.step))       # particle steps, of a fluid step


def cases(quick):
    """All cases; a fluid step is not shorter than a particle step."""
    cells, f1, f2 = (CELLS[:3:2], F1[1:], F2[:2]) if quick else (CELLS, F1, F2)
    each = {b: round(b * D / L, 9) for b in f2}    # a fluid step as long as a particle step
    pairs = {(a, b) for a in f1 for b in f2 if a >= each[b]}
    return ([Case("vortices", n, a, b) for n in cells for a, b in sorted(pairs)]
            + [Case("parabola", 0, a, b) for a, b in sorted(pairs | {(a, b) for b, a in each.items()})])


def write_data(path, flow):
    """Writes the spheres for read_data."""
    x, v = first_state(flow)
    with open(path, "w") as out:
        out.write(f"{flow}\n\n{len(x)} atoms\n1 atom types\n\n0 {L} xlo xhi\n0 {L} ylo yhi\n"
                  f"{-D / 2} {D / 2} zlo zhi\n\nAtoms\n\n")
        out.writelines(f"{i} 1 {D} {RHO} {a:.17g} {b:.17g} 0\n" for i, (a, b) in enumerate(x, 1))
        out.write("\nVelocities\n\n")
        out.writelines(f"{i} {a:.17g} {b:.17g} 0 0 0 0\n" for i, (a, b) in enumerate(v, 1))


def write_series(path, cells, f1):
    """Writes the vortices in frames a fluid step apart, over one period, in single precision."""
    along = np.arange(cells) * L / cells
    velocity = np.zeros((cells, cells, 3))
    velocity[..., :2] = vortices(along, along[:, None])
    times = np.arange(round(1 / f1) + 1) * f1 * UNIT
    with h5py.File(path, "w") as file:
        grid = file.create_group("VTKHDF")
        grid.attrs["Version"], grid.attrs["Type"] = (2, 0), np.bytes_("ImageData")
        grid.attrs["WholeExtent"] = (0, cells - 1, 0, cells - 1, 0, 0)
        grid.attrs["Origin"], grid.attrs["Spacing"] = (0.0, 0.0, 0.0), (L / cells,) * 3
        frames = grid.create_group("PointData").create_dataset(
            "velocity", (len(times), *velocity.shape), np.float32)
        for n, t in enumerate(times):
            frames[n] = strength(t) * velocity
        series = grid.create_group("Steps")
        series.attrs["NSteps"], series["Values"] = len(times), times


def prepare(folder, chosen):
    """Writes all files of the runs."""
    for flow in SHAPES:
        write_data(folder / f"{flow}.data", flow)
    for cells, f1 in sorted({(case.cells, case.f1) for case in chosen if case.cells}):
        write_series(folder / f"vortices-{cells}-{f1:g}.vtkhdf", cells, f1)


def run_case(args, folder, case):
    """What LAMMPS's log says of the time, and positions and velocities at the end."""
    fastest = 2 * (1 + SWING) * U    # difference of two velocities
    variables = {"flow": case.flow, "data": f"{case.flow}.data", "out": "dump", "U": U, "L": L, "mu": MU,
                 "swing": SWING, "dt": case.step, "steps": case.steps, "fluid_every": case.every,
                 "file": f"vortices-{case.cells}-{case.f1:g}.vtkhdf",
                 "skin": max(D, 2.2 * case.step * np.sqrt(2) * fastest)}
    log = read_log(run_lammps(args.lmp, HERE / "in.flow_error", variables, folder))
    rows = np.loadtxt(folder / "dump", skiprows=9)
    return log, rows[:, 1:3], rows[:, 3:5]


def measure(args, folder, chosen, exact):
    """{case: row}; in each round every case runs once."""
    rows = {case: {"loops": [], "cpu": []} for case in chosen}
    for n in range(args.rounds):
        print(f"  round {n + 1} of {args.rounds}", file=sys.stderr, flush=True)
        for case, row in rows.items():
            log, x, v = run_case(args, folder, case)
            row["loops"].append(log["loop"])
            row["cpu"].append(log["cpu"])
            row["x"], row["v"] = rms(x - exact[case.flow].x) / L, rms(v - exact[case.flow].v) / U
    for case, row in rows.items():
        row["time"] = Spread.of([1e9 * t / (PARTICLES * case.steps) for t in row["loops"]])
        row["whole"] = Spread.of([1e6 * t / (PARTICLES * END) for t in row["loops"]])
    return rows


# ---------------------------------------------------------------------- table and plot


def table(args, rows, exact):
    """The text that is printed and written."""
    agree = max(e.agree for e in exact.values())
    core = np.median([share for row in rows.values() for share in row["cpu"]])
    lines = [*prose(f"""{processor()}, one core. {PARTICLES} spheres of d = {D / L:g} L with Stokes's drag,
                    relaxation time {TAU / UNIT:.3f} L/U, pass through each other to t = {END:g} L/U;
                    fix nve/sphere/mts. The flow has its shape times 1 + {SWING:g} sin(2 pi t U/L).
                    vortices: of Taylor and Green, four in the box of L x L, from a file with h
                    between nodes and a frame every f1 L/U; parabola: in closed form, its velocity a
                    variable that is evaluated every f1 L/U (fluid N). Particle steps are f2 d/U; N:
                    of them in a fluid step. Errors are root mean squares over all spheres at the end,
                    beside Runge-Kutta in the closed form, whose step halved moves spheres by
                    {agree:.0e} L. time: LAMMPS's loop per particle and step, median of {args.rounds}
                    rounds (smallest .. largest), in each of which every case ran once, on a core for
                    {core:.0%} of the time; whole: per particle and L/U. memory: of two frames, {BYTES} bytes a node."""), "",
             f"{'flow':<10}{'h/L':>7}{'f1':>7}{'f2':>5}{'N':>5}{'x err/d':>11}{'x err/L':>11}{'v err/U':>11}"
             f"{'time [ns]':>22}{'whole [us]':>12}{'memory [kB]':>13}"]
    last = None
    for case, row in rows.items():
        if last and (case.flow, case.cells) != last:
            lines.append("")
        last = case.flow, case.cells
        spacing = f"1/{case.cells}" if case.cells else "-"
        memory = f"{BYTES * case.cells**2 / 1e3:.0f}" if case.cells else "-"
        t = row["time"]
        lines.append(f"{case.flow:<10}{spacing:>7}{case.f1:>7g}{case.f2:>5g}{case.every:>5}"
                     f"{row['x'] * L / D:>11.3g}{row['x']:>11.2e}{row['v']:>11.2e}"
                     f"{f'{t.middle:.0f} ({t.low:.0f} .. {t.high:.0f})':>22}{row['whole'].middle:>12.1f}"
                     f"{memory:>13}")
    return "\n".join([*lines, "", *findings(rows)]) + "\n"


def findings(rows):
    """Lines on the order of the error in each of the three, and on what frames cost."""
    f2s = {case.f2 for case in rows}
    grid, formula = [c for c in rows if c.cells], [c for c in rows if not c.cells]
    finest = max(c.cells for c in grid)

    def order(what, theory, cases, size):
        points = sorted((size(case), rows[case]["x"]) for case in cases)
        (a, e), (b, f) = points[-2:]    # the two largest, where the error is of this more than of others
        return f"{what:<58}{np.log(f / e) / np.log(b / a):>6.2f}   theory: {theory}"

    series = sorted((c for c in grid if (c.cells, c.f2) == (finest, min(f2s))), key=lambda c: c.f1)
    more = PARTICLES * (rows[series[0]]["time"].middle - rows[series[-1]]["time"].middle)
    nodes = finest**2 * (1 / series[0].every - 1 / series[-1].every)
    return [order("order in h", 2, [c for c in grid if (c.f1, c.f2) == (min(c.f1 for c in grid), min(f2s))],
                  lambda c: 1 / c.cells),
            order("order in f1, frames of a series", 2, series, lambda c: c.f1),
            order("order in f1, a variable and fluid N", 1, [c for c in formula if c.f2 == min(f2s)],
                  lambda c: c.f1),
            order("order in f2, a variable at every step", 2, [c for c in formula if c.every == 1],
                  lambda c: c.f2),
            f"{f'to read a frame of {finest}^2 nodes, ns per node':<58}{more / nodes:>6.0f}"]


def guide(axis, x, y, order):
    """A short line of that order through a point."""
    ends = np.array([x / 2, x])
    axis.plot(ends, y * (ends / x) ** order, color="0.5", lw=1)
    axis.annotate(f"{order}", (x / 2**0.5, y / 2 ** (order / 2)), xytext=(6, -9), fontsize=8,
                  textcoords="offset points", color="0.4")


def draw(rows, path):
    """Error over grid spacing, over both steps, and over time."""
    figure, (space, steps, times) = plt.subplots(1, 3, figsize=(15, 4.8), layout="constrained")
    f1s, f2s = sorted({c.f1 for c in rows if c.cells}), sorted({c.f2 for c in rows})
    cells = sorted({c.cells for c in rows if c.cells})
    colours = dict(zip(f1s, ("#0072B2", "#009E73", "#CC79A7", "#E69F00")))
    markers = dict(zip(f2s, "o^s"))

    def line(axis, chosen, size, **look):
        points = sorted((size(case), rows[case]["x"]) for case in chosen)
        axis.plot(*zip(*points), **look)
        return points[-1]

    for f1 in f1s:
        top = line(space, [c for c in rows if c.cells and (c.f1, c.f2) == (f1, f2s[0])],
                   lambda c: 1 / c.cells, marker="o", color=colours[f1], label=f"a frame every {f1:g} L/U")
    guide(space, top[0], 0.6 * top[1], 2)
    space.set(title=f"grid spacing; particle step {f2s[0]:g} d/U", xlabel="h/L")

    for chosen, size, order, look in (
            ([c for c in rows if c.cells == cells[-1] and c.f2 == f2s[0]], lambda c: c.f1, 2,
             {"marker": "o", "color": "#0072B2", "label": f"frames every f1, h = L/{cells[-1]}"}),
            ([c for c in rows if not c.cells and c.f2 == f2s[0]], lambda c: c.f1, 1,
             {"marker": "v", "color": "#D55E00",
              "label": "variable evaluated every f1 (fluid N); first point: N = 1"}),
            ([c for c in rows if not c.cells and c.every == 1], lambda c: c.f2 * D / L, 2,
             {"marker": "s", "color": "#CC79A7", "label": "particle step, variable evaluated at each"})):
        top = line(steps, chosen, size, **look)
        guide(steps, top[0], 0.6 * top[1], order)
    steps.set(title="fluid and particle steps", xlabel="step [L/U]")

    # a line through the spacings, finer ones below, and for the parabola through the numbers N
    lines = [(colours[f1], f2, [c for c in rows if c.cells and (c.f1, c.f2) == (f1, f2)])
             for f1, f2 in product(f1s, f2s)]
    lines += [("0.5", f2, [c for c in rows if not c.cells and c.f2 == f2]) for f2 in f2s]
    for colour, f2, chosen in lines:
        chosen = sorted(chosen, key=lambda c: rows[c]["x"])
        if not chosen:
            continue
        whole = [rows[c]["whole"] for c in chosen]
        times.errorbar([w.middle for w in whole], [rows[c]["x"] for c in chosen],
                       xerr=[[w.middle - w.low for w in whole], [w.high - w.middle for w in whole]],
                       marker=markers[f2], color=colour, markersize=5, markerfacecolor="none", lw=0.7)
    for f1 in f1s:
        times.plot([], [], "-", color=colours[f1], label=f"a frame every {f1:g} L/U")
    times.plot([], [], "-", color="0.5", label="parabola, formula; lines through N")
    for f2 in f2s:
        times.plot([], [], markers[f2], color="k", markerfacecolor="none", label=f"particle step {f2:g} d/U")
    times.set(title=f"error over time; lines through h = L/{cells[0]} (top) to L/{cells[-1]}",
              xlabel=r"wall-clock time per particle and L/U [$\mu$s]")
    for axis in (space, steps, times):
        axis.set(xscale="log", yscale="log", ylabel="rms error of positions / L")
        axis.grid(color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
        axis.legend(fontsize=8, frameon=False)
    space.set_xticks([1 / n for n in cells], [f"1/{n}" for n in cells])
    space.minorticks_off()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    """Runs all cases, prints, writes and draws."""
    parser = rounds_parser("Speed against error of a flow that changes in time.", rounds=3)
    parser.add_argument("--keep", type=Path, help="folder for the files of the flow and the last run")
    args = parse_rounds(parser)
    chosen = cases(args.quick)
    exact = {flow: Exact.of(flow) for flow in SHAPES}
    with tempfile.TemporaryDirectory() as scratch:
        folder = (args.keep or Path(scratch)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        prepare(folder, chosen)
        try:
            rows = measure(args, folder, chosen, exact)
        except Failure as failure:
            stop(failure)
    draw(rows, keep_table(table(args, rows, exact), args.results, "flow_error"))


if __name__ == "__main__":
    main()
