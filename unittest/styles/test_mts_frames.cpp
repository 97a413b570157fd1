// Impacts are the same for who moves along: what fix nve/sphere/mts foresees in a scene whose wall
// moves, or whose images do in a sheared box, is what it foresees where these are at rest. C3.

#include "scenes.h"

namespace {

const std::string hertz = " jkr 2.0e6 0.25 0.0 ";    // an impact takes 0.01 of a particle step
const double step = 0.1;                             // [d/U]: particles see walls arrive in time

struct Outcome {
  std::vector<double> v;
  double late;
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
Outcome across_boundary(double timestep, bool image, int runs = 1)
{
  const double offset = 8.0;    // of velocities: length of the box times rate
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + hertz + "\n";
  Simulation sim;
  build(sim, {{4.0, image ? 0.4 : 4.4, 4.0}, {4.62, image ? 7.6 : 3.6, 4.0}}, scene);
  set_motion(sim, 1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {image ? 0.0 : -offset, 0.0, 0.0}, {0.0, 0.0, 0.0});
  if (image)
    sim.run("change_box all triclinic\nfix flow all deform 1 xy erate " + digits(offset / 8.0) +
            " remap v\n");
  sim.run("neighbor 0.8 bin\nfix nve all nve/sphere/mts collision auto safety 0.05\ntimestep " +
          digits(timestep));
  for (int k = 0; k < runs; k++)
    sim.run("run " + std::to_string(std::lround(0.06 / timestep / runs)));
  auto v = gather(sim, "v");
  if (image) v[3] -= offset;
  return {v, sim.value("f_nve[5]")};
}

TEST(MtsFrames, images_of_a_sheared_box_are_seen)
{
  for (const double timestep : {0.01, 0.02, 0.03, 0.06}) {
    SCOPED_TRACE(timestep);
    const auto found = across_boundary(timestep, true), other = across_boundary(timestep, false);
    EXPECT_EQ(found.late, 0.0);
    EXPECT_EQ(other.late, 0.0);
    EXPECT_GT(std::fabs(found.v[1]), 0.5) << "they have met";
    for (int c = 0; c < 6; c++) EXPECT_NEAR(found.v[c], other.v[c], 1e-6) << c;
  }
}

// A run that begins anew sees images where the last one left them, amid the impact, too.
TEST(MtsFrames, images_do_not_jump_between_runs)
{
  for (const double timestep : {0.001, 0.003, 0.01}) {
    SCOPED_TRACE(timestep);
    const auto one = across_boundary(timestep, true), many = across_boundary(timestep, true, 6);
    EXPECT_GT(std::fabs(one.v[1]), 0.5) << "they have met";
    for (int c = 0; c < 6; c++) EXPECT_NEAR(many.v[c], one.v[c], 1e-9) << c;
  }
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
