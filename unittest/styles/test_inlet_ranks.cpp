// fix inlet/flow: the same particles enter on any number of ranks and over a restart.

#include "inlet_scene.h"

namespace {
const std::string shared_scene = box("p p", "") + "fix air all flow/field channel x y 0 10 3" +
    unit_fluid +
    "fix in all inlet/flow x 0 air concentration 0.05 diameter lognormal 0.3 1.3 0.1 0.8 density 2 "
    "type 1 seed 99 outlet x 17\nfix drag all flow/force air drag stokes torque yes\n";
}

TEST(Inlet, goes_on_from_a_restart_as_if_nothing_had_been)
{
  const std::string file = scratch_file("restart");
  std::vector<double> x, radius;
  double counts[10];
  {
    Simulation sim;
    sim.run(shared_scene + "run 300\nwrite_restart " + file + "\nrun 400\n");
    x = inside(sim).x;
    radius = inside(sim).radius;
    for (int n = 0; n < 10; n++) counts[n] = sim.value("f_in[" + std::to_string(n + 1) + "]");
  }
  Simulation sim;
  std::string again = shared_scene.substr(shared_scene.find("neighbor 0.3"));
  sim.run("read_restart " + file + "\ncomm_modify vel yes\n" + again + "run 400\n");
  std::filesystem::remove(file);
  ASSERT_GT(x.size(), 300u);
  EXPECT_EQ(inside(sim).radius, radius);
  EXPECT_LT(difference(inside(sim).x, x), 1e-12);
  for (int n = 0; n < 10; n++)
    EXPECT_NEAR(sim.value("f_in[" + std::to_string(n + 1) + "]"), counts[n],
                1e-12 * std::fabs(counts[n]))
        << n;
  EXPECT_GT(counts[8], 0.0);
}

TEST(RanksInlet, the_same_particles_enter_on_any_number_of_ranks)
{
  const std::string scene = shared_scene + "fix even all balance 50 1.0 shift xy 5 1.0\nrun 650\n";
  Inside alone;
  double counts[10];
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(scene);
    for (int n = 0; n < 10; n++) counts[n] = sim.value("f_in[" + std::to_string(n + 1) + "]");
    alone = inside(sim);
  }
  Simulation sim;
  sim.run(scene);
  const auto all = inside(sim);
  ASSERT_GT(all.tag.size(), 800u);
  EXPECT_EQ(all.tag, alone.tag);
  EXPECT_EQ(all.radius, alone.radius);
  EXPECT_LT(difference(all.x, alone.x), 1e-12);
  EXPECT_LT(difference(all.omega, alone.omega), 1e-12);
  for (int n = 0; n < 10; n++)
    EXPECT_EQ(sim.value("f_in[" + std::to_string(n + 1) + "]"), counts[n]) << n;
  EXPECT_GT(counts[8], 0.0) << "some have left";
}

// The same where the box shrinks onto the particles, tiles are balanced, and a run is resumed
TEST(RanksInlet, shrink_wrapped_box_tiles_and_restart)
{
  const std::string scene = "comm_style tiled\ncomm_modify vel yes\n"
                            "fix air all flow/field uniform -1 0 0" +
      unit_fluid +
      "fix in all inlet/flow -x 15 air concentration 0.08 diameter uniform 0.4 0.8 density 2 "
      "type 1 seed 5 outlet -x 12 window 3 9 3 9\nfix even all balance 50 1.0 rcb\n";
  std::string shrinks = box();
  shrinks.replace(shrinks.find("boundary f"), 10, "boundary s");
  const std::string ends = "create_atoms 1 single 20 1 1\ncreate_atoms 1 single 14 1 1\n"
                           "set group all diameter 0.5 density 2\n";
  Inside alone;
  std::vector<double> counts;
  auto count = [](Simulation &sim) {
    std::vector<double> all;
    for (int n = 1; n <= 10; n++) all.push_back(sim.value("f_in[" + std::to_string(n) + "]"));
    return all;
  };
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(shrinks + scene + ends + "run 233\nrun 267\n");
    alone = inside(sim);
    counts = count(sim);
  }
  const std::string file = scratch_file("restart");
  {
    Simulation sim;
    sim.run(shrinks + scene + ends + "run 233\nwrite_restart " + file);
  }
  Simulation sim;
  sim.run("read_restart " + file + "\n" + box().substr(box().find("neighbor 0.3")) + scene +
          "run 267\n");
  MPI_Barrier(MPI_COMM_WORLD);
  std::filesystem::remove(file);
  const auto all = inside(sim);
  ASSERT_GT(all.tag.size(), 60u);
  EXPECT_EQ(all.tag, alone.tag);
  EXPECT_EQ(all.radius, alone.radius);
  EXPECT_LT(difference(all.x, alone.x), 1e-12);
  const auto again = count(sim);
  for (int n = 0; n < 10; n++) EXPECT_NEAR(again[n], counts[n], 1e-12 * counts[n]) << n;
  EXPECT_GT(counts[8], 30.0);
}

TEST(RanksInlet, dense_inlet_has_no_overlap_across_ranks)
{
  Simulation sim;
  sim.run(box() + uniform + "fix in all inlet/flow x 0 air concentration 0.12" + particle +
          "outlet x 15\nrun 900\n");
  EXPECT_GE(smallest_gap(sim, periodic_yz), -1e-12);
  EXPECT_GT(sim.value("f_in[2]"), 50.0);
  EXPECT_EQ(sim.value("f_in[1]"), sim.value("f_in[9]") + sim.value("atoms"));
}
