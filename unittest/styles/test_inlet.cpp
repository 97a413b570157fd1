// fix inlet/flow: the flux that was asked for enters, nowhere on top of another particle, at the
// fluid's own motion; and every number is accounted for.

#include "inlet_scene.h"
#include "vtkhdf_writer.h"

namespace {

// sum of (observed - expected)^2 / expected over bins of equal expectation
double chi_square(const std::vector<double> &u, int bins)
{
  std::vector<int> count(bins, 0);
  for (double value : u) count[std::min(bins - 1, static_cast<int>(value * bins))]++;
  const double expected = static_cast<double>(u.size()) / bins;
  double sum = 0.0;
  for (int n : count) sum += (n - expected) * (n - expected) / expected;
  return sum;
}

// 19 degrees of freedom: outside of these with a chance of 1e-4 on either side
constexpr double chi2_lo = 4.0, chi2_hi = 52.0;

}    // namespace

TEST(Inlet, flux_over_ten_thousand_steps)
{
  // c0 u A = 0.005 x (2/3 of 1.5) x 100; a thousandth of what entered is less than one particle.
  // Spheres are so soft that these steps follow their impacts.
  Simulation sim;
  sim.run(box() +
          "timestep 0.05\npair_coeff * * jkr 300 0.3 0 damping tsuji 0.5\nfix air all flow/field "
          "channel x y 0 10 1.5" +
          unit_fluid + "fix in all inlet/flow x 0 air concentration 0.005" + particle +
          "outlet x 10\nfix drag all flow/force air drag stokes\nrun 10000\n");
  const double size = pi / 6.0 * 0.125, flux = 0.005 * 1.0 * 100.0, time = 500.0;
  EXPECT_NEAR(sim.value("f_in[6]"), flux, 1e-12);
  EXPECT_NEAR(sim.value("f_in[8]"), flux, 1e-3 * flux);
  EXPECT_NEAR(sim.value("f_in[1]"), flux * time / size, 1.0 + 1e-3 * flux * time / size);
  EXPECT_NEAR(sim.value("f_in[4]"), size * sim.value("f_in[1]"), 1e-9 * flux * time);
  EXPECT_NEAR(sim.value("f_in[3]"), 2.0 * sim.value("f_in[4]"), 1e-9 * flux * time);
  EXPECT_GT(sim.value("f_in[9]"), 0.9 * sim.value("f_in[1]"));
  EXPECT_EQ(sim.value("f_in[1]"), sim.value("f_in[9]") + sim.value("atoms"));
}

TEST(Inlet, nothing_overlaps_and_all_move_with_the_fluid)
{
  Simulation sim;
  sim.run(box() + uniform + "fix in all inlet/flow x 0 air concentration 0.15" + particle +
          "outlet x 15\nfix drag all flow/force air drag stokes torque yes\n"
          "compute ke all ke\nthermo_style custom step c_ke\nrun 1200\n");
  EXPECT_GT(sim.value("f_in[2]"), 100.0) << "it is dense enough to refuse places";
  EXPECT_GE(smallest_gap(sim, periodic_yz), -1e-12);
  EXPECT_NEAR(smallest_gap(sim, periodic_yz), 0.0, 0.05);
  // all particles have the velocity of the fluid: no overlap has set energy free
  const double mass = 2.0 * pi / 6.0 * 0.125 * sim.value("atoms");
  EXPECT_NEAR(sim.value("c_ke") / (0.5 * mass), 1.0, 1e-6);
  EXPECT_NEAR(sim.value("f_in[8]"), 15.0, 0.02) << "refused particles enter later";
  EXPECT_LT(sim.value("f_in[5]"), 30.0);
}

TEST(Inlet, keeps_a_gap_to_others_and_walls)
{
  Simulation sim;
  sim.run(box("f p") + "fix wall all wall/levelset plane y 0 10 jkr 1e4 0.3 0.1\n" + uniform +
          "fix in all inlet/flow x 0 air concentration 0.05 gap 0.1" + particle + "\nrun 600\n");
  ASSERT_GT(sim.value("atoms"), 100.0);
  EXPECT_GE(smallest_gap(sim, periodic_yz), 0.1 - 1e-12);
  EXPECT_LT(smallest_gap(sim, periodic_yz), 0.2);
  double lowest = 1e30, highest = -1e30;
  const auto x = inside(sim).x;
  for (size_t i = 0; i < x.size() / 3; i++) {
    lowest = std::min(lowest, x[3 * i + 1]);
    highest = std::max(highest, x[3 * i + 1]);
  }
  EXPECT_GE(lowest, 0.35);
  EXPECT_LT(lowest, 0.6);
  EXPECT_LE(highest, 9.65);
  EXPECT_GT(highest, 9.4);
}

