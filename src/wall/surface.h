// Surfaces of a wall: distance of a point, positive in the fluid, and its foot on the surface.

#ifndef APF_SURFACE_H
#define APF_SURFACE_H

#include "grid_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace apf {

// A point seen from the surface. There is no foot where the distance has no slope: beyond the band
// that a grid's numbers are good for, and midway between two surfaces in one.
struct Foot {
  double distance;    // > 0 in the fluid                                              [length]
  double at[3];       // nearest point of the surface
  bool exists;
};

struct Surface {
  enum class Shape { plane, cylinder, grid } shape;
  int dim;             // plane: axis of its normal; cylinder: its axis; 0, 1, 2
  double side;         // +1: fluid above the plane, outside the cylinder; -1: below, inside
  double origin[2];    // plane: coordinate along dim; cylinder: axis position in the other two
                       // dimensions, in the order x, y, z                                [length]
  double radius;       // of the cylinder                                                 [length]
  GridDistance grid;
  // principal curvatures where they are the same all over the surface, else 0; > 0 where the
  // surface bends away from the fluid                                                  [1/length]
  double curvature[2] = {0.0, 0.0};
  bool uniform = true;    // whether they are the same
  // distances of a grid are known up to this, its largest number                        [length]
  double reach = std::numeric_limits<double>::infinity();

  static Surface plane(int dim, double coordinate, double side)
  {
    return {Shape::plane, dim, side, {coordinate, 0.0}, 0.0, {}};
  }
  static Surface cylinder(int dim, double c1, double c2, double radius, double side)
  {
    return {Shape::cylinder, dim, side, {c1, c2}, radius, {}, {side / radius, 0.0}};
  }
  static Surface gridded(const GridDistance &grid, double reach)
  {
    return {Shape::grid, 0, 1.0, {0.0, 0.0}, 0.0, grid, {0.0, 0.0}, false, reach};
  }

  // whether both are the same plane or cylinder, with the fluid on the same side
  bool same_as(const Surface &other) const
  {
    return shape != Shape::grid && shape == other.shape && dim == other.dim && side == other.side &&
        origin[0] == other.origin[0] && origin[1] == other.origin[1] && radius == other.radius;
  }

  // signed distance of x, > 0 in the fluid [length]
  double distance(const double *x) const
  {
    if (shape == Shape::plane) return side * (x[dim] - origin[0]);
    if (shape == Shape::grid) return grid.distance(x);
    return side * (axis_distance(x) - radius);
  }

  // the distance, or of a grid a bound below it that takes less time
  double at_least(const double *x) const
  {
    return shape == Shape::grid ? grid.at_least(x) : distance(x);
  }
  bool farther(const double *x, double than) const { return at_least(x) > than; }

  // the distance changes by no more than this times the way along each axis             [-]
  GridDistance::PerAxis steepness() const
  {
    if (shape == Shape::grid) return grid.steepness();
    GridDistance::PerAxis steepest{};
    for (int c = 0; c < 3; c++) steepest[c] = (shape == Shape::plane) == (c == dim) ? 1.0 : 0.0;
    return steepest;
  }

  // On a cylinder's axis the foot is not unique: any is taken. kappa: if given, gets the curvatures
  // of the surface of equal distance through x, the larger one first.
  Foot foot(const double *x, double *kappa = nullptr) const
  {
    Foot foot{0.0, {x[0], x[1], x[2]}, true};
    if (shape == Shape::plane) {
      foot.distance = distance(x);
      foot.at[dim] = origin[0];
    } else if (shape == Shape::cylinder) {
      const int d1 = first(), d2 = second();
      const double rho = axis_distance(x);
      const double e1 = rho > 0.0 ? (x[d1] - origin[0]) / rho : 1.0;
      const double e2 = rho > 0.0 ? (x[d2] - origin[1]) / rho : 0.0;
      foot.distance = side * (rho - radius);
      foot.at[d1] = origin[0] + radius * e1;
      foot.at[d2] = origin[1] + radius * e2;
    } else {
      double slope[3];
      foot.distance = kappa ? grid.distance(x, slope, kappa) : grid.distance(x, slope);
      const double size =
          std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
      foot.exists = size > least_slope;
      if (!foot.exists) return foot;
      const double back = foot.distance / size;
      for (int c = 0; c < 3; c++) foot.at[c] -= back * slope[c];
    }
    return foot;
  }

  // How fast the normal of a particle of radius r turns as it moves along: r times the curvature of
  // its path, kappa, which counts where it is not the same everywhere; < 0 inside a cylinder, where
  // the normal points outward [-]
  double turning(double kappa, double r) const
  {
    if (uniform) return r * curvature[0] / (1.0 + r * curvature[0]);
    // of an edge that is rolled over at the distance r: 1. Rounded, so that contacts at places that
    // are nearly alike are of one kind.
    return std::round(16.0 * std::clamp(r * kappa, -largest_turning, largest_turning)) / 16.0;
  }

  // Effective radius of the contact of a sphere of radius r: geometric mean of those along the two
  // principal directions (K. L. Johnson, J. A. Greenwood, J. Phys. D 38, 1042 (2005),
  // doi:10.1088/0022-3727/38/7/012) [length]
  double contact_radius(double r) const
  {
    return r / std::sqrt((1.0 + r * curvature[0]) * (1.0 + r * curvature[1]));
  }

  // the two dimensions across the plane's normal or the cylinder's axis
  int first() const { return dim == 0 ? 1 : 0; }
  int second() const { return dim == 2 ? 1 : 2; }

 private:
  static constexpr double least_slope = 0.5;    // of a distance it is 1
  static constexpr double largest_turning = 10.0;

  double axis_distance(const double *x) const
  {
    const double a = x[first()] - origin[0], b = x[second()] - origin[1];
    return std::sqrt(a * a + b * b);
  }
};

}    // namespace apf

#endif
