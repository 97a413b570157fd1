// Reaction of particles on the fluid, IIHR Report 459, eq (12): the force of each is shared out
// among the nodes around it, here the centres of the cells of a grid, in the proportion of
// trilinear interpolation. Divided by the volume of a cell it is the body force of the
// Navier-Stokes equations.

#ifndef APF_FLOW_FEEDBACK_H
#define APF_FLOW_FEEDBACK_H

#include "cell_grid.h"

#include "contact/vector.h"

namespace LAMMPS_NS {

class FlowFeedback {
 public:
  FlowFeedback(LAMMPS *lmp, Fix *owner, const std::array<int, 3> &cells);

  void set_up() { grid.set_up(1); }
  void begin() { grid.clear(); }
  // force: of the fluid on a particle at x; false if that is out of this rank's reach
  bool add(const double *x, const apf::Vec3 &force);
  void end() { grid.sum_ghosts(); }

  // sum over the grid of this rank's cells: force on the fluid
  apf::Vec3 sum();

  CellGrid grid;    // force on the fluid per volume, in two dimensions per area
};

}    // namespace LAMMPS_NS

#endif
