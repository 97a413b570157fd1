// The nearest point to x of the curve in which two carriers meet, or of the corner of three.

#ifndef FLOWGRID_NEAREST_POINT_H
#define FLOWGRID_NEAREST_POINT_H

#include "carrier.h"

namespace flowgrid {

// Solves a y = b, n x n, by elimination with the largest pivot; false if it is singular.
inline bool solve_system(double (*a)[6], double *b, int n)
{
  for (int k = 0; k < n; k++) {
    int p = k;
    for (int i = k + 1; i < n; i++)
      if (std::fabs(a[i][k]) > std::fabs(a[p][k])) p = i;
    if (std::fabs(a[p][k]) < 1e-9) return false;
    std::swap(b[k], b[p]);
    for (int j = 0; j < n; j++) std::swap(a[k][j], a[p][j]);
    for (int i = k + 1; i < n; i++) {
      const double factor = a[i][k] / a[k][k];
      for (int j = k; j < n; j++) a[i][j] -= factor * a[k][j];
      b[i] -= factor * b[k];
    }
  }
  for (int k = n - 1; k >= 0; k--) {
    for (int j = k + 1; j < n; j++) b[k] -= a[k][j] * b[j];
    b[k] /= a[k][k];
  }
  return true;
}

// Newton's method for the least |y - x| where the distances of `count` (2 or 3) carriers are 0:
//   y - x + sum_i w_i n_i = 0, phi_i(y) = 0.
// False if it does not converge, as where they touch without crossing.
inline bool nearest_point(const Carrier *const *carriers, int count, const Point &x, Point &y)
{
  double weight[3] = {};
  double scale = 1e-300;
  for (int k = 0; k < count; k++) scale += std::fabs(carriers[k]->distance(x));
  y = x;
  for (int iteration = 0; iteration < 30; iteration++) {
    double a[6][6] = {}, b[6];
    for (int i = 0; i < 3; i++) {
      a[i][i] = 1.0;
      b[i] = x[i] - y[i];
    }
    for (int k = 0; k < count; k++) {
      const Point n = carriers[k]->normal(y);
      carriers[k]->add_bend(y, weight[k], a);
      for (int i = 0; i < 3; i++) a[i][3 + k] = a[3 + k][i] = n[i];
      b[3 + k] = -carriers[k]->distance(y);
    }
    if (!solve_system(a, b, 3 + count)) return false;
    double step = 0.0;
    for (int i = 0; i < 3; i++) {
      y[i] += b[i];
      step += std::fabs(b[i]);
    }
    for (int k = 0; k < count; k++) weight[k] = b[3 + k];
    if (step < 1e-13 * scale) return true;
    if (!(step < 1e6 * scale)) return false;
    if (iteration > 6 && step < 1e-9 * scale) return true;    // as far as rounding lets it
  }
  return false;
}

}    // namespace flowgrid

#endif
