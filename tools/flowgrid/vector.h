// Points as vectors.

#ifndef FLOWGRID_VECTOR_H
#define FLOWGRID_VECTOR_H

#include "mesh.h"

#include <cmath>

namespace flowgrid {

inline Point operator+(const Point &a, const Point &b)
{
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}
inline Point operator-(const Point &a, const Point &b)
{
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}
inline Point operator*(double s, const Point &a)
{
  return {s * a[0], s * a[1], s * a[2]};
}
inline double dot(const Point &a, const Point &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
inline Point cross(const Point &a, const Point &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Point &a)
{
  return std::sqrt(dot(a, a));
}
// 0 stays 0
inline Point unit(const Point &a)
{
  const double size = length(a);
  return size > 0.0 ? (1.0 / size) * a : a;
}
inline double angle(const Point &a, const Point &b)
{
  return std::atan2(length(cross(a, b)), dot(a, b));
}

}    // namespace flowgrid

#endif
