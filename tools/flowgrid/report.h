// How good a mapped velocity is: its divergence, and how fast it slips at the walls.

#ifndef FLOWGRID_REPORT_H
#define FLOWGRID_REPORT_H

#include "mapping.h"

namespace flowgrid {

struct Quality {
  double fastest = 0.0;    // largest velocity              [velocity]
  double divergence_max = 0.0,
         divergence_rms = 0.0;    // of nodes with all neighbours in the fluid,
                                  // times spacing over the fastest       [-]
  size_t walls_seen = 0;          // points of walls within the grid
  double slip = 0.0;    // largest velocity, interpolated at these points, over the fastest  [-]
};

// trilinear interpolation on the grid; false outside of it
inline bool interpolate(const Grid &grid, const std::vector<double> &u, const Point &x, double *out)
{
  int base[3];
  double part[3];
  for (int c = 0; c < 3; c++) {
    if (grid.n[c] == 1) {
      base[c] = 0;
      part[c] = 0.0;
      continue;
    }
    const double s = (x[c] - grid.origin[c]) / grid.spacing[c];
    if (s < -1e-9 || s > grid.n[c] - 1 + 1e-9) return false;
    base[c] = std::min(std::max(static_cast<int>(s), 0), grid.n[c] - 2);
    part[c] = s - base[c];
  }
  for (int c = 0; c < 3; c++) out[c] = 0.0;
  for (int k = 0; k < 8; k++) {
    double w = 1.0;
    size_t at[3];
    for (int c = 0; c < 3; c++) {
      const bool upper = k >> c & 1;
      w *= upper ? part[c] : 1.0 - part[c];
      at[c] = std::min(base[c] + upper, grid.n[c] - 1);
    }
    const size_t node = (at[2] * grid.n[1] + at[1]) * grid.n[0] + at[0];
    for (int c = 0; c < 3; c++) out[c] += w * u[3 * node + c];
  }
  return true;
}

inline Quality quality(const Mapping &map, const std::vector<double> &u,
                       const std::vector<Point> &wall_points)
{
  Quality q;
  const Grid &grid = map.grid;
  for (size_t node = 0; node < grid.nodes(); node++)
    q.fastest = std::max(q.fastest, std::hypot(u[3 * node], u[3 * node + 1], u[3 * node + 2]));

  const size_t stride[3] = {1, static_cast<size_t>(grid.n[0]),
                            static_cast<size_t>(grid.n[0]) * grid.n[1]};
  double smallest = 1e300, sum = 0.0;
  size_t count = 0;
  for (int c = 0; c < 3; c++)
    if (grid.n[c] > 1) smallest = std::min(smallest, grid.spacing[c]);
  for (size_t node = 0; node < grid.nodes(); node++) {
    const int at[3] = {static_cast<int>(node % grid.n[0]),
                       static_cast<int>(node / grid.n[0] % grid.n[1]),
                       static_cast<int>(node / stride[2])};
    double divergence = 0.0;
    bool whole = map.inside(node);
    for (int c = 0; c < 3 && whole; c++) {
      if (grid.n[c] == 1) continue;
      whole = at[c] > 0 && at[c] < grid.n[c] - 1 && map.inside(node - stride[c]) &&
          map.inside(node + stride[c]);
      if (whole)
        divergence += (u[3 * (node + stride[c]) + c] - u[3 * (node - stride[c]) + c]) /
            (2.0 * grid.spacing[c]);
    }
    if (!whole) continue;
    const double scaled = q.fastest > 0.0 ? std::fabs(divergence) * smallest / q.fastest : 0.0;
    q.divergence_max = std::max(q.divergence_max, scaled);
    sum += scaled * scaled;
    count++;
  }
  if (count) q.divergence_rms = std::sqrt(sum / count);

  for (const auto &x : wall_points) {
    double at[3];
    if (!interpolate(grid, u, x, at)) continue;
    q.walls_seen++;
    if (q.fastest > 0.0) q.slip = std::max(q.slip, std::hypot(at[0], at[1], at[2]) / q.fastest);
  }
  return q;
}

}    // namespace flowgrid

#endif
