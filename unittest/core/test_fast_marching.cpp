// Fast marching against exact shapes, at two spacings: the error of a march from exact numbers near
// the wall falls with the square of the spacing; planes come out exactly. And beside scikit-fmm.

#include "compare.h"
#include "wall/fast_marching.h"

#include "gtest/gtest.h"

#include <array>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <unistd.h>

namespace {

using apf::FastMarching;
using apf::Lattice;
using Shape = std::function<double(const std::array<double, 3> &)>;

const double unknown = std::numeric_limits<double>::quiet_NaN();

Lattice cube(int dims, int cells, std::array<double, 3> stretch = {1.0, 1.0, 1.0})
{
  Lattice grid;
  grid.dims = dims;
  for (int axis = 0; axis < 3; axis++) {
    grid.n[axis] = axis < dims ? static_cast<int>(std::lround(cells / stretch[axis])) + 1 : 1;
    grid.origin[axis] = axis < dims ? -1.0 : 0.0;
    grid.spacing[axis] = axis < dims ? 2.0 / (grid.n[axis] - 1) : 1.0;
  }
  return grid;
}

std::vector<double> on_nodes(const Lattice &grid, const Shape &shape)
{
  std::vector<double> values;
  apf::for_each_node(grid, [&](int i, int j, int k, std::size_t) {
    values.push_back(
        shape({grid.origin[0] + i * grid.spacing[0], grid.origin[1] + j * grid.spacing[1],
               grid.origin[2] + k * grid.spacing[2]}));
  });
  return values;
}

std::vector<double> seeds_within(const std::vector<double> &exact, double width)
{
  auto seeds = exact;
  for (double &value : seeds)
    if (std::fabs(value) > width) value = unknown;
  return seeds;
}

double size(const std::array<double, 3> &x, int dims)
{
  return std::sqrt(x[0] * x[0] + x[1] * x[1] + (dims == 3 ? x[2] * x[2] : 0.0));
}

struct Error {
  double max = 0.0, mean = 0.0;
};
Error error_in_band(const std::vector<double> &exact, const std::vector<double> &marched,
                    double band)
{
  Error error;
  int n = 0;
  for (std::size_t node = 0; node < exact.size(); node++) {
    if (std::fabs(exact[node]) > band) continue;
    const double off = std::fabs(marched[node] - exact[node]);
    error.max = apf_test::larger(error.max, off);
    error.mean += off;
    n++;
  }
  error.mean /= n;
  return error;
}

// a circle or sphere of radius 0.5, known where |phi| < 0.08, to |phi| = 0.3
Error error_of_ball(int dims, int cells, std::array<double, 3> stretch = {1.0, 1.0, 1.0})
{
  const Lattice grid = cube(dims, cells, stretch);
  const auto exact = on_nodes(grid, [&](const std::array<double, 3> &x) {
    return size(x, dims) - 0.5;
  });
  return error_in_band(exact, FastMarching::fill(grid, seeds_within(exact, 0.08), 0.4), 0.3);
}

void expect_order(const Error &coarse, const Error &fine, double least, double most)
{
  const double order = std::log2(coarse.mean / fine.mean);
  EXPECT_GT(order, least);
  EXPECT_LT(order, most);
  printf("order of the mean error %.2f, of the largest %.2f; largest %.2e, %.2e\n", order,
         std::log2(coarse.max / fine.max), coarse.max, fine.max);
}

}    // namespace

TEST(FastMarching, second_order_around_and_in_a_circle)
{
  const Error coarse = error_of_ball(2, 64), fine = error_of_ball(2, 128);
  expect_order(coarse, fine, 1.7, 2.4);
  EXPECT_LT(fine.max, 1e-3);
}

TEST(FastMarching, second_order_around_and_in_a_sphere)
{
  const Error coarse = error_of_ball(3, 32), fine = error_of_ball(3, 64);
  expect_order(coarse, fine, 1.6, 2.4);
  EXPECT_LT(fine.max, 4e-3);
}

TEST(FastMarching, spacings_may_differ)
{
  const Error coarse = error_of_ball(2, 64, {1.0, 1.7, 1.0}),
              fine = error_of_ball(2, 128, {1.0, 1.7, 1.0});
  expect_order(coarse, fine, 1.7, 2.4);
}

TEST(FastMarching, planes_are_exact)
{
  // upwind differences are exact for linear fields, where the nodes upwind are within the grid
  const Lattice grid = cube(2, 50);
  const auto exact = on_nodes(grid, [](const std::array<double, 3> &x) {
    return 0.6 * x[0] + 0.8 * x[1];
  });
  const auto marched = FastMarching::fill(grid, seeds_within(exact, 0.15), 0.8);
  apf::for_each_node(grid, [&](int i, int j, int, std::size_t node) {
    const double x = grid.origin[0] + i * grid.spacing[0], y = grid.origin[1] + j * grid.spacing[1];
    // the way to the wall, and a cell more, lies within the grid
    const double d = exact[node], margin = 0.1;
    if (std::fabs(d) > 0.7 || std::fabs(x - 1.4 * d) > 1.0 - margin ||
        std::fabs(x) > 1.0 - margin || std::fabs(y - 1.4 * d) > 1.0 - margin ||
        std::fabs(y) > 1.0 - margin)
      return;
    EXPECT_NEAR(marched[node], d, 1e-13);
  });
}

