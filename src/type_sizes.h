// Sizes of the particles of each type, over all ranks: cut-offs, and the checks of overlap and time
// step, depend on the extremes.

#ifndef APF_TYPE_SIZES_H
#define APF_TYPE_SIZES_H

#include <vector>

namespace LAMMPS_NS {
class LAMMPS;

struct TypeSizes {                               // [1..ntypes]; 0 for a type without particles
  std::vector<double> radius_min, radius_max;    // those that fixes are about to insert included
  std::vector<double> mass_min;

  double largest_radius() const;    // of any type

  // Collective. An error where a radius is not > 0; who begins its text.
  static TypeSizes find(LAMMPS *lmp, const char *who);
};

}    // namespace LAMMPS_NS

#endif
