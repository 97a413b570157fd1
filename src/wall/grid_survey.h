// Looks at a gridded distance where the centres of particles come when they touch the wall: whether
// it is a distance there, how exact, and whether the wall bends the same way everywhere.

#ifndef APF_GRID_SURVEY_H
#define APF_GRID_SURVEY_H

#include "grid_distance.h"

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

  // nodes whose distance lies between two values, `at_most` less than the band of the field, and
  // that reached(x) does not leave out
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

 private:
  static constexpr double smooth = 8.0;    // growth of the error with twice the spacing: between
                                           // 16, of smooth fields, and 4, of jumps in curvature
  static constexpr double least_share = 0.05;    // an edge has no radius of curvature

  // whether it is the largest one so far
  static bool note(double value, const double *x, double &most, double *at)
  {
    if (value <= most) return false;
    most = value;
    std::copy(x, x + 3, at);
    return true;
  }
};

}    // namespace apf

#endif
