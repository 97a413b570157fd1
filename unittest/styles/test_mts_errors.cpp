// What fix nve/sphere/mts refuses, and why.

#include "scenes.h"

namespace {

void expect_words(const std::string &text, const std::vector<std::string> &words)
{
  ASSERT_NE(text, "") << "no message with " << words[0];
  for (const auto &word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
}

const std::string name = "Fix nve/sphere/mts";
const std::string start = "fix nve all nve/sphere/mts collision 8\n";

TEST(MtsErrors, words_of_the_command)
{
  const std::string missing = "fix nve/sphere/mts", argument = "missing argument";
  const std::vector<std::vector<std::string>> table = {
      {"", missing + " collision", argument},
      {"collision", missing + " collision", argument},
      {"steps 8", name, "begins with keyword collision, got steps"},
      {"collision 0", name, "auto, tolerance T or a number of steps from 1 to 1000000, got 0"},
      {"collision 1000001", name, "from 1 to 1000000, got 1000001"},
      {"collision -3", name, "auto, tolerance T or a number of steps from 1 to 1000000, got -3"},
      {"auto", name, "begins with keyword collision, got auto"},
      {"collision 2.5", name, "auto, tolerance T or a number of steps from 1 to 1000000, got 2.5"},
      {"collision automatic", name,
       "auto, tolerance T or a number of steps from 1 to 1000000, got automatic"},
      {"collision auto safety", missing + " safety", argument},
      {"collision auto safety 0", name, "safety must be in (0, 0.8], got 0"},
      {"collision auto safety -0.1", name, "safety must be in (0, 0.8], got -0.1"},
      {"collision auto safety 0.81", name, "safety must be in (0, 0.8], got 0.81"},
      {"collision auto safety nan", name, "safety must be a number in (0, 0.8], got nan"},
      {"collision auto safety much", name, "safety must be a number in (0, 0.8], got much"},
      {"collision 8 safety 0.3", name, "safety goes with collision auto only, got collision 8"},
      {"collision tolerance 0.01 safety 0.3", name, "safety goes with", "got collision tolerance"},
      {"collision tolerance", missing + " collision", argument},
      {"collision tolerance 0", name, "tolerance must be in (0, 0.08], got 0"},
      {"collision tolerance 0.09", name, "tolerance must be in (0, 0.08], got 0.09"},
      {"collision tolerance small", name,
       "collision tolerance must be a number in (0, 0.08], got small"},
      {"collision auto fluid", missing + " fluid", argument},
      {"collision auto fluid 0", name, "fluid must be >= 1, got 0"},
      {"collision auto fluid 1.5", name, "fluid must be an integer >= 1, got 1.5"},
      {"collision auto lookahead", missing + " lookahead", argument},
      {"collision auto lookahead maybe", name, "lookahead must be yes or no, got maybe"},
      {"collision auto 8", name, "keyword must be safety, fluid or lookahead, got 8"},
      {"collision 8 collision 9", name, "keyword collision is given twice"},
  };
  for (const auto &row : table) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}});
    SCOPED_TRACE(row[0]);
    expect_words(sim.error_of("fix nve all nve/sphere/mts " + row[0]),
                 {row.begin() + 1, row.end()});
  }
}

TEST(MtsErrors, what_is_right_is_taken)
{
  for (const char *words :
       {"collision 1", "collision 100 lookahead no", "collision auto safety 0.8 fluid 10",
        "collision auto lookahead yes fluid 1 safety 0.001", "collision tolerance 0.08 fluid 2"}) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.99, 4.0, 4.0}});
    EXPECT_EQ(sim.error_of(std::string("fix nve all nve/sphere/mts ") + words + "\nrun 1"), "");
  }
}

