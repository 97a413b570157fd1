#!/usr/bin/python3
"""What the loop of the contact kernel has to do for a contact, beside the time that it takes.

    roofline.py [--measure | --times FILE] [--clock GHZ] [--results DIR] BENCH_KERNEL

Disassembles the program bench_kernel and counts, for each composition of sub-models, dimension and
instruction set, instructions, vector arithmetic, shuffles, loads, stores, divisions, roots and
estimates per contact; from these the cycles that a Golden Cove core (Sapphire Rapids) needs at
least. --measure runs the program, two minutes; --times reads what it wrote with --benchmark_format=json. With
either the table is also written to results/kernel.txt. Needs objdump of Debian's binutils.
"""
import argparse
import json
import re
import subprocess
from collections import Counter
from pathlib import Path

from lammps_runs import HERE, processor, prose, stop

SETS = ("baseline", "avx2", "avx512")
# names in bench_kernel: adhesion, sliding, twisting, rolling of the kernel. Damping is no choice.
COMPOSITIONS = {"normal": "1000", "damping": "1000", "sliding": "1100", "twisting": "1110",
                "rolling": "1111"}

# ---- what a Golden Cove core can do in a cycle
# [O]: machine model spr.yml of OSACA (github.com/RRZE-HPC/OSACA, osaca/data), from uops.info and measured
# with ibench and asmbench on Sapphire Rapids; [L]: X86SchedSapphireRapids.td of LLVM.
ISSUE = 6             # micro-operations renamed [L]; an instruction is one or more
LOADS = 3             # ports 2, 3, 11 [O] [L]
LOADS_512 = 2         # of 512 bits: ports 2 and 3 [O]
STORES = 2            # ports 4 and 9; one of 512 bits takes both [O]
# Ports 0, 1 and 5 compute with vectors; port 1 does not while there are registers of 512 bits [O].
# A product takes one of 0 and 1, a shuffle of 1 and 5: with three the bound is on the low side.
PORTS = {"baseline": 3, "avx2": 3, "avx512": 2}
SPLIT = 3             # micro-operations of a division, root or estimate of 512 bits [L] [O]
DIVISION = {128: 4, 256: 8, 512: 16}    # cycles of the divider, which takes one at a time [O]
ROOT = 9 / 8    # of a division: 3.36 ns beside 2.97 for four numbers, measured here (kernel.md)

# ---- reading a disassembly

JUMP = re.compile(r"j(\w+)\s+([0-9a-f]+)")
SLOW = {"divisions": re.compile(r"v?div[ps][sd]$"), "roots": re.compile(r"v?sqrt[ps][sd]$"),
        "estimates": re.compile(r"v?r(sqrt|cp)(14)?[ps][sd]$")}
SHUFFLE = re.compile(r"v?p?(unpck|shuf|perm|insert|extract|insr|extr|broadcast|align|mov[hl]p)")


def kernel(functions, dims, composition, isa):
    """Instructions of a kernel with their addresses, and bytes of its registers.

    functions: parts of a text of objdump. The kernel is found by the name of its template.
    """
    flags = COMPOSITIONS[composition]
    if dims == "2D":
        flags = flags[:2] + "0" + flags[3]    # no twisting in the plane
    wanted = re.compile(r"^[0-9a-f]+ <int apf::%s::kernel<apf::%sFrame<apf::Pack<(\d+)> ?>, %s>"
                        r"\(apf::ContactList&.*>:$" % (
                            isa, "Plane" if dims == "2D" else "Space",
                            ", ".join("true" if f == "1" else "false" for f in flags)), re.M)
    found = [m for part in functions if (m := wanted.search(part, 0, 1000))]
    if len(found) != 1:
        raise ValueError(f"{len(found)} functions {wanted.pattern}, expected one")
    return instructions(found[0].string), int(found[0][1])


def instructions(text):
    """Instructions of a disassembled function with their addresses."""
    return [(int(address, 16), code.strip())
            for address, code in re.findall(r"^ *([0-9a-f]+):\t([^#<\n]*)", text, re.M)]