TEST(Inlet, places_follow_the_flux)
{
  // the flux below y is that of the parabola, s^2 (3 - 2 s); particles small enough to feel no edge
  Simulation sim;
  sim.run(box() + "fix air all flow/field channel x y 0 10 1.5" + unit_fluid +
          "fix in all inlet/flow x 0 air number 20000 diameter 1e-4 density 2 type 1 seed 7\n"
          "pair_coeff * * jkr 1e4 0.3 0\nrun 1\n");
  ASSERT_EQ(sim.value("f_in[1]"), 20000.0);
  const auto x = inside(sim).x;
  const auto v = inside(sim).v;
  std::vector<double> along_y, along_z, way;
  double spin = 0.0;
  const auto omega = inside(sim).omega;
  for (size_t i = 0; i < x.size() / 3; i++) {
    const double s = x[3 * i + 1] / 10.0, u = 6.0 * s * (1.0 - s);
    along_y.push_back(s * s * (3.0 - 2.0 * s));
    along_z.push_back(x[3 * i + 2] / 10.0);
    way.push_back(x[3 * i] / (0.01 * u));
    EXPECT_NEAR(v[3 * i], u, 1e-12);
    spin = std::max(spin, std::fabs(omega[3 * i + 2] + 0.5 * 0.6 * (1.0 - 2.0 * s)));
  }
  EXPECT_LT(spin, 1e-12) << "half the vorticity";
  for (const auto &u : {along_y, along_z, way}) {
    EXPECT_GT(chi_square(u, 20), chi2_lo);
    EXPECT_LT(chi_square(u, 20), chi2_hi);
  }
}

TEST(Inlet, diameters_follow_their_law)
{
  struct Case {
    std::string law;
    double mean_volume, mean;    // <d^3>, <d>
  };
  // lognormal: <d^k> = median^k exp(k^2 s^2 / 2); poly by volume: equal volumes of 0.1 and 0.2
  const double s2 = std::pow(std::log(1.3), 2);
  const std::vector<Case> cases = {
      {"uniform 0.1 0.3", 0.01, 0.2},
      {"lognormal 0.1 1.3 0.01 1.0", 1e-3 * std::exp(4.5 * s2), 0.1 * std::exp(0.5 * s2)},
      {"lognormal 0.1 1.2", 1e-3 * std::exp(4.5 * std::pow(std::log(1.2), 2)),
       0.1 * std::exp(0.5 * std::pow(std::log(1.2), 2))},
      {"poly volume 2 0.1 0.5 0.2 0.5", (8.0 * 0.001 + 0.008) / 9.0, (8.0 * 0.1 + 0.2) / 9.0}};
  for (const auto &one : cases) {
    Simulation sim;
    sim.run(box() + uniform + "fix in all inlet/flow x 0 air number 5000 every 1 diameter " +
            one.law + " density 2 type 1 seed 12\ntimestep 5\nrun 1\n");
    const auto radius = inside(sim).radius;
    ASSERT_EQ(radius.size(), 5000u);
    double mean = 0.0, volume = 0.0;
    for (double r : radius) {
      mean += 2.0 * r / 5000.0;
      volume += 8.0 * r * r * r / 5000.0;
    }
    EXPECT_NEAR(mean / one.mean, 1.0, 0.02) << one.law;
    EXPECT_NEAR(volume / one.mean_volume, 1.0, 0.06) << one.law;
    EXPECT_NEAR(sim.value("f_in[4]"), pi / 6.0 * 5000.0 * volume, 1e-9) << one.law;
  }
}

TEST(Inlet, enters_through_any_plane_in_both_directions)
{
  struct Case {
    std::string plane, flow;
    int axis;
    double at, v;
  };
  const std::vector<Case> cases = {{"x 1", "2 0 0", 0, 1, 2}, {"-x 19", "-2 0 0", 0, 19, -2},
                                   {"y 1", "0 2 0", 1, 1, 2}, {"-y 9", "0 -2 0", 1, 9, -2},
                                   {"z 1", "0 0 2", 2, 1, 2}, {"-z 9", "0 0 -2", 2, 9, -2}};
  for (const auto &one : cases) {
    Simulation sim;
    sim.run(box() + "fix air all flow/field uniform " + one.flow + unit_fluid +
            "fix in all inlet/flow " + one.plane + " air number 50" + particle + "\nrun 1\n");
    const auto x = inside(sim).x;
    ASSERT_EQ(x.size(), 150u) << one.plane;
    for (size_t i = 0; i < 50; i++) {
      const double way = (x[3 * i + one.axis] - one.at) * (one.v > 0.0 ? 1.0 : -1.0);
      EXPECT_GE(way, 0.0) << one.plane;
      EXPECT_LE(way, 0.02 + 1e-12) << one.plane;
    }
  }
}

