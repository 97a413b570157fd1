#!/usr/bin/python3
"""Cost and memory per particle from 1e4 to 1e6 particles, on one rank and on two.

    scaling.py [--quick] [--sizes N ...] [--ranks N ...] [--repeat N] [--time T]
               [--results DIR] [--lmp FILE]

Prints, and writes to results/scaling.txt with a plot in results/scaling.png: time per particle and
particle step, and memory per particle, of a dilute and a dense cloud (in.cloud) that fix
nve/sphere/mts moves, and of the dilute one with LAMMPS's own styles, whose arrays grow out of the
cache likewise; what two ranks gain there and in examples/channel up to the time T; and how
that compares with what APF must reach. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import os
import re
import shutil
import subprocess
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.lines import Line2D

from lammps_runs import (CHANNEL, HERE, Failure, check_log, count, environment, keep_table, lammps_command,
                         parse, processor, prose, read_log, results_option, stop, verdict)

WARM = 5                        # particle steps before the clock starts
SMALL, MORE = 2e4, 5            # clouds up to this size take a tenth of a second: so often in a round
PARTICLE_STEP = 1e-3            # of the channel                                    [L/U]
TARGETS = {"cost": 1.15, "memory": 1.5, "ranks": 1.7}    # ratio, kB per particle, ratio
# Runs a command and prints its peak of resident memory. In a process of its own: the kernel counts
# what the parent holds at the start of a child as the child's, and ours holds more than LAMMPS.
WEIGH = """import os, sys
pid = os.posix_spawnp(sys.argv[1], sys.argv[1:], os.environ)
_, status, usage = os.wait4(pid, 0)
print("peak", usage.ru_maxrss)
sys.exit(os.waitstatus_to_exitcode(status))
"""
COLOURS = {"dilute": "#0072B2", "stock": "0.5", "dense": "#E69F00"}


@dataclass(frozen=True)
class Scene:
    """Repeated cells; as many in y for every size, so that the air is the same."""

    per_cell: int    # particles
    rows: int        # cells in y
    steps: int       # particle steps on the clock
    collision: int   # collision steps of each


SCENES = {"dilute": Scene(1, 33, 200, 40), "stock": Scene(1, 33, 200, 1),
          "dense": Scene(13, 10, 12, 40)}


@dataclass
class Sample:
    """What one run measured."""

    particles: int
    cost: float         # time per particle and particle step                         [ns]
    loop: float         # [s]
    contacts: float     # per particle, at the end
    allocated: float    # by LAMMPS's count, all ranks                                [kB]
    resident: float     # largest of a rank, times ranks                              [kB]
    x_c: float          # share of particles sub-stepped
    cpu: float          # share of the loop time that the processes had a core
    late: int


# ---------------------------------------------------------------------- runs


def run_and_weigh(args, script, variables, folder, ranks):
    """Log of a run, and the largest resident memory of one process [kB]."""
    log = folder / "log.run"
    log.unlink(missing_ok=True)
    command = lammps_command(args.lmp, script, variables, log, ranks)
    done = subprocess.run([sys.executable, "-S", "-c", WEIGH, *command], cwd=folder,
                          env=environment(), capture_output=True, text=True)
    text = check_log(log, done)
    return text, int(re.findall(r"^peak (\d+)$", done.stdout, re.M)[-1])


def sample(text, resident, ranks, steps):
    """Sample from a log."""
    facts = read_log(text)
    particles = int(re.findall(r"^Loop time .* with (\d+) atoms", text, re.M)[-1])
    average = re.findall(r"memory allocation .* = \S+ \| (\S+) \|", text)[-1]
    contacts = re.findall(r"^ +\d+ +\d+ +(\S+) +\S+ *$", text, re.M)
    return Sample(particles, 1e9 * facts["loop"] / (particles * steps), facts["loop"],
                  float(contacts[-1]) / particles if contacts else np.nan,
                  1024 * float(average) * ranks, resident * ranks,
                  facts.get("x_c", np.nan), facts["cpu"], facts.get("late", 0))


def run_cloud(args, name, size, ranks, folder):
    """One run of a cloud."""
    scene = SCENES[name]
    side = max(2, round(np.sqrt(size / (scene.rows * scene.per_cell))))
    variables = {"scene": name, "nx": side, "ny": scene.rows, "nz": side, "warm": WARM,
                 "steps": scene.steps // args.shorter, "collision": scene.collision}
    text, resident = run_and_weigh(args, HERE / "in.cloud", variables, folder, ranks)
    return sample(text, resident, ranks, scene.steps // args.shorter)


def run_channel(args, ranks, folder):
    """One run of the channel."""
    variables = {"t": args.time, "step": PARTICLE_STEP, "dir": folder, "picture": 2 * args.time + 1}
    _, resident = run_and_weigh(args, CHANNEL, variables, folder, ranks)
    return sample((folder / "channel-phi50.log").read_text(), resident, ranks, args.time / PARTICLE_STEP)


def measure(args, folder):
    """Samples by (scene, size, ranks): every case once, then all of them again."""
    cases = [(name, size, ranks) for name in SCENES for size in args.sizes for ranks in args.ranks]
    cases += [("channel", 8000, ranks) for ranks in args.ranks]
    samples = {case: [] for case in cases}
    for n in range(args.repeat):
        for name, size, ranks in cases:
            print(f"  round {n + 1} of {args.repeat}: {name}, {size}, {ranks} rank(s)",
                  file=sys.stderr, flush=True)
            for _ in range(MORE if name != "channel" and size <= SMALL else 1):
                try:
                    new = (run_channel(args, ranks, folder) if name == "channel"
                           else run_cloud(args, name, size, ranks, folder))
                except Failure as failure:
                    stop(f"{name}, {size} particles, {ranks} rank(s): {failure}")
                samples[name, size, ranks].append(new)
    return samples


# ---------------------------------------------------------------------- table


def median(rows, key):
    """Median over the runs of a case."""
    return float(np.median([getattr(row, key) for row in rows]))


def memory(samples, key, case):
    """Memory per particle [kB]; with a smaller case, of the particles beyond those of it."""
    name, size, ranks = case
    rows = samples[case]
    smallest = min(s for n, s, r in samples if n == name and r == ranks)
    if key == "allocated" or size == smallest:
        return median(rows, key) / rows[0].particles
    base = samples[name, smallest, ranks]
    return ((median(rows, key) - median(base, key)) / (rows[0].particles - base[0].particles))


def case_lines(samples):
    """Table of all cases."""
    lines = [f"{'scene':<9}{'particles':>10}{'ranks':>6}{'loop [s]':>10}{'ns':>10}"
             f"{'smallest .. largest':>22}{'contacts':>10}{'x_c':>7}{'memory':>8}{'resident':>10}"
             f"{'late':>6}{'cpu %':>7}"]
    for case, rows in samples.items():
        costs = [row.cost for row in rows]
        line = (f"{case[0]:<9}{rows[0].particles:>10}{case[2]:>6}{median(rows, 'loop'):>10.2f}"
                f"{np.median(costs):>10.1f}{f'{min(costs):.1f} .. {max(costs):.1f}':>22}"
                f"{rows[-1].contacts:>10.2f}{rows[-1].x_c:>7.3f}"
                f"{memory(samples, 'allocated', case):>8.2f}"
                f"{memory(samples, 'resident', case):>10.2f}{rows[-1].late:>6}"
                f"{100 * median(rows, 'cpu'):>7.0f}")
        lines.append(line.replace("nan", "  -"))
    return lines


def cost_lines(samples, sizes):
    """Cost of the largest cloud relative to the smallest, on one rank."""
    lines = []
    for name in SCENES:
        small, large = (median(samples[name, size, 1], "cost") for size in (sizes[0], sizes[-1]))
        ratio = large / small
        if name == "stock":
            lines.append(f"{'stock: the same with styles of LAMMPS alone':<58}{ratio:>8.2f}")
            continue
        lines.append(verdict(f"{name}: cost per particle, {sizes[-1]:.0e} / {sizes[0]:.0e}",
                             f"{ratio:.2f}", f"<= {TARGETS['cost']}", ratio <= TARGETS["cost"]))
    return lines


def memory_lines(samples, sizes):
    """Memory of the largest cloud on one rank."""
    lines = []
    for name in ("dilute", "dense"):
        for key, words in (("allocated", "LAMMPS's count"), ("resident", "resident, peak")):
            value = memory(samples, key, (name, sizes[-1], 1))
            lines.append(verdict(f"{name}, {sizes[-1]:.0e}: memory per particle, {words}",
                                 f"{value:.2f}", f"<= {TARGETS['memory']} kB",
                                 value <= TARGETS["memory"]))
    return lines


def rank_lines(samples):
    """What more ranks gain, case by case: median of the ratios of the rounds."""
    lines = []
    for (name, size, ranks), rows in samples.items():
        if ranks == 1 or name == "stock":
            continue
        gain = np.median([one.loop / more.loop for one, more in zip(samples[name, size, 1], rows)])
        lines.append(verdict(f"{name}, {rows[0].particles} particles: {ranks} ranks against 1",
                             f"{gain:.2f}", f">= {TARGETS['ranks'] * ranks / 2:g}",
                             gain >= TARGETS["ranks"] * ranks / 2))
    return lines


def report(args, samples):
    """The text that is printed and written."""
    head = prose(f"""{processor()}, {os.cpu_count()} cores; median of {args.repeat} run(s), of the smallest
                 clouds {MORE * args.repeat}. ns: time
                 per particle and particle step of 0.1 d/U, with 40 collision steps (clouds; stock
                 takes one) or collision tolerance 0.01 (channel, to t = {args.time:g} L/U). x_c: share of
                 particles sub-stepped. memory: kB per particle by LAMMPS's count, all ranks;
                 resident: peak of the processes, the smallest size whole, else what each further
                 particle adds. late: contacts found late. cpu: share of the loop time on a core;
                 where it is well below 100 the machine is busy with other work, and times are too
                 long.""")
    lines = [*head, "", *case_lines(samples), ""]
    if len(args.sizes) > 1:
        lines += cost_lines(samples, args.sizes)
    lines += [*memory_lines(samples, args.sizes), *rank_lines(samples)]
    return "\n".join(lines) + "\n"


# ---------------------------------------------------------------------- plot


def draw_cost(axis, samples):
    """Cost per particle and particle step over size: median, smallest, largest."""
    for name, colour in COLOURS.items():
        for ranks in sorted({r for n, _, r in samples if n == name}):
            cases = [rows for (n, _, r), rows in samples.items() if (n, r) == (name, ranks)]
            costs = [[row.cost for row in rows] for rows in cases]
            middle = np.array([np.median(c) for c in costs])
            axis.errorbar([rows[0].particles for rows in cases], middle, capsize=3, color=colour,
                          yerr=(middle - [min(c) for c in costs], [max(c) for c in costs] - middle),
                          marker="o", linestyle="-" if ranks == 1 else "--")
            if ranks == 1 and name != "stock":
                ends = [cases[k][0].particles for k in (0, -1)]
                axis.plot(ends, [TARGETS["cost"] * middle[0]] * 2, color=colour, linestyle=":")
    axis.set(xscale="log", yscale="log", xlabel="particles",
             ylabel="time per particle and particle step [ns]")
    smallest = min(size for name, size, _ in samples if name in COLOURS)
    percent = 100 * (TARGETS["cost"] - 1)
    explain(axis, {"1 rank": "-", "more ranks": "--",
                   f"target for 1 rank: {percent:.0f} % above its cost at {smallest:.0e}": ":"})


def draw_memory(axis, samples):
    """Memory per particle over size, one rank."""
    for name, colour in COLOURS.items():
        cases = [case for case in samples if case[0] == name and case[2] == 1]
        for key, look in (("allocated", "-"), ("resident", "--")):
            shown = cases if key == "allocated" else cases[1:]
            axis.plot([samples[case][0].particles for case in shown],
                      [memory(samples, key, case) for case in shown], look, marker="o",
                      color=colour)
    axis.axhline(TARGETS["memory"], color="k", linestyle=":")
    axis.set(xscale="log", xlabel="particles", ylabel="memory per particle, one rank [kB]")
    axis.set_ylim(bottom=0)
    explain(axis, {"LAMMPS's count": "-", "resident, peak, of each further particle": "--",
                   f"target: {TARGETS['memory']} kB": ":"})


def draw_ranks(axis, samples):
    """What more ranks gain over size."""
    for name, colour in {**COLOURS, "channel": "#009E73"}.items():
        for ranks in sorted({r for n, _, r in samples if n == name and r > 1}):
            cases = [(case, rows) for case, rows in samples.items() if (case[0], case[2]) == (name, ranks)]
            gains = [[one.loop / more.loop for one, more in zip(samples[name, case[1], 1], rows)]
                     for case, rows in cases]
            middle = np.array([np.median(g) for g in gains])
            axis.errorbar([rows[0].particles for _, rows in cases], middle, capsize=3, color=colour, marker="o",
                          yerr=(middle - [min(g) for g in gains], [max(g) for g in gains] - middle))
            axis.axhline(TARGETS["ranks"] * ranks / 2, color="k", linestyle=":")
    axis.set(xscale="log", xlabel="particles", ylabel="speed-up by more ranks over one", ylim=(1, None))
    axis.plot([], [], "o", color="#009E73", label="channel")
    axis.plot([], [], ":", color="k", label="target")
    axis.legend(fontsize=8, frameon=False, loc="lower center", bbox_to_anchor=(0.5, 1), ncol=2)


def explain(axis, looks):
    """Legend: colours of the clouds, and what each sort of line is."""
    handles = [Line2D([], [], color=colour, marker="o", linestyle="", label=name)
               for name, colour in COLOURS.items()]
    handles += [Line2D([], [], color="k", linestyle=look, label=words)
                for words, look in looks.items()]
    axis.legend(handles=handles, fontsize=8, frameon=False, ncol=2, loc="lower center",
                bbox_to_anchor=(0.5, 1))


def draw(samples, path):
    """Cost, memory, and what ranks gain."""
    figure, panels = plt.subplots(1, 3, figsize=(15, 4.4))
    draw_cost(panels[0], samples)
    draw_memory(panels[1], samples)
    draw_ranks(panels[2], samples)
    for axis in panels:
        axis.grid(True, which="major", color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(path, dpi=120)


# ---------------------------------------------------------------------- main


def arguments():
    """Command line."""
    parser = argparse.ArgumentParser(description="Cost and memory per particle, over size.")
    parser.add_argument("--quick", action="store_true", help="1e3 and 1e4 particles, few steps")
    parser.add_argument("--sizes", type=float, nargs="+",
                        help="particles of the clouds (default 1e4 1e5 1e6)")
    parser.add_argument("--ranks", type=count, nargs="+", default=[1, 2],
                        help="MPI ranks (default 1 2); begins with 1")
    parser.add_argument("--repeat", type=count, help="runs of each case (default 3)")
    parser.add_argument("--time", type=float, help="end of the channel [L/U] (default 2)")
    parser.add_argument("--lmp", default=HERE.parent / "lmp",
                        help="LAMMPS with APF (default ../lmp)")
    results_option(parser)
    args = parse(parser)
    full, quick = ([1e4, 1e5, 1e6], 3, 2.0), ([1e3, 1e4], 1, 0.1)
    for name, value in zip(("sizes", "repeat", "time"), quick if args.quick else full):
        if getattr(args, name) is None:
            setattr(args, name, value)
    args.sizes, args.shorter = sorted(int(size) for size in args.sizes), 4 if args.quick else 1
    if args.ranks[0] != 1:
        stop(f"--ranks must begin with 1, got {args.ranks[0]}")
    if not shutil.which(args.lmp):
        stop(f"{args.lmp} is not a program; name a LAMMPS with APF by --lmp")
    args.lmp = os.path.abspath(shutil.which(args.lmp))
    return args


def main():
    """Runs everything, prints, writes and draws."""
    args = arguments()
    with tempfile.TemporaryDirectory() as folder:
        samples = measure(args, Path(folder))
    text = report(args, samples)
    draw(samples, keep_table(text, args.results, "scaling"))


if __name__ == "__main__":
    main()
