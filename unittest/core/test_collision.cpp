// Head-on collisions through the kernel: restitution, contact time, sticking.

#include "two_bodies.h"

#include <gtest/gtest.h>
#include <vector>

using namespace apf;
using namespace apf_test;

namespace {

// A damped adhesive impact, integrated independently of the kernel: JKR in its classical form with
// work of adhesion w, fourth-order Runge-Kutta in long double, in the variable s = sqrt(a):
//   overlap = s^4/R - sqrt(2 pi w/E) s,  F = 4 E s^6/(3 R) - sqrt(8 pi w E) s^3
// and in the parameter tau with d overlap/ds dtau = dt, in which the end of the neck is regular.
struct ReferenceImpact {
  using Real = long double;
  Real R, E, w, m, alpha;

  struct State {
    Real s, v;
  };

  Real pull() const { return sqrtl(2.0L * M_PIl * w / E); }
  Real stretch(Real s) const { return 4.0L * s * s * s / R - pull(); }    // d overlap/ds
  State rate(const State &y) const
  {
    const Real s3 = y.s * y.s * y.s;
    const Real force = 4.0L * E * s3 * s3 / (3.0L * R) - sqrtl(8.0L * M_PIl * w * E) * s3;
    const Real eta = alpha * sqrtl(m * 4.0L / 3.0L * E) * y.s;
    return {y.v, -stretch(y.s) * (force + eta * y.v) / m};
  }
  State advanced(const State &y, Real h) const
  {
    auto moved = [&y](const State &k, Real step) {
      return State{y.s + step * k.s, y.v + step * k.v};
    };
    const State k1 = rate(y), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2));
    const State k4 = rate(moved(k3, h));
    return {y.s + h / 6 * (k1.s + 2 * k2.s + 2 * k3.s + k4.s),
            y.v + h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v)};
  }

  // e from first touch (overlap 0) to the end of the neck (d overlap/ds = 0); 0: sticks
  Real restitution(Real V) const
  {
    const Real end = cbrtl(pull() * R / 4.0L);
    State y{cbrtl(pull() * R), V};
    Real h = y.s / (400.0L * V);
    for (bool returning = false;;) {
      const State next = advanced(y, h);
      if (next.s < end) {    // halve the step until the end of the neck is met
        if (h * V < 1e-15L * end) return -next.v / V;
        h *= 0.5L;
        continue;
      }
      y = next;
      if (returning && y.v > 0.0L) return 0.0L;
      returning = y.v < 0.0L;
    }
  }
};

ReferenceImpact reference(const TwoBodies &two)
{
  const Interface &surface = two.model.surface;
  return {two.bodies.R, surface.E, 2.0L * surface.gamma, two.bodies.m, two.model.alpha};
}

TwoBodies sticky_pair(double alpha = 0.0)
{
  ContactModel model = sticky_model();
  model.alpha = alpha;
  return TwoBodies::spheres(model, 5.0e-6, 8.0e-6, 2500.0, 1500.0);
}

// The lowest speed that rebounds, by bisection.
double sticking_speed(TwoBodies two, double low, double high)
{
  for (int n = 0; n < 14; n++) {
    const double V = 0.5 * (low + high);
    (head_on(two, V, 500).restitution > 0.0 ? high : low) = V;
  }
  return 0.5 * (low + high);
}

Interface of_equals(double E, double nu)
{
  return interface({E, nu, 0.0}, {E, nu, 0.0});
}

ContactModel hertz_of(const Interface &surface)
{
  return hertz_model(surface.E, surface.G);
}

}    // namespace

TEST(Collision, undamped_hertz_is_elastic)
{
  auto two = TwoBodies::spheres(hertz_model(1.0e9, 3.0e8), 1.0e-3, 2.0e-3);
  EXPECT_NEAR(head_on(two, 0.3).restitution, 1.0, 1e-4);
}

