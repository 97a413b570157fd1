"""Tables and plot of speed_error.py."""
import sys

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

from bars import Spread
from channel_runs import QUANTITIES
from impacts import ALPHA, MU, THETA, Contact
from lammps_runs import median_range, processor, prose

WANTED = 0.01    # of single rate's statistics of aggregates

COLOURS = {"single rate": "#000000", "respa": "#E69F00", "mts collision N": "#0072B2",
           "mts auto": "#009E73", "mts tolerance": "#D55E00", "mts auto, f2": "#CC79A7"}
MARKERS = dict(zip(COLOURS, "sDov^P"))    # of families in the plot


# ---------------------------------------------------------------------- tables


def percent(value, digits=2):
    """A share as text in percent."""
    return "-" if value is None or np.isnan(value) else f"{100 * value:+.{digits}f}"


def number(row, key, form):
    """A value of a row, or the median of its values, as text."""
    if key not in row:
        return "-"
    return format(np.median(row[key]) if isinstance(row[key], list) else row[key], form)


def difference(found):
    """A difference in percent, its standard error, and whether it is within WANTED."""
    sign = {True: "y", False: "n", None: "?"}[found.within(WANTED)]
    return f"{percent(found.mean)} +- {percent(found.error).lstrip('+')} {sign}"


def impact_lines(rows, columns):
    """Table of one set of impacts; columns: name -> text of a row."""
    lines = [f"{'scheme':<17}{'setting':<22}{'time [s]':>24}{'Lambda':>8}{'x_c':>7}"
             + "".join(f"{name:>11}" for name in columns) + f"{'late':>6}"]
    for scheme, row in rows:
        head = f"{scheme.family:<17}{scheme.setting:<22}"
        if "failed" in row:
            lines.append(f"{head} failed: {row['failed']}"[:100])
            continue
        time = median_range(row["time"], ".3f") if "time" in row else "-"
        lines.append(head + f"{time:>24}{number(row, 'Lambda', '.1f'):>8}"
                     f"{number(row, 'x_c', '.3f'):>7}"
                     + "".join(f"{text(row):>11}" for text in columns.values())
                     + f"{row['late'] if 'Lambda' in row else '-':>6}")
    return lines


def elastic_lines(args, rows):
    """Text on the elastic impacts."""
    columns = {"mean |de|": lambda row: f"{row['mean']:.5f}",
               "max |de|": lambda row: f"{row['max']:.5f}",
               "V_s pair %": lambda row: percent(row["V_s pair"]),
               "V_s wall %": lambda row: percent(row["V_s wall"])}
    pair, wall = Contact(50), Contact(50, wall=True)
    return [*prose(f"""Elastic impacts, phi = 50: {args.impacts} head-on pairs and as many on a
                   wall at 0.5 to 5 V_s, and both again at 0.7 to 1.3 V_s; random phases to the
                   time grid. |de|: from sqrt(1 - (V_s/V)^2) at V > 1.2 V_s. V_s exact
                   {pair.sticking:.4f} m/s (pair), {wall.sticking:.4f} m/s (wall); omega
                   {pair.frequency:.4g}/s (normal, pair)."""), "", *impact_lines(rows, columns)]


def damped_lines(args, known):
    """Text on the damped impacts."""
    columns = {"mean err": lambda row: f"{row['mean']:.5f}",
               "max err": lambda row: f"{row['max']:.5f}",
               "head-on de": lambda row: f"{row['head']:.5f}",
               "V_s pair %": lambda row: percent(row["V_s pair"])}
    contact = Contact(1.5, friction=True)
    return [*prose(f"""Damped impacts with friction, phi = 1.5: alpha {ALPHA}, mu {MU}, theta
                   {THETA}; {args.impacts} pairs at 0, 20, 40, 60 degrees and 1.2 to 3 V_s, and
                   as many head-on at 0.7 to 1.6 V_s. err: relative velocity and spin x
                   radius after the
                   impact, over V, from the finest run (single rate, omega dt = {known['kappa']});
                   head-on de: e from Runge-Kutta, which that run meets within
                   {known['agree']:.1e}. V_s by Runge-Kutta
                   {known['sticking'] * contact.sticking:.4f} m/s, {known['sticking']:.3f} times the
                   elastic one; omega {contact.frequency:.4g}/s (tangential)."""), "",
            *impact_lines(known["rows"], columns)]