TEST(Inlet, in_the_plane_concentration_is_by_area)
{
  Simulation sim;
  sim.run("units lj\ndimension 2\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
          "boundary f f p\nregion box block 0 20 0 10 -0.5 0.5\ncreate_box 1 box\n"
          "neighbor 0.3 bin\npair_style granular/adhesive\npair_coeff * * jkr 1e4 0.3 0.1\n"
          "fix move all nve/sphere\nfix flat all enforce2d\ntimestep 0.02\n" +
          uniform + "fix in all inlet/flow x 0 air concentration 0.02" + particle +
          "window 2 7\nrun 900\n");
  EXPECT_NEAR(sim.value("f_in[6]"), 0.02 * 5.0, 1e-12);
  EXPECT_NEAR(sim.value("f_in[1]") * pi / 4.0 * 0.25, 0.1 * 18.0, 0.2);
  const auto x = inside(sim).x;
  for (size_t i = 0; i < x.size() / 3; i++) {
    EXPECT_GE(x[3 * i + 1], 2.25);
    EXPECT_LE(x[3 * i + 1], 6.75);
    EXPECT_EQ(x[3 * i + 2], 0.0);
  }
  EXPECT_GE(smallest_gap(sim, periodic_yz), -1e-12);
}

TEST(Inlet, what_entered_is_inside_or_has_left)
{
  Simulation sim;
  sim.run(box() + "fix air all flow/field uniform 10 0 0" + unit_fluid +
          "fix in all inlet/flow x 0 air concentration 0.03" + particle + "outlet x 12\n");
  double left = 0.0;
  for (int n = 0; n < 8; n++) {
    sim.run("run 40 pre no post no\n");
    EXPECT_EQ(sim.value("f_in[1]"), sim.value("f_in[9]") + sim.value("atoms"));
    EXPECT_NEAR(sim.value("f_in[10]"), sim.value("f_in[9]") * 2.0 * pi / 6.0 * 0.125, 1e-9);
    left = sim.value("f_in[9]");
    if (n == 0) sim.run("run 0\n");
  }
  EXPECT_GT(left, 100.0);
}

TEST(Inlet, works_with_sub_stepped_contacts)
{
  Simulation sim;
  std::string commands = box();
  commands.replace(commands.find("nve/sphere"), 10, "nve/sphere/mts collision auto");
  sim.run(commands + "timestep 0.02\n" + uniform +
          "fix in all inlet/flow x 0 air concentration 0.1" + particle +
          "\nfix drag all flow/force air drag stokes\nrun 500\n");
  EXPECT_GT(sim.value("atoms"), 1000.0);
  EXPECT_GE(smallest_gap(sim, periodic_yz), -1e-12);
  EXPECT_EQ(sim.value("f_move[5]"), 0.0) << "no contact was found late";
}

TEST(Inlet, flow_that_pulsates_and_turns_back)
{
  // u < 0 in a part of its period of 100 steps; what enters within a step follows its beginning
  Simulation sim;
  sim.run(box() +
          "variable u equal 1.0+1.5*sin(2*PI*step*0.01)\nfix air all flow/field uniform v_u "
          "0 0" +
          unit_fluid + "fix in all inlet/flow x 1 air concentration 0.05" + particle +
          "\nfix drag all flow/force air drag stokes\nrun 300\n");
  double sum = 0.0;
  for (int n = 0; n < 300; n++) sum += std::max(1.0 + 1.5 * std::sin(2.0 * pi * 0.01 * n), 0.0);
  EXPECT_NEAR(sim.value("f_in[7]"), 5.0 * sum / 300.0, 1e-9);
  EXPECT_LE(sim.value("f_in[4]"), 5.0 * sum * 0.01);
  EXPECT_GT(sim.value("f_in[4]"), 5.0 * sum * 0.01 - 2.0 * pi / 6.0 * 0.125);
}

