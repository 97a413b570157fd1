// The normal law: JKR and its limit, Hertz.

#include "criterion.h"

#include "contact/jkr.h"

#include <gtest/gtest.h>
#include <vector>

using namespace apf;

namespace {

// The same law in different units and at different softness a0/R (from 7e-4 to 0.8).
struct Scale {
  const char *name;
  double R, E, gamma;

  JKR law() const { return JKR::make(R, E, gamma); }
  // eqs (38), (41)
  double a0() const { return std::cbrt(9.0 * pi * gamma * R * R / E); }
  double F_C() const { return 3.0 * pi * gamma * R; }
  double delta_C() const { return a0() * a0() / (2.0 * std::cbrt(6.0) * R); }
  double root(double overlap_over_delta_C) const
  {
    return law().root(overlap_over_delta_C * delta_C());
  }
  double radius(double s) const { return R * s * s / a0(); }
  double force(double s) const { return law().force(s) / F_C(); }
  double energy(double s) const { return law().energy(s) / (F_C() * delta_C()); }
};

const std::vector<Scale> scales = {{"SI, 10 um, stiff", 5.0e-6, 5.5e10, 0.03},
                                   {"SI, 1 um, soft", 5.0e-7, 2.0e8, 0.2},
                                   {"cgs", 1.0e-3, 1.0e9, 50.0},
                                   {"reduced", 0.5, 1.0e4, 1.5},
                                   {"reduced, far too soft", 1.0, 1.0, 0.02},
                                   {"SI, 1 m", 1.0, 7.0e10, 1.0}};

// Classical JKR in the contact radius a with work of adhesion w = 2 gamma, by bisection:
// F = 4 E a^3/(3 R) - sqrt(8 pi w E a^3), overlap = a^2/R - sqrt(2 pi w a/E).
struct ClassicalJKR {
  long double R, E, w;

  long double overlap(long double a) const { return a * a / R - sqrtl(2.0L * M_PIl * w * a / E); }
  long double force(long double a) const
  {
    return 4.0L * E * a * a * a / (3.0L * R) - sqrtl(8.0L * M_PIl * w * E * a * a * a);
  }
  // of a contact that bears a load: beyond the radius at which the force is least, -F_C
  long double overlap_under(long double load) const
  {
    long double low = cbrtl(9.0L * M_PIl * w * R * R / (8.0L * E)), high = low;    // dF/da = 0
    while (force(high) < load) high *= 2.0L;
    for (int n = 0; n < 200; n++) {
      const long double mid = 0.5L * (low + high);
      (force(mid) < load ? low : high) = mid;
    }
    return overlap(0.5L * (low + high));
  }
  long double contact_radius(long double delta) const
  {
    long double low = cbrtl(R * R * M_PIl * w / (8.0L * E)), high = low;    // d overlap/da = 0
    while (overlap(high) < delta) high *= 2.0L;
    for (int n = 0; n < 200; n++) {
      const long double mid = 0.5L * (low + high);
      (overlap(mid) < delta ? low : high) = mid;
    }
    return 0.5L * (low + high);
  }
};

double hertz_force(double R, double E, double overlap)
{
  return 4.0 / 3.0 * E * std::sqrt(R) * std::pow(overlap, 1.5);
}

// Work along the law from one overlap to another, trapezoidal in s.
double work(const JKR &law, double s_from, double s_to)
{
  const int n = 20000;
  double sum = 0.0;
  for (int k = 0; k < n; k++) {
    const double s0 = s_from + (s_to - s_from) * k / n, s1 = s_from + (s_to - s_from) * (k + 1) / n;
    sum += 0.5 * (law.force(s0) + law.force(s1)) * (law.overlap(s1) - law.overlap(s0));
  }
  return sum;
}

}    // namespace

TEST(JKR, radius_and_force_follow_the_published_curve)
{
  const double row[][3] = {
      {-0.999, 0.316447, -0.585297}, {-0.99, 0.346160, -0.648741}, {-0.9, 0.442553, -0.830926},
      {-0.75, 0.526774, -0.944614},  {-0.5, 0.623598, -0.999772},  {-0.25, 0.698984, -0.971515},
      {0.0, 0.763143, -0.888889},    {0.25, 0.820065, -0.764523},  {0.5, 0.871810, -0.605578},
      {1.0, 0.964265, -0.201195},    {1.5, 1.046256, 0.300423},    {2.0, 1.120755, 0.885107},
      {3.0, 1.253780, 2.268041},     {5.0, 1.478673, 5.740016},    {10.0, 1.916932, 17.559825},
      {30.0, 3.069666, 94.187207}};
  for (const Scale &unit : scales)
    for (const auto &[overlap, radius, force] : row) {
      const double s = unit.root(overlap);
      EXPECT_NEAR(unit.radius(s), radius, 5.1e-7) << unit.name << " at " << overlap;
      EXPECT_NEAR(unit.force(s), force, 5.1e-7) << unit.name << " at " << overlap;
    }
}

