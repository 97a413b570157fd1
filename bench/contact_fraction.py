#!/usr/bin/python3
"""What fix nve/sphere/mts gains, by the share of particles in contact: the channel from early to late.

    contact_fraction.py [--quick] [--times T ...] [--length T] [--rounds N] [--ranks N]
                        [--measure all|nothing] [--work DIR] [--results DIR] [--lmp FILE]

Runs examples/channel at phi = 50 to each of the times T. From each of these states it goes on for a
short length both ways, with a single rate and with mts, in turn. Prints, and writes to
results/contact_fraction.txt with a plot in results/contact_fraction.png, times and gain beside what
the cost model of doc/src/theory.rst says of the measured share. States and runs are kept in DIR
(default ../build-speed): the command goes on where it was. Delete DIR after a change of the code.
Needs Debian's python3-numpy and python3-matplotlib.
"""
import shutil
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from channel_runs import PARTICLES, TWO_WAYS, channel_schemes, channel_script, speeds
from lammps_runs import (Failure, count, keep_table, kept_runs, kept_runs_parser, median_range, parse_kept_runs,
                         processor, prose, read_log, run_lammps, stop)

PHI, SEED = "50", 4711
SCHEMES = {TWO_WAYS[scheme.name]: scheme for scheme in channel_schemes() if scheme.name in TWO_WAYS}


def arguments():
    """Command line."""
    parser = kept_runs_parser("What multiple rates gain, by the share in contact.", ranks=1)
    parser.add_argument("--quick", action="store_true", help="two early times, one short round")
    parser.add_argument("--times", type=float, nargs="+",
                        help="of the states to go on from [L/U] (default 0.2 0.5 1 2 4 10 30)")
    parser.add_argument("--length", type=float, help="of what is timed [L/U] (default 0.5)")
    parser.add_argument("--rounds", type=count, help="runs of each from each state (default 3)")
    args = parse_kept_runs(parser, {"times": ([0.2, 0.5], [0.2, 0.5, 1.0, 2.0, 4.0, 10.0, 30.0]),
                                    "length": (0.1, 0.5), "rounds": (1, 3)})
    args.times = sorted(args.times)
    return args


# ---------------------------------------------------------------------- runs


def go_on(args, scheme, start, end):
    """Runs from the state at time `start` (0: from the beginning) to `end`: its log, its last state."""
    folder = args.work / "scratch-contact-fraction"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    out = folder / f"channel-phi{PHI}"
    # steps are counted from the beginning, and those before the state were of its own length
    begun = round(start / SCHEMES["mts"].step)
    until = begun * scheme.step + end - start
    if begun:
        shutil.copy(state_path(args, start), f"{out}.restart.end")
    variables = {"integrate": scheme.integrate, "step": scheme.step, "seed": SEED, "phi": PHI, "t": until,
                 "dir": folder, "picture": 1000, "close": 1000, "resume": "end" if begun else "no"}
    run_lammps(args.lmp, channel_script(folder, scheme), variables, folder, args.ranks)
    log = Path(f"{out}.log").read_text()
    wanted = round((end - start) / scheme.step)
    if f" for {wanted} steps with {PARTICLES} atoms" not in log:
        raise Failure(f"{scheme.name} from t = {start:g} to {end:g} is not {wanted} steps")
    return log, Path(f"{out}.restart.end")


def state_path(args, time):
    """Restart file of the channel at that time."""
    return args.work / f"channel-state-phi{PHI}-t{time:g}.restart"


def need_state(args, time):
    """Runs with mts to that time, from the last of the earlier ones, unless that has been done."""
    if time == 0 or state_path(args, time).exists():
        return
    earlier = max([t for t in args.times if t < time], default=0)
    need_state(args, earlier)
    print(f"  channel, t = {earlier:g} to {time:g}", file=sys.stderr, flush=True)
    _, end = go_on(args, SCHEMES["mts"], earlier, time)
    end.replace(state_path(args, time))


def timed(args, scheme, start):
    """One run from that state."""
    need_state(args, start)
    return read_log(go_on(args, scheme, start, start + args.length)[0])


def measure(args, store):
    """{time: {scheme: results by round}} of the rounds that ran both ways."""
    out = {}
    for time in args.times:
        rounds = []
        for n in range(args.rounds):
            both = {name: store.get(
                f"contact fraction t={time:g}+{args.length:g} np={args.ranks} {scheme.name} round {n + 1}",
                lambda s=scheme, t=time: timed(args, s, t)) for name, scheme in SCHEMES.items()}
            failed = [result["failed"] for result in both.values() if result and "failed" in result]
            if failed:
                stop(f"t = {time:g}: {failed[0]}")
            if all(both.values()):
                rounds.append(both)
        if rounds:
            out[time] = {name: [both[name] for both in rounds] for name in SCHEMES}
    return out


def gains(runs):
    """What speed() says of each round, as lists by name."""
    return speeds(SCHEMES["mts"], runs["mts"], runs["single rate"])


# ---------------------------------------------------------------------- table and plot


