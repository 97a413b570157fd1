// compute aggregate/contact: aggregates built by hand with known answers, and random packings
// against a flood fill over all pairs of positions, which knows neither neighbour lists nor ranks.

#include "simulation.h"

#include "compute.h"

#include "gtest/gtest.h"

#include <cmath>
#include <filesystem>
#include <random>

namespace {

struct Particle {
  double x, y, z;
  int type;    // diameters 1, 0.8, 1.4
};

struct Scene {
  std::string newton = "on";
  std::string processors = "* * *";
  std::string boundary = "p p p";
  std::string region = "0 12 0 12 0 12";
  std::string pair = "pair_style granular/adhesive\n"
                     "pair_coeff * * jkr 1.0e6 0.3 1.0 damping tsuji 0.5\n";
};

const std::vector<std::string> both = {"on", "off"};

// particles get the IDs 1, 2, ... or those given
void build(Simulation &sim, const Scene &scene, const std::vector<Particle> &particles,
           std::vector<int> ids = {})
{
  sim.run("newton " + scene.newton + "\nprocessors " + scene.processors + "\nboundary " +
          scene.boundary + "\n" +
          "atom_style sphere\n"
          "atom_modify map array\n"
          "comm_modify vel yes\n"
          "region box block " +
          scene.region + "\n" +
          "create_box 3 box\n"
          "timestep 1.0e-5\n");
  std::vector<double> x;
  std::vector<int> types;
  for (const auto &p : particles) {
    x.insert(x.end(), {p.x, p.y, p.z});
    types.push_back(p.type);
    if (ids.size() < particles.size()) ids.push_back(static_cast<int>(ids.size()) + 1);
  }
  if (!particles.empty()) {
    lammps_create_atoms(sim.lammps(), static_cast<int>(particles.size()), ids.data(), types.data(),
                        x.data(), nullptr, nullptr, 0);
    sim.run("set type 1 diameter 1.0 density 1.0\n"
            "set type 2 diameter 0.8 density 1.0\n"
            "set type 3 diameter 1.4 density 1.0\n");
  }
  sim.run(scene.pair);
}

struct Row {
  double id, size, wall, contacts;
  bool operator==(const Row &o) const
  {
    return id == o.id && size == o.size && wall == o.wall && contacts == o.contacts;
  }
};

void PrintTo(const Row &row, std::ostream *out)
{
  *out << "{" << row.id << ", " << row.size << ", " << row.wall << ", " << row.contacts << "}";
}

// of all particles by ID
std::vector<double> gather(Simulation &sim, const char *name, int columns)
{
  std::vector<double> all(columns * static_cast<int>(lammps_get_natoms(sim.lammps())));
  lammps_gather(sim.lammps(), name, 1, columns, all.data());
  return all;
}

std::vector<Row> rows(Simulation &sim, const char *compute = "c_agg")
{
  constexpr int columns = 6;    // the last two are those of liquid bridges
  const auto values = gather(sim, compute, columns);
  std::vector<Row> result;
  for (size_t m = 0; m < values.size(); m += columns)
    result.push_back({values[m], values[m + 1], values[m + 2], values[m + 3]});
  return result;
}

std::vector<double> totals(Simulation &sim)
{
  std::vector<double> result;
  for (int n = 1; n <= 6; n++) result.push_back(sim.value("c_agg[" + std::to_string(n) + "]"));
  return result;
}

// Flood fill over all pairs at their nearest images; plane: walls at y = -plane and y = plane
std::vector<Row> flood_fill(Simulation &sim, double plane = INFINITY)
{
  const auto x = gather(sim, "x", 3), radius = gather(sim, "radius", 1);
  const int n = static_cast<int>(radius.size());
  double lo[3], hi[3], xy, yz, xz;
  int periodic[3], change;
  lammps_extract_box(sim.lammps(), lo, hi, &xy, &yz, &xz, periodic, &change);

  auto touch = [&](int i, int j) {
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
      double d = x[3 * j + c] - x[3 * i + c];
      if (periodic[c]) d -= (hi[c] - lo[c]) * std::round(d / (hi[c] - lo[c]));
      square += d * d;
    }
    return i != j && std::sqrt(square) < radius[i] + radius[j];
  };
  auto walls = [&](int i) {
    return (x[3 * i + 1] + plane < radius[i]) + (plane - x[3 * i + 1] < radius[i]);
  };

