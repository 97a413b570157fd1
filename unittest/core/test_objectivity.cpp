// What must not depend on who looks: rotation, boost, mirror, exchange of the two bodies, plane or
// space; and what nobody may create: linear and angular momentum.

#include "criterion.h"
#include "two_bodies.h"

#include <gtest/gtest.h>
#include <random>
#include <vector>

using namespace apf;
using namespace apf_test;

namespace {

ContactModel full_model(double alpha)
{
  ContactModel model = sticky_model();
  model.alpha = alpha;
  model.mu = 0.3;
  model.twisting = true;
  model.theta_crit = 0.02;
  model.zeta = 0.1;
  return model;
}

Vec3 unit(const Vec3 &u)
{
  return (1.0 / std::sqrt(norm2(u))) * u;
}

// Rodrigues' formula
Vec3 rotated(const Vec3 &u, const Vec3 &axis, double angle)
{
  return std::cos(angle) * u + std::sin(angle) * cross(axis, u) +
      ((1.0 - std::cos(angle)) * dot(axis, u)) * axis;
}

void expect_near(const Vec3 &u, const Vec3 &expected, double tolerance, const char *what)
{
  EXPECT_NEAR(std::sqrt(norm2(u - expected)), 0.0, tolerance) << what;
}

// A chain of equal spheres with loaded springs that is turned as one rigid body.
struct RigidChain {
  std::vector<Vec3> start;
  ContactList list;
  ContactKernel kernel;
  std::vector<double> x, v, omega, f, torque;

  explicit RigidChain(const std::vector<Vec3> &directions)
  {
    const ContactModel model = full_model(0.3);
    const double r = 4.0e-6;
    const auto constants = TwoBodies::spheres(model, r, r).constants;
    const JKR normal = model.normal(0.5 * r);
    KernelChoice choice;
    choice.include(model);
    kernel = contact_kernel(choice);
    start.push_back({1.0e-6, -2.0e-6, 3.0e-6});
    for (const Vec3 &direction : directions) {
      const Vec3 n = unit(direction), t = unit(cross(n, {0.3, 0.5, -0.8}));
      const int k = static_cast<int>(start.size());
      start.push_back(start.back() + (2.0 * r - normal.equilibrium_overlap()) * n);
      list.add(k - 1, k, 0, list.kinds.add({constants, {}}), loaded(n, t));
    }
    for (auto *array : {&x, &v, &omega, &f, &torque}) array->assign(3 * start.size(), 0.0);
  }

  // below the limits
  static ContactHistory loaded(const Vec3 &n, const Vec3 &t)
  {
    ContactHistory h;
    const Vec3 sliding = 1.0e-9 * t + 0.5e-9 * cross(n, t), rolling = -1.0e-8 * cross(n, t);
    const double values[] = {sliding.x, sliding.y, sliding.z, rolling.x, rolling.y, rolling.z};
    std::copy(values, values + 3, h.sliding);
    std::copy(values + 3, values + 6, h.rolling);
    h.twisting = 0.003;
    TwoBodies::set(h.normal, 0, n);
    return h;
  }