def group_loop(code):
    """The loop over complete groups of contacts: its instructions, and the contacts of a group.

    It is the one straight run of code with divisions or estimates that ends with a jump to its own
    beginning: no call (there is one where parts are reported, and where other constants are
    loaded), no jump elsewhere but by condition, no loop inside. Conditional jumps out of the run are
    not taken: they are for the last, incomplete group and for other constants; one within it skips
    the histories when time does not advance. It goes round while more than width - 1 contacts are
    left, and this number is read from it.
    """
    index = {address: n for n, (address, _) in enumerate(code)}
    back = {n: index[to] for n, (_, text) in enumerate(code)
            if (m := JUMP.match(text)) and (to := int(m[2], 16)) in index and index[to] <= n}
    found = []
    for end, begin in back.items():
        loop = [text for _, text in code[begin:end + 1]]
        plain = not any(re.match(r"call|jmp|ret", text) for text in loop)
        alone = not any(begin <= n < end for n in back)
        if plain and alone and any(p.match(t.split()[0]) for t in loop for p in SLOW.values()):
            found.append(loop)
    if len(found) != 1:
        raise ValueError(f"{len(found)} straight loops with divisions, expected one")
    test = re.match(r"cmp +\w+,0x([0-9a-f]+)$", found[0][-2])
    if not test or not found[0][-1].startswith("jg "):
        raise ValueError(f"the loop ends with '{found[0][-2]}; {found[0][-1]}', not with a "
                         "comparison of the contacts left with the width of a group")
    return found[0], int(test[1], 16) + 1


def count(loop):
    """Number of instructions of each sort; widths of arithmetic, divisions and roots are keys."""
    n = Counter(instructions=len(loop))
    for text in loop:
        name, _, rest = text.partition(" ")
        operands = rest.strip().split(",")
        memory = [("[" in o) for o in operands]
        width = next((w for r, w in (("zmm", 512), ("ymm", 256), ("xmm", 128)) if r in rest), 0)
        if any(memory) and name not in ("lea", "nop"):
            moves = re.match(r"v?(mov|p?extr)", name)
            size = 512 if "ZMMWORD" in rest else 0
            stored = memory[0] and not re.match(r"cmp|test", name)
            n["stores"] += stored
            n["stores", size] += stored
            n["loads"] += not (stored and moves)
            n["loads", size] += not (stored and moves)
        slow = next((sort for sort, pattern in SLOW.items() if pattern.match(name)), None)
        if slow:
            n[slow] += 1
            n[slow, width] += 1
        elif width and SHUFFLE.match(name):
            # from memory to all lanes, or a part to memory: no port for shuffles
            n["shuffles"] += not (memory[0] or "broadcast" in name and memory[-1])
        elif width and (not re.match(r"v?mov", name) or "{k" in rest):    # a masked move selects
            zero = "xor" in name and len(set(operands)) == 1    # done when registers are renamed
            n["arithmetic", width] += not zero
    return n


def bounds(n, isa):
    """Cycles that what was counted takes at least, by what would bound it."""
    slow = sum(k * (SPLIT if key[1] == 512 else 1) for key, k in n.items() if key[0] in SLOW)
    vector = sum(n["arithmetic", w] for w in DIVISION) + n["shuffles"] + slow
    return {"issue": n["instructions"] / ISSUE,
            "loads": max(n["loads"] / LOADS, n["loads", 512] / LOADS_512),
            "stores": (n["stores"] + n["stores", 512]) / STORES,
            "ports": vector / PORTS[isa],
            "divider": sum(c * (n["divisions", w] + ROOT * n["roots", w])
                           for w, c in DIVISION.items())}


# ---- measurements and the table

