// fix nve/sphere/mts against run_style verlet with fix nve/sphere at the collision step: where
// forces besides contacts are constant the two are the same to rounding, also where particles
// change between the levels. run_style respa shakes contacts with its outer force; mts does not.

#include "scenes.h"

namespace {

const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const std::string pair = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
const std::string floor_wall = "fix wall all wall/levelset plane z 0 NULL" + law + "\n";

struct Case {
  std::vector<Sphere> spheres;
  Scene scene;
  std::string commands;
  std::vector<double> v, omega;    // of the spheres, [3]
};

State after(const Case &c, const std::string &integrate, int steps)
{
  Simulation sim;
  build(sim, c.spheres, c.scene);
  for (size_t n = 0; n < c.spheres.size(); n++)
    set_motion(sim, static_cast<int>(n) + 1, {&c.v[3 * n], &c.v[3 * n] + 3},
               {&c.omega[3 * n], &c.omega[3 * n] + 3});
  sim.run(c.commands + integrate + "run " + std::to_string(steps));
  return state_of(sim);
}

const std::string verlet = "fix nve all nve/sphere\n";

void expect_verlet(const Case &c, double tolerance, int steps = 640)
{
  const State reference = after(c, verlet, steps);
  const State start = after(c, verlet, 0);
  ASSERT_GT(difference(reference.v, start.v), 1e-2);
  for (const int n : {8, 40}) {
    SCOPED_TRACE(n);
    const State levels = after(c, mts(n), steps / n);
    expect_same(levels, reference, tolerance);
  }
}

// three spheres slip, roll and fall on a wall
Case pile(const std::string &newton = "on")
{
  Case c;
  c.spheres = {{3.5, 4.0, 0.49}, {4.48, 4.0, 0.485}, {4.0, 4.2, 1.515}};
  c.scene.newton = newton;
  c.scene.boundary = "p p f";
  c.scene.style = pair;
  c.commands = "fix g all gravity 500 vector 1 0.5 -1\n" + floor_wall;
  c.v = {1.0, 0.5, 0.0, 0.5, 1.0, 0.0, 2.0, 0.0, -1.0};
  c.omega = {3.0, 1.0, 2.0, -2.0, 4.0, 1.0, 0.0, -3.0, -2.0};
  return c;
}

TEST(RanksMtsVerlet, pile_on_a_wall)
{
  for (const char *newton : {"on", "off"}) expect_verlet(pile(newton), 1e-10);
}

TEST(RanksMtsVerlet, in_the_plane)
{
  Case c = pile();
  c.scene.before = "dimension 2";
  c.scene.boundary = "p f p";
  c.scene.box = "0 8 0 8 -0.5 0.5";
  c.spheres = {{3.5, 0.49, 0.0}, {4.48, 0.485, 0.0}, {4.0, 1.515, 0.0}};
  c.commands = "fix g all gravity 500 vector 1 -1 0\nfix flat all enforce2d\n"
               "fix wall all wall/levelset plane y 0 NULL" +
      law + "\n";
  c.v = {1.0, 0.0, 0.0, 0.5, 0.0, 0.0, 2.0, -1.0, 0.0};
  c.omega = {0.0, 0.0, 3.0, 0.0, 0.0, -2.0, 0.0, 0.0, 5.0};
  expect_verlet(c, 1e-10);
}

TEST(RanksMtsVerlet, size_ratio_of_ten_and_frozen_spheres)
{
  Case c = pile();
  c.spheres = {{3.5, 4.0, 0.49}, {4.04, 4.0, 0.48, 0.1}, {3.4, 4.2, 1.02, 0.1}};
  c.commands += "group hold id 1\nfix hold hold freeze\n";
  c.v = {0.0, 0.0, 0.0, 0.5, 1.0, 0.0, 2.0, 0.0, -1.0};
  c.omega = {0.0, 0.0, 0.0, -2.0, 4.0, 1.0, 0.0, -3.0, -2.0};
  expect_verlet(c, 1e-10);
  const State end = after(c, mts(8), 80);
  EXPECT_EQ(end.x[0], 3.5);
  EXPECT_EQ(end.v[2], 0.0);
  EXPECT_EQ(end.omega[1], 0.0);
  c.commands = c.commands.substr(0, c.commands.find("group"));    // none is frozen
  expect_verlet(c, 1e-10);
}

// What is outside the fix's group stays where it is, whatever velocity it has.
TEST(RanksMtsVerlet, group_of_some)
{
  auto some = [](std::string integrate) {
    return "group some id 2 3\n" + integrate.replace(integrate.find("nve all"), 7, "nve some");
  };
  const State reference = after(pile(), some(verlet), 640),
              levels = after(pile(), some(mts(8)), 80);
  expect_same(levels, reference, 1e-10);
  EXPECT_EQ(levels.x[0], 3.5);
  EXPECT_EQ(levels.v[0], 1.0);
}

TEST(RanksMtsVerlet, pairs_of_types)
{
  Case c = pile();
  c.scene.types = 3;
  c.scene.type = {1, 2, 3};
  c.scene.style = "pair_style granular/adhesive\npair_coeff 1 1 jkr 1e6 0.3 50\n"
                  "pair_coeff 2 2 jkr 4e5 0.2 200 damping tsuji 0.4 sliding 0.2\n"
                  "pair_coeff 3 3 jkr 2e6 0.25 0 damping alpha 0.5\n"
                  "pair_coeff 1 3 jkr 1e6 0.25 80 sliding 0.5 rolling 0.01\n";
  expect_verlet(c, 1e-10);
}

TEST(RanksMtsVerlet, inside_a_cylinder)
{
  Case c = pile();
  c.scene.boundary = "p f f";
  c.scene.box = "0 8 -4 4 -4 4";
  c.spheres = {{3.5, 0.0, -2.49}, {4.48, 0.1, -2.485}, {4.0, 0.2, -1.485}};
  c.commands = "fix g all gravity 500 vector 1 0.5 -1\n"
               "fix wall all wall/levelset cylinder x 0 0 3 inside" +
      law + "\n";
  expect_verlet(c, 1e-10);
}

// ---------------------------------------------------------------------------------------------

double distance(const State &a, const State &b)
{
  return difference(a.x, b.x);
}

// The outer force of r-RESPA shakes contacts; the same force over all sub-steps does not.
TEST(MtsVerlet, is_nearer_than_respa)
{
  const State reference = after(pile(), verlet, 640);
  const State respa =
      after(pile(), verlet + "run_style respa 2 8 pair 1\ntimestep " + digits(8 * dt) + "\n", 80);
  const State levels = after(pile(), mts(8), 80);
  const double moved = distance(reference, after(pile(), verlet, 0));
  EXPECT_GT(distance(respa, reference) / moved, 1e-6);
  EXPECT_LT(distance(respa, reference) / moved, 2e-2);
  EXPECT_LT(distance(levels, reference) / moved, 1e-10);
}

// A free particle drifts once in a particle step, one that may meet another N times; the fraction
// of these, their contacts and their steps are reported.
TEST(MtsVerlet, reports_what_it_does)
{
  Simulation sim;
  const Material material;
  const double distance = 1.0 - material.pair().delta_eq();
  build(sim, {{1.0, 4.0, 4.0}, {1.0 + distance, 4.0, 4.0}, {5.0, 4.0, 4.0}, {6.5, 4.0, 4.0}},
        pile().scene);
  set_motion(sim, 3, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run(mts(10) + "run 7");
  EXPECT_EQ(sim.value("f_nve[1]"), 10.0);
  EXPECT_EQ(sim.value("f_nve[2]"), 0.5);
  EXPECT_EQ(sim.value("f_nve[3]"), 1.0);
  EXPECT_EQ(sim.value("f_nve[4]"), 70.0);
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  // tangential mode, sqrt(8 G a0 (1/m + 5/2m))
  const double a0 = material.pair().a0(), kt = 8.0 * material.G_eff() * a0;
  EXPECT_NEAR(sim.value("f_nve[6]") / (std::sqrt(3.5 * kt / (pi / 12.0)) * dt), 1.0, 1e-6);
  sim.run("unfix nve\nfix nve all nve/sphere/mts collision auto safety 0.1\nrun 3");
  EXPECT_LE(sim.value("f_nve[6]"), 0.1);
  EXPECT_GT(sim.value("f_nve[6]"), 0.05);
  EXPECT_EQ(sim.value("f_nve[4]"), 3.0 * sim.value("f_nve[1]"));
  sim.run("group gone id 4\ndelete_atoms group gone compress no");
  EXPECT_EQ(sim.value("f_nve[2]"), 0.5);    // of the atoms that there were in the step
}

}    // namespace
