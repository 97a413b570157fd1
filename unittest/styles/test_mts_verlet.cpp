// fix nve/sphere/mts against run_style verlet with fix nve/sphere at the collision step: where
// forces besides contacts are constant the two are the same to rounding, also where particles
// change between the levels. Against run_style respa with the contacts at its inner level, whose
// outer force shakes them: that of mts does not.

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

double distance(const State &a, const State &b)
{
  return difference(a.x, b.x);
}

std::string respa(int n)
{
  return verlet + "run_style respa 2 " + std::to_string(n) + " pair 1\ntimestep " + digits(n * dt) +
      "\n";
}

// With outer steps of n collision steps in both. Kicks of r-RESPA are as large as its outer step:
// what they do to contacts shrinks with it.
void expect_respa(const Case &c)
{
  const State start = after(c, verlet, 0);
  auto apart = [&](int n) {    // of the way that is gone
    const State sub = after(c, mts(n), 640 / n);
    return distance(after(c, respa(n), 640 / n), sub) / distance(sub, start);
  };
  const double coarse = apart(8), fine = apart(2);
  EXPECT_GT(coarse, 1e-5);
  EXPECT_LT(coarse, 1e-3);
  EXPECT_GT(coarse / fine, 4.0);
  EXPECT_LT(coarse / fine, 32.0);    // second order: (8^2 - 1) / (2^2 - 1) = 21
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
  for (const char *newton : {"on", "off"}) {
    expect_verlet(pile(newton), 1e-10);
    expect_respa(pile(newton));
  }
}

Case flat()
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
  return c;
}

TEST(RanksMtsVerlet, in_the_plane)
{
  const Case c = flat();
  expect_verlet(c, 1e-10);
  expect_respa(c);
}

TEST(RanksMtsVerlet, size_ratio_of_ten_and_frozen_spheres)
{
  Case c = pile();
  c.spheres = {{3.5, 4.0, 0.49}, {4.04, 4.0, 0.48, 0.1}, {3.4, 4.2, 1.02, 0.1}};
  c.commands += "group hold id 1\nfix hold hold freeze\n";
  c.v = {0.0, 0.0, 0.0, 0.5, 1.0, 0.0, 2.0, 0.0, -1.0};
  c.omega = {0.0, 0.0, 0.0, -2.0, 4.0, 1.0, 0.0, -3.0, -2.0};
  expect_verlet(c, 1e-10);
  expect_respa(c);
  const State end = after(c, mts(8), 80);
  EXPECT_EQ(end.x[0], 3.5);
  EXPECT_EQ(end.v[2], 0.0);
  EXPECT_EQ(end.omega[1], 0.0);
  c.commands = c.commands.substr(0, c.commands.find("group"));    // none is frozen
  expect_verlet(c, 1e-10);
  expect_respa(c);
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
  const State inner = after(pile(), some(respa(8)), 80);
  const double apart = distance(inner, levels) / distance(levels, after(pile(), verlet, 0));
  EXPECT_GT(apart, 1e-5);
  EXPECT_LT(apart, 1e-3);
  EXPECT_EQ(levels.x[0], 3.5);
  EXPECT_EQ(levels.v[0], 1.0);
}

const std::string three_materials = "pair_style granular/adhesive\npair_coeff 1 1 jkr 1e6 0.3 50\n"
                                    "pair_coeff 2 2 jkr 4e5 0.2 200 damping tsuji 0.4 sliding 0.2\n"
                                    "pair_coeff 3 3 jkr 2e6 0.25 0 damping alpha 0.5\n"
                                    "pair_coeff 1 3 jkr 1e6 0.25 80 sliding 0.5 rolling 0.01\n";

TEST(RanksMtsVerlet, pairs_of_types)
{
  Case c = pile();
  c.scene.types = 3;
  c.scene.type = {1, 2, 3};
  c.scene.style = three_materials;
  expect_verlet(c, 1e-10);
  expect_respa(c);
}

// three sizes, three types, one held: all at once, in the plane
TEST(RanksMtsVerlet, sizes_and_types_in_the_plane_and_a_frozen_disc)
{
  Case c = flat();
  c.spheres = {{3.5, 0.49, 0.0}, {4.264, 0.29, 0.0, 0.6}, {3.91, 1.0, 0.0, 0.3}};
  c.scene.types = 3;
  c.scene.type = {1, 2, 3};
  c.scene.style = three_materials;
  c.commands += "group hold id 1\nfix hold hold freeze\n";
  c.v = {0.0, 0.0, 0.0, -0.5, 0.0, 0.0, 2.0, -1.0, 0.0};
  c.omega = {0.0, 0.0, 0.0, 0.0, 0.0, -2.0, 0.0, 0.0, 5.0};
  expect_verlet(c, 1e-10);
  expect_respa(c);
  const State end = after(c, mts(8), 80);
  EXPECT_EQ(end.x[0], 3.5);
  EXPECT_EQ(end.x[1], 0.49);
  EXPECT_GT(std::fabs(end.omega[5]), 0.1);
  EXPECT_GT(std::fabs(end.omega[8]), 0.1);
}

// A stock pair style beside ours acts in particle steps: of second order in them.
TEST(RanksMtsVerlet, beside_a_stock_pair_style)
{
  Case c = pile();
  const std::string ours = "pair_coeff * * granular/adhesive" + law + "\n",
                    overlay = "pair_style hybrid/overlay granular/adhesive ";
  c.scene.style = overlay + "zero 2.0\n" + ours + "pair_coeff * * zero\n";
  expect_verlet(c, 1e-10);
  c.scene.style = overlay + "soft 2.0\n" + ours + "pair_coeff * * soft 200.0\n";
  const State reference = after(c, verlet, 640), start = after(c, verlet, 0);
  const double moved = distance(reference, start);
  Case without = c;
  without.scene.style = pair;
  EXPECT_GT(distance(after(without, verlet, 640), reference) / moved, 1e-2) << "it acts";
  const double coarse = distance(after(c, mts(40), 16), reference) / moved,
               fine = distance(after(c, mts(8), 80), reference) / moved;
  EXPECT_GT(coarse, 1e-5);
  EXPECT_LT(coarse, 2e-3);
  EXPECT_GT(coarse / fine, 12.0);
  EXPECT_LT(coarse / fine, 50.0);    // (40^2 - 1) / (8^2 - 1) = 25
  // both at the inner level of r-RESPA: ours refuses a level of its own by keyword hybrid
  expect_respa(c);
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
  expect_respa(c);
}

// The outer force of r-RESPA shakes contacts; the same force over all sub-steps does not.
TEST(MtsVerlet, is_nearer_than_respa)
{
  const State reference = after(pile(), verlet, 640);
  const State inner = after(pile(), respa(8), 80), levels = after(pile(), mts(8), 80);
  const double moved = distance(reference, after(pile(), verlet, 0));
  EXPECT_GT(distance(inner, reference) / moved, 1e-5);
  EXPECT_LT(distance(inner, reference) / moved, 1e-3);
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
