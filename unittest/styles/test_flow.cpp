// fix flow/field and fix flow/force through LAMMPS. Facts: closed forms of Stokes relaxation,
// settling and spin-up, a damped oscillator, momentum balance, r-RESPA against velocity Verlet.

#include "simulation.h"

#include "gtest/gtest.h"

#include <cmath>
#include <functional>
#include <sstream>
#include <string>
#include <vector>

namespace {

constexpr double pi = 3.14159265358979323846;

// A sphere with d = 1 and mass pi/6 at (5,5,5); in a fluid of viscosity mu = 1/18 its relaxation
// time is rho d^2/(18 mu) = 1, and 0.3 for its spin.
const std::string one_sphere = R"(
units lj
atom_style sphere
atom_modify map array
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 5 5 5
set type 1 diameter 1.0 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
)";
const std::string fluid = " density 0.5 viscosity $(1/18)\n";
const double resistance = pi / 6.0;                                // 3 pi mu d
const std::string syrup = " density 0.5 viscosity $(1e4/18)\n";    // tau = 1e-4

std::string timestep(double dt)
{
  std::ostringstream text;
  text.precision(17);
  text << "timestep " << dt << "\n";
  return text.str();
}

// observed order between steps of length t/n and t/2n
double order(const std::function<double(int)> &error, int n)
{
  return std::log2(std::fabs(error(n)) / std::fabs(error(2 * n)));
}

}    // namespace

TEST(FlowForce, velocity_relaxes_as_exp)
{
  Simulation sim;
  sim.run(one_sphere + "velocity all set -3 1 0.5\n");
  sim.run("fix flow all flow/field uniform 1 2 3" + fluid +
          "fix drag all flow/force flow drag stokes\n" + timestep(0.01) + "run 150\n");
  const double decay = std::exp(-1.5);
  EXPECT_NEAR(sim.value("vx[1]"), 1.0 - 4.0 * decay, 2e-5);
  EXPECT_NEAR(sim.value("vy[1]"), 2.0 - 1.0 * decay, 2e-5);
  EXPECT_NEAR(sim.value("vz[1]"), 3.0 - 2.5 * decay, 2e-5);
  EXPECT_NEAR(sim.value("x[1]"), 5.0 + 1.5 - 4.0 * (1.0 - decay), 2e-5);
}

TEST(FlowForce, ten_micrometre_sphere_settles_at_seven_millimetres_per_second)
{
  const double v = 1e-10 * (2600.0 - 1.2) * 9.81 / (18.0 * 2e-5);    // d^2 (rho_p - rho_f) g/18 mu
  EXPECT_NEAR(v, 7.0817e-3, 1e-7);
  for (double ratio : {0.01, 10.0, 1000.0}) {    // timestep/tau
    Simulation sim;
    sim.run(R"(
units si
atom_style sphere
atom_modify map array
region box block 0 1 0 1 0 1
create_box 1 box
create_atoms 1 single 0.5 0.5 0.5
set type 1 diameter 10e-6 density 2600
pair_style zero 0.1 nocoeff
pair_coeff * *
neighbor 0.1 bin
fix move all nve/sphere
fix air all flow/field uniform 0 0 0 density 1.2 viscosity 2e-5
fix drag all flow/force air drag stokes gravity 0 0 -9.81
)");
    sim.run("timestep $(" + std::to_string(ratio) + "*1e-10*2600/(18*2e-5))\n" +
            (ratio < 1.0 ? "run 4000\n" : "run 40\n"));
    EXPECT_NEAR(sim.value("vz[1]") / -v, 1.0, 1e-12) << "timestep/tau = " << ratio;
    EXPECT_EQ(sim.value("vx[1]"), 0.0);
  }
}

TEST(FlowForce, sphere_lighter_than_the_fluid_rises)
{
  Simulation sim;
  sim.run(one_sphere +
          "fix flow all flow/field uniform 0 0 0 density 3 viscosity $(1/18)\n"
          "fix drag all flow/force flow drag stokes gravity 0 -1 0\n" +
          timestep(1.0) + "run 60\n");
  EXPECT_NEAR(sim.value("vy[1]"), 2.0, 1e-12);    // (rho_f/rho_p - 1) g tau
}

