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

void check_diameters(LAMMPS *lmp, const std::string &who)
{
  for (const auto &fix : lmp->modify->get_fix_list())
    if (fix->diam_flag)
      lmp->error->all(FLERR, Error::NOLASTLINE,
                      "{}: fix {} {} changes diameters within a run, which contacts do not see; "
                      "unfix it and change them between runs, as in: set group all diameter D",
                      who, fix->id, fix->style);
}

int frozen_groups(LAMMPS *lmp)
{
  int bits = 0;
  for (const auto &fix : lmp->modify->get_fix_by_style("^freeze")) bits |= fix->groupbit;
  return bits;
}

}    // namespace LAMMPS_NS