  std::vector<Row> result(n, Row{0, 0, 0, 0});
  for (int seed = 0; seed < n; seed++) {    // the first that is met has the smallest ID
    if (result[seed].id > 0) continue;
    std::vector<int> members = {seed};
    result[seed].id = seed + 1;
    int wall = 0;
    for (size_t m = 0; m < members.size(); m++) {
      const int i = members[m];
      result[i].contacts = walls(i);
      if (walls(i)) wall = 1;
      for (int j = 0; j < n; j++) {
        if (!touch(i, j)) continue;
        result[i].contacts++;
        if (result[j].id == 0) members.push_back(j);
        result[j].id = seed + 1;
      }
    }
    for (int i : members) {
      result[i].size = static_cast<double>(members.size());
      result[i].wall = wall;
    }
  }
  return result;
}

// the global vector that belongs to these rows
std::vector<double> totals_of(const std::vector<Row> &all)
{
  double particles[2] = {0, 0}, aggregates[2] = {0, 0};
  for (size_t i = 0; i < all.size(); i++) {
    if (all[i].size < 2) continue;
    for (int wall = 0; wall <= static_cast<int>(all[i].wall); wall++) {
      particles[wall]++;
      if (all[i].id == i + 1) aggregates[wall]++;
    }
  }
  auto mean = [&](int w) {
    return aggregates[w] > 0 ? particles[w] / aggregates[w] : 0.0;
  };
  return {particles[0], aggregates[0], mean(0), particles[1], aggregates[1], mean(1)};
}

void expect_flood_fill(Simulation &sim, double plane = INFINITY)
{
  const auto expected = flood_fill(sim, plane);
  EXPECT_EQ(rows(sim), expected);
  EXPECT_EQ(totals(sim), totals_of(expected));
}

std::vector<Particle> random_packing(int n, double size, int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, size);
  std::vector<Particle> result;
  for (int i = 0; i < n; i++) {
    const double x = place(random), y = place(random), z = place(random);
    result.push_back({x, y, z, 1 + i % 3});
  }
  return result;
}

const char *measure = "compute agg all aggregate/contact\nrun 0\n";

}    // namespace

TEST(RanksAggregate, chain_and_loners)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    std::vector<Particle> chain;
    for (int i = 0; i < 7; i++) chain.push_back({3.0 + 0.95 * i, 6.0, 6.0, 1});
    chain.push_back({1.0, 1.0, 1.0, 1});
    chain.push_back({11.0, 2.0, 11.0, 3});
    build(sim, scene, chain);
    sim.run(measure);
    std::vector<Row> expected(7, Row{1, 7, 0, 2});
    expected.front().contacts = expected.back().contacts = 1;
    expected.push_back({8, 1, 0, 0});
    expected.push_back({9, 1, 0, 0});
    EXPECT_EQ(rows(sim), expected);
    EXPECT_EQ(totals(sim), (std::vector<double>{7, 1, 7, 0, 0, 0}));
  }
}

TEST(RanksAggregate, across_a_periodic_corner)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    // eight particles around one corner of the box, each touches three
    std::vector<Particle> cube;
    for (int n = 0; n < 8; n++)
      cube.push_back({n & 1 ? 0.45 : 11.55, n & 2 ? 0.45 : 11.55, n & 4 ? 0.45 : 11.55, 1});
    build(sim, scene, cube);
    sim.run(measure);
    EXPECT_EQ(rows(sim), std::vector<Row>(8, Row{1, 8, 0, 3}));
    EXPECT_EQ(totals(sim), (std::vector<double>{8, 1, 8, 0, 0, 0}));
  }
}

