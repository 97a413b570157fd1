// Lift, Magnus, added mass, pressure gradient and slip through LAMMPS. Facts: drift velocities, an
// independent Runge-Kutta integration of Maxey and Riley's equation, balance of momentum, collision
// steps.

#include "flow_scene.h"

#include "fix.h"

#include <array>
#include <functional>

namespace {

// A sphere of diameter 1 and mass pi/6 in the middle of a periodic box.
std::string sphere(double density = 1.0)
{
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
         "region box block 0 10 0 10 0 10\ncreate_box 1 box\ncreate_atoms 1 single 5 5 5\n"
         "set type 1 diameter 1.0 density " +
      digits(density) + "\npair_style zero 1.0 nocoeff\npair_coeff * *\nfix move all nve/sphere\n";
}

}    // namespace

TEST(FlowForces, added_mass_makes_relaxation_slower_by_half_the_density_ratio)
{
  // tau (1 + chi/2), chi = 0.385, tau = 1
  Simulation sim;
  sim.run(sphere() + "velocity all set 1 0 0\nfix air all flow/field uniform 0 0 0" +
          properties(0.385, 1.0 / 18.0) +
          "fix drag all flow/force air drag stokes added_mass yes\n" + timestep(0.002) +
          "run 1000\n");
  EXPECT_NEAR(sim.value("vx[1]"), std::exp(-2.0 / (1.0 + 0.385 / 2.0)), 2e-6);
  // momentum of the sphere changes by what the fix reports
  EXPECT_NEAR(sim.value("f_drag[22]"), sim.value("fx[1]"), 1e-14);
}

TEST(FlowForces, sphere_as_dense_as_the_fluid_moves_with_it)
{
  // no drag to speak of: pressure gradient and added mass alone accelerate it as the fluid
  Simulation sim;
  sim.run(sphere() + "variable u equal 0.3*step*dt\nfix air all flow/field uniform v_u 0 0" +
          properties(1.0, 1e-12) +
          "fix drag all flow/force air drag stokes added_mass yes pressure yes\n" + timestep(0.01) +
          "run 1\nvelocity all set 0.003 0 0\nrun 500\n");
  EXPECT_NEAR(sim.value("vx[1]") / (0.3 * 5.01), 1.0, 1e-3);
}

TEST(FlowForces, oscillating_fluid_against_runge_kutta)
{
  // (m + c_M m_f) v' = 3 pi mu d (u - v) + m_f (1 + c_M) u',  u = cos(3 t), of second order in dt
  const double chi = 0.385, m = pi / 6.0, k = pi / 6.0 * 2.0, mu = 2.0 / 18.0;
  auto rate = [&](double t, double v) {
    return (k * (std::cos(3 * t) - v) - 1.5 * chi * m * 3.0 * std::sin(3 * t)) /
        (m * (1.0 + 0.5 * chi));
  };
  double v = 1.0;
  const int n = 20000;
  const double time = 4.0, h = time / n;
  for (int i = 0; i < n; i++) {
    const double t = i * h, k1 = rate(t, v), k2 = rate(t + h / 2, v + h / 2 * k1),
                 k3 = rate(t + h / 2, v + h / 2 * k2), k4 = rate(t + h, v + h * k3);
    v += h / 6 * (k1 + 2 * k2 + 2 * k3 + k4);
  }
  auto error = [&](int steps) {
    Simulation sim;
    sim.run(sphere() + "variable u equal cos(3*step*dt)\nfix air all flow/field uniform v_u 0 0" +
            properties(chi, mu) +
            "fix drag all flow/force air drag stokes added_mass yes pressure yes\n" +
            timestep(time / steps) + "velocity all set 1 0 0\nrun " + std::to_string(steps) + "\n");
    return std::fabs(sim.value("vx[1]") - v);
  };
  // the rate of a variable is a difference backward in time: order one
  EXPECT_LT(error(4000), 1e-3);
  EXPECT_NEAR(std::log2(error(1000) / error(2000)), 1.0, 0.2);
}

