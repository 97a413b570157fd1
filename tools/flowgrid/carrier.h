// Unbounded surfaces of which the faces of shapes are parts: planes, spheres, cylinders without
// ends. Each has a signed distance, < 0 behind the plane and inside the others, whose slope and
// curvature are known in closed form.

#ifndef FLOWGRID_CARRIER_H
#define FLOWGRID_CARRIER_H

#include "vector.h"

namespace flowgrid {

struct Carrier {
  enum class Kind { plane, sphere, cylinder } kind;
  Point origin;     // a point of the plane, the center, a point of the axis
  Point axis;       // unit normal, or direction of the cylinder
  double radius;    // [length]

  double distance(const Point &x) const
  {
    return kind == Kind::plane ? dot(axis, x - origin) : length(across(x)) - radius;
  }

  // slope of the distance; on the axis of a cylinder, or in the center, any direction
  Point normal(const Point &x) const
  {
    if (kind == Kind::plane) return axis;
    const Point out = unit(across(x));
    return dot(out, out) > 0.0 ? out : any_normal();
  }

  // adds factor times the second derivatives of the distance
  void add_bend(const Point &x, double factor, double (*h)[6]) const
  {
    if (kind == Kind::plane) return;
    const Point n = normal(x);
    const double rho = std::max(length(across(x)), 1e-3 * radius);
    for (int i = 0; i < 3; i++)
      for (int j = 0; j < 3; j++) {
        const double along = kind == Kind::cylinder ? axis[i] * axis[j] : 0.0;
        h[i][j] += factor * ((i == j) - n[i] * n[j] - along) / rho;
      }
  }

  Point foot(const Point &x) const
  {
    // a second step takes the rounding of the first away
    const Point y = x - distance(x) * normal(x);
    return y - distance(y) * normal(y);
  }

  // the center, or the nearest point of the axis; of a plane the point itself
  Point middle(const Point &x) const { return kind == Kind::plane ? x : x - across(x); }

  // 1 or -1 if the other one is the same surface, with the same or the opposite normal, else 0
  int same_as(const Carrier &other, double tolerance) const
  {
    if (kind != other.kind) return 0;
    if (kind == Kind::sphere)
      return length(origin - other.origin) < tolerance &&
          std::fabs(radius - other.radius) < tolerance;
    if (length(cross(axis, other.axis)) > 1e-12) return 0;
    if (kind == Kind::cylinder)
      return length(across(other.origin)) < tolerance &&
          std::fabs(radius - other.radius) < tolerance;
    if (std::fabs(distance(other.origin)) > tolerance) return 0;
    return dot(axis, other.axis) > 0.0 ? 1 : -1;
  }

 private:
  Point across(const Point &x) const
  {
    const Point r = x - origin;
    return kind == Kind::cylinder ? r - dot(r, axis) * axis : r;
  }
  Point any_normal() const
  {
    if (kind == Kind::sphere) return {1.0, 0.0, 0.0};
    const Point e = std::fabs(axis[0]) < 0.7 ? Point{1.0, 0.0, 0.0} : Point{0.0, 1.0, 0.0};
    return unit(cross(axis, e));
  }
};

}    // namespace flowgrid

#endif
