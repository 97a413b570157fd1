// Gridded flows without LAMMPS. Facts: linear fields are interpolated exactly, smooth ones to
// second order, periodic ones repeat, solenoidal ones stay so; no-slip at walls that cross the
// grid.

#include "compare.h"
#include "gridded.h"

#include "gtest/gtest.h"

using namespace apf;

TEST(GridFlow, linear_field_is_exact)
{
  const double A[3][3] = {{0.4, -1.1, 0.6}, {2.0, 0.3, -0.8}, {-0.5, 0.9, 1.7}};
  for (int dims : {2, 3})
    for (int n : {2, 3, 9}) {
      const auto u = [&](const double *x) {
        Vec3 r{0.1, -0.2, 0.3};
        for (int k = 0; k < dims; k++)
          r = r + x[k] * Vec3{A[0][k], A[1][k], dims == 3 ? A[2][k] : 0.0};
        return dims == 3 ? r : Vec3{r.x, r.y, 0.0};
      };
      const Gridded field(box(dims, n, n + 1, n + 2), u);
      const auto points = points_in(field.grid, 61);
      const auto out = field.at(points);
      for (int l = 0; l < 61; l++) {
        const double x[3] = {points[l].x, points[l].y, points[l].z};
        for (int a = 0; a < 3; a++) {
          EXPECT_NEAR(out.velocity[a][l], component(u(x), a), 1e-12);
          for (int b = 0; b < 3; b++)
            EXPECT_NEAR(out.gradient[a][b][l], a < dims && b < dims ? A[a][b] : 0.0, 1e-12);
          EXPECT_EQ(out.rate[a][l], 0.0);
        }
        EXPECT_NEAR(out.vorticity[2][l], A[1][0] - A[0][1], 1e-12);
        EXPECT_NEAR(out.vorticity[0][l], dims == 3 ? A[2][1] - A[1][2] : 0.0, 1e-12);
        EXPECT_NEAR(out.vorticity[1][l], dims == 3 ? A[0][2] - A[2][0] : 0.0, 1e-12);
      }
    }
}

namespace {

// a smooth field without divergence, in the plane if dims is 2
struct Swirl {
  int dims;
  Vec3 operator()(const double *x) const
  {
    const double z = dims == 3 ? x[2] : 0.0;
    return {std::sin(x[0]) * std::cos(x[1]) * std::cos(z),
            -std::cos(x[0]) * std::sin(x[1]) * std::cos(z),
            dims == 3 ? std::cos(2.0 * x[0]) * std::sin(x[1]) : 0.0};
  }
  double slope(const double *x, int a, int b) const
  {
    const double e = 1e-5;
    double right[3] = {x[0], x[1], x[2]}, left[3] = {x[0], x[1], x[2]};
    right[b] += e;
    left[b] -= e;
    return (component((*this)(right), a) - component((*this)(left), a)) / (2.0 * e);
  }
};

struct Errors {
  double velocity = 0.0, gradient = 0.0, divergence = 0.0;    // largest ones
};

Errors errors_of(const Gridded &field, const Swirl &u, const std::vector<Vec3> &points)
{
  Errors worst;
  const auto out = field.at(points);
  for (std::size_t l = 0; l < points.size(); l++) {
    const double x[3] = {points[l].x, points[l].y, points[l].z};
    double divergence = 0.0;
    for (int a = 0; a < 3; a++) {
      divergence += out.gradient[a][a][l];
      worst.velocity =
          apf_test::larger(worst.velocity, std::fabs(out.velocity[a][l] - component(u(x), a)));
      for (int b = 0; b < 3; b++)
        worst.gradient =
            apf_test::larger(worst.gradient, std::fabs(out.gradient[a][b][l] - u.slope(x, a, b)));
    }
    worst.divergence = apf_test::larger(worst.divergence, std::fabs(divergence));
  }
  return worst;
}

}    // namespace