TEST(FlowForces, saffman_drift)
{
  // physics: u = G y; pushed along x with slip V, it drifts with -0.17136 V d sqrt(G/nu)
  for (double G : {0.01, -0.01}) {
    const double V = 1e-3, mu = 1.0, k = 3.0 * pi * mu, nu = 1.0;
    Simulation sim;
    sim.run(sphere() + "fix air all flow/field shear x y " + digits(G) + " 5.0" +
            properties(1.0, mu) + "fix push all addforce " + digits(k * V) + " 0 0\n" +
            "fix drag all flow/force air drag stokes lift saffman\nfix_modify push energy no\n" +
            timestep(0.01) + "run 400\n");
    const double expected = -(G > 0 ? 1 : -1) * 0.17136 * V * std::sqrt(std::fabs(G) / nu);
    // drag along x also holds what the drift changes of u: relative 1e-4
    EXPECT_NEAR(sim.value("vy[1]") / expected, 1.0, 1e-3) << G;
    EXPECT_NEAR(sim.value("f_drag[8]") / (k * expected), 1.0, 1e-3) << G;
  }
}

TEST(FlowForces, magnus_drift)
{
  // fixed spin Om_z and slip V_x: v_y = d^2 Om_z V_x / (24 nu)
  const double V = 1e-3, Om = 0.3, k = 3.0 * pi;
  Simulation sim;
  sim.run(sphere() + "fix air all flow/field uniform 0 0 0" + properties(1.0, 1.0) +
          "fix push all addforce " + digits(k * V) + " 0 0\nset atom 1 omega 0 0 " + digits(Om) +
          "\nfix drag all flow/force air drag stokes magnus yes\n" + timestep(0.01) + "run 300\n");
  EXPECT_NEAR(sim.value("vy[1]") / (Om * V / 24.0), 1.0, 1e-3);
}

TEST(FlowForces, stiff_forces_have_their_fixed_points)
{
  // dt/tau = 1000: weight, lift and drag balance at once
  const double mu = 1000.0 / 18.0, k = 3.0 * pi * mu;
  Simulation sim;
  sim.run(sphere(3.0) + "fix air all flow/field shear x y 0.5 5.0" + properties(1.0, mu) +
          "fix drag all flow/force air drag stokes torque yes gravity 0 0 -9.81 magnus yes\n" +
          timestep(3.0) + "run 30\n");
  EXPECT_NEAR(sim.value("vz[1]") / (-2.0 * pi / 6.0 * 9.81 / k), 1.0, 1e-9);
  EXPECT_NEAR(gather(sim, "omega")[2], -0.25, 1e-9);
}

TEST(FlowForces, slip_lets_fine_particles_settle_faster)
{
  // 1 um in air at 20 C, 1000 kg/m^3: 3.48e-5 m/s (Hinds, Aerosol Technology, table A11)
  Simulation sim;
  sim.run("units si\natom_style sphere\natom_modify map array\nregion box block 0 2e-5 0 2e-5 0 "
          "2e-5\ncreate_box 1 box\ncreate_atoms 1 single 1e-5 1e-5 1e-5\n"
          "set type 1 diameter 1e-6 density 1000\npair_style zero 1e-6 nocoeff\npair_coeff * *\n"
          "neighbor 1e-6 bin\nfix move all nve/sphere\n"
          "fix air all flow/field uniform 0 0 0 density 1.2 viscosity 1.81e-5\n"
          "fix drag all flow/force air drag stokes gravity 0 0 -9.81 cunningham 6.6e-8\n"
          "timestep 1e-6\nrun 100\n");
  EXPECT_NEAR(-sim.value("vz[1]") / 3.48e-5, 1.0, 0.02);
}

TEST(FlowForces, hindered_settling)
{
  // beta = 3.7 at small Re; `superficial` leaves one power of 1 - c away
  for (const bool superficial : {false, true}) {
    Simulation sim;
    sim.run(sphere(2.0) + "fix air all flow/field uniform 0 0 0" + properties(1.0, 100.0) +
            "fix drag all flow/force air drag difelice " + (superficial ? "superficial " : "") +
            "concentration 0.1 gravity 0 0 -1\n" + timestep(0.1) + "run 200\n");
    const double free = pi / 6.0 / (3.0 * pi * 100.0);
    EXPECT_NEAR(-sim.value("vz[1]") / free, std::pow(0.9, superficial ? 2.7 : 3.7), 2e-4);
  }
}

