#!/usr/bin/python3
"""Speed against error of time integration: single rate, r-RESPA and fix nve/sphere/mts.

    speed_error.py [--quick] [--part impacts|channel|all] [--time T] [--seeds K] [--ranks N]
                   [--impacts N] [--repeat N] [--work DIR] [--results DIR] [--lmp FILE] [--show]

Prints, and writes to results/speed_error.txt with a plot in results/speed_error.png:

  elastic impacts   restitution and sticking velocity of pairs and at a wall, beside exact values
  damped impacts    oblique, with friction, beside the finest run and a Runge-Kutta integrator
  channel           aggregates of examples/channel, beside the mean of single-rate runs over seeds

each with the wall-clock time of the run. Every run leaves a JSON file in DIR (default
../build-speed): the command can be interrupted and goes on where it was; what has run is shown.
Delete DIR after a change of the code. Needs Debian's python3-numpy and python3-matplotlib.
"""
import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import textwrap
from collections import namedtuple
from dataclasses import dataclass, field
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np

HERE = Path(__file__).resolve().parent
CHANNEL = HERE.parent / "examples" / "channel" / "in.channel"

# examples/channel/in.channel, in SI
D, RHO, U, L, LAMBDA = 1e-5, 2600.0, 0.5, 1e-3, 1e4
NU, ALPHA, MU, THETA = 0.3, 1.018, 0.3, 0.01
E_EFF = LAMBDA * RHO * U**2                     # effective modulus                [Pa]
YOUNG = 2 * (1 - NU**2) * E_EFF                 # Young's modulus                  [Pa]
G_EFF = YOUNG / (4 * (1 + NU) * (2 - NU))       # effective shear modulus          [Pa]
MASS = np.pi / 6 * RHO * D**3                   # of a particle                    [kg]
REPORT_STEP = 2.5e-5 * L / U                    # collision step of the report     [s]
LOSS = 0.9355025                                # of touching and parting          [F_C delta_C]

# what is varied
KAPPAS = (0.8, 0.475, 0.3, 0.15, 0.075)         # omega dt of the stiffest mode
TOLERANCES = (0.03, 0.01, 0.003, 0.001)
F2 = (0.05, 0.1, 0.2, 0.5)                      # particle step                    [d/U]
MEETING = 0.5 * D / U                           # impacts happen within this time, ...   [s]
END = 3 * MEETING                               # ... and are over before that one       [s]

COLOURS = {"single rate": "#000000", "respa": "#E69F00", "mts collision N": "#0072B2",
           "mts auto": "#009E73", "mts tolerance": "#D55E00", "mts auto, f2": "#CC79A7"}
MARKERS = dict(zip(COLOURS, "sDov^P"))    # of families in the plot


def stop(reason):
    """Ends with exit code 1 and a message."""
    sys.exit(f"{Path(sys.argv[0]).name}: {reason}")


# ---------------------------------------------------------------------- LAMMPS


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
                      r" +sub-stepped ([\d.]+) %.*contacts found late (\d+)", text)
    cpu = re.findall(r"^([\d.]+)% CPU use", text, re.M)
    out = {"loop": float(loop[-1]), "cpu": float(cpu[-1]) / 100}
    if found:
        particle, collision, share, late = (float(word) for word in found.groups())
        out.update(Lambda=collision / particle, x_c=share / 100, late=int(late))
    return out


def processor():
    """Name of the processor."""
    found = re.search(r"^model name\s*: (.*)$", Path("/proc/cpuinfo").read_text(), re.M)
    return found[1] if found else "unknown processor"


# ---------------------------------------------------------------------- results of runs


class Store:
    """Results of runs, one JSON file each; failures are kept as {"failed": reason}."""

    def __init__(self, folder, show):
        self.folder, self.show = folder, show
        folder.mkdir(parents=True, exist_ok=True)

    def get(self, name, make=None):
        """Result of the run of that name; runs it if need be and allowed, else None."""
        path = self.folder / f"{re.sub('[^A-Za-z0-9.+-]+', '_', name)}.json"
        if path.exists():
            return json.loads(path.read_text())
        if self.show or make is None:
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


# ---------------------------------------------------------------------- closed forms