TEST(Inlet, fractions_of_a_number_and_moments_between_insertions)
{
  Simulation sim;
  sim.run(box() + uniform + "fix in all inlet/flow x 0 air number 7.5 every 20" + particle +
          "\nrun 199\n");
  EXPECT_EQ(sim.value("f_in[1]"), 67.0);
  EXPECT_NEAR(sim.value("f_in[5]"), 0.5, 1e-12);
  EXPECT_NEAR(sim.value("f_in[6]"), 7.5 * pi / 6.0 * 0.125 / 0.2, 1e-12);
  sim.run("run 1\n");
  EXPECT_EQ(sim.value("f_in[1]"), 75.0);
  const auto x = inside(sim).x;    // all along the way of 200 steps, not in ten sheets
  double mean = 0.0, square = 0.0;
  for (int i = 0; i < 75; i++) {
    mean += std::fmod(x[3 * i] / 0.2, 1.0) / 75.0;
    square += std::pow(x[3 * i] / 2.0, 2) / 75.0;
  }
  EXPECT_NEAR(mean, 0.5, 4.0 / std::sqrt(12.0 * 75.0));
  EXPECT_NEAR(square, 1.0 / 3.0, 4.0 * std::sqrt(4.0 / 45.0 / 75.0));
}

// A large sphere stands in the way until the flow carries it off.
TEST(Inlet, what_is_due_enters_later)
{
  Simulation sim;
  sim.run(box() + uniform +
          "create_atoms 1 single 0.2 5 5\nset atom 1 diameter 3.8 density 1\n"
          "fix in all inlet/flow x 0 air concentration 0.08 window 3.2 6.8 3.2 6.8 diameter 1.0 "
          "density 2 type 1 seed 4711\nvelocity all set 0 0 0\nrun 200\n");
  const double due = 0.08 * 3.6 * 3.6 / (pi / 6.0);    // per time
  EXPECT_EQ(sim.value("f_in[1]"), 0.0);
  EXPECT_NEAR(sim.value("f_in[5]"), 2.0 * due, 1e-9);
  EXPECT_GT(sim.value("f_in[2]"), 1000.0);
  sim.run("velocity all set 1 0 0\nrun 1200\n");
  EXPECT_EQ(sim.value("f_in[1]"), std::floor(14.0 * due));
  EXPECT_LT(sim.value("f_in[5]"), 1.0);
  EXPECT_GE(smallest_gap(sim, periodic_yz), -1e-12);
}

// Free fall from rest: a particle that inherited the force of another, of up to 64 times its mass,
// would show. The gap keeps them apart.
TEST(Inlet, respa_gives_no_forces_of_others)
{
  Simulation sim;
  sim.run(box() + uniform +
          "fix in all inlet/flow x 0 air concentration 0.05 diameter uniform 0.2 0.8 density 2 "
          "type 1 seed 4711 gap 0.1 outlet x 3\nfix fall all gravity 0.01 vector 0 0 -1\n"
          "fix_modify fall respa 1\n"
          "run_style respa 2 4\nrun 600\n");
  EXPECT_NEAR(sim.value("f_in[4]"), 30.0, pi / 6.0 * 0.512);
  EXPECT_EQ(sim.value("f_in[1]"), sim.value("f_in[9]") + sim.value("atoms"));
  EXPECT_GT(sim.value("f_in[9]"), 100.0);
  const auto x = inside(sim).x, v = inside(sim).v;
  for (size_t i = 0; i < v.size(); i += 3) {
    EXPECT_NEAR(v[i], 1.0, 1e-12);
    EXPECT_NEAR(v[i + 2], -0.01 * x[i], 0.01 * 1.5 * 0.01);    // within a step and a half
  }
}

TEST(Inlet, walls_that_the_file_of_the_flow_knows)
{
  const std::string file = scratch_file("slit.vtkhdf");
  {
    VtkhdfWriter writer(file, {3, 21, 3}, {0, 0, 0}, {10, 0.5, 5});
    writer.field("velocity", 3, [](const double *x, double, double *u) {
      u[0] = std::max(1.0 - std::fabs(x[1] - 5.0) / 3.0, 0.0);
    });
    writer.field("distance", 1, [](const double *x, double, double *d) {
      d[0] = 3.0 - std::fabs(x[1] - 5.0);
    });
  }
  Simulation sim;
  sim.run(box() + "fix air all flow/field file " + file + unit_fluid +
          "fix in all inlet/flow x 0 air number 150 every 1" + particle +
          "\ntimestep 1.0\nrun 1\n");
  std::filesystem::remove(file);
  ASSERT_EQ(sim.value("f_in[1]"), 150.0);
  double farthest = 0.0;
  const auto x = inside(sim).x;
  for (size_t i = 0; i < x.size() / 3; i++)
    farthest = std::max(farthest, std::fabs(x[3 * i + 1] - 5.0));
  EXPECT_LE(farthest, 2.75 + 1e-9);
  EXPECT_GT(farthest, 2.3);
}
