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

  // of any type; 0 if there are no particles, or nothing is known of their masses
  double largest_radius() const;
  double smallest_radius() const;
  double smallest_mass() const;

  // Of the particles of a group and those that fixes insert into it; 0: all. Collective. An error
  // where a radius or mass is not > 0 and finite, or its reciprocal is not; who begins its text.
  static TypeSizes find(LAMMPS *lmp, const char *who, int igroup = 0);
};

}    // namespace LAMMPS_NS

#endif