@dataclass(frozen=True)
class Contact:
    """JKR contact of the dust: of a pair, or of a sphere with a wall."""

    phi: float
    wall: bool = False
    friction: bool = False

    R = property(lambda self: D / 2 if self.wall else D / 4)
    m = property(lambda self: MASS if self.wall else MASS / 2)
    gamma = property(lambda self: self.phi * RHO * U**2 * D / 2)
    a0 = property(lambda self: (9 * np.pi * self.gamma * self.R**2 / E_EFF) ** (1 / 3))
    pulloff = property(lambda self: 3 * np.pi * self.gamma * self.R)
    neck = property(lambda self: self.a0**2 / (2 * 6 ** (1 / 3) * self.R))

    @property
    def sticking(self):
        """Sticking velocity without damping [m/s]."""
        return np.sqrt(2 * LOSS * self.pulloff * self.neck / self.m)

    @property
    def frequency(self):
        """Frequency of the stiffest mode at rest [1/s], as in src/contact/stiffness.h."""
        inertia = 0.4 * self.m * (D / 2) ** 2
        squares = [1.2 * E_EFF * self.a0 / self.m]
        if self.friction:
            squares += [3.5 * 8 * G_EFF * self.a0 / self.m, 4 * self.pulloff * self.R / inertia]
        return np.sqrt(max(squares))


def exact_restitution(ratio):
    """e of an elastic adhesive impact at V/V_s."""
    return np.sqrt(np.maximum(0, 1 - 1 / ratio**2))


def contact_root(overlap, root):
    """sqrt(a/a0) on the stable branch for overlap/delta_C, by Newton's method from `root`."""
    c = 6 ** (1 / 3)
    for _ in range(6):
        step = (c * (2 * root**4 - 4 / 3 * root) - overlap) / (c * (8 * root**3 - 4 / 3))
        root = np.maximum(root - step, 6 ** (-1 / 3) + 1e-12)
    return root


def runge_kutta_restitution(ratio, alpha, h=2e-3):
    """e of head-on damped impacts at V/V_s (elastic V_s); lengths in delta_C, forces in F_C."""
    m, c = 2 * LOSS, 4 / 3 / 1.2114137    # (4/3) E a = c F_C/delta_C a/a0
    ratio = np.asarray(ratio, float)
    x, v, e = np.zeros_like(ratio), ratio.copy(), np.zeros_like(ratio)
    s, going = np.full_like(ratio, 0.9), np.full(ratio.shape, True)

    def acceleration(x, v):
        root = contact_root(np.maximum(x, -1), s)
        return -(4 * (root**6 - root**3) + alpha * np.sqrt(m * c) * root * v) / m

    while going.any():
        k1 = acceleration(x, v)
        v2 = v + h / 2 * k1
        k2 = acceleration(x + h / 2 * v, v2)
        v3 = v + h / 2 * k2
        k3 = acceleration(x + h / 2 * v2, v3)
        v4 = v + h * k3
        k4 = acceleration(x + h * v3, v4)
        dx, dv = h / 6 * (v + 2 * v2 + 2 * v3 + v4), h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
        ended = going & (x + dx <= -1)
        e[ended] = -(v + dv * (-1 - x) / np.where(dx == 0, 1, dx))[ended] / ratio[ended]
        going &= ~ended & ~((v < 0) & (v + dv > 0))    # parted, or turned back by the neck
        x, v = np.where(going, x + dx, 0), np.where(going, v + dv, 1)
        s = np.where(going, contact_root(np.maximum(x, -1), s), 0.9)
    return e


def runge_kutta_sticking(alpha):
    """Sticking velocity with damping over the elastic one."""
    low, high = 1.0, 60.0
    while high - low > 1e-4:
        trial = np.linspace(low, high, 9)
        parts = runge_kutta_restitution(trial, alpha) > 0
        k = int(np.argmax(parts))
        low, high = trial[k - 1], trial[k]
    return (low + high) / 2


# ---------------------------------------------------------------------- impacts: schemes


@dataclass(frozen=True)
class Scheme:
    """A way to step in time."""

    family: str
    setting: str
    integrate: str
    step: float         # LAMMPS's timestep                              [s]
    respa: int = 0      # inner steps of r-RESPA; 0 = run_style verlet

    name = property(lambda self: f"{self.family} {self.setting}")


def particle_step(f2):
    """Particle step [s]."""
    return f2 * D / U


def single_rate(kappa, omega, setting=None):
    """Every step a collision step."""
    return Scheme("single rate", setting or f"{kappa:g}", "nve/sphere", kappa / omega)


def mts(family, setting, words, f2=0.1):
    """Collision steps inside a particle step."""
    return Scheme(family, setting, f"nve/sphere/mts collision {words}", particle_step(f2))


