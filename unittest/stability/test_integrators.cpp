// Impacts and the bound doublet of the list of hard cases, C1, C2, C6, C8, C12 and C19, under
// velocity Verlet, stock r-RESPA and fix nve/sphere/mts; more of the latter in test_mts_impact.cpp.

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

  std::vector<double> restitutions(const Integrator &integrator) const
  {
    std::vector<double> x, v, e;
    const int all = phases * static_cast<int>(speeds.size());
    for (int n = 0; n < all; n++)
      for (const double sign : {-1.0, 1.0}) {
        const double V = speeds[n / phases],
                     gap = V * (4.0 * T + step * (n % phases + first_phase) / phases);
        x.insert(x.end(),
                 {origin + 8.0 + snap(sign * 0.5 * (1.0 + gap)), origin + 2.0 + 4.0 * (n % 16),
                  origin + 2.0 + 4.0 * (n / 16)});
        v.insert(v.end(), {-sign * 0.5 * V, 0.0, 0.0});
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
    sim.run(integrator.commands(step) + "neighbor 2.0 bin\n" +
            integrator.run(static_cast<int>(60.0 * T / step)));
    const auto after = gather(sim, "v"), end = gather(sim, "x");
    for (int n = 0; n < all; n++)
      e.push_back(end[6 * n + 3] - end[6 * n] > 1.0 + 2.0 * T * speeds[n / phases]
                      ? (after[6 * n + 3] - after[6 * n]) / speeds[n / phases]
                      : 0.0);
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
  // the sticking speed to 2 %
  Impacts fifty{{0.98 * scale.V_s, 1.02 * scale.V_s}, 50};
  fifty.step = 4.0 * dt;
  const auto e = fifty.restitutions(integrator);
  const auto stay = [](auto begin, auto end) {
    return static_cast<double>(std::count(begin, end, 0.0));
  };
  expect_criterion(integrator.of("C1 *: pairs of 50 that stay together at 0.98 V_s"),
                   stay(e.begin(), e.begin() + 50), 50.0, 50.0);
  expect_criterion(integrator.of("C1 *: pairs of 50 that stay together at 1.02 V_s"),
                   stay(e.begin() + 50, e.end()), 0.0, 0.0);
}

TEST(Integrators, impacts_by_verlet)
{
  impacts(integrators[0]);
}
TEST(Integrators, impacts_by_respa)
{
  impacts(integrators[1]);
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
    // no touch at the very end of a step: rounding would choose the step, and e change by 1e-5
    hard.phases = 16;
    hard.first_phase = 0.5;
    const auto near = hard.restitutions(integrator);
    hard.origin = 10000.0;
    const auto far = hard.restitutions(integrator);
    expect_criterion(integrator.of("C6 *: change of e 1e4 d from the origin"),
                     difference(far, near) * largest(near), 0.0, 1e-6);
  }
}

// C8: a small sphere and one 100 and 1000 times as large. e of a wall with R = r/(1 + 1/ratio); an
// oblique impact with friction keeps the angular momentum.
TEST(Integrators, size_ratio)
{
  for (const double ratio : {100.0, 1000.0})
    for (const auto &integrator : integrators)
      for (const bool oblique : {false, true}) {
        const double d = 1.0 / ratio, m = pi / 6.0 * d * d * d / (1.0 + d * d * d);
        const JkrCurve small{0.5 * d / (1.0 + d), 1e4, 1.0 * d};
        const Scale unit(small, m);
        const double V = 2.0 * unit.V_s, gap = V * 2.0 * unit.T;
        Scene scene;
        scene.box = "-4 4 -4 4 -4 4";    // places near 0 are rounded less, and so are arms
        scene.style = plain(" jkr " + digits(2e4 * (1.0 - 0.0625)) + " 0.25 " + digits(1.0 * d) +
                            (oblique ? " sliding 0.3" : ""));
        Simulation sim;
        build(sim, {{0.0, 0.0, 0.0}, {0.5 * (1.0 + d) + gap, 0.0, 0.0, d}}, scene);
        set_motion(sim, 2, {-V, oblique ? 0.7 * V : 0.0, 0.0}, {0.0, 0.0, 0.0});
        auto angular = [&] {    // about the middle of the large one at the start, of all
          const auto x = gather(sim, "x"), v = gather(sim, "v"), w = gather(sim, "omega");
          const double mass[] = {pi / 6.0, pi / 6.0 * d * d * d}, size[] = {1.0, d};
          double L = 0.0;
          for (int n : {0, 1})
            L += mass[n] * (x[3 * n] * v[3 * n + 1] - x[3 * n + 1] * v[3 * n]) +
                0.1 * mass[n] * size[n] * size[n] * w[3 * n + 2];
          return L;
        };
        sim.run("neighbor " + digits(20.0 * gap) + " bin\n" + integrator.commands(0.02 * unit.T) +
                "run 0");
        const double L = angular();
        sim.run(integrator.run(1500));
        const auto v = gather(sim, "v");
        if (oblique) {
          EXPECT_GT(std::fabs(gather(sim, "omega")[5]) * d / V, 0.1);
          expect_criterion(
              integrator.of("C8 *: angular momentum lost at a size ratio of 100, 1000"),
              std::fabs(angular() - L) / (0.5 * pi / 6.0 * d * d * d * V), 0.0, 1e-12);
        } else {
          expect_criterion(
              integrator.of("C8 *: e at a size ratio of 100, 1000 over that of a wall"),
              (v[3] - v[0]) / V / std::sqrt(0.75), 0.999, 1.001);
        }
      }
}

// C12: oblique impacts with spin and friction, each pair by itself; 2000 at a time, since places in
// a larger box are rounded more coarsely
TEST(Integrators, angular_momentum_of_impacts)
{
  const int pairs = 2000, side = static_cast<int>(std::ceil(std::cbrt(pairs)));
  for (int batch = 0; batch < count(1, 50); batch++)
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
      expect_criterion(integrator.of("C12 *: angular momentum lost in one of the impacts"),
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
    for (const double V : {1.5, 2.0, 4.0, 10.0, 30.0}) {
      at.speeds.push_back(V * scale.V_s);
      exact.push_back(damped_restitution(curve, m_eff, alpha, V * scale.V_s));
    }
    for (const auto &integrator : integrators) {
      double error[2] = {};
      for (const int fine : {0, 1}) {
        at.step = (fine ? 0.0125 : 0.05) * scale.T;
        const auto e = at.restitutions(integrator);
        for (size_t n = 0; n < e.size(); n++)
          error[fine] = std::max(error[fine], std::fabs(e[n] - exact[n / at.phases]));
      }
      expect_criterion(integrator.of("C19 *: largest error of e, damped, omega dt = 0.05"),
                       error[0], 0.0, 0.01);
      EXPECT_LT(error[1], error[0]) << integrator.name << alpha;
    }
  }
}

}    // namespace
