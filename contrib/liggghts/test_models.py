#!/usr/bin/python3
"""Tests of the contact models of this folder, run by LIGGGHTS: against closed forms.

    test_models.py [PROGRAM]     PROGRAM as ./build prints it; ./test does both

Exit code 77: skipped, because LIGGGHTS with the models has not been built.
"""
import math
import shutil
import sys
import unittest

import numpy as np

from scenes import JKR, REST, run, scene, table, thermo

E, NU, GAMMA, MU, THETA = 1.0e6, 0.25, 100.0, 0.3, 0.01
E_EFF = 0.5 * E / (1 - NU**2)
G_EFF = 0.25 * E / ((1 + NU) * (2 - NU))    # 1/G = sum of (2 - nu)/G of the bodies
PAIR = JKR(0.25, E_EFF, GAMMA)
WALL = JKR(0.5, E_EFF, GAMMA)
MASS = math.pi / 6
INERTIA = 0.1 * MASS
PARTS = "tangential adhesive rolling_friction dominik_tielens twisting on"
program = ""


def models(spheres, words="", restitution=1.0, adhesion=2 * GAMMA, boundary="p p p"):
    """Head of a script with our models."""
    laws = [
        f"fix m1 all property/global youngsModulus peratomtype {E}",
        f"fix m2 all property/global poissonsRatio peratomtype {NU}",
        f"fix m3 all property/global coefficientRestitution peratomtypepair 1 {restitution}",
        f"fix m4 all property/global surfaceEnergy peratomtypepair 1 {adhesion}",
        f"fix m5 all property/global coefficientFriction peratomtypepair 1 {MU}",
        f"fix m6 all property/global criticalRollingAngle peratomtypepair 1 {THETA}",
        f"pair_style gran model jkr {words}", "pair_coeff * *",
    ]
    return scene("LIGGGHTS", spheres, "\n".join(laws), boundary)


def pair_on_x(gap, speed, **words):
    """Two spheres along x whose second moves away from the first at a speed."""
    half = np.array([0.5 * speed, 0.0, 0.0])
    return models([((3, 4, 4), -half, REST), ((4 + gap, 4, 4), half, REST)], **words)


def step_of(law, mass):
    """A fiftieth of the period in the bottom of the normal force."""
    return 2 * math.pi / math.sqrt(0.990578 * law.F_C / law.delta_C / mass) / 50


class PullOff(unittest.TestCase):
    """Bodies that are moved at a constant speed, first together, then apart."""

    def curves(self, law, make):
        """Overlap and force while the bodies come together and while they part."""
        steps, way = 400, 4 * law.delta_C    # from a gap of 2 delta_C to an overlap of 2 delta_C
        speed = way / steps
        together = table(program, make(way / 2, -speed) + f"run {steps}\n")
        both = table(program, make(way / 2, -speed) + f"run {steps}\n" + self.turned(speed) +
                     f"run {steps}\n")
        return together, both[steps + 1:]

    def returned(self, law, make):
        """The same while they come together again after the neck has ended."""
        steps, way = 400, 4 * law.delta_C
        speed, far = way / steps, 330    # steps to a gap of 1.3 delta_C
        rows = table(program, make(way / 2, -speed) + f"run {steps}\n" + self.turned(speed) +
                     f"run {far}\n" + self.turned(-speed) + f"run {far}\n")
        return rows[steps + far + 2:]

    def check(self, law, rows, parting):
        overlap, force = rows[:, 1], rows[:, 2]
        reach = law.delta_C if parting else 0.0
        near = np.abs(overlap + reach) < 1e-9 * law.delta_C    # either is right
        held = (overlap > -reach) & ~near
        exact = np.array([law.force(d) for d in overlap[held]])
        np.testing.assert_allclose(force[held] / law.F_C, exact / law.F_C, atol=1e-8)
        np.testing.assert_array_equal(force[~held & ~near], 0.0)
        return overlap[force != 0.0], force[force != 0.0] / law.F_C

    def check_both(self, law, together, apart):
        overlap, force = self.check(law, together, False)
        self.assertGreater(overlap.min(), -1e-9 * law.delta_C)
        self.assertAlmostEqual(force[np.argmin(overlap)], -8 / 9, delta=0.01)
        overlap, force = self.check(law, apart, True)
        self.assertAlmostEqual(force.min(), -1.0, delta=1e-4)
        self.assertAlmostEqual(overlap[np.argmin(force)] / law.delta_C, -(9 ** (-1 / 3)), delta=0.02)
        self.assertAlmostEqual(overlap.min() / law.delta_C, -1.0, delta=0.0101)    # one step
        self.assertTrue(-0.66 < force[np.argmin(overlap)] < -5 / 9 + 1e-8)    # at -0.99: -0.649

    def turned(self, speed):
        return (f"velocity g1 set {-0.5 * speed:.17g} 0 0 units box\n"
                f"velocity g2 set {0.5 * speed:.17g} 0 0 units box\n")

    def test_pair(self):
        def make(gap, speed):
            return (pair_on_x(gap, speed) + "fix move all nve/noforce\ntimestep 1\nthermo 1\n" +
                    thermo("1-(x[2]-x[1])", "fx[2]") + "\n")

        self.check_both(PAIR, *self.curves(PAIR, make))
        self.check(PAIR, self.returned(PAIR, make), False)


