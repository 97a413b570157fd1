// Impacts and the bound doublet of the list of hard cases, C1, C2, C6, C12 and C19, under velocity
// Verlet, stock r-RESPA and fix nve/sphere/mts; more of the latter in test_mts_impact.cpp. Where
// nothing but contacts acts r-RESPA is velocity Verlet; C2 and C19 have scenes with another force,
// which it has on its outer level.

#include "damped_impact.h"
#include "integrators.h"

#include <algorithm>
#include <random>

namespace {

const Material material;
const JkrCurve curve = material.pair();
const double m_eff = pi / 12.0;
const Scale scale(curve, m_eff);

std::string plain(const std::string &law)
{
  return "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
}

// e of head-on impacts at some speeds, each at `phases` phases of the time grid; 0 of bodies that
// stay together, whose necks reach less far than 2 T V
struct Impacts {
  std::vector<double> speeds;
  int phases = 4;
  double first_phase = 0.0;    // in units of their distance
  double step = 0.1 * scale.T, T = scale.T;
  std::string law = jkr;
  double origin = 0.0;
  double tau = INFINITY;    // of the drag of a fluid at rest

  double speed(int n) const { return speeds[n / phases]; }
  double gap(int n) const
  {
    return speed(n) * (4.0 * T + step * (n % phases + first_phase) / phases);
  }
  // Drag takes from a speed as much as the way is long, over tau.
  double speed_at_touch(int n) const { return speed(n) - gap(n) / tau; }