TEST(RanksAggregate, chain_that_wraps_onto_itself)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.processors = "* 1 1";
    std::vector<Particle> chain;
    for (int i = 0; i < 13; i++) chain.push_back({0.2 + i * 12.0 / 13, 5.0, 5.0, 1});
    build(sim, scene, chain);
    sim.run(measure);
    EXPECT_EQ(rows(sim), std::vector<Row>(13, Row{1, 13, 0, 2}));
  }
}

TEST(RanksAggregate, snake_through_all_ranks_many_times)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.processors = "* 1 1";
    std::vector<Particle> snake;    // rows along x, joined at alternate ends
    for (int row = 0; row < 6; row++) {
      for (int i = 0; i < 12; i++)
        snake.push_back({0.7 + 0.95 * (row % 2 ? 11 - i : i), 1.0 + 1.9 * row, 6.0, 1});
      snake.push_back({row % 2 ? 0.7 : 0.7 + 0.95 * 11, 1.95 + 1.9 * row, 6.0, 1});
    }
    snake.pop_back();
    const int n = static_cast<int>(snake.size());
    std::vector<int> ids;    // the smallest ID is at the tail
    for (int i = 0; i < n; i++) ids.push_back(n - i);
    scene.region = "0 12.5 0 12 0 12";
    build(sim, scene, snake, ids);
    sim.run(measure);
    std::vector<Row> expected(n, Row{1, double(n), 0, 2});
    expected.front().contacts = expected.back().contacts = 1;
    EXPECT_EQ(rows(sim), expected);
  }
}

TEST(RanksAggregate, ranks_without_particles)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    build(sim, scene, {{1.0, 1.0, 1.0, 1}, {1.9, 1.0, 1.0, 1}});
    sim.run(measure);
    EXPECT_EQ(rows(sim), std::vector<Row>(2, Row{1, 2, 0, 1}));
    EXPECT_EQ(totals(sim), (std::vector<double>{2, 1, 2, 0, 0, 0}));
  }
}

TEST(RanksAggregate, no_particles_at_all)
{
  Simulation sim;
  build(sim, {}, {});
  sim.run(measure);
  EXPECT_EQ(totals(sim), std::vector<double>(6, 0.0));
}

// from a few pairs to one aggregate that percolates through the periodic box
TEST(RanksAggregate, random_packing_is_flood_fill)
{
  for (const auto &newton : both)
    for (const auto *processors : {"* * *", "1 * 1"})
      for (int n : {200, 600, 700, 1500}) {
        SCOPED_TRACE("newton " + newton + " processors " + processors + " " + std::to_string(n));
        Simulation sim;
        Scene scene;
        scene.newton = newton;
        scene.processors = processors;
        build(sim, scene, random_packing(n, 12.0, n));
        sim.run(measure);
        expect_flood_fill(sim);
        sim.run("compute largest all reduce max c_agg[2]\nrun 0\n");
        const double largest = sim.value("c_largest") / n;
        EXPECT_GT(largest, n == 1500 ? 0.9 : 0.0);
        EXPECT_LT(largest, n == 200 ? 0.1 : 1.0 + 1e-12);
      }
}

TEST(RanksAggregate, irregular_subdomains_and_triclinic_box)
{
  Simulation tiled;
  Scene scene;
  scene.newton = "off";    // LAMMPS's tiled communication cannot bring back histories from ghosts
  build(tiled, scene, random_packing(650, 12.0, 7));
  tiled.run("comm_style tiled\nbalance 1.0 rcb\n");
  tiled.run(measure);
  expect_flood_fill(tiled);

  Simulation triclinic;
  build(triclinic, {}, random_packing(650, 12.0, 8));
  triclinic.run("change_box all triclinic\n");
  triclinic.run(measure);
  expect_flood_fill(triclinic);
}

