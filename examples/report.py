"""What plot.py of the examples share: files that LAMMPS wrote, numbers of the report, the table of both.

Needs Debian's python3-numpy and python3-matplotlib.
"""
import csv
import re
import sys

import numpy as np


def stop(path, reason):
    """Ends with exit code 1 and a message that names the file."""
    sys.exit(f"{path}: {reason}")


def read_rows(path):
    """Rows of numbers of a file that LAMMPS's fix ave/* wrote, without a last line that is cut off."""
    if not path.is_file():
        stop(path, "missing; the example's input script writes it")
    lines = path.read_text().split("\n")[:-1]
    return [[float(word) for word in line.split()] for line in lines if line[:1] != "#"]


def read_history(path):
    """Columns of fix ave/time by name, as in the file's second line."""
    rows = read_rows(path)
    names = [name.split("[")[0] for name in path.read_text().splitlines()[1].lstrip("# ").split()]
    rows = [row for row in rows if len(row) == len(names)]
    if not rows:
        stop(path, "holds no numbers yet")
    return dict(zip(names, np.array(rows).T))


def read_blocks(path):
    """Blocks of fix ave/chunk or ave/histo: list of (step, rows of numbers); whole blocks only."""
    rows, blocks = read_rows(path), []
    while rows:
        step, bins = rows[0][0], int(rows[0][1])
        if len(rows) > bins:
            blocks.append((step, np.array(rows[1:bins + 1])))
        rows = rows[bins + 1:]
    if not blocks:
        stop(path, "holds no block yet")
    return blocks


def read_log(path):
    """Wall-clock time of all runs [s] and largest memory [MB] in a log."""
    text = path.read_text()
    times = [float(word) for word in re.findall(r"^Loop time of (\S+)", text, re.M)]
    memory = [float(word) for word in re.findall(r"^Maximum resident set size: (\S+)", text, re.M)]
    return sum(times), max(memory, default=np.nan)


def read_report(path):
    """Rows of report.csv as dicts; low, value, high are floats, nan where the report has none."""
    with open(path, encoding="ascii") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    for row in rows:
        row.update({key: float(row[key] or "nan") for key in ("low", "value", "high")})
    return rows


def verdict(row, ours):
    """Words for one row: agreement within the report's range, or not."""
    if np.isnan(ours):
        return "not reached"
    return "differs" if ours < row["low"] or ours > row["high"] else "agrees"


def table(report, values, runs, path):
    """Writes and prints report / ours / difference / verdict, and the runs with what they cost.

    values: of (case, quantity), nan for a time that a run has not reached; rows of cases that were
    not run are left out. runs: of a name, words on its parameters and its log.
    """
    lines = [("case", "fig.", "quantity", "report", "ours", "diff.", "verdict", "the report says")]
    for row in report:
        ours = values.get((row["case"], row["quantity"]))
        if ours is None:
            continue
        said, known = row["value"], not np.isnan(row["value"])
        range_ = f"{row['low']:g} .. {row['high']:g}".replace("nan .. ", "< ").replace(" .. nan", " <")
        lines.append((row["case"], row["figure"], row["quantity"], f"{said:g}" if known else range_,
                      f"{ours:.3g}", f"{ours - said:+.2g}" if known else "", verdict(row, ours),
                      row["words"]))
    widths = [max(len(line[k]) for line in lines) for k in range(len(lines[0]))]
    text = "\n".join("  ".join(w.ljust(n) for w, n in zip(line, widths)).rstrip() for line in lines)
    text += "\n\n"
    for name, (words, log) in runs.items():
        seconds, memory = read_log(log)
        text += f"{name}: {words}; {seconds:.0f} s, {memory:.0f} MB\n"
    path.write_text(text)
    print(text, end="")
