#include "particle_checks.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

namespace LAMMPS_NS {

void check_spheres(LAMMPS *lmp, const std::string &who, int iarg)
{
  auto *atom = lmp->atom;
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    lmp->error->all(FLERR, iarg,
                    "{} needs atom style sphere: radius, mass, omega and torque per atom; atom "
                    "style {} has not all of them",
                    who, atom->get_style());
}

int frozen_groups(LAMMPS *lmp)
{
  int bits = 0;
  for (const auto &fix : lmp->modify->get_fix_by_style("^freeze")) bits |= fix->groupbit;
  return bits;
}

}    // namespace LAMMPS_NS
