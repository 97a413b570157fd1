// Impacts are the same for who moves along: what fix nve/sphere/mts foresees in a scene whose wall
// moves, or whose images do in a sheared box, is what it foresees where these are at rest. C3.

#include "scenes.h"

namespace {

const std::string hertz = " jkr 2.0e6 0.25 0.0 ";    // an impact takes 0.01 of a particle step
const double step = 0.1;                             // [d/U]: particles see walls arrive in time

struct Outcome {
  std::vector<double> v;
  double late = 0.0;
  double cut = 0.0;    // runs that ended with forces
};

// Two spheres, 0.02 apart and from a wall at x = 0, which the wall strikes at unit speed: seen from
// the box, or from the wall. Spheres then have what these numbers say, less the frame's.
Outcome struck_by_wall(bool wall_moves, int steps)
{
  Scene scene;
  scene.boundary = "f p p";
  scene.box = "-1 12 0 8 0 8";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + hertz +
      "\nfix wall all wall/levelset plane x 0 NULL" + hertz +
      (wall_moves ? "move linear 1 0 0\n" : "\n");
  Simulation sim;
  build(sim, {{0.52, 4.0, 4.0}, {1.54, 4.0, 4.0}}, scene);
  const double frame = wall_moves ? 0.0 : -1.0;
  for (const int id : {1, 2}) set_motion(sim, id, {frame, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("neighbor 0.6 bin\nfix nve all nve/sphere/mts collision auto safety 0.05\ntimestep " +
          digits(step) + "\nrun " + std::to_string(steps));
  const auto v = gather(sim, "v");
  return {{v[0] - frame, v[3] - frame}, sim.value("f_nve[5]")};
}

// Each impact hands on twice the wall's speed, as Newton's cradle does: the first sphere stops, is
// struck again, and has as much.
TEST(MtsFrames, piston_drives_two_spheres)
{
  const auto one = struck_by_wall(true, 1);
  EXPECT_NEAR(one.v[1], 2.0, 0.01);
  const auto found = struck_by_wall(true, 3);
  EXPECT_NEAR(found.v[0], 2.0, 0.01);
  EXPECT_NEAR(found.v[1], 2.0, 0.01);
  EXPECT_EQ(found.late, 0.0);
  const auto other = struck_by_wall(false, 3);
  EXPECT_EQ(other.late, 0.0);
  for (const int k : {0, 1}) EXPECT_NEAR(found.v[k], other.v[k], 1e-9);
}

// The same by a wall that turns: at its middle a door of radius 6 is as fast.
TEST(MtsFrames, door_drives_two_spheres)
{
  Scene scene;
  scene.boundary = "f f p";
  scene.box = "-2 12 -7 8 0 8";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + hertz +
      "\nfix wall all wall/levelset plane x 0 NULL" + hertz + "move rotate 0 -6 0 0 0 " +
      digits(-1.0 / 6.0) + "\n";
  Simulation sim;
  build(sim, {{0.52, 0.0, 4.0}, {1.54, 0.0, 4.0}}, scene);
  sim.run("neighbor 0.6 bin\nfix nve all nve/sphere/mts collision auto safety 0.05\ntimestep " +
          digits(step) + "\nrun 1");
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  EXPECT_NEAR(gather(sim, "v")[3], 2.0, 0.03);    // the door turns by a degree meanwhile
}

// Two spheres at rest on either side of a boundary at which the box is sheared: one meets the
// other's image at the relative speed of the two sides. Or the same pair amid a box at rest.
struct Shear {
  std::string name = "xy";    // of the tilt: of y's vector along x
  double tilt = 0.0;          // at first
  int every = 1;              // N of fix deform
  std::string law = hertz;
  bool image = true;
  int runs = 1;
};

Outcome across_boundary(double timestep, const Shear &how)
{
  const double offset = 8.0;    // of velocities: length of the box times rate
  const int along = how.name[0] - 'x', across = how.name[1] - 'x';
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + how.law + "\n";
  std::vector<double> one(3, 4.0), two(3, 4.0), rest(3, 0.0), moving(3, 0.0);
  const double at = 4.62 + (how.image ? how.tilt : 0.0);
  two[along] = at - 8.0 * std::floor(at / 8.0);
  one[across] = how.image ? 0.4 : 4.4;
  two[across] = how.image ? 7.6 : 3.6;
  moving[along] = how.image ? 0.0 : -offset;
  Simulation sim;
  build(sim, {{one[0], one[1], one[2]}, {two[0], two[1], two[2]}}, scene);
  set_motion(sim, 1, rest, rest);
  set_motion(sim, 2, moving, rest);
  if (how.image)
    sim.run("change_box all triclinic\nchange_box all " + how.name + " final " + digits(how.tilt) +
            "\nfix flow all deform " + std::to_string(how.every) + " " + how.name + " erate " +
            digits(offset / 8.0) + " remap v\n");
  sim.run("neighbor 0.8 bin\nfix nve all nve/sphere/mts collision auto safety 0.05\ntimestep " +
          digits(timestep));
  Outcome found;
  const int steps = static_cast<int>(std::lround(0.06 / timestep));
  for (int k = 0; k < how.runs; k++) {
    sim.run("run " + std::to_string(steps / how.runs));
    found.late += sim.value("f_nve[5]");
    const auto f = gather(sim, "f");
    if (k < how.runs - 1) found.cut += std::fabs(f[along]) + std::fabs(f[across]) > 0.0;
  }
  auto v = gather(sim, "v");
  if (how.image) v[3 + along] -= offset;
  found.v = {v[along], v[across], v[3 + along], v[3 + across]};
  return found;
}

// LAMMPS moves the box after the forces of a step, or with N = 0 before them. A tilt of 3.97 of a
// box of 8 becomes one of -4 within the run.
const Shear shears[] = {{"xy"},         {"xz"},       {"yz"},         {"xy", 0.0, 0},
                        {"xy", 0.0, 2}, {"xy", 3.97}, {"xz", 3.97, 0}};

TEST(RanksMtsFrames, images_of_a_sheared_box_are_seen)
{
  for (auto how : shears)
    for (const double timestep : {0.01, 0.02, 0.03, 0.06}) {
      SCOPED_TRACE(how.name + " " + digits(how.tilt) + " N " + std::to_string(how.every) +
                   " timestep " + digits(timestep));
      const auto found = across_boundary(timestep, how);
      how.image = false;
      const auto other = across_boundary(timestep, how);
      how.image = true;
      EXPECT_EQ(found.late, 0.0);
      EXPECT_EQ(other.late, 0.0);
      EXPECT_GT(std::fabs(found.v[1]), 0.5) << "they have met";
      for (int c = 0; c < 4; c++) EXPECT_NEAR(found.v[c], other.v[c], 1e-6) << c;
    }
}

// A run that begins anew sees images where the last one left them, amid the impact of two soft
// spheres, too. (With N = 2 the box of LAMMPS itself loses steps in runs of odd length.)
TEST(RanksMtsFrames, images_do_not_jump_between_runs)
{
  for (auto how : shears)
    if (how.every < 2)
      for (const double timestep : {0.003, 0.01}) {
        SCOPED_TRACE(how.name + " " + digits(how.tilt) + " N " + std::to_string(how.every) +
                     " timestep " + digits(timestep));
        how.law = " jkr 2.0e3 0.25 0.0 ";
        how.runs = 1;
        const auto one = across_boundary(timestep, how);
        how.runs = static_cast<int>(std::lround(0.06 / timestep));
        const auto many = across_boundary(timestep, how);
        EXPECT_GT(std::fabs(one.v[1]), 0.5) << "they have met";
        EXPECT_GT(many.cut, 1.0) << "amid the impact";
        for (int c = 0; c < 4; c++) EXPECT_NEAR(many.v[c], one.v[c], 1e-9) << c;
      }
}

// A doublet at rest, oblique to the sheared boundary, goes through it: a sphere that is wrapped, or
// its image, does not jump.
TEST(RanksMtsFrames, doublet_goes_through_a_sheared_boundary)
{
  const Material material;
  const double distance = 1.0 - material.pair().delta_eq();
  for (const int every : {0, 1, 2, 5})
    for (const double direction : {2.0, -2.0}) {
      SCOPED_TRACE("N " + std::to_string(every) + ", " + digits(direction));
      Scene scene;
      scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
      Simulation sim;
      const double first = direction > 0.0 ? 7.2 : 0.3, arm = distance * std::sqrt(0.5);
      build(sim, {{3.0, first, 4.0}, {3.0 + arm, first + arm, 4.0}}, scene);
      for (const int id : {1, 2}) set_motion(sim, id, {0.3, direction, 0.0}, {0.0, 0.0, 0.0});
      sim.run("change_box all triclinic\nfix flow all deform " + std::to_string(every) +
              " xy erate 1.0 remap v\nneighbor 0.8 bin\n"
              "fix nve all nve/sphere/mts collision 4\ntimestep 1e-3\nthermo_style custom step pe\n"
              "thermo_modify norm no\nrun 0");
      const double energy = sim.value("pe");
      double most = 0.0;
      for (int k = 0; k < 32; k++) {
        sim.run("run 20");
        most = std::max(most, std::fabs(sim.value("pe") - energy));
        EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
      }
      EXPECT_LT(most, 1e-9 * std::fabs(energy));
      const auto y = gather(sim, "x");
      EXPECT_TRUE(direction > 0.0 ? y[4] < 2.0 : y[1] > 6.0) << "both have gone through";
    }
}

// fix deform's own remap x moves particles along with the box, at the end of a step: a doublet
// across a face of a box that is compressed is pressed as one amid it is.
TEST(RanksMtsFrames, images_of_a_box_that_takes_particles_along)
{
  std::vector<double> forces[2];
  for (const bool image : {true, false}) {
    Scene scene;
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + hertz + "\n";
    Simulation sim;
    build(sim, {{image ? 0.5 : 4.5, 4.0, 4.0}, {image ? 7.501 : 3.501, 4.0, 4.0}}, scene);
    for (const int id : {1, 2}) set_motion(sim, id, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("neighbor 0.8 bin\nfix flow all deform 1 x erate -0.1 remap x\n"
            "fix nve all nve/sphere/mts collision 4\ntimestep 1e-4\nrun 0");
    for (int k = 0; k < 30; k++) {
      forces[image].push_back(gather(sim, "f")[0]);
      sim.run("run 1");
    }
  }
  double most = 0.0;
  for (const double f : forces[0]) most = std::max(most, std::fabs(f));
  EXPECT_GT(most, 1.0);
  for (size_t k = 0; k < forces[0].size(); k++)
    EXPECT_NEAR(forces[1][k], forces[0][k], 1e-7 * most) << k;
}

// A particle that another command puts into a second one is not foreseen, and counts as late, also
// in a step with nothing else in contact.
TEST(MtsFrames, contact_that_nobody_foresaw_counts_as_late)
{
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + hertz + "\n";
  Simulation sim;
  build(sim, {{2.0, 4.0, 4.0}, {4.0, 4.0, 4.0}}, scene);
  sim.run("group one id 1\nfix nve all nve/sphere/mts collision auto\ntimestep 0.001\n"
          "neighbor 2 bin\nrun 2");
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  sim.run("fix put one recenter 3.001 INIT INIT shift one units box\nrun 2");
  EXPECT_EQ(sim.value("f_nve[5]"), 1.0);
}

}    // namespace
