// C15 of the list of hard cases, rolling springs without damping in aggregates of 100, under
// velocity Verlet, stock r-RESPA and fix nve/sphere/mts.

#include "integrators.h"
#include "necks.h"

#include <algorithm>

namespace {

const Material material;
const double mass = pi / 6.0, inertia = 0.1 * mass;    // of a sphere of diameter and density 1

// A sheet of 100 without end, each sphere turning against its four neighbours: all contacts
// roll and none slides. I dOmega/dt = -4 (k xi + eta dxi/dt), dxi/dt = 2 R Omega, k = 4 F_C.
TEST(Cases, rolling_resonance_of_a_sheet)
{
  const auto curve = material.pair();
  const double d = 1.0 - curve.delta_eq(), k = 4.0 * curve.F_C();
  const double rate = std::sqrt(8.0 * k * curve.R / inertia);
  for (const double zeta : {0.0, 0.1})
    for (const auto &integrator : integrators) {
      Scene scene;
      scene.box = "0 " + digits(10.0 * d) + " 0 " + digits(10.0 * d) + " 0 8";
      scene.style = pair_of(jkr + "sliding 0.3 rolling 0.1 " + digits(zeta));
      Simulation sim;
      build(sim, {}, scene);
      std::vector<double> x, v(300, 0.0);
      for (int n = 0; n < 100; n++)
        x.insert(x.end(), {d * (n % 10 + 0.5), d * (n / 10 + 0.5), 4.0});
      add_spheres(sim, x, v);
      // a third of the rolling limit
      const double spin = 0.03 * 0.5 * rate;
      const double share = zeta > 0.0 ? 2.0 * zeta : 0.0;    // four dashpots, four springs
      const double period = 2.0 * pi / (rate * std::sqrt(1.0 - share * share));
      const int steps = static_cast<int>(std::lround(period / dt));
      const double step = period / (steps / 10 * 10);
      sim.run("variable w atom " + digits(spin) +
              "*(1-2*(((id-1)%10+floor((id-1)/10))%2))\nset group all omega 0 0 v_w\n"
              "compute spin all erotate/sphere\ncompute parts all pair granular/adhesive\n"
              "thermo_style custom step c_spin c_parts[3] pe ke\nthermo_modify norm no\n"
              "neighbor 0.1 bin\n" +
              integrator.commands(step) + "run 0");
      const double start = sim.value("c_spin");
      EXPECT_NEAR(start, 50.0 * inertia * spin * spin, 1e-9 * start);
      if (zeta == 0.0) {
        double most = 0.0;
        for (int n = 0; n < 200; n++) {
          sim.run(integrator.run(count(steps / 3, 10 * steps / 3)));
          most = std::max(most, sim.value("c_parts[3]") / start);
        }
        expect_criterion(
            integrator.of("C15 *: sheet that is not in shear, largest energy of rolling in " +
                          std::to_string(count(66, 660)) + " swings, of that at the start"),
            most, 0.9, 1.01);
      } else {
        sim.run(integrator.run(2 * (steps / 10 * 10)));
        const double logs = std::log(gather(sim, "omega")[2] / spin);
        expect_criterion(
            integrator.of(
                "C15 *: sheet that is not in shear, decay with zeta = 0.1 over the predicted"),
            logs / (-share * rate * 2.0 * period), 0.95, 1.05);
      }
    }
}

// ... and a block of 5 x 5 x 4 in shear, which turns with the fluid from the beginning on: no
// spring comes to its limit, though some have little left of it, and energy of rolling stays
// bounded: swings of the beginning go to the fluid, and at last each turn is like the one before
TEST(Cases, block_in_shear)
{
  const auto curve = material.pair();
  const double d = 1.0 - curve.delta_eq(), G = 12.0, theta = 0.0015, mu = 0.3;
  const int turns = 5, turn = static_cast<int>(4.0 * pi / G / dt);
  for (const auto &integrator : integrators) {
    Scene scene;
    scene.box = "0 16 0 16 0 16";
    scene.style = pair_of(jkr + "sliding " + digits(mu) + " rolling " + digits(theta) + " ");
    Simulation sim;
    build(sim, {}, scene);
    std::vector<double> x, v;
    for (int n = 0; n < 100; n++) {
      const double at[3] = {d * (n % 5 - 2), d * (n / 5 % 5 - 2), d * (n / 25 - 1.5)};
      x.insert(x.end(), {8.0 + at[0], 8.0 + at[1], 8.0 + at[2]});
      v.insert(v.end(), {0.5 * G * at[1], -0.5 * G * at[0], 0.0});
    }
    add_spheres(sim, x, v);
    sim.run("set group all omega 0 0 " + digits(-0.5 * G) +
            "\ncompute parts all pair granular/adhesive\ncompute agg all aggregate/contact\n"
            "thermo_style custom step c_parts[3] c_agg[2] pe ke\nthermo_modify norm no\n"
            "fix air all flow/field shear x y " +
            digits(G) + " 8 density 1e-3 viscosity 0.16\n" +
            "fix drag all flow/force air drag stokes torque yes\nneighbor 0.3 bin\n" +
            local_contacts + integrator.commands(dt) + "run 0\n");
    // largest share of the limit, of rolling and of sliding
    double rolls = 0.0, slides = 0.0;
    const auto look = [&] {
      for (const auto &contact : contacts_of(sim)) {
        const double *p = contact.p, h = p[2] / curve.a0();
        const double rolling = 4.0 * curve.F_C() * std::pow(h, 1.5) * theta * curve.R,
                     elastic = 4.0 * curve.F_C() * (h * h * h - std::pow(h, 1.5));
        rolls = std::max(rolls, std::hypot(p[8], p[9], p[10]) / rolling);
        slides = std::max(
            slides, std::hypot(p[5], p[6], p[7]) / (mu * std::fabs(elastic + 2.0 * curve.F_C())));
      }
    };
    std::vector<double> energy(turns, 0.0);    // of rolling, the largest in each turn
    for (double &most : energy)
      for (int n = 0; n < turn / 100; n++) {
        sim.run(integrator.run(100));
        most = std::max(most, sim.value("c_parts[3]"));
        look();
      }
    EXPECT_EQ(sim.value("c_agg[2]"), 1.0) << "one aggregate";
    const std::string in = " in " + std::to_string(turns) + " turns of shear";
    expect_criterion(integrator.of("C15 *: block, energy of rolling" + in +
                                   ", largest after the first turn over that in it"),
                     *std::max_element(energy.begin() + 1, energy.end()) / energy[0], 0.01, 1.0);
    expect_criterion(
        integrator.of("C15 *: block, energy of rolling" + in + ", last turn over the one before"),
        energy[turns - 1] / energy[turns - 2], 0.8, 1.05);
    expect_criterion(integrator.of("C15 *: block, largest xi" + in + ", of xi_crit"), rolls, 0.1,
                     0.9);
    expect_criterion(integrator.of("C15 *: block, largest sliding force" + in + ", of its limit"),
                     slides, 0.1, 0.9);
  }
}

}    // namespace