def table(args, found):
    """The text that is printed and written."""
    lines = [*prose(f"""{processor()}. Channel, phi = {PHI}, {PARTICLES} particles, {args.ranks} rank(s): from
                    its state at t, in L/U, for {args.length:g} L/U more. single rate: fix nve/sphere with the
                    report's collision step, 2.5e-5 L/U; mts: particle step 1e-3 L/U, collision
                    tolerance 0.01. x_c: share of particles sub-stepped, mean over the run; contacts: of
                    pairs and with walls, at its end, over particles; Lambda: collision steps of a
                    particle step. Times are LAMMPS's loop times, median (smallest .. largest) of
                    {max(len(runs["mts"]) for runs in found.values())} rounds, both in turn; speed-up:
                    median of the ratios of each round. equal: the speed-up if a collision step of a
                    particle cost as much as a step of single rate, 40/(1 + x_c Lambda); c: what it costs
                    of one, from the speed-up that is measured, 40/(1 + c x_c Lambda); model: Lambda/(1 + x_c
                    Lambda), over a single rate with the same collision step, with c = 1; late: contacts
                    found late; cpu: least share of the time on a core."""), "",
             f"{'t':>4}{'x_c':>8}{'contacts':>10}{'Lambda':>8}{'single rate [s]':>24}{'mts [s]':>24}"
             f"{'speed-up':>24}{'equal':>7}{'c':>6}{'model':>7}{'late':>6}{'cpu':>6}"]
    for time, runs in found.items():
        gain = gains(runs)
        mid = {name: float(np.median(values)) for name, values in gain.items()}
        contacts = np.median([r["contacts"] for r in runs["mts"]]) / PARTICLES
        single, mts = (median_range([r["loop"] for r in runs[name]], ".2f") for name in SCHEMES)
        lines.append(f"{time:>4g}{mid['x_c']:>8.3f}{contacts:>10.3f}{mid['Lambda']:>8.1f}"
                     f"{single:>24}{mts:>24}{median_range(gain['speedup'], '.2f'):>24}{mid['equal']:>7.2f}{mid['c']:>6.2f}"
                     f"{mid['model']:>7.2f}{sum(r['late'] for r in runs['mts']):>6}"
                     f"{min(r['cpu'] for results in runs.values() for r in results):>6.0%}")
    return "\n".join(lines) + "\n"


def draw(found, path):
    """Gain over the share in contact, and the model."""
    figure, axis = plt.subplots(figsize=(7, 4.8))
    every = {time: gains(runs) for time, runs in found.items()}
    mid = {name: np.array([np.median(gain[name]) for gain in every.values()])
           for name in ("x_c", "Lambda", "speedup", "c")}
    around = np.array([[m - min(gain["speedup"]), max(gain["speedup"]) - m]
                       for m, gain in zip(mid["speedup"], every.values())]).T
    axis.errorbar(mid["x_c"], mid["speedup"], around, marker="o", color="#D55E00", capsize=4,
                  linestyle="none", label="measured; bars: smallest and largest")
    words = {}    # one for states of one share
    for time, x, y in zip(every, mid["x_c"], mid["speedup"]):
        words.setdefault(round(x, 2), (x, y, []))[2].append(f"{time:g}")
    for x, y, times in words.values():
        axis.annotate(f"t = {', '.join(times)}", (x, y), xytext=(-7 if x > 0.9 else 7, 7),
                      textcoords="offset points", fontsize=8, ha="right" if x > 0.9 else "left")
    x = np.linspace(0.02, 1, 200)
    steps = SCHEMES["mts"].step / SCHEMES["single rate"].step
    # Lambda is not the same at all times: between two states it is in between
    order = np.argsort(mid["x_c"])
    sub_steps = x * np.interp(x, mid["x_c"][order], mid["Lambda"][order])
    c = np.median(mid["c"])
    axis.plot(x, steps / (1 + c * sub_steps), color="#0072B2",
              label=rf"{steps:g}/(1 + c $x_c \Lambda$), $\Lambda$ as measured, c = {c:.2f}")
    axis.plot(x, steps / (1 + sub_steps), color="0.4", linestyle="--", label="c = 1")
    axis.axhline(1, color="0.7", lw=0.8)
    axis.set(xlabel="share of particles sub-stepped, $x_c$", ylabel="speed-up over a single rate",
             xlim=(0, 1.03), yscale="log", title=rf"channel, $\phi$ = {PHI}, from t = {min(found):g} to {max(found):g} L/U")
    for side in (axis.yaxis.set_major_formatter, axis.yaxis.set_minor_formatter):
        side(lambda value, _: f"{value:g}" if f"{value:e}"[0] in "1235" else "")
    axis.grid(True, color="0.9")
    axis.spines[["top", "right"]].set_visible(False)
    axis.legend(fontsize=9, frameon=False)
    figure.tight_layout()
    figure.savefig(path, dpi=120)
    plt.close(figure)


def main():
    """Runs what is missing, prints, writes and draws."""
    args = arguments()
    found = measure(args, kept_runs(args))
    if not found:
        stop(f"{args.work}: nothing has run yet")
    draw(found, keep_table(table(args, found), args.results, "contact_fraction"))


if __name__ == "__main__":
    main()
