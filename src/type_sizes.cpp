#include "type_sizes.h"

#include "atom.h"
#include "error.h"
#include "fix.h"
#include "group.h"
#include "modify.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

using namespace LAMMPS_NS;

double TypeSizes::largest_radius() const
{
  return *std::max_element(radius_max.begin(), radius_max.end());
}

// 0 stands for unknown
static double smaller(double a, double b)
{
  return a > 0.0 && b > 0.0 ? std::min(a, b) : std::max(a, b);
}

static double smallest(const std::vector<double> &of_types)
{
  return std::accumulate(of_types.begin(), of_types.end(), 0.0, smaller);
}

double TypeSizes::smallest_radius() const
{
  return smallest(radius_min);
}

double TypeSizes::smallest_mass() const
{
  return smallest(mass_min);
}

// what a fix says of particles of a type that it inserts into the group; 0 if nothing
static double told(Fix *fix, int igroup, const char *name, int type)
{
  if (igroup != 0 && fix->igroup != igroup) return 0.0;
  const auto *value = static_cast<double *>(fix->extract(name, type));
  return value ? *value : 0.0;
}

// Laws divide by each of these.
static void check_sizes(LAMMPS *lmp, const char *who, int i)
{
  const Atom *atom = lmp->atom;
  for (const auto &[name, value] :
       {std::pair{"radii", atom->radius[i]}, {"masses", atom->rmass[i]}}) {
    if (value <= 0.0)
      lmp->error->one(FLERR, Error::NOLASTLINE, "{} needs {} > 0, atom {} has {}", who, name,
                      atom->tag[i], value);
    if (!std::isfinite(value) || !std::isfinite(1.0 / value))
      lmp->error->one(FLERR, Error::NOLASTLINE,
                      "{} needs {} that are finite numbers, as are their reciprocals; atom {} has "
                      "{}",
                      who, name, atom->tag[i], value);
  }
}

TypeSizes TypeSizes::find(LAMMPS *lmp, const char *who, int igroup)
{
  const Atom *atom = lmp->atom;
  const int n = atom->ntypes + 1;
  std::vector<double> mine(3 * n, 0.0), all(3 * n, 0.0);    // radius, 1 / radius, 1 / mass
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & lmp->group->bitmask[igroup])) continue;
    const double r = atom->radius[i];
    check_sizes(lmp, who, i);
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
      // LAMMPS's own fixes tell the largest radius only
      sizes.radius_max[t] = std::max(sizes.radius_max[t], told(fix, igroup, "radius", t));
      sizes.radius_min[t] = smaller(sizes.radius_min[t], told(fix, igroup, "smallest_radius", t));
      sizes.mass_min[t] = smaller(sizes.mass_min[t], told(fix, igroup, "smallest_mass", t));
    }
    if (sizes.radius_min[t] == 0.0) sizes.radius_min[t] = sizes.radius_max[t];
  }
  return sizes;
}
