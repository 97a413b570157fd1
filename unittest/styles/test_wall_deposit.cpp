// Compute wall/deposit: heights, dendrites and thickness in scenes built by hand.

#include "scenes.h"
#include "temporary_file.h"

#include "error.h"

namespace {

const double volume = pi / 6.0;    // of a sphere of diameter 1
const std::string halves = "region left block -1 4 -1 9 -1 9\nregion right block 4 9 -1 9 -1 9\n";

// particles, largest height, thickness
using Deposit = std::vector<double>;

struct Pile {
  std::string zones = "", compute = "",
              style = "pair_style granular/adhesive\npair_coeff * *" + jkr;
  std::string newton = "on", plane = "0 8";

  void make(Simulation &sim, const std::vector<Sphere> &spheres) const
  {
    Scene scene;
    scene.boundary = "p p f";
    scene.newton = newton;
    scene.style = style + "\n" + halves + "fix wall all wall/levelset plane z " + plane + jkr +
        zones + "\ngroup few id 1 3\ncompute dep " + (compute.empty() ? "all" : "") +
        compute.substr(0, compute.find(' ')) + " wall/deposit wall" +
        (compute.find(' ') < compute.size() ? compute.substr(compute.find(' ')) : "") + "\n";
    build(sim, spheres, scene);
    sim.run("run 0");
  }
};

Deposit vector_of(Simulation &sim)
{
  return {sim.value("c_dep[1]"), sim.value("c_dep[2]"), sim.value("c_dep[3]")};
}
Deposit row(Simulation &sim, int n)
{
  const std::string r = "c_dep[" + std::to_string(n) + "]";
  return {sim.value(r + "[1]"), sim.value(r + "[2]"), sim.value(r + "[3]")};
}

void expect_near(const Deposit &a, const Deposit &b)
{
  ASSERT_EQ(a.size(), b.size());
  for (size_t n = 0; n < a.size(); n++) EXPECT_NEAR(a[n], b[n], 1e-9) << n;
}

// A dendrite of four on the floor that leans over, one that hangs from the ceiling, a sphere on the
// floor, a free pair.
const std::vector<Sphere> spheres = {{2.0, 4.0, 0.49},  {2.0, 4.0, 1.45}, {2.0, 4.0, 2.41},
                                     {2.96, 4.0, 2.41}, {6.0, 4.0, 7.51}, {6.0, 4.0, 6.55},
                                     {6.0, 1.0, 0.48},  {4.0, 7.0, 4.0},  {4.0, 7.96, 4.0}};
const std::vector<double> heights = {0.99, 1.95, 2.91, 2.91, 0.99, 1.95, 0.98, 0.0, 0.0};

TEST(RanksDeposit, heights_are_those_of_the_far_sides)
{
  for (const char *newton : {"on", "off"}) {
    Simulation sim;
    Pile pile;
    pile.newton = newton;
    pile.make(sim, spheres);
    expect_near(gather(sim, "c_dep", 1), heights);
    expect_near(row(sim, 1), {5.0, 2.91, 5.0 * volume / 64.0});
    expect_near(row(sim, 2), {2.0, 1.95, 2.0 * volume / 64.0});
    expect_near(row(sim, 3), {7.0, 2.91, 7.0 * volume / 128.0});
    expect_near(vector_of(sim), row(sim, 3));
  }
}

TEST(RanksDeposit, one_zone)
{
  Simulation sim;
  Pile pile;
  pile.zones = "zone a left zone b right";
  pile.compute = "all zone b";
  pile.make(sim, spheres);
  expect_near(gather(sim, "c_dep", 1), {0.0, 0.0, 0.0, 0.0, 0.99, 1.95, 0.98, 0.0, 0.0});
  expect_near(vector_of(sim), {3.0, 1.95, 3.0 * volume / 64.0});    // half of both planes
  expect_near(row(sim, 1), {4.0, 2.91, 4.0 * volume / 64.0});
  expect_near(row(sim, 2), vector_of(sim));
  expect_near(row(sim, 3), {0.0, 0.0, 0.0});
  expect_near(row(sim, 4), {7.0, 2.91, 7.0 * volume / 128.0});
}

// The tip is nearer to the ceiling than to the floor: while it does not touch, it is the tip of
// a dendrite on the floor.
TEST(RanksDeposit, height_is_above_the_surface_that_holds)
{
  const std::vector<Sphere> tower = {{4.0, 4.0, 0.49}, {4.0, 4.0, 1.45}, {4.0, 4.0, 2.41}};
  {
    Simulation sim;
    Pile pile;
    pile.plane = "0 2.95";
    pile.make(sim, tower);
    expect_near(gather(sim, "c_dep", 1), {0.99, 1.95, 2.91});
  }
  Simulation sim;    // bridges the gap: each is as high as above the nearer wall
  Pile pile;
  pile.plane = "0 2.9";
  pile.make(sim, tower);
  expect_near(gather(sim, "c_dep", 1), {0.99, 1.95, 0.99});
  expect_near(row(sim, 1), {3.0, 2.91, 3.0 * volume / 64.0});
  expect_near(row(sim, 2), {3.0, 2.9 - 0.49 + 0.5, 3.0 * volume / 64.0});
  expect_near(row(sim, 3), {3.0, 1.95, 3.0 * volume / 128.0});
}

TEST(RanksDeposit, counts_its_group)
{
  Simulation sim;
  Pile pile;
  pile.compute = "few";
  pile.make(sim, spheres);    // 2, which connects 1 and 3, is not in the group
  expect_near(gather(sim, "c_dep", 1), {0.99, 0.0, 2.91, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0});
  expect_near(vector_of(sim), {2.0, 2.91, 2.0 * volume / 128.0});
}

// A sphere that hangs on a liquid bridge, and one that a bridge joins to it, stick without contact.
TEST(RanksDeposit, what_a_bridge_holds_counts)
{
  Simulation sim;
  Scene scene;
  scene.boundary = "p p f";
  const std::string law = " jkr 1e7 0.25 0 bridge 0.01 1 0 0";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law +
      "\nfix wall all wall/levelset plane z 0 8" + law + "\ncompute dep all wall/deposit wall\n";
  build(sim, {{2.0, 4.0, 0.4999}, {2.0, 4.0, 1.4998}, {5.0, 4.0, 0.55}}, scene);
  sim.run("timestep 1e-13\nrun 0\nset atom 1 z 0.55\nset atom 2 z 1.6\nrun 0 post no");
  expect_near(gather(sim, "c_dep", 1), {1.05, 2.1, 0.0});
  expect_near(row(sim, 1), {2.0, 2.1, 2.0 * volume / 64.0});
  EXPECT_EQ(sim.value("f_wall[10]"), 1.0);
  EXPECT_EQ(sim.value("f_wall[1][7]"), 0.0) << "no contact";
  EXPECT_EQ(sim.value("f_wall[1][8]"), 0.0);
  EXPECT_EQ(sim.value("f_wall[1][9]"), 2.0) << "deposited";
}

TEST(Deposit, only_what_touches_with_another_pair_style)
{
  Simulation sim;
  Pile pile;
  pile.style = "pair_style zero 2\npair_coeff * *";
  pile.make(sim, spheres);
  expect_near(gather(sim, "c_dep", 1), {0.99, 0.0, 0.0, 0.0, 0.99, 0.0, 0.98, 0.0, 0.0});
}

TEST(RanksDeposit, is_measured_again_as_particles_come_and_go)
{
  Simulation sim;
  Pile pile;
  pile.make(sim, spheres);
  sim.run("group tip id 4\nfix mv tip move linear 64 0 0 units box\nrun 32");
  expect_near({row(sim, 1)[0]}, {4.0});
  expect_near({gather(sim, "c_dep", 1)[3]}, {0.0});
}

// A tower on a gridded floor whose band ends at 2: above it heights are not known, and a warning
// says so.
TEST(RanksDeposit, heights_beyond_the_band_of_a_grid)
{
  for (const double band : {2.0, 8.0}) {
    TemporaryFile file("apf_wall_deposit");
    file.write({21, 21, 21}, {0, 0, 0}, {0.4, 0.4, 0.4}, [band](VtkhdfWriter &w) {
      w.field("distance", 1, [band](const double *x, double, double *phi) {
        *phi = std::min(x[2], band);
      });
    });
    Scene scene;
    scene.boundary = "f f f";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr +
        "\nfix wall all wall/levelset file " + file.path + jkr +
        "\ncompute dep all wall/deposit wall\n";
    Simulation sim;
    build(sim, {{4.0, 4.0, 0.49}, {4.0, 4.0, 1.45}, {4.0, 4.0, 2.41}, {4.0, 4.0, 3.37}}, scene);
    sim.run("run 0");
    const int before = sim.lammps()->error->get_numwarn();
    const double most = vector_of(sim)[1];
    const int warnings = sim.lammps()->error->get_numwarn() - before;
    if (band < 4.0) {
      EXPECT_NEAR(most, band + 0.5, 1e-9);
      EXPECT_EQ(warnings, TemporaryFile::rank() == 0 ? 1 : 0);
      EXPECT_NEAR(vector_of(sim)[1], band + 0.5, 1e-9);
      EXPECT_LE(sim.lammps()->error->get_numwarn() - before, 1);    // once
    } else {
      EXPECT_NEAR(most, 3.87, 1e-9);
      EXPECT_EQ(warnings, 0);
    }
  }
}

}    // namespace
