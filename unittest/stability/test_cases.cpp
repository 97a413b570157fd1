// Cases C9, C11, C20, C21, C23, C25 and C28 of the list of hard cases under velocity
// Verlet, stock r-RESPA and fix nve/sphere/mts.

#include "inlet_scene.h"
#include "integrators.h"
#include "necks.h"

#include "neighbor.h"

#include <algorithm>
#include <array>

namespace {

const Material material;
const double mass = pi / 6.0, inertia = 0.1 * mass;    // of a sphere of diameter and density 1

// C9: a held neck at -0.9 delta_C with loaded springs, lists built anew 1e4 times; a third sphere
// flies
TEST(Cases, neck_beyond_contact)
{
  const auto curve = material.pair();
  const double stretch = 0.9 * curve.delta_C();
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.99, 4.0, 4.0}, {1.0, 1.0, 1.0}});
    load_springs(sim, 16, {0.0, 0.02, -0.01}, {0.3, 0.2, -0.1}, {-0.3, 0.1, 0.0});
    set_motion(sim, 3, {30.0, 10.0, 5.0}, {0.0, 0.0, 0.0});
    std::string commands = integrator.commands(dt);
    commands.replace(commands.find(" all "), 5, " flies ");
    sim.run("group flies id 3\nrun 0\nset atom 2 x " + digits(5.0 + stretch) +
            "\nneighbor 0.05 bin\nneigh_modify delay 0 every 1 check no\natom_modify sort 5 1.0\n" +
            commands + "run 0");
    const auto f = gather(sim, "f"), torque = gather(sim, "torque");
    EXPECT_NEAR(f[0], -curve.force(-stretch), 1e-6 * curve.F_C());
    EXPECT_GT(std::hypot(f[1], f[2]), 1e-4 * curve.F_C()) << "sliding";
    // sliding takes as much of it on both
    EXPECT_GT(std::fabs(torque[0]), 1e-5 * curve.F_C()) << "twisting";
    EXPECT_GT(std::hypot(torque[1] - torque[4], torque[2] - torque[5]), 1e-5 * curve.F_C())
        << "rolling";
    sim.run("run 10000");
    EXPECT_EQ(sim.lammps()->neighbor->ncalls, 10000);
    expect_criterion(
        integrator.of("C9 *: change of force and torque of a neck in 1e4 rebuilds, of them"),
        std::max(difference(gather(sim, "f"), f), difference(gather(sim, "torque"), torque)), 0.0,
        1e-12);
  }
}

// C11: a doublet spins for ten turns at its own distance; boosted, it flies at 1024 times the speed
// of its spheres about its middle
TEST(Cases, doublet_spins)
{
  const auto curve = material.pair();
  const double W = 16.0, ramp = 2.0 * pi / W;    // of a turn
  double tension = 0.0, distance = 1.0 - curve.delta_eq();
  for (int n = 0; n < 50; n++) {    // m W^2 d/2 stretches it
    tension = mass * W * W * 0.5 * distance;
    double low = 0.0, high = curve.delta_eq();
    for (int k = 0; k < 100; k++) {
      const double half = 0.5 * (low + high);
      (curve.force(half) < -tension ? low : high) = half;
    }
    distance = 1.0 - low;
  }
  const int steps = static_cast<int>(ramp / dt);
  for (const auto &integrator : integrators)
    for (const double boost : {0.0, 8192.0}) {
      Simulation sim;
      build(sim, {{3.5, 4.0, 4.0}, {3.5 + distance, 4.0, 4.0}});
      set_motion(sim, 1, {boost, -0.5 * W * distance, 0.0}, {0.0, 0.0, W});
      set_motion(sim, 2, {boost, 0.5 * W * distance, 0.0}, {0.0, 0.0, W});
      sim.run("compute spin all erotate/sphere\ncompute parts all pair granular/adhesive\n"
              "thermo_style custom step pe ke c_spin c_parts[2] c_parts[3]\n"
              "thermo_modify norm no\nneighbor 2.0 bin\nneigh_modify delay 0 every 1\n" +
              integrator.commands(dt) + "run 0");
      auto measured = [&] {
        const auto v = gather(sim, "v"), w = gather(sim, "omega"), x = gather(sim, "x");
        double d[3];
        for (int c = 0; c < 3; c++) {
          d[c] = x[3 + c] - x[c];
          d[c] -= 8.0 * std::round(d[c] / 8.0);
        }
        const double L =
            0.5 * mass * (d[0] * (v[4] - v[1]) - d[1] * (v[3] - v[0])) + inertia * (w[2] + w[5]);
        double E = sim.value("pe+c_spin");
        for (int c = 0; c < 6; c++) {
          const double u = v[c] - (c % 3 == 0 ? boost : 0.0);
          E += 0.5 * mass * u * u;
        }
        return std::array<double, 2>{L, E};
      };
      const auto before = measured();
      sim.run(integrator.run(10 * steps));
      const auto after = measured();
      const double kinetic = 0.5 * before[0] * W;
      const std::string at = boost > 0.0 ? ", boosted" : "";
      expect_criterion(integrator.of("C11 *: change of L in 10 turns" + at),
                       std::fabs(after[0] / before[0] - 1.0), 0.0, 1e-10);
      expect_criterion(integrator.of("C11 *: drift of energy in 10 turns, of the kinetic" + at),
                       (after[1] - before[1]) / kinetic, -1e-5, 1e-5);
      expect_criterion(integrator.of("C11 *: energy of springs, of the kinetic" + at),
                       sim.value("c_parts[2]+c_parts[3]") / kinetic, 0.0, 1e-6);
    }
}

