// Signed distance to a wall from numbers at the nodes of a grid, smooth enough to roll on.
//
// The field is a tensor product of cubic B-splines. Its coefficients follow from the nodes by
//   c_i = (-f_(i-1) + 8 f_i - f_(i+1)) / 6     along each axis,
// the quasi-interpolant that reproduces cubics: planes at any angle come out exactly, curved walls
// with an error of (35/1152) h^4 f'''' at most, and value, slope and curvature are continuous, so
// that nothing that slides along a wall feels the cells. No system of equations is solved: a
// distance depends on the nodes nearby only.
// C. de Boor, G. Fix, J. Approx. Theory 8, 19 (1973), doi:10.1016/0021-9045(73)90029-4

#ifndef APF_GRID_DISTANCE_H
#define APF_GRID_DISTANCE_H

#include "../flow/lattice.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace apf {

// Coefficients stand in the order of memory of the lattice, with `margin` layers before the first
// cell and two nodes and a layer behind the last one, along each axis that the lattice has.
class GridDistance {
 public:
  static constexpr double error_constant = 35.0 / 1152.0;

  GridDistance() = default;
  // coefficients: size(lattice) numbers written by write_coefficients(), kept by the caller
  GridDistance(const Lattice &lattice, const double *coefficients) : c(coefficients)
  {
    dims = lattice.dims;
    std::ptrdiff_t step = 1;
    for (int axis = 0; axis < dims; axis++) {
      origin[axis] = lattice.origin[axis];
      per_length[axis] = 1.0 / lattice.spacing[axis];
      cells[axis] = lattice.cells(axis);
      per_cells[axis] = lattice.periodic[axis] ? 1.0 / cells[axis] : 0.0;
      half_diagonal += 0.25 * lattice.spacing[axis] * lattice.spacing[axis];
      widest = std::max(widest, lattice.spacing[axis]);
      stride[axis] = step;
      step *= count(lattice, axis);
    }
    half_diagonal = std::sqrt(half_diagonal);
  }

  static std::size_t size(const Lattice &lattice)
  {
    std::size_t n = 1;
    for (int axis = 0; axis < lattice.dims; axis++) n *= count(lattice, axis);
    return n;
  }

  // nodes: signed distance at the nodes of the lattice                               [length]
  static void write_coefficients(const Lattice &lattice, const std::vector<double> &nodes,
                                 double *coefficients)
  {
    std::vector<double> from = nodes, to;
    int n[3] = {lattice.n[0], lattice.n[1], lattice.n[2]};
    for (int axis = 0; axis < lattice.dims; axis++) {
      filter(lattice, axis, n, from, to);
      n[axis] = count(lattice, axis);
      from.swap(to);
    }
    std::copy(from.begin(), from.end(), coefficients);
  }

  // signed distance, > 0 in the fluid; of the nearest point of the grid where x is outside of it
  double distance(const double *x) const
  {
    Cell cell;
    find(x, cell);
    for (int axis = 0; axis < dims; axis++) value_weights(cell.part[axis], cell.w[axis]);
    return dims == 3 ? sum3(cell, cell.w[0], cell.w[1], cell.w[2])
                     : sum2(cell, cell.w[0], cell.w[1]);
  }

  // the same, and its slope [3], which is the wall's normal where the field is a distance    [-]
  double distance(const double *x, double *slope) const
  {
    Cell cell;
    double d[3][4];
    find(x, cell);
    for (int axis = 0; axis < dims; axis++) {
      value_weights(cell.part[axis], cell.w[axis]);
      slope_weights(cell.part[axis], per_length[axis], d[axis]);
    }
    if (dims == 2) {
      slope[0] = sum2(cell, d[0], cell.w[1]);
      slope[1] = sum2(cell, cell.w[0], d[1]);
      slope[2] = 0.0;
      return sum2(cell, cell.w[0], cell.w[1]);
    }
    // rows along x are summed once for all four sums
    double value = 0.0;
    slope[0] = slope[1] = slope[2] = 0.0;
    for (int k = 0; k < 4; k++) {
      double row[2] = {}, row_dx = 0.0;    // summed with the weights of y and with their slopes
      for (int j = 0; j < 4; j++) {
        const double *p = cell.first + k * stride[2] + j * stride[1];
        double sum = 0.0, sum_dx = 0.0;
        for (int i = 0; i < 4; i++) {
          sum += cell.w[0][i] * p[i];
          sum_dx += d[0][i] * p[i];
        }
        row[0] += cell.w[1][j] * sum;
        row[1] += d[1][j] * sum;
        row_dx += cell.w[1][j] * sum_dx;
      }
      value += cell.w[2][k] * row[0];
      slope[0] += cell.w[2][k] * row_dx;
      slope[1] += cell.w[2][k] * row[1];
      slope[2] += d[2][k] * row[0];
    }
    return value;
  }