TEST(FastMarching, a_border_between_seeds_on_an_axis_is_exact)
{
  // along an axis, from one layer of seeds on each side
  const Lattice grid = cube(3, 20);
  const auto exact = on_nodes(grid, [](const std::array<double, 3> &x) {
    return x[2] - 0.03;
  });
  const auto marched = FastMarching::fill(grid, seeds_within(exact, 0.08), 0.5);
  for (std::size_t node = 0; node < exact.size(); node++)
    EXPECT_NEAR(marched[node], std::min(std::max(exact[node], -0.5), 0.5), 1e-13);
}

TEST(FastMarching, periodic_axes_have_no_border)
{
  // a circle cut by the border is the one in the middle, moved by half a period
  Lattice grid = cube(2, 64);
  for (int axis = 0; axis < 2; axis++) {
    grid.periodic[axis] = true;
    grid.n[axis]--;
  }
  const auto exact = on_nodes(grid, [](const std::array<double, 3> &x) {
    return size(x, 2) - 0.4;
  });
  const auto middle = FastMarching::fill(grid, seeds_within(exact, 0.1), 0.5);
  auto moved = seeds_within(exact, 0.1);
  const auto rolled = [&](std::size_t node) {
    const int i = (node % 64 + 32) % 64, j = (node / 64 + 32) % 64;
    return grid.node(i, j, 0);
  };
  const auto seeds = moved;
  for (std::size_t node = 0; node < seeds.size(); node++) moved[rolled(node)] = seeds[node];
  const auto cut = FastMarching::fill(grid, moved, 0.5);
  for (std::size_t node = 0; node < seeds.size(); node++)
    EXPECT_NEAR(cut[rolled(node)], middle[node], 1e-14);
}

TEST(FastMarching, both_sides_end_at_the_band)
{
  const Lattice grid = cube(2, 40);
  const auto exact = on_nodes(grid, [](const std::array<double, 3> &x) {
    return size(x, 2) - 0.6;
  });
  const auto marched = FastMarching::fill(grid, seeds_within(exact, 0.1), 0.2);
  for (std::size_t node = 0; node < exact.size(); node++) {
    EXPECT_LE(std::fabs(marched[node]), 0.2);
    EXPECT_EQ(std::signbit(marched[node]), std::signbit(exact[node]));
    if (std::fabs(exact[node]) > 0.22) {
      EXPECT_EQ(std::fabs(marched[node]), 0.2);
    } else if (std::fabs(exact[node]) <= 0.1) {
      EXPECT_EQ(marched[node], exact[node]);
    }
  }
  const std::vector<double> none(grid.nodes(), unknown);
  for (const double value : FastMarching::fill(grid, none, 0.2)) EXPECT_EQ(value, 0.2);
}

// scikit-fmm finds the wall by itself; both are compared with the circle
TEST(FastMarching, beside_scikit_fmm)
{
  if (std::system("/usr/bin/python3 -c 'import skfmm' 2>/dev/null") != 0)
    GTEST_SKIP() << "Debian's python3-scikit-fmm is not installed";
  const Lattice grid = cube(2, 100);
  const auto exact = on_nodes(grid, [](const std::array<double, 3> &x) {
    return size(x, 2) - 0.5;
  });
  const std::string file =
      (std::filesystem::temp_directory_path() / ("apf-skfmm-" + std::to_string(getpid()))).string();
  {
    std::ofstream out(file, std::ios::binary);
    out.write(reinterpret_cast<const char *>(exact.data()), exact.size() * sizeof(double));
  }
  const std::string python = "/usr/bin/python3 -c 'import numpy, skfmm\n"
                             "phi = numpy.fromfile(\"" +
      file +
      "\").reshape(101, 101)\n"
      "skfmm.distance(phi, dx=0.02, order=2).tofile(\"" +
      file + "\")'";
  ASSERT_EQ(std::system(python.c_str()), 0);
  std::vector<double> theirs(exact.size());
  std::ifstream(file, std::ios::binary)
      .read(reinterpret_cast<char *>(theirs.data()), theirs.size() * sizeof(double));
  std::remove(file.c_str());
  const auto ours = FastMarching::fill(grid, seeds_within(exact, 0.04), 0.4);
  const Error our_error = error_in_band(exact, ours, 0.3),
              their_error = error_in_band(exact, theirs, 0.3);
  printf("largest error: ours %.2e, theirs %.2e\n", our_error.max, their_error.max);
  EXPECT_LT(our_error.max, their_error.max);
  EXPECT_GT(our_error.max, 0.05 * their_error.max);
  EXPECT_LT(error_in_band(theirs, ours, 0.3).max, 1.5 * their_error.max);
}
