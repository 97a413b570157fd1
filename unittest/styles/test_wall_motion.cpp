// Fix wall/levelset move: what a wall does that moves as a rigid body follows from Galilean
// invariance and from rigid rotation.

#include "scenes.h"
#include "temporary_file.h"

namespace {

const Material material;
const std::string none = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";

Scene at_wall(const std::string &wall, const std::string &boundary = "p p f")
{
  Scene scene;
  scene.boundary = boundary;
  scene.style = none + "fix wall all wall/levelset " + wall + "\n";
  return scene;
}

const std::vector<std::string> integrators = {
    "timestep " + digits(dt / 4) + "\nfix nve all nve/sphere\n",
    "timestep " + digits(dt) + "\nrun_style respa 2 4 pair 1\nfix nve all nve/sphere\n",
    mts(8, dt / 4)};

std::string run_for(Simulation &sim, double time)
{
  return "run " + std::to_string(std::lround(time / sim.lammps()->update->dt));
}

}    // namespace

// A piston that strikes a sphere at rest: the sphere leaves with (1 + e) times its speed.
TEST(WallMotion, piston_gives_one_plus_e_times_its_speed)
{
  const double v = 6.0, e = 0.5;
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 1.02}},
          at_wall("plane z 0.5 NULL jkr 1.0e6 0.25 0 damping tsuji 0.5 move linear 0 0 " +
                  digits(v)));
    sim.run(integrator);
    sim.run(run_for(sim, 0.05));
    EXPECT_EQ(sim.value("f_wall[8]"), 1.0);
    EXPECT_EQ(sim.value("f_wall[7]"), 0.0);
    EXPECT_NEAR(gather(sim, "v")[2] / ((1.0 + e) * v), 1.0, 0.01) << integrator;
  }
}

// Sphere and wall move together: as both at rest.
TEST(WallMotion, what_moves_with_the_wall_is_at_rest)
{
  for (const auto &integrator : integrators) {
    const double rest = 0.5 - material.wall().delta_eq();
    Simulation sim;
    build(sim, {{4.0, 4.0, 1.0 + rest - 1e-3}},
          at_wall("plane z 1 NULL" + jkr + all_friction + "damping tsuji 0.2 move linear 2 -1 3"));
    set_motion(sim, 1, {2.0, -1.0, 3.0}, {0.0, 0.0, 0.0});
    sim.run(integrator);
    sim.run(run_for(sim, 1.0));
    const auto x = gather(sim, "x"), v = gather(sim, "v");
    EXPECT_NEAR(x[2] - (1.0 + 3.0) - rest, 0.0, 1e-9) << integrator;
    EXPECT_NEAR(v[0], 2.0, 1e-9);
    EXPECT_NEAR(v[1], -1.0, 1e-9);
    EXPECT_NEAR(v[2], 3.0, 1e-9);
    EXPECT_LT(largest(gather(sim, "omega")), 1e-9);
  }
}

// A drum that turns takes a sphere that sticks to it along, without gravity; the sphere turns with
// the drum and presses against it with m omega^2 rho.
TEST(WallMotion, drum_takes_along_what_sticks)
{
  const double omega = 2.0, rho = 2.5 + material.wall().delta_eq();
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{4.0 + rho, 4.0, 4.0}},
          at_wall("cylinder z 4 4 3 inside" + jkr +
                      "damping tsuji 0.2 sliding 0.5 twisting yes "
                      "rolling 0.02 0.5 move rotate 4 4 0 0 0 " +
                      digits(omega),
                  "f f p"));
    set_motion(sim, 1, {0.0, omega * rho, 0.0}, {0.0, 0.0, omega});
    sim.run(integrator);
    const double turn = 0.25 * pi;    // the time of a quarter turn
    sim.run(run_for(sim, turn));
    const auto x = gather(sim, "x"), w = gather(sim, "omega");
    const double time = sim.lammps()->update->dt * sim.lammps()->update->ntimestep;
    const double angle = std::atan2(x[1] - 4.0, x[0] - 4.0);
    EXPECT_NEAR(angle, omega * time, 2e-3) << integrator;
    EXPECT_NEAR(w[2], omega, 2e-3);
    const double mass = pi / 6.0, size = std::hypot(sim.value("f_wall[1]"), sim.value("f_wall[2]"));
    EXPECT_NEAR(size / (mass * omega * omega * std::hypot(x[0] - 4.0, x[1] - 4.0)), 1.0, 0.01);
  }
}