class PullOffWall(PullOff):
    """The same from a flat wall."""

    def turned(self, speed):
        return f"velocity g1 set 0 0 {speed:.17g} units box\n"

    def test_pair(self):
        pass

    def test_wall(self):
        def make(gap, speed):
            return (models([((4, 4, 0.5 + gap), (0, 0, speed), REST)], boundary="p p f") +
                    "fix wall all wall/gran model jkr primitive type 1 zplane 0.0\n"
                    "fix move all nve/noforce\ntimestep 1\nthermo 1\n" +
                    thermo("0.5-z[1]", "fz[1]") + "\n")

        self.check_both(WALL, *self.curves(WALL, make))
        self.check(WALL, self.returned(WALL, make), False)


class Doublet(unittest.TestCase):
    """Two spheres that hold each other."""

    def test_comes_to_rest_at_equilibrium(self):
        step = step_of(PAIR, MASS / 2)
        rows = table(program, pair_on_x(0.1 * PAIR.delta_C, -0.05, words=PARTS, restitution=0.2) +
                     f"fix move all nve/sphere\ntimestep {step}\nthermo 1000\n" +
                     thermo("1-(x[2]-x[1])", "fx[2]") + "\nrun 4000\n")
        self.assertAlmostEqual(rows[-1, 1] / PAIR.delta_C, 1.211414, delta=1e-6)
        self.assertAlmostEqual(rows[-1, 2] / PAIR.F_C, 0.0, delta=1e-6)

    def roll(self, turns, drift, ranks=1, zeta=0.0):
        """Rolls to and fro while the doublet turns about the axis of rolling; error of the relative
        spin in twenty periods, by its amplitude."""
        I = INERTIA
        # the overlap at which the neck bears what turning about the middle takes
        overlap = PAIR.overlap_at(-MASS * turns**2 * 0.5)
        k = 4 * PAIR.F_C * PAIR.radius(overlap) ** 1.5
        omega = math.sqrt(2 * k * PAIR.R / I)
        spin = 0.2 * THETA * omega / 2    # a fifth of the critical angle
        distance = 1 - overlap
        v = np.array([0.0, 0.5 * turns * distance, 0.0])
        drift = np.array(drift)
        step = step_of(PAIR, MASS / 2) / 2
        steps = round(20 * 2 * math.pi / omega / step)
        script = models([((3, 4, 4), drift - v, (0, 0, turns + spin)),
                         ((3 + distance, 4, 4), drift + v, (0, 0, turns - spin))],
                        PARTS + f" rollingDamping {zeta}")
        rows = table(program, script + f"fix move all nve/sphere\ntimestep {step}\n"
                     f"compute spin all property/atom omegaz\nthermo {steps // 200}\n" +
                     thermo("c_spin[1]-c_spin[2]") + f"\nrun {steps}\n", ranks)
        t, share = omega * step * rows[:, 0], math.sqrt(1 - zeta**2)
        exact = np.exp(-zeta * t) * (np.cos(share * t) - zeta / share * np.sin(share * t))
        return np.abs(rows[:, 1] / (2 * spin) - exact).max()

    def test_rolls_as_an_oscillator(self):
        self.assertLess(self.roll(0.0, REST), 0.01)

    def test_rolling_is_damped(self):
        self.assertLess(self.roll(0.0, REST, zeta=0.05), 0.01)

    def test_rolls_alike_while_it_tumbles_through_the_boundaries(self):
        omega = math.sqrt(8 * PAIR.F_C * PAIR.R / (0.1 * MASS))
        turns = omega / 20
        duration = 20 * 2 * math.pi / omega    # one turn
        drift = (16 / duration, 16 / duration, 0.0)    # through the box twice: i and j change places
        self.assertLess(self.roll(turns, drift), 0.02)
        self.assertLess(self.roll(turns, drift, ranks=2), 0.02)


