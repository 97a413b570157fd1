// Dense aggregates at the report's own time step (f3 = 0.1): many contacts on one particle raise
// its frequencies and add up their dashpots. An aggregate with motion in it must come to rest.

#include "simulation.h"

#include "gtest/gtest.h"

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

// The report's channel dust: d = 10 um, rho_p = 2600, U = 0.5 m/s, lambda = 1e4, dt = 2.5e-5 L/U.
std::string dust(double phi)
{
  const double nu = 0.3, E = 2.0 * (1.0 - nu * nu) * 1e4 * 2600 * 0.25;
  const double gamma = phi * 2600 * 0.25 * 5e-6;
  return "set group all diameter 1e-5 density 2600\npair_style granular/adhesive\npair_coeff 1 1 "
         "jkr " +
      std::to_string(E) + " 0.3 " + std::to_string(gamma) +
      " damping alpha 1.018 sliding 0.3\ntimestep 5e-8\nfix nve all nve/sphere\n";
}

std::string header(int dimension)
{
  return "units si\ndimension " + std::to_string(dimension) +
      "\natom_style sphere\natom_modify map array\ncomm_modify vel yes\nboundary p p p\n"
      "neighbor 3e-6 bin\nregion box block -1e-4 1e-4 -1e-4 1e-4 " +
      (dimension == 2 ? "-5e-6 5e-6" : "-1e-4 1e-4") + "\ncreate_box 1 box\n";
}

std::string at(double x, double y, double z)
{
  std::string text = "create_atoms 1 single";
  for (const double c : {x, y, z}) text += " " + std::to_string(c * 1e6) + "e-6";
  return text + " units box\n";
}

// distance of two at rest [m]; physics of JKR: overlap / r = (2/3) (9 pi phi / (4 lambda))^(2/3)
double spacing(double phi)
{
  return 5e-6 * (2.0 - 2.0 / 3.0 * std::pow(9.0 * M_PI * phi / 4e4, 2.0 / 3.0));
}

std::string hexagonal_flake(double phi)
{
  const double d = spacing(phi);
  std::string text;
  for (int row = 0; row < 4; row++)
    for (int k = 0; k < 4; k++)
      text += at(d * (k + 0.5 * (row % 2)), d * row * std::sqrt(0.75), 0.0);
  return text;
}

// a particle and its twelve neighbours in the FCC lattice
std::string fcc_cluster(double phi)
{
  const double h = spacing(phi) / std::sqrt(2.0);
  std::string text = at(0.0, 0.0, 0.0);
  for (const double a : {-h, h})
    for (const double b : {-h, h}) text += at(a, b, 0.0) + at(a, 0.0, b) + at(0.0, a, b);
  return text;
}

// no torques are left, and what turns then turns as one body
void expect_rest(const std::string &scene, int dimension, double phi)
{
  Simulation sim;
  sim.run(header(dimension) + scene + dust(phi) +
          "compute spin all erotate/sphere\ncompute w all property/atom tqx tqy tqz\n"
          "compute t all reduce maxabs c_w[*]\nvariable turn atom 2e4*(id%3-1)\n"
          "set group all omega 0 0 v_turn\nthermo_style custom step ke c_spin c_t[*]\nthermo "
          "100\nrun 100");
  const double energy = sim.value("ke") + sim.value("c_spin"), torque = sim.value("c_t[3]");
  ASSERT_GT(energy, 0.0);
  ASSERT_GT(torque, 0.0);
  sim.run("run 30000");
  EXPECT_LT(sim.value("ke"), energy) << "phi = " << phi;
  EXPECT_LT(sim.value("c_t[3]") / torque, 1e-3) << "phi = " << phi;
}

TEST(Stability, hexagonal_flake_comes_to_rest_at_the_reports_step)
{
  for (const double phi : {1.5, 15.0, 50.0, 150.0}) expect_rest(hexagonal_flake(phi), 2, phi);
}

// What limits the dashpots must not depend on when the neighbour list was built, or a run begun.
TEST(Stability, a_run_is_the_same_however_lists_and_runs_are_cut)
{
  auto energy = [](const std::string &commands) {
    Simulation sim;
    sim.run(header(2) + hexagonal_flake(50.0) + dust(50.0) +
            "variable turn atom 2e4*(id%3-1)\nset group all omega 0 0 v_turn\n"
            "compute spin all erotate/sphere\nthermo_style custom step ke c_spin\n" +
            commands);
    return sim.value("c_spin");
  };
  const double whole = energy("run 200");
  ASSERT_GT(whole, 0.0);
  for (const char *cut : {"run 1\nrun 199", "run 0\nrun 200", "run 100\nrun 100",
                          "neigh_modify delay 0 every 1 check no\nrun 200"})
    EXPECT_NEAR(energy(cut) / whole, 1.0, 1e-9) << cut;
}

// With time backwards a dashpot gives energy. A wall and a fluid without the pair style say so.
TEST(Stability, time_that_goes_backwards_is_refused)
{
  const std::string contacts = header(2) + hexagonal_flake(50.0) + dust(50.0),
                    alone = header(2) + at(0.0, 0.0, 0.0) +
      "set group all diameter 1e-5 density 2600\npair_style zero 2e-5 nocoeff\npair_coeff * *\n"
      "fix nve all nve/sphere\n",
                    step = "timestep -1e-8\nrun 1", pair = "Pair granular/adhesive",
                    sub_steps = "unfix nve\nfix nve all nve/sphere/mts collision ";
  const std::vector<std::array<std::string, 2>> table = {
      {contacts, pair},
      {contacts + "run_style respa 2 4 pair 1\n", pair},
      {contacts + sub_steps + "10\n", pair},
      {contacts + sub_steps + "auto\n", pair},
      {contacts + sub_steps + "tolerance 0.01\n", pair},
      {alone + "fix floor all wall/levelset cylinder z 0 -5e-5 1e-5 outside jkr 1e7 0.3 0.01\n",
       "Fix wall/levelset floor"},
      {alone +
           "fix air all flow/field uniform 1 0 0 density 1 viscosity 1e-5\n"
           "fix drag all flow/force air drag stokes\n",
       "Fix flow/force drag"}};
  for (const auto &[scene, who] : table) {
    Simulation sim;
    const auto error = sim.error_of(scene + step);
    EXPECT_NE(error.find(who + ": timestep must be >= 0, got -1e-08"), std::string::npos)
        << scene << error;
    EXPECT_EQ(sim.error_of("timestep 0.0\nrun 1"), "");
  }
}

TEST(Stability, twelve_contacts_on_a_particle_come_to_rest_at_the_reports_step)
{
  for (const double phi : {1.5, 15.0, 50.0, 150.0}) expect_rest(fcc_cluster(phi), 3, phi);
}

}    // namespace