TEST(JKR, closed_points_are_exact)
{
  struct Point {
    const char *name;
    double overlap, radius, force, energy;    // in delta_C, a0, F_C, F_C delta_C
  };
  // energy 4 6^(1/3) (0.8 h^5 - 4/3 h^(7/2) + h^2/3), h = a/a0
  const double c = std::cbrt(6.0);
  const Point points[] = {
      {"equilibrium", 2.0 * c / 3.0, 1.0, 0.0, -0.8 * c},
      {"first touch", 0.0, std::cbrt(4.0 / 9.0), -8.0 / 9.0,
       4.0 * c * std::cbrt(16.0 / 81.0) * (0.8 * 4.0 / 9.0 - 8.0 / 9.0 + 1.0 / 3.0)},
      {"pull-off force", -std::cbrt(1.0 / 9.0), std::cbrt(0.25), -1.0, -0.8 / 3.0 * std::cbrt(3.0)},
      {"end of the neck", -1.0, std::cbrt(1.0 / 36.0), -5.0 / 9.0, 4.0 / 45.0}};
  for (const Scale &unit : scales)
    for (const Point &p : points) {
      const double s = std::sqrt(p.radius * unit.a0() / unit.R);    // not through the root
      EXPECT_NEAR(unit.law().overlap(s) / unit.delta_C(), p.overlap, 1e-10) << unit.name << p.name;
      EXPECT_NEAR(unit.force(s), p.force, 1e-10) << unit.name << p.name;
      EXPECT_NEAR(unit.energy(s), p.energy, 1e-10) << unit.name << p.name;
      // at the end of the neck the radius is only as good as the root of rounding
      const double tolerance = p.overlap == -1.0 ? 1e-7 : 1e-10;
      EXPECT_NEAR(unit.radius(unit.root(p.overlap)), p.radius, tolerance) << unit.name << p.name;
    }
}

TEST(JKR, named_quantities_are_those_of_the_report)
{
  for (const Scale &unit : scales) {
    const JKR law = unit.law();
    EXPECT_NEAR(law.pulloff_force() / unit.F_C(), 1.0, 1e-13) << unit.name;
    EXPECT_NEAR(law.pulloff_overlap() / unit.delta_C(), 1.0, 1e-13) << unit.name;
    EXPECT_NEAR(law.equilibrium_radius() / unit.a0(), 1.0, 1e-13) << unit.name;
    EXPECT_NEAR(law.equilibrium_overlap() / unit.delta_C(), 1.211414, 5e-7) << unit.name;
    EXPECT_NEAR(unit.F_C() / (unit.E * std::pow(unit.a0(), 3) / (3.0 * unit.R)), 1.0, 1e-13);
  }
}

TEST(JKR, numbers_of_a_10_um_silica_pair_in_SI)
{
  // E = 5.5e10 Pa, gamma = 0.03 J/m^2, R = 5 um, by hand
  const JKR law = scales[0].law();
  EXPECT_NEAR(law.pulloff_force(), 1.413717e-6, 1e-12);
  EXPECT_NEAR(law.equilibrium_radius(), 7.278306e-8, 1e-14);
  EXPECT_NEAR(law.pulloff_overlap(), 2.915257e-10, 1e-16);
  EXPECT_NEAR(law.force(law.root(0.0)), -1.256637e-6, 1e-12);
}

TEST(JKR, largest_pull_is_the_pulloff_force)
{
  for (const Scale &unit : scales) {
    double least = 0.0, where = 0.0;
    for (int n = 0; n <= 20000; n++) {
      const double overlap = -1.0 + n * 1e-4, force = unit.force(unit.root(overlap));
      if (force < least) {
        least = force;
        where = overlap;
      }
    }
    EXPECT_NEAR(least, -1.0, 1e-8) << unit.name;
    EXPECT_NEAR(where, -0.480750, 1e-4) << unit.name;
  }
}

