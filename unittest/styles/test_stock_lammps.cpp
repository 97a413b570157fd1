// What granular styles of LAMMPS itself do not do and ours claim to: ours on the scene, and stock
// beside it (tests Stock_*), so that a LAMMPS that does it is noticed. Seen in 4 Jul 2026.

#include "scenes.h"

namespace {

const Material material;
const std::string stock_jkr =
    "pair_style granular\npair_coeff * * jkr 1.0e6 0 0.25 100 tangential mindlin NULL 0 0.3 "
    "rolling sds 2000 0 0.02 twisting marshall\n";

Scene scene_with(const std::string &style, const std::string &boundary = "p p p")
{
  Scene scene;
  scene.style = style;
  scene.boundary = boundary;
  return scene;
}

std::string number(double value)
{
  char text[32];
  snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

// as in 20260704
int release()
{
  Simulation sim;
  return lammps_version(sim.lammps());
}

// ---------------------------------------------------------------------------------------------
// the neck

// force on sphere 1 at a separation, after a contact; positive pulls it to the other
double pull_at(const std::string &style, double separation)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}}, scene_with(style));
  sim.run("group second id 2\nrun 1\ndisplace_atoms second move " + number(0.01 + separation) +
          " 0 0 units box\nrun 1");
  return gather(sim, "f")[0] / material.pair().F_C();
}

TEST(StockLammps, neck_reaches_to_delta_C)
{
  const double delta_C = material.pair().delta_C();
  EXPECT_NEAR(pull_at(adhesive, 0.25 * delta_C), 0.971515, 1e-5);    // table A5
  EXPECT_NEAR(pull_at(adhesive, 0.75 * delta_C), 0.944634, 1e-3);
  EXPECT_NEAR(pull_at(adhesive, 0.99 * delta_C), 0.648741, 1e-5);
  EXPECT_EQ(pull_at(adhesive, 1.001 * delta_C), 0.0);
}

TEST(Stock_StockLammps, neck_ends_at_the_force_maximum)
{
  const double delta_C = material.pair().delta_C();
  EXPECT_NEAR(pull_at(stock_jkr, 0.47 * delta_C), 1.0, 0.001);
  EXPECT_EQ(pull_at(stock_jkr, 0.49 * delta_C), 0.0);
}

// relative speed after a head-on impact over that before
double restitution(const std::string &style, double v)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 3.0}, {4.005, 3.0, 3.0}}, scene_with(style));
  set_motion(sim, 1, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("timestep " + number(dt / 4) + "\nfix nve all nve/sphere\nrun 8000");
  const auto x = gather(sim, "x"), u = gather(sim, "v");
  return x[3] - x[0] > 1.01 ? (u[3] - u[0]) / v : 0.0;
}

double sticking_velocity()    // B2.2, equal spheres: r = 0.5, w = 2 gamma, rho = 1
{
  return 0.9201 * std::pow(std::pow(200.0 / 0.25, 5) / std::pow(material.E_eff(), 2), 1.0 / 6.0);
}

TEST(StockLammps, sticking_velocity_is_that_of_jkr)
{
  // m_eff and R of B2.2: V_s = sqrt(2 x 0.935503 F_C delta_C / m_eff)
  const auto curve = material.pair();
  const double V_s = std::sqrt(2.0 * 0.935503 * curve.F_C() * curve.delta_C() * 12.0 / pi);
  EXPECT_NEAR(sticking_velocity() / V_s, 1.0, 1e-3);
  EXPECT_EQ(restitution(adhesive, 0.98 * V_s), 0.0);
  EXPECT_NEAR(restitution(adhesive, 1.5 * V_s), std::sqrt(1.0 - 1.0 / 2.25), 0.005);
}

TEST(Stock_StockLammps, sticking_velocity_is_seven_tenths_of_jkr)
{
  EXPECT_GT(restitution(stock_jkr, 0.75 * sticking_velocity()), 0.0);
  EXPECT_EQ(restitution(stock_jkr, 0.65 * sticking_velocity()), 0.0);
}

// force on a sphere drawn off the wall by a separation
double pull_at_wall(const std::string &wall, double separation)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 0.49}},
        scene_with("pair_style zero 1.5\npair_coeff * *\n" + wall, "p p f"));
  sim.run("run 1\ndisplace_atoms all move 0 0 " + number(0.01 + separation) + " units box\nrun 1");
  return -gather(sim, "f")[2] / material.wall().F_C();
}

