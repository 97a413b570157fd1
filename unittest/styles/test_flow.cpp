// fix flow/field and fix flow/force through LAMMPS. Facts: closed forms of Stokes relaxation,
// settling and spin-up, a damped oscillator, second order in the time step.

#include "flow_scene.h"

#include <functional>

namespace {

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

// 1/0 and inf - inf from step 4 on, under each integrator
TEST(FlowField, speed_that_is_no_finite_number)
{
  for (const std::string style : {"", "run_style respa 2 2\n", "mts"})
    for (const std::string flow : {"channel x y 0 10 v_u", "uniform 0 v_u 0", "shear x y v_u 5"})
      for (const std::string u : {"exp(1000*(step>3))", "exp(1000*(step>3))-exp(1001*(step>3))"}) {
        SCOPED_TRACE(style + flow + u);
        std::string scene = one_sphere;
        if (style == "mts")
          scene += "comm_modify vel yes\npair_style granular/adhesive\n"
                   "pair_coeff * * jkr 1e4 0.3 0.1\nunfix move\n"
                   "fix move all nve/sphere/mts collision 2\n";
        else
          scene += style;
        Simulation sim;
        sim.run(scene + "variable u equal " + u + "\nfix flow all flow/field " + flow + fluid +
                "fix drag all flow/force flow drag stokes\n" + timestep(1e-6));
        EXPECT_EQ(sim.error_of("run 3\n"), "");
        const auto said = sim.error_of("run 10\n");
        EXPECT_NE(said.find("Fix flow/field flow: variable u is "), said.npos) << said;
        EXPECT_NE(said.find(" at step 4"), said.npos) << said;
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
