#!/usr/bin/python3
"""The channel at each adhesion number of the report: fix nve/sphere/mts beside a single rate.

    channel_phi.py [--quick] [--phi PHI ...] [--time T] [--seeds K] [--ranks N]
                   [--measure all|nothing] [--work DIR] [--results DIR] [--lmp FILE]

Runs examples/channel both ways to the time T, from the same particles, for each phi and seed, one
run after the other. Prints, and writes to results/channel_phi.txt with a plot in
results/channel_phi.png: shares in aggregates and on walls, number and size of aggregates, wall-clock
time of each, and what mts gains. Every run leaves a JSON file in DIR (default ../build-speed): the
command goes on where it was. Delete DIR after a change of the code. Needs Debian's python3-numpy and
python3-matplotlib.
"""
import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullLocator

from channel_runs import PARTICLES, QUANTITIES, TWO_WAYS, channel_schemes, run_channel
from lammps_runs import (count, keep_table, kept_runs, kept_runs_parser, median_range, parse_kept_runs, processor,
                         prose, stop, verdict)

SHARES = ("in agg.", "wall")     # of QUANTITIES, shown as a share of all particles
COLOURS = {"single rate": "#000000", "mts": "#D55E00"}


def arguments():
    """Command line."""
    parser = kept_runs_parser("The channel at each phi, mts beside a single rate.", ranks=2)
    parser.add_argument("--quick", action="store_true", help="one phi, one seed, a short time")
    parser.add_argument("--phi", nargs="+", help="adhesion numbers (default 1.5 15 50 150)")
    parser.add_argument("--time", type=float, help="end of the runs [L/U] (default 4)")
    parser.add_argument("--seeds", type=count, help="runs of each (default 3)")
    return parse_kept_runs(parser, {"phi": (["50"], ["1.5", "15", "50", "150"]), "time": (0.2, 4.0), "seeds": (1, 3)})


def measure(args, store):
    """{phi: {scheme: results by seed}} of the seeds that ran both ways."""
    schemes = [scheme for scheme in channel_schemes() if scheme.name in TWO_WAYS]
    out = {}
    for phi in args.phi:
        runs = {TWO_WAYS[scheme.name]: [] for scheme in schemes}
        for seed in range(4711, 4711 + args.seeds):
            both = {TWO_WAYS[scheme.name]: store.get(
                f"channel phi={phi} t={args.time:g} np={args.ranks} {scheme.name} {seed}",
                lambda s=scheme, seed=seed, phi=phi: run_channel(args, s, seed, args.time, phi))
                for scheme in schemes}
            failed = [result["failed"] for result in both.values() if result and "failed" in result]
            if failed:
                stop(f"phi = {phi}, seed {seed}: {failed[0]}")
            if all(both.values()):
                for name, result in both.items():
                    runs[name].append(result)
        if runs["mts"]:
            out[phi] = runs
    return out


def scaled(name, values):
    """Shares in percent of all particles, other quantities as they are."""
    return np.array(values) * (100 / PARTICLES if name in SHARES else 1)


def spread(values):
    """Standard deviation over seeds, nan for a single one."""
    return np.std(values, ddof=1) if len(values) > 1 else np.nan


def table(args, found):
    """The text that is printed and written."""
    lines = [*prose(f"""{processor()}. Channel to t = {args.time:g} L/U, {args.ranks} rank(s), up to
                    {args.seeds} seeds. single rate: fix nve/sphere with the report's collision step,
                    2.5e-5 L/U; mts: particle step 1e-3 L/U, collision tolerance 0.01. In aggregates and
                    on walls: per cent of all particles in aggregates, in those on a wall; means
                    over the last fifth of the time and over seeds, +- standard deviation over
                    seeds; differs by: mean of mts / single - 1 of runs with the same seed, +- its
                    standard error; reached: with twice that within 1 %. Times are LAMMPS's loop times, median (smallest .. largest);
                    speed-up: median of the ratios of runs of the same seed. Lambda: collision steps
                    of a particle step; x_c: share of particles sub-stepped; late: contacts found
                    late; cpu: least share of the time on a core."""), "",
             f"{'phi':<5}{'':<13}{'in aggregates %':>17}{'number':>16}{'size':>16}{'on walls %':>17}"
             f"{'time [s]':>23}{'speed-up':>10}{'Lambda':>8}{'x_c':>7}{'late':>6}{'cpu':>6}"]
    digits, verdicts = {"in agg.": 2, "number": 1, "size": 2, "wall": 2}, []

    def cells(values, error):
        widths = (17, 16, 16, 17)
        return "".join(f"{f'{values[q]:.{digits[q]}f} +- {error[q]:.{digits[q]}f}':>{w}}"
                       for q, w in zip(QUANTITIES, widths))

    for phi, runs in found.items():
        by_name = {name: {q: scaled(q, [r[q] for r in results]) for q in QUANTITIES}
                   for name, results in runs.items()}
        times = {name: [r["loop"] for r in results] for name, results in runs.items()}
        for name, results in runs.items():
            line = f"{phi:<5}{name:<13}" + cells({q: v.mean() for q, v in by_name[name].items()},
                                                 {q: spread(v) for q, v in by_name[name].items()})
            line += f"{median_range(times[name], '.1f'):>23}"
            if name == "mts":
                gain = np.median(np.array(times["single rate"]) / times["mts"])
                line += (f"{gain:>10.2f}{np.mean([r['Lambda'] for r in results]):>8.1f}"
                         f"{np.mean([r['x_c'] for r in results]):>7.3f}{sum(r['late'] for r in results):>6}")
            else:
                line += " " * 31
            lines.append(line + f"{min(r['cpu'] for r in results):>6.0%}")
        apart = {q: 100 * (by_name["mts"][q] / by_name["single rate"][q] - 1) for q in QUANTITIES}
        error = {q: spread(v) / np.sqrt(len(v)) for q, v in apart.items()}
        lines += [f"{'':<5}{'differs by %':<13}" + cells({q: v.mean() for q, v in apart.items()}, error), ""]
        verdicts += [verdict(f"phi = {phi}, {q}: mts beside single rate", f"{apart[q].mean():+.2f} %",
                             f"1 %, +- {error[q]:.2f}", abs(apart[q].mean()) + 2 * error[q] <= 1) for q in QUANTITIES]
    return "\n".join(lines + verdicts) + "\n"


