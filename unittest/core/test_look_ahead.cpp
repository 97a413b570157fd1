// Which bodies may touch within a step: candidates.h and look_ahead.h against straight lines.

#include "contact/bodies.h"
#include "contact/candidates.h"

#include "gtest/gtest.h"

#include <cmath>
#include <random>

using namespace apf;

namespace {

SpaceRow body(double x, double v, double y = 0.0)
{
  SpaceRow row{};
  row.x[0] = x;
  row.x[1] = y;
  row.v[0] = v;
  return row;
}

LookAhead ahead_of(int bodies, double limit = 10.0)
{
  static const std::vector<double> radii(10, 0.5);
  LookAhead ahead;
  ahead.step = 1.0;
  ahead.reach = 2.0;    // twice the step
  ahead.limit = limit;
  ahead.radius = radii.data();
  ahead.begin(bodies);
  return ahead;
}

// unit spheres in a row, all pairs
Candidates all_pairs(int bodies)
{
  Candidates pairs;
  for (int i = 0; i < bodies; i++)
    for (int j = i + 1; j < bodies; j++) pairs.add(i, j, 1.0);
  return pairs;
}

TEST(LookAhead, approach_is_along_the_line_of_centres)
{
  const SpaceRow a = body(0.0, 3.0), b = body(3.0, -1.0, 4.0);
  const auto approach = Approach::of(a, b, 1.5);
  EXPECT_DOUBLE_EQ(approach.gap, 3.5);
  EXPECT_DOUBLE_EQ(approach.closing_speed, 4.0 * 0.6);
  EXPECT_DOUBLE_EQ(approach.relative_speed, 4.0);
  const auto reverse = Approach::of(b, a, 1.5);
  EXPECT_DOUBLE_EQ(reverse.closing_speed, approach.closing_speed);
}

TEST(LookAhead, pair_is_active_from_twice_the_way_of_a_step)
{
  for (const double gap : {0.39, 0.41}) {
    const SpaceRow rows[] = {body(0.0, 0.1), body(1.0 + gap, -0.1)};
    auto pairs = all_pairs(2);
    auto ahead = ahead_of(2);
    pairs.find_approaching(rows, ahead);
    pairs.find_near(rows, ahead);
    EXPECT_EQ(ahead.activity[0], gap < 0.4 ? ACTIVE : FREE) << gap;
    EXPECT_EQ(ahead.activity[1], ahead.activity[0]);
    EXPECT_EQ(pairs.near.size(), gap < 0.4 ? 1u : 0u);
    EXPECT_DOUBLE_EQ(ahead.fastest, gap < 0.4 ? 0.2 : 0.0);
  }
}

TEST(LookAhead, margin_and_forces_reach_farther)
{
  const SpaceRow rows[] = {body(0.0, 0.0), body(1.5, 0.0)};
  for (const bool margin : {false, true}) {
    auto pairs = all_pairs(2);
    auto ahead = ahead_of(2);
    (margin ? ahead.margin : ahead.extra) = margin ? 0.49 : 0.24;
    pairs.find_approaching(rows, ahead);
    EXPECT_EQ(ahead.activity[0], FREE);
    (margin ? ahead.margin : ahead.extra) = margin ? 0.51 : 0.26;
    pairs.find_approaching(rows, ahead);
    EXPECT_EQ(ahead.activity[0], ACTIVE);
  }
}

TEST(LookAhead, what_parts_is_free_unless_it_touches)
{
  const SpaceRow rows[] = {body(0.0, -1.0), body(1.1, 1.0)};
  auto pairs = all_pairs(2);
  auto ahead = ahead_of(2);
  pairs.find_approaching(rows, ahead);
  EXPECT_EQ(ahead.activity[0], FREE);
  pairs.closed[0] = 1;
  pairs.find_approaching(rows, ahead);
  EXPECT_EQ(ahead.activity[0], ACTIVE);
  EXPECT_DOUBLE_EQ(ahead.fastest, 2.0);
  EXPECT_TRUE(pairs.near.empty()) << "contacts need not be looked for";
}

// Newton's cradle: the last of the row is struck within the step, though nothing nears it now.
TEST(LookAhead, one_that_may_be_struck_is_near)
{
  const SpaceRow rows[] = {body(0.0, 0.5), body(1.2, 0.0), body(2.5, 0.0), body(9.0, 0.0)};
  auto pairs = all_pairs(4);
  auto ahead = ahead_of(4);
  pairs.find_approaching(rows, ahead);
  pairs.find_near(rows, ahead);
  EXPECT_EQ(ahead.activity[0], ACTIVE);
  EXPECT_EQ(ahead.activity[1], ACTIVE);
  EXPECT_EQ(ahead.activity[2], NEAR);
  EXPECT_EQ(ahead.activity[3], FREE);
  for (int i = 0; i < 4; i++) EXPECT_EQ(ahead.used[i] != 0, ahead.activity[i] != FREE) << i;
}

// Straight lines: every pair that overlaps at some time in the step is looked at, and most of the
// others are not.
TEST(LookAhead, random_flights_that_meet_are_all_found)
{
  std::mt19937 random(1);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  int meeting = 0, found = 0, missed = 0;
  const int flights = 100000;
  for (int n = 0; n < flights; n++) {
    SpaceRow rows[2] = {};
    for (int c = 0; c < 3; c++) {
      rows[1].x[c] = 4.0 * u(random);
      rows[0].v[c] = 0.5 * u(random);
      rows[1].v[c] = 0.5 * u(random);
    }
    double xx = 0.0, xv = 0.0, vv = 0.0;
    for (int c = 0; c < 3; c++) {
      const double v = rows[1].v[c] - rows[0].v[c];
      xx += rows[1].x[c] * rows[1].x[c];
      xv += rows[1].x[c] * v;
      vv += v * v;
    }
    if (xx < 1.0) continue;
    const double t = std::min(1.0, std::max(0.0, -xv / vv));
    const bool meets = xx + 2.0 * t * xv + t * t * vv < 1.0;
    auto pairs = all_pairs(2);
    auto ahead = ahead_of(2, std::sqrt(vv));
    pairs.find_approaching(rows, ahead);
    meeting += meets;
    found += ahead.activity[0] == ACTIVE;
    missed += meets && ahead.activity[0] != ACTIVE;
  }
  EXPECT_EQ(missed, 0);
  EXPECT_GT(meeting, 200);
  EXPECT_LT(found, 5 * meeting);
}

// A parabola under a force: the speed that it adds in a step is `extra`.
TEST(LookAhead, forces_bring_together_what_rests)
{
  const double a = 0.3;    // each way: half of 2 a t^2 in a step of 1
  const SpaceRow rows[] = {body(0.0, 0.0), body(1.0 + 0.99 * a, 0.0)};
  auto pairs = all_pairs(2);
  auto ahead = ahead_of(2);
  ahead.extra = a;
  pairs.find_approaching(rows, ahead);
  EXPECT_EQ(ahead.activity[0], ACTIVE);
}

}    // namespace
