// Where a point lies within a cell. Bi- and trilinear cells: IIHR Report 459, eqs (51) to (55), and
// their like in space,
//   x = sum Phi_k x_k,   Phi_k = product over axes of (1 + s_k p)/2,   s_k = -1 or 1,
// inverted by Newton's method. Triangles and tetrahedra are linear: their coordinates are the
// weights of the corners themselves.

#ifndef FLOWGRID_INVERSE_MAP_H
#define FLOWGRID_INVERSE_MAP_H

#include "mesh.h"

#include <cmath>

namespace flowgrid {

// A point that lies less than this beyond a face counts as on it: VTK's reader of OpenFOAM keeps
// coordinates in single precision.
constexpr double inside_tolerance = 1e-6;
// One that rounding alone put beyond a face is on it, so that a wall at rest stays at rest. A node
// farther out gets the cell's functions as they go on there, which keeps linear fields exact.
constexpr double on_face = 1e-12;

struct Local {
  double weight[8] = {};    // of the corners
  // how far the point is beyond each face, in coordinates of the cell; <= 0 inside
  double beyond[6] = {};
  bool converged = true;

  bool inside(int faces) const
  {
    bool all = converged;
    for (int f = 0; f < faces; f++) all &= beyond[f] <= inside_tolerance;
    return all;
  }
};

// solves a x = b for n = 2 or 3 by Cramer's rule; false if a is singular
inline bool solve(int n, const double (*a)[3], const double *b, double *x)
{
  if (n == 2) {
    const double det = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    if (det == 0.0) return false;
    x[0] = (b[0] * a[1][1] - a[0][1] * b[1]) / det;
    x[1] = (a[0][0] * b[1] - b[0] * a[1][0]) / det;
    return true;
  }
  auto det3 = [](const double *u, const double *v, const double *w) {
    return u[0] * (v[1] * w[2] - v[2] * w[1]) - u[1] * (v[0] * w[2] - v[2] * w[0]) +
        u[2] * (v[0] * w[1] - v[1] * w[0]);
  };
  double column[3][3];
  for (int r = 0; r < 3; r++)
    for (int c = 0; c < 3; c++) column[c][r] = a[r][c];
  const double det = det3(column[0], column[1], column[2]);
  if (det == 0.0) return false;
  x[0] = det3(b, column[1], column[2]) / det;
  x[1] = det3(column[0], b, column[2]) / det;
  x[2] = det3(column[0], column[1], b) / det;
  return true;
}

// simplex: x = x_0 + sum l_k (x_k - x_0), weights l_k, l_0 = 1 - sum
inline Local in_simplex(const Mesh &mesh, int cell, const double *x)
{
  Local local;
  const int n = info(mesh.shapes[cell]).dim;
  const auto &corner = mesh.corners[cell];
  double a[3][3], b[3], l[3];
  for (int r = 0; r < n; r++) {
    b[r] = x[r] - mesh.points[corner[0]][r];
    for (int k = 0; k < n; k++) a[r][k] = mesh.points[corner[k + 1]][r] - mesh.points[corner[0]][r];
  }
  local.converged = solve(n, a, b, l);
  if (!local.converged) return local;
  local.weight[0] = 1.0;
  for (int k = 0; k < n; k++) {
    local.weight[k + 1] = l[k];
    local.weight[0] -= l[k];
  }
  for (int k = 0; k <= n; k++) local.beyond[k] = -local.weight[k];
  if (!local.inside(n + 1)) return local;
  for (int k = 0; k <= n; k++)
    if (std::fabs(local.weight[k]) < on_face) local.weight[k] = 0.0;
  return local;
}

// quadrilateral or hexahedron
inline Local in_brick(const Mesh &mesh, int cell, const double *x)
{
  static const double sign[8][3] = {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                    {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
  const auto &shape = info(mesh.shapes[cell]);
  const int n = shape.dim;
  const auto &corner = mesh.corners[cell];
  Local local;
  double p[3] = {};
  auto set_weight = [&](int k, double *factor) {
    local.weight[k] = 1.0;
    for (int c = 0; c < n; c++) {
      factor[c] = 0.5 * (1.0 + sign[k][c] * p[c]);
      local.weight[k] *= factor[c];
    }
  };
  local.converged = false;
  for (int step = 0; step < 30 && !local.converged; step++) {
    double a[3][3] = {}, b[3], dp[3];
    for (int r = 0; r < n; r++) b[r] = x[r];
    for (int k = 0; k < shape.corners; k++) {
      double factor[3];
      set_weight(k, factor);
      for (int c = 0; c < n; c++) {
        double slope = 0.5 * sign[k][c];
        for (int d = 0; d < n; d++)
          if (d != c) slope *= factor[d];
        for (int r = 0; r < n; r++) a[r][c] += slope * mesh.points[corner[k]][r];
      }
      for (int r = 0; r < n; r++) b[r] -= local.weight[k] * mesh.points[corner[k]][r];
    }
    if (!solve(n, a, b, dp)) break;
    double largest = 0.0, way = 0.0;
    for (int c = 0; c < n; c++) way = std::max(way, std::fabs(dp[c]));
    const double damp = way > 2.0 ? 2.0 / way : 1.0;    // far away the map folds over
    for (int c = 0; c < n; c++) {
      p[c] += damp * dp[c];
      largest = std::max(largest, std::fabs(p[c]));
    }
    local.converged = way < 1e-12 * std::max(largest, 1.0);
    if (largest > 1e3) break;
  }
  for (int c = 0; c < n; c++) {
    local.beyond[2 * c] = -p[c] - 1.0;
    local.beyond[2 * c + 1] = p[c] - 1.0;
    if (std::fabs(std::fabs(p[c]) - 1.0) < on_face) p[c] = std::copysign(1.0, p[c]);
  }
  for (int k = 0; k < shape.corners; k++) {
    double factor[3];
    set_weight(k, factor);
  }
  return local;
}

inline Local locate(const Mesh &mesh, int cell, const double *x)
{
  const Shape shape = mesh.shapes[cell];
  return shape == Shape::TRIANGLE || shape == Shape::TETRA ? in_simplex(mesh, cell, x)
                                                           : in_brick(mesh, cell, x);
}

}    // namespace flowgrid

#endif
