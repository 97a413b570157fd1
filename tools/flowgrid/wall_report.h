// How good the distances of a grid are for fix wall/levelset, which interpolates them by cubic
// B-splines.

#ifndef FLOWGRID_WALL_REPORT_H
#define FLOWGRID_WALL_REPORT_H

#include "level_set.h"

namespace flowgrid {

struct WallQuality {
  // | |slope| - 1 | of the interpolated distance in the band, in the fluid               [-]
  double slope_max = 0.0, slope_rms = 0.0;
  // Largest error of the distance at random points between nodes, as far from the wall as centers
  // of particles that touch it are                                                  [length]
  double error = 0.0;
  Point error_at{};
  int points = 0;
};

// low, high: range of distances at which the error is measured, within those that are exact
WallQuality wall_quality(const Wall &wall, const Grid &grid, const LevelSet &levels,
                         const DistanceArray &array, double low, double high, double band);

// Where walls face each other at less than a particle's diameter, across the fluid or a solid
struct Narrows {
  double gap = INFINITY,
         solid = INFINITY;    // the narrowest one; infinite if there is none [length]
  Point gap_at{}, solid_at{};
};
Narrows find_narrows(const Grid &grid, const std::vector<double> &distance, double diameter);

}    // namespace flowgrid

#endif
