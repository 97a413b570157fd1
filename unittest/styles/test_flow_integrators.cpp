// fix flow/force with the integrators and dimensions of LAMMPS, and what it reports. Facts: r-RESPA
// against velocity Verlet, balance of momentum, closed forms, the same sums on any number of ranks.

#include "flow_scene.h"

TEST(FlowForce, plane_simulation_stays_in_its_plane)
{
  Simulation sim;
  sim.run("units lj\ndimension 2\natom_style sphere\nregion box block 0 10 0 10 -0.5 0.5\n"
          "create_box 1 box\ncreate_atoms 1 single 5 5 0\nset type 1 diameter 1 density 1\n"
          "pair_style zero 1.0 nocoeff\npair_coeff * *\nfix move all nve/sphere\n"
          "fix flow all flow/field channel x y 4 8 2" +
          fluid + "fix drag all flow/force flow drag schiller torque yes gravity 0 -1 0\n");
  auto *atom = sim.lammps()->atom;
  for (int k = 0; k < 3; k++) atom->omega[0][k] = 1.0;
  atom->v[0][2] = 1.0;
  sim.run(timestep(0.01) + "run 0\n");
  EXPECT_EQ(atom->f[0][2], 0.0);
  EXPECT_EQ(atom->torque[0][0], 0.0);
  EXPECT_EQ(atom->torque[0][1], 0.0);
  EXPECT_LT(atom->torque[0][2], -0.1);
  EXPECT_GT(atom->f[0][0], 0.1);
  EXPECT_LT(atom->f[0][1], -0.1);
}

// Forces at the outermost level of r-RESPA act with its step: the same motion as with Verlet.
TEST(FlowForce, respa_equals_verlet_at_the_level_of_the_fix)
{
  const std::string flow = "velocity all set 1 2 3\nfix flow all flow/field uniform -1 2 1" +
      fluid + "fix drag all flow/force flow drag schiller torque yes gravity 0 0 -1\n";
  auto end = [&](const std::string &style, double dt, int n) {
    Simulation sim;
    sim.run(one_sphere + flow + style + timestep(dt) + "run " + std::to_string(n) + "\n");
    return std::vector<double>{sim.value("x[1]"), sim.value("y[1]"), sim.value("z[1]"),
                               sim.value("vx[1]"), sim.value("vz[1]")};
  };
  const auto outer = end("run_style respa 2 4\n", 0.4, 10);
  const auto inner = end("run_style respa 2 4\nfix_modify drag respa 1\n", 0.4, 10);
  const auto coarse = end("", 0.4, 10);
  const auto fine = end("", 0.1, 40);
  for (size_t k = 0; k < outer.size(); k++) {
    EXPECT_NEAR(outer[k], coarse[k], 1e-12) << k;
    EXPECT_NEAR(inner[k], fine[k], 1e-12) << k;
  }
  EXPECT_GT(std::fabs(coarse[3] - fine[3]), 1e-4) << "the levels cannot be told apart";
}

TEST(FlowForce, spin_in_respa_equals_verlet)
{
  auto end = [&](const std::string &style) {
    Simulation sim;
    sim.run(one_sphere + "fix flow all flow/field shear x y 4 5" + fluid +
            "fix drag all flow/force flow drag stokes torque yes\n" + style + timestep(0.2) +
            "run 3\n");
    return sim.lammps()->atom->omega[0][2];
  };
  const double verlet = end("");
  EXPECT_NEAR(end("run_style respa 2 4\n"), verlet, 1e-13);
  EXPECT_LT(verlet, -1.0);
}

TEST(FlowForce, virial_counts_only_on_request)
{
  auto pressure = [](const std::string &modify) {
    Simulation sim;
    sim.run(one_sphere + "fix flow all flow/field uniform 2 0 0" + fluid +
            "fix drag all flow/force flow drag stokes\n" + modify +
            "compute p all pressure NULL virial\nthermo_style custom step c_p[1]\n" +
            timestep(1e-9) + "run 0\n");
    return sim.value("c_p[1]");
  };
  EXPECT_EQ(pressure(""), 0.0);
  // virial stress F x/V with F = 3 pi mu d u at x = 5 in a box of volume 1000
  EXPECT_NEAR(pressure("fix_modify drag virial yes\n"), 2.0 * resistance * 5.0 / 1000.0, 1e-9);
}