// C20: twelve contacts on a particle at the report's step, f3 = 0.1, and damping
void dense(const Integrator &integrator, double phi, const std::string &modes)
{
  const JkrCurve curve{0.25, 1e4, 0.5 * phi};
  const double h = (1.0 - curve.delta_eq()) / std::sqrt(2.0);
  Scene scene;
  scene.box = "0 10 0 10 0 10";
  scene.style = pair_of(" jkr " + digits(2e4 * (1.0 - 0.09)) + " 0.3 " + digits(curve.gamma) +
                        " damping alpha 1.018 " + modes);
  std::vector<Sphere> cluster = {{5.0, 5.0, 5.0}};
  for (const double a : {-h, h})
    for (const double b : {-h, h})
      cluster.insert(cluster.end(),
                     {{5.0 + a, 5.0 + b, 5.0}, {5.0 + a, 5.0, 5.0 + b}, {5.0, 5.0 + a, 5.0 + b}});
  Simulation sim;
  build(sim, cluster, scene);
  sim.run("compute spin all erotate/sphere\nvariable E equal pe+ke+c_spin\n"
          "thermo_style custom step pe ke c_spin\nthermo_modify norm no\n"
          "variable a atom 0.4*(id%3-1)\nvariable b atom 0.4*(id%5-2)\n"
          "variable c atom 0.4*(id%2-0.5)\nset group all omega v_a v_b v_c\nneighbor 1.0 bin\n" +
          integrator.commands(2.5e-3) + "run 0");
  const double start = sim.value("ke+c_spin");
  double last = sim.value("v_E"), most = -1.0;
  for (int n = 0; n < 50; n++) {
    sim.run(integrator.run(100));
    most = std::max(most, (sim.value("v_E") - last) / start);
    last = sim.value("v_E");
  }
  expect_criterion(integrator.of("C20 *: largest gain of energy in 100 steps, " + modes), most,
                   -1.0, 1e-6);
}

TEST(Cases, dense_aggregate)
{
  for (const std::string modes : {"sliding 0.3", "sliding 0.3 twisting yes rolling 0.01 0.1",
                                  "sliding 0.3 twisting yes rolling 0.01"})
    for (const double phi : {1.5, 15.0, 50.0, 150.0})
      for (const auto &integrator : integrators) dense(integrator, phi, modes);
}

