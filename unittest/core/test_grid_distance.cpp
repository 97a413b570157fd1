// Distances from a grid against the shapes they were taken from.

#include "compare.h"
#include "wall/grid_survey.h"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace {

using Shape = std::function<double(const double *)>;

struct Field {
  apf::Lattice lattice;
  std::vector<double> coefficients;
  apf::GridDistance grid;

  Field(int dims, int nodes, double length, const Shape &shape, bool periodic = false)
  {
    lattice.dims = dims;
    for (int k = 0; k < 3; k++) {
      lattice.n[k] = k < dims ? nodes : 1;
      lattice.periodic[k] = periodic && k == 0;
      lattice.origin[k] = -0.5 * length;
      lattice.spacing[k] = length / (nodes - (lattice.periodic[k] ? 0 : 1));
    }
    std::vector<double> values;
    apf::for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
      double x[3];
      lattice.position(i, j, k, x);
      values.push_back(shape(x));
    });
    coefficients.resize(apf::GridDistance::size(lattice));
    const auto jumps = apf::GridDistance::write_coefficients(lattice, values, coefficients.data());
    grid = apf::GridDistance(lattice, coefficients.data(), jumps);
  }
};

double size(const double *x, int dims)
{
  double sum = 0.0;
  for (int c = 0; c < dims; c++) sum += x[c] * x[c];
  return std::sqrt(sum);
}

// largest error of the distance around a circle or sphere of radius 1, at the distance 0.5
double error_around(int dims, int nodes)
{
  const Field field(dims, nodes, 4.0, [dims](const double *x) {
    return size(x, dims) - 1.0;
  });
  std::mt19937 random(7);
  std::normal_distribution<double> gauss;
  double worst = 0.0;
  for (int n = 0; n < 2000; n++) {
    double x[3] = {};
    for (int c = 0; c < dims; c++) x[c] = gauss(random);
    const double scale = 1.5 / size(x, dims);
    for (double &component : x) component *= scale;
    worst = apf_test::larger(worst, std::fabs(field.grid.distance(x) - 0.5));
  }
  return worst;
}

}    // namespace

TEST(GridDistance, planes_at_any_angle_are_exact)
{
  std::mt19937 random(1);
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> in_box(-1.0, 1.0);
  for (int dims : {2, 3})
    for (int n = 0; n < 20; n++) {
      double normal[3] = {};
      for (int c = 0; c < dims; c++) normal[c] = gauss(random);
      const double s = size(normal, dims);
      for (double &component : normal) component /= s;
      const auto plane = [&](const double *x) {
        return normal[0] * x[0] + normal[1] * x[1] + normal[2] * x[2] - 0.1;
      };
      const Field field(dims, 12, 2.0, plane);
      for (int k = 0; k < 200; k++) {
        double x[3] = {}, slope[3], kappa[2];
        for (int c = 0; c < dims; c++) x[c] = in_box(random);
        EXPECT_NEAR(field.grid.distance(x), plane(x), 2e-15);
        EXPECT_NEAR(field.grid.distance(x, slope), plane(x), 2e-15);
        for (int c = 0; c < 3; c++) EXPECT_NEAR(slope[c], normal[c], 4e-14);
        field.grid.distance(x, slope, kappa);
        EXPECT_NEAR(kappa[0], 0.0, 2e-12);
        EXPECT_LT(field.grid.at_least(x), plane(x));
        EXPECT_GT(field.grid.at_least(x), plane(x) - 3.0 * field.lattice.spacing[0]);
      }
    }
}

// 35/1152 h^4 times the sum of the fourth derivatives along the axes: 3/rho^3 to 12/rho^3 of size
// around a circle of radius rho
TEST(GridDistance, curved_walls_are_of_fourth_order)
{
  for (int dims : {2, 3}) {
    const double coarse = error_around(dims, 41), fine = error_around(dims, 81);
    const double order = std::log2(coarse / fine);
    EXPECT_GT(order, 3.8) << dims;
    EXPECT_LT(order, 4.2) << dims;
    const double scale = apf::GridDistance::error_constant * std::pow(0.05, 4) / std::pow(1.5, 3);
    EXPECT_LT(fine, 12.0 * scale) << dims;
    EXPECT_GT(fine, 1.0 * scale) << dims;
  }
}

TEST(GridDistance, slope_is_the_derivative_and_has_size_one)
{
  const Field field(3, 41, 4.0, [](const double *x) {
    return size(x, 3) - 1.0;
  });
  const double x[3] = {0.9, -0.7, 0.83}, h = 1e-5;
  double slope[3];
  field.grid.distance(x, slope);
  for (int c = 0; c < 3; c++) {
    double up[3] = {x[0], x[1], x[2]}, down[3] = {x[0], x[1], x[2]};
    up[c] += h;
    down[c] -= h;
    EXPECT_NEAR(slope[c], (field.grid.distance(up) - field.grid.distance(down)) / (2.0 * h), 1e-9);
    EXPECT_NEAR(slope[c], x[c] / size(x, 3), 2e-4);
  }
  EXPECT_NEAR(size(slope, 3), 1.0, 2e-4);
}