// From the largest pull to loads that make adhesion count for little.
TEST(JKR, overlap_under_a_load_is_where_the_force_balances_it)
{
  for (const Scale &unit : scales) {
    const JKR law = unit.law();
    const ClassicalJKR classical{unit.R, unit.E, 2.0 * unit.gamma};
    for (const double load : {-0.999, -0.9, -5.0 / 9.0, -0.1, 0.0, 0.1, 1.0, 10.0, 1e3, 1e6}) {
      const double known = classical.overlap_under(load * unit.F_C()) / unit.delta_C();
      EXPECT_NEAR(law.overlap_under(load * unit.F_C()) / unit.delta_C() / known, 1.0, 1e-11)
          << unit.name << " at " << load;
    }
    EXPECT_NEAR(law.overlap_under(0.0) / unit.delta_C(), 1.211414, 5e-7) << unit.name;
    EXPECT_NEAR(law.overlap_under(0.0) / law.equilibrium_overlap(), 1.0, 1e-14) << unit.name;
    // there as good as the root of rounding
    EXPECT_NEAR(law.overlap_under(-unit.F_C()) / unit.delta_C(), -0.480750, 6e-7) << unit.name;

    const JKR bare = JKR::make(unit.R, unit.E, 0.0);
    EXPECT_EQ(bare.overlap_under(0.0), 0.0) << unit.name;
    for (const double overlap : {1e-6 * unit.R, 0.3 * unit.R})
      EXPECT_NEAR(bare.overlap_under(hertz_force(unit.R, unit.E, overlap)) / overlap, 1.0, 1e-13);
  }
}

TEST(JKR, stiffness_at_equilibrium_is_six_fifths_E_a0)
{
  for (const Scale &unit : scales) {
    const double h = 1e-4, eq = std::cbrt(6.0) * 2.0 / 3.0;
    const double slope =
        (unit.force(unit.root(eq + h)) - unit.force(unit.root(eq - h))) / (2.0 * h);
    EXPECT_NEAR(slope, 0.990578, 1e-6) << unit.name;
    EXPECT_NEAR(slope * unit.F_C() / unit.delta_C() / (1.2 * unit.E * unit.a0()), 1.0, 1e-6);
  }
}

TEST(JKR, overlap_of_the_root_is_the_overlap_over_twenty_decades)
{
  for (const double neck : {1e-8, 1e-5, 1e-3, 0.03, 0.3, 1.0}) {
    const JKR law{1.0, 1.0, neck};
    const double delta_C = law.pulloff_overlap();
    for (double x = 1e-14; x < 1e6; x *= 1.05) {    // distance to the end of the neck
      const double overlap = delta_C * (x - 1.0);
      const double scale = std::max(std::fabs(overlap), delta_C);
      const double s = law.root(overlap);
      ASSERT_NEAR((law.overlap(s) - overlap) / scale, 0.0, 1e-12) << "neck " << neck << " x " << x;
    }
  }
}

TEST(JKR, end_of_the_neck_is_finite_and_meets_the_law)
{
  for (const Scale &unit : scales) {
    const JKR law = unit.law();
    for (const double step : {-1e-9, -1e-13, -1e-15, 0.0, 1e-15, 1e-13, 1e-9}) {
      const double overlap = -law.pulloff_overlap() * (1.0 - step);
      const double s = law.root(overlap);
      ASSERT_TRUE(std::isfinite(s)) << unit.name << step;
      EXPECT_GE(s, law.neck);
      if (step >= 0.0) {
        expect_criterion("C18 law: residual at the end of the neck, of delta_C",
                         std::fabs((law.overlap(s) - overlap) / law.pulloff_overlap()), 0.0, 1e-12);
      }
      // F + 5/9 F_C grows with the root of the distance to the end
      EXPECT_NEAR(unit.force(s), -5.0 / 9.0, 2.0 * std::sqrt(std::fabs(step)) + 1e-7);
    }
  }
}

// C18 asks for an error of 1e-3 F_C of a table. There is no table; this is that of the root.
TEST(JKR, end_of_the_neck_has_the_force_of_a_bisection)
{
  for (const Scale &unit : scales) {
    const ClassicalJKR classical{unit.R, unit.E, 2.0L * unit.gamma};
    for (double x = 1e-14; x < 100.0; x *= 1.3) {    // distance to the end, of delta_C
      const double overlap = unit.law().pulloff_overlap() * (x - 1.0);
      const long double known = classical.force(classical.contact_radius(overlap));
      expect_criterion(
          "C18 law: force of the root less that of a bisection, of F_C (no table)",
          std::fabs(static_cast<double>(unit.law().force(unit.law().root(overlap)) - known)) /
              unit.F_C() / std::max(1.0, x),
          0.0, 1e-6);
    }
  }
}

TEST(JKR, beyond_the_neck_the_root_stays_at_its_end)
{
  for (const Scale &unit : scales)
    for (const double overlap : {-1.001, -2.0, -1e3, -1e9})
      EXPECT_NEAR(unit.root(overlap) / unit.law().neck, 1.0, 1e-12) << unit.name << overlap;
}

TEST(JKR, force_and_radius_grow_with_overlap)
{
  for (const Scale &unit : scales) {
    double last = unit.root(-1.0);
    for (int n = 1; n <= 5000; n++) {
      const double s = unit.root(-1.0 + 1e-3 * n);
      ASSERT_GT(s, last) << unit.name << n;
      last = s;
    }
  }
}