// ... what is told before a run of a step above 0.3: of the step in which contacts are taken
TEST(Cases, dense_aggregate_is_told_its_steps)
{
  const double omega =
      std::sqrt(3.5 * 8.0 * material.G_eff() * material.pair().a0() / (0.5 * mass));
  const std::string words = "omega dt = ", cure = " gives 0.3";
  for (const auto &integrator : integrators) {
    if (integrator.name == "mts") continue;    // MtsEnergy.twelve_contacts has its summary
    for (const double kappa : {0.29, 0.35, 0.7}) {
      Scene scene;
      scene.style = pair_of(jkr + "sliding 0.3");
      Simulation sim;
      build(sim, {{4.0, 4.0, 4.0}, {4.99, 4.0, 4.0}}, scene);
      const std::string text =
          log_of(sim, "neighbor 1.0 bin\n" + integrator.commands(kappa / omega) + "run 0\n");
      const auto at = text.find(words);
      ASSERT_EQ(at != std::string::npos, kappa > 0.3) << text;
      if (kappa < 0.3) continue;
      expect_criterion(
          integrator.of("C20 *: omega dt of the line before a run over that of the law"),
          std::stod(text.substr(at + words.size())) / kappa, 0.995, 1.005);
      EXPECT_NE(text.find(cure, at), std::string::npos) << text;
    }
  }
}

