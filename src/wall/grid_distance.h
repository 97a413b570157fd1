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

#include "../contact/pack.h"
#include "../flow/lattice.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <vector>

namespace apf {

// Coefficients stand in the order of memory of the lattice, with `margin` layers before the first
// cell and two nodes and a layer behind the last one, along each axis that the lattice has.
class GridDistance {
 public:
  static constexpr double error_constant = 35.0 / 1152.0;
  using PerAxis = std::array<double, 3>;

  GridDistance() = default;
  // coefficients: size(lattice) numbers written by write_coefficients(), kept by the caller
  // jumps: what that returned
  GridDistance(const Lattice &lattice, const double *coefficients, const PerAxis &jumps) :
      c(coefficients), dims(lattice.dims)
  {
    std::ptrdiff_t step = 1;
    for (int axis = 0; axis < dims; axis++) {
      origin[axis] = lattice.origin[axis];
      per_length[axis] = 1.0 / lattice.spacing[axis];
      cells[axis] = lattice.cells(axis);
      per_cells[axis] = lattice.periodic[axis] ? 1.0 / cells[axis] : 0.0;
      widest = std::max(widest, lattice.spacing[axis]);
      steepest[axis] = jumps[axis] * per_length[axis];
      around += mean_way * jumps[axis];
      stride[axis] = step;
      step *= count(lattice, axis);
    }
  }

  static std::size_t size(const Lattice &lattice)
  {
    std::size_t n = 1;
    for (int axis = 0; axis < lattice.dims; axis++) n *= count(lattice, axis);
    return n;
  }

  // nodes: signed distance at the nodes of the lattice                               [length]
  // Returns the largest differences of neighbors along each axis, both of them in the fluid: behind
  // a wall, where a field goes on to its other side, numbers may jump.                 [length]
  static PerAxis write_coefficients(const Lattice &lattice, const std::vector<double> &nodes,
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
    PerAxis jumps{};
    std::size_t step = 1;
    for (int axis = 0; axis < lattice.dims; axis++) {
      for (std::size_t at = 0; at < from.size(); at++) {
        // NOLINTNEXTLINE(clang-analyzer-core.*): there are no more than three axes
        if (at / step % n[axis] + 1 == static_cast<std::size_t>(n[axis])) continue;
        const double a = from[at], b = from[at + step];
        if (a > 0.0 && b > 0.0) jumps[axis] = std::max(jumps[axis], std::fabs(b - a));
      }
      step *= n[axis];
    }
    return jumps;
  }

  // signed distance, > 0 in the fluid; of the nearest point of the grid where x is outside of it
  double distance(const double *x) const
  {
    return with_sums<0>(x, [](const auto &sums) {
      return sums.value();
    });
  }

  // the same, and its slope [3], which is the wall's normal where the field is a distance    [-]
  double distance(const double *x, double *slope) const
  {
    return with_sums<1>(x, [&](const auto &sums) {
      sums.get_slope(slope);
      return sums.value();
    });
  }

  // the same, and the two curvatures of the surface of equal distance through x, the larger one
  // first; > 0 where it bends away from the fluid (around a sphere in it). In the plane the second
  // one is 0.                                                                          [1/length]
  double distance(const double *x, double *slope, double *kappa) const
  {
    return with_sums<2>(x, [&](const auto &sums) {
      double h[3][3];
      sums.get_slope(slope);
      sums.get_bend(h);
      find_curvatures(slope, h, kappa);
      return sums.value();
    });
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
      // NOLINTNEXTLINE(clang-analyzer-core.*): there are no more than three axes
      const int i = index(axis, x[axis], s);
      p += (i + margin + (s > 0.5)) * stride[axis];
    }
    return *p - around;
  }
  // the distance changes by no more than this times the way along each axis, in the fluid      [-]
  const PerAxis &steepness() const { return steepest; }

 private:
  static constexpr int margin = 1;
  // A number of the field is a mean of coefficients, which stand so far from the nearest node on
  // average, at most: 1/48 + 23/48 + 2/48 midway between two                          [spacings]
  static constexpr double mean_way = 26.0 / 48.0;

  const double *c = nullptr;
  int dims = 3;
  double origin[3] = {}, per_length[3] = {};
  double cells[3] = {}, per_cells[3] = {};    // number of cells; 1/cells if periodic, else 0
  std::ptrdiff_t stride[3] = {};
  double widest = 0.0;    // of the spacings                                           [length]
  double around = 0.0;    // largest difference of a number and the nearest coefficient [length]
  PerAxis steepest{};

  // four numbers that are neighbors along x
  struct Row {
    Pair low{}, high{};

    static Row at(const double *p)
    {
      Row row;
      std::memcpy(&row.low, p, sizeof(Pair));
      std::memcpy(&row.high, p + 2, sizeof(Pair));
      return row;
    }
    void add(double weight, const Row &row)
    {
      const Pair w = {weight, weight};
      low += w * row.low;
      high += w * row.high;
    }
    double sum(const double *w) const
    {
      const Pair s = Pair{w[0], w[1]} * low + Pair{w[2], w[3]} * high;
      return s[0] + s[1];
    }
  };

