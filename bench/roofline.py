#!/usr/bin/python3
"""What the loop of the contact kernel has to do for a contact, beside the time that it takes.

    roofline.py [--measure | --times FILE] [--clock GHZ] [--results DIR] BENCH_KERNEL
    roofline.py --draw [--results DIR]

Disassembles the program bench_kernel and counts, for each composition of sub-models, dimension and
instruction set, instructions, vector arithmetic, shuffles, loads, stores, divisions, roots and
estimates per contact; from these the cycles that a core of this machine needs at least, if it is
one whose numbers are known: Golden Cove (Sapphire and Emerald Rapids) or Zen 5. --measure runs the program, two minutes; --times takes what it wrote, with
--benchmark_format=json. With either the table is also written to results/kernel.txt, with a plot in
results/kernel.png; --draw makes the plot anew from the table that is there. Needs objdump of
Debian's binutils, and python3-matplotlib for the plot. kernel.md says more.
"""
import argparse
import json
import re
import subprocess
from collections import Counter
from pathlib import Path
from typing import NamedTuple

from lammps_runs import parse, processor, prose, results_option, stop

SETS = ("baseline", "avx2", "avx512")
# names in bench_kernel: adhesion, sliding, twisting, rolling of the kernel. Damping is no choice.
COMPOSITIONS = {"normal": "1000", "damping": "1000", "sliding": "1100", "twisting": "1110",
                "rolling": "1111", "hertz": "0000", "hertz-all": "0110"}

# ---- what a core can do in a cycle


class Core(NamedTuple):
    """What bounds a loop. Ports: units that compute with vectors, by instruction set."""
    name: str
    issue: int         # micro-operations renamed; an instruction is one or more
    loads: int
    loads_512: int     # of 512 bits
    stores: int        # one of 512 bits counts as two
    ports: dict
    split: int         # micro-operations of a division or estimate of 512 bits
    division: dict     # cycles of the divider, which takes one at a time, by bits
    root: float        # of a division

    def bounds(self, n, isa):
        """Cycles that what was counted takes at least, for each of what may bound it."""
        slow = sum(k * (self.split if key[1] == 512 else 1)
                   for key, k in n.items() if key[0] in SLOW)
        vector = sum(n["arithmetic", width] for width in self.division) + n["shuffles"] + slow
        divider = sum(cycles * (n["divisions", width] + self.root * n["roots", width])
                      for width, cycles in self.division.items())
        return {"issue": n["instructions"] / self.issue,
                "loads": max(n["loads"] / self.loads, n["loads", 512] / self.loads_512),
                "stores": (n["stores"] + n["stores", 512]) / self.stores,
                "ports": vector / self.ports[isa], "divider": divider}


# By maker and family, and for some models. [O]: machine models osaca/data/spr.yml and zen5.yml of OSACA
# (github.com/RRZE-HPC/OSACA), from measurements there; [L]: X86SchedSapphireRapids.td of LLVM;
# [M]: throughput of a row of independent instructions over a chain of additions of one cycle each,
# measured on such a core.
GOLDEN_COVE = Core(
    "Golden Cove", issue=6,      # [L]
    loads=3, loads_512=2,        # ports 2, 3, 11; of 512 bits 2 and 3 [O] [L]
    stores=2,                    # ports 4 and 9; one of 512 bits takes both [O]
    # 0, 1 and 5, but 1 not with 512 bits [O]. A product takes 0 or 1, a shuffle 1 or 5: with three
    # ports the bound is on the low side.
    ports={"baseline": 3, "avx2": 3, "avx512": 2},
    split=3,                     # of a division [L] or estimate [O]
    division={128: 4, 256: 8, 512: 16},    # [O]
    root=9 / 8)                  # 3.36 ns beside 2.97 for four numbers [M]
ZEN_5 = Core(
    "Zen 5", issue=8,            # [O]
    loads=4, loads_512=2,        # four into integer registers, two vectors of any width [O]
    stores=2,                    # ports 4 and 5; one of 512 bits takes both [O]
    # A product takes 0 or 2, a sum 1 or 3 [O]: with four ports the bound is on the low side.
    ports={"baseline": 4, "avx2": 4, "avx512": 4},
    split=1,
    division={128: 4, 256: 4, 512: 4}, root=7.5 / 4)    # [M]
CORES = {("GenuineIntel", 6, 143): GOLDEN_COVE, ("GenuineIntel", 6, 207): GOLDEN_COVE,
         ("AuthenticAMD", 26, None): ZEN_5}