// C21: viscosity stops spheres at a gap, from the law of logarithms with the bridge's finite volume
TEST(Cases, viscous_bridge)
{
  const double l = 0.06, mu = 2.0, R = 0.25, m_eff = mass / 2.0, V = l * mass,
               k = 6.0 * pi * mu * R * R;
  // the films touch at the start
  const double begin = 0.9 * (std::cbrt(1.0 + l) - 1.0), least = 1e-3 * R, stop = 5.0 * least;
  double momentum = 0.0;
  const int n = 20000;
  for (int q = 0; q < n; q++) {
    const double h = stop * std::pow(begin / stop, (q + 0.5) / n);
    const double H = 1.0 - 1.0 / std::sqrt(1.0 + V / (pi * R * h * h));
    momentum += k * H * H * std::log(begin / stop) / n;
  }
  const double v0 = momentum / m_eff, explicit_limit = 2.0 * least * m_eff / k;
  for (const double times : {1.0, 10.0, 100.0})
    for (const auto &integrator : integrators) {
      const double step = times * explicit_limit, gap = begin;
      Scene scene;
      scene.style = pair_of(" jkr 1.0e7 0.25 0.0 form film bridge " + digits(l) + " 1e-9 0 " +
                            digits(mu) + " 1e-3");
      Simulation sim;
      build(sim, {{4.0 - 0.5 * (1.0 + gap), 4.0, 4.0}, {4.0 + 0.5 * (1.0 + gap), 4.0, 4.0}}, scene);
      set_motion(sim, 1, {0.5 * v0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      set_motion(sim, 2, {-0.5 * v0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("neighbor 4.0 bin\n" + integrator.commands(step) + integrator.run(4000));
      expect_criterion(
          integrator.of("C21 *: gap at rest, steps up to 100 x explicit, over the law"),
          (sim.value("x[2]-x[1]") - 1.0) / stop, 0.999, 1.001);
    }
}

// C23: a force and stiff drag, step over tau = 10
std::vector<double> speed_in_syrup(const Integrator &integrator, const std::string &law,
                                   double viscosity, double density, double pull)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  const double tau = 1.0 / (18.0 * viscosity);
  sim.run("fix pull all addforce 0 0 " + digits(pull) +
          "\nfix air all flow/field uniform 1 0 0 density " + digits(density) + " viscosity " +
          digits(viscosity) + "\nfix drag all flow/force air drag " + law + "\n" +
          integrator.commands(10.0 * tau / integrator.inner) + "run 100");
  return gather(sim, "v");
}

TEST(Cases, stiff_drag)
{
  const double mu = 1e4, alone = 3.0 * pi * mu;
  for (const auto &integrator : integrators) {
    const auto v = speed_in_syrup(integrator, "stokes", mu, 1e-3, 1e3);
    expect_criterion(integrator.of("C23 *: terminal velocity at a step of 10 tau, less 1"),
                     v[2] / (1e3 / alone) - 1.0, -1e-6, 1e-6);
    expect_criterion(integrator.of("C23 *: velocity along the fluid, less 1"), v[0] - 1.0, -1e-6,
                     1e-6);
    // among others, Di Felice: f = (1 - c)^-beta of the drag alone, and as much shorter a time
    for (const double Re : {0.02, 1.0}) {
      const double density = 100.0, c = 0.5, slip = Re * mu / density,
                   beta = 3.7 - 0.65 * std::exp(-0.5 * std::pow(1.5 - std::log10(Re), 2)),
                   f = std::pow(1.0 - c, -beta);
      EXPECT_NEAR(f, Re == 1.0 ? 11.2 : 13.0, 0.1);
      const auto hindered = speed_in_syrup(integrator, "difelice concentration " + digits(c), mu,
                                           density, alone * f * slip);
      const std::string crowd = " at c = 0.5, f = " + std::string(Re == 1.0 ? "11.2" : "13.0");
      expect_criterion(
          integrator.of("C23 *: terminal velocity at a step of 10 tau, less 1," + crowd),
          hindered[2] / slip - 1.0, -1e-6, 1e-6);
      expect_criterion(integrator.of("C23 *: velocity along the fluid, less 1," + crowd),
                       hindered[0] - 1.0, -1e-6, 1e-6);
    }
  }
}

// C25: spheres that enter a box at a speed of 1; v_more: their kinetic energy over that of the
// fluid's speed, less 1
const double entering = pi / 6.0 * 0.125;    // volume of one

void inlet(Simulation &sim, const Integrator &integrator, const std::string &concentration,
           const std::string &more, double width = 10.0)
{
  Scene scene;
  scene.box = "0 20 0 " + digits(width) + " 0 " + digits(width);
  scene.boundary = "f p p";
  scene.style = pair_of(" jkr 1e4 0.3 0.1 damping tsuji 0.5 sliding 0.3");
  build(sim, {}, scene);
  sim.run("neighbor 0.3 bin\nfix air all flow/field uniform 1 0 0 density 1 viscosity 1\n"
          "fix in all inlet/flow x 0 air concentration " +
          concentration + " diameter 0.5 density 2 type 1 seed 4711 outlet x 15\n" +
          "compute ke all ke\nvariable more equal c_ke/(" + digits(entering) +
          "*atoms+1e-300)-1\nvariable off equal abs(v_more)*(atoms>0)\n"
          "thermo_style custom step c_ke\nthermo_modify norm no\n" +
          integrator.commands(0.05 / integrator.inner) + more);
}

// C25: what enters is the flux, at the speed of the fluid
TEST(Cases, inlet)
{
  const int steps = 10000;    // one sphere is a part of 3e-4 and less of what enters
  for (const std::string c : {"0.004", "0.01", "0.1"})
    for (const auto &integrator : integrators) {
      Simulation sim;
      const std::string drag = "fix drag all flow/force air drag stokes torque yes\n",
                        at = " at c = " + c + ", in 1e4 steps";
      const double width = c == "0.1" ? 3.0 : 10.0;    // enough enter
      inlet(sim, integrator, c, drag + "thermo 100000\n", width);
      sim.run("run " + std::to_string(steps));
      const double due = std::stod(c) * width * width * 0.05 * steps;
      expect_criterion(integrator.of("C25 *: volume that entered over the flux" + at),
                       sim.value("f_in[1]") * entering / due, 0.999, 1.001);
      expect_criterion(integrator.of("C25 *: kinetic energy over that of the fluid, less 1" + at),
                       sim.value("v_more"), -1e-6, 1e-6);
    }
}

// ... and nothing is put where it overlaps another and sets energy free: no drag takes that away.
// The energy is looked at in every step, and gaps before those that entered last have left.
void gaps_at_inlet(const std::string &c, int steps, double refused)
{
  const int look = 200;    // they leave after 300
  const std::string at = " at c = " + c + ", in " + std::to_string(steps) + " steps";
  for (const auto &integrator : integrators) {
    Simulation sim;
    inlet(sim, integrator, c, "fix log all vector 1 v_off\nthermo 1\n");
    double least = 1e30;
    for (int n = 0; n < steps; n += look) {
      sim.run("run " + std::to_string(look));
      least = std::min(least, smallest_gap(sim, periodic_yz));
    }
    EXPECT_GT(sim.value("f_in[2]"), refused * sim.value("f_in[1]")) << "places are taken" << at;
    expect_criterion(integrator.of("C25 *: smallest gap" + at + ", of d"), least / 0.5, -1e-12,
                     0.1);
    expect_criterion(integrator.of("C25 *: change of kinetic energy in any step" + at),
                     sim.value("max(f_log)"), 0.0, 1e-6);
  }
}

TEST(Cases, thin_inlet)
{
  for (const std::string c : {"0.004", "0.01"}) gaps_at_inlet(c, 10000, 0.01);
}

// at concentrations at which there is hardly any room
TEST(Cases, dense_inlet)
{
  for (const std::string c : {"0.1", "0.2"}) gaps_at_inlet(c, count(400, 10000), 0.5);
}

// C28: pairs that meet within a long flight; at the same collision step sub-steps give the same
// impacts as the single rate in less time
TEST(Cases, speed_against_error)
{
  const JkrCurve curve = material.pair();
  const Scale scale(curve, mass / 2.0);
  struct Outcome {
    std::vector<double> e;
    double time;
  };
  auto outcome = [&](const Integrator &integrator, double step) {
    std::vector<double> x, v;
    const int pairs = 1000;
    for (int n = 0; n < pairs; n++)
      for (const double sign : {-1.0, 1.0}) {
        const double V = scale.V_s * (1.2 + 2.8 * (n % 50) / 50.0);
        const double gap = V * scale.T * (5.0 + 0.3 * n);    // one after another
        x.insert(x.end(),
                 {8.0 + sign * 0.5 * (1.0 + gap), 1.5 + 3.0 * (n % 32), 1.5 + 3.0 * (n / 32)});
        v.insert(v.end(), {-sign * 0.5 * V, 0.0, 0.0});
      }
    Scene scene;
    scene.box = "-30 46 0 96 0 96";
    scene.style = pair_of(jkr);
    Simulation sim;
    build(sim, {}, scene);
    add_spheres(sim, x, v);
    sim.run("neighbor 0.5 bin\n" + integrator.commands(step) + "run 0");
    const std::clock_t start = std::clock();
    sim.run(integrator.run(static_cast<int>(350.0 * scale.T / step)));
    Outcome result{{}, static_cast<double>(std::clock() - start)};
    const auto after = gather(sim, "v");
    for (int n = 0; n < pairs; n++)
      result.e.push_back((after[6 * n + 3] - after[6 * n]) / (v[6 * n] - v[6 * n + 3]));
    return result;
  };
  const double step = 0.1 * scale.T;
  const Integrator long_steps{"mts", 40}, respa{"respa", 40};
  const auto single = outcome(integrators[0], step), sub = outcome(long_steps, step),
             levels = outcome(respa, step);
  auto error = [&](const Outcome &o) {
    double sum = 0.0;
    for (size_t n = 0; n < o.e.size(); n++) {
      const double V = 1.2 + 2.8 * (n % 50) / 50.0;
      sum += std::fabs(o.e[n] - std::sqrt(1.0 - 1.0 / (V * V))) / o.e.size();
    }
    return sum;
  };
  auto mean = [](const Outcome &o) {
    double sum = 0.0;
    for (const double e : o.e) sum += e / o.e.size();
    return sum;
  };
  expect_criterion("C28 verlet: mean error of e", error(single), 0.0, 0.01);
  expect_criterion("C28 respa: mean e over that of the single rate", mean(levels) / mean(single),
                   0.99, 1.01);
  expect_criterion("C28 mts: mean e over that of the single rate", mean(sub) / mean(single), 0.99,
                   1.01);
  expect_criterion("C28 mts: mean error of e", error(sub), 0.0, 0.01);
  // Time of the processor: 3.5 on a quiet machine, 2.8 on one where much else runs
  expect_criterion("C28 mts: time of the single rate over that of sub-steps",
                   single.time / sub.time, 1.5, 7.0);
}

}    // namespace