TEST(GridDistance, curvatures_of_sphere_cylinder_and_circle)
{
  const double x[3] = {0.9, -0.7, 0.83};
  double slope[3], kappa[2];
  const Field sphere(3, 81, 4.0, [](const double *x) {
    return 1.9 - size(x, 3);
  });
  sphere.grid.distance(x, slope, kappa);
  EXPECT_NEAR(kappa[0], -1.0 / size(x, 3), 2e-3);
  EXPECT_NEAR(kappa[1], -1.0 / size(x, 3), 2e-3);
  const Field cylinder(3, 81, 4.0, [](const double *x) {
    return size(x, 2) - 0.5;
  });
  cylinder.grid.distance(x, slope, kappa);
  EXPECT_NEAR(kappa[0], 1.0 / size(x, 2), 2e-3);
  EXPECT_NEAR(kappa[1], 0.0, 1e-3);
  const Field circle(2, 81, 4.0, [](const double *x) {
    return size(x, 2) - 0.5;
  });
  circle.grid.distance(x, slope, kappa);
  EXPECT_NEAR(kappa[0], 1.0 / size(x, 2), 2e-3);
  EXPECT_EQ(kappa[1], 0.0);
}

// from one cell to the next nothing jumps up to the curvature
TEST(GridDistance, curvature_is_continuous_across_cells)
{
  const Field field(2, 21, 4.0, [](const double *x) {
    return size(x, 2) - 1.0;
  });
  const double h = field.lattice.spacing[0], face = field.lattice.origin[0] + 15.0 * h;
  for (double y : {0.31, 0.77, 1.2}) {
    const double left[3] = {face - 1e-9, y, 0.0}, right[3] = {face + 1e-9, y, 0.0};
    double slope[3], a[2], b[2];
    field.grid.distance(left, slope, a);
    field.grid.distance(right, slope, b);
    EXPECT_NEAR(a[0], b[0], 1e-7);
    EXPECT_GT(a[0], 0.1);
  }
}

TEST(GridDistance, periodic_grids_repeat)
{
  const double length = 2.0, pi = std::acos(-1.0);
  const auto wave = [&](const double *x) {
    return x[1] - 0.1 * std::cos(pi * x[0]);
  };
  const Field field(2, 40, length, wave, true);
  const double bound =
      1.001 * apf::GridDistance::error_constant * 0.1 * std::pow(pi * field.lattice.spacing[0], 4);
  for (double x0 : {-1.0, -0.987, 0.3, 0.98}) {
    const double x[3] = {x0, 0.2, 0.0}, image[3] = {x0 + 3.0 * length, 0.2, 0.0};
    EXPECT_NEAR(field.grid.distance(x), wave(x), bound);
    EXPECT_NEAR(field.grid.distance(image), field.grid.distance(x), 1e-13);
  }
}

TEST(GridDistance, outside_of_the_grid_its_border_counts)
{
  const Field field(2, 11, 2.0, [](const double *x) {
    return x[0] + 1.5;
  });
  const double inside[3] = {1.0, 0.0, 0.0}, outside[3] = {1.7, 0.0, 0.0};
  EXPECT_NEAR(field.grid.distance(outside), 2.5, 1e-14);
  EXPECT_NEAR(field.grid.distance(inside), 2.5, 1e-14);
  const double lost[3] = {std::nan(""), 0.0, 0.0};    // for LAMMPS to find: no crash here
  EXPECT_NEAR(field.grid.distance(lost), 0.5, 1e-14);
}

// What is no number is the largest error, wherever it is met.
TEST(GridSurvey, a_distance_that_is_no_number_is_infinitely_wrong)
{
  Field field(3, 13, 4.0, [](const double *x) {
    return x[1];
  });
  const auto everywhere = [](const double *) {
    return true;
  };
  const auto survey = [&] {
    return apf::GridSurvey::of(field.lattice, field.grid, 0.45, 1.5, everywhere);
  };
  EXPECT_GT(survey().nodes, 0);
  EXPECT_LT(survey().slope_error, 1e-12);
  const int layer = field.lattice.cells(0) + 3;    // of coefficients, one of them before the nodes
  field.coefficients[7 + layer * (9 + layer * 7)] = std::nan("");    // of the node at (0, 2/3, 0)
  EXPECT_EQ(survey().slope_error, HUGE_VAL);
  EXPECT_EQ(std::max(survey().error, survey().edge_bend), HUGE_VAL);
}

// A wall at the height 0.2, or on the border at -2, for a sphere of radius 0.5 and any scale of its
// field; none where the field has one sign, or where no centre comes.
TEST(GridSurvey, walls_are_found_on_any_scale)
{
  const auto found = [](const Shape &shape, double highest) {
    const Field field(3, 9, 4.0, shape);
    double at[3] = {};
    const bool is_there = apf::GridSurvey::crossing(
        field.lattice, field.grid, 0.5,
        [&](const double *x) {
          return x[1] <= highest;
        },
        at);
    return is_there ? at[1] : HUGE_VAL;
  };
  for (const double height : {0.2, -2.0})
    for (const double scale : {1e-320, 1e-200, 0.01, 1.0, 10.0, 1e99}) {
      const auto wall = [=](const double *x) {
        return scale * (x[1] - height);
      };
      const double first = height > 0.0 ? 0.5 : -1.5;
      EXPECT_EQ(found(wall, 2.0), first) << height << " " << scale;
      EXPECT_EQ(found(wall, height + 0.4), HUGE_VAL) << height << " " << scale;
    }
  EXPECT_EQ(found(
                [](const double *x) {
                  return x[1] > 0.0 ? 10.0 : -10.0;
                },
                2.0),
            0.5);
  for (const double side : {1.0, -1.0, 0.0})
    EXPECT_EQ(found(
                  [=](const double *x) {
                    return side * (x[1] + 3.0);
                  },
                  2.0),
              HUGE_VAL);
}