TEST(MtsErrors, what_it_cannot_work_with)
{
  const std::vector<std::vector<std::string>> table = {
      {start + "run_style respa 2 4 pair 1\nrun 0", name, "run_style respa", "run_style verlet"},
      {start + "minimize 0 0 1 1", name, "minimize", "unfix it first"},
      {start + "fix more all nve/sphere\nrun 0", name, "fix more nve/sphere", "stand still"},
      {start + "fix more all nve/sphere/mts collision 8\nrun 0", name, "nve/sphere/mts"},
      {start + "group one id 1\nfix move one move linear 1 0 0\nrun 0", name, "fix move move"},
      {start + "fix body all rigid single\nrun 0", name, "fix body rigid"},
      {start + "pair_style zero 1.0\npair_coeff * *\nrun 0", name, "pair style granular/adhesive",
       "got 0"},
      {start + "pair_style none\nrun 0", name, "pair style granular/adhesive", "got 0"},
  };
  for (const auto &row : table) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}});
    SCOPED_TRACE(row[0]);
    expect_words(sim.error_of(row[0]), {row.begin() + 1, row.end()});
  }
  Simulation sim;
  expect_words(sim.error_of("region b block 0 1 0 1 0 1\ncreate_box 1 b\n" + start),
               {name, "atom style sphere", "atomic"});
}

TEST(MtsErrors, forces_that_are_set_give_a_warning)
{
  for (const std::string style : {"setforce", "aveforce", "addforce"}) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}});
    const auto text = log_of(sim, start + "fix hold all " + style + " 0 0 0\nrun 0\n");
    EXPECT_EQ(text.find("fix hold " + style + " does not hold particles") != std::string::npos,
              style != "addforce")
        << text;
  }
}

TEST(MtsErrors, walls_that_are_not_sub_stepped_give_a_warning)
{
  Scene scene;
  scene.boundary = "p f p";
  Simulation sim;
  build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}}, scene);
  const auto text =
      log_of(sim,
             start +
                 "fix floor all wall/gran hooke/history 1000 NULL 50 NULL 0.5 0 yplane 0 "
                 "NULL\nrun 0\n");
  expect_words(text, {"fix floor wall/gran", "take no collision steps"});
}

// Of a pair that stays together, 5 particle steps of 8 collision steps; of a bridge alone, which
// asks for 14; without contacts no mode sets the step, and steps are in no period.
TEST(MtsErrors, summary_at_the_end_of_a_run)
{
  Simulation pair;
  build(pair, {{3.0, 4.0, 4.0}, {3.99, 4.0, 4.0}, {6.0, 6.0, 6.0}});
  expect_words(log_of(pair, start + "run 5\n"),
               {"nve: 5 particle steps", "40 collision steps, 8 to 8 in a particle step",
                "sub-stepped 66.7 % of the particles, 1 contacts at the end; ",
                "stiffest mode of contacts tangential, ", "in its period, omega dt at most ",
                "; contacts found late 0"});
  Simulation wet;
  build(wet, {{3.0, 4.0, 4.0}, {3.995, 4.0, 4.0}});
  expect_words(log_of(wet,
                      "pair_coeff * * jkr 2e6 0.25 0.01 bridge 0.0002 20000 20 1 0.01\n"
                      "fix nve all nve/sphere/mts collision auto\nrun 1\n"),
               {"finest step set by bridge mode"});
  Simulation none;
  build(none, {{2.0, 4.0, 4.0}, {6.0, 4.0, 4.0}});
  expect_words(
      log_of(none, "fix nve all nve/sphere/mts collision auto\nrun 1\n"),
      {"sub-stepped 0.0 %", "finest step set by no mode of contacts, omega dt at most 0;"});
  expect_words(log_of(none, "unfix nve\n" + start + "run 1\n"),
               {"sub-stepped 0.0 % of the particles, 0 contacts at the end; no contacts; "
                "contacts found late 0"});
}

// A law of which one mode is the stiffest, a pair at rest: omega dt is the safety that was asked
// for, or less by the rounding up of the number of steps.
TEST(MtsErrors, summary_names_the_stiffest_mode)
{
  const std::vector<std::pair<std::string, std::string>> laws = {
      {"normal", "jkr 1e6 0.25 100"},
      {"tangential", "jkr 1e6 0.25 100 sliding 0.3"},
      {"rolling", "jkr 1e6 0.25 1.5e4 rolling 0.02"}};
  for (const auto &[mode, law] : laws) {
    Simulation sim;
    Scene scene;
    scene.style = "pair_style granular/adhesive\npair_coeff * * " + law + "\n";
    const double E = 0.5e6 / (1.0 - 0.0625), gamma = mode == "rolling" ? 1.5e4 : 100.0;
    build(sim, {{3.0, 4.0, 4.0}, {4.0 - JkrCurve{0.25, E, gamma}.delta_eq(), 4.0, 4.0}}, scene);
    const auto text = log_of(sim,
                             "fix nve all nve/sphere/mts collision auto safety 0.1\ntimestep " +
                                 digits(32.0 * dt) + "\nrun 2\n");
    const std::string before =
        "finest step set by " + mode + " mode of contacts, omega dt at most ";
    const auto at = text.find(before);
    ASSERT_NE(at, std::string::npos) << text;
    const double kappa = std::stod(text.substr(at + before.size()));
    EXPECT_LE(kappa, 0.1) << text;
    EXPECT_GT(kappa, 0.08) << text;
  }
}

