"""Bars of what the scripts here measured: a group for each name, a colour for each series."""
from dataclasses import dataclass

import numpy as np

WIDTH = 0.8    # of a group; groups are 1 apart
COLOURS = {"2-D": "#0072B2", "3-D": "#E69F00",
           "baseline": "#56B4E9", "avx2": "#0072B2", "avx512": "#E69F00", "unsorted": "0.6"}


@dataclass(frozen=True)
class Spread:
    """A median, and the ends of its whisker."""

    low: float
    middle: float
    high: float

    @classmethod
    def of(cls, values):
        """Of the values of all runs."""
        return cls(min(values), float(np.median(values)), max(values))

    @classmethod
    def around(cls, median, variation):
        """With the coefficient of variation to both sides."""
        return cls(median * (1 - variation), median, median * (1 + variation))


def place(names, series, name, label):
    """Middle of a bar and half its width; names: of the groups, series: labels of all bars."""
    width = WIDTH / len(series)
    return names.index(name) + (series.index(label) - (len(series) - 1) / 2) * width, 0.45 * width


def draw_bars(axis, names, series, digits=0):
    """Draws series, {label: {name: Spread}}, in groups in the order of the names."""
    labels = list(series)
    for label, spreads in series.items():
        at = [place(names, labels, name, label)[0] for name in spreads]
        middle = np.array([s.middle for s in spreads.values()])
        whiskers = (middle - [s.low for s in spreads.values()],
                    [s.high for s in spreads.values()] - middle)
        bars = axis.bar(at, middle, 0.9 * WIDTH / len(labels), yerr=whiskers, capsize=2,
                        color=COLOURS[label], label=label, error_kw={"lw": 0.8})
        axis.bar_label(bars, fmt=f"%.{digits}f", padding=2, fontsize=7)
    axis.set_xticks(range(len(names)), names)
    axis.spines[["top", "right"]].set_visible(False)


def mark(axis, names, series, values, **look):
    """A short line across bars at values, {(label, name): value}."""
    places = [place(names, list(series), name, label) for label, name in values]
    axis.hlines(list(values.values()), [at - half for at, half in places],
                [at + half for at, half in places], **look)
