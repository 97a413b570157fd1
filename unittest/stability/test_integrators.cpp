// The impacts and the bound doublet of the list of hard cases, C1 and C2, under velocity Verlet and
// stock r-RESPA; those of fix nve/sphere/mts are in test_mts_impact.cpp and test_mts_energy.cpp.

#include "criterion.h"
#include "scenes.h"

#include <algorithm>

namespace {

const Material material;
const JkrCurve curve = material.pair();
const double work = 0.935503 * curve.F_C() * curve.delta_C();    // of a touch-detach cycle
const double m_eff = pi / 12.0, V_s = std::sqrt(2.0 * work / m_eff);
const std::string plain = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";

// the step in which contacts are computed is `step` in both
std::string integrator(bool respa, double step)
{
  return "fix nve all nve/sphere\ntimestep " + digits(respa ? 10 * step : step) +
      (respa ? "\nrun_style respa 2 10 pair 1\n" : "\n");
}

// e of head-on impacts at 50 phases of the time grid
std::vector<double> restitutions(bool respa, double V, double step)
{
  std::vector<double> x, v, e;
  for (int n = 0; n < 50; n++)
    for (const double sign : {-1.0, 1.0}) {
      const double gap = V * (0.01 + step * n / 50.0);
      x.insert(x.end(), {8.0 + sign * 0.5 * (1.0 + gap), 2.0 + 4.0 * (n % 8), 2.0 + 4.0 * (n / 8)});
      v.insert(v.end(), {-sign * 0.5 * V, 0.0, 0.0});
    }
  Scene scene;
  scene.box = "0 16 0 32 0 32";
  scene.style = plain;
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  const double outer = respa ? 10 * step : step;
  sim.run(integrator(respa, step) + "neighbor 2.0 bin\nrun " + std::to_string(int(0.1 / outer)));
  const auto after = gather(sim, "v");
  for (int n = 0; n < 50; n++) e.push_back((after[6 * n + 3] - after[6 * n]) / V);
  return e;
}

void impacts(bool respa, const std::string &name)
{
  for (const double V : {1.2, 1.5, 2.0, 3.0, 5.0}) {
    const auto e = restitutions(respa, V * V_s, 4.0 * dt);    // omega dt = 0.1 at rest
    double mean = 0.0;
    for (const double one : e) mean += (1.0 - one * one) * V * V / e.size();
    expect_criterion("C1 " + name + ": mean work of a neck over 0.9355 F_C delta_C", mean, 0.99,
                     1.01);
    expect_criterion("C1 " + name + ": scatter of e over 50 phases",
                     *std::max_element(e.begin(), e.end()) - *std::min_element(e.begin(), e.end()),
                     0.0, 0.01);
  }
}

TEST(Integrators, impacts_by_verlet)
{
  impacts(false, "verlet");
}
TEST(Integrators, impacts_by_respa)
{
  impacts(true, "respa");
}

// 1e6 steps of contact about the bottom of the well, amplitude 0.2 delta_C
void doublet(bool respa, const std::string &name)
{
  Simulation sim;
  Scene scene;
  scene.style = plain;
  build(sim, {{3.0, 4.0, 4.0}, {4.0 - curve.delta_eq() + 0.2 * curve.delta_C(), 4.0, 4.0}}, scene);
  sim.run(integrator(respa, dt) +
          "variable E equal pe+ke\nthermo_style custom step pe ke\nthermo_modify norm no\n"
          "fix mean all ave/time 1 " +
          std::string(respa ? "500 500" : "5000 5000") + " v_E\nthermo 1000000\nrun " +
          (respa ? "500" : "5000"));
  const double early = sim.value("f_mean");
  sim.run(respa ? "run 99500" : "run 995000");
  const double swing =
      0.5 * 0.990578 * curve.F_C() / curve.delta_C() * std::pow(0.2 * curve.delta_C(), 2);
  expect_criterion("C2 " + name + ": drift of energy in 1e6 steps, of that of the swing",
                   std::fabs(sim.value("f_mean") - early) / swing, 0.0, 1e-4);
}

TEST(Integrators, doublet_by_verlet)
{
  doublet(false, "verlet");
}
TEST(Integrators, doublet_by_respa)
{
  doublet(true, "respa");
}

}    // namespace