TEST(FlowForce, spin_approaches_half_the_vorticity)
{
  Simulation sim;
  sim.run(one_sphere + "fix flow all flow/field shear y z 4 5" + fluid +
          "fix drag all flow/force flow drag stokes torque yes\n" + timestep(0.002) + "run 300\n");
  // u_y grows with z: the curl is -4 along x
  EXPECT_NEAR(sim.value("F_drag[1][1]"), 0.0, 1e-12);
  const auto *omega = sim.lammps()->atom->omega[0];
  EXPECT_NEAR(omega[0], -2.0 * (1.0 - std::exp(-0.6 / 0.3)), 1e-5);
  EXPECT_EQ(omega[1], 0.0);
  EXPECT_EQ(omega[2], 0.0);
}

TEST(FlowForce, stiff_spin_reaches_half_the_vorticity_exactly)
{
  Simulation sim;
  sim.run(one_sphere + "fix flow all flow/field shear x y 4 5" + fluid +
          "fix drag all flow/force flow drag stokes torque yes\n" + timestep(300.0) + "run 40\n");
  EXPECT_NEAR(sim.lammps()->atom->omega[0][2] / -2.0, 1.0, 1e-12);
}

TEST(FlowForce, without_torque_a_sphere_does_not_turn)
{
  Simulation sim;
  sim.run(one_sphere + "fix flow all flow/field shear x y 4 5" + fluid +
          "fix drag all flow/force flow drag stokes\n" + timestep(0.1) + "run 10\n");
  EXPECT_EQ(sim.lammps()->atom->omega[0][2], 0.0);
}

TEST(FlowForce, stiff_drag_never_overshoots)
{
  for (const std::string law : {"stokes", "schiller"})
    for (double ratio : {10.0, 1000.0}) {
      Simulation sim;
      sim.run(one_sphere + "velocity all set 10 0 0\nfix flow all flow/field uniform 1 0 0" +
              syrup + "fix drag all flow/force flow drag " + law + "\n" + timestep(1e-4 * ratio) +
              "neigh_modify delay 0 every 1 check no\nrun 0\n");
      double before = 10.0;
      for (int step = 0; step < 60; step++) {
        sim.run("run 1 pre no post no");
        const double now = sim.lammps()->atom->v[0][0];
        EXPECT_LE(now, before * (1.0 + 1e-14)) << law << " step " << step;
        EXPECT_GE(now, 1.0 - 1e-12) << law << " step " << step;
        before = now;
      }
      EXPECT_NEAR(before, 1.0, 1e-12) << law << " timestep/tau = " << ratio;
    }
}

// A constant force of another fix, defined before, takes part in the exact solution.
TEST(FlowForce, terminal_velocity_under_a_force_of_another_fix_is_exact)
{
  for (double ratio : {0.5, 10.0, 1000.0}) {    // timestep/tau
    Simulation sim;
    sim.run(one_sphere + "fix pull all addforce 0 0 1e3\nfix flow all flow/field uniform 1 0 0" +
            syrup + "fix drag all flow/force flow drag stokes\n" + timestep(1e-4 * ratio) +
            "run 100\n");
    EXPECT_NEAR(sim.value("vz[1]") / (1e3 / (1e4 * resistance)), 1.0, 1e-12) << ratio;
    EXPECT_NEAR(sim.value("f_drag[3]") / -1e3, 1.0, 1e-12) << "drag balances the pull";
  }
}

// A sphere that a spring holds in a wind: the drag is 3 pi mu d u, however long the step.
TEST(FlowForce, held_sphere_feels_the_full_drag)
{
  const double drag = 1e4 * resistance * 100.0;
  for (double ratio : {0.1, 1.0, 10.0}) {    // timestep/tau
    Simulation sim;
    sim.run(one_sphere +
            "fix spring all spring/self $(2e6*PI/6)\n"
            "fix flow all flow/field uniform 100 0 0" +
            syrup + "fix drag all flow/force flow drag stokes\n" + timestep(1e-4 * ratio) +
            "run $(round(0.2/dt))\n");
    EXPECT_NEAR(sim.value("x[1]"), 5.5, 1e-12) << ratio;
    EXPECT_NEAR(sim.value("f_drag[1]") / drag, 1.0, 1e-12) << ratio;
  }
}

