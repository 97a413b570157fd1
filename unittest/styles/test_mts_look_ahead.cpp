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
// C4: impacts from all sides and up to 0.99 of the way past each other; bodies move by up to a
// radius in a step

// What a Hertz impact at the speed 1 does to the velocity: |change|. R: radius of the contact. The
// middles are D apart at touch and their ways pass each other at b; the force along their line is
// integrated here.
double kick(const Impact &impact, double R, double D, double b)
{
  const double k = 4.0 / 3.0 * impact.lambda * std::sqrt(R) / impact.m();
  const double step = impact.duration() / 50.0;
  double x = -std::sqrt(D * D - b * b) + 0.5 * step, y = b, u = 1.0, v = 0.0;
  auto distance = [&] {
    return std::sqrt(x * x + y * y);
  };
  for (double r = distance(); r < D; r = distance()) {
    const double push = step * k * (D - r) * std::sqrt(D - r) / r;
    u += push * x;
    v += push * y;
    x += step * u;
    y += step * v;
  }
  return std::hypot(u - 1.0, v);
}

// rows [bodies][3]: the relative velocity before and after, and the kick that each should have had
struct Struck {
  int missed = 0;
  double worst_kick = 0.0, worst_energy = 0.0;

  void count(const double *before, const double *after, double expected)
  {
    double change = 0.0, energy = 0.0;
    for (int c = 0; c < 3; c++) {
      change += std::pow(after[c] - before[c], 2);
      energy += after[c] * after[c];
    }
    const double error = std::fabs(std::sqrt(change) / expected - 1.0);
    missed += error > 0.02;
    worst_kick = std::max(worst_kick, error);
    worst_energy = std::max(worst_energy, std::fabs(energy - 1.0));
  }
};

void expect_all_struck(const std::string &impacts, const Struck &struck, Simulation &sim)
{
  expect_criterion("C4 mts: missed of " + impacts, struck.missed, 0.0, 0.0);
  EXPECT_LT(struck.worst_kick, 0.01);
  EXPECT_LT(struck.worst_energy, 0.01);
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
}

TEST(MtsLookAhead, no_impact_is_missed)
{
  const Impact impact{1e3, false};
  const int n = 100000, side = 47;
  std::mt19937 random(4);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;
  std::vector<double> x, v, expected;
  for (int k = 0; k < n; k++) {
    double e[3], t[3], e2 = 0.0, t2 = 0.0, et = 0.0;
    for (int c = 0; c < 3; c++) e[c] = gauss(random), t[c] = gauss(random);
    for (int c = 0; c < 3; c++) e2 += e[c] * e[c], et += e[c] * t[c];
    for (int c = 0; c < 3; c++) t[c] -= et / e2 * e[c];
    for (int c = 0; c < 3; c++) t2 += t[c] * t[c];
    const double b = 0.99 * std::sqrt(uniform(random)), far = 1.5 + 3.0 * uniform(random);
    const int cell[3] = {k % side, k / side % side, k / side / side};
    expected.push_back(kick(impact, impact.R(), 1.0, b));
    for (const double sign : {-0.5, 0.5})
      for (int c = 0; c < 3; c++) {
        x.push_back(9.0 * (cell[c] + 0.5) +
                    sign * (far * e[c] / std::sqrt(e2) + b * t[c] / std::sqrt(t2)));
        v.push_back(-sign * e[c] / std::sqrt(e2));
      }
  }
  Scene scene;
  scene.box = "0 423 0 423 0 423";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + impact.law() + "\n";
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run("neighbor 4.5 bin\nfix nve all nve/sphere/mts collision auto\ntimestep 1.0\nrun 6");
  const auto after = gather(sim, "v");
  Struck struck;
  for (int k = 0; k < n; k++) {
    double u[3], w[3];    // of the first relative to the second
    for (int c = 0; c < 3; c++) {
      u[c] = v[6 * k + c] - v[6 * k + 3 + c];
      w[c] = after[6 * k + c] - after[6 * k + 3 + c];
    }
    struck.count(u, w, expected[k]);
  }
  expect_all_struck("1e5 impacts", struck, sim);
}

// ... on a plane, nearly along it, and on a rod of the size of the spheres
TEST(MtsLookAhead, no_wall_is_missed)
{
  const Impact impact{1e3, true};
  const int n = 20000;
  std::mt19937 random(44);
  std::uniform_real_distribution<double> uniform;
  for (const bool rod : {false, true}) {
    // radius of the rod: 1; that of the contact is the geometric mean of those across and along it
    const double r = 0.5, D = 1.0 + r, R = r / std::sqrt(1.0 + r);
    std::vector<double> x, v, expected;
    for (int k = 0; k < n; k++) {
      const double b = 0.99 * std::sqrt(uniform(random)), head_on = std::sqrt(1.0 - b * b);
      const double far = 0.3 + 2.0 * uniform(random), turn = 2.0 * pi * uniform(random);
      const double c = std::cos(turn), s = std::sin(turn), along = 4000.0 * uniform(random);
      if (rod) {
        const double back = D * head_on + far;
        x.insert(x.end(), {along, -back * c - D * b * s, -back * s + D * b * c});
        v.insert(v.end(), {0.0, c, s});
        expected.push_back(kick(impact, R, D, D * b));
      } else {
        x.insert(x.end(), {along, 4.0 * uniform(random) - 2.0, -7.5 + far * head_on});
        v.insert(v.end(), {b * c, b * s, -head_on});
        expected.push_back(2.0 * head_on);
      }
    }
    Scene scene;
    scene.boundary = rod ? "p f f" : "p p f";
    scene.box = "0 4000 -8 8 -8 8";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + impact.law() +
        "\nneigh_modify exclude type 1 1\nfix wall all wall/levelset " +
        (rod ? "cylinder x 0 0 1 outside" : "plane z -8 NULL") + impact.law() + "\n";
    Simulation sim;
    build(sim, {}, scene);
    add_spheres(sim, x, v);
    sim.run("neighbor 3.0 bin\nfix nve all nve/sphere/mts collision auto\ntimestep 0.5\nrun 7");
    const auto after = gather(sim, "v");
    Struck struck;
    for (int k = 0; k < n; k++) struck.count(&v[3 * k], &after[3 * k], expected[k]);
    expect_all_struck(rod ? "2e4 impacts on a rod" : "2e4 impacts on a plane", struck, sim);
  }
}

