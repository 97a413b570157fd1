"""Readers of the files that LAMMPS writes: logs, fix ave/time, ave/chunk, ave/histo, dumps.

tools/apf_plot and the plot.py of the examples use them. A run may still be writing: a last line or
block that is cut off is left out. Errors end the program with a message that names file and column.
Needs Debian's python3-numpy.
"""
import re
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np


def stop(path, reason):
    """Ends with exit code 1 and a message that names the file."""
    sys.exit(f"{path}: {reason}")


@dataclass
class Table:
    """Named columns of numbers; step is that of a block or snapshot, None for tables over time."""
    path: Path
    names: list
    rows: np.ndarray    # rows x columns
    step: int = None
    totals: tuple = ()    # what the line before a block tells after step and number of rows

    def __contains__(self, name):
        return self.place(name) is not None

    def place(self, name):
        """Index of a column: by its name, or by its name without [unit] where that is unique."""
        if name in self.names:
            return self.names.index(name)
        short = [full.split("[")[0] for full in self.names]
        return short.index(name) if short.count(name) == 1 else None

    def __getitem__(self, name):
        place = self.place(name)
        if place is None:
            stop(self.path, f"no column {name}; it has {' '.join(self.names)}")
        return self.rows[:, place]


def lines_of(path):
    """Lines of a text file, without a last one that is cut off."""
    path = Path(path)
    if not path.is_file():
        stop(path, "missing")
    try:
        return path.read_text().split("\n")[:-1]
    except UnicodeDecodeError:
        stop(path, "is not a text file")


def numbers(path, number, line, count=None):
    """Numbers of one line, of which there must be count."""
    words = line.split()
    try:
        values = [float(word) for word in words]
    except ValueError:
        stop(path, f"line {number}: not numbers: {line.strip()[:60]}")
    if count is not None and len(values) != count:
        stop(path, f"line {number}: {len(values)} numbers for {count} columns")
    return values


def read_log(path):
    """Thermo output of a log: a Table for each sequence of runs. Runs follow each other while columns
    stay and steps go on; the step that a run repeats from the one before is left out."""
    tables, names, lines = [], None, lines_of(path)
    for number, line in enumerate(lines, 1):
        if number > 1 and lines[number - 2].startswith("Per MPI rank memory"):
            names = line.split()
        elif line.startswith(("Loop time", "ERROR")):
            names = None
        elif names and len(line.split()) == len(names) and re.match(r" *[-+.\d]", line):
            row = numbers(path, number, line)
            if not tables or tables[-1][0] != names or row[0] < tables[-1][1][-1][0]:
                tables.append((names, []))
            elif row[0] == tables[-1][1][-1][0]:
                tables[-1][1].pop()
            tables[-1][1].append(row)
    if not tables:
        stop(path, "no thermo output of style one or custom")
    return [Table(Path(path), names, np.array(rows)) for names, rows in tables]


def read_cost(path):
    """Wall-clock time of all runs [s] and largest memory [MB] in a log."""
    text = "\n".join(lines_of(path))
    times = [float(word) for word in re.findall(r"^Loop time of (\S+)", text, re.M)]
    memory = [float(word) for word in re.findall(r"^Maximum resident set size: (\S+)", text, re.M)]
    return sum(times), max(memory, default=np.nan)


def header(path, lines):
    """Names of the columns of a file of fix ave/*, those of its blocks where there are any."""
    heads = [line.lstrip("# ").split() for line in lines[:3] if line.startswith("#")]
    if len(heads) < 2:
        stop(path, "its first lines are not those of a fix ave file; was title1 or title2 left out?")
    return heads


