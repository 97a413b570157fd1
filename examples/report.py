"""What plot.py of the examples share: runs that LAMMPS wrote, numbers of the report, the table of both.

A run is a set of files NAME.*: the log, the history that fix ave/time wrote, profiles and histograms. Numbers
of the report are in report.csv of an example; ours, once kept, in its folder results: values.csv (case, quantity,
ours, spread, t) and runs.csv (what each run cost, its parameters). Needs Debian's python3-numpy and
python3-matplotlib.
"""
import argparse
import csv
import re
import sys
from dataclasses import dataclass
from fnmatch import fnmatchcase
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from PIL import Image    # matplotlib needs it, too

sys.path.append(str(Path(__file__).resolve().parent.parent / "tools"))
import apf_read
from apf_read import stop

COSTS = ["wall-clock [s]", "CPU [s]", "MB"]
HEADS = ["case", "figure", "quantity", "report", "ours", "difference", "verdict", "the report says"]


# ---------------------------------------------------------------------- runs


def read_history(path):
    """Columns of fix ave/time by name, as in the file's second line; of at least two times."""
    history = apf_read.read_history(path)
    if len(history.rows) < 2:
        stop(path, "holds no numbers of two times yet")
    return {name.split("[")[0]: history[name] for name in history.names}


def read_blocks(path):
    """Blocks of fix ave/chunk or ave/histo: list of (step, rows of numbers); whole blocks only, none in a short run."""
    return [(block.step, block.rows) for block in apf_read.whole_blocks(path)]


def memory(log):
    """The largest resident memory of a rank [MB] that a log tells; empty if none."""
    found = re.findall(r"^Maximum resident set size: (\S+)", log, re.M)
    return f"{max(map(float, found)):.0f}" if found else ""


class Run:
    """One run: `history` over the times `t`, blocks of other files, what it cost."""

    def __init__(self, path, prefix, steps=None):
        """From its history; `steps` in a unit of time, where the history has no column t."""
        self.path, self.name = path, path.stem.removeprefix(prefix)
        self.history = read_history(path)
        step = self.history["step"]
        self.t = step / steps if steps else self.history["t"]
        self.unit = steps or (step[-1] - step[0]) / (self.t[-1] - self.t[0])    # t may be a mean over steps

    def log(self):
        """Text of the log; empty where there is none."""
        path = self.path.with_suffix(".log")
        return path.read_text(errors="replace") if path.is_file() else ""

    def blocks(self, suffix):
        """Times and rows of the blocks of another file of the run."""
        blocks = read_blocks(self.path.with_suffix(suffix))
        return np.array([step for step, _ in blocks]) / self.unit, [rows for _, rows in blocks]

    def totals(self, suffix):
        """What the line before the last block of another file tells after step and number of rows."""
        return apf_read.whole_blocks(self.path.with_suffix(suffix))[-1].totals

    def pictures(self, kind=""):
        """Times and paths of the pictures NAME{kind}.STEP.png."""
        paths = sorted(self.path.parent.glob(f"{self.path.stem}{kind}.{'[0-9]' * 9}.png"))
        return [int(path.suffixes[-2][1:]) / self.unit for path in paths], paths

    def last(self, key, share=0.2):
        """Mean and standard deviation in time of a column over the last share of the run."""
        values = self.history[key][self.t >= (1 - share) * self.t[-1] - 1e-6]
        return values.mean(), values.std(ddof=1) if len(values) > 1 else np.nan

    def ending(self):
        """What the script printed at its end (pass: ..., FAIL: ...); empty as long as it runs."""
        ends = [line for line in self.log().split("\n") if line[:5] in ("pass:", "FAIL:")]
        return ends[-1] if ends else ""

    def cost(self, words):
        """Row of runs.csv: `words`, then law, drag, inlet and timestep of the log, and what all pieces cost together.

        Times are those of the steps which the log has a time for, scaled to all, if these are
        more than half: a piece that was ended from outside has none.
        """
        text = self.log()
        law = re.findall(r"^pair_coeff +1 1 ([^$\n]+)$", text, re.M)
        drag = re.findall(r"^fix +drag all flow/force \S+ (drag [^$\n]+)$", text, re.M)
        inlet = re.findall(r"^fix +in all inlet/flow x (\S+) \S+ ([a-z]+) ([^$\s]+) (?:every (\d+) )?diameter [^$\n]+$", text, re.M)
        step = re.findall(r"^timestep +([^$\n]+)$", text, re.M)
        loops = np.array(re.findall(r"^Loop time of (\S+) on (\d+) procs for (\d+) steps(?s:.*?)^ *(\S+)% CPU use",
                                    text, re.M), dtype=float).reshape(-1, 4)
        seconds, ranks, steps, share = loops[loops[:, 2] > 0].T
        row = {"run": self.path.stem, "t": f"{self.t[-1]:g}", "ranks": "", **dict.fromkeys(COSTS, "")}
        if len(steps):
            scale = (self.history["step"][-1] - self.history["step"][0]) / steps.sum()
            row["ranks"] = f"{ranks.max():.0f}"
            if scale < 2:
                used = seconds * ranks * share / 100
                row.update({COSTS[0]: f"{seconds.sum() * scale:.0f}", COSTS[1]: f"{used.sum() * scale:.0f}"})
        row[COSTS[2]] = memory(text)
        settings = [words, *law[-1:], *drag[-1:],
                    *(f"inlet at x = {float(x):g}, {kind} {value}" + (f" every {every} steps" if every else "")
                      for x, kind, value, every in inlet[-1:]),
                    *(f"timestep {float(number):.4g}" for number in step[-1:])]
        return {**row, "parameters": "; ".join(part.strip() for part in settings)}