def this_core():
    """The core of this machine; None if its numbers are not known."""
    text = Path("/proc/cpuinfo").read_text()
    words = [re.search(rf"^{word}\s*: (.*)$", text, re.M)
             for word in ("vendor_id", "cpu family", "model")]
    if not all(words):
        return None
    maker, family, model = words[0][1], int(words[1][1]), int(words[2][1])
    return CORES.get((maker, family, model), CORES.get((maker, family, None)))


# ---- reading a disassembly

JUMP = re.compile(r"j(\w+)\s+([0-9a-f]+)$")
FLAGS = re.compile(r"(v?comis[sd]|cmp|test|add|sub|and|or|xor|neg|inc|dec|sh[lr]|sar|imul)\b")
SLOW = {"divisions": re.compile(r"v?div[ps][sd]$"), "roots": re.compile(r"v?sqrt[ps][sd]$"),
        "estimates": re.compile(r"v?r(sqrt|cp)(14)?[ps][sd]$")}
SHUFFLE = re.compile(r"v?p?(unpck|shuf|perm|insert|extract|insr|extr|broadcast|align|mov[hl]p)")


def instructions(text):
    """Instructions of a disassembled function with their addresses."""
    return [(int(address, 16), code.strip())
            for address, code in re.findall(r"^ *([0-9a-f]+):\t([^#<\n]*)", text, re.M)]


def kernel(functions, dims, composition, isa):
    """Instructions of a kernel, found by the name of its template; functions: texts of objdump."""
    flags = COMPOSITIONS[composition]
    if dims == "2D":
        flags = flags[:2] + "0" + flags[3]    # no twisting in the plane
    name = "int apf::{}::kernel<apf::{}Frame<apf::Pack<[0-9]+> ?>, {}>[(]apf::ContactList&".format(
        isa, "Plane" if dims == "2D" else "Space",
        ", ".join("true" if flag == "1" else "false" for flag in flags))
    found = [text for text in functions if re.search(f"^[0-9a-f]+ <{name}.*>:$", text[:1000], re.M)]
    if len(found) != 1:
        raise ValueError(f"{len(found)} functions {name}, expected one")
    return instructions(found[0])


def one_round(code, index, begin):
    """The instructions of one round of a loop from its beginning; None if it is not one of ours.

    Of jumps by condition two are taken: `jg` back to the beginning, and `ja` after a comparison of
    floating-point numbers; the only one is whether time advances, and it does. Others lead out of
    the loop, to the last, incomplete group, or to a call that loads other constants.
    """
    path, seen, n, compared = [], set(), begin, ""
    while n is not None and n < len(code) and n not in seen:
        seen.add(n)
        text = code[n][1]
        path.append(text)
        n += 1
        if FLAGS.match(text):
            compared = text
        if not text.startswith("j"):
            if re.match("call|ret", text):
                return None
            continue
        jump = JUMP.match(text)
        to = index.get(int(jump[2], 16)) if jump else None
        if to == begin:
            return path if jump[1] == "g" else None
        known = ("a", "be") if "comis" in compared else ("e", "ne", "g", "ge", "l", "le")
        if to in seen or not jump or jump[1] not in known + ("mp",):
            return None
        if jump[1] in ("a", "mp"):
            n = to
    return None


def group_loop(code):
    """The loop over complete groups of contacts: its instructions, and the contacts of a group.

    It is the one loop with divisions or estimates whose round has no call (there is one where parts
    are reported) and no loop inside and that goes round while more than width - 1 contacts are
    left: this number is read from it.
    """
    index = {address: n for n, (address, _) in enumerate(code)}
    begins = {index[to] for n, (_, text) in enumerate(code)
              if (jump := JUMP.match(text)) and index.get(to := int(jump[2], 16), n + 1) <= n}
    rounds = [path for begin in sorted(begins) if (path := one_round(code, index, begin)) and
              any(slow.match(text.split()[0]) for text in path for slow in SLOW.values())]
    if len(rounds) != 1:
        raise ValueError(f"{len(rounds)} loops with divisions and without calls, expected one")
    test = re.match(r"cmp +\w+,0x([0-9a-f]+)$", rounds[0][-2])
    if not test:
        raise ValueError(f"the loop ends with '{rounds[0][-2]}', not with a comparison of the "
                         "contacts left with the width of a group")
    return rounds[0], int(test[1], 16) + 1