TEST(FlowForce, per_atom_output_is_the_force_and_others_have_none)
{
  Simulation sim;
  sim.run(one_sphere +
          "create_atoms 1 single 2 3 4\nset atom 2 diameter 1.0 density 1.0\n"
          "group some id 2\nvelocity all set 0.3 0.1 -0.2\n"
          "fix flow all flow/field channel x y 0 10 2" +
          fluid + "fix drag some flow/force flow drag stokes torque yes gravity 0 0 -2\n" +
          timestep(0.01) + "compute turn all property/atom tqz\nrun 7\n");
  const double weight = -2.0 * 0.5 * pi / 6.0;
  const char axis[] = "xyz";
  for (int k = 0; k < 3; k++) {
    const std::string column = "[" + std::to_string(k + 1) + "]";
    const std::string f = std::string("f") + axis[k];
    EXPECT_NEAR(sim.value(f + "[2]"), sim.value("F_drag[2]" + column) + (k == 2 ? weight : 0.0),
                1e-14);
    EXPECT_EQ(sim.value(f + "[1]"), 0.0);
    EXPECT_EQ(sim.value("F_drag[1]" + column), 0.0);
    EXPECT_EQ(sim.value("f_drag" + column), sim.value("F_drag[2]" + column));
  }
  EXPECT_EQ(sim.value("C_turn[2]"), sim.value("F_drag[2][6]"));
  // slower and turning slower than the fluid at y = 3: u = 2*4*0.3*0.7, vorticity -0.32
  EXPECT_NEAR(sim.value("F_drag[2][1]"), resistance * (1.68 - 0.3), 0.1);
  EXPECT_NEAR(sim.value("F_drag[2][6]"), -pi / 18.0 * 0.16, 0.01);
  EXPECT_NEAR(sim.value("f_drag[6]"), weight, 1e-14);
  EXPECT_EQ(sim.value("F_drag[1][6]"), 0.0);
}

TEST(FlowForce, momentum_changes_by_the_reported_forces)
{
  Simulation sim;
  sim.run(one_sphere + "velocity all set 0.3 0.1 -0.2\nfix flow all flow/field pipe z 4 4 5 2" +
          fluid + "fix drag all flow/force flow drag schiller gravity 1 2 3\n" + timestep(0.05) +
          "variable force equal f_drag[3]+f_drag[6]\nfix sum all ave/time 1 9 9 v_force\nrun 0\n");
  // velocity Verlet: sum of forces over the steps, the first and the last counted half
  const double first = sim.value("v_force"), start = sim.value("vz[1]");
  sim.run("run 9\n");
  const double last = sim.value("v_force");
  const double sum = 9.0 * sim.value("f_sum") + 0.5 * first - 0.5 * last;
  EXPECT_NEAR(pi / 6.0 * (sim.value("vz[1]") - start), 0.05 * sum, 1e-14);
  EXPECT_GT(std::fabs(sum), 0.1);
}

TEST(RanksFlowForce, sums_do_not_depend_on_ranks)
{
  Simulation sim;
  sim.run(R"(
units lj
atom_style sphere
atom_modify map array
region box block 0 20 0 20 0 20
create_box 1 box
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
fix flow all flow/field uniform 3 0 0 density 0.5 viscosity $(1/18)
fix drag all flow/force flow drag stokes gravity 0 0 -1
create_atoms 1 random 20000 4321 box
set type 1 diameter 1 density 1
timestep 0.1
run 40
)");
  // every sphere moves alike; gravity less buoyancy is m/2. They are more than LAMMPS had room for
  // when the fix was defined.
  EXPECT_NEAR(sim.value("f_drag[6]") / (-20000.0 * 0.5 * pi / 6.0), 1.0, 1e-12);
  const double slip = 3.0 * std::exp(-4.0);
  EXPECT_NEAR(sim.value("f_drag[1]") / (20000.0 * resistance * slip), 1.0, 0.1);
  EXPECT_NEAR(sim.value("vcm(all,x)"), 3.0 - slip, 1e-3);
}