TEST(GridFlow, smooth_field_is_of_second_order)
{
  for (int dims : {2, 3})
    for (bool periodic : {false, true}) {
      const Swirl swirl{dims};
      Errors errors[2];
      for (int fine = 0; fine < 2; fine++) {
        Lattice grid{};
        grid.dims = dims;
        for (int k = 0; k < 3; k++) {
          const int cells = (fine + 1) * (20 + 4 * k);
          grid.periodic[k] = periodic;
          grid.n[k] = k == dims ? 1 : cells + (periodic ? 0 : 1);
          grid.spacing[k] = 2.0 * pi / cells;
        }
        errors[fine] = errors_of(Gridded(grid, swirl), swirl, points_in(grid, 64));
      }
      EXPECT_NEAR(order(errors[0].velocity, errors[1].velocity), 2.0, 0.3) << dims << periodic;
      EXPECT_NEAR(order(errors[0].gradient, errors[1].gradient), 2.0, 0.3) << dims << periodic;
      EXPECT_NEAR(order(errors[0].divergence, errors[1].divergence), 2.0, 0.5) << dims << periodic;
      EXPECT_LT(errors[1].velocity, 0.02);
      EXPECT_LT(errors[1].divergence, 0.1);
    }
}

TEST(GridFlow, periodic_directions_repeat)
{
  const Swirl swirl{3};
  Lattice grid = box(3, 8, 9, 10);
  grid.periodic[0] = grid.periodic[2] = true;
  const Gridded field(grid, swirl);
  auto points = points_in(grid, 64);
  const auto here = field.at(points);
  for (auto &p : points) {
    p.x += 3.0 * 8 * grid.spacing[0];
    p.z -= 2.0 * 10 * grid.spacing[2];
  }
  bool inside = false;
  const auto there = field.at(points, Detail::GRADIENT, &inside);
  EXPECT_TRUE(inside);
  for (int l = 0; l < 64; l++)
    for (int a = 0; a < 3; a++) {
      EXPECT_NEAR(there.velocity[a][l], here.velocity[a][l], 1e-12);
      EXPECT_NEAR(there.gradient[0][a][l], here.gradient[0][a][l], 1e-12);
    }
}

TEST(GridFlow, points_outside_are_told_and_take_the_border)
{
  for (int dims : {2, 3}) {
    const Lattice grid = box(dims, 4, 5, 6);
    const Gridded field(grid, Swirl{dims});
    const double end = grid.origin[1] + 4 * grid.spacing[1];
    const double h = grid.spacing[1], z = grid.origin[2] + 0.5;
    const auto inside = [&](double y) {
      bool yes = false;
      field.at({{0.5, 0.4, z}, {0.5, y, z}}, Detail::VELOCITY, &yes);
      return yes;
    };
    EXPECT_TRUE(inside(end));
    EXPECT_TRUE(inside(end + 1e-7 * h)) << "rounding";
    EXPECT_FALSE(inside(end + 1e-5 * h));
    EXPECT_TRUE(inside(grid.origin[1]));
    EXPECT_FALSE(inside(grid.origin[1] - 1e-5 * h));
    EXPECT_FALSE(inside(1e300));
    EXPECT_FALSE(inside(-1e300));
    EXPECT_FALSE(inside(std::nan("")));
    EXPECT_FALSE(inside(INFINITY));
    const auto out = field.at({{0.5, end, z}, {0.5, end + 7.0, z}, {0.5, std::nan(""), z}});
    EXPECT_EQ(out.velocity[0][1], out.velocity[0][0]);
    EXPECT_TRUE(std::isfinite(out.velocity[0][2]));
  }
}

TEST(GridFlow, in_the_plane_z_is_ignored)
{
  const Gridded field(box(2, 6, 7, 1), Swirl{2});
  bool inside = false;
  const auto out = field.at({{0.5, 0.4, 0.0}, {0.5, 0.4, 77.0}}, Detail::GRADIENT, &inside);
  EXPECT_TRUE(inside);
  EXPECT_EQ(out.velocity[0][0], out.velocity[0][1]);
  EXPECT_EQ(out.velocity[2][1], 0.0);
}