def read_history(path):
    """A file of fix ave/time with scalars over time: one Table. Names are those of its second line.

    A run that went on from a restart file may have written a step twice: the later row counts. A table whose
    first column is not the step, as a study prints one, stays as it is.
    """
    lines = lines_of(path)
    names = header(path, lines)[1]
    rows = [numbers(path, number, line, len(names))
            for number, line in enumerate(lines, 1) if line and not line.startswith("#")]
    if not rows:
        stop(path, "holds no numbers yet")
    if names[0].lower() in ("timestep", "step"):
        by_step = {row[0]: row for row in rows}
        rows = [by_step[step] for step in sorted(by_step)]
    return Table(Path(path), names, np.array(rows))


def whole_blocks(path):
    """A file of fix ave/chunk, ave/histo or ave/time with vectors: a Table for each whole block, the later
    one of those of the same step; none as long as a run has written none."""
    lines = lines_of(path)
    heads = header(path, lines)
    if len(heads) < 3:
        stop(path, "holds no blocks: it is a table over time")
    data = [(number, line) for number, line in enumerate(lines, 1) if line and not line.startswith("#")]
    blocks, begin = {}, 0
    while begin < len(data):
        number, line = data[begin]
        step, count, *totals = numbers(path, number, line)
        step, count = int(step), int(count)
        if begin + count >= len(data):
            break
        rows = [numbers(path, *one, len(heads[2])) for one in data[begin + 1:begin + 1 + count]]
        blocks[step] = Table(Path(path), heads[2], np.array(rows), step, tuple(totals))
        begin += 1 + count
    return [blocks[step] for step in sorted(blocks)]


def read_blocks(path):
    """As whole_blocks, of which there must be one."""
    return whole_blocks(path) or stop(path, "holds no block yet")


@dataclass
class Snapshot(Table):
    """One snapshot of dump custom, local or grid."""
    bounds: np.ndarray = None    # lo, hi of x, y, z
    size: tuple = None           # nodes along x, y, z of dump grid

    def grid(self, name):
        """A column of dump grid as an array [iz, iy, ix]."""
        if self.size is None:
            stop(self.path, "is no dump grid")
        return self[name].reshape(self.size[::-1])


def snapshot(path, items):
    """The Snapshot of one TIMESTEP's items, (title, line number, lines); None if it is cut off."""
    parts = {" ".join(title.split()[:2]): lines for title, _, lines in items}
    title, number, data = items[-1]
    size = None
    if title.startswith("GRID CELLS"):
        size = tuple(int(word) for word in parts["GRID SIZE"][0].split())
    elif "NUMBER OF" not in parts or title.startswith("NUMBER OF"):
        return None
    names = title.split()[2 if size else 1:]
    count = int(np.prod(size)) if size else int(parts["NUMBER OF"][0])
    if len(data) < count:
        return None
    rows = np.full((count, len(names)), np.nan)    # nan: words, such as elements
    for k, line in enumerate(data):
        words = line.split()
        if len(words) != len(names):
            stop(path, f"line {number + k + 1}: {len(words)} values for {len(names)} columns")
        rows[k] = [float(word) if re.match(r"[-+.\d]|nan|inf", word) else np.nan for word in words]
    bounds = np.array([numbers(path, number, line)[:2] for line in parts["BOX BOUNDS"]])
    return Snapshot(Path(path), names, rows, int(parts["TIMESTEP"][0]), bounds=bounds, size=size)


def read_dump(path):
    """Snapshots of dump custom, local or grid in text form; a last one that is cut off is left out."""
    lines, items, snapshots = lines_of(path), [], []
    if not lines or not lines[0].startswith("ITEM:"):
        stop(path, "is no dump custom, local or grid in text form")
    for number, line in enumerate(lines + ["ITEM: TIMESTEP"], 1):
        if line.startswith("ITEM: TIMESTEP") and any(item[0] == "TIMESTEP" for item in items):
            snapshots.append(snapshot(path, items))
            items = []
        if line.startswith("ITEM: "):
            items.append((line[6:].strip(), number, []))
        else:
            items[-1][2].append(line)
    snapshots = [one for one in snapshots if one]
    if not snapshots:
        stop(path, "holds no whole snapshot yet")
    return snapshots
