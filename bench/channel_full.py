#!/usr/bin/python3
"""The report's channel to its end, t = 100 L/U, at each adhesion number: how long it takes.

    channel_full.py [--quick] [--phi PHI ...] [--time T] [--rounds K] [--ranks N]
                    [--measure all|nothing] [--work DIR] [--results DIR] [--lmp FILE]

Runs examples/channel as it stands, without pictures, each phi once and then all of them again. Prints,
and writes to results/channel_full.txt with a plot in results/channel_full.png: wall-clock time, steps,
what is in contact at the end; and how that compares with the ten minutes that APF must stay below.
Every run leaves a JSON file in DIR (default ../build-speed): the command goes on where it was. Delete
DIR after a change of the code. Needs Debian's python3-numpy and python3-matplotlib.
"""
import shutil

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from lammps_runs import (CHANNEL, count, keep_table, kept_runs, kept_runs_parser, median_range, parse_kept_runs,
                         processor, prose, read_log, run_lammps, stop, verdict)

TARGET = 600.0         # s, phi = 50, t = 100, two ranks
REPORTS = 24 * 3600    # s, of the report's run


def arguments():
    """Command line."""
    parser = kept_runs_parser("The report's channel to its end at each phi.", ranks=2)
    parser.add_argument("--quick", action="store_true", help="one phi, one round, a short time")
    parser.add_argument("--phi", nargs="+", help="adhesion numbers (default 1.5 15 50 150)")
    parser.add_argument("--time", type=float, help="end of the runs [L/U] (default 100)")
    parser.add_argument("--rounds", type=count, help="runs of each (default 3)")
    return parse_kept_runs(parser, {"phi": (["50"], ["1.5", "15", "50", "150"]), "time": (0.5, 100.0), "rounds": (1, 3)})


def run_channel(args, phi):
    """One run: what its log says."""
    folder = args.work / "scratch-channel-full"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    variables = {"phi": phi, "t": args.time, "dir": folder, "picture": 2 * args.time + 1}
    run_lammps(args.lmp, CHANNEL, variables, folder, args.ranks)
    return read_log((folder / f"channel-phi{phi}.log").read_text())


def measure(args, store):
    """{phi: results of all rounds}, as far as they ran."""
    found = {phi: [] for phi in args.phi}
    for n in range(args.rounds):
        for phi, results in found.items():
            result = store.get(f"channel full phi={phi} t={args.time:g} np={args.ranks} round {n + 1}",
                               lambda phi=phi: run_channel(args, phi))
            if result and "failed" in result:
                stop(f"phi = {phi}: {result['failed']}")
            if result:
                results.append(result)
    return {phi: results for phi, results in found.items() if results}


def table(args, found):
    """The text that is printed and written."""
    lines = [*prose(f"""{processor()}. examples/channel, 8000 particles, to t = {args.time:g} L/U, {args.ranks} rank(s).
                    Times are LAMMPS's loop times, median (smallest .. largest) of up to {args.rounds} rounds, in each of
                    which every phi ran once. Lambda: collision steps of a particle step of 1e-3 L/U, mean; x_c: share of particles
                    sub-stepped; contacts: of pairs and with walls at the end; late: contacts found late; cpu: least share of
                    the time on a core."""), "",
             f"{'phi':<6}{'runs':>5}{'time [s]':>26}{'Lambda':>9}{'x_c':>8}{'contacts':>10}{'late':>6}{'cpu':>6}"]
    for phi, results in found.items():
        last = results[-1]
        lines.append(f"{phi:<6}{len(results):>5}{median_range([r['loop'] for r in results], '.0f'):>26}"
                     f"{last['Lambda']:>9.1f}{last['x_c']:>8.3f}{last['contacts']:>10}"
                     f"{sum(r['late'] for r in results):>6}{min(r['cpu'] for r in results):>6.0%}")
    if args.time == 100 and args.ranks == 2:
        lines.append("")
        for phi, results in found.items():
            middle = np.median([r["loop"] for r in results])
            lines.append(verdict(f"phi = {phi}: t = 100 on two ranks", f"{middle:.0f} s", f"<= {TARGET:.0f} s",
                                 middle <= TARGET))
    return "\n".join(lines) + "\n"


def draw(args, found, path):
    """Bars of the times, the target and the report's own time."""
    figure, axis = plt.subplots(figsize=(6.5, 4.2))
    times = [[r["loop"] for r in results] for results in found.values()]
    middle = np.array([np.median(t) for t in times])
    bars = axis.bar(range(len(times)), middle, 0.6, color="#0072B2", capsize=4,
                    yerr=(middle - [min(t) for t in times], [max(t) for t in times] - middle))
    axis.bar_label(bars, fmt="%.0f s", padding=-16, color="w")
    if args.time == 100:
        axis.axhline(TARGET, color="k", linestyle=":", label="target at phi = 50: 600 s")
        axis.axhline(REPORTS, color="firebrick", linestyle="--", label="the report's run: 24 h")
        axis.legend(frameon=False, fontsize=8, loc="center right", bbox_to_anchor=(1, 0.75))
    axis.set(xlabel=r"$\phi = \gamma/(\rho_p U^2 r)$", ylabel="wall-clock time [s]", yscale="log", ylim=(10, 2 * REPORTS),
             title=f"channel to t = {args.time:g} L/U, {args.ranks} rank(s)\nmedian; bars: smallest and largest")
    axis.set_xticks(range(len(times)), list(found))
    axis.spines[["top", "right"]].set_visible(False)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    """Runs what is missing, prints, writes and draws."""
    args = arguments()
    found = measure(args, kept_runs(args))
    if not found:
        stop(f"{args.work}: nothing has run yet")
    draw(args, found, keep_table(table(args, found), args.results, "channel_full"))


if __name__ == "__main__":
    main()