def count(loop):
    """Number of instructions of each sort, of some also by the bits of their registers."""
    n = Counter(instructions=len(loop))
    for text in loop:
        name, _, rest = text.partition(" ")
        operands = rest.strip().split(",")
        memory = ["[" in operand for operand in operands]
        width = next((w for r, w in (("zmm", 512), ("ymm", 256), ("xmm", 128)) if r in rest), 0)
        if any(memory) and name not in ("lea", "nop"):
            stored = memory[0] and not re.match(r"cmp|test", name)
            loaded = not (stored and re.match(r"[vk]?(mov|p?extr)", name))
            for sort, here in (("stores", stored), ("loads", loaded)):
                n[sort] += here
                n[sort, 512] += here and "ZMMWORD" in rest
        slow = next((sort for sort, pattern in SLOW.items() if pattern.match(name)), None)
        if slow:
            n[slow] += 1
            n[slow, width] += 1
        elif width and SHUFFLE.match(name):
            # what the units for loads and stores do themselves: one number to all, a part stored
            n["shuffles"] += not (memory[0] or "broadcast" in name and memory[-1])
        elif width and (not re.match(r"v?mov", name) or "{k" in rest):    # a masked move selects
            cleared = "xor" in name and len(set(operands)) == 1    # done when registers are renamed
            n["arithmetic", width] += not cleared
    return n


# ---- measurements and the table

def measured(text, unit="per_contact"):
    """Median [ns] and coefficient of variation of a unit by name, from JSON of a benchmark."""
    times = {}
    for row in json.loads(text)["benchmarks"]:
        if row.get("aggregate_name") in ("median", "cv"):
            name = row["run_name"].split("/min_time")[0]
            times.setdefault(name, {})[row["aggregate_name"]] = row[unit]
    return {name: (1e9 * row["median"], row["cv"]) for name, row in times.items()}


COUNTS = ("instructions", ("arithmetic", 512), ("arithmetic", 256), ("arithmetic", 128), "shuffles",
          "loads", "stores", "divisions", "roots", "estimates")
ORDER = ["2D", "3D", *COMPOSITIONS, "scalar", *SETS, "polydisperse", "bridges", "maugis", "willett",
         "tangential"]
# groups of bars in the plot, by name without dimension and instruction set
GROUPS = {"normal": "normal", "damping": "+ damping", "sliding": "+ sliding",
          "twisting": "+ twisting", "rolling": "+ rolling\n= all", "rolling/polydisperse":
          "all, radii\ndiffer", "hertz": "Hertz", "hertz-all": "Hertz, all",
          "bridges/maugis": "bridge,\nmaugis", "bridges/willett": "bridge,\nwillett",
          "bridges/tangential": "bridge,\ntangential"}
WORDS = "instr 512 256 128 shuf load store div root est issue load store ports div".split()
WANTED = {"2D": 22.0, "3D": 40.0}    # ns per contact with all sub-models
HEAD = [f"{'':34s}{'per contact':60s}{'cycles at least':29s}{'bound':>7s}{'time':>8s}",
        f"{'':33s}" + "".join(f"{word:>6s}" for word in WORDS) +
        f"{'[ns]':>7s}{'[ns]':>8s}{'cv %':>6s}{'ratio':>7s}"]


def line(name, functions, times, core, clock):
    """One line of the table: counts and bounds where there are any, times where measured."""
    dims, composition, *between, isa = name.split("/")
    row, bound = f"{name:33s}" + " " * 97, None
    if composition in COMPOSITIONS and isa in SETS and not between:
        try:
            loop, width = group_loop(kernel(functions, dims, composition, isa))
        except ValueError as error:
            raise ValueError(f"{name}: {error}") from None
        n = count(loop)
        cycles = list(core.bounds(n, isa).values()) if core else []
        row = f"{name:33s}" + "".join(
            f"{number / width:6.1f}" for number in [n[key] for key in COUNTS] + cycles)
        if cycles:
            bound = max(cycles) / width / clock
            row += f"{bound:7.1f}"
        row = f"{row:130s}"
    if name in times:
        median, variation = times[name]
        row += f"{median:8.1f}{100 * variation:6.1f}" + (f"{median / bound:7.1f}" if bound else "")
    return row.rstrip()


def read_table(text):
    """(bound, None where there is none; median; coefficient of variation) by name, of kernel.txt."""
    found = {}
    for row in text.splitlines():
        words = row[130:].split()
        if re.match("[23]D/", row) and words:
            bound = row[123:130].strip()
            found[row.split()[0]] = (float(bound) if bound else None, float(words[0]),
                                     0.01 * float(words[1]))
    return found


def draw_dimension(axis, rows, dims):
    """Bars of all instruction sets, and the bounds across them."""
    from bars import Spread, draw_bars, mark    # counts alone need no matplotlib
    wanted = {isa: {group: rows[name] for group in GROUPS
                    if (name := f"{dims}/{group}/{isa}") in rows} for isa in SETS}
    names = [group for group in GROUPS if any(group in bars for bars in wanted.values())]
    series = {isa: {group: Spread.around(*row[1:]) for group, row in bars.items()}
              for isa, bars in wanted.items()}
    draw_bars(axis, names, series)
    mark(axis, names, series, {(isa, group): row[0] for isa, bars in wanted.items()
                               for group, row in bars.items() if row[0]},
         color="k", label="bound: the loop takes at least")
    axis.set_xticks(range(len(names)), [GROUPS[name] for name in names])
    axis.axhline(WANTED[dims], color="firebrick", linestyle=":", linewidth=1,
                 label=f"wanted of all modes: {WANTED['2D']:g} (2-D), {WANTED['3D']:g} ns (3-D)")
    axis.set_ylabel(f"{dims[0]}-D: ns per contact, or bridge")