class Sliding(unittest.TestCase):
    """Springs and sliders of a doublet at rest in other ways than rolling."""

    WORDS = "tangential adhesive twisting on"

    def at_rest(self, turns, omega_of):
        """Frequency and distance of a doublet that turns at a share of its own frequency, which is omega_of
        distance, contact radius and tangential stiffness."""
        overlap = PAIR.overlap_at(0.0)
        for _ in range(3):    # what turning takes is a small part
            a = PAIR.a0 * PAIR.radius(overlap)
            omega = omega_of(1 - overlap, a, 8 * G_EFF * a)
            overlap = PAIR.overlap_at(-MASS * (turns * omega)**2 * 0.5)
        return omega, 1 - overlap

    def swing(self, omega, distance, rate, spins, speed, columns, drifts,
              periods=10):
        """Times and columns while a doublet on x turns about z at a rate, with additional spins and a speed
        along y between its ends. Drifting takes it through the box, so that i and j change places."""
        step = 0.05 / omega    # leapfrog is ahead by (omega step)^2/24: 0.007 rad in ten periods
        steps = round(periods * 2 * math.pi / omega / step)
        drift = np.array([8, 8, 0]) / (10 * 2 * math.pi / omega) if drifts else np.zeros(3)
        v = np.array([0.0, 0.5 * (rate * distance + speed), 0.0])
        turning = np.array([0.0, 0.0, rate])
        script = models([((3, 4, 4), drift - v, turning + spins[0]),
                         ((3 + distance, 4, 4), drift + v, turning + spins[1])], self.WORDS)
        rows = table(program, script + f"fix move all nve/sphere\ntimestep {step}\n"
                     "compute wx all property/atom omegax\ncompute wy all property/atom omegay\n"
                     f"compute wz all property/atom omegaz\nthermo {steps // 200}\n" +
                     thermo(*columns) + f"\nrun {steps}\n")
        return step * rows[:, 0], rows[:, 1:]

    def slide(self, turns):
        """Slides to and fro without angular momentum; error of the sum of spins by its amplitude."""
        omega, distance = self.at_rest(
            turns, lambda d, a, kt: math.sqrt(kt * (2 / MASS + 0.5 * d**2 / INERTIA)))
        kt = omega**2 / (2 / MASS + 0.5 * distance**2 / INERTIA)
        slip = 0.2 * 2 * MU * PAIR.F_C / kt * omega    # a fifth of what makes the surfaces slide
        spin = slip / (distance + 4 * INERTIA / (MASS * distance))
        w = np.array([0.0, 0.0, spin])
        t, rows = self.swing(omega, distance, turns * omega, (w, w),
                             -4 * INERTIA * spin / (MASS * distance), ["c_wz[1]+c_wz[2]"], turns)
        return np.abs((0.5 * rows[:, 0] - turns * omega) / spin - np.cos(omega * t)).max()

    def twist(self, turns):
        """Twists to and fro; error of the relative spin about the line of centres by its amplitude. In a
        doublet that turns, twisting becomes relative spin across the line, at rate turns, and back."""
        own = lambda d, a, kt: math.sqrt(kt * a**2 / INERTIA)
        omega, distance = self.at_rest(turns, own)
        a = omega * math.sqrt(INERTIA)    # sqrt(kt) a
        a = (a**2 / (8 * G_EFF)) ** (1 / 3)
        spin = 0.2 * (2 / 3 * a * 2 * MU * PAIR.F_C) / (0.5 * 8 * G_EFF * a**3) * omega / 2
        w = np.array([spin, 0.0, 0.0])
        t, rows = self.swing(omega, distance, turns * omega, (w, -w), 0.0,
                             ["c_wx[1]-c_wx[2]", "c_wy[1]-c_wy[2]"], turns)
        angle = turns * omega * t
        along = rows[:, 0] * np.cos(angle) + rows[:, 1] * np.sin(angle)
        return np.abs(along / (2 * spin) - np.cos(omega * math.hypot(1, turns) * t)).max()

    def test_slides_as_an_oscillator(self):
        self.assertLess(self.slide(0.0), 0.02)

    def test_slides_alike_while_it_tumbles_through_the_boundaries(self):
        self.assertLess(self.slide(0.02), 0.05)

    def test_twists_as_an_oscillator(self):
        self.assertLess(self.twist(0.0), 0.02)

    def test_twists_alike_while_it_tumbles_through_the_boundaries(self):
        self.assertLess(self.twist(0.05), 0.05)


