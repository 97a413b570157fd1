// compute aggregate/contact: aggregates built by hand with known answers, and random packings
// against a flood fill over all pairs of positions, which knows neither neighbour lists nor ranks.

#include "aggregates.h"

TEST(RanksAggregate, chain_and_loners)
{
  for (const auto &newton : both) {
    Simulation sim;
    Packing scene;
    scene.newton = newton;
    auto chain = chain_of(7);
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
    Packing scene;
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
    Packing scene;
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
    Packing scene;
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
    scene.box = "0 12.5 0 12 0 12";
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
    Packing scene;
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
  build(sim, Packing(), {});
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
        Packing scene;
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
  Packing scene;
  scene.newton = "off";    // LAMMPS's tiled communication cannot bring back histories from ghosts
  build(tiled, scene, random_packing(650, 12.0, 7));
  tiled.run("comm_style tiled\nbalance 1.0 rcb\n");
  tiled.run(measure);
  expect_flood_fill(tiled);

  Simulation triclinic;
  build(triclinic, Packing(), random_packing(650, 12.0, 8));
  triclinic.run("change_box all triclinic\n");
  triclinic.run(measure);
  expect_flood_fill(triclinic);
}

// Hertzian contacts are closed exactly while particles overlap
TEST(RanksAggregate, moving_particles_are_followed)
{
  for (const auto &newton : both) {
    Simulation sim;
    Packing scene;
    scene.newton = newton;
    scene.style = "pair_style granular/adhesive\n"
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
