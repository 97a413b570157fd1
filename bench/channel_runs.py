"""The channel of speed_error.py and channel_phi.py: schemes, runs, differences from the single rate."""
import re
import shutil
from dataclasses import dataclass

import numpy as np

from lammps_runs import CHANNEL, read_log, read_time, run_lammps, stop

PARTICLES = 8000    # in.channel loses none
QUANTITIES = {"in agg.": 2, "number": 3, "size": 4, "wall": 5}    # columns of .aggregates

# of channel_schemes(), where two of them are compared
TWO_WAYS = {"single rate 1": "single rate", "mts tolerance 0.01": "mts"}


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

    return [*(ChannelScheme("single rate", f"{n:g}", "nve/sphere", n * 2.5e-5) for n in (1, 0.5, 2)),
            ChannelScheme("respa", "N=40", "nve/sphere", 1e-3, 40),
            sub("mts collision N", "N=40", "40"),
            *(sub("mts auto", f"{safety:g}", f"auto safety {safety:g}") for safety in (0.15, 0.3, 0.6)),
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
            if args.schemes and scheme.name not in args.schemes:
                continue
            result = store.get(f"channel t={args.time:g} np={args.ranks} {scheme.name} {seed}",
                               lambda s=scheme, seed=seed: run_channel(args, s, seed,
                                                                       args.time))
            if result is not None:
                results[seed] = result
    return rows


def channel_times(args, store):
    """Times of each scheme to args.clock, a list of rounds as far as they ran; in turn."""
    times = {scheme: [] for scheme in channel_schemes()}
    for n in range(args.repeat):
        for scheme, results in times.items():
            if args.schemes and scheme.name not in args.schemes:
                continue
            result = store.get(
                f"time of channel t={args.clock:g} np={args.ranks} {scheme.name} round {n + 1}",
                lambda s=scheme: read_time(run_channel(args, s, 4711, args.clock)), "times")
            results.append(result if result and "loop" in result else None)
    return times


def speed(scheme, own, reference):
    """Cost and speed-up of one scheme, from its time and that of the reference."""
    row = {"time": own["loop"], "cpu": own["cpu"], "speedup": reference["loop"] / own["loop"]}
    if "Lambda" in own:
        sub_steps = own["x_c"] * own["Lambda"]    # of a particle, in a particle step
        steps = scheme.step / 2.5e-5              # of single rate, in the same time
        row.update(Lambda=own["Lambda"], x_c=own["x_c"], model=own["Lambda"] / (1 + sub_steps),
                   equal=steps / (1 + sub_steps),
                   c=(steps / row["speedup"] - 1) / sub_steps if sub_steps else np.nan)
    return row


def speeds(scheme, own, reference):
    """What speed() says of each round in which both ran, as lists by name."""
    rows = [speed(scheme, *both) for both in zip(own, reference) if all(both)]
    return {name: [row[name] for row in rows] for name in (rows[0] if rows else ())}


@dataclass(frozen=True)
class Difference:
    """Mean of relative differences from single rate at the same seed, and its standard error."""

    mean: float
    error: float    # nan with one seed

    @classmethod
    def of(cls, own, reference):
        """Of a quantity, by seed."""
        apart = (np.array(own) - reference) / np.mean(reference)
        return cls(apart.mean(), apart.std(ddof=1) / np.sqrt(len(apart)) if len(apart) > 1 else np.nan)

    def within(self, limit):
        """True: within two standard errors; False: beyond, by as much; None: the seeds do not tell."""
        if np.isnan(self.error):
            return None
        if abs(self.mean) + 2 * self.error <= limit:
            return True
        return None if abs(self.mean) - 2 * self.error <= limit else False


def channel_errors(results, reference):
    """Differences from the reference; both lists of results, of the same seeds."""
    row = {"seeds": len(results)}
    if "Lambda" in results[0]:
        row["late"] = sum(r["late"] for r in results)
    for q in QUANTITIES:
        values = [r[q] for r in reference]
        row[q] = Difference.of([r[q] for r in results], values) if any(values) else Difference(np.nan, np.nan)
    row["rms"] = Difference(*(np.sqrt(np.nanmean([part(row[q]) ** 2 for q in QUANTITIES]))
                              for part in (lambda d: d.mean, lambda d: d.error)))
    return row


def channel_set(args, store):
    """Rows (scheme, row) of the channel; empty as long as the reference has not run."""
    found, times = channel_rows(args, store), channel_times(args, store)
    clock = next(iter(times.values()))
    good = {scheme: {seed: r for seed, r in results.items() if "failed" not in r}
            for scheme, results in found.items()}
    reference = next(iter(good.values()))
    rows = []
    for scheme, results in found.items():
        both = [seed for seed in good[scheme] if seed in reference]
        if both:
            row = channel_errors([good[scheme][seed] for seed in both],
                                 [reference[seed] for seed in both])
            rows.append((scheme, dict(row, **speeds(scheme, times[scheme], clock))))
        elif reference and results:
            rows.append((scheme, {"failed": next(r["failed"] for r in results.values() if "failed" in r)}))
    return rows