TEST(FlowForces, columns_are_the_forces_that_the_script_names)
{
  Simulation sim;
  sim.run(sphere() +
          "velocity all set 0.3 0.1 0\nset atom 1 omega 1 2 3\n"
          "fix air all flow/field shear x y 0.7 0.0" +
          properties(0.5, 0.1) +
          "fix drag all flow/force air drag schiller torque yes gravity 0 0 -1 lift saffman magnus "
          "yes added_mass yes pressure yes brownian 0.1 77\n"
          "compute parts all reduce sum f_drag[1] f_drag[7] f_drag[10] f_drag[13] f_drag[16] "
          "f_drag[19] f_drag[22]\nthermo_style custom step c_parts[1]\n" +
          timestep(0.01) + "run 7\n");
  double sum = 0.0;
  for (int k = 1; k <= 7; k++) sum += sim.value("c_parts[" + std::to_string(k) + "]");
  EXPECT_NEAR(sum, sim.value("fx[1]"), 1e-13);
  for (int k = 0; k < 7; k++)
    EXPECT_NEAR(sim.value("c_parts[" + std::to_string(k + 1) + "]"),
                sim.value("f_drag[" + std::to_string(3 * k + 1) + "]"), 1e-13)
        << "the vector has their sums, in the same order";
  EXPECT_NEAR(sim.value("f_drag[22]"), sum, 1e-13);
  EXPECT_NE(sim.value("f_drag[19]"), 0.0);
}

TEST(FlowForces, without_a_per_atom_array_the_motion_is_the_same)
{
  double v[2], total[2];
  for (const bool with : {false, true}) {
    Simulation sim;
    sim.run(sphere() + "velocity all set 1 0 0\nfix air all flow/field uniform 0 0.5 0" +
            properties(0.385, 1.0 / 18.0) +
            "fix drag all flow/force air drag stokes torque yes peratom " +
            (with ? "yes\n" : "no\n") + timestep(0.01) + "run 50\n");
    v[with] = sim.value("vx[1]");
    total[with] = sim.value("f_drag[22]");
    const auto error = sim.error_of("compute sum all reduce sum f_drag[1]");
    EXPECT_EQ(error.empty(), with) << error;
    EXPECT_EQ(error.find("fix drag does not calculate per-atom values") == std::string::npos, with)
        << "as the page of the fix says: " << error;
  }
  EXPECT_EQ(v[0], v[1]);
  EXPECT_EQ(total[0], total[1]);
}

TEST(FlowForces, groups_of_scattered_atoms_get_what_all_together_get)
{
  // every second atom, so that a block is no rows one after another
  const std::string scene =
      "units lj\natom_style sphere\natom_modify map array\n"
      "region box block 0 10 0 10 0 10\ncreate_box 1 box\ncreate_atoms 1 random 150 77 box\n"
      "reset_atoms id sort yes\nset group all diameter 0.4 density 2\nset atom 1*70 diameter 0.3\n"
      "pair_style zero 1.0 nocoeff\npair_coeff * *\nfix move all nve/sphere\n"
      "velocity all create 1.0 99 loop geom\nset group all omega 1 2 3\n"
      "fix air all flow/field shear y x 0.5 0 density 0.5 viscosity 0.3\n"
      "variable odd atom id%2\ngroup odd variable odd\ngroup even subtract all odd\n";
  const std::string forces =
      " flow/force air drag schiller torque yes lift saffman magnus yes gravity 0 0 -1\n";
  std::vector<double> together[3];
  for (const bool scattered : {false, true}) {
    Simulation sim;
    sim.run(scene + (scattered ? "fix drag odd" : "fix drag all") + forces +
            (scattered ? "fix rest even" + forces : "") + "run 25\n");
    for (int k = 0; k < 3; k++) {
      const auto values = gather(sim, k == 0 ? "x" : k == 1 ? "v" : "omega");
      if (scattered)
        EXPECT_EQ(values, together[k]) << k;
      else
        together[k] = values;
    }
    const auto *fix = sim.lammps()->modify->get_fix_by_id("drag");
    for (int i = 0; i < 150; i++) {
      const double *row = fix->array_atom[i];
      const bool acts = !scattered || sim.lammps()->atom->tag[i] % 2 == 1;
      for (int column : {0, 5, 8, 10, 14}) EXPECT_EQ(row[column] != 0.0, acts) << i << column;
    }
  }
}