TEST(FlowForce, order_is_two_in_a_sheared_flow)
{
  // y relaxes from v_y = 0.8, and x follows G y: closed form
  const double G = 1.5, w = 0.8, t = 1.0, decay = std::exp(-t);
  const double exact = G * w * (1.0 - decay) - G * w * t * decay;
  auto error = [&](int n) {
    Simulation sim;
    sim.run(one_sphere + "velocity all set 0 0.8 0\nfix flow all flow/field shear x y 1.5 5" +
            fluid + "fix drag all flow/force flow drag stokes torque yes\n" + timestep(t / n) +
            "run " + std::to_string(n) + "\n");
    return sim.value("vx[1]") - exact;
  };
  EXPECT_NEAR(order(error, 8), 2.0, 0.1);
  EXPECT_NEAR(order(error, 16), 2.0, 0.1);
  EXPECT_LT(std::fabs(error(32)), 1e-3);
}

TEST(FlowForce, order_is_two_with_forces_of_others)
{
  // oscillator x'' + x' + 4 x = 4 * 5, x(0) = 5, x'(0) = 1: closed form
  const double t = 2.0, q = std::sqrt(4.0 - 0.25);
  const double exact = 5.0 + std::exp(-0.5 * t) * std::sin(q * t) / q;
  auto error = [&](int n) {
    Simulation sim;
    sim.run(one_sphere +
            "velocity all set 1 0 0\nfix spring all spring/self $(4*PI/6)\n"
            "fix flow all flow/field uniform 0 0 0" +
            fluid + "fix drag all flow/force flow drag stokes\n" + timestep(t / n) + "run " +
            std::to_string(n) + "\n");
    return sim.value("x[1]") - exact;
  };
  EXPECT_NEAR(order(error, 32), 2.0, 0.1);
  EXPECT_NEAR(order(error, 64), 2.0, 0.1);
  EXPECT_LT(std::fabs(error(128)), 1e-3);
}

TEST(FlowForce, order_is_two_with_nonlinear_drag)
{
  // x' = v, v' = -v (1 + 0.15 (9 v)^0.687); independent integration with Runge-Kutta's method
  auto rate = [](double v) {
    return -v * (1.0 + 0.15 * std::pow(9.0 * v, 0.687));
  };
  double exact = 4.0;
  const int steps = 20000;
  const double h = 1.0 / steps;
  for (int i = 0; i < steps; i++) {
    const double a = rate(exact), b = rate(exact + 0.5 * h * a), c = rate(exact + 0.5 * h * b);
    exact += h / 6.0 * (a + 2.0 * b + 2.0 * c + rate(exact + h * c));
  }
  auto error = [&](int n) {
    Simulation sim;
    sim.run(one_sphere + "velocity all set 4 0 0\nfix flow all flow/field uniform 0 0 0" + fluid +
            "fix drag all flow/force flow drag schiller\n" + timestep(1.0 / n) + "run " +
            std::to_string(n) + "\n");
    return sim.value("vx[1]") - exact;
  };
  EXPECT_NEAR(order(error, 16), 2.0, 0.1);
  EXPECT_NEAR(order(error, 32), 2.0, 0.1);
  EXPECT_LT(std::fabs(error(64)), 1e-3);
}