TEST(StockLammps, wall_has_a_neck)
{
  const double delta_C = material.wall().delta_C();
  const std::string wall = "fix w all wall/levelset plane z 0 NULL" + jkr;
  EXPECT_NEAR(pull_at_wall(wall, 0.25 * delta_C), 0.971515, 1e-5);
  EXPECT_NEAR(pull_at_wall(wall, 0.99 * delta_C), 0.648741, 1e-5);
  EXPECT_EQ(pull_at_wall(wall, 1.001 * delta_C), 0.0);
}

TEST(Stock_StockLammps, wall_region_has_no_neck)
{
  const std::string wall = "region w block -1 9 -1 9 0 9 units box\n"
                           "fix w all wall/gran/region granular jkr 1e6 0 0.25 100 tangential "
                           "linear_nohistory 0 0 region w";
  EXPECT_EQ(pull_at_wall(wall, 0.02 * material.wall().delta_C()), 0.0);
}

// ---------------------------------------------------------------------------------------------
// history

// torque on sphere 1 about the contact normal over relative angle
double twisting_slope(const std::string &style)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}}, scene_with(style));
  load_springs(sim, 32, {0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}, {-0.1, 0.0, 0.0});
  sim.run("run 0");
  return -gather(sim, "torque")[0] / (0.2 * 32 * dt);
}

TEST(StockLammps, twisting_slope_is_half_k_T_a_squared)
{
  const double a = material.pair().a(0.01), k_T = 8.0 * material.G_eff() * a;
  EXPECT_NEAR(twisting_slope(adhesive) / (0.5 * k_T * a * a), 1.0, 1e-9);
}

TEST(Stock_StockLammps, twisting_slope_lacks_a_factor_a)
{
  const double a = material.pair().a(0.01), k_T = 8.0 * material.G_eff() * a;
  EXPECT_NEAR(twisting_slope(stock_jkr) / (0.5 * k_T * a * a), 1.0 / a, 0.02 / a);
}

// difference that exchanging i and j makes to a doublet turned about an axis
double swap_error(const std::string &style)
{
  auto torques = [&style](const std::string &neighbors) {
    Simulation sim;
    build(sim, {{4.0, 3.51, 4.0}, {4.0, 4.49, 4.0}}, scene_with(style));
    sim.run(neighbors);
    load_springs(sim, 32, {0.0, 0.0, 0.0}, {0.3, 0.0, 0.3}, {-0.3, 0.0, -0.3});
    sim.run("fix mv all move rotate 4 4 4 1 0.5 2 0.125 units box\nrun 1500");
    return gather(sim, "torque");
  };
  return difference(torques("neigh_modify delay 0 every 1 check no binsize 1.7"),
                    torques("neighbor 2 bin\nneigh_modify delay 1000000 every 1000000 check no"));
}

TEST(StockLammps, exchange_of_i_and_j_changes_nothing)
{
  EXPECT_LT(swap_error(adhesive), 1e-10);
}

TEST(Stock_StockLammps, exchange_of_i_and_j_turns_rolling_round)
{
  // no sliding spring: it would hide the rolling moment, which is small here
  EXPECT_NEAR(swap_error("pair_style granular\npair_coeff * * jkr 1e6 0 0.25 100 tangential "
                         "linear_nohistory 0 0 rolling sds 2000 0 0.02"),
              2.0, 0.01);
}

// tangential force after the same time under r-RESPA, 10 inner steps, over that under Verlet
double respa_ratio(const std::string &style)
{
  auto force = [&style](const std::string &commands, int runs) {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}, {3.98, 3.0, 3.0}}, scene_with(style));
    sim.run(commands);
    set_motion(sim, 1, {0.0, 0.005, 0.0}, {0.0, 0.0, 0.0});
    sim.run("run " + std::to_string(runs));
    return gather(sim, "f")[1];
  };
  return force("run_style respa 2 10 pair 1\ntimestep " + number(10 * dt), 8) / force("", 80);
}

TEST(StockLammps, sliding_spring_grows_with_the_inner_step)
{
  EXPECT_NEAR(respa_ratio(adhesive), 1.0, 1e-9);
}

TEST(Stock_StockLammps, sliding_spring_grows_with_the_outer_step)
{
  EXPECT_NEAR(respa_ratio(stock_jkr), 10.0, 0.1);
}

TEST(StockLammps, wall_acts_at_an_inner_level)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 0.49}},
        scene_with(adhesive + "fix w all wall/levelset plane z 0 NULL" + jkr + "\n", "p p f"));
  EXPECT_EQ(sim.error_of("run_style respa 2 10 pair 1\nfix_modify w respa 1\nrun 1"), "");
}

TEST(Stock_StockLammps, wall_acts_at_the_outermost_level_only)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 0.49}},
        scene_with(adhesive +
                       "fix w all wall/gran granular hertz/material 1e6 0 0.25 tangential "
                       "linear_nohistory 0 0 zplane 0 NULL\n",
                   "p p f"));
  EXPECT_NE(sim.error_of("run_style respa 2 10 pair 1\nfix_modify w respa 1"), "");
}

