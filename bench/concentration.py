#!/usr/bin/python3
"""Cost of fix flow/concentration: direct sum of clouds against convolution with FFTW.

    concentration.py [--quick] [--repeat N] [--results DIR] [--lmp FILE]

Prints, and writes to results/concentration.txt: time for a grid by both methods, by the radius of the
clouds in cells, number of particles, borders and dimension; which one `method auto` would take by the
estimate in src; and the coefficients of that estimate that fit these times best. Needs Debian's
python3-numpy.
"""
import argparse
import re
import tempfile
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lammps_runs import HERE, Failure, count, keep_table, parse, processor, results_option, run_lammps, stop

REACH = 4.0    # of a cloud, in radii
# ns: a cell of a cloud, a cell along one axis of it, and a cell of the grid with its ghosts, as in
# cloud_sum.cpp; a weight of a spline, and a cell of the grid at each doubling of their number, as
# in cloud_convolution.cpp
COSTS = {"direct": [0.3, 14.0, 4.0], "fft": [0.9, 0.8]}


@dataclass(frozen=True)
class Case:
    """A grid and particles on it."""

    dim: int
    n: int          # cells along an axis
    cells: float    # radius of a cloud over the width of a cell
    number: int     # particles
    border: str = "p"

    def splines(self):
        """Order of the splines, as cloud_spectrum.h has it."""
        k = np.pi * (np.arange(600) + 0.5) / 200
        cloud = np.exp(-0.25 * (k * self.cells) ** 2) * abs(np.sinc(0.5 * k / np.pi))
        k, first, beyond = k[:200], cloud[:200], cloud[200:].sum()

        def error(order):
            waves = sum((k / (2 * np.pi * m + sign * k)) ** order for m in (1, 2, 3) for sign in (-1, 1))
            return 3 * ((first * waves).sum() + beyond) / first.sum()

        return next((order for order in range(3, 12) if error(order) <= 1e-6), 12)

    def work(self):
        """What each method does, in the units of COSTS."""
        width, order = 2 * int(np.ceil(REACH * self.cells)) + 1, self.splines()
        closed = self.border == "f"
        ghosts = 0 if closed else width
        margin = int(np.ceil(REACH * self.cells)) + order + 3 if closed else 0
        size = float(self.n + margin) ** self.dim
        return {"direct": np.array([self.number * min(width, self.n) ** self.dim,
                                    self.number * self.dim * width, (self.n + ghosts) ** self.dim],
                                   dtype=float),
                "fft": np.array([(1 + closed) * self.number * order ** self.dim, size * np.log2(size)],
                                dtype=float)}


def cases(quick):
    """Grids of every kind: crossing of the two methods in the middle."""
    out = []
    for cells in (3, 6) if quick else (2.6, 3, 4, 6, 7.9):
        out += [Case(3, 64, cells, number) for number in (100, 1000, 10000)]
        out += [Case(3, 64, cells, 1000, "f"), Case(2, 512, cells, 10000), Case(2, 512, cells, 100000)]
    return out + ([] if quick else [Case(3, 128, 4, 1000), Case(3, 128, 4, 10000)])


def seconds(args, case, method, folder):
    """Time of one grid: LAMMPS's section Modify, less the particles at rest."""
    steps = 1 if case.number * (2 * REACH * case.cells) ** case.dim > 1e9 else 5
    text = run_lammps(args.lmp, HERE / "in.concentration",
                      dict(n=case.n, dim=case.dim, cells=case.cells, number=case.number,
                           method=method, border=case.border, steps=steps), folder)
    return float(re.findall(r"^Modify\s*\|\s*([\d.e+-]+)", text, re.M)[-1]) / steps


def measure(args, folder):
    """Times of all cases by (case, method): every one once, then all of them again."""
    times = {}
    for _ in range(args.repeat):
        for case in cases(args.quick):
            for method in ("direct", "fft"):
                try:
                    times.setdefault((case, method), []).append(seconds(args, case, method, folder))
                except Failure as failure:
                    stop(f"{case}, {method}: {failure}")
    return times


def fit(rows, work):
    """Coefficients >= 0 that fit the logarithms of the times best, in ns."""
    work, times = np.array(work), 1e9 * np.array(rows)
    x = np.full(work.shape[1], 1.0)
    for _ in range(20000):    # multiplicative steps keep them positive
        model = work @ x
        x *= np.exp(0.5 * (work * x / model[:, None] * np.log(times / model)[:, None]).mean(axis=0))
    return x


def report(times, repeat):
    """Lines of the table."""
    lines = [f"{processor()}, one core; median of {repeat} runs, times in ms", "",
             f"{'dim':>3}{'grid':>6}{'border':>8}{'R/dx':>6}{'particles':>11}{'direct':>10}{'fft':>10}"
             f"{'ratio':>8}{'smallest .. largest':>22}  auto"]
    data = {"direct": ([], []), "fft": ([], [])}
    for case in dict.fromkeys(case for case, _ in times):
        work = case.work()
        runs = {method: np.array(times[case, method]) for method in work}
        for method, values in runs.items():
            data[method][0].append(np.median(values))
            data[method][1].append(work[method])
        ratio = runs["direct"] / runs["fft"]
        chosen = min(work, key=lambda method: work[method] @ COSTS[method])
        loss = np.median(ratio if chosen == "direct" else 1 / ratio)
        lines.append(f"{case.dim:>3}{case.n:>6}{'open' if case.border == 'p' else 'closed':>8}"
                     f"{case.cells:>6}{case.number:>11}{1e3 * np.median(runs['direct']):>10.2f}"
                     f"{1e3 * np.median(runs['fft']):>10.2f}{np.median(ratio):>8.2f}"
                     f"{f'{ratio.min():.2f} .. {ratio.max():.2f}':>22}  {chosen}"
                     + (f", {loss:.2f} times as long" if loss > 1.0 else ""))
    lines.append("")
    for method, (values, work) in data.items():
        fitted = " ".join(f"{x:.2f}" for x in fit(values, work))
        used = " ".join(f"{x:.2f}" for x in COSTS[method])
        lines.append(f"estimate [ns]: {method:<7} used {used}, fitted {fitted}")
    return lines


def main():
    """Command line."""
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--quick", action="store_true", help="few cases")
    parser.add_argument("--repeat", type=count, default=3, help="runs of each")
    results_option(parser)
    parser.add_argument("--lmp", default=str(HERE.parent / "lmp"))
    args = parse(parser)
    with tempfile.TemporaryDirectory() as folder:
        times = measure(args, Path(folder))
    text = "\n".join(report(times, args.repeat)) + "\n"
    keep_table(text, args.results, "concentration")


if __name__ == "__main__":
    main()
