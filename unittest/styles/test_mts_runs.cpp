// fix nve/sphere/mts: runs that stop and go on, restarts in mid-contact, and what other commands
// see of contacts after a step: that is what a velocity Verlet step of the collision step's length
// gives.

#include "scenes.h"

#include <fstream>
#include <map>

namespace {

const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const std::string wall = "fix wall all wall/levelset plane z 0 NULL" + law + "\n";
const std::string dynamics = "fix g all gravity 500 vector 1 0.5 -1\n" + wall;

void build_pile(Simulation &sim)
{
  Scene scene;
  scene.boundary = "p p f";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
  build(sim, {{3.5, 4.0, 0.49}, {4.48, 4.0, 0.485}, {4.0, 4.2, 1.515}}, scene);
  set_motion(sim, 1, {1.0, 0.5, 0.0}, {3.0, 1.0, 2.0});
  set_motion(sim, 2, {0.5, 1.0, 0.0}, {-2.0, 4.0, 1.0});
  set_motion(sim, 3, {2.0, 0.0, -1.0}, {0.0, -3.0, -2.0});
}

std::string chosen(const std::string &how)
{
  return "fix nve all nve/sphere/mts collision " + how + "\ntimestep " + digits(20 * dt) + "\n";
}
const std::string fixed = mts(20), automatic = chosen("auto safety 0.05"),
                  tolerant = chosen("tolerance 0.001");

State after(const std::string &commands)
{
  Simulation sim;
  build_pile(sim);
  sim.run(dynamics + commands);
  return state_of(sim);
}

// The number of collision steps follows the contacts, as the next tests need it.
TEST(RanksMtsRuns, tolerance_takes_many_numbers_of_steps)
{
  Simulation sim;
  build_pile(sim);
  sim.run(dynamics + tolerant + "run 0");
  std::map<double, int> times;
  for (int n = 0; n < 40; n++) {
    sim.run("run 1 pre no post no");
    times[sim.value("f_nve[1]")]++;
  }
  EXPECT_GT(times.size(), 3u);
  EXPECT_GT(times.rbegin()->first, 4.0);
}

TEST(RanksMtsRuns, two_runs_are_one)
{
  for (const auto &integrate : {fixed, automatic, tolerant}) {
    const State reference = after(integrate + "run 40");
    ASSERT_GT(largest(reference.torque), 0.5);
    for (const char *cut :
         {"run 1\nrun 39", "run 0\nrun 40", "run 17\nrun 0\nrun 23", "run 40 every 8 NULL"}) {
      SCOPED_TRACE(integrate + cut);
      expect_same(after(integrate + cut), reference, 1e-10);
    }
  }
}

TEST(RanksMtsRuns, restart_goes_on)
{
  const std::string file = scratch_file("restart");
  for (const auto &integrate : {fixed, automatic, tolerant}) {
    double counted[2] = {};
    State reference;
    {
      Simulation sim;
      build_pile(sim);
      sim.run(dynamics + integrate + "run 40");
      reference = state_of(sim);
      counted[0] = sim.value("f_nve[4]");
      counted[1] = sim.value("f_wall[8]");
    }
    for (const std::string &way :
         {"run 17\nwrite_restart " + file, "restart 17 " + file + "\nrun 40"}) {
      after(integrate + way);
      const std::string from = way[1] == 'e' ? file + ".17" : file;
      Simulation sim;
      sim.run("read_restart " + from + "\n" + dynamics + integrate + "run 23");
      SCOPED_TRACE(integrate + way);
      expect_same(state_of(sim), reference, 1e-10);
      EXPECT_EQ(sim.value("f_nve[4]"), counted[0]);
      EXPECT_EQ(sim.value("f_wall[8]"), counted[1]);
      EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
    }
    for (const char *number : {"", ".17", ".34"}) std::remove((file + number).c_str());
  }
}

// ---------------------------------------------------------------------------------------------
// Impacts that begin and end within the run, of pairs and at a wall: whichever step a run ends
// with, the impulse of a contact that has just been made or has ended is not lost.

State impacts(const std::string &commands, const std::string &from = "")
{
  Simulation sim;
  const std::string floor =
      "fix wall all wall/levelset plane z 0 NULL" + jkr + "\nneighbor 1 bin\n";
  if (from.empty()) {
    Scene scene;
    scene.boundary = "p p f";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
    const double V = 3.0 *
        std::sqrt(2.0 * 0.935503 * Material().pair().F_C() * Material().pair().delta_C() /
                  (pi / 12.0));
    std::vector<Sphere> spheres;
    for (int n = 0; n < 4; n++) {
      spheres.push_back({1.5, 1.0 + 2.0 * n, 4.0});
      spheres.push_back({2.5 + 0.003 * (n + 1), 1.0 + 2.0 * n, 4.0});
      spheres.push_back({6.0, 1.0 + 2.0 * n, 0.5 + 0.003 * (n + 1)});
    }
    build(sim, spheres, scene);
    for (int n = 0; n < 4; n++) {
      set_motion(sim, 3 * n + 1, {0.5 * V, 0.0, 0.0}, {0.0, 0.0, 0.0});
      set_motion(sim, 3 * n + 2, {-0.5 * V, 0.0, 0.0}, {0.0, 0.0, 0.0});
      set_motion(sim, 3 * n + 3, {0.0, 0.0, -V}, {0.0, 0.0, 0.0});
    }
    sim.run(floor);
  } else {
    sim.run("read_restart " + from + "\n" + floor);
  }
  sim.run(commands);
  return state_of(sim);
}

std::string times(int n, const std::string &command)
{
  std::string all;
  for (int k = 0; k < n; k++) all += command + "\n";
  return all;
}

TEST(RanksMtsRuns, impacts_through_the_ends_of_runs)
{
  struct Way {
    std::string integrate;
    int steps;
  };
  const std::string verlet = "fix nve all nve/sphere\ntimestep " + digits(8 * dt) + "\n";
  const std::string follow =
      "timestep " + digits(64 * dt) + "\nfix nve all nve/sphere/mts collision ";
  for (const auto &[integrate, steps] :
       {Way{verlet, 80}, Way{mts(8, 8 * dt), 10}, Way{follow + "auto\n", 10},
        Way{follow + "tolerance 0.01\n", 10}}) {
    SCOPED_TRACE(integrate);
    const State whole = impacts(integrate + "run " + std::to_string(steps));
    // all have bounced, and fly apart at the speed that adhesion leaves them
    for (int n = 0; n < 4; n++) {
      EXPECT_LT(whole.v[9 * n], 0.0);
      EXPECT_GT(whole.v[9 * n + 3], 0.0);
      EXPECT_GT(whole.v[9 * n + 8], 0.0);
    }
    const State split = impacts(integrate + times(steps, "run 1"));
    EXPECT_LT(difference(split.x, whole.x), 1e-10);
    EXPECT_LT(difference(split.v, whole.v), 1e-10);
    const State idle = impacts(integrate + times(steps, "run 0\nrun 1"));
    EXPECT_LT(difference(idle.v, whole.v), 1e-10);

    const std::string file = scratch_file("impacts");
    for (int cut = 1; cut < steps; cut += steps / 10) {
      impacts(integrate + "run " + std::to_string(cut) + "\nwrite_restart " + file);
      const State after = impacts(integrate + "run " + std::to_string(steps - cut), file);
      EXPECT_LT(difference(after.v, whole.v), 1e-10) << cut;
    }
    std::remove(file.c_str());
  }
}

// ---------------------------------------------------------------------------------------------
// energy, pressure, rows of pair/local and the load of the wall, at the end of the same time

const std::string outputs =
    "compute p all pressure NULL pair\n"
    "compute c all pair/local dist force p1 p4 p5 p6 p7 p8 p9 p10 p11\n"
    "compute sum all reduce sum c_c[*] inputs local\n"
    "compute most all reduce maxabs c_c[*] inputs local\n"
    "fix_modify wall energy yes virial yes\ncompute w all pressure NULL fix\n"
    "compute s all stress/atom NULL\ncompute S all reduce maxabs c_s[*]\n"
    "thermo_style custom step pe ke c_p[*] c_w[*] c_sum[*] c_most[*] c_S[*] "
    "f_wall[*]\nthermo_modify norm no\n";

std::vector<double> seen(Simulation &sim)
{
  std::vector<double> all = {sim.value("pe"), sim.value("ke")};
  for (const char *name : {"c_p", "c_w", "c_sum", "c_most", "c_S", "f_wall"})
    for (int n = 1; n <= (name[2] == 's' || name[2] == 'm' ? 11 : 6); n++)
      all.push_back(sim.value(std::string(name) + "[" + std::to_string(n) + "]"));
  return all;
}

TEST(RanksMtsRuns, outputs_are_those_of_verlet_at_the_collision_step)
{
  auto outcome = [](const std::string &integrate, const std::string &run) {
    Simulation sim;
    build_pile(sim);
    sim.run(dynamics + "fix nve all nve/sphere\n" + outputs);
    if (integrate[0] == 'f') sim.run("unfix nve\nthermo_style custom step\n" + integrate);
    sim.run("thermo_style custom step pe ke c_p[*] c_w[*] c_sum[*] c_most[*] c_S[*] f_wall[*]\n"
            "thermo_modify norm no\nthermo 1000000\n" +
            run);
    auto numbers = seen(sim);
    const auto state = state_of(sim);
    numbers.insert(numbers.end(), state.f.begin(), state.f.end());
    numbers.insert(numbers.end(), state.torque.begin(), state.torque.end());
    return numbers;
  };
  const auto reference = outcome("", "run 800"), levels = outcome(fixed, "run 40");
  for (size_t n = 0; n < reference.size(); n++)
    EXPECT_NEAR(levels[n], reference[n], 1e-7 * std::max(1.0, std::fabs(reference[n]))) << n;
  // looked at again without a step, nothing is different
  const auto again = outcome(fixed, "run 40\nrun 0");
  for (size_t n = 0; n < reference.size(); n++)
    EXPECT_NEAR(again[n], levels[n], 1e-9 * std::max(1.0, std::fabs(levels[n]))) << n;
}

// ---------------------------------------------------------------------------------------------
// elastic contacts without friction depend on positions alone, where there are no necks: a dump
// shows the run again

TEST(RanksMtsRuns, rerun_of_a_dump_shows_the_run)
{
  const std::string file = scratch_file("dump");
  auto rows = [&](const std::string &run) {
    const std::string table = file + ".table";
    {
      Simulation sim;
      build_pile(sim);
      sim.run("velocity all set 1 0.5 0.25\nset atom 2 x 4.492\npair_style "
              "granular/adhesive\npair_coeff * *" +
              jkr +
              "\nfix g all gravity 500 vector 1 0.5 -1\nthermo_modify norm no\n"
              "compute p all pressure NULL pair\nvariable e equal pe\nvariable p equal c_p\n"
              "variable n equal f_nve[3]\n" +
              fixed + "fix log all ave/time 4 1 4 v_e v_p v_n file " + table +
              " format \" %.17g\"\n" + run);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    std::ifstream in(table);
    std::vector<double> all;
    std::string line;
    while (std::getline(in, line)) {
      std::istringstream words(line);
      for (double number; words >> number;) all.push_back(number);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    std::remove(table.c_str());
    return all;
  };
  const auto run =
      rows("dump d all custom 4 " + file +
           " id type x y z vx vy vz\ndump_modify d sort id format float %.17g\nrun 40");
  const auto again = rows("rerun " + file + " dump x y z vx vy vz");
  std::remove(file.c_str());
  ASSERT_EQ(run.size(), 44u);    // step, energy, pressure and contacts of eleven steps
  for (size_t n = 0; n < run.size(); n++)
    EXPECT_NEAR(again[n], run[n], 1e-9 * std::max(1.0, std::fabs(run[n]))) << n;
}

}    // namespace