def impact_schemes(omega):
    """All schemes for contacts of that frequency."""
    report = omega * REPORT_STEP
    kappas = sorted({*KAPPAS, *([report] if min(abs(report / k - 1) for k in KAPPAS) > 0.05
                                else [])}, reverse=True)
    label = {k: f"{k:.3g}" + (" (report)" if abs(report / k - 1) <= 0.05 else "") for k in kappas}
    inner = {k: int(np.ceil(particle_step(0.1) * omega / k)) for k in kappas}
    schemes = [single_rate(k, omega, label[k]) for k in kappas]
    schemes += [Scheme("respa", label[k], "nve/sphere", particle_step(0.1), inner[k])
                for k in kappas]
    schemes += [mts("mts collision N", f"{label[k]} N={inner[k]}", inner[k]) for k in kappas]
    schemes += [mts("mts auto", f"{k:g}", f"auto safety {k:g}") for k in KAPPAS]
    schemes += [mts("mts tolerance", f"{t:g}", f"tolerance {t:g}") for t in TOLERANCES]
    schemes += [mts("mts auto, f2", f"{f2:g}", "auto safety 0.15", f2) for f2 in F2]
    schemes += [mts("mts, blind", "lookahead no", "auto safety 0.15 lookahead no")]
    return schemes


# ---------------------------------------------------------------------- impacts: scenes


@dataclass(frozen=True)
class Scene:
    """Impacts that run together."""

    name: str
    contact: Contact
    speeds: tuple           # smallest, largest, of the elastic sticking velocity
    law: str                # words after E, nu, gamma
    angles: tuple = (0.0,)  # between velocity and line of centres at touch        [degrees]
    salt: int = 0           # of the random numbers

    fastest = property(lambda self: self.speeds[1] * self.contact.sticking)
    spread = property(lambda self: (2.1 if self.contact.wall else 1.5) * self.fastest)

    def skin(self, step):
        """Neighbour skin [m]: what look-ahead and single rate need."""
        return max(D, 3.2 * step * self.spread)


Impacts = namedtuple("Impacts", "ratio angle turn time")


def draw_impacts(scene, n):
    """V/V_s, evenly spaced; angle; direction of the line of centres; time until they touch."""
    random = np.random.default_rng(4711 + scene.salt)
    ratio = np.linspace(*scene.speeds, n)
    angle = np.radians(np.resize(scene.angles, n))
    turn = random.uniform(0, 2 * np.pi, n)
    return Impacts(ratio, angle, turn, MEETING * random.uniform(0.05, 1.05, n))


def axes(impacts):
    """Unit vectors along the line of centres and across, [n][2]."""
    c, s = np.cos(impacts.turn), np.sin(impacts.turn)
    return np.stack([c, s], 1), np.stack([-s, c], 1)