def draw(args, found, path):
    """Shares, differences and times over phi."""
    figure, (shares, apart, times) = plt.subplots(1, 3, figsize=(15, 4.6))
    phi = [float(word) for word in found]
    for k, (q, words) in enumerate((("in agg.", "in aggregates"), ("number", "number of aggregates"),
                                    ("size", "their mean size"), ("wall", "in aggregates on walls"))):
        values = [100 * (np.array([r[q] for r in runs["mts"]]) / [r[q] for r in runs["single rate"]] - 1)
                  for runs in found.values()]
        apart.errorbar(np.array(phi) * 1.09**(k - 1.5), [v.mean() for v in values],
                       [2 * spread(v) / np.sqrt(len(v)) for v in values], marker="osD^"[k], linestyle="none",
                       capsize=3, color=("#0072B2", "#E69F00", "#009E73", "#CC79A7")[k], label=words)
    for limit in (-1, 1):
        apart.axhline(limit, color="firebrick", linestyle=":", label="wanted: 1 %" if limit > 0 else None)
    apart.axhline(0, color="0.6", linewidth=0.8)
    apart.set(title="mts less single rate, same seeds;\nbars: two standard errors", ylabel="difference [%]",
              ylim=(-1.6, 2.6))
    for name, colour in COLOURS.items():
        for q, marker, words in (("in agg.", "o", "in aggregates"), ("wall", "s", "in aggregates on walls")):
            values = [scaled(q, [r[q] for r in runs[name]]) for runs in found.values()]
            shares.errorbar(phi, [v.mean() for v in values], [spread(v) for v in values], marker=marker,
                            color=colour, linestyle="-" if name == "mts" else "none", capsize=4,
                            markersize=5 if name == "mts" else 9, label=f"{words}, {name}",
                            markerfacecolor=colour if name == "mts" else "none")
        values = [[r["loop"] for r in runs[name]] for runs in found.values()]
        middles = [np.median(v) for v in values]
        around = [[m - min(v) for m, v in zip(middles, values)], [max(v) - m for m, v in zip(middles, values)]]
        times.errorbar(phi, middles, around, marker="o", color=colour, capsize=4, label=name)
    shares.set(title=f"means from 4/5 of t = {args.time:g} L/U on;\nbars: standard deviation over seeds",
               ylabel="share of all particles [%]", ylim=(0, 100))
    times.set(title=f"to t = {args.time:g} L/U, {args.ranks} ranks;\nbars: smallest and largest",
              ylabel="wall-clock time [s]", yscale="log")
    for axis in (shares, apart, times):
        axis.set(xlabel=r"$\phi = \gamma/(\rho_p U^2 r)$", xscale="log")
        axis.set_xticks(phi, [f"{p:g}" for p in phi])
        axis.xaxis.set_minor_locator(NullLocator())
        axis.grid(True, color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
        axis.legend(fontsize=8, frameon=False)
    for side in (times.yaxis.set_major_formatter, times.yaxis.set_minor_formatter):
        side("{x:g}")
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    """Runs what is missing, prints, writes and draws."""
    args = arguments()
    found = measure(args, kept_runs(args))
    if not found:
        stop(f"{args.work}: nothing has run yet")
    draw(args, found, keep_table(table(args, found), args.results, "channel_phi"))


if __name__ == "__main__":
    main()