TEST(JKR, vanishing_adhesion_is_hertz)
{
  const double R = 2.0e-3, E = 3.0e9;
  for (const double overlap : {1e-12, 1e-9, 1e-6, 1e-4}) {
    const JKR hertz = JKR::make(R, E, 0.0);
    const double s = hertz.root(overlap);
    EXPECT_NEAR(hertz.force(s) / hertz_force(R, E, overlap), 1.0, 1e-13) << overlap;
    EXPECT_NEAR(R * s * s / std::sqrt(R * overlap), 1.0, 1e-13) << overlap;
    EXPECT_NEAR(hertz.energy(s) / (0.4 * hertz_force(R, E, overlap) * overlap), 1.0, 1e-13);
  }
}

TEST(JKR, weak_adhesion_is_hertz_less_two_thirds_of_the_pulloff_force)
{
  // expansion of eqs (39), (40) for a >> a0: F = F_Hertz - 2/3 F_C + O(F_C (a0/a)^(3/2))
  const double R = 2.0e-3, E = 3.0e9, overlap = 1e-5;
  for (const double gamma : {1e-2, 1e-3, 1e-4, 1e-5}) {
    const JKR law = JKR::make(R, E, gamma);
    const double force = law.force(law.root(overlap));
    const double order = std::pow(law.equilibrium_radius() / std::sqrt(R * overlap), 1.5);
    EXPECT_NEAR((hertz_force(R, E, overlap) - force) / (3.0 * pi * gamma * R), 2.0 / 3.0,
                order + 1e-8 * 1e-2 / gamma)
        << gamma;
  }
}

TEST(JKR, is_the_classical_law_with_twice_the_surface_energy)
{
  for (const Scale &unit : scales) {
    const ClassicalJKR classical{unit.R, unit.E, 2.0L * unit.gamma};
    for (const double overlap :
         {-0.999999, -0.99, -0.7, -0.48, -0.1, 0.0, 0.3, 1.2, 4.0, 50.0, 1e4}) {
      const long double delta = overlap * unit.delta_C();
      const long double a = classical.contact_radius(delta);
      const double s = unit.law().root(static_cast<double>(delta));
      const double radius = static_cast<double>(a), force = static_cast<double>(classical.force(a));
      // near the end of the neck the radius amplifies rounding by the root of the distance
      const double tolerance = 1e-13 / std::sqrt(overlap + 1.0 + 1e-6) + 1e-13;
      EXPECT_NEAR(unit.R * s * s / radius, 1.0, tolerance) << unit.name << overlap;
      EXPECT_NEAR((unit.law().force(s) - force) / std::max(std::fabs(force), unit.F_C()), 0.0,
                  4.0 * tolerance)
          << unit.name << overlap;
    }
  }
}

TEST(JKR, slope_of_the_energy_is_the_force)
{
  for (const Scale &unit : scales)
    for (const double overlap : {-0.9, -0.5, 0.0, 0.7, 1.2, 3.0, 100.0}) {
      const double h = 1e-4;
      const double slope =
          (unit.energy(unit.root(overlap + h)) - unit.energy(unit.root(overlap - h))) / (2.0 * h);
      const double force = unit.force(unit.root(overlap));
      EXPECT_NEAR(slope, force, 1e-6 * std::max(1.0, std::fabs(force))) << unit.name << overlap;
    }
}

TEST(JKR, works_of_touching_parting_and_breaking)
{
  for (const Scale &unit : scales) {
    const JKR law = unit.law();
    const double unit_work = unit.F_C() * unit.delta_C();
    const double touch = unit.root(0.0), rest = unit.root(2.0 * std::cbrt(6.0) / 3.0);
    const double pull = unit.root(-std::cbrt(1.0 / 9.0)), end = law.neck;
    struct {
      const char *name;
      double from, to, value;
    } const works[] = {
        {"lost in a cycle of touching and parting", touch, end, 0.935503},
        {"breaking from equilibrium", rest, end, 1.542585},
        {"gained from touch to equilibrium", rest, touch, 0.607082},
        {"lost in a cycle with neck end at the force maximum", touch, pull, 0.462014}};
    for (const auto &w : works) {
      const double energy = (law.energy(w.to) - law.energy(w.from)) / unit_work;
      EXPECT_NEAR(energy, w.value, 6e-7) << unit.name << w.name;
      EXPECT_NEAR(energy, work(law, w.from, w.to) / unit_work, 1e-7) << unit.name << w.name;
    }
    const double w5 = std::pow(2.0 * unit.gamma, 5);
    const double johnson = 7.0922 * std::cbrt(w5 * std::pow(unit.R, 4) / (unit.E * unit.E));
    EXPECT_NEAR((law.energy(end) - law.energy(touch)) / johnson, 1.0, 1e-5) << unit.name;
  }
}