def pair_bodies(scene, impacts):
    """Positions and velocities of pairs [2 n][2], and the box's length and height [m]."""
    n = len(impacts.ratio)
    along, across = axes(impacts)
    speed = impacts.ratio * scene.contact.sticking
    v = speed[:, None] * (np.cos(impacts.angle)[:, None] * along
                          + np.sin(impacts.angle)[:, None] * across)    # of i relative to j
    pitch = scene.fastest * (END + 2.5 * MEETING) + 4 * D
    side = int(np.ceil(np.sqrt(n)))
    cells = np.stack([np.arange(n) % side, np.arange(n) // side], 1)
    middle = (cells + 0.5) * pitch
    apart = D * along + v * impacts.time[:, None]                       # from i to j
    x = np.stack([middle - apart / 2, middle + apart / 2], 1).reshape(-1, 2)
    return x, np.stack([v / 2, -v / 2], 1).reshape(-1, 2), (side * pitch, side * pitch)


def wall_bodies(scene, impacts):
    """Positions and velocities of spheres that fall on the wall y = 0, and the box."""
    n = len(impacts.ratio)
    speed = impacts.ratio * scene.contact.sticking
    pitch = 3.5 * scene.spread * MEETING + 4 * D
    x = np.stack([(np.arange(n) + 0.5) * pitch, D / 2 + speed * impacts.time], 1)
    v = np.stack([np.zeros(n), -speed], 1)
    return x, v, (n * pitch, scene.fastest * END + 4 * D)


def write_scene(path, bodies):
    """Writes a data file."""
    x, v, (length, height) = bodies
    with open(path, "w") as out:
        out.write(f"impacts\n\n{len(x)} atoms\n1 atom types\n\n0 {length:.17g} xlo xhi\n"
                  f"0 {height:.17g} ylo yhi\n{-D / 2} {D / 2} zlo zhi\n\nAtoms\n\n")
        out.writelines(f"{i} 1 {D} {RHO} {a:.17g} {b:.17g} 0\n" for i, (a, b) in enumerate(x, 1))
        out.write("\nVelocities\n\n")
        out.writelines(f"{i} {a:.17g} {b:.17g} 0 0 0 0\n" for i, (a, b) in enumerate(v, 1))


def read_outcomes(path, scene, impacts):
    """Relative velocity along, across and spin times radius, over V [n][3]; 1 where they stuck."""
    rows = np.loadtxt(path, skiprows=9)[:, 1:]
    speed = (impacts.ratio * scene.contact.sticking)[:, None]
    if scene.contact.wall:
        out = np.stack([rows[:, 1], rows[:, 0], rows[:, 2] * D / 2], 1) / speed
        return out, rows[:, 3] > 0
    i, j = rows[0::2], rows[1::2]
    along, across = axes(impacts)
    v = j[:, :2] - i[:, :2]    # parting
    spin = (i[:, 2] + j[:, 2]) / 2 * D / 2
    out = np.stack([(v * along).sum(1), (v * across).sum(1), spin], 1) / speed
    return out, i[:, 3] > 0


def run_impacts(args, scene, scheme, repeat):
    """One scheme on one scene: log, fastest loop of `repeat` runs, outcomes."""
    folder = args.work / "scratch"
    folder.mkdir(parents=True, exist_ok=True)
    impacts = draw_impacts(scene, args.impacts)
    write_scene(folder / "data", (wall_bodies if scene.contact.wall else pair_bodies)(scene,
                                                                                      impacts))
    outer = max(scheme.step, particle_step(0.1))    # single rate: the skin of f2 = 0.1
    c = scene.contact
    variables = {"scene": "wall" if c.wall else "pair", "data": "data", "out": "dump",
                 "skin": scene.skin(outer), "bin": scene.skin(particle_step(max(F2))) / 2,
                 "law": f"jkr {YOUNG:.12g} {NU} {c.gamma:.12g} {scene.law}".strip(),
                 "check": "no" if scheme.respa else "yes", "integrate": scheme.integrate,
                 "dt": scheme.step, "respa": scheme.respa, "steps": int(round(END / scheme.step))}
    logs = [read_log(run_lammps(args.lmp, HERE / "in.impacts", variables, folder))
            for _ in range(repeat)]
    outcomes, stuck = read_outcomes(folder / "dump", scene, impacts)
    return dict(min(logs, key=lambda log: log["loop"]), stuck=stuck.tolist(),
                outcomes=outcomes.round(9).tolist())


def elastic_scenes():
    """Pairs and wall at phi = 50; around the sticking velocity, and faster."""
    pair, wall = Contact(50), Contact(50, wall=True)
    return {"pair slow": Scene("pair slow", pair, (0.7, 1.3), "damping none", salt=1),
            "pair": Scene("pair", pair, (0.5, 5.0), "damping none", salt=2),
            "wall slow": Scene("wall slow", wall, (0.7, 1.3), "damping none", salt=3),
            "wall": Scene("wall", wall, (0.5, 5.0), "damping none", salt=4)}


def damped_scenes(sticking):
    """Head-on around the sticking velocity, and oblique; at phi = 1.5, where dust rebounds."""
    pair = Contact(1.5, friction=True)
    law = f"damping alpha {ALPHA} sliding {MU} rolling {THETA}"
    return {"pair slow": Scene("pair slow", pair, (0.7 * sticking, 1.6 * sticking), law, salt=5),
            "oblique": Scene("oblique", pair, (1.2 * sticking, 3 * sticking), law,
                             (0.0, 20.0, 40.0, 60.0), salt=6)}


# ---------------------------------------------------------------------- impacts: errors


def measured_sticking(scene, result):
    """Sticking velocity over the elastic one: where as many stick above as part below."""
    low, high = scene.speeds
    return low + (high - low) * np.mean(result["stuck"])


def common(results):
    """Wall-clock time and counts of the scenes of one scheme together."""
    loops = np.array([r["loop"] for r in results])
    row = {"time": loops.sum(), "late": sum(r.get("late", 0) for r in results)}
    if "Lambda" in results[0]:
        row["Lambda"] = np.mean([r["Lambda"] for r in results])
        row["x_c"] = np.mean([r["x_c"] for r in results])
    return row


def elastic_errors(scenes, results):
    """Errors of restitution at V > 1.2 V_s and of sticking velocities."""
    off = []
    for name in ("pair", "wall"):
        ratio = np.linspace(*scenes[name].speeds, len(results[name]["stuck"]))
        e = np.array(results[name]["outcomes"])[:, 0] * ~np.array(results[name]["stuck"])
        off.append(abs(e - exact_restitution(ratio))[ratio > 1.2])
    row = common(list(results.values()))
    row.update(mean=np.mean(np.concatenate(off)), max=np.max(np.concatenate(off)))
    for name in ("pair", "wall"):
        row[f"V_s {name}"] = measured_sticking(scenes[f"{name} slow"],
                                               results[f"{name} slow"]) - 1
    return row


def damped_errors(scenes, results, finest, head_on, sticking):
    """Errors of rebounds from the finest run's, of head-on ones from Runge-Kutta, and of V_s."""
    outcomes, reference = np.array(results["oblique"]["outcomes"]), np.array(finest["outcomes"])
    stuck, keeps = np.array(results["oblique"]["stuck"]), ~np.array(finest["stuck"])
    off = np.linalg.norm(outcomes - reference, axis=1)[keeps]
    straight = np.arange(len(stuck)) % len(scenes["oblique"].angles) == 0
    row = common(list(results.values()))
    row.update(mean=np.mean(off), max=np.max(off),
               head=np.mean(abs((outcomes[:, 0] * ~stuck)[straight] - head_on)))
    row["V_s pair"] = measured_sticking(scenes["pair slow"], results["pair slow"]) / sticking - 1
    return row


def impact_rows(args, store, kind, scenes, omega, errors):
    """Rows {scheme, errors} of one set; rows that did not run are left out."""
    rows = []
    for scheme in impact_schemes(omega):
        results = {}
        for name, scene in scenes.items():
            results[name] = store.get(
                f"{kind} {args.impacts} {name} {scheme.name}",
                lambda scene=scene, scheme=scheme: run_impacts(args, scene, scheme, args.repeat))
        if any(r is None for r in results.values()):
            continue
        failed = [r["failed"] for r in results.values() if "failed" in r]
        rows.append((scheme, {"failed": failed[0]} if failed else errors(results)))
    return rows


def elastic_set(args, store):
    """Rows of the elastic impacts."""
    scenes = elastic_scenes()
    return impact_rows(args, store, "elastic", scenes, Contact(50).frequency,
                       lambda results: elastic_errors(scenes, results))


def damped_set(args, store):
    """Rows of the damped impacts, and facts about their reference; None if there is none yet."""
    known = store.get("damped sticking velocity",
                      lambda: {"ratio": runge_kutta_sticking(ALPHA)})
    if known is None:
        return None
    sticking, scenes = known["ratio"], damped_scenes(known["ratio"])
    scene, omega = scenes["oblique"], Contact(1.5, friction=True).frequency
    kappa = 0.03 if args.quick else 0.01
    finest = store.get(f"damped {args.impacts} finest {kappa}",
                       lambda: run_impacts(args, scene, single_rate(kappa, omega), 1))
    straight = np.linspace(*scene.speeds, args.impacts)[::len(scene.angles)]
    exact = store.get(f"damped {args.impacts} head-on",
                      lambda: {"e": runge_kutta_restitution(straight, ALPHA).tolist()})
    if finest is None or exact is None:
        return None
    if "failed" in finest:
        stop(f"the finest run of the damped impacts failed: {finest['failed']}")
    head_on = np.array(exact["e"])
    reference = np.array(finest["outcomes"])[::len(scene.angles), 0]
    rows = impact_rows(args, store, "damped", scenes, omega, lambda results: damped_errors(
        scenes, results, finest, head_on, sticking))
    return {"rows": rows, "sticking": sticking, "kappa": kappa,
            "agree": float(np.max(abs(reference - head_on)))}


# ---------------------------------------------------------------------- channel


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


def run_channel(args, scheme, seed):
    """One run: log, and quantities averaged over the last fifth."""
    folder = args.work / "scratch-channel"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    variables = {"integrate": scheme.integrate, "step": scheme.step, "seed": seed, "t": args.time,
                 "dir": folder, "picture": 2 * args.time + 1}
    log = run_lammps(args.lmp, channel_script(folder, scheme), variables, folder, args.ranks)
    rows = np.loadtxt(folder / "channel-phi50.aggregates", ndmin=2)
    last = rows[rows[:, 1] >= 0.8 * args.time - 1e-6]
    return dict(read_log(log), **{name: float(last[:, k].mean())
                                  for name, k in QUANTITIES.items()})


def channel_rows(args, store):
    """Results of each scheme by seed, as far as they ran; all schemes of a seed, then the next."""
    rows = {scheme: {} for scheme in channel_schemes()}
    for seed in range(4711, 4711 + args.seeds):
        for scheme, results in rows.items():
            result = store.get(f"channel t={args.time:g} np={args.ranks} {scheme.name} {seed}",
                               lambda s=scheme, seed=seed: run_channel(args, s, seed))
            if result is not None:
                results[seed] = result
    return rows


def channel_errors(scheme, results, reference):
    """Relative differences from the reference's mean, cost and speed-up of one scheme.

    Both are lists of results, of the same seeds.
    """
    mean = {q: np.mean([r[q] for r in reference]) for q in QUANTITIES}
    time = np.mean([r["loop"] for r in results])
    row = {"time": time, "seeds": len(results),
           "speedup": np.mean([r["loop"] for r in reference]) / time,
           "late": sum(r.get("late", 0) for r in results),
           "cpu": np.mean([r["cpu"] for r in results])}
    for q in QUANTITIES:
        row[q] = np.mean([r[q] for r in results]) / mean[q] - 1 if mean[q] else np.nan
    row["rms"] = np.sqrt(np.nanmean([row[q] ** 2 for q in QUANTITIES]))
    if "Lambda" in results[0]:
        steps, share = (np.mean([r[k] for r in results]) for k in ("Lambda", "x_c"))
        cost = 1 + share * steps
        row.update(Lambda=steps, x_c=share, model=steps / cost, bound=scheme.step / 2.5e-5 / cost)
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
    found = channel_rows(args, store)
    good = {scheme: {seed: r for seed, r in results.items() if "failed" not in r}
            for scheme, results in found.items()}
    reference = next(iter(good.values()))
    if not reference:
        return Channel()
    rows = []
    for scheme, results in found.items():
        both = [seed for seed in good[scheme] if seed in reference]
        if both:
            rows.append((scheme, channel_errors(scheme, [good[scheme][seed] for seed in both],
                                                [reference[seed] for seed in both])))
        elif results:
            failed = [r["failed"] for r in results.values() if "failed" in r]
            rows.append((scheme, {"failed": failed[0] if failed else "the reference did not run"}))
    return Channel(rows, seed_spread(list(reference.values())))


# ---------------------------------------------------------------------- tables


def percent(value, digits=2):
    """A share as text in percent."""
    return "-" if value is None or np.isnan(value) else f"{100 * value:+.{digits}f}"


def prose(text):
    """Lines of a text."""
    return textwrap.wrap(" ".join(text.split()), 100)


def number(row, key, form):
    """A value of a row as text."""
    return format(row[key], form) if key in row else "-"


def impact_lines(rows, columns):
    """Table of one set of impacts; columns: name -> text of a row."""
    lines = [f"{'scheme':<17}{'setting':<22}{'time [s]':>9}{'Lambda':>8}{'x_c':>7}"
             + "".join(f"{name:>11}" for name in columns) + f"{'late':>6}"]
    for scheme, row in rows:
        head = f"{scheme.family:<17}{scheme.setting:<22}"
        if "failed" in row:
            lines.append(f"{head} failed: {row['failed']}"[:100])
            continue
        lines.append(head + f"{row['time']:>9.3f}{number(row, 'Lambda', '.1f'):>8}"
                     f"{number(row, 'x_c', '.3f'):>7}"
                     + "".join(f"{text(row):>11}" for text in columns.values())
                     + f"{row['late'] if 'Lambda' in row else '-':>6}")
    return lines


def elastic_lines(args, rows):
    """Text on the elastic impacts."""
    columns = {"mean |de|": lambda row: f"{row['mean']:.5f}",
               "max |de|": lambda row: f"{row['max']:.5f}",
               "V_s pair %": lambda row: percent(row["V_s pair"]),
               "V_s wall %": lambda row: percent(row["V_s wall"])}
    pair, wall = Contact(50), Contact(50, wall=True)
    return [*prose(f"""Elastic impacts, phi = 50: {args.impacts} head-on pairs and as many on a
                   wall at 0.5 to 5 V_s, and both again at 0.7 to 1.3 V_s; random phases to the
                   time grid. |de|: from sqrt(1 - (V_s/V)^2) at V > 1.2 V_s. V_s exact
                   {pair.sticking:.4f} m/s (pair), {wall.sticking:.4f} m/s (wall); omega
                   {pair.frequency:.4g}/s (normal, pair)."""), "", *impact_lines(rows, columns)]


def damped_lines(args, known):
    """Text on the damped impacts."""
    columns = {"mean err": lambda row: f"{row['mean']:.5f}",
               "max err": lambda row: f"{row['max']:.5f}",
               "head-on de": lambda row: f"{row['head']:.5f}",
               "V_s pair %": lambda row: percent(row["V_s pair"])}
    contact = Contact(1.5, friction=True)
    return [*prose(f"""Damped impacts with friction, phi = 1.5: alpha {ALPHA}, mu {MU}, theta
                   {THETA}; {args.impacts} pairs at 0, 20, 40, 60 degrees and 1.2 to 3 V_s, and
                   as many head-on at 0.7 to 1.6 V_s. err: relative velocity and spin x
                   radius after the
                   impact, over V, from the finest run (single rate, omega dt = {known['kappa']});
                   head-on de: e from Runge-Kutta, which that run meets within
                   {known['agree']:.1e}. V_s by Runge-Kutta
                   {known['sticking'] * contact.sticking:.4f} m/s, {known['sticking']:.3f} times the
                   elastic one; omega {contact.frequency:.4g}/s (tangential)."""), "",
            *impact_lines(known["rows"], columns)]


def channel_lines(args, channel):
    """Text on the channel."""
    names = "".join(f"{q + ' %':>10}" for q in QUANTITIES)
    lines = [*prose(f"""Channel, phi = 50, to t = {args.time:g} L/U, {args.ranks} rank(s), up to
                    {args.seeds} seed(s): particles in aggregates, aggregates, their mean size and
                    particles in those on a wall, means over the last fifth, less those of the
                    single rate at the report's step and the same seeds. Lambda: collision steps of
                    a particle step; x_c: share of particles sub-stepped; bound on the speed-up: the
                    report's steps in a particle step / (1 + x_c Lambda); model: Lambda/(1 + x_c
                    Lambda), the bound where single rate has the same collision step; cpu: share of
                    the time on a core, well below 100 on a busy machine."""), "",
             f"{'scheme':<17}{'setting':<9}{'seeds':>5}{'time [s]':>10}{names}{'Lambda':>8}"
             f"{'x_c':>7}{'speed-up':>9}{'bound':>7}{'model':>7}{'late':>6}{'cpu %':>7}"]
    for scheme, row in channel.rows:
        head = f"{scheme.family:<17}{scheme.setting:<9}"
        if "failed" in row:
            lines.append(f"{head} failed: {row['failed']}"[:100])
            continue
        lines.append(head + f"{row['seeds']:>5}{row['time']:>10.1f}"
                     + "".join(f"{percent(row[q]):>10}" for q in QUANTITIES)
                     + f"{number(row, 'Lambda', '.1f'):>8}{number(row, 'x_c', '.3f'):>7}"
                     f"{row['speedup']:>9.2f}{number(row, 'bound', '.2f'):>7}"
                     f"{number(row, 'model', '.2f'):>7}"
                     f"{row['late'] if 'Lambda' in row else '-':>6}{100 * row['cpu']:>7.0f}")
    lines.append(f"{'standard deviation of single rate':<41}"
                 + "".join(f"{percent(channel.spread[q]).lstrip('+'):>10}" for q in QUANTITIES))
    return lines


def report(args, elastic, damped, channel):
    """The text that is printed and written."""
    blocks = [prose(f"""{processor()}; wall-clock times are LAMMPS's loop times, one core unless
                    said otherwise; impacts: least of {args.repeat} run(s). Numbers beside single
                    rate, respa, N and auto are omega dt of the stiffest mode at rest, beside f2 the
                    particle step in d/U, else 0.1; late: contacts found late; blind: lookahead no.
                    Impacts under respa rebuild the neighbour list every particle step: it is
                    checked after the inner steps only.""")]
    if elastic:
        blocks.append(elastic_lines(args, elastic))
    if damped and damped["rows"]:
        blocks.append(damped_lines(args, damped))
    if channel.rows:
        blocks.append(channel_lines(args, channel))
    return "\n\n".join("\n".join(block) for block in blocks) + "\n"


# ---------------------------------------------------------------------- plot


def draw_families(axis, rows, error, look):
    """One line for each family of schemes; says whether there is any."""
    any_points = False
    for family in COLOURS:
        points = [(row["time"], row[error]) for scheme, row in rows
                  if scheme.family == family and "failed" not in row and row[error] > 0]
        if points:
            axis.plot(*zip(*points), marker=MARKERS[family], color=COLOURS[family], **look)
            any_points = True
    return any_points


def draw_impacts_panel(axis, elastic, damped):
    """Error of impacts over wall-clock time."""
    if draw_families(axis, elastic, "mean", {"linestyle": "-"}):
        axis.set(xscale="log", yscale="log")
    if damped:
        draw_families(axis, damped["rows"], "mean", {"linestyle": ":", "markerfacecolor": "none"})
    axis.plot([], [], "k-", label="elastic: mean |e - exact|, V > 1.2 $V_s$")
    axis.plot([], [], "k:", label="damped, oblique: mean error / V")
    axis.set(title="impacts", xlabel="wall-clock time [s]", ylabel="mean error [-]")


def draw_channel_panel(axis, channel):
    """Difference from single rate over wall-clock time."""
    rows = [(s, dict(row, rms=100 * row["rms"])) for s, row in channel.rows if "failed" not in row]
    if draw_families(axis, rows, "rms", {"linestyle": "-"}):
        axis.set(xscale="log", yscale="log")
    if rows:
        axis.axvline(rows[0][1]["time"], color="k", linewidth=0.9, linestyle="--",
                     label="single rate at the report's step")
        if not np.isnan(channel.spread["rms"]):
            axis.axhline(100 * channel.spread["rms"], color="0.4", linestyle="-.", linewidth=0.9,
                         label="its standard deviation over seeds")
    axis.set(title="channel", xlabel="wall-clock time [s]",
             ylabel="rms difference of four aggregate statistics [%]")


def draw(elastic, damped, channel, path):
    """Error over wall-clock time: impacts on the left, the channel on the right."""
    figure, panels = plt.subplots(1, 2, figsize=(11.5, 5.4))
    draw_impacts_panel(panels[0], elastic, damped)
    draw_channel_panel(panels[1], channel)
    for axis in panels:
        axis.grid(True, which="major", color="0.9")
        axis.spines[["top", "right"]].set_visible(False)
        if axis.get_legend_handles_labels()[0]:
            axis.legend(fontsize=8, frameon=False)
    handles = [plt.Line2D([], [], color=COLOURS[f], marker=MARKERS[f], label=f) for f in COLOURS]
    figure.legend(handles=handles, loc="lower center", ncol=len(COLOURS), frameon=False, fontsize=9)
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    figure.savefig(path, dpi=120)
    plt.close(figure)


# ---------------------------------------------------------------------- main


def arguments():
    """Command line."""
    parser = argparse.ArgumentParser(description="Speed against error of time integration.")
    parser.add_argument("--quick", action="store_true", help="few impacts and a short channel")
    parser.add_argument("--part", choices=("impacts", "channel", "all"), default="all")
    parser.add_argument("--time", type=float, help="end of the channel [L/U] (default 20)")
    parser.add_argument("--seeds", type=int, help="runs of each channel scheme (default 3)")
    parser.add_argument("--ranks", type=int, default=1, help="MPI ranks of the channel (default 1)")
    parser.add_argument("--impacts", type=int, help="impacts of a scene (default 2000)")
    parser.add_argument("--repeat", type=int, help="runs of each impact scene (default 3)")
    parser.add_argument("--lmp", default=HERE.parent / "lmp",
                        help="LAMMPS with APF (default ../lmp)")
    parser.add_argument("--work", type=Path, default=HERE.parent / "build-speed",
                        help="folder for results of runs (default ../build-speed)")
    parser.add_argument("--results", type=Path, default=HERE / "results",
                        help="folder for table and plot (default results, beside this)")
    parser.add_argument("--show", action="store_true", help="run nothing, show what has run")
    args = parser.parse_args()
    full, quick = (20.0, 3, 2000, 3), (0.5, 1, 200, 1)
    for name, value in zip(("time", "seeds", "impacts", "repeat"), quick if args.quick else full):
        if getattr(args, name) is None:
            setattr(args, name, value)
    if not shutil.which(args.lmp):
        stop(f"{args.lmp} is not a program; name a LAMMPS with APF by --lmp")
    args.lmp, args.work = os.path.abspath(shutil.which(args.lmp)), args.work.resolve()
    return args


def collect(args, store):
    """Rows of all parts, by running what is missing."""
    elastic = damped = None
    if args.part != "channel":
        elastic, damped = elastic_set(args, store), damped_set(args, store)
    return elastic or [], damped, channel_set(args, store) if args.part != "impacts" else Channel()


def main():
    """Runs what is missing, prints, writes and draws."""
    args = arguments()
    store = Store(args.work, args.show)
    try:
        found = collect(args, store)
    except KeyboardInterrupt:
        print("interrupted; the same command goes on from here", file=sys.stderr)
        found = collect(args, Store(args.work, True))
    elastic, damped, channel = found
    if not (elastic or damped or channel.rows):
        stop(f"{args.work}: nothing has run yet")
    text = report(args, *found)
    print(text, end="")
    args.results.mkdir(parents=True, exist_ok=True)
    (args.results / "speed_error.txt").write_text(text)
    draw(*found, args.results / "speed_error.png")


if __name__ == "__main__":
    main()
