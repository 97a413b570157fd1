// Contacts at the inner level of run_style respa: they act, remember and restart with that level's
// step, and the trajectory tends to velocity Verlet's as the outer step shrinks.

#include "scenes.h"

namespace {

const Material material;
const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const std::string wall = "fix wall all wall/levelset plane z 0 NULL" + law + "\n";

std::string step(double size)
{
  char text[40];
  snprintf(text, sizeof(text), "timestep %.17g\n", size);
  return text;
}

std::string respa(int n, const std::string &level = "pair 1")
{
  return "run_style respa 2 " + std::to_string(n) + " " + level + "\n" + step(n * dt);
}

Scene scene_with(const std::string &style)
{
  Scene scene;
  scene.boundary = "p p f";
  scene.style = style;
  return scene;
}
const std::string pair = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";

// ---------------------------------------------------------------------------------------------
// springs of pair and wall have the length velocity x time, not outer step x number of calls

void expect_lengths(Simulation &sim, int runs)
{
  set_motion(sim, 1, {0.0, 0.02, 0.0}, {0.0, 0.0, 0.0});
  sim.run("run " + std::to_string(runs));
  set_motion(sim, 1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("run 1");
  const double t = 80 * dt;
  const double kt = 8.0 * material.G_eff();
  const double at_pair = kt * material.pair().a(0.01) * 0.02 * t;
  const double at_wall = kt * material.wall().a(0.02) * 0.02 * t;
  const auto f = gather(sim, "f"), torque = gather(sim, "torque");
  EXPECT_NEAR(f[4] / at_pair, 1.0, 1e-9);
  EXPECT_NEAR(f[1] / -(at_pair + at_wall), 1.0, 1e-9);
  EXPECT_NEAR(f[0] / -material.pair().force(0.01), 1.0, 1e-9) << "counted once";
  EXPECT_NEAR(f[2] / material.wall().force(0.02), 1.0, 1e-9) << "counted once";
  // torques of the spring: arm x force, along -x from the wall and along z from the pair
  EXPECT_NEAR(torque[0] / (0.48 * -at_wall), 1.0, 1e-9);
  EXPECT_NEAR(torque[5] / (0.495 * -at_pair), 1.0, 1e-9);
}

TEST(RanksRespa, springs_grow_with_the_inner_step)
{
  const std::string sticky = jkr + "sliding 0.3 ";
  const std::string style = "pair_style granular/adhesive\npair_coeff * *" + sticky +
      "\nfix wall all wall/levelset plane z 0 NULL" + sticky + "\n";
  for (const auto &[commands, runs] : std::vector<std::pair<std::string, int>>{
           {"", 80},
           {respa(10), 8},
           {respa(10) + "fix_modify wall respa 1\n", 8},
           {"run_style respa 3 2 5 pair 1\n" + step(10 * dt), 8}}) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 0.48}, {3.99, 4.0, 0.48 + 1e-300}}, scene_with(style));
    // the second sphere must not touch the wall
    sim.run("group first id 1\nunfix wall\nfix wall first wall/levelset plane z 0 NULL" + sticky);
    SCOPED_TRACE(commands);
    sim.run(commands);
    expect_lengths(sim, runs);
  }
}

// ---------------------------------------------------------------------------------------------
// trajectories: three spheres slip, roll and fall on a wall, gravity at the outer level

void build_pile(Simulation &sim)
{
  build(sim, {{3.5, 4.0, 0.49}, {4.48, 4.0, 0.485}, {4.0, 4.2, 1.315}}, scene_with(pair));
  set_motion(sim, 1, {1.0, 0.5, 0.0}, {3.0, 1.0, 2.0});
  set_motion(sim, 2, {0.5, 1.0, 0.0}, {-2.0, 4.0, 1.0});
  set_motion(sim, 3, {2.0, 0.0, -1.0}, {0.0, -3.0, -2.0});
}
const std::string dynamics =
    "fix nve all nve/sphere\nfix g all gravity 500 vector 1 0.5 -1\n" + wall;

State after(const std::string &style, int runs)
{
  Simulation sim;
  build_pile(sim);
  sim.run(dynamics + style + "run " + std::to_string(runs));
  return state_of(sim);
}

