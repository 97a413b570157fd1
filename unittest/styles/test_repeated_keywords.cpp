// A keyword that is given twice, of which one value would count for nothing: an error that points
// at the second one. Those that add something each time stay as they are.

#include "refused_commands.h"
#include "simulation.h"
#include "temporary_file.h"

#include "gtest/gtest.h"

namespace {

const std::string law = " jkr 1e6 0.3 0.01 ", floor_at_0 = "fix w all wall/levelset plane z 0 NULL";
const std::string in = "fix in all inlet/flow x 1 air number 1 diameter 1 density 1 type 1 seed 1";

void expect_second_is_refused(const std::string &scene, const std::string &command,
                              const std::string &keyword)
{
  Simulation sim;
  sim.run(sphere_in_air + scene);
  const std::string error = sim.error_of(command);
  EXPECT_NE(error.find("keyword " + keyword + " is given twice"), std::string::npos)
      << command << "\ngave: " << error;
  EXPECT_TRUE(points_at_last(error, keyword)) << error;
}

}    // namespace

TEST(RepeatedKeywords, of_contact_laws)
{
  const char *const twice[][2] = {
      {"damping", "damping none sliding 0.3 damping alpha 1"},
      {"sliding", "sliding 0.3 sliding 0.3"},
      {"twisting", "sliding 0.3 twisting yes twisting no"},
      {"rolling", "rolling 0.01 0.1 rolling 0.02"},
      {"break", "break force break touch"},
      {"scale_stiffness", "scale_stiffness 0.5 scale_stiffness 1"},
      {"bridge", "bridge 0.01 0.07 0 1e-3 bridge 0.02 0.07 0 1e-3"},
      {"form", "bridge 0.01 0.07 0 1e-3 form film form contact"},
      {"capillary", "bridge 0.01 0.07 0 1e-3 capillary willett capillary maugis"},
      {"tangential", "bridge 0.01 0.07 0 1e-3 tangential yes tangential no"},
      {"wet_gamma", "bridge 0.01 0.07 0 1e-3 wet_gamma 1 1 1 1 wet_gamma 2 1 1 1"},
      {"inventory", "bridge 0.01 0.07 0 1e-3 inventory 1 even inventory 0.5"},
  };
  for (const auto &[keyword, words] : twice) {
    expect_second_is_refused("pair_style granular/adhesive\n", "pair_coeff * *" + law + words,
                             keyword);
    expect_second_is_refused("", floor_at_0 + law + words, keyword);
  }
  expect_second_is_refused("pair_style hybrid granular/adhesive zero 1\n",
                           "pair_coeff * * granular/adhesive" + law + "break force break force",
                           "break");
}

TEST(RepeatedKeywords, of_fixes_and_of_advice)
{
  const std::string flow = "fix f all flow/field ", drag = "fix d all flow/force air drag stokes ";
  const std::string cloud = "fix c all flow/concentration 9 9 9 cloud 1 ";
  const std::string rows[][2] = {
      {"density", flow + "uniform 1 0 0 density 1 viscosity 1 density 2"},
      {"viscosity", flow + "uniform 1 0 0 viscosity 1 viscosity 2"},
      {"loop", flow + "file none.vtkhdf loop yes loop no"},
      {"outside", flow + "file none.vtkhdf outside clamp density 1 outside error"},
      {"wall", flow + "file none.vtkhdf wall plain wall plain"},
      {"density", flow + "file none.vtkhdf density 1 density 1"},
      {"drag", drag + "drag schiller"},
      {"torque", drag + "torque yes torque no"},
      {"gravity", drag + "gravity 0 0 -1 gravity 0 0 1"},
      {"lift", drag + "lift saffman lift saffman"},
      {"peratom", drag + "peratom no magnus yes peratom yes"},
      {"brownian", drag + "brownian 1 3 brownian 1 4"},
      {"cunningham", drag + "cunningham 1 cunningham 2"},
      {"feedback", drag + "feedback 3 3 3 feedback no"},
      {"safety", "fix m all nve/sphere/mts collision auto safety 0.1 fluid 2 safety 0.2"},
      {"collision", "fix m all nve/sphere/mts collision 20 collision 30"},
      {"fluid", "fix m all nve/sphere/mts collision 5 fluid 2 fluid 2"},
      {"lookahead", "fix m all nve/sphere/mts collision 5 lookahead yes lookahead no"},
      {"number", in + " number 2"},
      {"window", in + " window NULL NULL 1 9 window NULL NULL 1 8"},
      {"seed", in + " every 2 seed 3"},
      {"cloud", cloud + "cloud 1.1"},
      {"method", cloud + "method auto every 3 method direct"},
      {"length", "apf_advise length 1 speed 1 length 2"},
  };
  for (const auto &[keyword, command] : rows)
    expect_second_is_refused("pair_style granular/adhesive\npair_coeff * *" + law + "\n", command,
                             keyword);
}

TEST(RepeatedKeywords, arrays_of_a_wall_differ)
{
  const TemporaryFile file("apf_repeated");
  file.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    for (const char *name : {"distance_a", "distance_b"})
      w.array(name, {3, 3, 3}, std::vector<double>(27, 5.0));
  });
  const std::string wall = "fix w all wall/levelset file " + file.path;
  expect_second_is_refused("", wall + " array distance_a array distance_a" + law,
                           "array distance_a");
  expect_second_is_refused("", wall + law + "resolution 0.1 resolution 0.1", "resolution");
  Simulation sim;
  sim.run(sphere_in_air);
  EXPECT_EQ(sim.error_of(wall + " array distance_a array distance_b" + law), "");
}

TEST(RepeatedKeywords, that_add_something_each_time_are_taken)
{
  for (const auto &command :
       {floor_at_0 + law + "zone a lo zone b box move linear 0 0 0 move rotate 0 0 0 0 0 0",
        in + " outlet x 9 outlet z 8"}) {
    Simulation sim;
    sim.run(sphere_in_air);
    EXPECT_EQ(sim.error_of(command), "") << command;
  }
}
