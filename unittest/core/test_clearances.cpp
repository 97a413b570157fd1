// Bounds of the distance to walls against the distance itself.

#include "wall/clearances.h"

#include <gtest/gtest.h>

#include <random>

namespace {

double size(const double *x)
{
  return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

struct GriddedSphere {    // fluid inside: with a kink in the middle
  std::vector<double> coefficients;
  apf::Surface surface{};

  GriddedSphere()
  {
    apf::Lattice lattice;
    std::vector<double> values;
    for (int c = 0; c < 3; c++) {
      lattice.n[c] = 31;
      lattice.origin[c] = -1.5;
      lattice.spacing[c] = 0.1;
    }
    apf::for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
      double x[3];
      lattice.position(i, j, k, x);
      values.push_back(1.2 - size(x));
    });
    coefficients.resize(apf::GridDistance::size(lattice));
    const auto jumps = apf::GridDistance::write_coefficients(lattice, values, coefficients.data());
    surface = apf::Surface::gridded(apf::GridDistance(lattice, coefficients.data(), jumps), 1.2);
  }
};

}    // namespace

// From wherever a particle was looked at, and wherever it went in the fluid, the bound lies below
// the distance; and not by more than the way times the steepest slopes along three axes.
TEST(Clearances, are_below_the_distance)
{
  const GriddedSphere sphere;
  const std::vector<apf::Surface> surfaces = {apf::Surface::plane(1, -1.3, 1.0),
                                              apf::Surface::cylinder(2, 0.1, 0.0, 1.3, -1.0),
                                              sphere.surface};
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in_box(-0.7, 0.7);
  for (const auto &surface : surfaces) {
    apf::Clearances clearances;
    clearances.include(surface);
    clearances.resize(1);
    double closest = 1e300;
    for (int n = 0; n < 20000; n++) {
      double x[3], y[3], way = 0.0;
      for (int c = 0; c < 3; c++) {
        x[c] = in_box(random);
        y[c] = n % 2 ? in_box(random) : x[c] + 0.1 * in_box(random);
        way += std::fabs(y[c] - x[c]);
      }
      clearances.note(0, x, surface.distance(x));
      const double above = surface.distance(y) - clearances.at_least(0, y);
      EXPECT_GE(above, -1e-15);
      EXPECT_LE(above, 3.4 * way + 1e-15);    // 5/3 along an axis at a kink, and the way itself
      closest = std::min(closest, above / way);
    }
    // straight to the wall; the grid's kink makes its steepest slope 5/3
    EXPECT_LT(closest, surface.shape == apf::Surface::Shape::grid ? 1.3 : 0.05);
    clearances.forget_all();
    const double x[3] = {};
    EXPECT_LT(clearances.at_least(0, x), -1e300);
  }
}

// the bound from one number of the grid
TEST(Clearances, bound_of_the_nearest_node)
{
  const GriddedSphere sphere;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in_box(-0.69, 0.69);
  double closest = 1e300;
  for (int n = 0; n < 20000; n++) {
    const double x[3] = {in_box(random), in_box(random), in_box(random)};
    const double below = sphere.surface.distance(x) - sphere.surface.at_least(x);
    EXPECT_GT(below, 0.0);
    EXPECT_LT(below, 0.4);    // four spacings
    closest = std::min(closest, below);
  }
  EXPECT_LT(closest, 0.25);
}