  // at an angle about an axis through the origin, turning at a rate, dt after the last call
  void evaluate(const Vec3 &axis, double angle, double rate, double dt)
  {
    for (size_t b = 0; b < start.size(); b++) {
      const Vec3 position = rotated(start[b], axis, angle);
      const int body = static_cast<int>(b);
      TwoBodies::set(x.data(), body, position);
      TwoBodies::set(v.data(), body, rate * cross(axis, position));
      TwoBodies::set(omega.data(), body, rate * axis);
    }
    std::fill(f.begin(), f.end(), 0.0);
    std::fill(torque.begin(), torque.end(), 0.0);
    run_kernel(kernel, false, list, static_cast<int>(x.size() / 3), x.data(), v.data(),
               omega.data(), f.data(), torque.data(), {dt, 0.0, 0.0}, nullptr);
  }
};

void expect_carried(const RigidChain &chain, const RigidChain &before, const Vec3 &axis,
                    double angle)
{
  for (int k = 0; k < chain.list.size(); k++) {
    const ContactHistory now = chain.list.history_of(k), old = before.list.history_of(k);
    const Vec3 sliding = TwoBodies::vec(old.sliding, 0), rolling = TwoBodies::vec(old.rolling, 0);
    const double changes[] = {
        std::sqrt(norm2(TwoBodies::vec(now.sliding, 0)) / norm2(sliding)) - 1.0,
        std::sqrt(norm2(TwoBodies::vec(now.rolling, 0)) / norm2(rolling)) - 1.0,
        now.twisting / old.twisting - 1.0};
    for (const double change : changes)
      expect_criterion(
          chain.list.size() > 1
              ? "C11 kernel: change of the length of springs in 10 turns, bent chain that is turned"
              : "C11 kernel: change of the length of springs in 10 turns, doublet that is turned",
          std::fabs(change), 0.0, 1e-9);
    expect_near(TwoBodies::vec(now.sliding, 0), rotated(sliding, axis, angle),
                1e-6 * std::sqrt(norm2(sliding)), "sliding");
    expect_near(TwoBodies::vec(now.rolling, 0), rotated(rolling, axis, angle),
                1e-6 * std::sqrt(norm2(rolling)), "rolling");
  }
  double largest_force = 0.0, largest_torque = 0.0;
  for (const double component : before.f)
    largest_force = apf_test::larger(largest_force, std::fabs(component));
  for (const double component : before.torque)
    largest_torque = apf_test::larger(largest_torque, std::fabs(component));
  for (int b = 0; b < static_cast<int>(chain.start.size()); b++) {
    expect_near(TwoBodies::vec(chain.f.data(), b),
                rotated(TwoBodies::vec(before.f.data(), b), axis, angle), 2e-6 * largest_force,
                "force");
    expect_near(TwoBodies::vec(chain.torque.data(), b),
                rotated(TwoBodies::vec(before.torque.data(), b), axis, angle),
                2e-6 * largest_torque, "torque");
  }
}

// An oblique impact of unequal spinning spheres, in the plane if asked to.
TwoBodies oblique(double alpha, bool flat = false, double speed_ratio = 5.0)
{
  auto two = TwoBodies::spheres(full_model(alpha), 3.0e-6, 5.0e-6, 2500.0, 1800.0);
  const double V = speed_ratio * two.sticking_speed(), r = 3.0e-6;
  two.place(0.0);
  TwoBodies::set(two.v, 0, {V, 0.8 * V, flat ? 0.0 : -0.5 * V});
  TwoBodies::set(two.v, 1, {-0.1 * V, 0.2 * V, flat ? 0.0 : 0.1 * V});
  if (!flat) TwoBodies::set(two.omega, 0, {0.5 * V / r, -0.3 * V / r, 0.0});
  two.omega[2] = 0.2 * V / r;
  two.omega[5] = -0.4 * V / r;
  return two;
}

double speed_scale(const TwoBodies &two)
{
  return 5.0 * two.sticking_speed();
}

// Far into the impact: past the largest overlap, before the end.
constexpr int steps = 480;
double step_size(const TwoBodies &two)
{
  return two.contact_time(speed_scale(two)) / 200;
}

void run(TwoBodies &two, int n)
{
  const double dt = step_size(two);
  for (int k = 0; k < n; k++) two.step(dt);
}

void expect_same_motion(const TwoBodies &a, const TwoBodies &b, double tolerance)
{
  const double V = speed_scale(a);
  for (int c = 0; c < 6; c++) {
    EXPECT_NEAR((a.v[c] - b.v[c]) / V, 0.0, tolerance) << "velocity " << c;
    EXPECT_NEAR((a.omega[c] - b.omega[c]) * 3.0e-6 / V, 0.0, tolerance) << "spin " << c;
  }
}

// The scene turned, about an axis.
void turn(TwoBodies &two, const Vec3 &axis, double angle)
{
  for (double *u : {two.x, two.v, two.omega})
    for (int b = 0; b < 2; b++) TwoBodies::set(u, b, rotated(TwoBodies::vec(u, b), axis, angle));
}

// The scene seen in a mirror across an axis: vectors lose that sign, spins lose the other two.
void mirror(TwoBodies &two, int axis)
{
  for (int c = 0; c < 6; c++) {
    if (c % 3 == axis) {
      two.x[c] = -two.x[c];
      two.v[c] = -two.v[c];
    } else {
      two.omega[c] = -two.omega[c];
    }
  }
}

}    // namespace

TEST(Objectivity, rigid_rotation_carries_the_springs_of_a_doublet_along)
{
  const Vec3 n = unit({1.0, 2.0, -0.5});
  for (const Vec3 &direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, n,
                                unit(cross(n, {0, 0, 1})), Vec3{-0.6, 0.0, 0.8}}) {
    RigidChain chain({n}), before({n});
    before.evaluate(direction, 0.0, 0.0, 0.0);
    const int turns = 10, per_turn = 20000;
    for (int k = 1; k <= turns * per_turn; k++) {
      chain.evaluate(direction, 2.0 * pi * k / per_turn, 2.0 * pi / per_turn, 1.0);
      if (k % 44444 == 0) expect_carried(chain, before, direction, 2.0 * pi * k / per_turn);
    }
    expect_carried(chain, before, direction, 0.0);
  }
}