// Hertzian contacts are closed exactly while particles overlap
TEST(RanksAggregate, moving_particles_are_followed)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.pair = "pair_style granular/adhesive\n"
                 "pair_coeff * * jkr 1.0e3 0.3 0.0 damping tsuji 0.5\n";
    build(sim, scene, random_packing(500, 12.0, 3));
    sim.run("velocity all create 4.0 4711 loop geom\n"
            "fix move all nve/sphere\n"
            "timestep 1.0e-3\n"
            "compute agg all aggregate/contact\n"
            "thermo_style custom step c_agg[1] c_agg[2]\n"
            "thermo 50\n");
    for (int n = 0; n < 4; n++) {
      sim.run("run 250\n");
      expect_flood_fill(sim);
    }
  }
}

TEST(RanksAggregate, wall_contacts)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.boundary = "p f p";
    scene.region = "0 12 -3.5 3.5 0 12";
    const double touching = -3.0 + 0.45;
    std::vector<Particle> particles = {
        {2.0, touching, 6.0, 1},    // a tower of three on the wall
        {2.0, touching + 0.9, 6.0, 1},
        {2.0, touching + 1.8, 6.0, 1},
        {5.0, touching, 6.0, 1},    // alone on the wall
        {8.0, 0.0, 6.0, 1},         // a pair in the fluid
        {8.9, 0.0, 6.0, 1},
        {11.6, 3.0 - 0.45, 6.0, 1},    // a pair through the periodic boundary, both on the wall
        {0.5, 3.0 - 0.45, 6.0, 1},
        {4.0, 0.0, 6.0, 1}};    // alone
    build(sim, scene, particles);
    sim.run("fix w all wall/levelset plane y -3 3 jkr 1.0e6 0.3 1.0\n");
    sim.run(measure);
    const std::vector<Row> expected = {{1, 3, 1, 2}, {1, 3, 1, 2}, {1, 3, 1, 1},
                                       {4, 1, 1, 1}, {5, 2, 0, 1}, {5, 2, 0, 1},
                                       {7, 2, 1, 2}, {7, 2, 1, 2}, {9, 1, 0, 0}};
    EXPECT_EQ(rows(sim), expected);
    EXPECT_EQ(totals(sim), (std::vector<double>{7, 3, 7.0 / 3, 5, 2, 2.5}));
    expect_flood_fill(sim, 3.0);
  }
}

TEST(RanksAggregate, two_walls_and_a_packing)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.boundary = "p f p";
    scene.region = "0 12 -6.5 6.5 0 12";
    auto packing = random_packing(550, 12.0, 5);
    for (auto &p : packing) p.y = 0.95 * (p.y - 6.0);
    build(sim, scene, packing);
    // one fix for each wall: contacts add up
    sim.run("fix low all wall/levelset plane y -6 NULL jkr 1.0e6 0.3 1.0\n"
            "fix high all wall/levelset plane y NULL 6 jkr 1.0e6 0.3 1.0\n");
    sim.run(measure);
    expect_flood_fill(sim, 6.0);
  }
}

TEST(RanksAggregate, only_the_group_takes_part)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    std::vector<Particle> chain;
    for (int i = 0; i < 7; i++) chain.push_back({3.0 + 0.95 * i, 6.0, 6.0, i == 3 ? 3 : 1});
    build(sim, scene, chain);
    sim.run("group some type 1\ncompute part some aggregate/contact\n");
    sim.run(measure);
    EXPECT_EQ(rows(sim, "c_part"),
              (std::vector<Row>{{1, 3, 0, 1},
                                {1, 3, 0, 2},
                                {1, 3, 0, 1},
                                {0, 0, 0, 0},
                                {5, 3, 0, 1},
                                {5, 3, 0, 2},
                                {5, 3, 0, 1}}));
    EXPECT_EQ(rows(sim)[6].size, 7);
    EXPECT_EQ(sim.value("c_part[1]"), 6);
    EXPECT_EQ(sim.value("c_part[2]"), 2);
    EXPECT_EQ(sim.value("c_part[3]"), 3);
  }
}