def measured(text):
    """Median and coefficient of variation by name, from the JSON of bench_kernel: ns, 1."""
    times = {}
    for row in json.loads(text)["benchmarks"]:
        name = row["run_name"].split("/min_time")[0]
        if row.get("aggregate_name") == "median":
            times.setdefault(name, {})["median"] = 1e9 * row["per_contact"]
        elif row.get("aggregate_name") == "cv":
            times.setdefault(name, {})["cv"] = row["per_contact"]
    return times


COUNTS = ("instructions", ("arithmetic", 512), ("arithmetic", 256), ("arithmetic", 128), "shuffles",
          "loads", "stores", "divisions", "roots", "estimates")
HEAD = """
                               per contact                                                               cycles at least               bound   time
                               instr   512   256   128  shuf  load store   div  root   est   issue  load store ports   div    [ns]    [ns]  cv %  ratio
"""


def line(name, functions, times, clock):
    """One line of the table: counts and bounds where there are any, times where measured."""
    dims, composition, *_, isa = name.split("/")
    counted, bound = " " * 97, None
    if composition in COMPOSITIONS and isa in SETS and name.count("/") == 2:
        code, register = kernel(functions, dims, composition, isa)
        loop, width = group_loop(code)
        if width * 8 % register:
            raise ValueError(f"{width} contacts do not fill registers of {register} bytes")
        n = count(loop)
        cycles = [c / width for c in bounds(n, isa).values()]
        bound = max(cycles) / clock
        counted = (" ".join(f"{n[key] / width:5.1f}" for key in COUNTS) + "   " +
                   " ".join(f"{c:5.1f}" for c in cycles) + f"  {bound:6.1f}")
    row = f"{name:30s} {counted}"
    if name in times:
        median, cv = times[name]["median"], times[name]["cv"]
        row += f"  {median:6.1f} {100 * cv:5.1f}"
        row += f"  {median / bound:5.1f}" if bound else ""
    return row


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, metavar="BENCH_KERNEL")
    source = parser.add_mutually_exclusive_group()
    source.add_argument("--measure", action="store_true", help="run the program, two minutes")
    source.add_argument("--times", type=Path, help="its output with --benchmark_format=json")
    parser.add_argument("--clock", type=float, metavar="GHZ", help="(default: /proc/cpuinfo)")
    parser.add_argument("--results", type=Path, default=HERE / "results", metavar="DIR")
    args = parser.parse_args()
    ghz = args.clock or max(map(float, re.findall(r"^cpu MHz\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)),
                            default=0.0) / 1000.0
    if not ghz > 0.0:
        stop("the clock is not in /proc/cpuinfo; --clock GHZ gives it")

    def output(*command):
        try:
            return subprocess.run(command, check=True, stdout=subprocess.PIPE, text=True).stdout
        except (OSError, subprocess.CalledProcessError) as error:
            stop(error)

    functions = output("objdump", "-d", "-C", "-M", "intel", "--no-show-raw-insn",
                       args.program).split("\n\n")
    times = {}
    if args.measure:
        times = measured(output(args.program, "--benchmark_format=json",
                                "--benchmark_enable_random_interleaving=true"))
    elif args.times:
        times = measured(args.times.read_text())
    names = times or [f"{d}/{c}/{isa}" for d in ("2D", "3D") for c in COMPOSITIONS for isa in SETS
                      if (d, c) != ("2D", "twisting")]
    table = prose(f"""{processor()}, one core; clock {ghz:.2f} GHz, {'as given' if args.clock else
        'of /proc/cpuinfo, which in a virtual machine is not what the core runs at'}. Counts of the
        loop over complete groups of contacts, all of one kind; arithmetic by bits of the
        registers. Bound: the largest of the cycles at least; ratio: time to bound.""")
    try:
        table += HEAD.rstrip().split("\n") + [line(name, functions, times, ghz) for name in names]
    except ValueError as error:
        stop(f"{args.program}: {error}")
    print(*table, sep="\n")
    if times:
        args.results.mkdir(parents=True, exist_ok=True)
        (args.results / "kernel.txt").write_text("\n".join(table) + "\n")


if __name__ == "__main__":
    main()
