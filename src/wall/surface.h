// Walls of simple shape: distance of a point, positive in the fluid, and its foot on the wall.

#ifndef APF_SURFACE_H
#define APF_SURFACE_H

#include <cmath>

namespace apf {

struct Surface {
  enum class Shape { plane, cylinder } shape;
  int dim;             // plane: axis of its normal; cylinder: its axis; 0, 1, 2
  double side;         // +1: fluid above the plane, outside the cylinder; -1: below, inside
  double origin[2];    // plane: coordinate along dim; cylinder: axis position in the other two
                       // dimensions, in the order x, y, z                                [length]
  double radius;       // of the cylinder                                                 [length]

  static Surface plane(int dim, double coordinate, double side)
  {
    return {Shape::plane, dim, side, {coordinate, 0.0}, 0.0};
  }
  static Surface cylinder(int dim, double c1, double c2, double radius, double side)
  {
    return {Shape::cylinder, dim, side, {c1, c2}, radius};
  }

  // signed distance of x, > 0 in the fluid [length]
  double distance(const double *x) const
  {
    if (shape == Shape::plane) return side * (x[dim] - origin[0]);
    return side * (axis_distance(x) - radius);
  }

  // nearest point of the wall. On a cylinder's axis it is not unique: any is taken.
  void foot(const double *x, double *at) const
  {
    for (int c = 0; c < 3; c++) at[c] = x[c];
    if (shape == Shape::plane) {
      at[dim] = origin[0];
      return;
    }
    const int d1 = first(), d2 = second();
    const double rho = axis_distance(x);
    const double e1 = rho > 0.0 ? (x[d1] - origin[0]) / rho : 1.0;
    const double e2 = rho > 0.0 ? (x[d2] - origin[1]) / rho : 0.0;
    at[d1] = origin[0] + radius * e1;
    at[d2] = origin[1] + radius * e2;
  }

  // how fast the normal of a particle of radius r turns as it moves along: r / distance from the
  // axis, < 0 inside a cylinder, where the normal points outward [-]
  double turning(double r) const
  {
    return shape == Shape::plane ? 0.0 : side * r / (radius + side * r);
  }

  // the two dimensions across the plane's normal or the cylinder's axis
  int first() const { return dim == 0 ? 1 : 0; }
  int second() const { return dim == 2 ? 1 : 2; }

 private:
  double axis_distance(const double *x) const
  {
    const double a = x[first()] - origin[0], b = x[second()] - origin[1];
    return std::sqrt(a * a + b * b);
  }
};

}    // namespace apf

#endif