  std::vector<double> restitutions(const Integrator &integrator) const
  {
    std::vector<double> x, v, e;
    const int all = phases * static_cast<int>(speeds.size());
    for (int n = 0; n < all; n++)
      for (const double sign : {-1.0, 1.0}) {
        x.insert(x.end(),
                 {origin + 8.0 + snap(sign * 0.5 * (1.0 + gap(n))), origin + 2.0 + 4.0 * (n % 16),
                  origin + 2.0 + 4.0 * (n / 16)});
        v.insert(v.end(), {-sign * 0.5 * speed(n), 0.0, 0.0});
      }
    Scene scene;
    auto range = [&](double width) {
      return digits(origin) + " " + digits(origin + width) + " ";
    };
    scene.box = range(16.0) + range(64.0) + range(4.0 * (1 + all / 16));
    scene.style = plain(law);
    Simulation sim;
    build(sim, {}, scene);
    add_spheres(sim, x, v);
    if (tau < INFINITY)
      sim.run("fix air all flow/field uniform 0 0 0 density 1e-9 viscosity " +
              digits(1.0 / 18.0 / tau) + "\nfix drag all flow/force air drag stokes");
    sim.run(integrator.commands(step) + "neighbor 2.0 bin\n" +
            integrator.run(static_cast<int>(60.0 * T / step)));
    const auto after = gather(sim, "v"), end = gather(sim, "x");
    for (int n = 0; n < all; n++) {
      const double distance = end[6 * n + 3] - end[6 * n],
                   parting = after[6 * n + 3] - after[6 * n] +
          (distance - 1.0 - curve.delta_C()) / tau;    // where the neck ended
      e.push_back(distance > 1.0 + 2.0 * T * speed(n) ? parting / speed_at_touch(n) : 0.0);
    }
    return e;
  }
};

void impacts(const Integrator &integrator)
{
  for (const double V : {1.2, 1.5, 2.0, 3.0, 5.0}) {
    Impacts fifty{{V * scale.V_s}, 50};
    fifty.step = 4.0 * dt;    // omega dt = 0.1 at rest
    const auto e = fifty.restitutions(integrator);
    double mean = 0.0;
    for (const double one : e) mean += (1.0 - one * one) * V * V / e.size();
    expect_criterion(integrator.of("C1 *: mean work of a neck over 0.9355 F_C delta_C"), mean, 0.99,
                     1.01);
    expect_criterion(integrator.of("C1 *: scatter of e over 50 phases"),
                     *std::max_element(e.begin(), e.end()) - *std::min_element(e.begin(), e.end()),
                     0.0, 0.01);
  }
  auto mean_error = [&](double step) {
    Impacts at{
        {1.2 * scale.V_s, 1.5 * scale.V_s, 2.0 * scale.V_s, 3.0 * scale.V_s, 5.0 * scale.V_s}, 50};
    at.step = step;
    const auto e = at.restitutions(integrator);
    double sum = 0.0;
    for (size_t n = 0; n < e.size(); n++) {
      const double V = at.speed(static_cast<int>(n)) / scale.V_s;
      sum += std::fabs(e[n] - std::sqrt(1.0 - 1.0 / (V * V))) / e.size();
    }
    return sum;
  };
  const double coarse = mean_error(4.0 * dt);
  expect_criterion(integrator.of("C1 *: mean error of e at omega dt = 0.1"), coarse, 1e-6, 1e-4);
  expect_criterion(integrator.of("C1 *: order of the error in the step"),
                   0.5 * std::log2(coarse / mean_error(dt)), 1.8, 3.2);
}

TEST(Integrators, impacts_by_verlet)
{
  impacts(integrators[0]);
}
TEST(Integrators, impacts_by_respa)
{
  impacts(integrators[1]);
}

// the sticking speed to 2 %
TEST(Integrators, impacts_at_the_sticking_speed)
{
  Impacts fifty{{0.5 * scale.V_s, 0.98 * scale.V_s, 1.02 * scale.V_s}, 50};
  fifty.step = 4.0 * dt;
  const auto stay = [](auto begin, auto end) {
    return static_cast<double>(std::count(begin, end, 0.0));
  };
  for (const auto &integrator : integrators) {
    const auto e = fifty.restitutions(integrator);
    EXPECT_EQ(stay(e.begin(), e.begin() + 50), 50.0);
    expect_criterion(integrator.of("C1 *: pairs of 50 that stay together at 0.98 V_s"),
                     stay(e.begin() + 50, e.begin() + 100), 50.0, 50.0);
    expect_criterion(integrator.of("C1 *: pairs of 50 that stay together at 1.02 V_s"),
                     stay(e.begin() + 100, e.end()), 0.0, 0.0);
  }
}

// 1e6 steps of contact about the bottom of the well, amplitude 0.2 delta_C
void doublet(const Integrator &integrator)
{
  Simulation sim;
  Scene scene;
  scene.style = plain(jkr);
  build(sim, {{3.0, 4.0, 4.0}, {4.0 - curve.delta_eq() + 0.2 * curve.delta_C(), 4.0, 4.0}}, scene);
  const std::string some = std::to_string(5000 / integrator.inner);
  sim.run(integrator.commands(dt) +
          "variable E equal pe+ke\nthermo_style custom step pe ke\nthermo_modify norm no\n"
          "fix mean all ave/time 1 " +
          some + " " + some + " v_E\nthermo 1000000\n" + integrator.run(5000));
  const double early = sim.value("f_mean");
  sim.run(integrator.run(995000));
  const double swing =
      0.5 * 0.990578 * curve.F_C() / curve.delta_C() * std::pow(0.2 * curve.delta_C(), 2);
  expect_criterion(integrator.of("C2 *: drift of energy in 1e6 steps, of that of the swing"),
                   std::fabs(sim.value("f_mean") - early) / swing, 0.0, 1e-4);
}

TEST(Integrators, doublet_by_verlet)
{
  doublet(integrators[0]);
}
TEST(Integrators, doublet_by_respa)
{
  doublet(integrators[1]);
}

// ... and one whose first sphere hangs on a spring, which r-RESPA has on its outer level, with as
// much energy in that as in the swing. Under mts the spring gives the force F of the step's begin,
// and half a step of its change as a kick at the end: with q = A cos(omega t) along the swing it
// does the work -k/2 [q_0 (q_1 - q_0) + (q_1 - q_0) dt/2 q'_1], which has a mean over the phase.
TEST(Integrators, doublet_on_a_spring)
{
  const double k = curve.F_C() / curve.delta_C(),
               swing = 0.5 * 0.990578 * k * std::pow(0.2 * curve.delta_C(), 2);
  for (const auto &integrator : integrators) {
    Simulation sim;
    Scene scene;
    scene.style = plain(jkr);
    build(sim, {{3.0, 4.0, 4.0}, {4.0 - curve.delta_eq() + 0.2 * curve.delta_C(), 4.0, 4.0}},
          scene);
    const double v = std::sqrt(2.0 * swing / (4.0 * m_eff));
    for (const int id : {1, 2}) set_motion(sim, id, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
    const std::string some = std::to_string(50000 / integrator.inner);
    sim.run("group first id 1\nfix hang first spring/self " + digits(0.1 * k) +
            "\nfix_modify hang energy yes\n" + integrator.commands(dt) +
            "variable E equal pe+ke\nthermo_style custom step pe ke\nthermo_modify norm no\n"
            "fix mean all ave/time 1 " +
            some + " " + some + " v_E\nthermo 1000000\n" + integrator.run(50000));
    const double early = sim.value("f_mean");
    sim.run(integrator.run(950000));
    const double drift = std::fabs(sim.value("f_mean") - early) / swing;
    const std::string what = integrator.of("C2 *: the same on a spring, which is no contact");
    if (integrator.name != "mts") {
      expect_criterion(what, drift, 0.0, 1e-4);
      continue;
    }
    expect_unmet(what, drift, 0.0, 1e-4, 1.0,
                 "a force as it was at the begin of a particle step feeds an undamped contact");
    const double z = 10.0 * dt * std::sqrt(0.990578 * k / m_eff),
                 rate = 0.1 / (4.0 * 0.990578) * (1.0 - std::cos(z) - 0.5 * z * std::sin(z));
    expect_criterion("C2 mts: the same, of the closed form of this gain",
                     drift / (std::exp(97500.0 * rate) - std::exp(2500.0 * rate)), 0.93, 1.07);
  }
}

// C6: E of 10 GPa, lambda = 1.5e7
TEST(Integrators, stiff_spheres)
{
  const JkrCurve stiff{0.25, 1.5e7, 0.75};
  const double share = 1.0 / 1500.0;
  const std::string law = " jkr " + digits(stiff.E * 2.0 * (1.0 - 0.0625)) + " 0.25 0.75 ";
  // E to the share, gamma to its power of 2/5: the sticking speed stays
  const JkrCurve soft{0.25, stiff.E * share, 0.75 * std::pow(share, 0.4)};
  const Scale fast(stiff, m_eff), slow(soft, m_eff);
  EXPECT_NEAR(slow.V_s / fast.V_s, 1.0, 1e-9);
  for (const auto &integrator : integrators) {
    Impacts hard, softened;
    hard.speeds = softened.speeds = {1.2 * fast.V_s, 1.5 * fast.V_s, 3.0 * fast.V_s};
    hard.T = fast.T;
    hard.step = 0.02 * fast.T;
    hard.law = law;
    softened.T = slow.T;
    softened.step = 0.02 * slow.T;
    softened.law = law + "scale_stiffness " + digits(share);
    const auto e = hard.restitutions(integrator), e_soft = softened.restitutions(integrator);
    for (size_t n = 0; n < e.size(); n++)
      expect_criterion(integrator.of("C6 *: e of softened less e of stiff spheres"),
                       e_soft[n] - e[n], -0.01, 0.01);
    for (auto *impacts : {&hard, &softened}) {
      auto apart = [&](double V) {
        auto at = *impacts;
        at.speeds = {V * fast.V_s};
        at.phases = 16;
        const auto e = at.restitutions(integrator);
        return std::count_if(e.begin(), e.end(), [](double one) {
          return one > 0.0;
        });
      };
      expect_criterion(integrator.of("C6 *: pairs of 16 that part at 0.99 V_s, stiff and softened"),
                       apart(0.99), 0.0, 0.0);
      expect_criterion(integrator.of("C6 *: pairs of 16 that part at 1.01 V_s, stiff and softened"),
                       apart(1.01), 16.0, 16.0);
    }
    hard.speeds = {3.0 * fast.V_s};
    hard.phases = 16;
    for (const double first_phase : {0.0, 0.5}) {    // 0: one touches at the very end of a step
      hard.first_phase = first_phase;
      hard.origin = 0.0;
      const auto near = hard.restitutions(integrator);
      hard.origin = 10000.0;
      const auto far = hard.restitutions(integrator);
      expect_criterion(integrator.of("C6 *: change of e 1e4 d from the origin"),
                       difference(far, near) * largest(near), 0.0, 1e-6);
    }
  }
}

// C12: oblique impacts with spin and friction, each pair by itself; 2000 at a time, since places in
// a larger box are rounded more coarsely
TEST(Integrators, angular_momentum_of_impacts)
{
  const int pairs = 2000, batches = 50, side = static_cast<int>(std::ceil(std::cbrt(pairs)));
  for (int batch = 0; batch < batches; batch++)
    for (const auto &integrator : integrators) {
      std::mt19937 random(12 + batch);
      std::uniform_real_distribution<double> u(-1.0, 1.0);
      const double V = 3.0 * scale.V_s, gap = V * scale.T;
      std::vector<double> x, v;
      for (int n = 0; n < pairs; n++)
        for (const double sign : {-0.5, 0.5}) {
          const double at[] = {double(n % side), double(n / side % side), double(n / side / side)};
          for (int c = 0; c < 3; c++)
            x.push_back(3.0 * at[c] + 1.5 + (c == 0 ? sign * (1.0 + gap) : 0.0));
          v.insert(v.end(), {-sign * V, sign * V * u(random), sign * V * u(random)});
        }
      Scene scene;
      const std::string width = "0 " + std::to_string(3 * side) + " ";
      scene.box = width + width + width;
      scene.style = plain(jkr + "damping tsuji 0.8" + all_friction);
      Simulation sim;
      build(sim, {}, scene);
      add_spheres(sim, x, v);
      const std::string spin = digits(V);
      sim.run("variable w atom " + spin + "*sin(id)\nset group all omega v_w v_w v_w\n" +
              "neighbor 0.6 bin\n" + integrator.commands(0.2 * scale.T) + "run 0");
      auto angular = [&] {    // of each pair about its middle, over m d V
        const auto p = gather(sim, "x"), u = gather(sim, "v"), w = gather(sim, "omega");
        std::vector<double> L(3 * pairs);
        for (int n = 0; n < pairs; n++)
          for (int c = 0; c < 3; c++) {
            const int a = (c + 1) % 3, b = (c + 2) % 3, i = 6 * n, j = 6 * n + 3;
            L[3 * n + c] = (0.5 *
                                ((p[j + a] - p[i + a]) * (u[j + b] - u[i + b]) -
                                 (p[j + b] - p[i + b]) * (u[j + a] - u[i + a])) +
                            0.1 * (w[i + c] + w[j + c])) /
                V;
          }
        return L;
      };
      const auto before = angular();
      const auto w = gather(sim, "omega");
      sim.run(integrator.run(100));
      const auto after = angular();
      EXPECT_GT(difference(gather(sim, "omega"), w), 0.1);
      expect_criterion(integrator.of("C12 *: angular momentum lost in one of 1e5 impacts"),
                       difference(after, before) * largest(before), 0.0, 1e-12);
    }
}

// C19: the dashpot acts at the first touch
TEST(Integrators, damped_impacts)
{
  for (const double alpha : {0.1, 0.5, 1.018}) {
    std::vector<double> exact;
    Impacts at;
    at.law = jkr + "damping alpha " + digits(alpha);
    for (const double V : {1.1, 1.5, 2.0, 4.0, 10.0, 30.0}) {
      at.speeds.push_back(V * scale.V_s);
      exact.push_back(damped_restitution(curve, m_eff, alpha, V * scale.V_s));
    }
    for (const auto &integrator : integrators) {
      double before = 0.0;
      for (const double step : {0.1, 0.05, 0.025, 0.0125}) {
        at.step = step * scale.T;
        const auto e = at.restitutions(integrator);
        double error = 0.0;
        for (size_t n = 0; n < e.size(); n++)
          error = std::max(error, std::fabs(e[n] - exact[n / at.phases]));
        if (step == 0.05)
          expect_criterion(integrator.of("C19 *: largest error of e, damped, omega dt = 0.05"),
                           error, 0.0, 0.01);
        if (before > 0.0)
          expect_criterion(
              integrator.of("C19 *: error of e at half the step over that at the step"),
              error / before, 0.0, 1.0);
        before = error;
      }
    }
  }
}

// ... in a fluid, whose drag r-RESPA has on its outer level
TEST(Integrators, damped_impacts_in_a_fluid)
{
  const double alpha = 0.5;
  Impacts at;
  at.law = jkr + "damping alpha " + digits(alpha);
  at.tau = 40.0 * scale.T;
  at.step = 0.05 * scale.T;
  for (const double V : {2.0, 4.0, 10.0, 30.0}) at.speeds.push_back(V * scale.V_s);
  for (const auto &integrator : integrators) {
    const auto e = at.restitutions(integrator);
    double error = 0.0, without = 0.0;
    for (int n = 0; n < static_cast<int>(e.size()); n++) {
      const double V = at.speed_at_touch(n);
      error = std::max(error, std::fabs(e[n] - damped_restitution(curve, m_eff, alpha, V, at.tau)));
      without = std::max(without, std::fabs(e[n] - damped_restitution(curve, m_eff, alpha, V)));
    }
    EXPECT_GT(without, 0.02) << "the fluid matters";
    expect_criterion(integrator.of("C19 *: largest error of e, damped, in a fluid"), error, 0.0,
                     0.01);
  }
}

}    // namespace