TEST(RanksAggregate, dynamic_group_changes_without_new_neighbours)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.processors = "* 1 1";
    std::vector<Particle> chain;
    for (int i = 0; i < 6; i++) chain.push_back({3.0 + 0.95 * i, 6.0, 6.0, 1});
    build(sim, scene, chain);
    sim.run("neigh_modify every 1000 delay 1000\n"
            "variable stays atom \"id != step\"\n"
            "group some dynamic all every 1 var stays\n"
            "compute agg some aggregate/contact\n");
    for (int step = 1; step < 6; step++) {
      sim.run("run 1 pre " + std::string(step == 1 ? "yes" : "no") + "\n");
      std::vector<Row> expected;
      for (int id = 1; id <= 6; id++) {
        const int first = id < step ? 1 : step + 1, last = id < step ? step - 1 : 6;
        if (id == step)
          expected.push_back({0, 0, 0, 0});
        else
          expected.push_back(
              {double(first), double(last - first + 1), 0, double((id > first) + (id < last))});
      }
      EXPECT_EQ(rows(sim), expected) << "step " << step;
    }
  }
}

// Two pairs of particles at the same distance, in reach of a neck: the pair that has touched before
// is an aggregate, the other is not.
TEST(RanksAggregate, stretched_neck_counts)
{
  const double E = 1.0e4, gamma = 30.0, poisson = 0.3, R = 0.25;
  const double effective = E / (2.0 * (1.0 - poisson * poisson));
  const double a0 = std::cbrt(9.0 * M_PI * gamma * R * R / effective);
  const double reach = a0 * a0 / (2.0 * std::cbrt(6.0) * R);    // delta_C
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.pair = "pair_style granular/adhesive\n"
                 "pair_coeff * * jkr 1.0e4 0.3 30.0 damping tsuji 0.5\n";
    build(sim, scene,
          {{11.5, 2.0, 6.0, 1}, {0.4, 2.0, 6.0, 1}, {11.5, 8.0, 6.0, 1}, {1.4, 8.0, 6.0, 1}});
    sim.run(measure);
    EXPECT_EQ(totals(sim)[0], 2);
    const double gap = 0.5 * reach;
    sim.run("group touched id 2\ngroup untouched id 4\ndisplace_atoms touched move " +
            std::to_string(0.1 + gap) + " 0 0\ndisplace_atoms untouched move " +
            std::to_string(-0.9 + gap) + " 0 0\nrun 0\n");
    EXPECT_EQ(rows(sim),
              (std::vector<Row>{{1, 2, 0, 1}, {1, 2, 0, 1}, {3, 1, 0, 0}, {4, 1, 0, 0}}));
    sim.run("displace_atoms touched move " + std::to_string(reach) + " 0 0\nrun 0\n");
    EXPECT_EQ(totals(sim)[0], 0);
  }
}

TEST(RanksAggregate, sub_style_of_hybrid)
{
  for (const auto *hybrid : {"hybrid", "hybrid/overlay"}) {
    Simulation sim;
    Scene scene;
    scene.pair = "pair_style " + std::string(hybrid) +
        " zero 2.0 granular/adhesive\n"
        "pair_coeff * * granular/adhesive jkr 1.0e6 0.3 1.0\n"
        "pair_coeff 3 3 zero\n";
    build(sim, scene,
          {{6.0, 6.0, 6.0, 1}, {6.9, 6.0, 6.0, 1}, {3.0, 3.0, 3.0, 3}, {4.2, 3.0, 3.0, 3}});
    sim.run(measure);
    const bool overlay = std::string(hybrid) == "hybrid/overlay";
    EXPECT_EQ(rows(sim)[0], (Row{1, 2, 0, 1}));
    EXPECT_EQ(rows(sim)[3], overlay ? (Row{3, 2, 0, 1}) : (Row{4, 1, 0, 0}));
  }
}

