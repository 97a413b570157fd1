// Words that are no numbers, numbers out of range and words that are none of a few: all commands
// say so in the same words, with argument, range and value, and point at the word.

#include "refused_commands.h"
#include "simulation.h"

#include "gtest/gtest.h"

namespace {

const std::string scene =
    sphere_in_air + "pair_style granular/adhesive\npair_coeff * * jkr 1e6 0.3 0.01\n";

struct Row {
  std::string command, message, word;    // the last one is what the error points at
};

void expect_exactly(const std::string &who, const std::vector<Row> &rows)
{
  for (const auto &row : rows) {
    Simulation sim;
    sim.run(scene);
    const std::string error = sim.error_of(row.command);
    EXPECT_EQ(error.rfind("ERROR: " + who + " " + row.message + ", got " + row.word + " (", 0), 0U)
        << row.command << "\ngave: " << error;
    EXPECT_TRUE(points_at_last(error, row.word)) << error;
  }
}

}    // namespace

TEST(ArgumentErrors, of_contact_laws)
{
  const std::string law = "pair_coeff * * jkr 1e6 0.3 0.01 ";
  expect_exactly(
      "Pair granular/adhesive",
      {{"pair_coeff * * jkr hard 0.3 0", "Young's modulus E must be a number > 0", "hard"},
       {"pair_coeff * * jkr 1e31 0.3 0", "Young's modulus E must be <= 1e+30", "1e31"},
       {"pair_coeff * * jkr 1e-101 0.3 0", "Young's modulus E must be at least 1e-100 in size",
        "1e-101"},
       {"pair_coeff * * jkr 1e6 0.3 1e-101",
        "surface energy gamma must be 0 or at least 1e-100 in size", "1e-101"},
       {"pair_coeff * * jkr 1e999 0.3 0", "Young's modulus E must be <= 1e+30", "1e999"},
       {law + "rolling 2", "rolling theta_crit must be in [0, 1]", "2"},
       {law + "damping some", "damping must be tsuji, alpha or none", "some"},
       {law + "sliding 0.3 twisting on", "twisting must be yes or no", "on"}});
}

TEST(ArgumentErrors, of_walls)
{
  const std::string wall = "fix w all wall/levelset ", law = " jkr 1e6 0.3 0 ";
  expect_exactly(
      "Fix wall/levelset",
      {{wall + "plane x low NULL" + law, "plane must be a number", "low"},
       {wall + "plane x -1e31 NULL" + law, "plane must be >= -1e+30", "-1e31"},
       {wall + "cylinder z 5 5 wide inside" + law, "cylinder radius must be a number > 0", "wide"},
       {wall + "cylinder z 5 5 3 within" + law,
        "cylinder side of the fluid must be inside or outside", "within"},
       {wall + "plane x 0 NULL" + law + "move linear fast 0 0", "move linear must be a number",
        "fast"},
       {wall + "plane x 0 NULL" + law + "move rotate 0 0 here 0 0 1",
        "move rotate centre must be a number in [-10000000, 10000000]", "here"},
       {wall + "plane x 0 NULL" + law + "move rotate 0 0 1e20 0 0 1",
        "move rotate centre must be in [-10000000, 10000000]", "1e20"}});
}

TEST(ArgumentErrors, of_sub_steps)
{
  const std::string mts = "fix m all nve/sphere/mts collision ";
  expect_exactly(
      "Fix nve/sphere/mts",
      {{mts + "tolerance abc", "collision tolerance must be a number in (0, 0.08]", "abc"},
       {mts + "auto safety 1", "safety must be in (0, 0.8]", "1"},
       {mts + "99999999999",
        "collision must be auto, tolerance T or a number of steps from 1 to 1000000",
        "99999999999"},
       {mts + "auto fluid 99999999999", "fluid must be <= 2147483647", "99999999999"},
       {mts + "auto fluid -99999999999", "fluid must be >= 1", "-99999999999"},
       {mts + "auto fluid two", "fluid must be an integer >= 1", "two"},
       {mts + "auto lookahead maybe", "lookahead must be yes or no", "maybe"}});
}

TEST(ArgumentErrors, of_flows)
{
  const std::string flow = "fix f all flow/field ", fluid = " density 1 viscosity 1";
  expect_exactly(
      "Fix flow/field",
      {{flow + "uniform fast 0 0" + fluid, "uniform velocity must be a number", "fast"},
       {flow + "channel x y 0 top 1" + fluid, "channel upper wall must be a number", "top"},
       {flow + "pipe x 0 0 wide 1" + fluid, "pipe radius must be a number > 0", "wide"},
       {flow + "shear x y 1 here" + fluid, "shear origin must be a number", "here"},
       {flow + "uniform 1 0 0 density none", "density must be a number > 0", "none"},
       {flow + "file none.vtkhdf loop on", "loop must be yes or no", "on"}});
  const std::string cloud = "fix c all flow/concentration ";
  expect_exactly("Fix flow/concentration",
                 {{cloud + "9 9 few cloud 1", "number of cells must be an integer >= 1", "few"},
                  {cloud + "9 9 9 cloud big", "cloud radius must be a number > 0", "big"},
                  {cloud + "9 9 9 every 0.5", "every must be an integer >= 1", "0.5"}});
}

TEST(ArgumentErrors, of_forces_of_the_fluid)
{
  const std::string drag = "fix d all flow/force air drag ";
  expect_exactly(
      "Fix flow/force",
      {{drag + "oseen", "drag must be stokes, schiller or difelice", "oseen"},
       {drag + "stokes lift magnus", "lift must be saffman", "magnus"},
       {drag + "stokes torque on", "torque must be yes or no", "on"},
       {drag + "stokes gravity 0 0 down", "gravity must be a number", "down"},
       {drag + "stokes brownian warm 1", "brownian temperature must be a number >= 0", "warm"},
       {drag + "stokes brownian 1 1.5", "brownian seed must be an integer > 0", "1.5"},
       {drag + "stokes cunningham long", "cunningham mean free path must be a number > 0", "long"},
       {drag + "difelice concentration 0.7", "concentration must be in [0, 0.64]", "0.7"},
       {drag + "stokes feedback 9 9 some", "feedback number of cells must be an integer >= 1",
        "some"}});
}

TEST(ArgumentErrors, of_inlets_and_of_advice)
{
  const std::string in = "fix in all inlet/flow x 1 air ";
  expect_exactly(
      "Fix inlet/flow",
      {{"fix in all inlet/flow x left air", "position must be a number", "left"},
       {in + "number many", "number must be a number > 0", "many"},
       {in + "every 1.5", "every must be an integer >= 1", "1.5"},
       {in + "gap wide", "gap must be a number >= 0", "wide"},
       {in + "seed 900000001", "seed must be in [1, 900000000]", "900000001"},
       {in + "concentration dense", "concentration must be a number in (0, 0.64]", "dense"},
       {in + "window 1 2 3 end", "window bound must be a number", "end"},
       {in + "diameter poly mass 1 1 1", "diameter poly must be number or volume", "mass"},
       {in + "diameter poly number two 1 1", "diameter poly number of diameters must be an integer",
        "two"},
       {in + "outlet x far", "outlet position must be a number", "far"}});
  expect_exactly("Command apf_advise",
                 {{"apf_advise speed high", "speed must be a number > 0", "high"}});
}