// A pair that nobody looks out for is found overlapping, and counted.
TEST(MtsErrors, summary_counts_what_was_found_late)
{
  Simulation sim;
  build(sim, {{3.0, 4.0, 4.0}, {4.01, 4.0, 4.0}});
  sim.run("group right id 2\nvelocity right set -1 0 0");
  expect_words(log_of(sim,
                      "fix nve all nve/sphere/mts collision 8 lookahead no\ntimestep " +
                          digits(512.0 * dt) + "\nrun 1\n"),
               {"1 contacts at the end", "contacts found late 1\n"});
}

// With look-ahead nothing is found late but what something else moves between two steps: a warning.
TEST(MtsErrors, late_contacts_give_a_warning_where_none_are_expected)
{
  for (const bool moved : {false, true}) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}});
    const auto text = log_of(
        sim,
        "group one id 1\nfix nve all nve/sphere/mts collision auto\ntimestep 0.0001\n"
        "neighbor 2 bin\n" +
            std::string(moved ? "fix put one recenter 4.001 INIT INIT shift one units box\n" : "") +
            "run 2\n");
    EXPECT_EQ(text.find("1 contacts were found late") != std::string::npos, moved);
  }
}

TEST(MtsErrors, held_particles_that_have_velocities_give_a_warning)
{
  for (const bool fast : {false, true}) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}});
    const auto text = log_of(sim,
                             "group one id 1\nset atom 2 vx " + std::string(fast ? "1e-5" : "0") +
                                 "\nfix nve one nve/sphere/mts collision auto\ntimestep "
                                 "0.0001\nneighbor 2 bin\nrun 1\n");
    EXPECT_EQ(text.find("outside its group have velocities") != std::string::npos, fast);
  }
}

// A pair at rest: sqrt(3.5 k_T/m) with k_T = 8 G a0 is its highest frequency, and the step is the
// N-th part of the timestep.
TEST(MtsErrors, summary_tells_what_a_number_of_steps_is_worth)
{
  const Material material;
  const auto curve = material.pair();
  const double omega = std::sqrt(3.5 * 8.0 * material.G_eff() * curve.a0() / (pi / 12.0));
  for (const int n : {3, 12}) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {4.0 - curve.delta_eq(), 4.0, 4.0}});
    const auto text =
        log_of(sim, "fix nve all nve/sphere/mts collision " + std::to_string(n) + "\nrun 2\n");
    const std::string before = "stiffest mode of contacts tangential, ";
    const auto at = text.find(before);
    ASSERT_NE(at, std::string::npos) << text;
    EXPECT_NE(text.find("; contacts found late 0"), std::string::npos);
    const double said = std::stod(text.substr(at + before.size()));
    EXPECT_NEAR(said * omega * dt / n / (2.0 * pi), 1.0, 0.006) << text;
    const std::string kappa = " collision steps in its period, omega dt at most ";
    const auto there = text.find(kappa);
    ASSERT_NE(there, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(there + kappa.size())) * n / (omega * dt), 1.0, 0.006);
  }
}

