// Sub-steps of a wall's contacts, see FixContacts.

#include "fix_wall_levelset.h"

#include "atom.h"
#include "math_extra.h"
#include "neighbor.h"
#include "update.h"

#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void FixWallLevelset::include_walls(apf::VelocityRange &range, double time) const
{
  if (!motion.pose.moves) {
    const double rest[3] = {};
    range.include(rest);
    return;
  }
  const double turning = std::sqrt(norm2(motion.pose.spin));
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const auto v = motion.pose.velocity_at(atom->x[i]);
    const double there[3] = {v.x, v.y, v.z};
    const double far = atom->radius[i] + neighbor->skin + time * MathExtra::len3(there);
    const bool away = rebuild ? distance(atom->x[i]) > far : far_from_all(i, far);
    if (!away) range.include(there, turning * far);
  }
}

void FixWallLevelset::find_fastest(apf::LookAhead &ahead)
{
  if (wet) bridges.find_fastest(ahead);
  if (contacts.size() == 0) return;
  gather();    // contacts may have ended since the last forces
  rows.with_rows([&](const auto *r) {
    contacts.find_fastest(r, update->dt, ahead, [&](int k) {
      return ahead.acceleration[contacts.source[k]];
    });
  });
}

void FixWallLevelset::find_approaching(apf::LookAhead &ahead)
{
  near.clear();
  perhaps.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    const double farthest = ahead.farthest() + ahead.reach * speed_near(x);
    if (far_from_all(i, farthest + atom->radius[i])) continue;
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
      const bool closed = touched[i] >> s & 1;
      if (!closed && farther(s, x, farthest + atom->radius[i])) continue;
      const auto approach = approach_of(i, foot_of(s, x));
      if (!closed && approach.gap > farthest) continue;
      if (closed || approach.gap <= ahead.distance(approach.closing_speed)) {
        ahead.meet(i, approach.relative_speed, speed_of(i, ahead));
        if (!closed) {
          near.push_back({i, s});
          ahead.approach(approach);
        }
      } else {
        perhaps.push_back({i, s, approach.gap});
      }
    }
  }
  if (wet) bridges.find_approaching(ahead);
}

// How a particle moves against the wall's material; where there is no foot, as if straight at it.
apf::Approach FixWallLevelset::approach_of(int i, const apf::Foot &foot)
{
  double v[3], omega[3], x[3], n[3];
  particles().motion(i, v, omega);
  particles().position(i, x);
  if (motion.pose.moves) {
    const auto v_wall = motion.pose.velocity_at(foot.at);
    v[0] -= v_wall.x;
    v[1] -= v_wall.y;
    v[2] -= v_wall.z;
  }
  const double speed = MathExtra::len3(v);
  if (!foot.exists) return {foot.distance - atom->radius[i], speed, speed};
  MathExtra::sub3(foot.at, x, n);
  return {foot.distance - atom->radius[i], MathExtra::dot3(v, n) / MathExtra::len3(n), speed};
}

double FixWallLevelset::speed_of(int i, const apf::LookAhead &ahead)
{
  double speed = 0.0;
  particles().with_rows([&](const auto *r) {
    speed = ahead.speed_of(r, i);
  });
  return speed;
}

double FixWallLevelset::speed_near(const double *x) const
{
  if (!motion.pose.moves) return 0.0;
  const auto v = motion.pose.velocity_at(x);
  return std::sqrt(norm2(v));
}

// A wall is struck, but strikes nothing in turn.
bool FixWallLevelset::find_near(apf::LookAhead &ahead)
{
  size_t left = 0;
  for (const auto &candidate : perhaps) {
    if (ahead.free(candidate.i) ||
        candidate.gap > ahead.distance_if_struck(ahead.after_impacts(), ahead.walls))
      perhaps[left++] = candidate;
    else
      near.push_back({candidate.i, candidate.surface});
  }
  perhaps.resize(left);
  if (wet) bridges.find_near(ahead);
  return false;
}

void FixWallLevelset::sub_step(const apf::ContactTimes &times)
{
  motion.pose.advance(times.advance);
  const int before = contacts.size();
  for (const auto &[i, s] : near) touch(i, s, true);
  if (wet) bridges.sub_detect(times.advance);
  gather();
  const int ended = add_forces(times, before);
  if (wet) {
    const int ruptured = bridges.add_forces(times, due);
    return_loads(bridges.copies(), bridges.atoms());
    if (ruptured) bridges.remove_ruptured(true);
  }
  contacts_change();
  if (ended) remove_ended(true);
}

void FixWallLevelset::pin(apf::Islands &islands) const
{
  for (const int i : contacts.source) islands.pin(i);
  for (const auto &candidate : near) islands.pin(candidate.i);
}

void FixWallLevelset::settle_bridges()
{
  if (wet) bridges.settle();
}

void FixWallLevelset::find_stiffest(apf::Stiffest &stiffest)
{
  contacts.find_stiffest(stiffest, [&](int k) {
    return stiffest.acceleration[contacts.source[k]];
  });
  for (const auto &[i, s] : near) {
    const double *x = atom->x[i];
    const auto bodies = bodies_of(i, s, x);
    const int kind = contacts.kinds.find(s, coefficient.model, bodies);
    stiffest.include_near(contacts.kinds[kind].mode, approach_of(i, foot_of(s, x)),
                          stiffest.acceleration[i]);
  }
  if (wet) bridges.find_stiffest(stiffest);
}