double distance(const State &a, const State &b)
{
  double most = 0.0;
  for (size_t n = 0; n < a.x.size(); n++) most = std::max(most, std::fabs(a.x[n] - b.x[n]));
  return most;
}

// damping and friction see velocities without the outer kick to come: first order in the inner step
TEST(RanksRespa, tends_to_verlet_as_steps_shrink)
{
  auto error = [](int refine) {
    const std::string fine = step(dt / refine), outer = step(4 * dt / refine);
    const State verlet = after(fine, 320 * refine);
    const State levels = after("run_style respa 2 4 pair 1\n" + outer, 80 * refine);
    return distance(levels, verlet) / distance(verlet, after("", 0));
  };
  const double coarse = error(1), fine = error(4);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_NEAR(coarse / fine, 4.0, 2.0);
}

// An undamped doublet whose first sphere hangs on an outer spring: second order in the outer step.
TEST(RanksRespa, error_is_of_second_order_in_the_outer_step)
{
  auto after_swing = [](const std::string &commands, int runs) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {3.98, 4.0, 4.0}},
          scene_with("pair_style granular/adhesive\npair_coeff * *" + jkr));
    set_motion(sim, 1, {0.2, 0.5, 0.0}, {0.0, 0.0, 0.0});
    sim.run("group first id 1\nfix nve all nve/sphere\nfix hang first spring/self 5000\n" +
            commands + "run " + std::to_string(runs));
    return state_of(sim);
  };
  const State verlet = after_swing("", 960);
  const double error2 = distance(after_swing(respa(2), 480), verlet);
  const double error8 = distance(after_swing(respa(8), 120), verlet);
  EXPECT_NEAR(error8 / error2, 63.0 / 3.0, 6.0);    // (8^2 - 1) / (2^2 - 1)
}

// A sphere that static friction and the rolling spring hold on a wall against an outer force stays.
TEST(RanksRespa, sphere_on_a_wall_does_not_creep)
{
  auto place = [](const std::string &commands, int first, int second) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 0.4911}},
          scene_with(pair + "fix wall all wall/levelset plane z 0 NULL" + jkr +
                     "damping tsuji 0.1 sliding 0.5 rolling 0.01 0.5\n"));
    sim.run("fix nve all nve/sphere\nfix push all addforce 4.5 0 0\n" + commands + "run " +
            std::to_string(first));
    const double early = gather(sim, "x")[0];
    sim.run("run " + std::to_string(second));
    return gather(sim, "x")[0] - early;
  };
  const double verlet = place("", 16000, 16000), levels = place(respa(8), 2000, 2000);
  EXPECT_LT(std::fabs(verlet), 1e-7);
  EXPECT_LT(std::fabs(levels), 1e-7);
}

TEST(RanksRespa, all_forces_at_the_inner_level_is_verlet)
{
  const State verlet = after("", 400);
  const std::string inner = respa(4) + "fix_modify g respa 1\n";
  EXPECT_LT(distance(after(inner, 100), verlet), 1e-12);
}

// ---------------------------------------------------------------------------------------------
// runs that stop and go on

TEST(RanksRespa, two_runs_are_one)
{
  const State reference = after(respa(8), 100);
  Simulation sim;
  build_pile(sim);
  sim.run(dynamics + respa(8) + "run 40\nrun 60");
  expect_same(state_of(sim), reference, 1e-11);
}

TEST(RanksRespa, restart_goes_on)
{
  const std::string file = scratch_file("restart");
  const State reference = after(respa(8), 100);
  for (const std::string &way :
       {"run 40\nwrite_restart " + file, "restart 40 " + file + "\nrun 100"}) {
    {
      Simulation first;
      build_pile(first);
      first.run(dynamics + respa(8) + way);
    }
    const std::string from = way[1] == 'e' ? file + ".40" : file;
    Simulation second;
    second.run("read_restart " + from + "\n" + dynamics + respa(8) + "run 60");
    SCOPED_TRACE(way);
    expect_same(state_of(second), reference, 1e-11);
  }
  for (const char *number : {"", ".40", ".80"}) std::remove((file + number).c_str());
}

}    // namespace