TEST(Collision, damping_gives_the_restitution_of_antypov_and_elliott)
{
  const double table[][2] = {
      {0.0749, 0.9}, {0.2522, 0.7}, {0.4818, 0.5}, {0.8002, 0.3}, {1.0195, 0.2}};
  for (const auto &[alpha, e] : table) {
    EXPECT_NEAR(damping_from_restitution(e), alpha, 6e-5);
    auto model = hertz_model(1.0e9, 3.0e8);
    model.alpha = alpha;
    auto two = TwoBodies::spheres(model, 1.0e-3, 1.0e-3);
    EXPECT_NEAR(head_on(two, 0.5).restitution / e, 1.0, 0.005) << alpha;
  }
}

TEST(Collision, restitution_depends_on_damping_alone)
{
  struct {
    double E, ri, rj, rho_i, rho_j, V;
  } const cases[] = {{1e9, 1e-3, 1e-3, 2500, 2500, 1e-4}, {1e9, 1e-3, 1e-3, 2500, 2500, 50.0},
                     {1e5, 1e-6, 3e-5, 2500, 1.0, 0.1},   {2e11, 0.2, 0.05, 8000, 700, 2.0},
                     {7e10, 1e-4, 1e-1, 10, 1e4, 1.0},    {1.0, 0.5, 0.5, 1.0, 1.0, 1e-2}};
  for (const double e : {0.98, 0.6, 0.2})
    for (const auto &c : cases) {
      auto model = hertz_model(c.E, 0.3 * c.E);
      model.alpha = damping_from_restitution(e);
      auto pair = TwoBodies::spheres(model, c.ri, c.rj, c.rho_i, c.rho_j);
      EXPECT_NEAR(head_on(pair, c.V).restitution, e, 5e-4) << c.E << " at " << c.V;
      auto wall = TwoBodies::at_wall(model, c.ri, c.rho_i);
      EXPECT_NEAR(head_on(wall, c.V).restitution, e, 5e-4) << c.E << " at " << c.V;
    }
}

TEST(Collision, spheres_of_chung_and_ooi_test_1)    // doi:10.1007/s10035-011-0277-0
{
  auto glass = TwoBodies::spheres(hertz_of(of_equals(48e9, 0.2)), 0.01, 0.01, 2800.0, 2800.0);
  Rebound r = head_on(glass, 20.0, 4000);
  EXPECT_NEAR(r.max_force / 10.70e3, 1.0, 1e-3);
  EXPECT_NEAR(r.max_overlap / 274.1e-6, 1.0, 1e-3);
  EXPECT_NEAR(r.duration / 40.34e-6, 1.0, 1e-3);
  auto limestone = TwoBodies::spheres(hertz_of(of_equals(20e9, 0.25)), 0.01, 0.01, 2500.0, 2500.0);
  r = head_on(limestone, 20.0, 4000);
  EXPECT_NEAR(r.max_force / 7108.0, 1.0, 1e-3);
  EXPECT_NEAR(r.max_overlap / 368.3e-6, 1.0, 1e-3);
  EXPECT_NEAR(r.duration / 54.20e-6, 1.0, 1e-3);
}

TEST(Collision, sphere_on_rigid_plane_of_chung_and_ooi_test_2)
{
  const Material rigid{INFINITY, 0.3, 0.0};
  auto aluminium = TwoBodies::at_wall(hertz_of(interface({70e9, 0.3, 0.0}, rigid)), 0.1, 2699.0);
  Rebound r = head_on(aluminium, 0.2, 4000);
  EXPECT_NEAR(r.max_force / 11.37e3, 1.0, 1e-3);
  EXPECT_NEAR(r.max_overlap / 49.72e-6, 1.0, 1e-3);
  EXPECT_NEAR(r.duration / 731.6e-6, 1.0, 1e-3);
  auto magnesium = TwoBodies::at_wall(hertz_of(interface({40e9, 0.35, 0.0}, rigid)), 0.1, 1800.0);
  r = head_on(magnesium, 0.2, 4000);
  EXPECT_NEAR(r.max_force / 7233.0, 1.0, 1e-3);
  EXPECT_NEAR(r.max_overlap / 52.12e-6, 1.0, 1e-3);
  EXPECT_NEAR(r.duration / 767.0e-6, 1.0, 1e-3);
}