class Limits(unittest.TestCase):
    """Torques and forces of surfaces that slide on each other, from the loss of spin or speed."""

    def loss(self, script, column, duration):
        """Mean rate of a column's change in the second half of a run."""
        step = step_of(PAIR, MASS / 2) / 2
        rows = table(program, script + f"fix move all nve/sphere\ntimestep {step}\n"
                     "compute wx all property/atom omegax\ncompute wy all property/atom omegay\n"
                     "compute wz all property/atom omegaz\nthermo 1\n" +
                     thermo(column) + f"\nrun {round(duration / step)}\n")
        half = len(rows) // 2
        return (rows[-1, 1] - rows[half, 1]) / ((len(rows) - 1 - half) * step)

    def doublet(self, words, spin):
        distance = 1 - PAIR.overlap_at(0.0)
        return models([((3, 4, 4), REST, tuple(spin)), ((3 + distance, 4, 4), REST,
                                                       tuple(-np.array(spin)))], words)

    def test_rolling(self):
        moment = 4 * PAIR.F_C * THETA * PAIR.R
        spin = 20 * THETA * math.sqrt(8 * PAIR.F_C * PAIR.R / INERTIA)
        rate = self.loss(self.doublet("rolling_friction dominik_tielens", (0, 0, spin)),
                         "c_wz[1]-c_wz[2]", 0.2 * spin * INERTIA / moment)
        self.assertAlmostEqual(rate / (-2 * moment / INERTIA), 1.0, delta=0.01)

    def test_twisting(self):
        torque = 2 / 3 * PAIR.a0 * 2 * MU * PAIR.F_C
        spin = 20 * torque / (4 * G_EFF * PAIR.a0**3) * math.sqrt(8 * G_EFF * PAIR.a0**3 / INERTIA)
        rate = self.loss(self.doublet(Sliding.WORDS, (spin, 0, 0)), "c_wx[1]-c_wx[2]",
                         0.2 * spin * INERTIA / torque)
        self.assertAlmostEqual(rate / (-2 * torque / INERTIA), 1.0, delta=0.01)

    def on_the_wall(self, column):
        """A sphere that slides on a flat wall along x."""
        height = 0.5 - WALL.overlap_at(0.0)
        force = 2 * MU * WALL.F_C
        speed = 10 * force / (8 * G_EFF * WALL.a0) * math.sqrt(3.5 * 8 * G_EFF * WALL.a0 / MASS)
        return self.loss(
            models([((4, 4, height), (speed, 0, 0), REST)], "tangential adhesive", boundary="p p f") +
            "fix wall all wall/gran model jkr tangential adhesive primitive type 1 zplane 0.0\n",
            column, 0.2 * speed * MASS / force), force, height

    def test_friction_of_a_wall(self):
        rate, force, _ = self.on_the_wall("vx[1]")
        self.assertAlmostEqual(rate / (-force / MASS), 1.0, delta=0.01)

    def test_torque_of_a_wall(self):
        rate, force, height = self.on_the_wall("c_wy[1]")
        self.assertAlmostEqual(rate / (force * height / INERTIA), 1.0, delta=0.01)

    def test_oblique_impact(self):
        """At a flat angle surfaces slide all the time: impulses are as mu to one."""
        V = np.array([-0.01, 0.04, 0.0])
        script = models([((3, 4, 4), -0.5 * V, REST), ((4.0001, 4, 4), 0.5 * V, REST)],
                        "tangential adhesive", adhesion=0.0)
        rows = table(program, script + f"fix move all nve/sphere\n"
                     f"timestep {step_of(PAIR, MASS / 2) / 10}\n"
                     "compute wz all property/atom omegaz\nthermo 4000\n" +
                     thermo("vx[2]-vx[1]", "vy[2]-vy[1]", "c_wz[1]", "c_wz[2]") + "\nrun 4000\n")
        normal, across = rows[-1, 1] - V[0], rows[-1, 2] - V[1]
        self.assertAlmostEqual(across / normal, -MU, delta=0.02 * MU)
        for spin in rows[-1, 3:]:    # arm 1/2
            self.assertAlmostEqual(spin / (-0.5 * 0.5 * MASS * across / INERTIA), 1.0, delta=0.02)