def channel_lines(args, rows):
    """Text on the channel."""
    names = "".join(f"{q + ' %':>20}" for q in QUANTITIES)
    lines = [*prose(f"""Channel, phi = 50, to t = {args.time:g} L/U, {args.ranks} rank(s), up to
                    {args.seeds} seed(s): particles in aggregates, aggregates, their mean size and
                    particles in those on a wall, means over the last fifth. Each number: mean over
                    seeds of the relative difference from single rate at the report's step and the
                    same seed, +- standard error of this mean; y: within {100 * WANTED:g} % by two standard
                    errors; n: not, by as much; ?: so many seeds do not tell (with few, two standard
                    errors are less sure than 95 %). The other columns are medians of {args.repeat}
                    round(s) to t = {args.clock:g}, seed 4711, all schemes in turn, as times want a
                    quiet machine; time: median (smallest .. largest). Lambda:
                    collision steps of a particle step; x_c: share of particles sub-stepped; equal:
                    the speed-up if a collision step of a particle cost as much as a step of single
                    rate, the report's steps in a particle step / (1 + x_c Lambda); c: what it
                    costs of one, from the speed-up that is measured (packed contacts, no drag, no
                    ghosts, no look at the list); model: Lambda/(1 + x_c Lambda), the speed-up over
                    a single rate with the same collision step, with c = 1; cpu: share of the time
                    on a core, well below 100 on a busy machine."""), "",
             f"{'scheme':<17}{'setting':<9}{'seeds':>5}{names}{'late':>6}{'time [s]':>22}"
             f"{'Lambda':>8}{'x_c':>7}{'speed-up':>9}{'equal':>7}{'c':>6}{'model':>7}{'cpu':>7}"]
    for scheme, row in rows:
        head = f"{scheme.family:<17}{scheme.setting:<9}"
        if "failed" in row:
            lines.append(f"{head} failed: {row['failed']}"[:100])
            continue
        reference = scheme is rows[0][0]
        time = median_range(row["time"], ".1f") if "time" in row else "-"
        lines.append(head + f"{row['seeds']:>5}"
                     + "".join(f"{'-' if reference else difference(row[q]):>20}" for q in QUANTITIES)
                     + f"{number(row, 'late', 'd'):>6}{time:>22}"
                     f"{number(row, 'Lambda', '.1f'):>8}{number(row, 'x_c', '.3f'):>7}"
                     f"{number(row, 'speedup', '.2f'):>9}{number(row, 'equal', '.2f'):>7}"
                     f"{number(row, 'c', '.2f'):>6}{number(row, 'model', '.2f'):>7}{number(row, 'cpu', '.0%'):>7}")
    return lines


def joined(*blocks):
    """Text of blocks of lines."""
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


def impact_text(args, elastic, damped):
    """Tables of the impacts."""
    blocks = [prose(f"""{processor()}, one core; wall-clock times are LAMMPS's loop times of all scenes of a scheme
                    together: median (smallest .. largest) of {args.repeat} round(s), in each of which every scheme ran
                    once. Numbers beside single rate, respa and N are omega dt of the stiffest
                    mode at rest; those beside auto are its safety, which counts the compression of
                    the hardest impact in view, too, so that omega dt at rest is smaller (see
                    Lambda); those beside tolerance are T, those beside f2 the particle step in
                    d/U, else 0.1, at the safety 0.15. late: contacts found late. blind: lookahead no, as the report
                    has it, safety 0.15; contacts that are first seen at the end of a particle step
                    have gained so much energy that particles may leave the box. Under respa the neighbour list is
                    rebuilt every particle step: it is checked after the inner steps only.""")]
    if elastic:
        blocks.append(elastic_lines(args, elastic))
    if damped and damped["rows"]:
        blocks.append(damped_lines(args, damped))
    return joined(*blocks)


def channel_text(args, rows):
    """Table of the channel."""
    return joined(prose(f"""{processor()}. Beside single rate: LAMMPS's step over that of the report, 2.5e-5 L/U; beside
                        respa and N: collision steps of a particle step of 0.1 d/U; beside auto: safety, or 0.3, and f2, the
                        particle step in d/U, else 0.1; beside tolerance: T."""), channel_lines(args, rows))


# ---------------------------------------------------------------------- plot


def draw_families(axis, rows, error, look):
    """One line for each family of schemes; error: of a row, as (value, error bar or 0)."""
    for family in COLOURS:
        points = [(Spread.of(row["time"]), *error(row)) for scheme, row in rows
                  if scheme.family == family and "time" in row and "failed" not in row]
        points = [point for point in points if point[1] > 0]
        if not points:
            continue
        times, values, bars = zip(*points)
        middle = np.array([t.middle for t in times])
        across = [middle - [t.low for t in times], [t.high for t in times] - middle]
        values, bars = np.array(values), np.nan_to_num(bars)
        axis.errorbar(middle, values, xerr=across, marker=MARKERS[family], color=COLOURS[family],
                      yerr=[np.minimum(bars, 0.9 * values), bars] if bars.any() else None,
                      elinewidth=0.8, capsize=2, **look)


