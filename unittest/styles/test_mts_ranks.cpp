// fix nve/sphere/mts knows nothing of ranks, boundaries, cells and who owns a pair: each scene
// equals the same scene computed well inside one box by velocity Verlet at the collision step, or,
// where the fix chooses that step, by one rank.

#include "scenes.h"

#include "fix.h"
#include "modify.h"

#include <tuple>

namespace {

const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const std::string pair = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
const std::vector<std::string> both = {"on", "off"};

// An aggregate of six, its contacts off their rest, and a bullet that hits it.
const std::vector<Sphere> aggregate = {
    {0.0, 0.0, 0.0},         {0.985, 0.0, 0.0},        {0.49, 0.85, 0.0},   {0.49, 0.29, 0.81},
    {-0.7, -0.69, 0.0, 1.0}, {0.49, 0.29, -0.36, 0.2}, {2.1, 0.7, 0.3, 0.5}};

struct Journey {
  Scene scene;
  std::string commands;
  std::vector<double> from = {4.0, 4.0, 4.0}, v = {0.0, 0.0, 0.0};
};

const std::vector<std::vector<double>> places = {
    {4.0, 4.0, 4.0}, {2.0, 2.0, 2.0}, {7.875, 7.75, 0.125}, {3.625, 7.875, 4.25}};

void set_out(Simulation &sim, const Journey &journey)
{
  auto spheres = aggregate;
  for (auto &sphere : spheres) {
    sphere.x = snap(sphere.x) + journey.from[0];
    sphere.y = snap(sphere.y) + journey.from[1];
    sphere.z = snap(sphere.z) + journey.from[2];
  }
  Scene scene = journey.scene;
  scene.style = pair;
  build(sim, spheres, scene);
  for (int n = 0; n < 7; n++) {
    const double s = n == 6 ? -25.0 : 0.3 * (n % 3);
    set_motion(sim, n + 1, {journey.v[0] + s, journey.v[1] - 0.2 * s, journey.v[2] + 0.1 * s},
               {2.0 - n, 0.5 * n, 1.0});
  }
}

// positions are relative to the first sphere, velocities to the journey
State travelled(Simulation &sim, const Journey &journey, const std::string &integrate, int steps)
{
  set_out(sim, journey);
  sim.run("neighbor 0.5 bin\n" + journey.commands + integrate + "run " + std::to_string(steps));
  State state = state_of(sim);
  for (int n = 6; n >= 0; n--)
    for (int c = 0; c < 3; c++) {
      double d = state.x[3 * n + c] - state.x[c];
      state.x[3 * n + c] = d - 8.0 * std::round(d / 8.0);
      state.v[3 * n + c] -= journey.v[c];
    }
  return state;
}

State travelled(const Journey &journey, const std::string &integrate, int steps)
{
  Simulation sim;
  return travelled(sim, journey, integrate, steps);
}

const State &reference()
{
  static const State state = travelled(Journey(), "fix nve all nve/sphere\n", 1600);
  return state;
}

void expect_reference(const Journey &journey, double tolerance = 1e-9)
{
  const State state = travelled(journey, mts(16), 100);
  expect_same(state, reference(), tolerance);
}

TEST(RanksMtsRanks, the_bullet_hits)
{
  const State before = travelled(Journey(), mts(16), 0);
  EXPECT_GT(difference(reference().v, before.v), 0.5);
  EXPECT_GT(largest(reference().torque), 0.5);
}

TEST(RanksMtsRanks, aggregate_across_ranks_and_boundaries)
{
  for (const auto &newton : both)
    for (const auto &from : places) {
      Journey journey;
      journey.scene.newton = newton;
      journey.from = from;
      SCOPED_TRACE(newton + " " + digits(from[0]));
      expect_reference(journey);
    }
}

TEST(RanksMtsRanks, aggregate_travels_along_each_decomposition)
{
  const std::string n = std::to_string(number_of_ranks());
  for (const auto &newton : both)
    for (const std::string &processors : {n + " 1 1", "1 " + n + " 1", "1 1 " + n}) {
      Journey journey;
      journey.scene.newton = newton;
      journey.scene.processors = processors;
      journey.scene.before = "atom_modify sort 7 1.0";
      journey.v = {48.0, -32.0, 64.0};    // 4.7, 3.1 and 6.3 diameters
      SCOPED_TRACE(newton + " " + processors);
      expect_reference(journey, 1e-7);
    }
}

TEST(RanksMtsRanks, tiled_decomposition_that_is_balanced)
{
  for (const auto &newton : both) {
    Journey journey;
    journey.scene.newton = newton;
    journey.v = {48.0, -32.0, 64.0};
    journey.commands = "comm_style tiled\ncomm_modify vel yes\n"
                       "fix rcb all balance 7 1.0 rcb\n";
    SCOPED_TRACE(newton);
    expect_reference(journey, 1e-7);
    journey.commands = "fix shift all balance 7 1.0 shift xyz 5 1.1\n";
    expect_reference(journey, 1e-7);
  }
}

TEST(RanksMtsRanks, neighbour_lists_built_often)
{
  Journey journey;
  journey.v = {48.0, -32.0, 64.0};
  journey.commands = "neigh_modify delay 0 every 1 check no binsize 2\natom_modify sort 1 1.0\n";
  expect_reference(journey, 1e-7);
}

// All ranks choose the same number of collision steps, and the one that a single rank chooses: it
// follows the bullet, and the contact that asks for the finest step is on one of the ranks only.
TEST(RanksMtsRanks, the_number_of_collision_steps_is_that_of_one_rank)
{
  for (const std::string how : {"auto", "tolerance 0.01"}) {
    const std::string integrate =
        "fix nve all nve/sphere/mts collision " + how + "\ntimestep " + digits(64 * dt) + "\n";
    for (const auto &newton : both)
      for (const auto &from : places) {
        SCOPED_TRACE(how + " " + newton + " " + digits(from[0]));
        Journey journey;
        journey.scene.newton = newton;
        journey.from = from;
        const auto outcome = [&](MPI_Comm ranks) {
          Simulation sim({}, ranks);
          const State state = travelled(sim, journey, integrate, 25);
          return std::make_tuple(state, sim.value("f_nve[1]"), sim.value("f_nve[4]"));
        };
        const auto [one, last, all] = outcome(MPI_COMM_SELF);
        const auto [state, last_here, all_here] = outcome(MPI_COMM_WORLD);
        expect_same(state, one, 1e-9);
        EXPECT_EQ(last_here, last);
        EXPECT_EQ(all_here, all);
        EXPECT_GT(std::fabs(all - 25 * last), 5.0) << "of many numbers";
        EXPECT_GT(all, 50.0);
      }
  }
}

// The kick of a touch or of an end may be half in one particle step and half in the next, whose
// collision steps are of another length: what is given is one impulse. Pairs in which either sphere
// is of another rank, across the middle or the border of the box, and a wall; in closed form e^2 =
// 1 - (V_s/V)^2.
TEST(RanksMtsRanks, impacts_between_steps_of_two_lengths)
{
  const Material material;
  const double ratio = 1.5, exact = std::sqrt(1.0 - 1.0 / (ratio * ratio));
  struct Way {
    std::string newton, how;
    double center;    // of the pair along x; 0: one sphere and the wall
  };
  const std::string coarse = "auto safety 0.1", fine = "tolerance 0.0005";
  for (const auto &[newton, how, center] :
       {Way{"on", coarse, 4.0}, Way{"off", fine, 4.0}, Way{"on", fine, 7.9},
        Way{"off", coarse, 7.9}, Way{"on", coarse, 0.0}, Way{"on", fine, 0.0}}) {
    SCOPED_TRACE(newton + " " + how + " " + digits(center));
    const bool wall = center == 0.0;
    const auto curve = wall ? material.wall() : material.pair();
    const double V = ratio *
        std::sqrt(2.0 * 0.935503 * curve.F_C() * curve.delta_C() / (pi / (wall ? 6.0 : 12.0)));
    for (int n = 0; n < 12; n++) {
      const double gap = 0.01 * (1.0 + n / 12.0) + 1e-5;
      Scene scene;
      scene.newton = newton;
      scene.boundary = "p p f";
      scene.processors = std::to_string(number_of_ranks()) + " 1 1";
      scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr +
          "\nfix wall all wall/levelset plane z 0 NULL" + jkr + "\nneighbor 2.0 bin\n";
      const double x = center - 0.5 * (1.0 + gap);
      Simulation sim;
      build(sim,
            wall ? std::vector<Sphere>{{4.0, 4.0, 0.5 + gap}}
                 : std::vector<Sphere>{{x, 4.0, 4.0}, {std::fmod(x + 1.0 + gap, 8.0), 4.0, 4.0}},
            scene);
      set_motion(sim, 1, {wall ? 0.0 : 0.5 * V, 0.0, wall ? -V : 0.0}, {0.0, 0.0, 0.0});
      if (!wall) set_motion(sim, 2, {-0.5 * V, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("fix nve all nve/sphere/mts collision " + how + "\ntimestep " + digits(0.01 / V) +
              "\nrun 40");
      const auto v = gather(sim, "v");
      EXPECT_NEAR((wall ? v[2] : v[3] - v[0]) / V, exact, 5e-4) << n;
      EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
    }
  }
}

// So many contacts that collision steps are taken tile by tile (contact/islands.h), but for
// aggregates across the box's and the ranks' boundaries: every one moves as one alone does.
TEST(RanksMtsRanks, each_of_many_aggregates_moves_as_one_alone)
{
  constexpr int along = 8, copies = along * along * along, bodies = 7;
  for (const auto &newton : both)
    for (const double from : {4.0, 0.25}) {
      SCOPED_TRACE(newton + " " + digits(from));
      Journey journey;
      journey.scene.newton = newton;
      journey.from = {from, 4.0, 4.0};
      Simulation sim;
      set_out(sim, journey);
      sim.run("replicate 8 8 8\nneighbor 0.5 bin\n" + mts(16) +
              "compute contacts all contact/atom\ncompute sum all reduce sum c_contacts\n"
              "thermo_style custom step c_sum\nrun 100");
      EXPECT_GT(sim.value("c_sum"), 2 * 2500.0);    // tiles take 1000 pairs
      const State all = state_of(sim);
      ASSERT_EQ(all.x.size(), 3u * copies * bodies);
      double x = 0.0, v = 0.0, omega = 0.0;
      for (int copy = 0; copy < copies; copy++)
        for (int n = 0; n < 3 * bodies; n++) {
          const int at = 3 * bodies * copy + n;
          double d = all.x[at] - all.x[3 * bodies * copy + n % 3] - reference().x[n];
          d -= 8.0 * std::round(d / 8.0);    // one of another copy may be there
          x = std::max(x, std::fabs(d));
          v = std::max(v, std::fabs(all.v[at] - reference().v[n]));
          omega = std::max(omega, std::fabs(all.omega[at] - reference().omega[n]));
        }
      EXPECT_LT(x, 1e-9);
      EXPECT_LT(v, 1e-8 * largest(reference().v));
      EXPECT_LT(omega, 1e-8 * largest(reference().omega));
    }
}

// Ghosts, and those of them that a collision step exchanges, of all ranks: in a gas so dilute that
// none meet, though there are pairs in the neighbour list, and with more spheres in the box.
struct Ghosts {
  int all, exchanged;
};

Ghosts ghosts_of(const std::string &newton, const std::vector<Sphere> &more)
{
  Scene scene;
  scene.newton = newton;
  scene.processors = std::to_string(number_of_ranks()) + " 1 1";
  scene.style = pair;
  std::vector<Sphere> spheres = more;
  for (int n = 0; n < 16; n++) spheres.push_back({0.25 + 0.5 * n, 0.5 + 1.35 * (n % 4), 6.0});
  Simulation sim;
  build(sim, spheres, scene);
  for (int n = 0; n < 16; n++)
    set_motion(sim, static_cast<int>(more.size()) + n + 1, {0.0, n % 2 ? 1.0 : -1.0, 0.5},
               {0.0, 0.0, 1.0});
  sim.run("neighbor 0.5 bin\n" + mts(16) + "run 2");
  EXPECT_EQ(sim.value("f_nve[1]"), 16.0);
  EXPECT_EQ(sim.value("f_nve[3]"), more.size() / 2);    // contacts
  auto *lammps = sim.lammps();
  int dim;
  const auto *exchanged =
      static_cast<int *>(lammps->modify->get_fix_by_id("nve")->extract("substep_ghosts", dim));
  int mine[2] = {lammps->atom->nghost, *exchanged}, sum[2];
  MPI_Allreduce(mine, sum, 2, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  return {sum[0], sum[1]};
}

// the middle of the box is a border between two ranks, its end one between ranks or images
TEST(RanksMtsGhosts, collision_steps_exchange_partners_across_a_border_alone)
{
  const std::vector<Sphere> in_middle = {{3.51, 2.0, 2.0}, {4.49, 2.0, 2.0}},
                            at_end = {{0.48, 4.0, 2.0}, {7.5, 4.0, 2.0}},
                            beside_border = {{3.9, 6.0, 2.0}, {3.9, 6.98, 2.0}};
  const int borders = number_of_ranks() > 1;
  for (const auto &newton : both) {
    SCOPED_TRACE("newton " + newton);
    const int of_pair = newton == "on" ? 1 : 2;    // off: each rank has the other's sphere
    const auto gas = ghosts_of(newton, {}), beside = ghosts_of(newton, beside_border),
               middle = ghosts_of(newton, in_middle), end = ghosts_of(newton, at_end);
    EXPECT_GE(gas.all, 8);
    EXPECT_EQ(gas.exchanged, 0);
    EXPECT_EQ(beside.exchanged, 0);
    EXPECT_EQ(middle.exchanged, of_pair * borders);
    EXPECT_EQ(end.exchanged, of_pair);
    auto four = in_middle;
    four.insert(four.end(), at_end.begin(), at_end.end());
    EXPECT_EQ(ghosts_of(newton, four).exchanged, of_pair * (borders + 1));
  }
}

}    // namespace