TEST(MtsFlowForces, doublet_with_added_mass_is_that_of_velocity_verlet)
{
  auto after = [](const std::string &integrate, int steps) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.985, 4.0, 4.0}});
    set_motion(sim, 1, {3.0, 0.5, 0.0}, {0.0, 0.0, 2.0});
    set_motion(sim, 2, {-3.0, 0.0, 0.2}, {0.0, 1.0, 0.0});
    sim.run("neighbor 0.5 bin\nfix air all flow/field shear x y 5.0 4.0 density 0.8 viscosity 0.3\n"
            "fix drag all flow/force air drag schiller torque yes added_mass yes pressure yes lift "
            "saffman magnus yes\n" +
            integrate + "run " + std::to_string(steps));
    return state_of(sim);
  };
  const State fine = after("fix nve all nve/sphere\n", 3200);
  const State mts16 = after(mts(16), 200);
  EXPECT_LT(difference(mts16.x, fine.x), 3e-5);
  EXPECT_LT(difference(mts16.v, fine.v), 2e-3);
  EXPECT_LT(difference(mts16.omega, fine.omega), 2e-3);
  const State mts4 = after(mts(4), 800);
  EXPECT_LT(difference(mts4.v, fine.v), difference(mts16.v, fine.v));
}

TEST(MtsFlowForces, contact_forces_are_untouched_by_added_mass)
{
  // at rest on a floor: the wall bears the weight, whatever moves along with the sphere
  for (const std::string &added : {std::string("no"), std::string("yes")}) {
    Scene scene;
    scene.boundary = "p p f";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr +
        "\nfix wall all wall/levelset plane z 0 NULL" + jkr + "damping tsuji 0.1 sliding 0.5\n";
    Simulation sim;
    build(sim, {{4.0, 4.0, 0.5 - Material().wall().delta_eq()}}, scene);
    sim.run("fix air all flow/field uniform 0 0 0 density 0.8 viscosity 0.01\n"
            "fix drag all flow/force air drag stokes gravity 0 0 -50 added_mass " +
            added + "\n" + mts(16) + "run 2000");
    EXPECT_NEAR(sim.value("f_wall[3]") / (-0.2 * pi / 6.0 * 50.0), 1.0, 1e-3) << added;
  }
}

TEST(FlowForces, added_mass_refuses_what_it_cannot_do)
{
  Simulation sim;
  sim.run(sphere() + "fix air all flow/field uniform 0 0 0" + properties(1.0, 1.0) +
          "fix drag all flow/force air drag stokes added_mass yes\nrun_style respa 2 2 pair 1\n");
  EXPECT_NE(sim.error_of("run 1").find("added_mass cannot work with run_style respa"),
            std::string::npos);
}

TEST(FlowForces, errors_name_what_is_wrong)
{
  const std::vector<std::array<std::string, 2>> rows = {
      {"lift mei", "lift must be saffman, got mei"},
      {"magnus on", "magnus must be yes or no, got on"},
      {"brownian -1 3", "temperature must be >= 0, got -1"},
      {"brownian 1 0", "seed must be > 0, got 0"},
      {"cunningham 0", "mean free path must be > 0, got 0"},
      {"concentration 0.1", "goes with drag difelice or feedback"}};
  for (const auto &row : rows) {
    Simulation sim;
    sim.run(sphere() + "fix air all flow/field uniform 0 0 0" + properties(1.0, 1.0));
    const auto text = sim.error_of("fix drag all flow/force air drag stokes " + row[0]);
    EXPECT_NE(text.find(row[1]), std::string::npos) << text;
  }
}