def read_runs(folder, pattern, make, keep_in=None):
    """All runs of a folder whose history's name fits the pattern; make(path) is a Run.

    `keep_in`: the example that will keep them; refuses before anything of it is replaced.
    """
    runs = [make(path) for path in sorted(folder.glob(pattern))]
    if not runs:
        stop(folder / pattern, "missing; run the input script with -var dir first")
    if keep_in:
        refuse_shorter(keep_in, {run.path.stem: run.t[-1] for run in runs})
    return runs


def those_with(runs, has, what, figures):
    """The runs that have what the figures need; a line names the others, and says what becomes of the figures."""
    some = [run for run in runs if has(run)]
    short = ", ".join(f"{run.path.stem} (t = {run.t[-1]:g})" for run in runs if run not in some)
    if short:
        print(f"{figures}: no {what} yet of {short}; {'drawn without' if some else 'not drawn'}", file=sys.stderr)
    return some


def trimmed(image):
    """A picture without its white margins."""
    inked = image[..., :3].min(axis=2) < 0.95
    rows, columns = (np.flatnonzero(inked.any(axis=axis)) for axis in (1, 0))
    return image[rows[0]:rows[-1] + 1, columns[0]:columns[-1] + 1] if len(rows) else image


def draw_pictures(pictures, columns, path, size=(3.1, 2.7), trim=False, circle=None):
    """Pictures of (title, file) in rows, each of this size in inches, None for none; `trim` takes white margins off.

    `circle` is the radius, in pixels, of a grey disc around the middle of each, whose middle square is shown.
    """
    rows = -(-len(pictures) // columns)
    figure, axes = plt.subplots(rows, columns, figsize=(size[0] * columns, size[1] * rows), squeeze=False,
                                layout="constrained")
    for axis in axes.flat:
        axis.axis("off")
    for axis, picture in zip(axes.flat, pictures):
        if picture is None:
            continue
        title, file = picture
        image = plt.imread(file)
        axis.imshow(trimmed(image) if trim else image)
        if circle:
            height, width = image.shape[:2]
            axis.set_xlim((width - height) / 2, (width + height) / 2)
            axis.add_patch(plt.Circle((width / 2, height / 2), circle, facecolor="0.85", edgecolor="0.4"))
        axis.set_title(title, fontsize=9)
    figure.savefig(path, dpi=110, bbox_inches="tight")
    with Image.open(path) as image:    # a palette that keeps rare colours: a third of the size
        small = image.convert("RGB").quantize(256, Image.Quantize.MAXCOVERAGE)
    small.save(path, optimize=True)


# ---------------------------------------------------------------------- the report's numbers beside ours


@dataclass
class Ours:
    """A number of ours, its standard deviation in time if known, and the time that was reached."""

    value: float
    spread: float = np.nan
    t: float = np.nan


def read_csv(path):
    """Rows as dicts; lines that begin with # are comments; none where there is no file."""
    if not path.is_file():
        return []
    with open(path, encoding="ascii") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def write_csv(path, rows):
    """Rows of dicts, whole or not at all; there must be one."""
    path.parent.mkdir(exist_ok=True)
    draft = path.with_suffix(".draft")
    with open(draft, "w", encoding="ascii", newline="") as file:
        writer = csv.DictWriter(file, list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    draft.replace(path)


def read_report(path):
    """Rows of report.csv; low, value, high are floats, nan where the report has none."""
    rows = read_csv(path)
    for row in rows:
        row.update({key: float(row[key] or "nan") for key in ("low", "value", "high")})
    return rows


def outside(row, value):
    """How far a value lies above (> 0) or below (< 0) the report's range; 0 inside."""
    if value < row["low"]:
        return value - row["low"]
    return value - row["high"] if value > row["high"] else 0.0


def verdict(row, ours):
    """Words for one row: too short a run, no number to compare with, or agreement.

    What reaches the range by its spread, but varies by more than the range is wide and by more than half of itself, is no number.
    """
    since = float(row.get("for_t", "").strip("=> ") or 0)
    if ours.t < since - 1e-6:
        return f"not reached: run ended at t = {ours.t:g}"
    if np.isnan(ours.value):
        return "not reached"
    if np.isnan(row["low"]) and np.isnan(row["high"]):
        return "no number"
    off, spread = abs(outside(row, ours.value)), np.nan_to_num(ours.spread)
    if off > spread:
        return "differs"
    if spread > row["high"] - row["low"] and spread > abs(ours.value) / 2:
        return f"no number: varies by {spread:.2g}"
    return "agrees within our spread" if off else "agrees"


def said(row):
    """The report's value with its reading error, or its range."""
    low, value, high = row["low"], row["value"], row["high"]
    if not np.isnan(value):
        return f"{value:g}" + (f" +- {high - value:.2g}" if high > value else "")
    if np.isnan(low):
        return "in words" if np.isnan(high) else f"< {high:g}"
    return f"{low:g} .. {high:g}" if not np.isnan(high) else f"> {low:g}"


def compare(report, values):
    """Rows of the table report / ours: all our cases that fit the pattern of the report's case."""
    table = []
    for row in report:
        for (case, quantity), ours in values.items():
            if quantity == row["quantity"] and fnmatchcase(case, row["case"]):
                table.append(dict(zip(HEADS, (case, row["figure"], quantity.replace("_", " "), said(row),
                                              *in_words(row, ours), verdict(row, ours), row["words"]))))
    return table


def in_words(row, ours):
    """Our value with its spread, and its difference from the report's value or range."""
    if np.isnan(ours.value):
        return "", ""
    known = not np.isnan(row["value"])
    difference = ours.value - row["value"] if known else outside(row, ours.value)
    spread = "" if not ours.spread > 1e-6 * abs(ours.value) else f" ({ours.spread:.2g})"
    return f"{ours.value:.3g}{spread}", f"{difference:+.2g}" if known or difference else ""


def text_of(rows):
    """Rows of dicts as text with aligned columns; empty if there are none."""
    if not rows:
        return ""
    lines = [list(rows[0]), *(list(row.values()) for row in rows)]
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    return "".join("  ".join(w.ljust(n) for w, n in zip(line, widths)).rstrip() + "\n" for line in lines)


def read_kept(example):
    """Values by (case, quantity), and rows of runs.csv, that an example has kept."""
    values = {(row["case"], row["quantity"]): Ours(*(float(row[key] or "nan") for key in ("ours", "spread", "t")))
              for row in read_csv(example / "results" / "values.csv")}
    return values, {row["run"]: row for row in read_csv(example / "results" / "runs.csv")}


def refuse_shorter(example, reached):
    """Stops if a run ended before the kept one of its name, as a quick run does; `reached` are times by names of runs."""
    path, kept = example / "results" / "runs.csv", read_kept(example)[1]
    for name, t in reached.items():
        if name in kept and t < 0.999 * float(kept[name]["t"]):
            stop(path, f"{name} is kept to t = {kept[name]['t']}, this run ended at {t:g}; nothing is kept. "
                 "To keep it all the same delete its line there first")


def keep(example, values, runs):
    """Adds values and runs to those that the example has kept; its whole set. Refuses a run that is shorter than the kept one."""
    refuse_shorter(example, {row["run"]: float(row["t"]) for row in runs})
    kept_values, kept_runs = read_kept(example)
    values, runs = {**kept_values, **values}, {**kept_runs, **{row["run"]: row for row in runs}}

    def number(value, form):
        return "" if np.isnan(value) else format(value, form)

    write_csv(example / "results" / "values.csv",
              [{"case": case, "quantity": quantity, "ours": number(ours.value, ".6g"),
                "spread": number(ours.spread, ".3g"), "t": number(ours.t, "g")}
               for (case, quantity), ours in sorted(values.items())])
    write_csv(example / "results" / "runs.csv", [runs[name] for name in sorted(runs)])


# ---------------------------------------------------------------------- a plot.py


def arguments(words, example):
    """Command line of a plot.py: folder with the runs, folder for figures and table, whether to keep."""
    parser = argparse.ArgumentParser(description=words)
    parser.add_argument("dir", nargs="?", default=".", type=Path, help="folder with the output (default .)")
    parser.add_argument("--keep", action="store_true",
                        help="put figures and numbers into the example's folder, in place of DIR")
    args = parser.parse_args()
    return args.dir, example if args.keep else args.dir, args.keep


def values_by_run(runs, values_of):
    """Our numbers by (run, quantity): those of values_of(run), each an Ours or a bare number."""
    return {(run.name, key): value if isinstance(value, Ours) else Ours(value, t=run.t[-1])
            for run in runs for key, value in values_of(run).items()}


def conclude(example, values, runs, out, kept):
    """Prints the table report / ours and what the runs cost; writes both to out/compare.txt, or keeps the numbers."""
    table = text_of(compare(read_report(example / "report.csv"), values))
    text = (table or "no number to compare with the report's\n") + "\n" + text_of(runs)
    print(text, end="")
    if kept:
        keep(example, values, runs)
    else:
        (out / "compare.txt").write_text(text)
