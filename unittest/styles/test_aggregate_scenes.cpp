// compute aggregate/contact with walls, groups, stretched necks, pair_style hybrid, fix balance and
// restarts.

#include "aggregates.h"

#include "compute.h"

#include <filesystem>

TEST(RanksAggregate, wall_contacts)
{
  for (const auto &newton : both) {
    Simulation sim;
    Packing scene;
    scene.newton = newton;
    scene.boundary = "p f p";
    scene.box = "0 12 -3.5 3.5 0 12";
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
    Packing scene;
    scene.newton = newton;
    scene.boundary = "p f p";
    scene.box = "0 12 -6.5 6.5 0 12";
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
    Packing scene;
    scene.newton = newton;
    auto chain = chain_of(7);
    chain[3].type = 3;
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
    Packing scene;
    scene.newton = newton;
    scene.processors = "* 1 1";
    build(sim, scene, chain_of(6));
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
    Packing scene;
    scene.newton = newton;
    scene.style = "pair_style granular/adhesive\n"
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
    Packing scene;
    scene.style = "pair_style " + std::string(hybrid) +
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
  build(sim, Packing(), {{6.0, 6.0, 6.0, 1}, {6.9, 6.0, 6.0, 1}});
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
  build(sim, Packing(), {{5.0, 5.0, 5.0, 1}, {5.95, 5.0, 5.0, 1}});
  sim.run(measure + std::string("\nvariable cost atom 1+c_agg[4]\n"));
  const std::string said = sim.error_of(balance);
  EXPECT_NE(said.find("aggregate/contact agg is asked for before the first forces"), said.npos)
      << said;

  Simulation kept;
  build(kept, Packing(), {{5.0, 5.0, 5.0, 1}, {5.95, 5.0, 5.0, 1}});
  kept.run(measure +
           std::string("\nfix touch all ave/atom 1 1 10 c_agg[4]\n"
                       "variable cost atom 1+f_touch\n"));
  EXPECT_EQ(kept.error_of(balance), "");
}
