// Clouds of particles on a grid as a direct sum: each is added to all cells that it reaches. What
// would fall on cells outside the fluid comes back to those inside.

#ifndef LMP_CLOUD_SUM_H
#define LMP_CLOUD_SUM_H

#include "cell_grid.h"

#include "flow/gaussian_cloud.h"

namespace LAMMPS_NS {

class CloudSum {
 public:
  // fluid: 1 in cells that clouds may lie in, else 0, with ghosts as far as clouds reach; which: as
  // for CellGrid. Collective.
  CloudSum(LAMMPS *, Fix *owner, const CellGrid &fluid, double radius, bool walled, int which);

  void begin() { grid.clear(); }
  // false if the particle is too far from this rank's part of the box
  bool add(const double *x, double amount);
  void end() { grid.sum_ghosts(); }

  static int reach(const CellGrid &, double radius);    // of clouds beyond a particle's cell
  static double cost(const CellGrid &, double radius, double particles, bool walled);    // ns

  CellGrid grid;    // after end() the sum, in cells of this rank

 private:
  const CellGrid &fluid;
  double radius;
  bool walled;
  apf::CloudWeights weights[3];
};

}    // namespace LAMMPS_NS

#endif