TEST(Objectivity, rigid_rotation_carries_the_springs_of_a_bent_chain_along)
{
  const std::vector<Vec3> bent = {{1.0, 0.2, 0.0}, {0.1, 1.0, 0.6}};
  for (const Vec3 &direction : {unit(bent[0]), unit(bent[1]), unit({-1.0, 0.7, 0.4})}) {
    RigidChain chain(bent), before(bent);
    before.evaluate(direction, 0.0, 0.0, 0.0);
    for (int k = 1; k <= 200000; k++)
      chain.evaluate(direction, 2.0 * pi * k / 20000, 2.0 * pi / 20000, 1.0);
    expect_carried(chain, before, direction, 0.0);
  }
}

TEST(Objectivity, length_of_the_springs_survives_coarse_steps)
{
  const Vec3 n = unit({1.0, 2.0, -0.5}), axis = unit({0.2, -0.4, 1.0});
  RigidChain chain({n});
  const double before = norm2(TwoBodies::vec(chain.list.history_of(0).sliding, 0));
  for (int k = 1; k <= 100; k++) chain.evaluate(axis, 0.6 * k, 0.6, 1.0);    // ten steps a turn
  EXPECT_NEAR(norm2(TwoBodies::vec(chain.list.history_of(0).sliding, 0)) / before, 1.0, 1e-9);
}

TEST(Objectivity, free_doublet_spins_without_loss)
{
  auto two = TwoBodies::spheres(full_model(0.0), 4.0e-6, 4.0e-6);
  // adhesion balances the centrifugal force at delta = 0.5 delta_C
  const double overlap = 0.5 * two.pulloff_overlap(), distance = 8.0e-6 - overlap;
  const double rate = std::sqrt(0.605578 * two.pulloff_force() / (two.bodies.m * distance));
  two.place(overlap);
  const Vec3 spin = rate * unit({0.0, 1.0, -2.0});
  for (int b = 0; b < 2; b++) {
    TwoBodies::set(two.v, b,
                   cross(spin, TwoBodies::vec(two.x, b) - 0.5 * TwoBodies::vec(two.x, 0)));
    TwoBodies::set(two.omega, b, spin);
  }
  two.contact_forces(0.0);
  auto energy = [&two] {
    const ContactParts &p = two.parts;
    return two.kinetic_energy() + p.elastic_energy + p.sliding_energy + p.rolling_energy +
        p.twisting_energy;
  };
  const double E = energy(), kinetic = two.kinetic_energy();
  const Vec3 L = two.angular_momentum();
  const double dt = 0.05 * std::sqrt(two.bodies.m * two.pulloff_overlap() / two.pulloff_force());
  const int per_turn = static_cast<int>(2.0 * pi / (rate * dt));
  for (int k = 0; k < 10 * per_turn; k++) two.step(dt);
  expect_criterion("C11 kernel: drift of energy in 10 turns", (energy() - E) / kinetic, -1e-5,
                   1e-5);
  expect_criterion("C11 kernel: change of L in 10 turns",
                   std::sqrt(norm2(two.angular_momentum() - L) / norm2(L)), 0.0, 1e-10);
  EXPECT_NEAR(std::sqrt(norm2(TwoBodies::vec(two.parts.sliding, 0))) / two.pulloff_force(), 0.0,
              1e-4);
}

TEST(Objectivity, boost_changes_nothing)
{
  auto still = oblique(0.3), moving = oblique(0.3);
  const double U = 1.0e3 * speed_scale(still);
  const Vec3 boost{U, -2.0 * U, 0.5 * U};
  for (int b = 0; b < 2; b++) TwoBodies::set(moving.v, b, TwoBodies::vec(moving.v, b) + boost);
  run(still, steps);
  run(moving, steps);
  for (int b = 0; b < 2; b++) TwoBodies::set(moving.v, b, TwoBodies::vec(moving.v, b) - boost);
  expect_same_motion(still, moving, 1e-9);
}

TEST(Objectivity, turned_scene_is_the_scene_turned)
{
  for (const Vec3 &axis : {Vec3{0, 0, 1}, unit({1.0, -0.4, 0.7})}) {
    auto scene = oblique(0.3), turned = scene;
    turn(turned, axis, 2.0);
    run(scene, steps);
    run(turned, steps);
    turn(turned, axis, -2.0);
    expect_same_motion(scene, turned, 1e-11);
  }
}

TEST(Objectivity, mirrored_scene_is_the_scene_mirrored)
{
  for (const bool flat : {false, true})
    for (int axis = 0; axis < (flat ? 2 : 3); axis++) {
      auto scene = oblique(0.3, flat), mirrored = scene;
      for (TwoBodies *two : {&scene, &mirrored}) two->live_in_plane(flat);
      mirror(mirrored, axis);
      run(scene, steps);
      run(mirrored, steps);
      mirror(mirrored, axis);
      expect_same_motion(scene, mirrored, 1e-13);
    }
}

