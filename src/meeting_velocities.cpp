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
  for (const auto *keeper : keepers) moving_walls |= keeper->include_walls(bodies, time);
}

void MeetingVelocities::pack(double *buf) const
{
  buf = std::copy_n(bodies.most, 6, buf);
  buf = std::copy_n(images.most, 6, buf);
  *buf = moving_walls;
}

void MeetingVelocities::unpack(const double *buf)
{
  std::copy_n(buf, 6, bodies.most);
  std::copy_n(buf + 6, 6, images.most);
  moving_walls = buf[12] > 0.0;
}
