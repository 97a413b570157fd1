// Energy and momentum under fix nve/sphere/mts: a bound doublet for very long, dense aggregates,
// and a gas of adhesive spheres in which energy leaves by the ends of necks. C2, C20, C26,
// C27.

#include "criterion.h"
#include "necks.h"
#include "scenes.h"

#include <algorithm>
#include <random>

namespace {

const Material material;

// potential and kinetic energy of all
const std::string count_energy = "compute spin all erotate/sphere\n"
                                 "variable E equal pe+ke+c_spin\n"
                                 "thermo_style custom step pe ke c_spin f_nve[3]\n"
                                 "thermo_modify norm no\n";

// ---------------------------------------------------------------------------------------------
// C2: 1e6 collision steps about the bottom of the well, amplitude 0.2 delta_C

TEST(MtsEnergy, bound_doublet_keeps_its_energy)
{
  const auto curve = material.pair();
  const double stretched = 1.0 - curve.delta_eq() + 0.2 * curve.delta_C();
  Simulation sim;
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
  build(sim, {{3.0, 4.0, 4.0}, {3.0 + stretched, 4.0, 4.0}}, scene);
  sim.run(mts(97) + count_energy + "run 0");
  // energy above that at rest: 0.99058 F_C / delta_C times half the amplitude squared
  const double swing =
      0.5 * 0.990578 * curve.F_C() / curve.delta_C() * std::pow(0.2 * curve.delta_C(), 2);
  sim.run("variable d equal x[2]-x[1]\nfix mean all ave/time 1 500 500 v_E v_d\nrun 500");
  const double early = sim.value("f_mean[1]"), distance = sim.value("f_mean[2]");
  sim.run("run 9500");
  const double late = sim.value("f_mean[1]");
  EXPECT_GE(sim.value("f_nve[4]"), 9.7e5);
  EXPECT_EQ(sim.value("f_nve[3]"), 1.0);
  expect_criterion("C2 mts: drift of energy in 1e6 steps, of that of the swing",
                   std::fabs(late - early) / swing, 0.0, 1e-4);
  // it swings still, and as far: the well is softer outside
  EXPECT_NEAR(sim.value("f_mean[2]"), distance, 0.02 * curve.delta_C());
}

// ---------------------------------------------------------------------------------------------
// C20: a particle and its twelve neighbours at the report's steps, f3 = 0.1 and 40 collision steps
// in a particle step. Units of d, U and rho_p; lambda = 1e4.

std::vector<Sphere> fcc_cluster(double spacing)
{
  const double h = spacing / std::sqrt(2.0);
  std::vector<Sphere> spheres = {{5.0, 5.0, 5.0}};
  for (const double a : {-h, h})
    for (const double b : {-h, h}) {
      spheres.push_back({5.0 + a, 5.0 + b, 5.0});
      spheres.push_back({5.0 + a, 5.0, 5.0 + b});
      spheres.push_back({5.0, 5.0 + a, 5.0 + b});
    }
  return spheres;
}

// A cluster at rest: omega dt as the summary prints it, and whether it is above 0.3, with the
// number of collision steps that gives 0.3, beside the largest frequency of a contact.
void expect_told(Simulation &sim, const JkrCurve &curve, const std::string &modes)
{
  const double m = pi / 12.0, I = 0.4 * m * 0.25, G = 0.25 * 2e4 * (1.0 - 0.09) / 1.3 / 1.7;
  const double omega = std::max(std::sqrt(3.5 * 8.0 * G * curve.a0() / m),
                                modes.find("rolling") == std::string::npos
                                    ? 0.0
                                    : std::sqrt(4.0 * curve.F_C() * curve.R / I));
  const std::string text = log_of(sim, "run 1\n"), words = "omega dt at most ";
  const auto at = text.find(words);
  ASSERT_NE(at, std::string::npos) << text;
  const double kappa = 2.5e-3 * omega, told = std::stod(text.substr(at + words.size()));
  expect_criterion("C20 mts: omega dt of the summary over that of the law, " + modes, told / kappa,
                   0.995, 1.005);
  const auto cure = text.find("(collision ");
  EXPECT_EQ(cure != std::string::npos, kappa > 0.3) << text;
  if (cure == std::string::npos) return;
  EXPECT_NEAR(std::stod(text.substr(cure + 11)), 40.0 * kappa / 0.3, 1.5) << text;
}

// turn: commands that make the spheres turn
void expect_loss(double phi, const std::string &modes, const std::string &turn)
{
  const JkrCurve curve{0.25, 1e4, 0.5 * phi};
  Scene scene;
  scene.box = "0 10 0 10 0 10";
  scene.style = "pair_style granular/adhesive\npair_coeff * * jkr " + digits(2e4 * (1.0 - 0.09)) +
      " 0.3 " + digits(curve.gamma) + " damping alpha 1.018 " + modes + "\n";
  Simulation sim;
  build(sim, fcc_cluster(1.0 - curve.delta_eq()), scene);
  sim.run(mts(40, 2.5e-3));
  expect_told(sim, curve, modes);
  sim.run(count_energy + turn +
          "compute parts all pair granular/adhesive\n"
          "thermo_style custom step pe ke c_spin f_nve[3] c_parts[3] c_parts[4]\n"
          "thermo_modify norm no\nrun 0");
  const bool turns = modes.find("rolling") != std::string::npos;
  const double start = sim.value("ke+c_spin"), bottom = sim.value("pe");
  double last = sim.value("v_E"), most = -1.0, rolled = 0.0, twisted = 0.0;
  for (int n = 0; n < 20; n++) {
    sim.run("run 1");
    rolled = std::max(rolled, sim.value("c_parts[3]"));
    twisted = std::max(twisted, sim.value("c_parts[4]"));
    most = std::max(most, (sim.value("v_E") - last) / start);
    last = sim.value("v_E");
  }
  sim.run("run 750");
  EXPECT_EQ(rolled / start > 1e-6, turns) << phi;
  EXPECT_EQ(twisted / start > 1e-6, turns) << phi;
  expect_criterion("C20 mts: largest gain of energy in a particle step, " + modes, most, -1.0,
                   1e-6);
  EXPECT_LT(sim.value("v_E"), bottom + start) << phi;
  EXPECT_LT(sim.value("ke"), start) << phi;
  EXPECT_EQ(sim.value("f_nve[3]"), 36.0) << phi;
}

TEST(MtsEnergy, twelve_contacts_on_a_particle_lose_energy_only)
{
  const std::string about_z = "variable turn atom 0.4*(id%3-1)\nset group all omega 0 0 v_turn\n",
                    about_all = "variable a atom 0.4*(id%3-1)\nvariable b atom 0.4*(id%5-2)\n"
                                "variable c atom 0.4*(id%2-0.5)\nset group all omega v_a v_b v_c\n";
  for (const double phi : {1.5, 15.0, 50.0, 150.0}) {
    expect_loss(phi, "sliding 0.3", about_z);
    expect_loss(phi, "sliding 0.3 twisting yes rolling 0.01 0.1", about_all);
    expect_loss(phi, "sliding 0.3 twisting yes rolling 0.01", about_all);
  }
}

// ---------------------------------------------------------------------------------------------
// C26, C27: 1000 adhesive spheres without damping. When a neck opens it gives 0.846614 F_C delta_C,
// when it breaks 0.088889 are lost (table A5), so energy counted from open necks falls in steps.

struct Ledger {
  double missing;     // energy, of that at the start
  double breaks;      // of necks, counted from lists of contacts
  double uneven;      // largest loss in a particle step besides that of its breaks, in units of one
  double momentum;    // largest change, of the sum of magnitudes
};

Ledger gas(int collision_steps, int particle_steps, double step)
{
  const auto curve = material.pair();
  const double unit = curve.F_C() * curve.delta_C(), loss = 0.935503 * unit;
  std::mt19937 random(26);
  std::normal_distribution<double> gauss(0.0, 4.0);
  std::vector<double> x, v;
  for (int n = 0; n < 1000; n++) {
    for (const int cell : {n % 10, n / 10 % 10, n / 100}) {
      x.push_back(2.0 * (cell + 0.5));
      v.push_back(gauss(random));
    }
  }
  Scene scene;
  scene.box = "0 20 0 20 0 20";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run(mts(collision_steps, step) + count_energy + local_contacts +
          "neighbor 1.0 bin\nthermo 1000000\nrun 0");
  auto momentum = [&] {
    std::vector<double> p(3, 0.0);
    const auto v = gather(sim, "v");
    for (size_t n = 0; n < v.size(); n++) p[n % 3] += v[n];
    return p;
  };
  const auto p0 = momentum();
  double scale = 0.0;
  for (const double c : v) scale += std::fabs(c);
  const double E0 = sim.value("v_E");
  double last = E0;
  Necks before;
  Ledger ledger{};
  for (int n = 0; n < particle_steps; n++) {
    sim.run("run 1 pre no post no");
    const Necks necks = necks_of(contacts_of(sim));
    EXPECT_EQ(necks.size(), sim.value("f_nve[3]"));
    const double now = sim.value("v_E") + 0.846614 * unit * necks.size();
    const double breaks = ended(before, necks);
    ledger.breaks += breaks;
    ledger.uneven = std::max(ledger.uneven, std::fabs((last - now) / loss - breaks));
    const auto p = momentum();
    for (int c = 0; c < 3; c++)
      ledger.momentum = std::max(ledger.momentum, std::fabs(p[c] - p0[c]) / scale);
    last = now;
    before = necks;
  }
  ledger.missing = (last + ledger.breaks * loss - E0) / E0;
  printf("gas, N = %d: %.0f breaks, missing %.3g, uneven %.3g\n", collision_steps, ledger.breaks,
         ledger.missing, ledger.uneven);
  return ledger;
}

TEST(MtsEnergy, gas_loses_what_breaks_take)
{
  const auto long_run = gas(40, 2500, 0.5 * dt);    // 1e5 collision steps, omega dt = 0.013
  expect_criterion("C26 mts: energy missing from the ledger, 1000 spheres, 1e5 steps, N = 40",
                   std::fabs(long_run.missing), 0.0, 1e-5);
  EXPECT_LT(long_run.uneven, 0.07);
  expect_criterion("C27 mts: change of momentum in the same run", long_run.momentum, 0.0, 1e-12);
  EXPECT_GT(long_run.breaks, 1000.0);
  const auto coarse = gas(16, 100, dt), fine = gas(64, 100, dt / 4.0);
  EXPECT_GT(coarse.uneven / fine.uneven, 4.0);    // first order or better
  EXPECT_LT(coarse.uneven / fine.uneven, 36.0);
}

}    // namespace