TEST(MtsErrors, skin_that_is_too_thin_for_what_it_must_see)
{
  Simulation sim;
  build(sim, {{2.0, 4.0, 4.0}, {6.0, 4.0, 4.0}});
  set_motion(sim, 1, {100.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  // 8 dt x speed 100
  expect_words(sim.error_of("neighbor 0.045 bin\n" + mts(8) + "run 1"),
               {name, "differ by 100", "approach by 0.0488", "skin of 0.045",
                "timestep 0.00018 or smaller", "neighbor 0.12 bin or larger"});
  const auto none = sim.error_of("neighbor 0 bin\nrun 1");    // no timestep suits it
  expect_words(none, {"skin of 0 lets contacts be seen: use neighbor 0.12 bin or larger"});
  EXPECT_EQ(none.find("or smaller"), std::string::npos) << none;

  // at rest, with the acceleration a: a step of sqrt(0.4 skin / a)
  Simulation pushed;
  build(pushed, {{2.0, 4.0, 4.0}, {6.0, 4.0, 4.0}});
  const std::string push = "fix push all addforce " + digits(4.0e5 * pi / 6.0) + " 0 0\n";
  expect_words(pushed.error_of("neighbor 0.045 bin\n" + push + mts(8) + "run 1"),
               {"differ by 0, and that gain up to 195", "timestep 0.00021 or smaller"});
  EXPECT_EQ(pushed.error_of("timestep 0.00021\nrun 1"), "");
}

// Enough for what they can do, not for twice that: the run goes on, looking less far ahead.
TEST(MtsErrors, skin_that_is_too_thin_for_the_safety_factor)
{
  Simulation sim;
  build(sim, {{2.0, 4.0, 4.0}, {3.5, 4.0, 4.0}});
  set_motion(sim, 1, {100.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  EXPECT_EQ(sim.error_of("neighbor 0.09 bin\n" + mts(8) + "run 20"), "");
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  EXPECT_GT(sim.value("vx[2]"), 20.0) << "struck";
  EXPECT_EQ(sim.error_of("neighbor 0.15 bin\nrun 1"), "");
}

// ... with what needs a scene of its own
// Too many collision steps, because of a mass rather than of the timestep: by omega = (k/m)^(1/2),
// with m/2 of a pair of equals, 1e20 times as light.
TEST(MtsErrors, too_many_steps_name_the_contact_and_the_lightest_particle)
{
  const auto error = [](const std::string &density) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {3.99, 4.0, 4.0}, {6.0, 4.0, 4.0, 2.0}});
    return sim.error_of("set atom 1*2 density " + density +
                        "\nfix nve all nve/sphere/mts collision auto\nrun 1");
  };
  EXPECT_EQ(error("1"), "");
  const auto text = error("1e-20");
  expect_words(
      text,
      {name + " nve: a timestep of 6.1e-05 takes ", " collision steps, more than 1000000",
       " mode of a contact has omega = ", "of an effective mass of 2.62e-21;",
       "the lightest particle, ID ",
       " of type 1, has a mass of 5.24e-21, a diameter of 1 and a density of 1e-20: are these",
       ", and the stiffness, in order and in units lj?"});
  ASSERT_NE(text.find("If so, use timestep "), std::string::npos);
  const auto after = [&](const std::string &words) {
    return std::stod(text.substr(text.find(words) + words.size()));
  };
  const double n = after(" takes "), omega = after(" omega = "),
               step = after("If so, use timestep ");
  EXPECT_NEAR(omega * dt / n, 0.3, 0.01);    // of collision auto
  EXPECT_NEAR(step * n / (1e6 * dt), 0.9, 0.05);
  const auto heavier = error("1e-18");
  ASSERT_NE(heavier.find(" omega = "), std::string::npos) << heavier;
  EXPECT_NEAR(std::stod(heavier.substr(heavier.find(" omega = ") + 9)) / omega, 0.1, 0.001);
}

TEST(MtsErrors, rigid_molecules_and_scaled_pair_styles)
{
  const std::vector<std::vector<std::string>> table = {
      {"fix ids all property/atom mol ghost yes\nset group all mol 1\n" + start +
           "fix body all rigid/small molecule\nrun 0",
       name + " cannot work with fix body rigid/small", "stand still"},
      {"pair_style hybrid/scaled 0.5 granular/adhesive 1.0 zero 1.0\n"
       "pair_coeff * * granular/adhesive" +
           jkr + "\npair_coeff * * zero\n" + start + "run 0",
       name + " cannot work with pair_style hybrid/scaled", "take contact forces unscaled"},
  };
  for (const auto &row : table) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}});
    SCOPED_TRACE(row[1]);
    expect_words(sim.error_of(row[0]), {row.begin() + 1, row.end()});
  }
}

}    // namespace