// A turned wall from a file, the plane y = 4 of the box, stands where its shape says; so do its
// zones, in which a deposit per area is that of what lies there.
TEST(WallMotion, wall_from_a_file_turns)
{
  TemporaryFile file("apf_wall_motion");
  file.write({21, 21, 2}, {0, 0, -0.5}, {0.4, 0.4, 1.0}, [](VtkhdfWriter &w) {
    w.field("distance", 1, [](const double *x, double, double *phi) {
      *phi = x[1] - 4.0;
    });
  });
  Scene scene =
      at_wall("file " + file.path + jkr + "move rotate 4 4 0 0 0 1 zone right right", "f f p");
  scene.before = "dimension 2";
  scene.box = "0 8 0 8 -0.5 0.5";
  scene.style = "region right block 6 9 -1 9 -1 1\n" + scene.style;
  Simulation sim;
  build(sim, {{6.5, 7.0, 0.0}}, scene);
  // by 30 degrees about the middle; 0.49 above it
  const double angle = pi / 6.0, along = 3.0;
  sim.run("fix stay all nve/noforce\nfix flat all enforce2d\ntimestep " + digits(angle / 512.0) +
          "\nrun 512\nset atom 1 x " +
          digits(4.0 - 0.49 * std::sin(angle) + along * std::cos(angle)) + " y " +
          digits(4.0 + 0.49 * std::cos(angle) + along * std::sin(angle)) + "\nrun 0");
  const auto f = gather(sim, "f");
  const double expected = material.wall().force(0.01);
  EXPECT_NEAR(f[0], -expected * std::sin(angle), 1e-9 * std::fabs(expected));
  EXPECT_NEAR(f[1], expected * std::cos(angle), 1e-9 * std::fabs(expected));
  const double right = 4.0 - 2.0 / std::cos(angle);
  EXPECT_NEAR(sim.value("f_wall[1][13]"), right, 1e-6);
  EXPECT_NEAR(sim.value("f_wall[2][13]"), 8.0 - right, 1e-6);
  EXPECT_NEAR(sim.value("f_wall[1][15]"), pi / 6.0 / right, 1e-6);
  EXPECT_EQ(sim.value("f_wall[2][15]"), 0.0);
}

// a wall shaken by a variable, restarted in the middle
TEST(RanksWallMotion, restart_goes_on_where_the_wall_was)
{
  const std::string restart = scratch_file("restart");
  const std::string wall = "fix wall all wall/levelset plane z 0.5 NULL" + jkr + all_friction +
      "move linear v_side 0 v_shake\n";
  const std::string shake = "variable shake equal 1.5*sin(200*step*dt)\nvariable side equal 3\n";
  const std::string go = "fix g all gravity 300 vector 0 0 -1\nfix nve all nve/sphere\n";
  Scene scene;
  scene.boundary = "p p f";
  scene.style = none + shake + wall;
  Simulation sim;
  build(sim, {{1.0, 2.0, 0.99}, {6.0, 7.0, 0.995}}, scene);
  sim.run(go + "run 700\nwrite_restart " + restart + "\nrun 700");
  const State whole = state_of(sim);
  EXPECT_EQ(sim.value("f_wall[7]"), 2.0);
  EXPECT_GT(std::fabs(whole.v[0]), 0.1);
  sim.run("clear\nread_restart " + restart + "\n" + none + shake + wall + go + "run 700");
  expect_same(state_of(sim), whole, 1e-12);
}