TEST(FlowForces, two_drags_on_the_same_particles_give_a_warning)
{
  const auto log = [](const std::string &group, const std::string &seed) {
    Simulation sim;
    sim.run(sphere() +
            "create_atoms 1 single 2 2 2\nset atom 2 diameter 1.0 density 1.0\n"
            "group one id 1\ngroup two id 2\nfix air all flow/field uniform 0 0 0" +
            properties(1.0, 1.0));
    return log_of(sim,
                  "fix a one flow/force air drag stokes brownian 1 7\nfix b " + group +
                      " flow/force air drag stokes brownian 1 " + seed + "\nrun 0\n");
  };
  const std::string both = "Fix flow/force a and fix b act on the same particles",
                    seeds = "have the same brownian seed 7";
  const auto same = log("all", "7"), differ = log("all", "8"), apart = log("two", "7");
  EXPECT_NE(same.find(both), std::string::npos) << same;
  EXPECT_NE(same.find(seeds), std::string::npos) << same;
  EXPECT_NE(differ.find(both), std::string::npos) << differ;
  EXPECT_EQ(differ.find(seeds), std::string::npos) << differ;
  EXPECT_EQ(apart.find("WARNING: Fix flow/force"), std::string::npos) << apart;
}

TEST(FlowForces, examples_pass)
{
  for (const std::string name : {"shear", "settling", "brownian"}) {
    const auto folder = scratch_file(name);
    std::filesystem::create_directory(folder);
    Simulation sim({"-var", "dir", folder, "-var", "N", "3000"});
    sim.run("include " APF_EXAMPLES "/" + name + "/in." + name + "\n");
    EXPECT_STREQ(
        static_cast<const char *>(lammps_extract_variable(sim.lammps(), "verdict", nullptr)),
        "pass")
        << name;
    std::filesystem::remove_all(folder);
  }
}

TEST(FlowForces, one_warning_counts_the_particles_beyond_a_law)
{
  // Re = |v - u| d/nu: 2 and 0.5 under stokes, 900 and 2 under schiller; lift: Re <= sqrt(Re_G)
  auto warnings = [](const std::string &forces, double fast, double slow) {
    Simulation sim;
    sim.run(sphere() +
            "create_atoms 1 single 2 2 2\nset atom 2 diameter 1.0 density 1.0\n"
            "fix air all flow/field shear x y 0.01 0 density 1 viscosity 1\n"
            "set atom 1 vx " +
            digits(fast + 0.05) + "\nset atom 2 vx " + digits(slow + 0.02) + "\n");
    std::istringstream log(
        log_of(sim, "fix drag all flow/force air " + forces + "\ntimestep 1e-9\nrun 3\n"));
    std::string text;
    for (std::string line; std::getline(log, line);)
      if (line.find("WARNING: Fix flow/force") == 0) text += line;
    return text;
  };
  const auto stokes = warnings("drag stokes", 2.0, 0.5);
  EXPECT_NE(stokes.find("drag stokes is meant for Re <= 1, exceeded by 1 of 2 particles"),
            std::string::npos)
      << stokes;
  EXPECT_EQ(stokes.find("WARNING", 1), std::string::npos) << "once in a run";
  const auto schiller = warnings("drag schiller", 900.0, 2.0);
  EXPECT_NE(schiller.find("schiller is meant for Re <= 800, exceeded by 1 of 2 particles"),
            std::string::npos)
      << schiller;
  const auto hindered = warnings("drag difelice concentration 0.1", 1.1, 0.9);
  EXPECT_NE(hindered.find("difelice is meant for Re <= 1, exceeded by 1 of 2"), std::string::npos)
      << hindered;
  EXPECT_EQ(warnings("drag difelice concentration 0.1", 0.9, 0.0), "");
  EXPECT_EQ(warnings("drag stokes", 0.5, 0.2), "");
  EXPECT_EQ(warnings("drag schiller", 700.0, 2.0), "");
  const auto lift = warnings("drag stokes lift saffman", 0.5, 0.05);
  EXPECT_NE(
      lift.find(": lift saffman is meant for Re <= 1, Re_G <= 1, Re <= sqrt(Re_G), not met by 1 of "
                "2 particles"),
      std::string::npos)
      << lift;
  const auto both = warnings("drag stokes lift saffman", 2.0, 1.5);
  EXPECT_NE(
      both.find("step 0: drag stokes is meant for Re <= 1, exceeded by 2 of 2 particles; lift "
                "saffman is meant"),
      std::string::npos)
      << both;
  EXPECT_EQ(warnings("drag stokes lift saffman", 0.05, 0.03), "");
}
