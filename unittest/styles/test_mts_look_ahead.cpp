// Spheres that meet within a particle step of fix nve/sphere/mts: found before they overlap, none
// missed, and nothing happens to a particle when it changes between the levels. C3, C4, C5.

#include "criterion.h"
#include "scenes.h"

#include <algorithm>
#include <random>

namespace {

// Hertz's impact at unit speed of spheres of diameter and density 1, lambda = E
struct Impact {
  double lambda;
  bool wall;

  double R() const { return wall ? 0.5 : 0.25; }
  double m() const { return wall ? pi / 6.0 : pi / 12.0; }
  double deepest() const { return std::pow(15.0 * m() / (16.0 * lambda * std::sqrt(R())), 0.4); }
  double duration() const { return 2.9432751 * deepest(); }
  std::string law() const { return " jkr " + digits(2.0 * lambda * (1.0 - 0.0625)) + " 0.25 0.0 "; }
};

struct Found {
  double overlap = 0.0, slowest = 9.0, fastest = 0.0, late = 0.0;    // speeds after it
};

// 41 impacts, deepest at the end of the third particle step, or up to 15 % of their duration before
// and after.
Found impacts(const Impact &impact, double step, const std::string &more)
{
  std::vector<double> x, v;
  for (int n = 0; n < 41; n++) {
    const double gap = 3.0 * step - impact.duration() * (0.5 + 0.3 * (n / 40.0 - 0.5));
    const double y = 2.0 + 4.0 * (n % 7), z = 2.0 + 4.0 * (n / 7);
    if (impact.wall) {
      x.insert(x.end(), {0.5 + gap, y, z});
      v.insert(v.end(), {-1.0, 0.0, 0.0});
    } else {
      for (const double sign : {-1.0, 1.0}) {
        x.insert(x.end(), {4.0 + sign * 0.5 * (1.0 + gap), y, z});
        v.insert(v.end(), {-sign * 0.5, 0.0, 0.0});
      }
    }
  }
  Scene scene;
  scene.box = "0 8 0 28 0 28";
  scene.boundary = "f p p";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + impact.law() + "\n";
  if (impact.wall) scene.style += "fix wall all wall/levelset plane x 0 NULL" + impact.law();
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run("fix nve all nve/sphere/mts collision auto " + more + "\ntimestep " + digits(step) +
          "\nneighbor " + digits(0.1 + 3.0 * step) + " bin\nrun 3");
  Found found;
  const auto now = gather(sim, "x");
  for (int n = 0; n < 41; n++)
    found.overlap =
        std::max(found.overlap, impact.wall ? 0.5 - now[3 * n] : 1.0 - now[6 * n + 3] + now[6 * n]);
  sim.run("run " + std::to_string(2 + static_cast<int>(impact.duration() / step)));
  const auto after = gather(sim, "v");
  for (int n = 0; n < 41; n++) {
    const double speed = impact.wall ? after[3 * n] : after[6 * n + 3] - after[6 * n];
    found.slowest = std::min(found.slowest, speed);
    found.fastest = std::max(found.fastest, speed);
  }
  found.late = sim.value("f_nve[5]");
  return found;
}

TEST(MtsLookAhead, impacts_are_as_deep_and_fast_as_they_should_be)
{
  for (const bool wall : {false, true})
    for (const double lambda : {1e3, 1e4, 1e5, 1.5e7})
      for (const double step : {0.05, 0.1, 0.5}) {
        const Impact impact{lambda, wall};
        const auto found = impacts(impact, step, "");
        SCOPED_TRACE(digits(lambda) + " " + digits(step) + (wall ? " wall" : " pair"));
        expect_criterion("C3 mts: largest overlap over Hertz", found.overlap / impact.deepest(),
                         0.98, 1.02);
        EXPECT_NEAR(found.slowest * found.slowest, 1.0, 0.01);
        expect_criterion("C3 mts: energy after over before", found.fastest * found.fastest, 0.99,
                         1.01);
        EXPECT_EQ(found.late, 0.0);
      }
}

// what happens otherwise, and that the counter tells
TEST(MtsLookAhead, without_it_spheres_fly_apart)
{
  for (const bool wall : {false, true}) {
    const auto found = impacts({1e4, wall}, 0.1, "lookahead no");
    EXPECT_GT(found.fastest, 2.0) << wall;
    EXPECT_LT(found.fastest, 9.0) << wall;    // 64 times the energy is the most
    EXPECT_GT(found.late, 0.0) << wall;
    EXPECT_LE(found.late, 41.0) << wall;
  }
}

// ---------------------------------------------------------------------------------------------
// C4: 100000 impacts from all sides, particles move by up to a radius in a step

TEST(MtsLookAhead, no_impact_is_missed)
{
  const int n = 100000, side = 47;
  std::mt19937 random(4);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  std::vector<double> x, v, head_on;
  for (int k = 0; k < n; k++) {
    double e[3], t[3], e2 = 0.0, t2 = 0.0, et = 0.0;
    for (int c = 0; c < 3; c++) e[c] = gauss(random), t[c] = gauss(random);
    for (int c = 0; c < 3; c++) e2 += e[c] * e[c], et += e[c] * t[c];
    for (int c = 0; c < 3; c++) t[c] -= et / e2 * e[c];
    for (int c = 0; c < 3; c++) t2 += t[c] * t[c];
    const double b = 0.95 * std::sqrt(uniform(random)), far = 1.5 + 3.0 * uniform(random);
    const int cell[3] = {k % side, k / side % side, k / side / side};
    head_on.push_back(std::sqrt(1.0 - b * b));
    for (const double sign : {-0.5, 0.5})
      for (int c = 0; c < 3; c++) {
        x.push_back(9.0 * (cell[c] + 0.5) +
                    sign * (far * e[c] / std::sqrt(e2) + b * t[c] / std::sqrt(t2)));
        v.push_back(-sign * e[c] / std::sqrt(e2));
      }
  }
  Scene scene;
  scene.box = "0 423 0 423 0 423";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + Impact{1e3, false}.law() + "\n";
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run("neighbor 4.5 bin\nfix nve all nve/sphere/mts collision auto\ntimestep 1.0\nrun 6");
  const auto after = gather(sim, "v");
  int missed = 0;
  double worst = 0.0;
  for (int k = 0; k < n; k++) {
    double kick = 0.0, energy = 0.0;    // of the relative velocity; 2 cos of a hard sphere
    for (int c = 0; c < 3; c++) {
      const double w = after[6 * k + c] - after[6 * k + 3 + c];
      kick += std::pow(w - v[6 * k + c] + v[6 * k + 3 + c], 2);
      energy += w * w;
    }
    missed += std::fabs(std::sqrt(kick) / (2.0 * head_on[k]) - 1.0) > 0.3;
    worst = std::max(worst, std::fabs(energy - 1.0));
  }
  expect_criterion("C4 mts: missed of 1e5 impacts", missed, 0.0, 0.0);
  EXPECT_LT(worst, 0.02);
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
}

// ---------------------------------------------------------------------------------------------
// C5: a particle that passes spheres at a distance, near enough to be sub-stepped in every other
// step, falls along the parabola

TEST(MtsLookAhead, change_of_level_leaves_the_parabola_alone)
{
  const double step = 1.0 / 64.0, a = 0.5;
  const std::vector<std::string> forces = {
      "variable m equal mass(first)\nfix g first addforce $(0.5*v_m:%.17g) 0 0\n",
      "fix air all flow/field uniform 0 0 0 density 1e-30 viscosity 1e-30\n"
      "fix g first flow/force air drag stokes gravity 0.5 0 0\n"};
  for (const auto &force : forces) {
    std::vector<Sphere> spheres = {{2.0, 4.0, 4.0}};
    for (int n = 0; n < 30; n++) spheres.push_back({3.25 + 2.0 * n, 5.7, 4.0});
    Scene scene;
    scene.box = "0 70 0 8 0 8";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
    Simulation sim;
    build(sim, spheres, scene);
    set_motion(sim, 1, {1.0 / step, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("group first id 1\nneighbor 2.5 bin\n" + force + mts(16, step / 16.0));
    sim.run("fix log all vector 1 f_nve[2]\nthermo 1\nrun 40");
    int changes = 0;
    for (int n = 2; n <= 40; n++)
      changes += sim.value("f_log[" + std::to_string(n) + "]") !=
          sim.value("f_log[" + std::to_string(n - 1) + "]");
    const double t = 40.0 * step;
    EXPECT_GE(changes, 38);
    EXPECT_EQ(sim.value("f_nve[3]"), 0.0);
    const double place = gather(sim, "x")[0] / (2.0 + t / step + 0.5 * a * t * t);
    expect_criterion("C5 mts: place on the parabola, toggled every step, less 1", place - 1.0,
                     -1e-12, 1e-12);
    EXPECT_NEAR(gather(sim, "v")[0] / (1.0 / step + a * t), 1.0, 1e-12);
    EXPECT_EQ(gather(sim, "x")[1], 4.0);
  }
}

// with friction and unequal masses, in each step before, in and after an impact
TEST(MtsLookAhead, a_pair_keeps_its_momentum)
{
  Simulation sim;
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "damping tsuji 0.8" +
      all_friction + "\n";
  build(sim, {{3.0, 4.0, 4.0}, {4.0, 4.2, 3.9, 0.3}}, scene);
  set_motion(sim, 1, {20.0, 0.5, 0.1}, {1.0, 2.0, 3.0});
  set_motion(sim, 2, {-5.0, 1.0, 2.0}, {9.0, -8.0, 7.0});
  sim.run(mts(20) + "neighbor 1.0 bin\nrun 0");
  auto momentum = [&] {
    const auto v = gather(sim, "v");
    std::vector<double> p;
    for (int c = 0; c < 3; c++) p.push_back(v[c] + 0.027 * v[3 + c]);
    return p;
  };
  const auto before = momentum();
  double met = 0.0, parted = 0.0;
  for (int n = 0; n < 40; n++) {
    sim.run("run 1");
    met += sim.value("f_nve[3]");
    parted += sim.value("f_nve[2]") == 0.0;
    expect_criterion("C5 mts: change of a pair's momentum", difference(momentum(), before), 0.0,
                     1e-13);
  }
  EXPECT_GT(met, 0.0);
  EXPECT_GT(parted, 1.0);
  EXPECT_GT(std::fabs(gather(sim, "v")[0] - 20.0), 0.1);
}

}    // namespace
