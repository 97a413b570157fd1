// Head-on impacts of spheres under fix nve/sphere/mts: many pairs in one box, each with its own
// speed and place on the time grid, against closed forms and an integrator of their own. C1, C6,
// C19 of the list of hard cases.

#include "criterion.h"
#include "damped_impact.h"
#include "scenes.h"

#include <algorithm>

namespace {

const Material material;
const double m_eff = pi / 12.0;    // of two spheres of diameter and density 1

// Work of a touch-detach cycle over F_C delta_C (JKR), and the speed that it just stops.
double break_work(const JkrCurve &curve)
{
  return 0.935503 * curve.F_C() * curve.delta_C();
}
double sticking_speed(const JkrCurve &curve)
{
  return std::sqrt(2.0 * break_work(curve) / m_eff);
}

struct Impact {
  double speed, gap;
};

struct Setting {
  std::string law = jkr, commands, shift = "0";
  int steps = 0;
  double reach = 0.0;    // of an end of a neck: pairs nearer are bound
};

// Restitution of each impact, 0 where the spheres stay together.
std::vector<double> restitutions(const std::vector<Impact> &impacts, const Setting &setting)
{
  const double o = std::stod(setting.shift);
  auto range = [&](double width) {
    return digits(o) + " " + digits(o + width) + " ";
  };
  const int side = static_cast<int>(std::ceil(std::sqrt(impacts.size())));
  std::vector<double> x, v;
  for (size_t n = 0; n < impacts.size(); n++)
    for (const double sign : {-1.0, 1.0}) {
      x.insert(x.end(),
               {o + snap(8.0 + sign * 0.5 * (1.0 + impacts[n].gap)), o + 2.0 + 4.0 * (n % side),
                o + 2.0 + 4.0 * (n / side)});
      v.insert(v.end(), {-sign * 0.5 * impacts[n].speed, 0.0, 0.0});
    }
  Scene scene;
  scene.box = range(16.0) + range(4.0 * side) + range(4.0 * side);
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + setting.law + "\n";
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run(setting.commands + "run " + std::to_string(setting.steps));
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  const auto end = gather(sim, "x"), speed = gather(sim, "v");
  std::vector<double> result;
  for (size_t n = 0; n < impacts.size(); n++) {
    const double distance = end[6 * n + 3] - end[6 * n];
    result.push_back(distance > 1.0 + setting.reach
                         ? (speed[6 * n + 3] - speed[6 * n]) / impacts[n].speed
                         : 0.0);
  }
  return result;
}

// 50 phases of the time grid at one speed, about four particle steps of free flight before
std::vector<Impact> phases(double speed, double step, int count = 50)
{
  std::vector<Impact> impacts;
  for (int n = 0; n < count; n++) impacts.push_back({speed, speed * (0.01 + step * n / count)});
  return impacts;
}

// ---------------------------------------------------------------------------------------------
// C1. Were the steps in which contacts are made and end taken as they are, e would scatter with the
// phase by 8 % at 1.2 V_s and this step, in proportion to it; with the force of the jump times the
// time that was missed, by some tenths of a per cent. They leave the energy that leapfrog steps
// keep, so that the error is of second order.

const double accurate = 4.0 * dt;    // omega dt = 0.1 of the normal mode at rest

Setting elastic(double step)
{
  Setting setting;
  setting.commands = mts(40, step) + "neighbor 2.0 bin\n";
  setting.steps = static_cast<int>(std::ceil(0.1 / (40 * step)));
  setting.reach = material.pair().delta_C();
  return setting;
}

TEST(MtsImpact, adhesion_takes_its_work_at_every_phase)
{
  const double W = break_work(material.pair()), V_s = sticking_speed(material.pair());
  for (const double V : {1.2, 1.5, 2.0, 3.0, 5.0}) {
    double mean = 0.0, least = 1.0, most = 0.0;
    const auto e = restitutions(phases(V * V_s, accurate), elastic(accurate));
    for (const double one : e) {
      mean += 0.5 * m_eff * V * V_s * V * V_s * (1.0 - one * one) / e.size();
      least = std::min(least, one);
      most = std::max(most, one);
    }
    expect_criterion("C1 mts: mean work of a neck over 0.9355 F_C delta_C", mean / W, 0.99, 1.01);
    expect_criterion("C1 mts: scatter of e over 50 phases", most - least, 0.0, 0.01);
  }
}

TEST(MtsImpact, sticking_speed)
{
  const double V_s = sticking_speed(material.pair());
  for (const double V : {0.5, 0.9, 0.98})
    EXPECT_EQ(largest(restitutions(phases(V * V_s, accurate), elastic(accurate))), 0.0) << V;
  const auto e = restitutions(phases(1.02 * V_s, accurate), elastic(accurate));
  EXPECT_GT(*std::min_element(e.begin(), e.end()), 0.0);
}

TEST(MtsImpact, error_falls_with_the_step)
{
  const double V_s = sticking_speed(material.pair());
  auto error = [&](double step) {    // mean of 5 speeds at 50 phases
    double sum = 0.0;
    for (const double V : {1.2, 1.5, 2.0, 3.0, 5.0})
      for (const double e : restitutions(phases(V * V_s, step), elastic(step)))
        sum += std::fabs(e - std::sqrt(1.0 - 1.0 / (V * V)));
    return sum / 250.0;
  };
  const double coarse = error(4 * dt);
  expect_criterion("C1 mts: mean error of e at omega dt = 0.1", coarse, 1e-6, 1e-4);
  const double slope = std::log2(coarse / error(dt)) / 2.0;
  expect_criterion("C1 mts: order of the error in the step", slope, 1.8, 3.2);
}

// ---------------------------------------------------------------------------------------------
// C19, B2.3

TEST(MtsImpact, damped_restitution_is_that_of_another_integrator)
{
  const auto curve = material.pair();
  for (const double alpha : {0.1, 0.5, 1.018}) {
    std::vector<Impact> impacts;
    std::vector<double> exact;
    for (const double V : {1.1, 1.5, 2.0, 4.0, 10.0, 30.0}) {
      const double speed = V * sticking_speed(curve);
      for (const auto &impact : phases(speed, dt, 5)) impacts.push_back(impact);
      exact.resize(impacts.size(), damped_restitution(curve, m_eff, alpha, speed));
    }
    auto computed = [&](const std::string &safety) {
      Setting setting;
      setting.law = jkr + "damping alpha " + digits(alpha);
      setting.commands = "fix nve all nve/sphere/mts collision auto safety " + safety +
          "\ntimestep 0.001\nneighbor 1.0 bin\n";
      setting.steps = 100;
      setting.reach = curve.delta_C();
      return restitutions(impacts, setting);
    };
    const auto coarse = computed("0.3"), fine = computed("0.05");
    double worst[2] = {};
    for (size_t n = 0; n < impacts.size(); n++) {
      worst[0] = std::max(worst[0], std::fabs(coarse[n] - exact[n]));
      worst[1] = std::max(worst[1], std::fabs(fine[n] - exact[n]));
    }
    printf("C19, alpha %.3f: largest error of e %.4f, at a sixth of the step %.5f\n", alpha,
           worst[0], worst[1]);
    expect_criterion("C19 mts: largest error of e, damped, default safety", worst[0], 0.0, 0.01);
    EXPECT_LT(worst[1], 0.003) << alpha;
    EXPECT_LT(worst[1], 0.5 * worst[0]) << alpha;
  }
}

// ---------------------------------------------------------------------------------------------
// C6: E = 10 GPa, some 750 collision steps in a particle step of 0.1 d/U

const double stiff_E = 1.5e7, soft_share = 1.0 / 1500.0;

Setting stiff(const std::string &more = "")
{
  Setting setting;
  setting.law = " jkr " + digits(stiff_E * 2.0 * (1.0 - 0.0625)) + " 0.25 0.75 " + more;
  setting.commands = "fix nve all nve/sphere/mts collision auto safety 0.01\ntimestep 0.125\n"
                     "neighbor 0.5 bin\n";
  setting.steps = 40;
  setting.reach = 1e-4;
  return setting;
}

TEST(MtsImpact, stiff_spheres_rebound_as_soft_ones)
{
  const JkrCurve curve{0.25, stiff_E, 0.75};
  const double V_s = sticking_speed(curve);
  for (const std::string damping : {"", "damping alpha 0.3 "}) {
    std::vector<Impact> impacts;
    for (const double V : {0.98, 1.1, 1.5, 3.0}) impacts.push_back({V * V_s, V * V_s * 0.3});
    auto soft = stiff(damping + "scale_stiffness " + digits(soft_share));
    soft.reach = 2e-3;
    const auto hard = restitutions(impacts, stiff(damping)), e = restitutions(impacts, soft);
    for (size_t n = 0; n < e.size(); n++) {
      const double V = impacts[n].speed / V_s;
      expect_criterion("C6 mts: e of softened less e of stiff spheres, N by collision auto",
                       e[n] - hard[n], -0.01, 0.01);
      if (damping.empty()) {
        EXPECT_NEAR(hard[n], V > 1.0 ? std::sqrt(1.0 - 1.0 / (V * V)) : 0.0, 0.01) << V;
      }
    }
  }
}

TEST(MtsImpact, stiff_spheres_stick_at_the_speed_of_soft_ones)
{
  const double V_s = sticking_speed({0.25, stiff_E, 0.75});
  auto soft = stiff("scale_stiffness " + digits(soft_share));
  soft.reach = 2e-3;
  for (const auto &setting : {stiff(), soft})
    for (const double V : {0.99, 1.01}) {
      const auto e = restitutions(phases(V * V_s, 0.125, 16), setting);
      const auto apart = std::count_if(e.begin(), e.end(), [](double one) {
        return one > 0.0;
      });
      if (V < 1.0)
        expect_criterion(
            "C6 mts: pairs of 16 that part at 0.99 V_s, stiff and softened, N by collision auto",
            apart, 0.0, 0.0);
      else
        expect_criterion(
            "C6 mts: pairs of 16 that part at 1.01 V_s, stiff and softened, N by collision auto",
            apart, 16.0, 16.0);
    }
}

// damped, with all 750 collision steps
TEST(MtsImpact, far_from_the_origin_nothing_changes)
{
  const double V = 3.0 * sticking_speed({0.25, stiff_E, 0.75});
  auto near = stiff("damping alpha 0.3 ");
  near.commands = "fix nve all nve/sphere/mts collision 750\ntimestep 0.125\nneighbor 0.5 bin\n";
  auto far = near;
  far.shift = "10000";
  const auto e = restitutions(phases(V, 1e-3, 4), near);
  const auto shifted = restitutions(phases(V, 1e-3, 4), far);
  ASSERT_GT(e[0], 0.1);
  EXPECT_LT(difference(shifted, e) * largest(e), 1e-6);    // rounding; as Integrators.stiff_spheres
  EXPECT_GT(difference(shifted, e), 0.0);
}

}    // namespace