// ---------------------------------------------------------------------------------------------
// C5: a particle that passes spheres, or rods of a wall, at a distance, near enough to be
// sub-stepped in every other step: where it is and how fast in the end

constexpr double pass_step = 1.0 / 64.0, pass_time = 40.0 * pass_step;

struct Passed {
  double x, y, u, v;
  int changes = 0;    // of the level, in 40 steps
};

Passed pass(const std::string &beside, const std::string &force, const std::vector<double> &motion)
{
  std::vector<Sphere> spheres = {{2.0, 4.0, 4.0}, {68.0, 1.0, 1.0}};
  Scene scene;
  scene.box = "0 70 0 8 0 8";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
  for (int n = 0; n < 30; n++) {
    const double x = 3.25 + 2.0 * n;
    if (beside == "spheres") spheres.push_back({x, 5.7, 4.0});
    if (beside == "rods")
      scene.style += "fix rod" + std::to_string(n) + " all wall/levelset cylinder z " + digits(x) +
          " 5.7 0.5 outside" + jkr + "\n";
  }
  if (beside == "rods") scene.boundary = "f f p";
  Simulation sim;
  build(sim, spheres, scene);
  set_motion(sim, 1, motion, {0.0, 0.0, 0.0});
  sim.run("group first id 1\nneighbor 2.5 bin\n" + force + mts(16, pass_step / 16.0));
  sim.run("fix log all vector 1 f_nve[2]\nthermo 1\nrun 40");
  const auto x = gather(sim, "x"), v = gather(sim, "v");
  Passed passed{x[0], x[1], v[0], v[1]};
  for (int n = 2; n <= 40; n++)
    passed.changes += sim.value("f_log[" + std::to_string(n) + "]") !=
        sim.value("f_log[" + std::to_string(n - 1) + "]");
  EXPECT_EQ(sim.value("f_nve[3]"), 0.0);
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  return passed;
}

TEST(MtsLookAhead, change_of_level_leaves_the_parabola_alone)
{
  const double a = 0.5, speed = 1.0 / pass_step, t = pass_time;
  const std::vector<std::string> forces = {
      "variable m equal mass(first)\nfix g first addforce $(0.5*v_m:%.17g) 0 0\n",
      "fix air all flow/field uniform 0 0 0 density 1e-30 viscosity 1e-30\n"
      "fix g first flow/force air drag stokes gravity 0.5 0 0\n"};
  for (const std::string beside : {"spheres", "rods"})
    for (const auto &force : forces) {
      const auto passed = pass(beside, force, {speed, 0.0, 0.0});
      EXPECT_GE(passed.changes, 38) << beside;
      expect_criterion("C5 mts: place on the parabola, toggled every step beside " + beside +
                           ", less 1",
                       passed.x / (2.0 + speed * t + 0.5 * a * t * t) - 1.0, -1e-12, 1e-12);
      EXPECT_NEAR(passed.u / (speed + a * t), 1.0, 1e-12) << beside;
      EXPECT_EQ(passed.y, 4.0) << beside;
    }
}

// Across a shear flow with drag, against the closed form of dv/dt = (G y - v) / tau. The slip of a
// free particle after a step is the mean of those half a step before and after, (h/tau)^2/8 of it
// too much; sub-steps go on with that, so that as much stays at each of 20 hand-overs.
TEST(MtsLookAhead, change_of_level_in_shear_is_of_second_order)
{
  const double G = 16.0, slip = 0.3, rise = 0.05;
  for (const double tau : {0.5, 1.0, 2.0}) {
    // tau = m / (3 pi mu d), the fluid's mass being none
    const std::string air = "fix air all flow/field shear x y 16 0 density 1e-30 viscosity " +
        digits(1.0 / 18.0 / tau) + "\nfix g first flow/force air drag stokes\n";
    const double t = pass_time / tau, decay = std::exp(-t), y = tau * rise * (1.0 - decay),
                 u = slip * decay + G * rise * tau * (1.0 - decay - t * decay),
                 unit = std::pow(pass_step / tau, 2) / 8.0;
    for (const std::string beside : {"nothing", "spheres", "rods"}) {
      const bool toggled = beside != "nothing";
      const auto end = pass(beside, air, {4.0 * G + slip, rise, 0.0});
      EXPECT_EQ(end.changes, toggled ? 39 : 0);
      const double most = (toggled ? 20.0 : 1.0) * unit;
      for (const double error :
           {end.v / (rise * decay) - 1.0, (end.u - 4.0 * G) / u - 1.0, (end.y - 4.0) / y - 1.0}) {
        EXPECT_NEAR(error / most, 0.0, 1.1) << beside << " " << tau;
        if (toggled)
          expect_criterion("C5 mts: error in shear, toggled every step beside " + beside +
                               ", of 20 (h/tau)^2/8",
                           error / most, -1.1, 1.1);
      }
    }
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
