// Directions along which walls repeat themselves with the length of the grid.

#ifndef FLOWGRID_PERIODS_H
#define FLOWGRID_PERIODS_H

#include "mapping.h"
#include "vector.h"

#include <array>

namespace flowgrid {

class Periods {
 public:
  Periods(const std::array<bool, 3> &along, const Grid &grid) : repeats(along)
  {
    for (int c = 0; c < 3; c++) length[c] = (grid.n[c] - 1) * grid.spacing[c];
  }

  bool along(int axis) const { return repeats[axis]; }
  // whether a vector has a component along one of them
  bool crossed_by(const Point &x) const
  {
    for (int c = 0; c < 3; c++)
      if (repeats[c] && x[c] != 0.0) return true;
    return false;
  }

  // from something in the grid to itself and to its next copies on all sides
  std::vector<Point> shifts() const
  {
    std::vector<Point> all{Point{}};
    for (int c = 0; c < 3; c++) {
      if (!repeats[c]) continue;
      const size_t count = all.size();
      for (const double sign : {-1.0, 1.0})
        for (size_t k = 0; k < count; k++) {
          all.push_back(all[k]);
          all.back()[c] += sign * length[c];
        }
    }
    return all;
  }

  // the grid and as much beyond its periodic borders as a distance reaches
  Grid widened(const Grid &grid, double by) const
  {
    Grid wide = grid;
    for (int c = 0; c < 3; c++) {
      if (!repeats[c]) continue;
      const int cells = static_cast<int>(std::ceil(by / grid.spacing[c])) + 1;
      wide.n[c] += 2 * cells;
      wide.origin[c] -= cells * grid.spacing[c];
    }
    return wide;
  }

 private:
  std::array<bool, 3> repeats;
  Point length;
};

}    // namespace flowgrid

#endif
