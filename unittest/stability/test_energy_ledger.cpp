// C26, C27: adhesive spheres that collide and stick, with damping, sliding, rolling and twisting.
// The work of each dissipative force is summed up from outside, from compute pair/local and the
// motion of the particles, and must account for all the energy that is lost, mode by mode.

#include "integrators.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <iterator>
#include <random>

namespace {

const Material material;
const JkrCurve curve = material.pair();
const double unit = curve.F_C() * curve.delta_C();
const double mass = pi / 6.0, inertia = 0.1 * mass;

enum { DAMPING, SLIDING, ROLLING, TWISTING, MODES };
using Powers = std::array<double, MODES>;
using Necks = std::vector<uint64_t>;    // pairs of IDs, sorted

struct Motion {
  std::vector<double> x, v, w;
};

Motion motion_of(Simulation &sim)
{
  return {gather(sim, "x"), gather(sim, "v"), gather(sim, "omega")};
}

// power that the contact forces of each mode give to the particles; `necks` becomes the contacts
Powers powers(Simulation &sim, const Motion &m, double box, Necks &necks)
{
  auto **row = static_cast<double **>(
      lammps_extract_compute(sim.lammps(), "loc", LMP_STYLE_LOCAL, LMP_TYPE_ARRAY));
  auto **ids = static_cast<double **>(
      lammps_extract_compute(sim.lammps(), "ids", LMP_STYLE_LOCAL, LMP_TYPE_ARRAY));
  const int rows = *static_cast<int *>(
      lammps_extract_compute(sim.lammps(), "loc", LMP_STYLE_LOCAL, LMP_SIZE_ROWS));
  Powers sum{};
  necks.clear();
  for (int r = 0; r < rows; r++) {
    const double *p = row[r] - 1;    // p[1] = overlap, as the page counts
    if (p[2] == 0.0) continue;
    const auto a = static_cast<uint64_t>(ids[r][0]), b = static_cast<uint64_t>(ids[r][1]);
    necks.push_back(std::min(a, b) << 32 | std::max(a, b));
    const size_t i = 3 * (a - 1), j = 3 * (b - 1);
    double n[3], distance = 0.0;
    for (int c = 0; c < 3; c++) {
      n[c] = m.x[j + c] - m.x[i + c];
      n[c] -= box * std::round(n[c] / box);
      distance += n[c] * n[c];
    }
    distance = std::sqrt(distance);
    for (double &c : n) c /= distance;
    double W[3];    // of arms times spins; both arms are half the distance
    for (int c = 0; c < 3; c++) W[c] = 0.5 * distance * (m.w[i + c] + m.w[j + c]);
    for (int c = 0; c < 3; c++) {
      const int c1 = (c + 1) % 3, c2 = (c + 2) % 3;
      const double slip = m.v[i + c] - m.v[j + c] + W[c1] * n[c2] - W[c2] * n[c1];
      const double turn = m.w[i + c] - m.w[j + c];
      sum[DAMPING] -= p[4] * n[c] * (m.v[i + c] - m.v[j + c]);
      sum[SLIDING] += p[5 + c] * slip;
      sum[ROLLING] += p[8 + c] * turn;
      sum[TWISTING] += p[11] * n[c] * turn;
    }
  }
  std::sort(necks.begin(), necks.end());
  return sum;
}

size_t ended(const Necks &before, const Necks &now)
{
  Necks lost;
  std::set_difference(before.begin(), before.end(), now.begin(), now.end(),
                      std::back_inserter(lost));
  return lost.size();
}

double kinetic(const Motion &m)
{
  double E = 0.0;
  for (size_t n = 0; n < m.v.size(); n++)
    E += 0.5 * mass * m.v[n] * m.v[n] + 0.5 * inertia * m.w[n] * m.w[n];
  return E;
}

struct Account {
  double missing;     // of the energy at the start
  double momentum;    // change of it, of the sum of magnitudes
};
const std::string all_modes = "damping tsuji 0.8 sliding 0.3 twisting yes rolling 0.02 0.1";

// `every`: steps between two looks at the powers, much shorter than a contact's oscillation
Account ledger(const Integrator &integrator, const std::string &modes, int side, int steps,
               double step, int every = 1)
{
  const int N = side * side * side;
  const std::string what = std::to_string(N) + " spheres, " + std::to_string(steps) + " steps";
  const double width = 1.3 * side;
  std::mt19937 random(26);
  std::normal_distribution<double> gauss(0.0, 5.0);
  std::vector<double> x, v;
  for (int n = 0; n < N; n++)
    for (const int cell : {n % side, n / side % side, n / side / side}) {
      x.push_back(1.3 * (cell + 0.5));
      v.push_back(gauss(random));
    }
  Scene scene;
  const std::string range = "0 " + digits(width) + " ";
  scene.box = range + range + range;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + modes + "\n";
  Simulation sim;
  build(sim, {}, scene);
  add_spheres(sim, x, v);
  sim.run("neighbor 0.3 bin\ncompute parts all pair granular/adhesive\n"
          "compute loc all pair/local p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11\n"
          "compute ids all property/local patom1 patom2\n"
          "thermo_style custom step pe c_parts[1] c_parts[2] c_parts[3] c_parts[4]\n"
          "thermo_modify norm no\nthermo 1000000\n" +
          integrator.commands(step) + "run 0");
  Necks before, now;
  Motion motion = motion_of(sim);
  const double E0 = kinetic(motion);
  Powers last = powers(sim, motion, width, before), work{};
  std::array<double, 3> p0{}, change{};
  for (size_t n = 0; n < v.size(); n++) p0[n % 3] += v[n];
  double size = 0.0, broken = 0.0;
  for (const double c : v) size += std::fabs(c);
  // r-RESPA sets up every run; contacts go on through the ends of runs
  const std::string next = "run " + std::to_string(every) +
      (integrator.name == "respa" ? " post no" : " pre no post no");
  for (int n = 0; n < steps; n += every) {
    sim.run(next);
    motion = motion_of(sim);
    const Powers power = powers(sim, motion, width, now);
    for (int k = 0; k < MODES; k++) work[k] += 0.5 * every * step * (last[k] + power[k]);
    last = power;
    broken += ended(before, now);
    before.swap(now);
  }
  for (size_t n = 0; n < motion.v.size(); n++) change[n % 3] += motion.v[n];
  for (int c = 0; c < 3; c++) change[c] = std::fabs(change[c] - p0[c]) / size;
  // energy of necks is counted from where they opened
  const double elastic = sim.value("c_parts[1]") + 0.846614 * unit * before.size();
  Powers lost{};
  lost[DAMPING] = -work[DAMPING];
  for (const int k : {SLIDING, ROLLING, TWISTING})
    lost[k] = -work[k] - sim.value("c_parts[" + std::to_string(k + 1) + "]");
  double sum = kinetic(motion) + elastic + 0.935503 * unit * broken;
  for (const int k : {SLIDING, ROLLING, TWISTING})
    sum += sim.value("c_parts[" + std::to_string(k + 1) + "]");
  for (const double one : lost) sum += one;
  printf(
      "C26 %s, %s: of the energy at the start %.4f kinetic, %.4f elastic and adhesive; lost %.4f "
      "necks, %.4f damping, %.4f sliding, %.4f rolling, %.4f twisting; %zu contacts\n",
      integrator.name.c_str(), what.c_str(), kinetic(motion) / E0, elastic / E0,
      0.935503 * unit * broken / E0, lost[DAMPING] / E0, lost[SLIDING] / E0, lost[ROLLING] / E0,
      lost[TWISTING] / E0, before.size());
  EXPECT_GT(before.size(), N / 20u);
  if (!modes.empty())
    for (const double one : lost) EXPECT_GT(one, 1e-6 * E0) << "each mode takes part";
  return {std::fabs(sum / E0 - 1.0), *std::max_element(change.begin(), change.end())};
}

void all_accounts(const Integrator &integrator, int side, int steps, int every)
{
  const std::string what = std::to_string(side * side * side) + " spheres, " +
      std::to_string(steps) + " steps, omega dt = 0.013";
  const auto account = ledger(integrator, all_modes, side, steps, 0.5 * dt, every);
  expect_criterion(integrator.of("C26 *: energy missing from the ledger of all modes, " + what),
                   account.missing, 0.0, 1e-3);
  expect_criterion(integrator.of("C27 *: change of momentum, " + what), account.momentum, 0.0,
                   1e-12);
}

// every integrator with a single collision step in a step: work within a step cannot be seen
TEST(EnergyLedger, thousand_spheres)
{
  for (const auto &one : integrators) all_accounts({one.name, 1}, 10, count(3000, 100000), 1);
}

TEST(EnergyLedger, many_spheres)
{
  if (!std::getenv("APF_LONG")) GTEST_SKIP() << "long: tools/cases --long";
  all_accounts({"verlet", 1}, 22, 100000, 5);
  all_accounts({"verlet", 1}, 46, 100000, 10);
}

// The report's collision step, f3 d (rho^2 / (E^2 U))^(1/5) with f3 = 0.1, U as the speeds at the
// start. Contacts themselves meet the criterion there; dashpots and sliders, whose velocities are
// half a step old, at half of the step.
TEST(EnergyLedger, at_the_step_of_the_report)
{
  const double step = 0.1 * std::pow(std::pow(material.E_eff(), 2.0) * 5.0, -0.2);
  const int steps = count(1500, 100000);
  const Integrator mts{"mts", 1};
  const std::string of = std::to_string(steps) + " steps of f3 = ";
  expect_criterion("C26 mts: energy missing, no damping and friction, " + of + "0.1",
                   ledger(mts, "", 10, steps, step).missing, 0.0, 1e-3);
  const double coarse = ledger(mts, all_modes, 10, steps, step).missing;
  const double fine = ledger(mts, all_modes, 10, 2 * steps, 0.5 * step).missing;
  expect_criterion("C26 mts: energy missing, all modes, " + of + "0.05", fine, 0.0, 1e-3);
  expect_criterion("C26 mts: order of the step, all modes", std::log2(coarse / fine), 1.0, 4.0);
}

}    // namespace
