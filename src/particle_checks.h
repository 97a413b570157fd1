// What styles demand of the particles in a scene.

#ifndef APF_PARTICLE_CHECKS_H
#define APF_PARTICLE_CHECKS_H

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

// An error where particles are not spheres that turn.
//   who    begins the message, as in "Fix wall/levelset"
//   iarg   argument to point at, or Error::NOLASTLINE outside of the command
void check_spheres(LAMMPS *lmp, const std::string &who, int iarg);

}    // namespace LAMMPS_NS

#endif
