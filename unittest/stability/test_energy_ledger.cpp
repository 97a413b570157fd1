// C26, C27: adhesive spheres that collide and stick, with damping, sliding, rolling and twisting.
// The work of each dissipative force is summed up from outside, from compute pair/local and the
// motion of the particles, and must account for all the energy that is lost, mode by mode.

#include "integrators.h"
#include "necks.h"

#include <algorithm>
#include <array>
#include <random>
#include <utility>

namespace {

const Material material;
const JkrCurve curve = material.pair();
const double unit = curve.F_C() * curve.delta_C();
const double mass = pi / 6.0, inertia = 0.1 * mass;

enum { DAMPING, SLIDING, ROLLING, TWISTING, MODES };
using Powers = std::array<double, MODES>;

struct Motion {
  std::vector<double> x, v, w;
};

Motion motion_of(Simulation &sim)
{
  return {gather(sim, "x"), gather(sim, "v"), gather(sim, "omega")};
}

// power that the contact forces of each mode give to the particles
Powers powers(const std::vector<LocalRow> &contacts, const Motion &m, double box)
{
  Powers sum{};
  for (const auto &[p, a, b] : contacts) {
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
  return sum;
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
  Powers lost;        // by each mode, of the energy at the start
  double broken;      // necks, counted from lists of contacts
};
const std::string all_modes = "damping tsuji 0.8 sliding 0.3 twisting yes rolling 0.02 0.1";

// The report's collision step, f3 d (rho^2 / (E^2 U))^(1/5) with f3 = 0.1, U as the speeds at the
// start
const double report_step = 0.1 * std::pow(std::pow(material.E_eff(), 2.0) * 5.0, -0.2);

// A row of the documentation's table: tools/cases puts together the properties of this name.
void record_account(const Integrator &integrator, bool modes, int spheres, int steps, double step,
                    const std::vector<double> &shares)
{
  const std::string law = modes ? "all" : "necks alone";
  char key[128], numbers[16];
  snprintf(key, sizeof(key), "ledger|%s|%d|%s|%d|%d|%.3g", integrator.name.c_str(),
           integrator.inner, law.c_str(), spheres, steps, step / report_step * 0.1);
  std::string text;
  for (size_t n = 0; n < shares.size(); n++) {
    const bool last = n + 1 == shares.size();
    const double share = std::fabs(shares[n]) < 5e-6 && !last ? 0.0 : shares[n];    // no -0
    snprintf(numbers, sizeof(numbers), last ? "%.1e" : "%.5f|", share);
    text += numbers;
  }
  testing::Test::RecordProperty(key, text);
}

// What is looked at from outside is seen between particle steps only, the work within one by the
// trapezoidal rule: as contacts begin at any time between two looks it is right in the mean.
//   every   particle steps between two looks, shorter than a contact lasts
Account ledger(const Integrator &integrator, const std::string &modes, int side, int steps,
               double step, int every = 1)
{
  const int N = side * side * side, between = every * integrator.inner;
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
  sim.run("neighbor " + digits(std::max(0.3, 120.0 * integrator.inner * step)) +
          " bin\ncompute parts all pair granular/adhesive\n" + local_contacts +
          "thermo_style custom step pe c_parts[1] c_parts[2] c_parts[3] c_parts[4]\n"
          "thermo_modify norm no\nthermo 1000000\n" +
          integrator.commands(step) + "run 0");
  auto contacts = contacts_of(sim);
  Necks before = necks_of(contacts);
  Motion motion = motion_of(sim);
  const double E0 = kinetic(motion);
  Powers last = powers(contacts, motion, width), work{};
  std::array<double, 3> p0{}, change{};
  for (size_t n = 0; n < v.size(); n++) p0[n % 3] += v[n];
  double size = 0.0, broken = 0.0;
  for (const double c : v) size += std::fabs(c);
  // r-RESPA sets up every run; contacts go on through the ends of runs
  const std::string next = "run " + std::to_string(every) +
      (integrator.name == "respa" ? " post no" : " pre no post no");
  for (int n = 0; n < steps; n += between) {
    sim.run(next);
    motion = motion_of(sim);
    contacts = contacts_of(sim);
    const Powers power = powers(contacts, motion, width);
    for (int k = 0; k < MODES; k++) work[k] += 0.5 * between * step * (last[k] + power[k]);
    last = power;
    const Necks now = necks_of(contacts);
    broken += ended(before, now);
    before = now;
  }
  for (size_t n = 0; n < motion.v.size(); n++) change[n % 3] += motion.v[n];
  for (int c = 0; c < 3; c++) change[c] = std::fabs(change[c] - p0[c]) / size;
  // Energy of necks is counted from where they opened. Of JKR's that of the surfaces is
  // -2 gamma pi a^2, the rest is elastic.
  double adhesive = 0.846614 * unit * before.size();
  for (const auto &one : contacts) adhesive -= 2.0 * material.gamma * pi * one.p[2] * one.p[2];
  const double moving = kinetic(motion),
               elastic = sim.value("c_parts[1]") + 0.846614 * unit * before.size() - adhesive,
               necks = 0.935503 * unit * broken;
  double springs = 0.0;
  Powers lost{};
  lost[DAMPING] = -work[DAMPING];
  for (const int k : {SLIDING, ROLLING, TWISTING}) {
    const double kept = sim.value("c_parts[" + std::to_string(k + 1) + "]");
    lost[k] = -work[k] - kept;
    springs += kept;
  }
  double sum = moving + elastic + adhesive + springs + necks;
  for (double &one : lost) {
    sum += one;
    one /= E0;
  }
  const double missing = sum / E0 - 1.0;
  record_account(integrator, !modes.empty(), N, steps, step,
                 {moving / E0, elastic / E0, adhesive / E0, springs / E0, necks / E0, lost[DAMPING],
                  lost[SLIDING], lost[ROLLING], lost[TWISTING], missing});
  EXPECT_GT(elastic, 0.0);
  EXPECT_LT(adhesive, 0.0);
  EXPECT_GT(before.size(), N / 20u);
  for (const double one : modes.empty() ? Powers{1.0, 1.0, 1.0, 1.0} : lost)
    EXPECT_GT(one, 1e-6) << "each mode takes part";
  return {std::fabs(missing), *std::max_element(change.begin(), change.end()), lost, broken};
}

std::string words(int side, int steps, const Integrator &integrator)
{
  return std::to_string(side * side * side) + " spheres, " + std::to_string(steps) +
      " steps, N = " + std::to_string(integrator.inner);
}

// dt / 2 is omega dt = 0.028 of the stiffest mode, the tangential one
Account single_rate(int side, int steps, int every)
{
  const Integrator verlet{"verlet", 1};
  const std::string what = words(side, steps, verlet) + ", omega dt = 0.028";
  const auto account = ledger(verlet, all_modes, side, steps, 0.5 * dt, every);
  expect_criterion("C26 verlet: energy missing from the ledger of all modes, " + what,
                   account.missing, 0.0, 2e-4);
  expect_criterion("C27 verlet: change of momentum, " + what, account.momentum, 0.0, 1e-12);
  return account;
}

const std::vector<Integrator> many_rates = {{"respa", 40}, {"mts", 40}};

// Particle steps of 40 collision steps lose what a single rate loses, by each mode.
TEST(EnergyLedger, thousand_spheres)
{
  const auto alone = single_rate(10, count(3000, 100000), 1);
  for (const auto &one : many_rates) {
    const int steps = count(12000, 400000);    // a quarter as long, so that their work is seen
    const std::string what = words(10, steps, one) + ", omega dt = 0.007";
    const auto account = ledger(one, all_modes, 10, steps, 0.125 * dt);
    expect_criterion(one.of("C26 *: energy missing from the ledger of all modes, " + what),
                     account.missing, 0.0, 5e-4);
    double differ = 0.0;
    for (int k = 0; k < MODES; k++)
      differ = std::max(differ, std::fabs(account.lost[k] - alone.lost[k]));
    expect_criterion(one.of("C26 *: what a mode takes less that of verlet, of the energy, " + what),
                     differ, 0.0, 3e-3);
    expect_criterion(one.of("C26 *: necks that ended over those of verlet, " + what),
                     account.broken / alone.broken, 0.98, 1.02);
    expect_criterion(one.of("C27 *: change of momentum, " + what), account.momentum, 0.0, 1e-12);
  }
}

TEST(EnergyLedger, elastic_spheres)
{
  const int steps = count(3000, 100000);
  const auto alone = ledger({"verlet", 1}, "", 10, steps, 0.5 * dt);
  expect_criterion("C27 verlet: change of momentum, no damping and friction, " +
                       words(10, steps, {"verlet", 1}),
                   alone.momentum, 0.0, 1e-12);
  for (const auto &one : many_rates) {
    const std::string what = "no damping and friction, " + words(10, steps, one);
    const auto account = ledger(one, "", 10, steps, 0.5 * dt);
    expect_criterion(one.of("C26 *: energy missing, " + what), account.missing, 0.0, 1e-5);
    expect_criterion(one.of("C26 *: necks that ended over those of verlet, " + what),
                     account.broken / alone.broken, 0.98, 1.02);
    expect_criterion(one.of("C27 *: change of momentum, " + what), account.momentum, 0.0, 1e-12);
  }
}

// 1e4 and 1e5, an hour each the largest: a test for every run, so that they go on beside each other
void many_spheres(int side, const Integrator &one, int every = 1)
{
  if (!std::getenv("APF_LONG")) GTEST_SKIP() << "long: tools/cases --long";
  if (one.inner == 1) {
    single_rate(side, 100000, every);
    return;
  }
  const std::string what = words(side, 100000, one) + ", omega dt = 0.007";
  const auto account = ledger(one, all_modes, side, 100000, 0.125 * dt);
  expect_criterion(one.of("C26 *: energy missing from the ledger of all modes, " + what),
                   account.missing, 0.0, 5e-4);
  expect_criterion(one.of("C27 *: change of momentum, " + what), account.momentum, 0.0, 1e-12);
}

// clang-format off
TEST(EnergyLedger, ten_thousand_spheres_verlet) { many_spheres(22, {"verlet", 1}, 5); }
TEST(EnergyLedger, ten_thousand_spheres_respa) { many_spheres(22, many_rates[0]); }
TEST(EnergyLedger, ten_thousand_spheres_mts) { many_spheres(22, many_rates[1]); }
TEST(EnergyLedger, hundred_thousand_spheres_verlet) { many_spheres(46, {"verlet", 1}, 10); }
TEST(EnergyLedger, hundred_thousand_spheres_respa) { many_spheres(46, many_rates[0]); }
TEST(EnergyLedger, hundred_thousand_spheres_mts) { many_spheres(46, many_rates[1]); }
// clang-format on

// At the report's step contacts themselves meet the criterion; dashpots and sliders, whose
// velocities are half a step old, at half of the step. N is small: an impact lasts some 25 of these
// steps, and what it does is to be seen from outside.
TEST(EnergyLedger, at_the_step_of_the_report)
{
  const int steps = count(1500, 100000);
  const auto run = [&](const std::string &modes, const Integrator &by, int finer) {
    return modes + ", " + std::to_string(finer * steps) +
        " steps of f3 = " + (finer == 1 ? "0.1" : "0.05") + ", N = " + std::to_string(by.inner);
  };
  const auto named = [](const std::string &modes) {
    return modes.empty() ? "no damping and friction" : "all modes";
  };
  const auto missing = [&](const Integrator &by, const std::string &modes, int finer) {
    const auto account = ledger(by, modes, 10, finer * steps, report_step / finer);
    expect_criterion(by.of("C27 *: change of momentum, " + run(named(modes), by, finer)),
                     account.momentum, 0.0, 1e-12);
    return account.missing;
  };
  const auto what = [&](const Integrator &by, const std::string &modes, int finer) {
    return by.of("C26 *: energy missing, " + run(modes, by, finer));
  };
  // for necks alone, for all modes
  const std::pair<Integrator, Integrator> trials[] = {
      {{"verlet", 1}, {"verlet", 1}}, {{"respa", 8}, {"respa", 2}}, {{"mts", 8}, {"mts", 1}}};
  for (const auto &[alone, all] : trials) {
    expect_criterion(what(alone, "no damping and friction", 1), missing(alone, "", 1), 0.0, 1e-3);
    const double coarse = missing(all, all_modes, 1), fine = missing(all, all_modes, 2);
    expect_unmet(what(all, "all modes", 1), coarse, 0.0, 1e-3, 5e-3,
                 "dashpots and sliders have velocities that are half a step old");
    expect_criterion(what(all, "all modes", 2), fine, 0.0, 1e-3);
    expect_criterion(all.of("C26 *: what is missing at half the step, of that, all modes, N = ") +
                         std::to_string(all.inner),
                     fine / coarse, 0.0, 0.5);
  }
  const Integrator four{"mts", 4};
  expect_criterion(what(four, "all modes", 2), missing(four, all_modes, 2), 0.0, 1e-3);
}

}    // namespace