TEST(Collision, reference_integrator_meets_the_closed_restitution)
{
  const auto two = sticky_pair();
  const auto impact = reference(two);
  for (const double ratio : {1.01, 1.5, 3.0, 30.0}) {
    const double e = static_cast<double>(impact.restitution(ratio * two.sticking_speed()));
    EXPECT_NEAR(e, std::sqrt(1.0 - 1.0 / (ratio * ratio)), 1e-5) << ratio;
  }
}

TEST(Collision, undamped_adhesive_restitution_has_its_closed_form)
{
  auto two = sticky_pair();
  for (const double ratio : {1.05, 1.2, 1.5, 2.0, 3.0, 5.0, 10.0}) {
    const double e = head_on(two, ratio * two.sticking_speed()).restitution;
    EXPECT_NEAR(e, std::sqrt(1.0 - 1.0 / (ratio * ratio)), 1e-3) << ratio;
  }
  EXPECT_EQ(head_on(two, 0.98 * two.sticking_speed()).restitution, 0.0);
  EXPECT_EQ(head_on(two, 0.3 * two.sticking_speed()).restitution, 0.0);
}

TEST(Collision, sticking_speed_is_that_of_thornton_and_ning)    // doi:10.1016/S0032-5910(98)00099-0
{
  const double w = 2.0 * sticky_model().surface.gamma, E = sticky_model().surface.E;
  const double r = 4.0e-6, rho = 2000.0;
  auto formula = [&](double R) {
    return std::pow(std::pow(w / R, 5) / (rho * rho * rho * E * E), 1.0 / 6.0);
  };
  const double V = 1.8402 * formula(r);
  EXPECT_NEAR(sticking_speed(TwoBodies::at_wall(sticky_model(), r, rho), 0.9 * V, 1.1 * V) / V, 1.0,
              1e-3);
  const double U = 0.9201 * formula(0.5 * r);
  const auto pair = TwoBodies::spheres(sticky_model(), r, r, rho, rho);
  EXPECT_NEAR(sticking_speed(pair, 0.9 * U, 1.1 * U) / U, 1.0, 1e-3);
}

TEST(Collision, ammonium_fluorescein_sticks_to_a_wall_below_one_metre_per_second)
{
  // d = 2.45 um, E = 1.2 GPa on 182 GPa, work of adhesion 0.2 J/m^2: elastic limit 1.011 m/s
  ContactModel model;
  model.surface = interface({1.2e9, 0.3, 0.1}, {182e9, 0.3, 0.1});
  EXPECT_NEAR(sticking_speed(TwoBodies::at_wall(model, 1.225e-6, 1350.0), 0.8, 1.2), 1.011, 2e-3);
}

TEST(Collision, damped_adhesive_restitution_agrees_with_the_reference_integrator)
{
  for (const double alpha : {0.0, 0.25, 0.5, 1.02}) {
    auto two = sticky_pair(alpha);
    const auto impact = reference(two);
    for (const double ratio : {1.0, 1.5, 2.0, 3.0, 5.0, 10.0, 30.0}) {
      const double V = ratio * two.sticking_speed();
      const double expected = static_cast<double>(impact.restitution(V));
      EXPECT_NEAR(head_on(two, V).restitution, expected, 0.005) << alpha << " at " << ratio;
    }
  }
}

TEST(Collision, reference_and_kernel_stick_at_the_same_speed_when_damped)
{
  const auto two = sticky_pair(0.5);
  const auto impact = reference(two);
  const double V = sticking_speed(two, two.sticking_speed(), 5.0 * two.sticking_speed());
  EXPECT_EQ(static_cast<double>(impact.restitution(0.99 * V)), 0.0);
  EXPECT_GT(static_cast<double>(impact.restitution(1.01 * V)), 0.0);
}

