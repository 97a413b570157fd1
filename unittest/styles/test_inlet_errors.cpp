// Wrong input of fix inlet/flow.

#include "inlet_scene.h"

TEST(InletErrors, an_outlet_may_be_the_end_of_the_box)
{
  Simulation sim;
  sim.run(box() + uniform);
  EXPECT_EQ(sim.error_of("fix in all inlet/flow x 0 air concentration 0.01 diameter 0.5 density 2 "
                         "type 1 seed 3 outlet x 20\nrun 0"),
            "");
}

TEST(InletErrors, outlets_beside_the_inlet_across_a_periodic_border_give_a_warning)
{
  for (const bool periodic : {false, true}) {
    std::string scene = box() + uniform;
    if (periodic) scene.replace(scene.find("boundary f"), 10, "boundary p");
    Simulation sim;
    sim.run(scene);
    const auto text = log_of(sim,
                             "fix in all inlet/flow x 0 air concentration 0.01 outlet x 19" +
                                 particle + "\nfix drag all flow/force air drag stokes\nrun 0\n");
    EXPECT_EQ(text.find("the box is periodic in x") != std::string::npos, periodic) << text;
  }
}

// What enters joins group all and that of its inlet, not groups of particles that were there: 50
// steps leave it where it entered.
TEST(InletErrors, what_enters_and_nothing_moves)
{
  const auto log = [](const std::string &inlet, const std::string &others, bool &moved) {
    Simulation sim;
    sim.run(box("f p") + uniform +
            "create_atoms 1 single 10 5 5\nset group all diameter 0.5 density 2\n"
            "group bed id 1\ngroup mobile subtract all bed\ngroup late dynamic all every 1\n"
            "unfix move\nfix in " +
            inlet + " inlet/flow x 0 air number 1" + particle + "\nfix drag " + others +
            " flow/force air drag stokes\nfix w " + others +
            " wall/levelset plane y 0 NULL jkr 1e6 0.3 0.1\nfix move " + others + " nve/sphere\n");
    auto text = log_of(sim, "run 50\nrun 0\n");
    double largest = 0.0;
    const auto x = gather(sim, "x");
    for (std::size_t k = 3; k < x.size(); k += 3) largest = std::max(largest, x[k]);
    EXPECT_GE(x.size(), 6u) << "none entered";
    moved = largest > 0.1;    // in a step the fluid moves by 0.01
    return text;
  };
  const std::string words = "WARNING: Fix inlet/flow in: what enters joins group all";
  bool moved = true;
  auto text = log("all", "mobile", moved);
  for (const std::string rest : {", and fix move nve/sphere moves group mobile only",
                                 ", and fix w wall/levelset touches group mobile only",
                                 ", and fix drag flow/force acts on group mobile only"})
    EXPECT_NE(text.find(words + rest), std::string::npos) << text;
  EXPECT_NE(text.find("give group mobile after them, or this group to fix in inlet/flow"),
            std::string::npos)
      << text;
  EXPECT_FALSE(moved);
  text = log("bed", "mobile", moved);
  EXPECT_NE(text.find(words + " and bed, and fix move"), std::string::npos) << text;
  EXPECT_FALSE(moved);
  for (const auto &[inlet, others] :
       {std::pair<std::string, std::string>{"mobile", "mobile"}, {"all", "late"}, {"bed", "all"}}) {
    text = log(inlet, others, moved);
    EXPECT_EQ(text.find("what enters joins"), std::string::npos) << inlet << others << text;
    EXPECT_TRUE(moved) << inlet << " " << others;
  }
}

TEST(InletErrors, time_that_goes_backwards)
{
  Simulation sim;
  sim.run(box() + uniform + "pair_style zero 1\npair_coeff * *\n" +
          "fix in all inlet/flow x 0 air number 1" + particle + "\ntimestep -0.01\n");
  const auto said = sim.error_of("run 1\n");
  EXPECT_NE(said.find("Fix inlet/flow in: timestep must be >= 0, got -0.01"), said.npos) << said;
}

TEST(InletErrors, name_what_is_wrong)
{
  struct Row {
    std::string words, part;
  };
  const std::string good = " concentration 0.01 diameter 0.5 density 2 type 1 seed 3";
  const std::vector<Row> rows = {
      {"", "missing argument"},
      {"w 0 air" + good, "plane must be x, -x, y, -y, z or -z, got w"},
      {"x 0 air diameter 0.5 density 2 type 1 seed 3", "concentration or number"},
      {"x 0 air number 3" + good, "not both"},
      {"x 0 air concentration 0.7", "concentration must be in (0, 0.64]"},
      {"x 0 air concentration -1", "got -1"},
      {"x 0 air number 0", "number must be > 0, got 0"},
      {"x 0 air every 0", "every must be >= 1, got 0"},
      {"x 0 air diameter 0", "diameter must be > 0, got 0"},
      {"x 0 air diameter uniform 0.2 0.1", "diameter uniform HI must be > LO 0.2, got 0.1"},
      {"x 0 air diameter lognormal 0.2 0.9 0.1 0.3", "must be > 1, got 0.9"},
      {"x 0 air diameter lognormal 0.2 1.1 2 3", "at least 1 %"},
      {"x 0 air diameter poly mass 1 0.1 1", "poly must be number or volume, got mass"},
      {"x 0 air diameter poly number 2 0.1 1", "Fix inlet/flow diameter poly takes"},
      {"x 0 air density 0", "density must be > 0, got 0"},
      {"x 0 air type 2", "type must be in [1, 1], got 2"},
      {"x 0 air seed 0", "seed must be in [1, 900000000], got 0"},
      {"x 0 air gap -1", "gap must be >= 0, got -1"},
      {"x 0 air attempts 0", "attempts must be >= 1, got 0"},
      {"x 0 air window 3 2 NULL NULL", "must be > lower bound 3, got 2"},
      {"x 0 air outlet q 3", "outlet must be"},
      {"x 0 air outlet x -1", "would delete what enters at 0"},
      {"x 0 air diameter lognormal 0.2 1.1 2", "missing argument"},
      {"x 0 air speed 3", "keyword must be"},
      {"x 0 wind" + good + "\nrun 0", "fix wind does not exist"},
      {"x 0 move" + good + "\nrun 0", "must be of style flow/field, got nve/sphere"},
      {"x 30 air" + good + "\nrun 0", "must lie within the box"},
      {"x 20 air" + good + "\nrun 0", "would leave the box"},
      {"x 0 air outlet x 20.1" + good + "\nrun 0", "outlet x = 20.1 must lie within the box"},
      {"-x 20 air" + good + "\nrun 0", "does not enter anywhere"},
      {"x 0 air window 0 0.4 NULL NULL" + good + "\nrun 0", "smaller than the window"},
      {"x 0 air window -3 3 NULL NULL" + good + "\nrun 0", "must lie within the box"},
  };
  for (const auto &row : rows) {
    Simulation sim;
    sim.run(box() + uniform);
    const auto text = sim.error_of("fix in all inlet/flow " + row.words);
    EXPECT_NE(text.find(row.part), std::string::npos)
        << "'" << row.part << "' expected, got '" << text << "' from: " << row.words;
  }
}
