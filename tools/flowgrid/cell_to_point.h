// Values of cells, as CFD codes of finite volumes have them, to values at points: the value at a
// point of the linear function that fits the cells around it by least squares, exact for linear
// fields. Where these cells lie in a plane or line, as at boundaries, their neighbours are taken
// in; a direction in which there is only one cell has no slope.

#ifndef FLOWGRID_CELL_TO_POINT_H
#define FLOWGRID_CELL_TO_POINT_H

#include "mesh.h"
#include "progress.h"

#include <cmath>

namespace flowgrid {

// Lists of whole numbers one after another
struct Lists {
  std::vector<int> first{0}, items;

  int count() const { return static_cast<int>(first.size()) - 1; }
  const int *begin(int list) const { return items.data() + first[list]; }
  const int *end(int list) const { return items.data() + first[list + 1]; }
  void close() { first.push_back(static_cast<int>(items.size())); }

  // which lists an item is in
  Lists inverse(int count_items) const
  {
    Lists result;
    result.first.assign(count_items + 1, 0);
    result.items.resize(items.size());
    for (const int item : items) result.first[item + 1]++;
    for (int k = 0; k < count_items; k++) result.first[k + 1] += result.first[k];
    std::vector<int> at(result.first.begin(), result.first.end() - 1);
    for (int list = 0; list < count(); list++)
      for (const int *k = begin(list); k != end(list); ++k) result.items[at[*k]++] = list;
    return result;
  }
};

// Eigenvalues and -vectors (columns) of a symmetric matrix, by Jacobi's rotations
inline void eigen_system(double (&a)[3][3], double (&v)[3][3])
{
  for (int i = 0; i < 3; i++)
    for (int j = 0; j < 3; j++) v[i][j] = i == j;
  for (int sweep = 0; sweep < 30; sweep++)
    for (int p = 0; p < 2; p++)
      for (int q = p + 1; q < 3; q++) {
        if (std::fabs(a[p][q]) <= 1e-17 * (std::fabs(a[p][p]) + std::fabs(a[q][q]))) continue;
        const double angle = 0.5 * std::atan2(2.0 * a[p][q], a[q][q] - a[p][p]);
        const double c = std::cos(angle), s = std::sin(angle);
        for (int k = 0; k < 3; k++) {
          const double kp = a[k][p], kq = a[k][q], vp = v[k][p], vq = v[k][q];
          a[k][p] = c * kp - s * kq, a[k][q] = s * kp + c * kq;
          v[k][p] = c * vp - s * vq, v[k][q] = s * vp + c * vq;
        }
        for (int k = 0; k < 3; k++) {
          const double pk = a[p][k], qk = a[q][k];
          a[p][k] = c * pk - s * qk, a[q][k] = s * pk + c * qk;
        }
      }
}

class CellToPoint {
 public:
  CellToPoint() = default;
  CellToPoint(const std::vector<Point> &points, const Lists &cell_points,
              const std::vector<Point> &centres)
  {
    const Lists around = cell_points.inverse(static_cast<int>(points.size()));
    std::vector<int> near, wide;
    for (int p = 0; p < around.count(); p++) {
      if (p % 1024 == 0) show_progress("fitting", 1.0 * p / around.count());
      near.assign(around.begin(p), around.end(p));
      Fit fit(near, centres, flat);
      if (fit.rank < 3 || fit.gain(points[p], near, centres) > most_gain) {
        wide.clear();
        for (const int cell : near)
          for (const int *q = cell_points.begin(cell); q != cell_points.end(cell); ++q)
            wide.insert(wide.end(), around.begin(*q), around.end(*q));
        std::sort(wide.begin(), wide.end());
        wide.erase(std::unique(wide.begin(), wide.end()), wide.end());
        const Fit wider(wide, centres, flat);
        if (wider.gain(points[p], wide, centres) <= most_gain &&
            (wider.rank > fit.rank || fit.gain(points[p], near, centres) > most_gain))
          fit = wider, near = wide;
      }
      // a slope that the cells do not tell is none
      double cut = 1e-5;
      while (fit.gain(points[p], near, centres) > most_gain) {
        cut *= 10.0;
        fit = Fit(near, centres, cut);
      }
      for (const int cell : near) {
        cells.items.push_back(cell);
        weight.push_back(fit.weight(points[p], centres[cell]));
      }
      cells.close();
    }
    show_progress("fitting", 1.0);
  }

  std::vector<double> apply(const std::vector<double> &values, int components) const
  {
    std::vector<double> result(std::size_t(cells.count()) * components, 0.0);
    for (int p = 0; p < cells.count(); p++)
      for (int k = cells.first[p]; k < cells.first[p + 1]; k++)
        for (int c = 0; c < components; c++)
          result[std::size_t(p) * components + c] +=
              weight[k] * values[std::size_t(cells.items[k]) * components + c];
    return result;
  }

 private:
  // cells as flat as 1:10000 are resolved; rounding of single precision is not
  static constexpr double flat = 1e-9;
  static constexpr double most_gain = 6.0;    // 3 where a corner of a cube is extrapolated to

  Lists cells;    // of each point
  std::vector<double> weight;

  // Least squares: f(x) = mean f + (x - mean x) . C^+ sum_c (x_c - mean x) f_c, C the matrix of
  // second moments, C^+ its inverse in the directions in which the centres differ
  struct Fit {
    Point mean{};
    double inverse[3][3] = {};
    int rank = 0;
    double share;

    // moments less than `cut` of the largest count as 0
    Fit(const std::vector<int> &list, const std::vector<Point> &centres, double cut) :
        share(1.0 / list.size())
    {
      for (const int cell : list)
        for (int i = 0; i < 3; i++) mean[i] += share * centres[cell][i];
      double moments[3][3] = {}, axes[3][3];
      for (const int cell : list)
        for (int i = 0; i < 3; i++)
          for (int j = 0; j < 3; j++)
            moments[i][j] += (centres[cell][i] - mean[i]) * (centres[cell][j] - mean[j]);
      eigen_system(moments, axes);
      const double largest = std::max({moments[0][0], moments[1][1], moments[2][2]});
      for (int e = 0; e < 3; e++) {
        if (!(moments[e][e] > cut * largest)) continue;
        rank++;
        for (int i = 0; i < 3; i++)
          for (int j = 0; j < 3; j++) inverse[i][j] += axes[i][e] * axes[j][e] / moments[e][e];
      }
    }
    // by how much errors of the values may grow: the sum of magnitudes of the weights
    double gain(const Point &x, const std::vector<int> &list,
                const std::vector<Point> &centres) const
    {
      double sum = 0.0;
      for (const int cell : list) sum += std::fabs(weight(x, centres[cell]));
      return sum;
    }
    double weight(const Point &x, const Point &centre) const
    {
      double sum = share;
      for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) sum += (x[i] - mean[i]) * inverse[i][j] * (centre[j] - mean[j]);
      return sum;
    }
  };
};

}    // namespace flowgrid

#endif
