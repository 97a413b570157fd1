"""Impacts of speed_error.py: schemes, scenes, runs, and errors beside exact results."""
from collections import namedtuple
from dataclasses import dataclass

import numpy as np

from lammps_runs import HERE, read_log, read_time, run_lammps, stop

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


def run_impacts(args, scene, scheme):
    """One scheme on one scene: log, outcomes."""
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
    log = read_log(run_lammps(args.lmp, HERE / "in.impacts", variables, folder))
    outcomes, stuck = read_outcomes(folder / "dump", scene, impacts)
    return dict(log, stuck=stuck.tolist(), outcomes=outcomes.round(9).tolist())


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
    """Counts of the scenes of one scheme together."""
    row = {"late": sum(r.get("late", 0) for r in results)}
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


def impact_times(args, store, kind, scenes, schemes):
    """{scheme: loop times [s] of all scenes together}, a list of rounds as far as they ran; in turn."""
    times = {scheme: [] for scheme in schemes}
    for n in range(args.repeat):
        for scheme, loops in times.items():
            results = [store.get(
                f"time of {kind} {args.impacts} {name} {scheme.name} round {n + 1}",
                lambda scene=scene, scheme=scheme: read_time(run_impacts(args, scene, scheme)), "times")
                for name, scene in scenes.items()]
            if all(result and "loop" in result for result in results):
                loops.append(sum(result["loop"] for result in results))
    return times


def impact_rows(args, store, kind, scenes, omega, errors):
    """Rows {scheme, errors} of one set; rows that did not run are left out."""
    rows, schemes = [], impact_schemes(omega)
    for scheme in schemes:
        results = {name: store.get(f"{kind} {args.impacts} {name} {scheme.name}",
                                   lambda scene=scene, scheme=scheme: run_impacts(args, scene, scheme))
                   for name, scene in scenes.items()}
        if any(r is None for r in results.values()):
            continue
        failed = [r["failed"] for r in results.values() if "failed" in r]
        rows.append((scheme, {"failed": failed[0]} if failed else errors(results)))
    times = impact_times(args, store, kind, scenes, schemes)
    return [(scheme, dict(row, time=times[scheme]) if times[scheme] else row) for scheme, row in rows]


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
                       lambda: run_impacts(args, scene, single_rate(kappa, omega)))
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