TEST(FlowForce, each_size_and_density_has_its_own_time)
{
  Simulation sim;
  sim.run(one_sphere +
          "create_atoms 1 single 2 2 2\ncreate_atoms 1 single 8 8 8\n"
          "create_atoms 1 single 2 8 2\ncreate_atoms 1 single 8 2 8\n"
          "set atom 2 diameter 2.0\nset atom 2*3 density 3.0\nset atom 3 diameter 1.0\n"
          "set atom 4 diameter 0.5 density 2.0\nset atom 5 diameter 1.0 density 1.0\n"
          "fix flow all flow/field uniform 1 0 0" +
          fluid + "fix drag all flow/force flow drag stokes\n" + timestep(0.001) + "run 500\n");
  const double tau[] = {1.0, 12.0, 3.0, 0.5, 1.0};    // rho d^2
  for (int i = 1; i <= 5; i++)
    EXPECT_NEAR(sim.value("vx[" + std::to_string(i) + "]"), 1.0 - std::exp(-0.5 / tau[i - 1]), 1e-6)
        << "atom " << i;
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

TEST(FlowField, speed_may_be_a_variable)
{
  for (const std::string style : {"", "run_style respa 2 2\n"}) {
    Simulation sim;
    sim.run(one_sphere + "variable u equal step*0.1\nfix flow all flow/field channel x y 0 10 v_u" +
            fluid + "fix drag all flow/force flow drag stokes\n" + style + timestep(1e-6) +
            "run 20\n");
    EXPECT_NEAR(sim.value("f_flow[1]"), 2.0, 1e-15);
    EXPECT_NEAR(sim.value("f_drag[1]"), 2.0 * resistance, 1e-4);    // in the middle, still at rest
    EXPECT_EQ(sim.value("f_flow[4]"), 0.5);
    EXPECT_NEAR(sim.value("f_flow[5]"), 1.0 / 18.0, 1e-15);
  }
}

TEST(FlowField, fluid_outside_the_walls_is_at_rest)
{
  Simulation sim;
  sim.run(one_sphere +
          "create_atoms 1 single 5 9 5\nset atom 2 diameter 1 density 1\n"
          "fix flow all flow/field channel x y 2 8 1" +
          fluid + "fix drag all flow/force flow drag stokes\n" + timestep(1e-6) + "run 1\n");
  EXPECT_EQ(sim.value("fx[2]"), 0.0);
  EXPECT_NEAR(sim.value("fx[1]"), resistance, 1e-5);
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

TEST(FlowInput, errors_name_what_is_wrong)
{
  const std::string field = "fix flow all flow/field uniform 1 0 0 density 1 viscosity 1\n";
  const std::string force = field + "fix drag all flow/force flow ";
  const struct {
    std::string input, message;
  } table[] = {
      {"fix f all flow/field", "missing argument"},
      {"fix f all flow/field whirl 1", "channel, pipe, uniform, shear or file, got whirl"},
      {"fix f all flow/field channel x y 0 1", "fix flow/field channel command: missing argument"},
      {"fix f all flow/field channel x x 0 1 1 density 1 viscosity 1",
       "wall axis must differ from flow axis x"},
      {"fix f all flow/field channel a y 0 1 1 density 1 viscosity 1",
       "axis must be x, y or z, got a"},
      {"fix f all flow/field channel x y 1 0 1 density 1 viscosity 1",
       "upper wall must be > lower wall 1, got 0"},
      {"fix f all flow/field channel x y 0 one 1 density 1 viscosity 1", "instead of 'one'"},
      {"fix f all flow/field pipe z 0 0 0 1 density 1 viscosity 1", "radius must be > 0, got 0"},
      {"fix f all flow/field pipe z 0 0 -2 1 density 1 viscosity 1", "radius must be > 0, got -2"},
      {"fix f all flow/field pipe z 0 0", "fix flow/field pipe command: missing argument"},
      {"fix f all flow/field uniform 1 0", "fix flow/field uniform command: missing argument"},
      {"fix f all flow/field uniform 1 0 u density 1 viscosity 1", "instead of 'u'"},
      {"fix f all flow/field shear x x 1 0 density 1 viscosity 1",
       "gradient axis must differ from flow axis x"},
      {"fix f all flow/field shear x y 1", "fix flow/field shear command: missing argument"},
      {"fix f all flow/field uniform 1 0 0 viscosity 1", "requires keyword density"},
      {"fix f all flow/field uniform 1 0 0 density 1", "requires keyword viscosity"},
      {"fix f all flow/field uniform 1 0 0 density 0 viscosity 1", "density must be > 0, got 0"},
      {"fix f all flow/field uniform 1 0 0 density 1 viscosity -1",
       "viscosity must be > 0, got -1"},
      {"fix f all flow/field uniform 1 0 0 density 1 viscosity",
       "fix flow/field viscosity command: missing argument"},
      {"fix f all flow/field uniform 1 0 0 density 1 loop yes",
       "keyword must be density or viscosity, got loop"},
      {"fix f all flow/field uniform v_no 0 0 density 1 viscosity 1\nrun 0",
       "variable no does not exist"},
      {"variable a atom x\nfix f all flow/field uniform v_a 0 0 density 1 viscosity 1\nrun 0",
       "variable a must be of style equal"},
      {"fix drag all flow/force", "missing argument"},
      {"fix drag all flow/force none drag stokes", "field fix none does not exist"},
      {"fix drag all flow/force move drag stokes",
       "field fix move must be of style flow/field, got nve/sphere"},
      {force, "requires keyword drag"},
      {force + "drag", "fix flow/force drag command: missing argument"},
      {force + "drag oseen", "drag must be stokes, schiller or difelice, got oseen"},
      {force + "drag difelice", "drag difelice requires keyword concentration"},
      {force + "drag stokes torque", "fix flow/force torque command: missing argument"},
      {force + "drag stokes torque maybe", "torque must be yes or no, got maybe"},
      {force + "drag stokes gravity 0 0", "fix flow/force gravity command: missing argument"},
      {force + "drag stokes gravity 0 0 down", "instead of 'down'"},
      {force + "drag stokes feedback yes", "feedback yes takes the grid of fix flow/concentration"},
      {force + "drag stokes wake yes", "or feedback, got wake"},
      {force + "drag stokes\nunfix flow\nrun 0", "field fix flow does not exist"},
      {force + "drag stokes\nunfix move\nset type 1 diameter 0\nrun 0",
       "radius > 0, got 1 of radius 0"},
  };
  for (const auto &row : table) {
    Simulation sim;
    sim.run(one_sphere);
    const std::string error = sim.error_of(row.input);
    EXPECT_NE(error.find(row.message), std::string::npos) << row.input << "\ngave: " << error;
  }
}

TEST(FlowInput, errors_of_plane_simulations)
{
  const std::string plane = "units lj\ndimension 2\natom_style sphere\n"
                            "region box block 0 1 0 1 -0.5 0.5\ncreate_box 1 box\n";
  const std::string fluid = " density 1 viscosity 1\n";
  const struct {
    std::string input, message;
  } table[] = {
      {"fix f all flow/field channel x z 0 1 1" + fluid, "x or y in a 2d simulation, got z"},
      {"fix f all flow/field shear z y 1 0" + fluid, "x or y in a 2d simulation, got z"},
      {"fix f all flow/field pipe x 0 0 1 1" + fluid, "pipe requires a 3d simulation"},
      {"fix f all flow/field uniform 0 0 1" + fluid, "z velocity must be 0 in a 2d simulation"},
      {"fix f all flow/field uniform 1 0 0" + fluid +
           "fix d all flow/force f drag stokes gravity 0 0 -1",
       "gravity along z must be 0 in a 2d simulation, got -1"},
  };
  for (const auto &row : table) {
    Simulation sim;
    sim.run(plane);
    const std::string error = sim.error_of(row.input);
    EXPECT_NE(error.find(row.message), std::string::npos) << row.input << "\ngave: " << error;
  }
}

TEST(FlowInput, errors_of_units_and_atom_style)
{
  const std::string box = "region box block 0 1 0 1 0 1\ncreate_box 1 box\n";
  const std::string flow = "fix f all flow/field uniform 1 0 0 density 1 viscosity 1\n"
                           "fix d all flow/force f drag stokes\nrun 0\n";
  auto error = [&](const std::string &start) {
    Simulation sim;
    return sim.error_of(start + box + flow);
  };
  EXPECT_NE(error("atom_style atomic\n").find("requires atom_style sphere, got atomic"),
            std::string::npos);
  EXPECT_NE(error("units real\natom_style sphere\n").find("force = mass * acceleration"),
            std::string::npos);
  EXPECT_NE(error("units real\natom_style sphere\n").find("got real"), std::string::npos);
}