class Impact(unittest.TestCase):
    """A sphere meets another head-on."""

    def restitution(self, speed, finer=10, **words):
        """Relative speed long after, by that before; 0 when they stick."""
        step = step_of(PAIR, MASS / 2) / finer
        rows = table(program, pair_on_x(0.01 * PAIR.delta_C, -speed, **words) +
                     f"fix move all nve/sphere\ntimestep {step}\nthermo {400 * finer}\n" +
                     thermo("x[2]-x[1]-1", "vx[2]-vx[1]") + f"\nrun {400 * finer}\n")
        return rows[-1, 2] / speed if rows[-1, 1] > PAIR.delta_C else 0.0

    def test_sticking_velocity(self):
        V_s = math.sqrt(2 * 0.935503 * PAIR.F_C * PAIR.delta_C / (MASS / 2))
        self.assertEqual(self.restitution(0.97 * V_s), 0.0)
        for share in (1.03, 1.5, 3.0):
            self.assertAlmostEqual(self.restitution(share * V_s), math.sqrt(1 - share**-2),
                                   delta=0.03 if share < 1.1 else 0.005)

    def test_restitution_with_adhesion_and_damping(self):
        """Beside the equation of motion of the damped neck, integrated here."""
        speed, e = 2 * math.sqrt(2 * 0.935503 * PAIR.F_C * PAIR.delta_C / (MASS / 2)), 0.8
        beta = -math.log(e) / math.hypot(math.pi, math.log(e))
        h = np.linspace(6 ** (-2 / 3), 2.5, 100001)    # contact radius / a0
        overlaps = 6 ** (1 / 3) * (2 * h**2 - 4 / 3 * np.sqrt(h)) * PAIR.delta_C

        def acceleration(overlap, v):
            h_now = float(np.interp(overlap, overlaps, h))
            eta = math.sqrt(5) * beta * math.sqrt(MASS / 2 * 4 / 3 * E_EFF * PAIR.a0 * h_now)
            return -(4 * PAIR.F_C * (h_now**3 - h_now**1.5) + eta * v) / (MASS / 2)

        overlap, v, step = 0.0, speed, step_of(PAIR, MASS / 2) / 100
        while overlap > -PAIR.delta_C:
            middle = v + 0.5 * step * acceleration(overlap, v)
            v += step * acceleration(overlap + 0.5 * step * v, middle)
            overlap += step * middle
        self.assertAlmostEqual(self.restitution(speed, restitution=e), -v / speed, delta=0.005)

    def test_restitution_without_adhesion(self):
        for e in (0.9, 0.5, 0.2):
            self.assertAlmostEqual(self.restitution(1.0, restitution=e, adhesion=0.0) / e, 1.0,
                                   delta=0.005)

    def test_restitution_in_long_steps(self):
        """A contact of 34 steps: velocities are half a step behind positions, and the dashpot knows."""
        for e in (0.5, 0.3):
            self.assertAlmostEqual(self.restitution(1.0, finer=2, restitution=e, adhesion=0.0) / e,
                                   1.0, delta=0.002)


class Errors(unittest.TestCase):
    """What a script must not say."""

    def error_of(self, words):
        text, _ = run(program, pair_on_x(0.1, 0.0, words=words) +
                      "fix move all nve/sphere\nrun 0\n")
        return text

    def test_parts_need_the_normal_model(self):
        self.assertIn("twisting on needs tangential adhesive", self.error_of("twisting on"))
        self.assertIn("rollingDamping needs rolling_friction dominik_tielens",
                      self.error_of("rollingDamping 0.1"))
        self.assertNotIn("ERROR", self.error_of(PARTS + " rollingDamping 0.1"))


if __name__ == "__main__":
    program = shutil.which(sys.argv.pop(1) if len(sys.argv) > 1 else "lmp_liggghts")
    if not program:
        print("skipped: no LIGGGHTS with our contact models; contrib/liggghts/build makes it")
        sys.exit(77)
    unittest.main(verbosity=2)
