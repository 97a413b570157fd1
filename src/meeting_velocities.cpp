#include "meeting_velocities.h"

#include "atom.h"
#include "domain.h"
#include "fix_contacts.h"

#include <algorithm>

using namespace LAMMPS_NS;

void MeetingVelocities::include_others(const Atom *atom, const Domain *domain,
                                       const apf::Bodies &rows,
                                       const std::vector<FixContacts *> &keepers, double time)
{
  if (domain->deform_vremap)
    for (int i = atom->nlocal; i < atom->nlocal + atom->nghost; i++) {
      double v[3], omega[3];
      rows.motion(i, v, omega);
      images.include(v);
    }
  for (const auto *keeper : keepers) keeper->include_walls(walls, time);
}

void MeetingVelocities::pack(double *buf) const
{
  for (const auto *range : {&bodies, &images, &walls}) buf = std::copy_n(range->most, 6, buf);
}

void MeetingVelocities::unpack(const double *buf)
{
  for (auto *range : {&bodies, &images, &walls}) {
    std::copy_n(buf, 6, range->most);
    buf += 6;
  }
}

double MeetingVelocities::spread() const
{
  auto all = bodies;
  all.include(walls);
  return all.spread(images);
}

double MeetingVelocities::fastest(const double *in) const
{
  auto all = bodies;
  all.include(images);
  return all.farthest_from(in);
}
