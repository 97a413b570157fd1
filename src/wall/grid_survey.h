// Looks at a gridded distance where the centres of particles come when they touch the wall: whether
// it is a distance there, how exact, and whether the wall bends the same way everywhere.

#ifndef APF_GRID_SURVEY_H
#define APF_GRID_SURVEY_H

#include "grid_distance.h"

#include <limits>

namespace apf {

struct GridSurvey {
  long nodes = 0;        // that were looked at
  double error = 0.0;    // largest estimated error of the distance                    [length]
  double error_at[3] = {};
  double error_spacing = 0.0;    // of the axis along which it is                          [length]
  double edge_bend = 0.0;    // the same where its curvature jumps, over spacing^2     [1/length]
  double edge_at[3] = {};
  double edge_spacing = 0.0;
  double slope_error = 0.0;    // largest | |grad| - 1 |                                      [-]
  double slope_at[3] = {};
  double curvature[2] = {};    // mean of the wall's principal curvatures, the larger one first
  double spread[2] = {};       // their standard deviations                            [1/length]
  bool crosses = false;        // none was looked at although the sign changes, see crossing()
  double crosses_at[3] = {};

  // nodes whose distance lies between two values, `at_most` less than the band of the field, and
  // that reached(x) does not leave out; a distance that is no number counts, as infinitely wrong
  template <class Reached>
  static GridSurvey of(const Lattice &lattice, const GridDistance &grid, double at_least,
                       double at_most, const Reached &reached)
  {
    GridSurvey survey;
    double sum[2] = {}, squares[2] = {};
    for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
      double x[3];
      lattice.position(i, j, k, x);
      if (grid.at_least(x) > at_most) return;
      double slope[3], kappa[2];
      const double phi = grid.distance(x, slope, kappa);
      if (phi < at_least || phi > at_most || !reached(x)) return;
      survey.nodes++;
      double h, of_twice;
      const double error = grid.error_at(i, j, k, 1, h);
      const bool is_smooth = grid.error_at(i, j, k, 2, of_twice) > smooth * error;
      if (is_smooth && note(error, x, survey.error, survey.error_at)) survey.error_spacing = h;
      if (!is_smooth && note(error / (h * h), x, survey.edge_bend, survey.edge_at))
        survey.edge_spacing = h;
      const double size =
          std::sqrt(slope[0] * slope[0] + slope[1] * slope[1] + slope[2] * slope[2]);
      note(std::fabs(size - 1.0), x, survey.slope_error, survey.slope_at);
      for (int c = 0; c < 2; c++) {
        const double of_wall = kappa[c] / std::max(1.0 - phi * kappa[c], least_share);
        sum[c] += of_wall;
        squares[c] += of_wall * of_wall;
      }
    });
    if (survey.nodes == 0) return survey;
    for (int c = 0; c < 2; c++) {
      survey.curvature[c] = sum[c] / survey.nodes;
      const double mean2 = survey.curvature[c] * survey.curvature[c];
      survey.spread[c] = std::sqrt(std::max(squares[c] / survey.nodes - mean2, 0.0));
    }
    return survey;
  }

  // Whether the field becomes positive between two nodes where a sphere of that radius could touch
  // such a wall: comes(x) says whether its centre comes there. Holds whatever the field's scale is,
  // also of walls through nodes, up to rounding.
  template <class Comes>
  static bool crossing(const Lattice &lattice, const GridDistance &grid, double radius,
                       const Comes &comes, double *at)
  {
    constexpr double rounding = 1e-6;    // of the next node's distance
    bool found = false;
    for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
      double x[3], slope[3];
      lattice.position(i, j, k, x);
      if (found || !(grid.distance(x, slope) > 0.0)) return;
      for (int side = 0; side < 2 * lattice.dims && !found; side++) {
        const int axis = side / 2, step = side % 2 ? 1 : -1;
        int index[3] = {i, j, k};
        index[axis] = lattice.wrap(axis, index[axis] + step);
        if (index[axis] < 0) continue;
        double y[3], centre[3];
        lattice.position(index[0], index[1], index[2], y);
        if (grid.distance(y) > rounding * grid.distance(x)) continue;
        const double size = std::hypot(slope[0], slope[1], slope[2]);
        const bool has_normal = size > 0.0 && std::isfinite(size);
        for (int c = 0; c < 3; c++)
          centre[c] = x[c] + radius * (has_normal ? slope[c] / size : c == axis ? -step : 0.0);
        found = comes(centre);
      }
      if (found) std::copy(x, x + 3, at);
    });
    return found;
  }

 private:
  static constexpr double smooth = 8.0;    // growth of the error with twice the spacing: between
                                           // 16, of smooth fields, and 4, of jumps in curvature
  static constexpr double least_share = 0.05;    // an edge has no radius of curvature

  // whether it is the largest one so far; what is no number is infinite, or a later one would
  // take its place
  static bool note(double value, const double *x, double &most, double *at)
  {
    if (std::isnan(value)) value = std::numeric_limits<double>::infinity();
    if (!(value > most)) return false;
    most = value;
    std::copy(x, x + 3, at);
    return true;
  }
};

}    // namespace apf

#endif
