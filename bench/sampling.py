#!/usr/bin/python3
"""What it costs to know the fluid of a gridded flow at a particle: table and plot of bench_sampling.

    sampling.py [--results DIR] (BENCH_SAMPLING | --times FILE)

Runs the program, three minutes, or takes what it wrote with --benchmark_format=json, and writes
results/sampling.txt and results/sampling.png. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

from bars import Spread, draw_bars
from lammps_runs import keep_table, parse, processor, prose, results_option, stop
from roofline import SETS, measured, output

PARTICLES = 102400    # of sampling.cpp
DETAILS = {"velocity": "velocity", "vorticity": "+ vorticity", "gradient": "+ all slopes",
           "series": "the same,\ntwo times"}


def read_times(text):
    """Spreads by (dims, nodes along an axis), column and detail, from JSON of bench_sampling.

    Columns are the instruction sets, with sorted particles, and "unsorted" with the best of them.
    """
    times = {}
    for name, (median, variation) in measured(text, "per_particle").items():
        dims, nodes, detail, *unsorted, isa = name.split("/")
        column = "unsorted" if unsorted else isa
        grid = times.setdefault((dims, int(nodes)), {})
        grid.setdefault(column, {})[detail] = Spread.around(median, variation)
    return {grid: {column: {detail: rows[column][detail] for detail in DETAILS}
                   for column in (*SETS, "unsorted") if column in rows}
            for grid, rows in sorted(times.items())}


def table(times):
    """The result as lines."""
    columns = list(next(iter(times.values())))
    best = columns[-2]
    lines = prose(f"""{processor()}, one core; {PARTICLES} particles. Time per particle in ns:
        median of nine repetitions, +- coefficient of variation. Particles lie in memory in the order of
        bins of about eight cells; in the last column, with {best}, in no order. vorticity: with
        velocity; slopes: velocity and all its derivatives; two times: between two flows.""")
    lines += ["", f"{'grid':14}{'what':24}" + "".join(f"{column:>18}" for column in columns)]
    for (dims, nodes), rows in times.items():
        for detail, words in DETAILS.items():
            cells = [rows[column][detail] for column in columns]
            lines.append(f"{f'{nodes}^{dims[0]} nodes':14}{' '.join(words.split()):24}" + "".join(
                f"{s.middle:10.1f} +- {100 * (s.high / s.middle - 1):2.0f} %" for s in cells))
    return lines


def draw(times, path):
    """A panel for each grid; their scales are not the same."""
    figure, axes = plt.subplots(2, 2, figsize=(11, 7))
    for axis, ((dims, nodes), rows) in zip(axes.flat, times.items()):
        draw_bars(axis, list(DETAILS), rows)
        axis.set_xticks(range(len(DETAILS)), DETAILS.values())
        axis.set(title=f"{nodes}^{dims[0]} nodes", ylabel="time per particle [ns]")
    axes.flat[0].legend(frameon=False, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def main():
    """Measures or reads, prints, writes and draws."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, nargs="?", metavar="BENCH_SAMPLING")
    parser.add_argument("--times", type=Path, help="what it wrote with --benchmark_format=json")
    results_option(parser)
    args = parse(parser)
    if not args.times and not (args.program and args.program.is_file()):
        stop(f"{args.program or 'BENCH_SAMPLING'}: not there; a build with -D APF_BENCH=on has "
             "bench_sampling")
    times = read_times(args.times.read_text() if args.times else
                       output(args.program, "--benchmark_format=json",
                              "--benchmark_enable_random_interleaving=true"))
    text = "\n".join(table(times)) + "\n"
    draw(times, keep_table(text, args.results, "sampling"))


if __name__ == "__main__":
    main()