def draw(text, path):
    """Plot of a table, plane above space."""
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    clock = re.search(r"clock (\S+) GHz", text)[1]
    figure, axes = plt.subplots(2, 1, figsize=(11, 7.5))
    for axis, dims in zip(axes, ("2D", "3D")):
        draw_dimension(axis, read_table(text), dims)
    axes[0].set_title(f"contact kernel alone: median, coefficient of variation; bound at {clock} GHz")
    axes[0].legend(frameon=False, ncol=5, fontsize=8)
    figure.tight_layout()
    figure.savefig(path, dpi=110)


def output(*command):
    """What a program prints."""
    try:
        return subprocess.run([*map(str, command)], check=True, text=True,
                              stdout=subprocess.PIPE).stdout
    except (OSError, subprocess.CalledProcessError) as error:
        stop(error)


def arguments():
    """Command line; args.program is there unless it is not needed."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, nargs="?", metavar="BENCH_KERNEL")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--measure", action="store_true", help="run the program, two minutes")
    source.add_argument("--times", type=Path, help="its output with --benchmark_format=json")
    source.add_argument("--draw", action="store_true", help="kernel.png anew from kernel.txt")
    parser.add_argument("--clock", type=float, metavar="GHZ", help="default: as measured, without --measure that of "
                        "/proc/cpuinfo")
    results_option(parser)
    args = parse(parser)
    if args.draw:
        return args
    if not args.program or not args.program.is_file():
        stop(f"{args.program or 'BENCH_KERNEL'}: not there; a build with -D APF_BENCH=on has "
             "bench_kernel")
    return args


def find_clock(args, times):
    """The clock in GHz, and who says so."""
    if args.clock is not None:
        clock, told = args.clock, "as told"
    elif "clock" in times:
        clock, told = 1.0 / times["clock"][0], "by a chain of additions"
    else:
        known = re.findall(r"^cpu MHz\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
        clock = max(map(float, known), default=0.0) / 1000.0
        told = "of /proc/cpuinfo, which in a virtual machine need not be the core's"
    if not clock > 0.0:
        stop(f"the clock is {clock} GHz, must be > 0; --clock GHZ gives it")
    return clock, told


def find_times(args):
    """Median and coefficient of variation by name; nothing where only counts are wanted."""
    if args.measure:
        return measured(output(args.program, "--benchmark_format=json",
                               "--benchmark_enable_random_interleaving=true"))
    return measured(args.times.read_text()) if args.times else {}


def report(args, times):
    """The text that is printed and written."""
    clock, told = find_clock(args, times)
    core = this_core()
    bound = (f"Bound: the largest of the cycles, of a {core.name} core; ratio: time to bound; both "
             "are of the clock." if core else "No bounds: this core's numbers are not known here.")
    functions = output("objdump", "-d", "-C", "-M", "intel", "--no-show-raw-insn",
                       args.program).split("\n\n")
    names = set(times) - {"clock"} or {
        f"{dims}/{composition}/{isa}" for dims in ("2D", "3D") for composition in COMPOSITIONS
        for isa in SETS} - {f"2D/twisting/{isa}" for isa in SETS}
    names = sorted(names, key=lambda name: [ORDER.index(word) for word in name.split("/")])
    table = prose(f"""{processor()}, one core; clock {clock:.2f} GHz, {told}. Counts of the loop
        over complete groups of contacts of one kind, by bench/roofline.py; 512, 256, 128:
        arithmetic by bits of the registers. {bound} cv: coefficient of variation of nine
        runs.""") + [""]
    try:
        table += HEAD + [line(name, functions, times, core, clock) for name in names]
    except ValueError as error:
        stop(f"{args.program}: {error}")
    return "\n".join(table) + "\n"


def main():
    args = arguments()
    table, plot = args.results / "kernel.txt", args.results / "kernel.png"
    if args.draw:
        if not table.is_file():
            stop(f"{table}: not there; --measure writes it")
        draw(table.read_text(), plot)
        return
    times = find_times(args)
    text = report(args, times)
    print(text, end="")
    if times:
        table.write_text(text)
        draw(text, plot)


if __name__ == "__main__":
    main()