// ---------------------------------------------------------------------------------------------
// restart, reports, input

// force in a squeezed contact after read_restart, nothing else, over that before
double after_restart(const std::string &style)
{
  const std::string file = scratch_file("restart");
  double before;
  {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}, {3.95, 3.0, 3.0}}, scene_with(style));
    sim.run("run 1\nwrite_restart " + file);
    before = gather(sim, "f")[0];
  }
  Simulation sim;
  const std::string text = sim.error_of("read_restart " + file + "\nrun 1");
  std::remove(file.c_str());
  return text.empty() ? gather(sim, "f")[0] / before : -1.0;
}

TEST(StockLammps, pair_acts_after_read_restart)
{
  EXPECT_NEAR(after_restart(adhesive), 1.0, 1e-12);
}

TEST(Stock_StockLammps, pair_does_nothing_after_read_restart)
{
  const double share = after_restart(stock_jkr);
  if (release() < 20260704)
    EXPECT_NEAR(share, 1.0, 1e-12);    // 4 Feb 2025 does it right
  else
    EXPECT_LE(share, 0.0);    // an error, or no force
}

// sum over both spheres of what a compute reports when they are drawn apart by 0.3 delta_C
double reported(const std::string &style, const std::string &compute, const std::string &column)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}}, scene_with(style));
  sim.run("compute c all " + compute + "\ncompute s all reduce sum c_c" + column +
          "\nthermo_style custom step c_s\ngroup second id 2\nrun 1\ndisplace_atoms second move " +
          number(0.01 + 0.3 * material.pair().delta_C()) + " 0 0 units box\nrun 1");
  EXPECT_GT(gather(sim, "f")[0], 0.9 * material.pair().F_C());    // the neck holds
  return sim.value("c_s");
}

TEST(StockLammps, aggregates_hold_through_the_neck)
{
  EXPECT_EQ(reported(adhesive, "aggregate/contact", "[4]"), 2.0);
}

TEST(Stock_StockLammps, contact_atom_sees_no_neck)
{
  EXPECT_EQ(reported(stock_jkr, "contact/atom", ""), 0.0);
}

TEST(StockLammps, wall_reports_its_total_force)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 0.48}, {5.0, 5.0, 0.49}},
        scene_with(adhesive + "fix w all wall/levelset plane z 0 NULL" + jkr + "\n", "p p f"));
  sim.run("run 0");
  const auto f = gather(sim, "f");
  EXPECT_NEAR(sim.value("f_w[3]") / -(f[2] + f[5]), 1.0, 1e-12);
  EXPECT_GT(std::fabs(f[2] + f[5]), 1.0);
}

TEST(Stock_StockLammps, wall_reports_no_total_force)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 0.49}},
        scene_with(adhesive +
                       "fix w all wall/gran granular hertz/material 1e6 0 0.25 tangential "
                       "linear_nohistory 0 0 zplane 0 NULL\n",
                   "p p f"));
  sim.run("run 0");
  EXPECT_NE(sim.error_of("print \"$(f_w[3])\""), "");
}

TEST(StockLammps, restitution_goes_with_adhesion_and_is_exact)
{
  {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}}, scene_with(adhesive));
    EXPECT_EQ(sim.error_of("pair_coeff * *" + jkr + "damping tsuji 0.5\nrun 0"), "");
  }
  const std::string hertz =
      "pair_style granular/adhesive\npair_coeff * * jkr 1e6 0.25 0 damping tsuji ";
  for (const double e : {0.9, 0.5, 0.2})
    EXPECT_NEAR(restitution(hertz + number(e), 2.0) / e, 1.0, 0.005);
}

TEST(Stock_StockLammps, restitution_is_refused_with_adhesion_and_too_high)
{
  for (const char *law : {"tsuji", "coeff_restitution"}) {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}}, scene_with("pair_style granular"));
    EXPECT_NE(sim.error_of(
                  "pair_coeff * * jkr 1e6 0.5 0.25 100 tangential linear_nohistory 0 0 damping " +
                  std::string(law) + "\nrun 0"),
              "")
        << law;
  }
  auto tsuji = [](double e) {
    return "pair_style granular\npair_coeff * * hertz/material 1e6 " + number(e) +
        " 0.25 tangential linear_nohistory 0 0 damping tsuji";
  };
  EXPECT_NEAR(restitution(tsuji(0.5), 2.0), 0.62, 0.02);
  EXPECT_NEAR(restitution(tsuji(0.2), 2.0), 0.34, 0.03);
}

}    // namespace
