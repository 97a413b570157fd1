#!/usr/bin/python3
"""Speed against error of time integration: single rate, r-RESPA and fix nve/sphere/mts.

    speed_error.py [--quick] [--part impacts|channel|all] [--measure errors|times|all|nothing]
                   [--time T] [--clock T] [--seeds K] [--schemes NAME ...] [--ranks N] [--impacts N]
                   [--repeat N] [--work DIR] [--results DIR] [--lmp FILE]

Prints, and writes to results/speed_error_impacts.txt and speed_error_channel.txt, each with a plot:

  elastic impacts   restitution and sticking velocity of pairs and at a wall, beside exact values
  damped impacts    oblique, with friction, beside the finest run and a Runge-Kutta integrator
  channel           aggregates of examples/channel, beside single-rate runs of the same seeds; only some schemes
                    with --schemes, by the names that the table has ("single rate 1", "mts auto 0.3")

each with a wall-clock time, the median of N rounds (default 3) in each of which every scheme runs
once. Errors do not mind other work on the machine, times do: --measure makes runs for the one or the
other. Every run leaves a JSON file in DIR (default ../build-speed): the command can be interrupted
and goes on where it was; what has run is shown. Delete DIR after a change of the code. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import os
import shutil
import sys
from pathlib import Path

from channel_runs import channel_schemes, channel_set
from impacts import damped_set, elastic_set
from lammps_runs import HERE, Store, count, keep_table, parse, results_option, stop
from speed_error_report import channel_text, draw_channel, draw_impacts, impact_text


def arguments():
    """Command line."""
    parser = argparse.ArgumentParser(description="Speed against error of time integration.")
    parser.add_argument("--quick", action="store_true", help="few impacts and a short channel")
    parser.add_argument("--part", choices=("impacts", "channel", "all"), default="all")
    parser.add_argument("--measure", choices=("errors", "times", "all", "nothing"), default="all",
                        help="what to run; nothing shows what has run")
    parser.add_argument("--time", type=float, help="end of the channel [L/U] (default 20)")
    parser.add_argument("--clock", type=float,
                        help="the channel's times are measured up to this one (default 2)")
    parser.add_argument("--seeds", type=count, help="runs of each channel scheme (default 3)")
    parser.add_argument("--schemes", nargs="+", choices=[s.name for s in channel_schemes()], metavar="NAME",
                        help="schemes of the channel that are run (default all)")
    parser.add_argument("--ranks", type=count, default=1, help="MPI ranks of the channel (default 1)")
    parser.add_argument("--impacts", type=count, help="impacts of a scene (default 10000)")
    parser.add_argument("--repeat", type=count, help="rounds in which times are measured (default 3)")
    parser.add_argument("--lmp", default=HERE.parent / "lmp",
                        help="LAMMPS with APF (default ../lmp)")
    parser.add_argument("--work", type=Path, default=HERE.parent / "build-speed",
                        help="folder for results of runs (default ../build-speed)")
    results_option(parser)
    args = parse(parser)
    full, quick = (20.0, 2.0, 3, 10000, 3), (0.5, 0.3, 1, 200, 1)
    names = ("time", "clock", "seeds", "impacts", "repeat")
    for name, value in zip(names, quick if args.quick else full):
        if getattr(args, name) is None:
            setattr(args, name, value)
    if not shutil.which(args.lmp):
        stop(f"{args.lmp} is not a program; name a LAMMPS with APF by --lmp")
    args.lmp, args.work = os.path.abspath(shutil.which(args.lmp)), args.work.resolve()
    return args


def collect(args, store):
    """Rows of all parts, by running what is missing."""
    elastic = damped = None
    if args.part != "channel":
        elastic, damped = elastic_set(args, store), damped_set(args, store)
    return elastic or [], damped, channel_set(args, store) if args.part != "impacts" else []


def main():
    """Runs what is missing, prints, writes and draws."""
    args = arguments()
    wanted = ("errors", "times") if args.measure == "all" else (args.measure,)
    store = Store(args.work, wanted)
    try:
        found = collect(args, store)
    except KeyboardInterrupt:
        print("interrupted; the same command goes on from here", file=sys.stderr)
        found = collect(args, Store(args.work, ()))
    elastic, damped, channel = found
    if not (elastic or damped or channel):
        stop(f"{args.work}: nothing has run yet")
    if elastic or damped:
        text = impact_text(args, elastic, damped)
        draw_impacts(args, elastic, damped, keep_table(text, args.results, "speed_error_impacts"))
    if channel:
        draw_channel(channel, keep_table(channel_text(args, channel), args.results, "speed_error_channel"))


if __name__ == "__main__":
    main()
