// Shares of zones in pieces of surface, against areas known by geometry.

#include "wall/zone_share.h"

#include "gtest/gtest.h"

#include <cmath>
#include <functional>
#include <map>

namespace {

using apf::SurfacePoint;
using ZoneAt = std::function<int(const double *)>;

// the unit square at a height, in 2 n^2 triangles
std::map<int, double> areas(int n, const ZoneAt &zone_at)
{
  std::map<int, double> sum;
  auto corner = [&](int i, int j) {
    return SurfacePoint{1.0 * i / n, 1.0 * j / n, 0.3};
  };
  auto add = [&](const std::array<SurfacePoint, 3> &p) {
    apf::share_triangle(p, {zone_at(p[0].data()), zone_at(p[1].data()), zone_at(p[2].data())},
                        zone_at, [&](int zone, double share) {
                          sum[zone] += share / (2 * n * n);
                        });
  };
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      add({corner(i, j), corner(i + 1, j), corner(i + 1, j + 1)});
      add({corner(i, j), corner(i + 1, j + 1), corner(i, j + 1)});
    }
  return sum;
}

TEST(ZoneShare, straight_borders_at_any_angle_are_exact)
{
  // y < 0.21 + 0.37 x: a trapezium
  auto below = [](const double *x) {
    return x[1] < 0.21 + 0.37 * x[0] ? 1 : 0;
  };
  for (const int n : {1, 3, 8}) {
    const auto of = areas(n, below);
    EXPECT_NEAR(of.at(1), 0.21 + 0.5 * 0.37, 1e-12) << n;
    EXPECT_NEAR(of.at(0) + of.at(1), 1.0, 1e-12) << n;
  }
}

TEST(ZoneShare, circle_converges_with_second_order)
{
  auto disc = [](const double *x) {
    return std::hypot(x[0] - 0.47, x[1] - 0.52) < 0.31 ? 1 : 0;
  };
  const double exact = std::acos(-1.0) * 0.31 * 0.31;
  const double coarse = std::fabs(areas(20, disc).at(1) - exact);
  const double fine = std::fabs(areas(80, disc).at(1) - exact);
  EXPECT_LT(coarse, 2e-3 * exact);
  EXPECT_GT(coarse / fine, 10.0);
  EXPECT_LT(coarse / fine, 26.0);
}

TEST(ZoneShare, three_zones_that_meet_in_a_point_fill_the_square)
{
  // three sectors of 120 degrees about a point; only the triangle that holds it is not exact
  auto sector = [](const double *x) {
    return static_cast<int>((std::atan2(x[1] - 0.503, x[0] - 0.507) + 4.0) / 2.1);
  };
  double sum = 0.0;
  for (const auto &[zone, area] : areas(10, sector)) sum += area;
  EXPECT_NEAR(sum, 1.0, 1e-12);
  const auto coarse = areas(10, sector), fine = areas(200, sector);
  ASSERT_EQ(coarse.size(), 3u + (coarse.count(3) ? 1u : 0u));
  for (const auto &[zone, area] : fine) EXPECT_NEAR(coarse.at(zone), area, 0.005) << zone;
}

TEST(ZoneShare, line_is_cut_where_the_zone_ends)
{
  double of[2] = {};
  apf::share_line(
      {1.0, 2.0, 3.0}, {5.0, 2.0, 3.0}, {0, 1},
      [](const double *x) {
        return x[0] > 2.0 ? 1 : 0;
      },
      [&](int zone, double share) {
        of[zone] += share;
      });
  EXPECT_NEAR(of[0], 0.25, 1e-12);
  EXPECT_NEAR(of[1], 0.75, 1e-12);
}

}    // namespace