TEST(WallMotion, wrong_words_are_refused)
{
  Simulation sim;
  Scene scene = at_wall("plane z 0 NULL" + jkr);
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  const std::vector<std::array<std::string, 2>> cases = {
      {"move", "fix wall/levelset move"},
      {"move slide 1 0 0", "must be linear or rotate, got slide"},
      {"move linear 1 0", "move linear"},
      {"move linear 1 0 0 move linear 1 0 0", "given twice"},
      {"move rotate 0 0 0 1 0", "move rotate"}};
  for (const auto &[words, expected] : cases) {
    const std::string text = sim.error_of("fix w all wall/levelset plane z 0 NULL" + jkr + words);
    EXPECT_NE(text.find(expected), std::string::npos) << words << ": " << text;
  }
  const std::string text =
      sim.error_of("fix w all wall/levelset plane z 0 NULL" + jkr + "move linear v_no 0 0\nrun 0");
  EXPECT_NE(text.find("variable no does not exist"), std::string::npos) << text;
}

// The same surface in two fixes acts twice on particles that both groups have.
TEST(WallMotion, the_same_wall_twice_is_warned_of)
{
  const auto log = [](const std::string &first, const std::string &second,
                      const std::string &group = "all") {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {2.0, 2.0, 4.0}}, at_wall(first, "p p f"));
    return log_of(sim,
                  "group one id 1\ngroup two id 2\nfix nve all nve/sphere\nfix w2 " + group +
                      " wall/levelset " + second + "\nrun 0\n");
  };
  const std::string hertz = " jkr 1e6 0.25 0 ", planes = "plane z 0 8", both = planes + hertz;
  const std::string words = "WARNING: Fix wall/levelset wall and fix w2 are the same wall (";
  const auto told = [&](const std::string &text, const std::string &names) {
    return text.find(words + names + ") for the same particles") != std::string::npos;
  };
  EXPECT_TRUE(told(log(both, planes + jkr), "lo, hi"));
  EXPECT_TRUE(told(log(both, "plane z NULL 8" + hertz, "one"), "hi"));
  const std::string rod = "cylinder z 6 2 1 outside" + hertz, by = "move linear 0 0 ";
  EXPECT_TRUE(told(log(rod, rod, "two"), "cylinder"));
  EXPECT_TRUE(told(log(both + by + "0", both + by + "0"), "lo, hi"));

  for (const std::string &other :
       {"plane z 1e-9 7" + hertz, "plane z NULL 7.999" + hertz, both + by + "1",
        "cylinder z 6 2 0.9 outside" + hertz, "cylinder z 6 1.9 1 outside" + hertz})
    for (const std::string &first : {both, rod})
      EXPECT_EQ(log(first, other).find("are the same wall"), std::string::npos) << other;
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}, {2.0, 2.0, 4.0}});
  const std::string text = log_of(sim,
                                  "change_box all boundary p p f\ngroup one id 1\ngroup two id 2\n"
                                  "fix w1 one wall/levelset " +
                                      both + "\nfix w2 two wall/levelset " + both + "\nrun 0\n");
  EXPECT_EQ(text.find("are the same wall"), std::string::npos) << text;
}

TEST(WallMotion, the_same_wall_of_a_file_twice_is_warned_of)
{
  const TemporaryFile file("apf_twice"), same("apf_twice_again");
  for (const auto *one : {&file, &same})
    one->write({9, 9, 9}, {0, 0, 0}, {1, 1, 1}, [](VtkhdfWriter &w) {
      for (const char *name : {"distance_floor", "distance_ceiling"})
        w.field(name, 1, [name](const double *x, double, double *d) {
          d[0] = name[9] == 'f' ? x[2] - 0.5 : 7.5 - x[2];
        });
    });
  const auto log = [&](const std::string &second) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}}, at_wall("file " + file.path + " jkr 1e6 0.25 0"));
    return log_of(sim,
                  "fix nve all nve/sphere\nfix w2 all wall/levelset file " + second +
                      " jkr 1e6 0.25 0\nrun 0\n");
  };
  const std::string words = "are the same wall (";
  EXPECT_NE(log(file.path).find(words + "ceiling, floor)"), std::string::npos) << log(file.path);
  EXPECT_NE(log(file.path + " array distance_floor").find(words + "floor)"), std::string::npos);
  EXPECT_EQ(log(same.path).find(words), std::string::npos);
}