TEST(Objectivity, exchange_of_the_bodies_turns_the_force_around)
{
  for (const bool flat : {false, true}) {
    auto two = oblique(0.3, flat);
    two.live_in_plane(flat);
    run(two, steps / 3);
    auto swapped = two;
    swapped.swap();
    for (TwoBodies *t : {&two, &swapped}) t->contact_forces(step_size(two));
    const double scale = two.pulloff_force();
    for (int c = 0; c < 6; c++) {
      EXPECT_NEAR((two.f[c] - swapped.f[c]) / scale, 0.0, 1e-11) << c;
      EXPECT_NEAR((two.torque[c] - swapped.torque[c]) / (scale * 3.0e-6), 0.0, 1e-11) << c;
    }
    for (int c = 0; c < 3; c++)
      EXPECT_NEAR((two.parts.force[c] + swapped.parts.force[c]) / scale, 0.0, 1e-11) << c;
    const auto back = swapped.list.history_of(0).swapped(flat), history = two.list.history_of(0);
    for (int c = 0; c < 3; c++) {
      EXPECT_NEAR((back.sliding[c] - history.sliding[c]) / two.pulloff_overlap(), 0.0, 1e-12) << c;
      EXPECT_NEAR((back.rolling[c] - history.rolling[c]) / two.pulloff_overlap(), 0.0, 1e-11) << c;
      EXPECT_NEAR(back.normal[c], history.normal[c], 1e-13) << c;
    }
    EXPECT_NEAR(back.twisting, history.twisting, 1e-13);
  }
}

TEST(Objectivity, exchange_within_a_collision_changes_nothing)
{
  for (const bool flat : {false, true}) {
    auto kept = oblique(0.3, flat);
    kept.live_in_plane(flat);
    auto swapped = kept;
    run(kept, steps);
    for (int k = 0; k < 6; k++) {
      run(swapped, steps / 6);
      swapped.swap();
    }
    EXPECT_FALSE(kept.ended());
    expect_same_motion(kept, swapped, 1e-12);
  }
}

TEST(Objectivity, plane_is_space_for_planar_motion)
{
  for (int choice = 0; choice < 8; choice++) {
    auto space = oblique(0.3, true);
    const double dt = step_size(space), V = speed_scale(space), r = 3.0e-6;
    if (choice & 1) space.model.surface.gamma = 0.0;
    if (choice & 2) space.model.mu = 0.0;
    if (choice & 4) space.model.theta_crit = 0.0;
    space.constants = ContactConstants::make(space.model, space.bodies);
    space.list.clear();
    space.touch();
    auto plane = space;
    space.live_in_plane(false);
    plane.live_in_plane(true);
    for (int k = 0; k < steps; k++) {
      space.step(dt);
      plane.step(dt);
    }
    for (int c = 0; c < 6; c++) {
      EXPECT_NEAR((space.v[c] - plane.v[c]) / V, 0.0, 1e-12) << choice << c;
      EXPECT_NEAR((space.omega[c] - plane.omega[c]) * r / V, 0.0, 1e-12) << choice << c;
    }
    const double energy = 0.5 * space.bodies.m * V * V;
    EXPECT_NEAR((space.parts.elastic_energy - plane.parts.elastic_energy) / energy, 0.0, 1e-11);
    EXPECT_NEAR((space.parts.sliding_energy - plane.parts.sliding_energy) / energy, 0.0, 1e-11);
    EXPECT_NEAR((space.parts.rolling_energy - plane.parts.rolling_energy) / energy, 0.0, 1e-11);
    for (int c = 0; c < 3; c++)
      EXPECT_NEAR((space.parts.sliding[c] - plane.parts.sliding[c]) * r / energy, 0.0, 1e-11) << c;
    EXPECT_NEAR((space.parts.rolling[2] - plane.parts.rolling[2]) / energy, 0.0, 1e-11);
  }
}

TEST(Balance, oblique_impacts_keep_linear_and_angular_momentum)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  for (int impact = 0; impact < 100; impact++) {
    auto two = oblique(0.3, false, 5.0 + 4.0 * u(random));
    const double V = speed_scale(two);
    turn(two, unit({u(random), u(random), u(random)}), 3.0 * u(random));
    for (int c = 0; c < 6; c++) two.omega[c] += V / 3.0e-6 * u(random);
    const Vec3 P = two.momentum(), L = two.angular_momentum();
    const double scale = two.bodies.m * V;
    run(two, 1000);
    expect_near(two.momentum(), P, 1e-12 * scale, "momentum");
    const double turned = std::sqrt(norm2(two.angular_momentum() - L)) / (scale * 8.0e-6);
    expect_criterion("C12 kernel: angular momentum lost in one of 100 oblique impacts", turned, 0.0,
                     1e-12);
  }
}