TEST(RanksAggregate, one_calculation_gives_both_outputs)
{
  Simulation sim;
  build(sim, {}, {{6.0, 6.0, 6.0, 1}, {6.9, 6.0, 6.0, 1}});
  sim.run(measure);
  auto *compute = sim.lammps()->modify->get_compute_by_id("agg");
  ASSERT_NE(compute, nullptr);
  EXPECT_EQ(compute->invoked_peratom, -1);
  compute->compute_vector();
  EXPECT_EQ(compute->invoked_peratom, sim.lammps()->update->ntimestep);
  compute->vector[0] = -7.0;    // stays if nothing is done again
  compute->compute_peratom();
  EXPECT_EQ(compute->vector[0], -7.0);
  sim.run("run 0\n");    // a new run measures again
  EXPECT_EQ(totals(sim)[0], 2);
}

TEST(Aggregate, errors_name_the_cause)
{
  const std::string box = "atom_style sphere\nregion box block 0 9 0 9 0 9\ncreate_box 1 box\n"
                          "create_atoms 1 single 1 1 1\ncomm_modify vel yes\n";
  const std::string needs =
      "Compute aggregate/contact needs a pair style that keeps contacts, such as "
      "granular/adhesive; the pair style is ";
  auto error = [&](const std::string &commands) {
    return Simulation().error_of(commands);
  };

  EXPECT_NE(error(box + measure).find(needs + "none"), std::string::npos);
  EXPECT_NE(error(box + "pair_style zero 1.0\npair_coeff * *\n" + measure).find(needs + "zero"),
            std::string::npos);
  EXPECT_NE(error(box + "compute agg all aggregate/contact 2.0\n")
                .find("Compute aggregate/contact takes no arguments, got 2.0"),
            std::string::npos);
  EXPECT_NE(error("atom_modify id no\n" + box + "compute agg all aggregate/contact\n")
                .find("Compute aggregate/contact needs atom IDs: atom_modify id yes"),
            std::string::npos);
}

// fix balance evaluates its variables before ghosts and contacts of the run are there
// write_restart brings atoms back into the box, and gives ghosts new numbers
TEST(Aggregate, after_write_restart_contacts_have_to_be_found_again)
{
  Simulation sim;
  sim.run("atom_style sphere\nregion box block 0 9 0 9 0 9\ncreate_box 1 box\n"
          "comm_modify vel yes\ncreate_atoms 1 single 7.905 5 5\ncreate_atoms 1 single 8.9 5 5\n"
          "create_atoms 1 single 2 2 2\nset group all diameter 1 density 1\n"
          "velocity all set 1 0 0\npair_style granular/adhesive\n"
          "pair_coeff * * jkr 1e3 0.25 0.01\nneighbor 1 bin\n"
          "fix move all nve/sphere\ntimestep 1e-3\n"
          "compute agg all aggregate/contact\nthermo_style custom step\nrun 150\n");
  const auto file = (std::filesystem::temp_directory_path() / "apf-aggregate-restart").string();
  sim.run("write_restart " + file);
  std::filesystem::remove(file);
  const std::string said = sim.error_of("print $(c_agg[1])");
  EXPECT_NE(said.find("use run 0 first"), said.npos) << said;
  sim.run("run 0");
  EXPECT_EQ(sim.value("c_agg[1]"), 2.0);
}

TEST(Aggregate, weights_of_balance_are_taken_from_fix_ave_atom)
{
  const std::string balance = "fix share all balance 10 1.0 shift x 5 1.0 weight var cost\nrun 0";
  Simulation sim;
  build(sim, Scene(), {{5.0, 5.0, 5.0, 1}, {5.95, 5.0, 5.0, 1}});
  sim.run(measure + std::string("\nvariable cost atom 1+c_agg[4]\n"));
  const std::string said = sim.error_of(balance);
  EXPECT_NE(said.find("aggregate/contact agg is asked for before the first forces"), said.npos)
      << said;

  Simulation kept;
  build(kept, Scene(), {{5.0, 5.0, 5.0, 1}, {5.95, 5.0, 5.0, 1}});
  kept.run(measure +
           std::string("\nfix touch all ave/atom 1 1 10 c_agg[4]\n"
                       "variable cost atom 1+f_touch\n"));
  EXPECT_EQ(kept.error_of(balance), "");
}
