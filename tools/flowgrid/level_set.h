// The distances to a wall on a grid: exact near it, by fast marching farther out, to the end of the
// band; of the whole wall, and of its pieces in as few arrays as may be.

#ifndef FLOWGRID_LEVEL_SET_H
#define FLOWGRID_LEVEL_SET_H

#include "periods.h"
#include "wall.h"

#include "../../src/wall/fast_marching.h"

namespace flowgrid {

struct DistanceArray {
  std::string name;
  std::vector<int> pieces;       // of the wall
  double surface_error = 0.0;    // [length]
  std::vector<double> values;    // of the nodes                                     [length]
};

class LevelSet {
 public:
  static constexpr int most_arrays = 32;

  // exact: distances up to this one are the wall's own                                [length]
  // band: farther ones are cut off                                                    [length]
  // Throws std::runtime_error if the pieces do not make up the wall, or are too many.
  LevelSet(const Wall &wall, const Grid &grid, const Periods &periods, double exact, double band);

  const std::vector<double> &whole() const { return all; }
  const std::vector<DistanceArray> &arrays() const { return list; }
  size_t exact_nodes() const { return seeded; }

 private:
  std::vector<double> all;
  std::vector<DistanceArray> list;
  size_t seeded = 0;

  void share_arrays(const Wall &wall, double band);
};

inline apf::Lattice lattice_of(const Grid &grid)
{
  apf::Lattice lattice;
  lattice.dims = grid.n[2] == 1 ? 2 : 3;
  for (int c = 0; c < 3; c++) {
    lattice.n[c] = grid.n[c];
    lattice.origin[c] = grid.origin[c];
    lattice.spacing[c] = grid.spacing[c];
  }
  return lattice;
}

}    // namespace flowgrid

#endif