def decades(axis):
    """Labels at 1, 2, 3 and 5 of each decade of both axes, which may be less than one long."""
    axis.set(xscale="log", yscale="log")
    for side in (axis.xaxis, axis.yaxis):
        side.set_major_formatter("{x:g}")
        side.set_minor_formatter(lambda x, _: f"{x:g}" if f"{x:e}"[0] in "235" else "")


def draw_impacts_panel(axis, elastic, damped):
    """Error of impacts over wall-clock time."""
    draw_families(axis, elastic, lambda row: (row["mean"], 0), {"linestyle": "-"})
    if damped:
        draw_families(axis, damped["rows"], lambda row: (row["mean"], 0),
                      {"linestyle": ":", "markerfacecolor": "none"})
    axis.plot([], [], "k-", label="elastic: mean |e - exact|, V > 1.2 $V_s$")
    axis.plot([], [], "k:", label="damped, oblique: mean error / V")
    axis.axhline(0.01, color="firebrick", linestyle=":", linewidth=0.9, label="wanted: 0.01")
    axis.set(title="impacts", xlabel="wall-clock time [s]", ylabel="mean error [-]")
    decades(axis)
    axis.yaxis.set_major_formatter("{x:.0e}")
    axis.yaxis.set_minor_formatter("")


def draw_sticking_panel(axis, args, elastic, damped):
    """Error of the sticking velocity over wall-clock time; what cannot be told from 0 at the bottom."""
    least = 100 * 0.6 / args.impacts    # one impact more that sticks [%]

    def error(row):
        return max(abs(100 * row["V_s pair"]), least / 2), 0

    draw_families(axis, elastic, error, {"linestyle": "-"})
    if damped:
        draw_families(axis, damped["rows"], error, {"linestyle": ":", "markerfacecolor": "none"})
    axis.plot([], [], "k-", label="elastic, beside the exact one")
    axis.plot([], [], "k:", label="damped, beside Runge-Kutta")
    axis.axhline(1, color="firebrick", linestyle=":", linewidth=0.9, label="wanted: 1 %")
    axis.axhline(least, color="0.4", linestyle="-.", linewidth=0.9, label="one impact of all; below: none")
    axis.set(title="sticking velocity of pairs", xlabel="wall-clock time [s]", ylabel="error of $V_s$ [%]")
    decades(axis)


def draw_channel_panel(axis, rows):
    """Difference from single rate over wall-clock time."""
    draw_families(axis, rows[1:],
                  lambda row: (100 * row["rms"].mean, 100 * row["rms"].error), {"linestyle": "-"})
    if "time" in rows[0][1]:
        axis.axvline(np.median(rows[0][1]["time"]), color="k", linewidth=0.9, linestyle="--",
                     label="single rate at the report's step")
    axis.axhline(100 * WANTED, color="firebrick", linestyle=":", linewidth=0.9, label="wanted: 1 %")
    axis.set(title="channel; bars: standard error of the mean over seeds",
             xlabel="wall-clock time of a shorter run [s]",
             ylabel="rms difference of four aggregate statistics [%]")
    decades(axis)


def nothing_timed(rows):
    """Whether there is nothing to draw errors over; says so."""
    missing = not any("time" in row for _, row in rows)
    if missing:
        print("no plot: nothing has been timed yet, --measure times does that", file=sys.stderr)
    return missing


def draw_impacts(args, elastic, damped, path):
    """Errors of e and of the sticking velocity over wall-clock time."""
    if nothing_timed([*elastic, *(damped["rows"] if damped else [])]):
        return
    draw([lambda axis: draw_impacts_panel(axis, elastic, damped),
          lambda axis: draw_sticking_panel(axis, args, elastic, damped)], path)


def draw_channel(rows, path):
    """Differences from single rate over wall-clock time."""
    if nothing_timed(rows):
        return
    draw([lambda axis: draw_channel_panel(axis, rows)], path)


def draw(parts, path):
    """Panels side by side, with one legend of all schemes."""
    figure, panels = plt.subplots(1, len(parts), figsize=(1.5 + 5 * len(parts), 5.4), squeeze=False)
    for part, axis in zip(parts, panels[0]):
        part(axis)
    for axis in panels[0]:
        axis.grid(True, which="major", color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
        axis.legend(fontsize=8, frameon=False)
    handles = [plt.Line2D([], [], color=COLOURS[f], marker=MARKERS[f], label=f) for f in COLOURS]
    figure.legend(handles=handles, loc="lower center", ncol=3 * len(parts), frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.12 / len(parts), 1, 1))
    figure.savefig(path, dpi=120)
    plt.close(figure)
