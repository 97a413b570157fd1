// How bodies that overlap came so, and how long their impact lasts: first_touch.h against straight
// flight and an integration of Hertz's and JKR's laws.

#include "timestep/first_touch.h"

#include "contact/bodies.h"
#include "flow/relaxation.h"
#include "timestep/spread_nearby.h"

#include "gtest/gtest.h"

#include <array>
#include <cmath>
#include <random>
#include <vector>

using namespace apf;

namespace {

SpaceRow body(double x, double y, double vx, double vy)
{
  SpaceRow row{};
  row.x[0] = x;
  row.x[1] = y;
  row.v[0] = vx;
  row.v[1] = vy;
  return row;
}

ContactModel model_of(double gamma)
{
  ContactModel model;
  model.surface.E = 1000.0;
  model.surface.G = 300.0;
  model.surface.gamma = gamma;
  return model;
}

// time from touch to where the neck ends or the bodies part, in small leapfrog steps
double duration(const JKR &law, double m, double speed)
{
  const double end = -law.pulloff_overlap(), h = 1e-5;
  double overlap = 0.5 * h * speed, v = speed, t = 0.0;
  for (; overlap >= end && t < 10.0; t += h) {
    v -= h * law.force(law.root(overlap)) / m;
    overlap += h * v;
  }
  return t;
}

TEST(FirstTouch, impacts_last_as_long_as_hertz_says)
{
  const double m = 0.7;
  const auto mode = stiffest_mode(model_of(0.0), ContactBodies::pair(0.5, 0.5, m, 1.0));
  for (const double speed : {0.01, 1.0, 5.0})
    EXPECT_NEAR(impact_duration(mode, speed) / duration(model_of(0.0).normal(0.25), m, speed), 1.0,
                1e-3);
}

// With adhesion, well above the sticking velocity, the neck adds to it; at rest half a period is as
// long as this says.
TEST(FirstTouch, adhesion_is_as_stiff_as_its_neck_at_rest)
{
  const double m = 0.7;
  const auto model = model_of(0.3);
  const auto mode = stiffest_mode(model, ContactBodies::pair(0.5, 0.5, m, 1.0));
  EXPECT_NEAR(impact_duration(mode, 0.0) * mode.frequency, 3.91, 0.01);
  EXPECT_LT(impact_duration(mode, 3.0), duration(model.normal(0.25), m, 3.0));
  EXPECT_GT(impact_duration(mode, 3.0), 0.8 * duration(model.normal(0.25), m, 3.0));
}

// Pairs that fly in from apart: however deep they are found, also beyond the nearest place.
TEST(FirstTouch, speed_at_touch_is_that_of_straight_flight)
{
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform;
  for (int n = 0; n < 1000; n++) {
    const double b = 0.999 * uniform(random), speed = 0.1 + uniform(random);
    const double chord = std::sqrt(1.0 - b * b), way = 2.0 * chord * uniform(random);
    const auto now = Approach::of(body(way - chord, 0.0, speed, 0.0), body(0.0, b, 0.0, 0.0), 1.0);
    EXPECT_NEAR(FirstTouch::of(now, 1.0, 1.0).speed, speed * chord, 1e-7);
  }
}

TEST(FirstTouch, at_a_plane_it_is_the_normal_speed)
{
  const Approach now{-0.01, 0.3, 2.0};
  EXPECT_DOUBLE_EQ(FirstTouch::of(now, 0.5, 0.0).speed, 0.3);
}

TEST(FirstTouch, bodies_at_one_place_have_the_speed_that_they_have)
{
  const auto now = Approach::of(body(1.0, 1.0, 2.0, 0.0), body(1.0, 1.0, 0.0, 0.0), 1.0);
  EXPECT_DOUBLE_EQ(FirstTouch::of(now, 1.0, 1.0).speed, 2.0);
}

// found by sampling the way: pairs that were apart at the begin and the end of the step, and
// moved by more than half their distance of touch in it
TEST(FirstTouch, passages_are_those_that_touch_between_two_positions)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  int passed = 0;
  for (int n = 0; n < 3000; n++) {
    const auto a = body(4.0 * uniform(random) - 2.0, 4.0 * uniform(random) - 2.0,
                        5.0 * uniform(random) - 2.5, 5.0 * uniform(random) - 2.5);
    const auto b = body(0.0, 0.0, 0.1, 0.2);
    const auto distance = [&](double t) {
      return std::hypot(a.x[0] - b.x[0] + t * (a.v[0] - b.v[0]),
                        a.x[1] - b.x[1] + t * (a.v[1] - b.v[1]));
    };
    if (distance(0.0) < 1.0) continue;
    double nearest = 9.0;
    for (int k = 0; k <= 2000; k++) nearest = std::min(nearest, distance(-k / 2000.0));
    const auto passage = Passage::of(a, b, 1.0);
    if (passage.until > 0.0 || std::fabs(nearest - 1.0) < 1e-5) continue;
    const bool through =
        nearest < 1.0 && distance(-1.0) > 1.0 && std::hypot(a.v[0] - b.v[0], a.v[1] - b.v[1]) > 0.5;
    EXPECT_EQ(passage.through(1.0, 1.0, 0.5), through);
    passed += through;
  }
  EXPECT_GT(passed, 50);
}

