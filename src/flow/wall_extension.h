// Velocity at nodes outside the fluid, such that interpolation between nodes meets no-slip at the
// wall. With phi the signed distance to it, > 0 in the fluid, a velocity that vanishes there is
//   u = phi g,   g smooth
// g is fitted to the fluid's nodes around a node outside as a linear function of position, by least
// squares of u - phi g, and continued to that node: u is then wrong by third order in the spacing,
// and interpolation stays of second order up to the wall. Nodes just inside, where u/phi would be
// noise, carry the little weight phi^2. Nodes that belong to another wall (normal grad phi turned
// by more than 60 degrees) are left out; where no normal exists, in a plate thinner than the
// spacing, the velocity is 0. Nodes far from the fluid get 0, nobody reads them.
// After the ghost-cell methods, as in Y.-H. Tseng, J. H. Ferziger, J. Comput. Phys. 192, 593
// (2003), doi:10.1016/j.jcp.2003.07.024

#ifndef APF_WALL_EXTENSION_H
#define APF_WALL_EXTENSION_H

#include "../contact/vector.h"
#include "lattice.h"

#include <algorithm>
#include <limits>

namespace apf {

class WallExtension {
 public:
  // phi: signed distance at the nodes, u: three numbers per node; both in the order of memory
  WallExtension(const Lattice &lattice, const std::vector<double> &phi, std::vector<double> &u) :
      grid(lattice), distance(phi), velocity(u)
  {
  }

  void fill() const
  {
    for_each_node(grid, [this](int i, int j, int k, std::size_t node) {
      if (distance[node] > 0.0) return;
      const Vec3 u = extended(i, j, k, node);
      velocity[3 * node] = u.x;
      velocity[3 * node + 1] = u.y;
      velocity[3 * node + 2] = u.z;
    });
  }

 private:
  static constexpr int reach = 3;    // nodes that the fit looks at, along each axis
  static constexpr int depth = 2;    // layers of nodes outside that are filled: the second one
                                     // is for the slopes at the first
  static constexpr double ridge = 1e-10;    // keeps slopes that the nodes do not determine at 0

  const Lattice &grid;
  const std::vector<double> &distance;
  std::vector<double> &velocity;

  // least squares for g = c0 + c1 di + c2 dj + c3 dk, the three components of u side by side
  struct Fit {
    double a[4][4] = {}, b[4][3] = {};

    void add(double weight, double phi, const int *offset, const double *u)
    {
      const double q[4] = {phi, phi * offset[0], phi * offset[1], phi * offset[2]};
      for (int r = 0; r < 4; r++) {
        for (int c = 0; c <= r; c++) a[r][c] += weight * q[r] * q[c];
        for (int c = 0; c < 3; c++) b[r][c] += weight * q[r] * u[c];
      }
    }
    // c0 by Cholesky's method: the last unknown of the reversed order comes first
    Vec3 at_origin()
    {
      double l[4][4], y[4][3];
      for (int r = 1; r < 4; r++) a[r][r] += ridge * a[0][0];
      const auto entry = [this](int r, int c) {
        return a[3 - std::min(r, c)][3 - std::max(r, c)];
      };
      for (int r = 0; r < 4; r++) {
        for (int c = 0; c <= r; c++) {
          double sum = entry(r, c);
          for (int m = 0; m < c; m++) sum -= l[r][m] * l[c][m];
          l[r][c] = r == c ? std::sqrt(std::max(sum, ridge * a[0][0])) : sum / l[c][c];
        }
        for (int c = 0; c < 3; c++) {
          double sum = b[3 - r][c];
          for (int m = 0; m < r; m++) sum -= l[r][m] * y[m][c];
          y[r][c] = sum / l[r][r];
        }
      }
      return {y[3][0] / l[3][3], y[3][1] / l[3][3], y[3][2] / l[3][3]};
    }
  };

  Vec3 normal(int i, int j, int k, std::size_t node) const
  {
    const int index[3] = {i, j, k};
    double slope[3] = {};
    for (int axis = 0; axis < grid.dims; axis++)
      slope[axis] = node_slope(grid, axis, index[axis], &distance[node], grid.stride(axis));
    return {slope[0], slope[1], slope[2]};
  }

  // square of the distance to a neighbour
  double squared(const int *offset) const
  {
    double sum = 0.0;
    for (int axis = 0; axis < grid.dims; axis++)
      sum += offset[axis] * grid.spacing[axis] * offset[axis] * grid.spacing[axis];
    return sum;
  }

  Vec3 extended(int i, int j, int k, std::size_t node) const
  {
    double furthest = 0.0;
    for (int axis = 0; axis < grid.dims; axis++) furthest += depth * grid.spacing[axis];
    if (-distance[node] > furthest) return {0.0, 0.0, 0.0};
    const Vec3 outward = normal(i, j, k, node);
    if (norm2(outward) < 0.25) return {0.0, 0.0, 0.0};

    Fit fit;
    bool near = false;
    double nearest = std::numeric_limits<double>::max();
    const int deep = grid.dims == 3 ? reach : 0;
    for (int dk = -deep; dk <= deep; dk++)
      for (int dj = -reach; dj <= reach; dj++)
        for (int di = -reach; di <= reach; di++) {
          const int offset[3] = {di, dj, dk};
          const int at[3] = {grid.wrap(0, i + di), grid.wrap(1, j + dj), grid.wrap(2, k + dk)};
          if (at[0] < 0 || at[1] < 0 || at[2] < 0) continue;
          const std::size_t other = grid.node(at[0], at[1], at[2]);
          if (!(distance[other] > 0.0)) continue;
          nearest = std::min(nearest, squared(offset));
          near = near || (std::abs(di) <= depth && std::abs(dj) <= depth && std::abs(dk) <= depth);
          const Vec3 n = normal(at[0], at[1], at[2], other);
          if (dot(n, outward) < 0.5 * std::sqrt(norm2(n) * norm2(outward))) continue;
          const double r2 = 1.0 + di * di + dj * dj + dk * dk;
          fit.add(1.0 / (r2 * r2), distance[other], offset, &velocity[3 * other]);
        }
    if (!near || fit.a[0][0] == 0.0) return {0.0, 0.0, 0.0};
    // the wall is nearer than any node beyond it
    return -std::min(-distance[node], std::sqrt(nearest)) * fit.at_origin();
  }
};

}    // namespace apf

#endif
