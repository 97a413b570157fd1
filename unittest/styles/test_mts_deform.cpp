// fix nve/sphere/mts in a box that is sheared by fix deform: images move with their velocity
// between two particle steps, at the end of which LAMMPS moves the box.

#include "scenes.h"

namespace {

const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const Material material;

void build_sheared(Simulation &sim, const std::vector<Sphere> &spheres)
{
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
  build(sim, spheres, scene);
  sim.run("change_box all triclinic\nneighbor 0.8 bin\n");
}
const std::string shear = "fix flow all deform 1 xy erate 1.0 remap v\n";

// Two spheres that touch across the sheared boundary, at rest: their relative speed, less that of
// the box.
double shaking(const std::string &integrate, int every, const std::string &run)
{
  Simulation sim;
  const double half = 0.5 - 0.5 * material.pair().delta_eq();
  build_sheared(sim,
                {{4.0 + 0.6 * half, 0.8 * half, 4.0}, {4.0 - 0.6 * half, 8.0 - 0.8 * half, 4.0}});
  set_motion(sim, 1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {8.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run(shear + integrate +
          "variable w equal abs(vx[2]-vx[1]-8*round((vx[2]-vx[1])/8))\n"
          "fix log all vector " +
          std::to_string(every) + " v_w\n" + run);
  double most = 0.0;
  for (int n = 300; n < 400; n++)
    most = std::max(most, sim.value("f_log[" + std::to_string(n) + "]"));
  return most;
}

TEST(RanksMtsDeform, doublet_across_the_boundary_does_not_shake)
{
  const double verlet = shaking("fix nve all nve/sphere\n", 4, "run 1600");
  const double levels = shaking(mts(4), 1, "run 400");
  EXPECT_GT(levels, 0.0);
  EXPECT_LT(verlet, 1e-4);
  EXPECT_LT(levels, 2.5e-4);
}

TEST(RanksMtsDeform, gas_has_no_late_contact)
{
  std::vector<Sphere> spheres;
  for (int n = 0; n < 125; n++)
    spheres.push_back({1.6 * (n % 5) + 0.5, 1.6 * (n / 5 % 5) + 0.5, 1.6 * (n / 25) + 0.5});
  Simulation sim;
  build_sheared(sim, spheres);
  sim.run("velocity all create 9.0 4711 loop geom\n" + shear + mts(32) + "run 100");
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  EXPECT_GT(sim.value("f_nve[3]"), 5.0);
  EXPECT_EQ(lammps_get_natoms(sim.lammps()), 125.0);
}

// Pairs that touch across borders that move, and slowly cross these: none is lost, however near to
// the border its particles are.
TEST(RanksMtsDeform, contacts_across_a_moving_border_are_kept)
{
  Scene scene;
  scene.box = "0 8 0 16 0 16";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
  const double distance = 1.0 - material.pair().delta_eq(), crossing = 8.0;
  const double up = 0.1 * distance, across = std::sqrt(0.96) * distance;
  std::vector<Sphere> spheres;
  for (int n = 0; n < 49; n++) {
    const double y = 1.0 + 2.2 * (n % 7), z = 1.0 + 2.2 * (n / 7), side = n % 2 ? up : -up;
    const double left = (0.01 + 0.98 * n / 49.0) * across;
    spheres.push_back({left, y, z + side});
    spheres.push_back({8.0 + left - across, y, z - side});
  }
  auto own = [&](int n) {    // relative to the border
    return (n - 1) / 4 % 2 ? crossing : -crossing;
  };
  for (const std::string box : {"ortho", "triclinic"})
    for (const double border : {40.0, -40.0}) {
      SCOPED_TRACE(box + digits(border));
      Simulation sim;
      build(sim, spheres, scene);
      for (int n = 1; n <= 98; n++)
        set_motion(sim, n, {own(n) + (n % 2 ? border : -border), 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("change_box all " + box + "\nneighbor 2.0 bin\nfix flow all deform 1 x vel " +
              digits(-2.0 * border) + " remap v\n" + mts(4) +
              "fix mean all ave/time 1 80 80 f_nve[3]\nrun 80");
      EXPECT_EQ(sim.value("f_mean"), 49.0);
      EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
      EXPECT_NEAR(sim.value("lx"), 8.0 - 2.0 * border * 80 * 4 * dt, 1e-9);
      for (int n = 1; n <= 98; n++) {
        const double v = sim.value("vx[" + std::to_string(n) + "]");
        EXPECT_NEAR(std::fabs(v - own(n)), std::fabs(border), 1e-2 * crossing) << n;
      }
    }
}

// Two spheres at rest relative to the borders, which touch across one: nothing moves them there.
double speed_across(const std::string &how, const std::string &integrate)
{
  Simulation sim;
  const double half = 0.5 - 0.5 * material.pair().delta_eq();
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
  build(sim, {{4.0, half, 4.0}, {4.0, 8.0 - half, 4.0}}, scene);
  set_motion(sim, 1, {0.0, 0.04, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {0.0, -0.04, 0.0}, {0.0, 0.0, 0.0});
  sim.run("fix flow all deform 1 " + how + "\n" + integrate + "run 100");
  return std::max(std::fabs(sim.value("vy[1]") - 0.04), std::fabs(sim.value("vy[2]") + 0.04));
}

TEST(RanksMtsDeform, velocities_of_borders_are_right_or_refused)
{
  for (const std::string &integrate : {std::string("fix nve all nve/sphere\n"), mts(4)}) {
    for (const char *how :
         {"y erate -0.01 remap v", "y vel -0.08 remap v", "y trate -0.01 remap v"})
      EXPECT_LT(speed_across(how, integrate), 1e-3) << how;
    for (const std::string how : {"x erate 0.01 y volume", "x erate 0.01 y volume z volume"}) {
      Simulation sim;
      build(sim, {{4.0, 4.0, 4.0}});
      sim.run(integrate + "fix flow all deform 1 " + how + " remap v");
      const std::string said = sim.error_of("run 1");
      EXPECT_NE(
          said.find(
              "fix flow deform with remap v gives images across the border in y a wrong velocity"),
          said.npos)
          << said;
      EXPECT_NE(said.find("use remap x, or a style with a rate, such as erate"), said.npos) << said;
      sim.run("unfix flow\nfix flow all deform 1 " + how + " remap x\nrun 1");
    }
  }
}

// across a fixed border there are no images
TEST(MtsDeform, volume_kept_along_a_fixed_border_is_taken)
{
  Scene scene;
  scene.boundary = "p p f";
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  sim.run("fix nve all nve/sphere\nfix flow all deform 1 x erate 0.01 z volume remap v");
  EXPECT_EQ(sim.error_of("run 1"), "");
}

TEST(MtsDeform, box_changes_that_look_ahead_does_not_see_are_warned_of)
{
  const std::string warning = "which look-ahead does not see";
  for (const std::string how : {"deform 1 x vel 0.01 remap x", "deform 1 x vel 0.01 remap none",
                                "press/berendsen iso 1.0 1.0 1.0", "deform 1 x vel 0.01 remap v",
                                "balance 10 1.0 shift x 5 1.1"}) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {2.0, 2.0, 2.0}});
    sim.run(mts(4) + "fix change all " + how);
    const std::string said = log_of(sim, "run 1\n");
    const bool seen = how.find("remap v") != how.npos || how.find("balance") == 0;
    EXPECT_EQ(said.find(warning) == said.npos, seen) << how << said;
    if (!seen) {
      EXPECT_NE(said.find("fix change " + how.substr(0, how.find(' '))), said.npos) << said;
    }
  }
}

}    // namespace