  // Curvatures of the surface of equal distance through x, the larger one first; > 0 where it bends
  // away from the fluid (around a sphere in it). In the plane the second one is 0.     [1/length]
  void curvatures(const double *x, double *kappa) const
  {
    double slope[3], h[3][3] = {};
    distance(x, slope);
    Cell cell;
    double d[3][4], dd[3][4];
    find(x, cell);
    for (int axis = 0; axis < dims; axis++) {
      value_weights(cell.part[axis], cell.w[axis]);
      slope_weights(cell.part[axis], per_length[axis], d[axis]);
      second_weights(cell.part[axis], per_length[axis], dd[axis]);
    }
    for (int a = 0; a < dims; a++)
      for (int b = 0; b <= a; b++) {
        const double *w[3];
        for (int axis = 0; axis < dims; axis++) {
          const int order = (axis == a) + (axis == b);
          w[axis] = order == 2 ? dd[axis] : order == 1 ? d[axis] : cell.w[axis];
        }
        h[a][b] = h[b][a] = dims == 3 ? sum3(cell, w[0], w[1], w[2]) : sum2(cell, w[0], w[1]);
      }
    const double size2 = slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2];
    kappa[0] = kappa[1] = 0.0;
    if (size2 == 0.0) return;
    // trace and squared size of the part of h across the normal, which has two eigenvalues
    double trace = 0.0, across = 0.0, bend[3] = {}, along = 0.0;
    for (int a = 0; a < 3; a++) {
      trace += h[a][a];
      for (int b = 0; b < 3; b++) {
        across += h[a][b] * h[a][b];
        bend[a] += h[a][b] * slope[b];
      }
    }
    for (int a = 0; a < 3; a++) along += bend[a] * slope[a] / size2;
    for (double b : bend) across -= 2.0 * b * b / size2;
    across += along * along;
    trace -= along;
    const double per_size = 1.0 / std::sqrt(size2);
    if (dims == 2) {
      kappa[0] = trace * per_size;
      return;
    }
    const double spread = std::sqrt(std::max(2.0 * across - trace * trace, 0.0));
    kappa[0] = 0.5 * (trace + (trace < 0.0 ? -spread : spread)) * per_size;
    kappa[1] = 0.5 * (trace - (trace < 0.0 ? -spread : spread)) * per_size;
  }

  // What the nodes around a node say about the error of the distance there, if they stood `apart`
  // spacings: error_constant times the fourth differences along the axes, which are of fourth order
  // in the spacing where the field is smooth, and of second order where curvature jumps, as at the
  // rim of an edge. Borders that are not periodic are left out. spacing: of the axis that has the
  // largest part in it.                                                                  [length]
  double error_at(int i, int j, int k, int apart, double &spacing) const
  {
    const int at[3] = {i, j, k};
    const double *p = c;
    for (int axis = 0; axis < dims; axis++) p += (at[axis] + margin) * stride[axis];
    double sum = 0.0, most = 0.0;
    spacing = widest;
    for (int axis = 0; axis < dims; axis++) {
      const std::ptrdiff_t s = apart * stride[axis];
      const int beyond = 2 * apart - margin;
      if (at[axis] < beyond || at[axis] > cells[axis] - beyond) continue;
      const double part = std::fabs(p[-2 * s] + p[2 * s] - 4.0 * (p[-s] + p[s]) + 6.0 * p[0]);
      sum += part;
      if (part <= most) continue;
      most = part;
      spacing = 1.0 / per_length[axis];
    }
    return error_constant * sum;
  }

  // a bound that costs one number: the distance is larger                            [length]
  double at_least(const double *x) const
  {
    const double *p = c;
    for (int axis = 0; axis < dims; axis++) {
      double s;
      const int i = index(axis, x[axis], s);
      p += (i + margin + (s > 0.5)) * stride[axis];
    }
    return *p - half_diagonal - slack * widest;
  }

 private:
  static constexpr int margin = 1;
  static constexpr double slack = 0.5;    // coefficients differ from distances, at kinks by h/3

  const double *c = nullptr;
  int dims = 3;
  double origin[3] = {}, per_length[3] = {};
  double cells[3] = {}, per_cells[3] = {};    // number of cells; 1/cells if periodic, else 0
  std::ptrdiff_t stride[3] = {};
  double half_diagonal = 0.0, widest = 0.0;    // of a cell, of the spacings             [length]

  struct Cell {
    const double *first;    // of 4 x 4 x 4 coefficients
    double part[3];         // position in the cell, in [0, 1]
    double w[3][4];
  };

  static int count(const Lattice &lattice, int axis) { return lattice.cells(axis) + 3; }

  int index(int axis, double x, double &part) const
  {
    double s = (x - origin[axis]) * per_length[axis];
    s -= cells[axis] * std::floor(s * per_cells[axis]);
    s = std::min(std::max(s, 0.0), cells[axis]);
    const int i = std::min(static_cast<int>(s), static_cast<int>(cells[axis]) - 1);
    part = s - i;
    return i;
  }
  void find(const double *x, Cell &cell) const
  {
    cell.first = c;
    for (int axis = 0; axis < dims; axis++)
      cell.first += index(axis, x[axis], cell.part[axis]) * stride[axis];
  }

  static void value_weights(double t, double *w)
  {
    const double u = 1.0 - t, t2 = t * t, u2 = u * u;
    w[0] = u2 * u / 6.0;
    w[1] = (4.0 - 3.0 * t2 * (2.0 - t)) / 6.0;
    w[2] = (4.0 - 3.0 * u2 * (2.0 - u)) / 6.0;
    w[3] = t2 * t / 6.0;
  }
  static void slope_weights(double t, double per_length, double *w)
  {
    const double u = 1.0 - t;
    w[0] = -0.5 * u * u * per_length;
    w[1] = -0.5 * t * (4.0 - 3.0 * t) * per_length;
    w[2] = 0.5 * u * (4.0 - 3.0 * u) * per_length;
    w[3] = 0.5 * t * t * per_length;
  }
  static void second_weights(double t, double per_length, double *w)
  {
    const double q = per_length * per_length;
    w[0] = (1.0 - t) * q;
    w[1] = (3.0 * t - 2.0) * q;
    w[2] = (1.0 - 3.0 * t) * q;
    w[3] = t * q;
  }

  double sum2(const Cell &cell, const double *wx, const double *wy) const
  {
    double sum = 0.0;
    for (int j = 0; j < 4; j++) {
      const double *p = cell.first + j * stride[1];
      sum += wy[j] * (wx[0] * p[0] + wx[1] * p[1] + wx[2] * p[2] + wx[3] * p[3]);
    }
    return sum;
  }
  double sum3(const Cell &cell, const double *wx, const double *wy, const double *wz) const
  {
    double sum = 0.0;
    for (int k = 0; k < 4; k++) {
      double plane = 0.0;
      for (int j = 0; j < 4; j++) {
        const double *p = cell.first + k * stride[2] + j * stride[1];
        plane += wy[j] * (wx[0] * p[0] + wx[1] * p[1] + wx[2] * p[2] + wx[3] * p[3]);
      }
      sum += wz[k] * plane;
    }
    return sum;
  }

  // Applies the filter along an axis. Beyond a border that is not periodic the nodes go on as a
  // cubic through the last four of them.
  static void filter(const Lattice &lattice, int axis, const int *n,
                     const std::vector<double> &from, std::vector<double> &to)
  {
    const int many = n[axis], wanted = count(lattice, axis);
    std::size_t step = 1, lines = 1;
    for (int a = 0; a < lattice.dims; a++) (a < axis ? step : lines) *= a == axis ? 1 : n[a];
    to.resize(step * lines * wanted);
    std::vector<double> f(wanted + 2);    // node i stands at i + 2
    for (std::size_t line = 0; line < lines; line++)
      for (std::size_t s = 0; s < step; s++) {
        const double *in = &from[line * many * step + s];
        double *out = &to[line * wanted * step + s];
        for (int i = -2; i < wanted; i++) f[i + 2] = node_value(lattice, axis, many, in, step, i);
        for (int i = 0; i < wanted; i++) out[i * step] = (8.0 * f[i + 1] - f[i] - f[i + 2]) / 6.0;
      }
  }
  static double node_value(const Lattice &lattice, int axis, int many, const double *f,
                           std::size_t step, int i)
  {
    const int at = lattice.wrap(axis, i);
    if (at >= 0) return f[at * step];
    const int out = i < 0 ? -i : i - (many - 1);    // layers beyond the border
    const auto inner = [&](int k) {
      return f[(i < 0 ? k : many - 1 - k) * step];
    };
    if (many < 4) return inner(0) + out * (inner(0) - inner(1));
    // Newton's form of the cubic at -out
    const double d1 = inner(1) - inner(0), d2 = inner(2) - 2.0 * inner(1) + inner(0);
    const double d3 = inner(3) - 3.0 * inner(2) + 3.0 * inner(1) - inner(0);
    const double x = -out;
    return inner(0) + x * d1 + x * (x - 1.0) / 2.0 * d2 + x * (x - 1.0) * (x - 2.0) / 6.0 * d3;
  }
};

}    // namespace apf

#endif