TEST(GridFlow, less_detail_gives_the_same_numbers)
{
  for (int dims : {2, 3}) {
    const Lattice grid = box(dims, 6, 7, 8);
    const auto points = points_in(grid, 40);
    const auto whole = Gridded(grid, Swirl{dims}).at(points);
    for (const Detail built : {Detail::VELOCITY, Detail::VORTICITY, Detail::GRADIENT})
      for (const Detail asked : {Detail::VELOCITY, Detail::VORTICITY}) {
        if (asked > built) continue;
        const auto out = Gridded(grid, Swirl{dims}, built).at(points, asked);
        for (int l = 0; l < 40; l++)
          for (int a = 0; a < 3; a++) {
            EXPECT_EQ(out.velocity[a][l], whole.velocity[a][l]);
            if (asked == Detail::VORTICITY) {
              EXPECT_EQ(out.vorticity[a][l], whole.vorticity[a][l]);
            }
          }
      }
  }
}

TEST(GridFlow, a_points_place_in_the_block_does_not_matter)
{
  for (int dims : {2, 3}) {
    const Gridded field(box(dims, 6, 7, 8), Swirl{dims});
    const auto points = points_in(field.grid, 64);
    const auto all = field.at(points);
    for (int l = 0; l < 64; l++) {
      const auto one = field.at({points[l]});
      for (int a = 0; a < 3; a++) {
        EXPECT_EQ(one.velocity[a][0], all.velocity[a][l]);
        EXPECT_EQ(one.gradient[0][a][0], all.gradient[0][a][l]);
      }
    }
  }
}

TEST(GridFlow, series_is_linear_in_time)
{
  for (int dims : {2, 3}) {
    const Swirl swirl{dims};
    const auto later = [&](const double *x) {
      return 3.0 * swirl(x);
    };
    Gridded field(box(dims, 6, 7, 8), swirl);
    const auto points = points_in(field.grid, 64);
    const auto first = field.at(points);
    field.add_frame(later, 0.25, 4.0);
    const auto now = field.at(points);
    for (int l = 0; l < 64; l++)
      for (int a = 0; a < 3; a++) {
        EXPECT_NEAR(now.velocity[a][l], 1.5 * first.velocity[a][l], 1e-13);
        EXPECT_NEAR(now.rate[a][l], 0.5 * first.velocity[a][l], 1e-13);
        EXPECT_NEAR(now.vorticity[a][l], 1.5 * first.vorticity[a][l], 1e-13);
        EXPECT_NEAR(now.gradient[a][0][l], 1.5 * first.gradient[a][0][l], 1e-13);
      }
  }
}

TEST(GridFlow, instruction_sets_agree)
{
  for (int dims : {2, 3}) {
    Gridded field(box(dims, 6, 7, 8), Swirl{dims});
    field.add_frame(
        [](const double *x) {
          return Vec3{x[0], x[1] * x[0], 1.0};
        },
        0.3, 2.0);
    const auto points = points_in(field.grid, 63);
    PointBlock block;
    block.n = 63;
    for (int l = 0; l < 63; l++) {
      const double x[3] = {points[l].x, points[l].y, points[l].z};
      block.set(l, x);
    }
    FluidBlock reference;
    for (const auto &build : grid_sampler_builds()) {
      FluidBlock out;
      build.sampler(field.flow.view, block, Detail::GRADIENT, out);
      if (std::string(build.name) == "baseline") reference = out;
      for (int l = 0; l < 63; l++)
        for (int a = 0; a < 3; a++) {
          EXPECT_NEAR(out.velocity[a][l], reference.velocity[a][l], 1e-14) << build.name;
          EXPECT_NEAR(out.vorticity[a][l], reference.vorticity[a][l], 1e-14) << build.name;
          EXPECT_NEAR(out.rate[a][l], reference.rate[a][l], 1e-14) << build.name;
          for (int b = 0; b < 3; b++)
            EXPECT_NEAR(out.gradient[a][b][l], reference.gradient[a][b][l], 1e-14) << build.name;
        }
    }
  }
}
