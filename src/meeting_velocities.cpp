#include "meeting_velocities.h"

#include "atom.h"
#include "domain.h"
#include "fix_contacts.h"
#include "fmt/format.h"

#include <algorithm>
#include <cmath>

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

std::string MeetingVelocities::cure(double spread, double acceleration, double skin, double enough)
{
  const double way = 0.4 * skin;    // of the step to advise
  const std::string other = fmt::format("neighbor {:.2g} bin or larger", enough);
  if (way <= 0.0) return "use " + other;
  return fmt::format("use timestep {:.2g} or smaller, or {}",
                     2.0 * way / (spread + std::sqrt(spread * spread + 4.0 * acceleration * way)),
                     other);
}

double MeetingVelocities::fastest(const double *in) const
{
  auto all = bodies;
  all.include(images);
  return all.farthest_from(in);
}
