"""Runs of LAMMPS for the scripts here: command lines, logs, kept results."""
import argparse
import json
import os
import re
import shutil
import statistics
import subprocess
import sys
import textwrap
from pathlib import Path

HERE = Path(__file__).resolve().parent
CHANNEL = HERE.parent / "examples" / "channel" / "in.channel"


def stop(reason):
    """Ends with exit code 1 and a message."""
    sys.exit(f"{Path(sys.argv[0]).name}: {reason}")


def count(text):
    """Type of an option: a whole number above 0."""
    if not text.isdigit() or int(text) == 0:
        raise argparse.ArgumentTypeError(f"must be a whole number above 0, got {text}")
    return int(text)


def results_option(parser):
    """Adds the folder for what is written; parse() takes it."""
    parser.add_argument("--results", type=Path, metavar="DIR",
                        help="folder for table and plot (default results, beside this; with --quick results/quick)")


def parse(parser):
    """The command line; the folder of the results is there."""
    args = parser.parse_args()
    args.results = args.results or HERE / "results" / ("quick" if getattr(args, "quick", False) else "")
    args.results.mkdir(parents=True, exist_ok=True)
    return args


def rounds_parser(description, rounds, steps=None):
    """Options of a script that measures in rounds, of so many steps; parse_rounds() takes them."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--quick", action="store_true", help="two rounds")
    parser.add_argument("--rounds", type=count, default=rounds,
                        help=f"runs of each case (default {rounds})")
    if steps:
        parser.add_argument("--steps", type=count, default=steps, help=f"steps of a run (default {steps})")
    parser.add_argument("--lmp", default=HERE.parent / "lmp",
                        help="LAMMPS that loads APF (default ../lmp)")
    results_option(parser)
    return parser


def parse_rounds(parser):
    """The command line; the program is there, and the folder of the results."""
    args = parse(parser)
    if args.quick:
        args.rounds = 2
    args.lmp = shutil.which(args.lmp) or stop(f"{args.lmp}: not there; --lmp names another")
    return args


def kept_runs_parser(description, ranks):
    """Options of a script whose runs are kept, see Store; parse_kept_runs() takes them."""
    parser = argparse.ArgumentParser(description=description)
    parser.add_argument("--ranks", type=count, default=ranks, help=f"MPI ranks (default {ranks})")
    parser.add_argument("--measure", choices=("all", "nothing"), default="all",
                        help="nothing shows what has run")
    parser.add_argument("--lmp", default=HERE.parent / "lmp", help="LAMMPS with APF (default ../lmp)")
    parser.add_argument("--work", type=Path, default=HERE.parent / "build-speed",
                        help="folder for results of runs (default ../build-speed)")
    results_option(parser)
    return parser


def parse_kept_runs(parser, defaults):
    """The command line; defaults: of options that --quick changes, name: (quick, full). The program is there."""
    args = parse(parser)
    for name, (quick, full) in defaults.items():
        if getattr(args, name) is None:
            setattr(args, name, quick if args.quick else full)
    lmp = shutil.which(args.lmp) or stop(f"{args.lmp} is not a program; name a LAMMPS with APF by --lmp")
    args.lmp, args.work = os.path.abspath(lmp), args.work.resolve()
    return args


def kept_runs(args):
    """Where results of runs are kept; with --measure nothing none is run."""
    return Store(args.work, ("errors",) if args.measure == "all" else ())


def prose(text):
    """Lines of a text."""
    return textwrap.wrap(" ".join(text.split()), 100)


def verdict(what, value, target, good):
    """One line: measured, target."""
    return f"{what:<58}{value:>8}   target {target:<18}{'reached' if good else 'missed'}"


def median_range(values, form):
    """Median, smallest and largest as text."""
    return f"{statistics.median(values):{form}} ({min(values):{form}} .. {max(values):{form}})"


def keep_table(text, folder, name):
    """Prints a table and writes it to name.txt in the folder of results; the path of the plot beside it."""
    print(text, end="")
    (folder / f"{name}.txt").write_text(text)
    return folder / f"{name}.png"


class Failure(Exception):
    """A run of LAMMPS that ended with an error."""


def environment():
    """Environment of a run: one thread a rank, and what Open MPI wants of root."""
    return dict(os.environ, OMP_NUM_THREADS="1", OMPI_ALLOW_RUN_AS_ROOT="1",
                OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1", OMPI_MCA_rmaps_base_oversubscribe="1")


def lammps_command(lmp, script, variables, log, ranks=1):
    """Command line of a run."""
    launch = ["mpirun", "-np", str(ranks)] if ranks > 1 else []
    words = [w for name, value in variables.items() for w in ("-var", name, str(value))]
    return [*launch, lmp, "-in", str(script), "-log", str(log), "-screen", "none", *words]


def check_log(log, done):
    """Text of a log; Failure with LAMMPS's message if the run did not end well."""
    text = log.read_text() if log.exists() else ""
    error = re.search(r"^ERROR.*", text + "\n" + done.stdout + done.stderr, re.M)
    if error or done.returncode != 0:
        raise Failure(error[0] if error else f"exit code {done.returncode}: {done.stderr[-300:]}")
    return text


def run_lammps(lmp, script, variables, folder, ranks=1):
    """Runs a script and gives its log."""
    log = folder / "log.run"
    log.unlink(missing_ok=True)
    done = subprocess.run(lammps_command(lmp, script, variables, log, ranks), cwd=folder,
                          env=environment(), capture_output=True, text=True)
    return check_log(log, done)


def read_log(text):
    """Loop time [s], share of it on a core, and what fix nve/sphere/mts says."""
    loop = re.findall(r"^Loop time of ([\d.e+-]+)", text, re.M)
    found = re.search(r"mts \S+: (\d+) particle steps of \S+, (\d+) collision steps.*\n"
                      r" +sub-stepped ([\d.]+) %.*, (\d+) contacts at the end.*contacts found late (\d+)", text)
    cpu = re.findall(r"^([\d.]+)% CPU use", text, re.M)
    out = {"loop": float(loop[-1]), "cpu": float(cpu[-1]) / 100}
    if found:
        particle, collision, share, contacts, late = (float(word) for word in found.groups())
        out.update(Lambda=collision / particle, x_c=share / 100, contacts=int(contacts), late=int(late))
    return out


def read_time(result):
    """What of a run's result depends on the machine."""
    return {name: result[name] for name in ("loop", "cpu", "Lambda", "x_c") if name in result}


def processor():
    """Name of the processor."""
    found = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    return found[1] if found else "unknown processor"


# ---------------------------------------------------------------------- results of runs


class Store:
    """Results of runs, one JSON file each; failures are kept as {"failed": reason}."""

    def __init__(self, folder, wanted):
        self.folder, self.wanted = folder, wanted
        folder.mkdir(parents=True, exist_ok=True)

    def get(self, name, make, kind="errors"):
        """Result of the run of that name; None if there is none and that kind is not wanted."""
        path = self.folder / f"{re.sub('[^A-Za-z0-9.+-]+', '_', name)}.json"
        if path.exists():
            return json.loads(path.read_text())
        if kind not in self.wanted:
            return None
        print(f"  {name}", file=sys.stderr, flush=True)
        try:
            result = make()
        except Failure as failure:
            result = {"failed": str(failure)}
        draft = path.with_suffix(".draft")
        draft.write_text(json.dumps(result))
        draft.replace(path)
        return result
