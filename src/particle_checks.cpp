#include "particle_checks.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "group.h"
#include "modify.h"
#include "named_atoms.h"
#include "neighbor.h"
#include "update.h"

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

void check_cleared(LAMMPS *lmp, const std::string &who, const Fix *fix)
{
  const int included = lmp->neighbor->includegroup;
  if (!included) return;
  const auto *atom = lmp->atom;
  const int bit = lmp->group->bitmask[included];
  int outside = 0;
  for (int i = 0; i < atom->nlocal; i++)
    outside = outside || (atom->mask[i] & fix->groupbit && !(atom->mask[i] & bit));
  MPI_Allreduce(MPI_IN_PLACE, &outside, 1, MPI_INT, MPI_MAX, lmp->world);
  if (outside)
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "{}: the particles of its group {} must be in {}, the group of neigh_modify "
                    "include: LAMMPS clears the forces of no others, which would add up",
                    who, lmp->group->names[fix->igroup], lmp->group->names[included]);
}

void check_finite(LAMMPS *lmp, const std::string &who)
{
  const auto *atom = lmp->atom;
  NamedAtoms lost;
  for (int i = 0; i < atom->nlocal; i++) {
    double nothing = 0.0;    // NAN where a number is not finite
    for (double *const *rows : {atom->x, atom->v, atom->omega})
      nothing += 0.0 * (rows[i][0] + rows[i][1] + rows[i][2]);
    if (nothing != 0.0) lost.add(atom->tag[i], 0.0);
  }
  lost.gather(lmp->world);
  if (lost.number() > 0)
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "{}: position, velocity or spin is no finite number for {} particles (IDs {}) "
                    "at step {}",
                    who, lost.number(), lost.ids(), lmp->update->ntimestep);
}

bool finite_is_due(const LAMMPS *lmp)
{
  constexpr bigint every = 100;
  return lmp->update->setupflag || lmp->update->ntimestep % every == 0;
}

void check_orthogonal(LAMMPS *lmp, const std::string &what, int iarg)
{
  if (lmp->domain->triclinic)
    lmp->error->all(FLERR, iarg, "{} an orthogonal box, not a triclinic one", what);
}

int frozen_groups(LAMMPS *lmp)
{
  int bits = 0;
  for (const auto &fix : lmp->modify->get_fix_by_style("^freeze")) bits |= fix->groupbit;
  return bits;
}

}    // namespace LAMMPS_NS