// ... and a list of that skin shows those that move no farther, before or after
TEST(FirstTouch, lists_show_pairs_that_meet)
{
  for (const double skin : {0.1, 0.5, 2.0})
    for (const double b : {0.0, 0.5, 0.999999}) {
      const double way = longest_way_shown(1.0, skin), edge = std::hypot(0.5 * way, b);
      EXPECT_LE(edge, 1.0 + skin);
      if (b > 0.99) { EXPECT_NEAR(edge, 1.0 + skin, 1e-5); }
    }
}

// Oscillators in leapfrog steps with a velocity that relaxes in each: as long a step as is said to
// be as stable as one without drag neither grows nor is far from growing.
TEST(FirstTouch, drag_makes_longer_steps_stable)
{
  const auto grows = [](double z, double omega) {    // steps of 1
    const double decay = std::exp(-z), mean = z > 0.0 ? (1.0 - decay) / z : 1.0;
    double x = 1.0, v = 0.3, late = 0.0;
    for (int n = 0; n < 4000; n++) {
      v = decay * v - mean * omega * omega * x;
      x += v;
      if (n >= 2000) late = std::max(late, std::fabs(x));
    }
    return late > 10.0;
  };
  for (const double z : {0.0, 0.1, 1.0, 10.0, 1000.0}) {
    const double limit = 2.0 / std::sqrt(mobility_in_steps(z));
    EXPECT_FALSE(grows(z, 0.99 * limit)) << z;
    EXPECT_TRUE(grows(z, 1.01 * limit)) << z;
  }
}

// Bins bound what all pairs within reach give, and tell what is far apart from it.
TEST(SpreadNearby, bounds_pairs_within_reach_and_not_those_beyond)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform;
  using Vectors = std::vector<std::array<double, 3>>;
  for (const double rate : {0.0, 1.0, 50.0}) {
    Vectors x(300), v(300);
    for (size_t i = 0; i < x.size(); i++)
      for (int c = 0; c < 3; c++) {
        x[i][c] = (c == 1 ? 40.0 : 8.0) * uniform(random) - 3.0;
        v[i][c] = uniform(random) + (c == 0 ? rate * x[i][1] : 0.0);
      }
    const auto pointers = [](const Vectors &all) {
      std::vector<const double *> rows;
      for (const auto &one : all) rows.push_back(one.data());
      return rows;
    };
    const double reach = 1.5,
                 bound = spread_nearby(pointers(x), pointers(v), static_cast<int>(x.size()), reach);
    double most = 0.0;
    for (size_t i = 0; i < x.size(); i++)
      for (size_t j = 0; j < i; j++) {
        const auto between = [&](const Vectors &of) {
          return std::hypot(of[i][0] - of[j][0], of[i][1] - of[j][1], of[i][2] - of[j][2]);
        };
        if (between(x) < reach) most = std::max(most, between(v));
      }
    EXPECT_GE(bound, most);
    // two bins and a bit, along each axis what the others have
    EXPECT_LE(bound, std::hypot(1.0 + 3.0 * 40.0 / 26.0 * rate, 1.0, 1.0));
  }
}

}    // namespace
