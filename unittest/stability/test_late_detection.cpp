// Contacts that are found late, C3 of the list of hard cases: under velocity Verlet and stock
// r-RESPA, whose neighbour lists are looked at once in an outermost step, as under fix
// nve/sphere/mts. More of the latter in test_mts_look_ahead.cpp, C4 in test_tunnelling.cpp.

#include "impacts.h"

namespace {

struct Found {
  double overlap = 0.0;                            // the largest after three particle steps
  double least_energy = 9.0, most_energy = 0.0;    // after the impact, over that before
};

// impacts of particles that have these ways to go
Found impacts(const Impact &impact, const Steps &steps, double skin,
              const std::vector<double> &gaps)
{
  std::vector<double> x, v;
  const int n = static_cast<int>(gaps.size());
  for (int k = 0; k < n; k++) {
    EXPECT_GT(gaps[k], 0.0);
    const double y = 2.0 + 4.0 * (k % 7), z = 2.0 + 4.0 * (k / 7);
    if (impact.at_wall()) {
      x.insert(x.end(), {0.5 + gaps[k], y, z});
      v.insert(v.end(), {-1.0, 0.0, 0.0});
    } else {
      for (const double sign : {-1.0, 1.0}) {
        x.insert(x.end(), {6.0 + sign * 0.5 * (1.0 + gaps[k]), y, z});
        v.insert(v.end(), {-sign * 0.5, 0.0, 0.0});
      }
    }
  }
  Scene scene;
  scene.box = "0 12 0 28 0 28";
  scene.boundary = "f p p";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + impact.law() + "\n";
  if (impact.at_wall()) scene.style += "fix wall all wall/levelset plane x 0 NULL" + impact.law();
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run(steps.commands(skin) + steps.run(3));
  Found found;
  const auto now = gather(sim, "x");
  for (int k = 0; k < n; k++)
    found.overlap = std::max(
        found.overlap, impact.at_wall() ? 0.5 - now[3 * k] : 1.0 - now[6 * k + 3] + now[6 * k]);
  const double farthest = *std::max_element(gaps.begin(), gaps.end());
  sim.run(steps.run(2 + static_cast<int>((farthest + impact.duration) / steps.particle)));
  const auto after = gather(sim, "v");
  for (int k = 0; k < n; k++) {
    const double e = impact.at_wall() ? after[3 * k] : after[6 * k + 3] - after[6 * k];
    found.least_energy = std::min(found.least_energy, e * std::fabs(e));
    found.most_energy = std::max(found.most_energy, e * std::fabs(e));
  }
  return found;
}

// C3: 41 impacts, deepest at the end of the third particle step or up to 15 % of their duration
// before and after; and pairs that are too far from each other for the first neighbour list, at all
// phases of lists and steps, with a skin that the approach of one step nearly fills. Contacts that
// are found late give Hertz's spheres up to 64 times their energy, and take it from those that
// adhere.
void late_detection(const std::string &name, const std::vector<double> &ratios)
{
  for (const double ratio : ratios)
    for (const bool wall : {false, true})
      for (const double lambda : {1e3, 1e4, 1e5, 1.5e7}) {
        const Impact impact(lambda, wall, ratio);
        const std::string kind = ratio > 0.0 ? ", adhesion" : ", Hertz";
        for (const double particle_step : {0.05, 0.1, 0.5}) {
          if (particle_step > 0.05 && name == "verlet") continue;
          SCOPED_TRACE(name + " " + digits(ratio) + " " + digits(lambda) + " " +
                       digits(particle_step) + (wall ? " wall" : " pair"));
          const Steps steps(name, particle_step, impact.duration / 100.0);
          std::vector<double> near, far;
          for (int n = 0; n < 41; n++) {
            near.push_back(3.0 * particle_step - impact.until_deepest -
                           0.3 * impact.duration * (n / 40.0 - 0.5));
            far.push_back(particle_step * (1.1 + 3.0 * n / 41.0));
          }
          const auto seen = impacts(impact, steps, 0.1 + 3.0 * particle_step, near);
          expect_criterion("C3 " + name + ": largest overlap over that of the law" + kind,
                           seen.overlap / impact.deepest, 0.98, 1.02);
          for (const double energy : {seen.least_energy, seen.most_energy})
            expect_criterion("C3 " + name + ": energy after less that of the law" + kind,
                             energy - impact.energy_after(), -0.01, 0.01);
          if (wall) continue;    // walls are not in lists
          // a neck closes faster than they came: its well is 0.607 F_C delta_C deep
          const double fastest =
              std::sqrt(1.0 + 0.607082 / 0.935503 * std::pow(impact.sticking, 2));
          const auto unseen = impacts(impact, steps, 1.05 * fastest * particle_step, far);
          for (const double energy : {unseen.least_energy, unseen.most_energy})
            expect_criterion("C3 " + name + ": the same, not in the first neighbour list" + kind,
                             energy - impact.energy_after(), -0.01, 0.01);
        }
      }
}

const std::vector<double> hertz = {0.0}, adhesion = {1.2, 3.0}, both = {0.0, 1.2, 3.0};

TEST(LateDetection, is_none_by_verlet)
{
  late_detection("verlet", both);
}
TEST(LateDetection, is_none_by_respa)
{
  late_detection("respa", hertz);
}
TEST(LateDetection, is_none_by_respa_with_adhesion)
{
  late_detection("respa", adhesion);
}
TEST(LateDetection, is_none_by_mts)
{
  late_detection("mts", both);
}

// A skin through which particles pass in one step of r-RESPA cannot show contacts in time
TEST(LateDetection, skin_that_one_step_of_respa_crosses_is_an_error)
{
  const Impact impact(1e4, false, 0.0);
  const auto said = [&](double skin, const std::string &more) {
    Simulation sim;
    Scene scene;
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + impact.law() + "\n";
    build(sim, {{2.0, 4.0, 4.0}, {6.0, 4.0, 4.0}}, scene);
    set_motion(sim, 1, {3.0, 1.0, 0.0}, {0.0, 0.0, 0.0});
    set_motion(sim, 2, {-1.0, 4.0, 0.0}, {0.0, 0.0, 0.0});
    return sim.error_of(more + Steps("respa", 0.02, 1e-3).commands(skin) + "run 3");
  };
  EXPECT_EQ(said(0.11, ""), "");    // they differ by 5
  const auto text = said(0.09, "");
  for (const char *words : {"Pair granular/adhesive", "velocities differ by 5,",
                            "approach by 0.1 in a timestep of 0.02", "skin of 0.09",
                            "timestep 0.0072 or smaller", "neighbor 0.24 bin"})
    EXPECT_NE(text.find(words), std::string::npos) << text;
  // a force of the outer level that gives the lighter one a speed of 0.6 in the step
  const std::string pull = "fix pull all addforce " + digits(30.0 * pi / 6.0) + " 0 0\n";
  EXPECT_NE(said(0.11, pull).find("gain up to 0.6,"), std::string::npos);
}

}    // namespace