  // The sums over the 4 x 4 x 4 coefficients around a point, for derivatives up to an order. Rows
  // along x are added up with the weights along y and z, once for all derivatives along x.
  template <int order, int dims> class Sums {
   public:
    Sums(const GridDistance &grid, const double *x)
    {
      const double *first = grid.c;
      for (int axis = 0; axis < dims; axis++) {
        double part;
        first += grid.index(axis, x[axis], part) * grid.stride[axis];
        set_weights(part, grid.per_length[axis], w[axis]);
      }
      constexpr int layers = dims == 3 ? 4 : 1;
      for (int z = 0; dims == 2 && z <= order; z++) w[2][z][0] = z == 0;
      Row sum, y, z, yy, yz, zz;    // kept in registers
      for (int k = 0; k < layers; k++) {
        const double *p = first + k * grid.stride[2];
        Row plane, slope, bend;    // of this layer, along y
        for (int j = 0; j < 4; j++) {
          const Row row = Row::at(p + j * grid.stride[1]);
          plane.add(w[1][0][j], row);
          if constexpr (order >= 1) slope.add(w[1][1][j], row);
          if constexpr (order >= 2) bend.add(w[1][2][j], row);
        }
        sum.add(w[2][0][k], plane);
        if constexpr (order >= 1) {
          y.add(w[2][0][k], slope);
          z.add(w[2][1][k], plane);
        }
        if constexpr (order >= 2) {
          yy.add(w[2][0][k], bend);
          yz.add(w[2][1][k], slope);
          zz.add(w[2][2][k], plane);
        }
      }
      rows[0][0] = sum;
      if constexpr (order >= 1) {
        rows[1][0] = y;
        rows[0][1] = z;
      }
      if constexpr (order >= 2) {
        rows[2][0] = yy;
        rows[1][1] = yz;
        rows[0][2] = zz;
      }
    }

    double value() const { return derivative(0, 0, 0); }
    void get_slope(double *slope) const
    {
      slope[0] = derivative(1, 0, 0);
      slope[1] = derivative(0, 1, 0);
      slope[2] = derivative(0, 0, 1);
    }
    void get_bend(double (*h)[3]) const
    {
      for (int a = 0; a < 3; a++)
        for (int b = 0; b <= a; b++)
          h[a][b] = h[b][a] =
              derivative((a == 0) + (b == 0), (a == 1) + (b == 1), (a == 2) + (b == 2));
    }

   private:
    double w[3][order + 1][4];         // of axes, orders, coefficients
    Row rows[order + 1][order + 1];    // by the orders along y and z

    double derivative(int x, int y, int z) const { return rows[y][z].sum(w[0][x]); }

    // t: position in the cell, in [0, 1]. Values add up to 1, slopes and bends to 0.
    static void set_weights(double t, double per_length, double (*w)[4])
    {
      constexpr double sixth = 1.0 / 6.0;
      const double u = 1.0 - t, t2 = t * t, u2 = u * u;
      w[0][0] = sixth * u2 * u;
      w[0][1] = 4.0 * sixth - t2 * (1.0 - 0.5 * t);
      w[0][3] = sixth * t2 * t;
      w[0][2] = (1.0 - w[0][1]) - (w[0][0] + w[0][3]);
      if constexpr (order >= 1) {
        const double half = 0.5 * per_length;
        w[1][0] = -half * u2;
        w[1][3] = half * t2;
        w[1][1] = per_length * t * (1.5 * t - 2.0);
        w[1][2] = -w[1][1] - (w[1][0] + w[1][3]);
      }
      if constexpr (order >= 2) {
        const double q = per_length * per_length;
        w[2][0] = u * q;
        w[2][3] = t * q;
        w[2][1] = w[2][3] - 2.0 * w[2][0];
        w[2][2] = w[2][0] - 2.0 * w[2][3];
      }
    }
  };

  template <int order, class Use> double with_sums(const double *x, const Use &use) const
  {
    return dims == 3 ? use(Sums<order, 3>(*this, x)) : use(Sums<order, 2>(*this, x));
  }

  // of a field with this slope and these second derivatives
  void find_curvatures(const double *slope, const double (*h)[3], double *kappa) const
  {
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

  static int count(const Lattice &lattice, int axis) { return lattice.cells(axis) + 3; }

  int index(int axis, double x, double &part) const
  {
    double s = (x - origin[axis]) * per_length[axis];
    if (per_cells[axis] != 0.0) s -= cells[axis] * std::floor(s * per_cells[axis]);
    s = std::min(std::max(0.0, s), cells[axis]);    // 0 where s is no number: LAMMPS tells it later
    const int i = std::min(static_cast<int>(s), static_cast<int>(cells[axis]) - 1);
    part = s - i;
    return i;
  }

  // Applies the filter along an axis. Beyond a border that is not periodic the nodes go on as a
  // cubic through the last four of them.
  static void filter(const Lattice &lattice, int axis, const int *n,
                     const std::vector<double> &from, std::vector<double> &to)
  {
    const int many = n[axis], wanted = count(lattice, axis);
    std::size_t step = 1, lines = 1;
    // NOLINTNEXTLINE(clang-analyzer-core.*): there are no more than three axes
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
