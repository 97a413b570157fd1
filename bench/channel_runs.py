"""The channel of speed_error.py and channel_phi.py: schemes, runs, differences from the single rate."""
import re
import shutil
from dataclasses import dataclass, field

import numpy as np

from lammps_runs import CHANNEL, read_log, read_time, run_lammps, stop

QUANTITIES = {"in agg.": 2, "number": 3, "size": 4, "wall": 5}    # columns of .aggregates


@dataclass(frozen=True)
class ChannelScheme:
    """A way to step the channel in time."""

    family: str
    setting: str
    integrate: str
    step: float          # LAMMPS's timestep                          [L/U]
    respa: int = 0
    skin: int = 1        # neighbour skin                             [d]

    name = property(lambda self: f"{self.family} {self.setting}")


def channel_schemes():
    """All schemes, the reference first."""
    def sub(family, setting, words, f2=0.1):
        return ChannelScheme(family, setting, f"nve/sphere/mts collision {words}", 0.01 * f2,
                             skin=1 if f2 <= 0.1 else 2)

    return [ChannelScheme("single rate", "report", "nve/sphere", 2.5e-5),
            ChannelScheme("single rate", "half", "nve/sphere", 1.25e-5),
            ChannelScheme("respa", "N=40", "nve/sphere", 1e-3, 40),
            sub("mts collision N", "N=40", "40"),
            sub("mts auto", "0.3", "auto"),
            sub("mts tolerance", "0.01", "tolerance 0.01"),
            sub("mts tolerance", "0.001", "tolerance 0.001"),
            *(sub("mts auto, f2", f"{f2:g}", "auto", f2) for f2 in (0.05, 0.2))]


def channel_script(folder, scheme):
    """Copy of in.channel with the scheme's skin; r-RESPA has air forces at its outer level."""
    changes = [(r"^neighbor .*", f"neighbor $({scheme.skin}*v_d) bin")]
    if scheme.respa:
        words = f"run_style respa 2 {scheme.respa} pair 1\nfix_modify wall respa 1\n"
        changes.append((r"^(?=run +\$\{steps\})", words))
    text = CHANNEL.read_text()
    for pattern, words in changes:
        text, found = re.subn(pattern, words, text, flags=re.M)
        if found != 1:
            stop(f"{CHANNEL}: one line expected that matches {pattern}, got {found}")
    copy = folder / "in.channel"
    copy.write_text(text)
    return copy


def run_channel(args, scheme, seed, time, phi="50"):
    """One run to that time: log, and quantities averaged over the last fifth."""
    folder = args.work / "scratch-channel"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    variables = {"integrate": scheme.integrate, "step": scheme.step, "seed": seed, "t": time,
                 "phi": phi, "dir": folder, "picture": 2 * time + 1}
    run_lammps(args.lmp, channel_script(folder, scheme), variables, folder, args.ranks)
    log = (folder / f"channel-phi{phi}.log").read_text()
    rows = np.loadtxt(folder / f"channel-phi{phi}.aggregates", ndmin=2)
    last = rows[rows[:, 1] >= 0.8 * time - 1e-6]
    return dict(read_log(log), **{name: float(last[:, k].mean())
                                  for name, k in QUANTITIES.items()})


def channel_rows(args, store):
    """Results of each scheme by seed, as far as they ran; all schemes of a seed, then the next."""
    rows = {scheme: {} for scheme in channel_schemes()}
    for seed in range(4711, 4711 + args.seeds):
        for scheme, results in rows.items():
            result = store.get(f"channel t={args.time:g} np={args.ranks} {scheme.name} {seed}",
                               lambda s=scheme, seed=seed: run_channel(args, s, seed,
                                                                       args.time))
            if result is not None:
                results[seed] = result
    return rows


def channel_times(args, store):
    """Time of each scheme to args.clock, where that has been measured."""
    return {scheme: store.get(f"time of channel t={args.clock:g} np={args.ranks} {scheme.name}",
                              lambda s=scheme: read_time(run_channel(args, s, 4711, args.clock)),
                              "times") for scheme in channel_schemes()}


def speed(scheme, own, reference):
    """Cost and speed-up of one scheme, from its time and that of the reference."""
    if not own or not reference or "loop" not in own or "loop" not in reference:
        return {}
    row = {"time": own["loop"], "cpu": own["cpu"], "speedup": reference["loop"] / own["loop"]}
    if "Lambda" in own:
        sub_steps = own["x_c"] * own["Lambda"]    # of a particle, in a particle step
        steps = scheme.step / 2.5e-5              # of single rate, in the same time
        row.update(Lambda=own["Lambda"], x_c=own["x_c"], model=own["Lambda"] / (1 + sub_steps),
                   equal=steps / (1 + sub_steps), c=(steps / row["speedup"] - 1) / sub_steps)
    return row


def channel_errors(results, reference):
    """Relative differences from the reference's mean; both lists of results, of the same seeds."""
    mean = {q: np.mean([r[q] for r in reference]) for q in QUANTITIES}
    row = {"seeds": len(results)}
    if "Lambda" in results[0]:
        row["late"] = sum(r["late"] for r in results)
    for q in QUANTITIES:
        row[q] = np.mean([r[q] for r in results]) / mean[q] - 1 if mean[q] else np.nan
    row["rms"] = np.sqrt(np.nanmean([row[q] ** 2 for q in QUANTITIES]))
    return row


def seed_spread(reference):
    """Standard deviation over seeds, relative to the mean; nan with one seed."""
    out = {}
    for q in QUANTITIES:
        values = np.array([r[q] for r in reference])
        out[q] = values.std(ddof=1) / values.mean() if len(values) > 1 and values.any() else np.nan
    out["rms"] = np.sqrt(np.mean([out[q] ** 2 for q in QUANTITIES]))
    return out


@dataclass
class Channel:
    """What is known about the channel."""

    rows: list = field(default_factory=list)     # (scheme, row)
    spread: dict = field(default_factory=dict)   # of the reference over seeds


def channel_set(args, store):
    """Rows of the channel; empty as long as the reference has not run."""
    found, times = channel_rows(args, store), channel_times(args, store)
    clock = next(iter(times.values()))
    good = {scheme: {seed: r for seed, r in results.items() if "failed" not in r}
            for scheme, results in found.items()}
    reference = next(iter(good.values()))
    if not reference:
        return Channel()
    rows = []
    for scheme, results in found.items():
        both = [seed for seed in good[scheme] if seed in reference]
        if both:
            row = channel_errors([good[scheme][seed] for seed in both],
                                 [reference[seed] for seed in both])
            rows.append((scheme, dict(row, **speed(scheme, times[scheme], clock))))
        elif results:
            failed = [r["failed"] for r in results.values() if "failed" in r]
            rows.append((scheme, {"failed": failed[0] if failed else "the reference did not run"}))
    return Channel(rows, seed_spread(list(reference.values())))
