#include "type_sizes.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

#include <algorithm>

using namespace LAMMPS_NS;

double TypeSizes::largest_radius() const
{
  return *std::max_element(radius_max.begin(), radius_max.end());
}

// what fix inlet/flow says of particles to come; LAMMPS's own fixes tell the largest radius only
static void include_smallest(LAMMPS *lmp, int type, const char *name, double &smallest)
{
  for (const auto &fix : lmp->modify->get_fix_list()) {
    int of_type = type;
    const auto *inserted = static_cast<double *>(fix->extract(name, of_type));
    if (inserted) smallest = smallest > 0.0 ? std::min(smallest, *inserted) : *inserted;
  }
}

TypeSizes TypeSizes::find(LAMMPS *lmp, const char *who)
{
  const Atom *atom = lmp->atom;
  const int n = atom->ntypes + 1;
  std::vector<double> mine(3 * n, 0.0), all(3 * n, 0.0);    // radius, 1 / radius, 1 / mass
  for (int i = 0; i < atom->nlocal; i++) {
    const double r = atom->radius[i];
    if (r <= 0.0)
      lmp->error->one(FLERR, Error::NOLASTLINE, "{} needs radii > 0, atom {} has {}", who,
                      atom->tag[i], r);
    double *largest = &mine[3 * atom->type[i]];
    largest[0] = std::max(largest[0], r);
    largest[1] = std::max(largest[1], 1.0 / r);
    largest[2] = std::max(largest[2], 1.0 / atom->rmass[i]);
  }
  MPI_Allreduce(mine.data(), all.data(), 3 * n, MPI_DOUBLE, MPI_MAX, lmp->world);

  TypeSizes sizes{std::vector<double>(n), std::vector<double>(n), std::vector<double>(n)};
  for (int t = 1; t < n; t++) {
    const double *largest = &all[3 * t];
    sizes.radius_max[t] = largest[0];
    sizes.radius_min[t] = largest[1] > 0.0 ? 1.0 / largest[1] : 0.0;
    sizes.mass_min[t] = largest[2] > 0.0 ? 1.0 / largest[2] : 0.0;
    for (const auto &fix : lmp->modify->get_fix_list()) {
      int type = t;
      const auto *inserted = static_cast<double *>(fix->extract("radius", type));
      if (inserted) sizes.radius_max[t] = std::max(sizes.radius_max[t], *inserted);
    }
    include_smallest(lmp, t, "smallest_radius", sizes.radius_min[t]);
    include_smallest(lmp, t, "smallest_mass", sizes.mass_min[t]);
    if (sizes.radius_min[t] == 0.0) sizes.radius_min[t] = sizes.radius_max[t];
  }
  return sizes;
}
