// What styles demand of the particles in a scene, and of its box.

#ifndef APF_PARTICLE_CHECKS_H
#define APF_PARTICLE_CHECKS_H

#include <string>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;

// An error where particles are not spheres that turn.
//   who    begins the message, as in "Fix wall/levelset"
//   iarg   argument to point at, or Error::NOLASTLINE outside of the command
void check_spheres(LAMMPS *lmp, const std::string &who, int iarg);

// An error where a fix changes diameters within a run: who may touch, and by which law, is found
// when lists are made.
void check_diameters(LAMMPS *lmp, const std::string &who);

// An error where LAMMPS clears the forces of some particles only, which neigh_modify include tells,
// and the fix adds to those of others. Collective.
void check_cleared(LAMMPS *lmp, const std::string &who, const Fix *fix);

// An error where a place, a velocity or a spin is no finite number, with the IDs. Comparisons pass
// over such numbers, and no neighbor list is built for them. Collective.
void check_finite(LAMMPS *lmp, const std::string &who);
// ... when it is time to: where a run begins and in every 100th step, so that it costs nothing
bool finite_is_due(const LAMMPS *lmp);

// An error in a triclinic box.
//   what   begins the message, which goes on with " an orthogonal"
void check_orthogonal(LAMMPS *lmp, const std::string &what, int iarg);

// Bits of the groups that fix freeze holds: forces do not move their particles.
int frozen_groups(LAMMPS *lmp);
// ... whose mass counts that many times where a bridge is solved for the speed that it leaves. More
// would be lost in rounding: the viscous momentum is mass times a difference of gaps.
constexpr double immovable = 1.0e7;

}    // namespace LAMMPS_NS

#endif