TEST(Collision, damped_restitution_depends_on_speed_ratio_and_damping_alone)
{
  ContactModel other;
  other.surface = {5.0e10, 1.0e10, 0.02};
  other.alpha = 0.25;
  auto stiff = TwoBodies::at_wall(other, 1.0e-6, 3000.0);
  auto soft = sticky_pair(0.25);
  for (const double ratio : {2.5, 4.0, 10.0})
    EXPECT_NEAR(head_on(stiff, ratio * stiff.sticking_speed()).restitution,
                head_on(soft, ratio * soft.sticking_speed()).restitution, 2e-3)
        << ratio;
}

TEST(Collision, neck_end_at_the_force_maximum_loses_half_of_the_energy)
{
  auto two = sticky_pair();
  two.model.neck_end = Break::force;
  two.constants = ContactConstants::make(two.model, two.bodies);
  const double V = 0.70275 * two.sticking_speed();
  EXPECT_NEAR(sticking_speed(two, 0.8 * V, 1.2 * V) / V, 1.0, 1e-3);
  for (const double ratio : {1.1, 2.0}) {
    const double speed = ratio * two.sticking_speed();
    const double e = head_on(two, speed).restitution;
    const double lost = 0.5 * two.bodies.m * speed * speed * (1.0 - e * e);
    EXPECT_NEAR(lost / (two.pulloff_force() * two.pulloff_overlap()), 0.462014, 2e-3) << ratio;
  }
}

TEST(Collision, without_a_neck_adhesion_loses_nothing)
{
  auto two = sticky_pair();
  const double V = two.sticking_speed();
  two.model.neck_end = Break::touch;
  two.constants = ContactConstants::make(two.model, two.bodies);
  for (const double ratio : {0.3, 1.1, 2.0})
    EXPECT_NEAR(head_on(two, ratio * V).restitution, 1.0, 2e-3) << ratio;
}

TEST(Collision, softer_contact_keeps_sticking_speed_and_restitution)
{
  for (const double f : {1.0, 1e-1, 1e-2, 1e-3, 1e-4}) {
    ContactModel model;
    model.surface = {5.0e10, 1.0e10, 0.02};    // a0/R = 0.013, or 0.08 at f = 1e-4
    model.stiffness_scale = f;
    auto two = TwoBodies::spheres(model, 5.0e-6, 5.0e-6);
    const double V = two.sticking_speed();    // of the real material
    EXPECT_NEAR(sticking_speed(two, 0.8 * V, 1.2 * V) / V, 1.0, 0.01) << f;
    two.model.alpha = 0.25;
    two.constants = ContactConstants::make(two.model, two.bodies);
    const auto impact = reference(two);
    for (const double ratio : {3.0, 10.0}) {
      const double expected = static_cast<double>(impact.restitution(ratio * V));
      EXPECT_NEAR(head_on(two, ratio * V).restitution / expected, 1.0, 0.01)
          << f << " at " << ratio;
    }
  }
}

TEST(Collision, energy_lost_is_the_neck_and_the_work_of_damping)
{
  auto two = sticky_pair(0.5);
  const double V = 8.0 * two.sticking_speed(), dt = two.contact_time(V) / 4000;
  two.place(0.0);
  two.v[0] = V;
  const double before = two.kinetic_energy();
  two.contact_forces(0.0);
  double damped = 0.0, power = two.parts.damping * two.closing_speed();
  while (!two.ended()) {
    two.step(dt);
    const double next = two.parts.damping * two.closing_speed();
    if (!two.ended()) damped += 0.5 * dt * (power + next);
    power = next;
  }
  const double neck = 0.935503 * two.pulloff_force() * two.pulloff_overlap();
  EXPECT_NEAR((before - two.kinetic_energy()) / (damped + neck), 1.0, 1e-3);
  EXPECT_GT(damped, neck);    // both matter here
}
