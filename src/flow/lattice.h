// A grid of equal cells, possibly periodic, as the flow uses it: its nodes, and numbers on them.

#ifndef APF_LATTICE_H
#define APF_LATTICE_H

#include <cstddef>
#include <vector>

namespace apf {

struct Lattice {
  int dims = 3;    // 2: the plane z = 0, n[2] = 1
  int n[3];        // nodes; a periodic direction does not repeat its first one at the end
  bool periodic[3] = {};
  double origin[3];     // of the first node                           [length]
  double spacing[3];    //                                             [length]

  std::size_t nodes() const { return std::size_t(n[0]) * n[1] * n[2]; }
  int cells(int axis) const { return axis >= dims || periodic[axis] ? n[axis] : n[axis] - 1; }
  std::size_t stride(int axis) const
  {
    return axis == 0 ? 1 : axis == 1 ? n[0] : std::size_t(n[0]) * n[1];
  }
  // of a node; 0 along an axis that the lattice does not have                         [length]
  void position(int i, int j, int k, double *x) const
  {
    const int index[3] = {i, j, k};
    for (int axis = 0; axis < 3; axis++)
      x[axis] = axis < dims ? origin[axis] + index[axis] * spacing[axis] : 0.0;
  }
  std::size_t node(int i, int j, int k) const { return i + n[0] * (j + std::size_t(n[1]) * k); }

  // i as the index of a node along an axis, -1 beyond the border; |i| within one period
  int wrap(int axis, int i) const
  {
    if (i >= 0 && i < n[axis]) return i;
    if (!periodic[axis]) return -1;
    return ((i % n[axis]) + n[axis]) % n[axis];
  }
};

// Calls f(i, j, k, node) for all nodes, in the order of memory.
template <class F> void for_each_node(const Lattice &grid, F f)
{
  std::size_t node = 0;
  for (int k = 0; k < grid.n[2]; k++)
    for (int j = 0; j < grid.n[1]; j++)
      for (int i = 0; i < grid.n[0]; i++) f(i, j, k, node++);
}

// Slope of f along an axis at node i of that axis, of second order: central differences, one-sided
// ones at borders that are not periodic. f points to the node, whose neighbours along the axis are
// `step` numbers away.
inline double node_slope(const Lattice &grid, int axis, int i, const double *f, std::ptrdiff_t step)
{
  const int n = grid.n[axis];
  const double h = grid.spacing[axis];
  const bool first = i == 0, last = i == n - 1;
  if (!first && !last) return (f[step] - f[-step]) / (2.0 * h);
  if (grid.periodic[axis])
    return (f[last ? -i * step : step] - f[first ? (n - 1) * step : -step]) / (2.0 * h);
  const std::ptrdiff_t inward = first ? step : -step;
  const double sign = first ? 1.0 : -1.0;
  if (n == 2) return sign * (f[inward] - f[0]) / h;
  return sign * (4.0 * (f[inward] - f[0]) - (f[2 * inward] - f[0])) / (2.0 * h);
}

}    // namespace apf

#endif
