#!/usr/bin/python3
"""What a contact costs: ours, LAMMPS's own granular pair style and LIGGGHTS, on the same flakes.

    peers.py [--repeat N] [--steps N] [--lmp FILE] [--liggghts FILE] [--keep DIR] [--results DIR]

Prints tables and writes them to results/peers.txt, with a plot in results/peers.png.
README.md says what the columns mean. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from itertools import product
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from bars import COLOURS, Spread, draw_bars, mark
from lammps_runs import HERE, count, keep_table, parse, processor, results_option, stop, verdict

PARTICLES = 7980
WARM = 100    # steps before the clock starts, for caches and pages
OURS, STOCK = "APF", "LAMMPS granular"
TARGETS = {2: (14.0, 22.0), 3: (8.0, 40.0)}    # by dimension: stock's time / ours, ours in ns

# examples/channel/in.channel at phi = 50, in SI
D, RHO, U, PHI, LAMBDA = 1e-5, 2600.0, 0.5, 50, 1e4
NU, ALPHA, RESTITUTION, MU, THETA = 0.3, 1.018, 0.2, 0.3, 0.01
DT, SKIN = 2.5e-8, 3e-6    # half in.channel's step: at that the peers' dashpots are unstable here
R = D / 4                                            # effective radius of a contact     [m]
E_EFF = LAMBDA * RHO * U**2                          # effective modulus                 [Pa]
GAMMA = PHI * RHO * U**2 * D / 2                     # surface energy                    [J/m^2]
A0 = (9 * np.pi * GAMMA * R**2 / E_EFF) ** (1 / 3)   # contact radius at rest            [m]
FC = 3 * np.pi * GAMMA * R                           # pull-off force                    [N]
DISTANCE = D - A0**2 / (3 * R)                       # of two centres at rest            [m]
SPEED = 0.01 * U                                     # largest, of the random velocities [m/s]

# sub-models in the order in which they are added, by words of our pair_coeff
MODES = {
    "normal": "damping none",
    "damping": f"damping alpha {ALPHA}",
    "sliding": f"sliding {MU}",
    "twisting": "twisting yes",
    "rolling": f"rolling {THETA}",
}


# ---------------------------------------------------------------------- scene


def hexagon():
    """19 sites of the triangular lattice with 42 contacts of length 1."""
    return np.array([(i + 0.5 * j, np.sqrt(0.75) * j, 0.0)
                     for i, j in product(range(-2, 3), repeat=2) if abs(i + j) <= 2])


def cuboctahedron():
    """13 sites of the FCC lattice with 36 contacts of length 1."""
    sites = [s for s in product((-1, 0, 1), repeat=3) if np.abs(s).sum() in (0, 2)]
    return np.array(sites) / np.sqrt(2)


def rotation(dim, random):
    """Random rotation matrix; about z in the plane."""
    if dim == 3:
        return np.linalg.qr(random.normal(size=(3, 3)))[0]
    angle = random.uniform(0, 2 * np.pi)
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])


def flakes(dim, random):
    """Centres of all particles and the length of the periodic box, both in m."""
    flake = DISTANCE * (hexagon() if dim == 2 else cuboctahedron())
    number = round(PARTICLES / len(flake))
    side = int(np.ceil(number ** (1 / dim)))
    pitch = 2 * np.linalg.norm(flake, axis=1).max() + 2 * D    # one diameter between two flakes
    cells = np.array(list(product(range(side), repeat=dim)))[:number]
    middles = np.zeros((number, 3))
    middles[:, :dim] = (cells + 0.5) * pitch
    return np.concatenate([m + flake @ rotation(dim, random).T for m in middles]), side * pitch


def velocities(n, dim, random):
    """Random velocities [m/s] and spins [rad/s] of n particles."""
    v = random.uniform(-SPEED, SPEED, (n, 3))
    spin = random.uniform(-SPEED, SPEED, (n, 3)) / (D / 2)
    if dim == 2:
        v[:, 2] = 0
        spin[:, :2] = 0
    return v, spin


def write_scene(path, dim):
    """Writes a data file that LAMMPS and LIGGGHTS both read."""
    random = np.random.default_rng(4711)
    x, length = flakes(dim, random)
    v, spin = velocities(len(x), dim, random)
    z = (-D / 2, D / 2) if dim == 2 else (0, length)
    with open(path, "w") as out:
        out.write(f"flakes\n\n{len(x)} atoms\n1 atom types\n\n0 {length:.17g} xlo xhi\n"
                  f"0 {length:.17g} ylo yhi\n{z[0]:.17g} {z[1]:.17g} zlo zhi\n\nAtoms\n\n")
        out.writelines(f"{i} 1 {D} {RHO} {a:.17g} {b:.17g} {c:.17g}\n"
                       for i, (a, b, c) in enumerate(x, 1))
        out.write("\nVelocities\n\n")
        out.writelines(f"{i} " + " ".join(f"{value:.9g}" for value in row) + "\n"
                       for i, row in enumerate(np.hstack([v, spin]), 1))


# ---------------------------------------------------------------------- runs


@dataclass(frozen=True)
class Case:
    """One line of a table."""

    name: str
    program: str    # file to run
    script: str     # input script in this folder
    dim: int
    words: str    # of the contact model, for the script


@dataclass
class Sample:
    """What one run measured."""

    contacts: tuple     # at the first and the last step
    ke_share: float     # kinetic energy at the last step, share of that at the first
    pair: float         # pair time per contact and step                               [ns]
    step: float         # whole step, per contact                                      [ns]


def variables(case, folder, steps):
    """The -var words of a run."""
    values = {
        "data": folder / f"flakes{case.dim}d.data", "dim": case.dim, "warm": WARM, "steps": steps,
        "d": D, "rho": RHO, "E": 2 * (1 - NU**2) * E_EFF, "nu": NU, "gamma": GAMMA, "mu": MU,
        "alpha": ALPHA, "e": RESTITUTION, "theta": THETA, "a0": A0, "FC": FC, "dt": DT,
        "skin": SKIN, "words": case.words,
    }
    return [word for name, value in values.items()
            for word in ("-var", name, str(value))]


def last_match(pattern, text, what):
    """Last match of a pattern as a float."""
    found = re.findall(pattern, text, re.M)
    if not found:
        stop(f"{what}: no match of {pattern!r}")
    return float(found[-1])


def read_sample(text, what, steps):
    """Sample from a log of LAMMPS or LIGGGHTS."""
    if last_match(r"^Neighbor list builds = (\d+)", text, what) > 0:
        stop(f"{what}: a neighbour list was rebuilt; take fewer --steps")
    # "Pair    | 0.1 | ..." in LAMMPS, "Pair  time (%) = 0.1 (...)" in LIGGGHTS
    pair = last_match(r"^Pair +(?:\||time \(%\) =) *([\d.e+-]+)", text, what)
    loop = last_match(r"^Loop time of ([\d.e+-]+)", text, what)
    thermo = re.findall(r"^ *\d+ +([\d.e+]+) +([\d.e+-]+) *$", text, re.M)
    if len(thermo) != 4:
        stop(f"{what}: 4 lines of thermo output expected, got {len(thermo)}")
    touching, ke = np.array(thermo, float)[[0, -1]].T
    scale = 2e9 / (touching[0] * steps)    # a contact touches two particles
    return Sample(tuple(int(n) // 2 for n in touching), ke[1] / ke[0], pair * scale, loop * scale)


def run(case, folder, steps):
    """Runs a case once."""
    log = folder / "log.run"
    command = [case.program, "-in", HERE / case.script, "-log", log, "-screen", "none",
               *variables(case, folder, steps)]
    env = dict(os.environ, OMP_NUM_THREADS="1")
    done = subprocess.run(command, cwd=folder, env=env, capture_output=True, text=True)
    text = log.read_text() if log.exists() else ""
    what = f"{case.name}, {case.dim}-D"
    if done.returncode != 0 or "ERROR" in text:
        tail = (text + done.stdout + done.stderr).splitlines()[-10:]
        stop("\n".join([f"{what}: {case.program} failed", *tail]))
    return read_sample(text, what, steps)


def measure(cases, folder, steps, repeat):
    """Samples by case: every case once, then all of them again, so that noise meets all alike."""
    samples = {case: [] for case in cases}
    for n in range(repeat):
        for k, case in enumerate(cases):
            print(f"\r  round {n + 1} of {repeat}, run {k + 1} of {len(cases)} ", end="",
                  file=sys.stderr, flush=True)
            samples[case].append(run(case, folder, steps))
    print(file=sys.stderr)
    return samples


# ---------------------------------------------------------------------- cases


def words_of(modes):
    """Words of our pair_coeff for some sub-models."""
    return " ".join(MODES[mode] for mode in modes if mode != "normal" or len(modes) == 1)


def modes_of(dim):
    """Sub-models that exist in so many dimensions."""
    return [mode for mode in MODES if dim == 3 or mode != "twisting"]


def sub_model_cases(lmp):
    """Ours, from the normal force alone to all modes, in two and three dimensions."""
    cases = []
    for dim in (2, 3):
        modes = modes_of(dim)
        for n, mode in enumerate(modes):
            name = f"+ {mode}" if n else mode
            cases.append(Case(name, lmp, "in.flakes.apf", dim, words_of(modes[:n + 1])))
    return cases


def engine_cases(lmp, liggghts):
    """All modes: ours first, then the peers that are installed."""
    cases = []
    for dim in (2, 3):
        cases.append(Case(OURS, lmp, "in.flakes.apf", dim, words_of(modes_of(dim))))
        cases.append(Case(STOCK, lmp, "in.flakes.granular", dim,
                          "damping viscoelastic"))
        if liggghts:
            cases.append(Case("LIGGGHTS", liggghts, "in.flakes.liggghts", dim,
                              f"torsionTorque {'on' if dim == 3 else 'off'}"))
    return cases


# ---------------------------------------------------------------------- tables and plot


def median_and_range(values):
    """Median and a text with the smallest and the largest value."""
    return np.median(values), f"{min(values):.1f} .. {max(values):.1f}"


def ratios(samples):
    """Pair time / ours of the same round, of each round, by case."""
    ours = {case.dim: rows for case, rows in samples.items() if case.name == OURS}
    return {case: [a.pair / b.pair for a, b in zip(rows, ours[case.dim])]
            for case, rows in samples.items()}


def engine_table(samples):
    """Lines of the table of engines."""
    beside = ratios(samples)
    lines = [f"{'engine':<18}{'dim':>4}{'contacts':>10}{'pair':>9}{'smallest .. largest':>22}"
             f"{'ratio':>8}{'smallest .. largest':>22}{'step':>9}{'ke':>9}"]
    for case, rows in samples.items():
        pair, spread = median_and_range([row.pair for row in rows])
        ratio, ratio_spread = median_and_range(beside[case])
        step = np.median([row.step for row in rows])
        lines.append(f"{case.name:<18}{case.dim:>4}{rows[0].contacts[0]:>10}{pair:>9.1f}"
                     f"{spread:>22}{ratio:>8.1f}{ratio_spread:>22}{step:>9.1f}"
                     f"{rows[0].ke_share:>9.4f}")
    return lines


def sub_model_table(samples):
    """Lines of the table of our sub-models."""
    lines = [f"{'APF sub-models':<18}{'dim':>4}{'contacts':>10}{'pair':>9}"
             f"{'smallest .. largest':>22}{'added':>8}"]
    before = {}
    for case, rows in samples.items():
        pair, spread = median_and_range([row.pair for row in rows])
        added = pair - before.get(case.dim, 0.0)
        before[case.dim] = pair
        lines.append(f"{case.name:<18}{case.dim:>4}{rows[0].contacts[0]:>10}{pair:>9.1f}"
                     f"{spread:>22}{added:>8.1f}")
    return lines


def verdicts(samples):
    """Lines: what was wanted of all modes, and whether it is there."""
    lines = []
    for case, values in ratios(samples).items():
        ratio, time = np.median(values), np.median([row.pair for row in samples[case]])
        times_stock, most = TARGETS[case.dim]
        if case.name == OURS:
            lines.append(verdict(f"{case.dim}-D: {OURS}, ns per contact and step", f"{time:.1f}",
                                 f"<= {most:g} ns", time <= most))
        if case.name == STOCK:
            lines.append(verdict(f"{case.dim}-D: {STOCK} / {OURS}", f"{ratio:.1f}",
                                 f">= {times_stock:g}", ratio >= times_stock))
    return lines


def broken_contacts(samples):
    """A line for every case whose contacts did not all last."""
    lines = []
    for case, rows in samples.items():
        first, last = rows[-1].contacts
        if first != last:
            lines.append(f"warning: {case.name}, {case.dim}-D: {first} contacts at the first step, "
                         f"{last} at the last")
    return lines


def version(program):
    """Version that a LAMMPS or LIGGGHTS prints as help."""
    text = subprocess.run([program, "-log", "none", "-h"], capture_output=True, text=True).stdout
    found = re.search(r"Simulator - (.*)|\(Version (.*?),", text)
    return (found[1] or found[2]) if found else "unknown version"


def report(args, lmp, liggghts, engines, parts):
    """The text that is printed and written."""
    peer = version(liggghts) if liggghts else "LIGGGHTS not installed: apt-get install liggghts"
    lines = [f"{processor()}, one core; LAMMPS {version(lmp)}; {peer}",
             f"median of {args.repeat} runs of {args.steps} steps; "
             "times per contact and step in ns",
             f"load of the machine {os.getloadavg()[1]:.1f}; 1.0 is this benchmark alone",
             "",
             *engine_table(engines),
             "",
             *sub_model_table(parts),
             "",
             *verdicts(engines),
             *broken_contacts(engines), *broken_contacts(parts)]
    return "\n".join(lines) + "\n"


def by_dimension(values):
    """Spreads by dimension and name, of values by case, and all names in the order of space."""
    series = {f"{dim}-D": {case.name: Spread.of(v) for case, v in values.items() if case.dim == dim}
              for dim in (2, 3)}
    return series, list(series["3-D"])


def pair_times(samples):
    """Pair times of all runs by case."""
    return {case: [row.pair for row in rows] for case, rows in samples.items()}


def draw_engines(axis, engines):
    """Times of all engines."""
    series, names = by_dimension(pair_times(engines))
    draw_bars(axis, names, series)
    axis.set(title="all modes; median, smallest, largest",
             ylabel="pair time per contact and step [ns]")


def draw_ratios(axis, engines):
    """Times of the peers over ours, with what was wanted."""
    peers = {case: values for case, values in ratios(engines).items() if case.name != OURS}
    series, names = by_dimension(peers)
    draw_bars(axis, names, series, digits=1)
    wanted = {(f"{dim}-D", STOCK): ratio for dim, (ratio, _) in TARGETS.items()}
    mark(axis, names, series, wanted, color="k", linestyle="--",
         label="target: " + ", ".join(f"{dim}-D {r:g}" for dim, (r, _) in TARGETS.items()))
    axis.set(title="times as long as ours", ylabel="pair time / ours of the same round")


def draw_parts(axis, parts):
    """Our sub-models, with what was wanted of all of them."""
    series, names = by_dimension(pair_times(parts))
    draw_bars(axis, names, series)
    for dim, (_, most) in TARGETS.items():
        axis.axhline(most, color=COLOURS[f"{dim}-D"], linestyle="--",
                     label=f"target: {dim}-D {most:g} ns")
    axis.set(title="APF, one sub-model after another",
             ylabel="pair time per contact and step [ns]")


def draw(engines, parts, path):
    """Engines, ratios and our sub-models side by side."""
    figure, axes = plt.subplots(1, 3, figsize=(15, 4.4), width_ratios=[3, 2, 4])
    draw_engines(axes[0], engines)
    draw_ratios(axes[1], engines)
    draw_parts(axes[2], parts)
    for axis in axes:
        axis.margins(y=0.25)    # room for the legend
        axis.legend(frameon=False, fontsize=8, ncol=2, loc="upper left")
    figure.tight_layout()
    figure.savefig(path, dpi=120)


# ---------------------------------------------------------------------- main


def arguments():
    """Command line."""
    parser = argparse.ArgumentParser(description="Measures what a contact costs in several codes.")
    parser.add_argument("--quick", action="store_true", help="one run of each case, 200 steps")
    parser.add_argument("--repeat", type=count, default=5, help="runs of each case (default 5)")
    parser.add_argument("--steps", type=count, default=1000, help="steps of a run (default 1000)")
    parser.add_argument("--lmp", default=HERE.parent / "lmp",
                        help="LAMMPS with APF (default ../lmp)")
    parser.add_argument("--liggghts", default="liggghts", help="LIGGGHTS (default liggghts)")
    parser.add_argument("--keep", type=Path, help="folder for the scenes and the last log")
    results_option(parser)
    args = parse(parser)
    if args.quick:
        args.repeat, args.steps = 1, 200
    return args


def find_programs(args):
    """Full paths of both programs; None for a LIGGGHTS that is not installed."""
    lmp, liggghts = shutil.which(args.lmp), shutil.which(args.liggghts)
    if not lmp:
        stop(f"{args.lmp} is not a program; name a LAMMPS with APF by --lmp")
    return os.path.abspath(lmp), liggghts and os.path.abspath(liggghts)


def main():
    """Runs everything, prints, writes and draws."""
    args = arguments()
    lmp, liggghts = find_programs(args)
    with tempfile.TemporaryDirectory() as temporary:
        folder = (args.keep or Path(temporary)).resolve()
        folder.mkdir(parents=True, exist_ok=True)
        for dim in (2, 3):
            write_scene(folder / f"flakes{dim}d.data", dim)
        engines = measure(engine_cases(lmp, liggghts), folder, args.steps, args.repeat)
        parts = measure(sub_model_cases(lmp), folder, args.steps, args.repeat)

    text = report(args, lmp, liggghts, engines, parts)
    draw(engines, parts, keep_table(text, args.results, "peers"))


if __name__ == "__main__":
    main()
