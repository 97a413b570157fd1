// The force of an adhesive contact jumps when bodies first touch, from 0 to -8/9 F_C, and when
// their neck ends, from -5/9 F_C to 0 (damping jumps along). Leapfrog steps see that up to a step
// late; with nothing done about it a collision gains or loses (force jump) x (distance of half a
// step) by chance, an error of first order in the step and the largest of all in the sticking
// velocity. When the jump came is known from the overlap and the speed, so the kick of the step in
// which it is seen gets the impulse that is missing, or gives back what was too much.
//
//   touch, a time t ago:   force x (t + step/2) is due, force x step is given
//   end,   a time t ago:   force x (step/2 - t) is due, nothing is given
//
// Half of the kick may belong to the next run; who looks at the contacts again finds no trace of
// it, so it is noted.

#ifndef APF_JUMP_H
#define APF_JUMP_H

#include "bodies.h"
#include "contact_law.h"

namespace apf {

// normal force at s, elastic and damping, > 0 repels; s = sqrt(a/R), mass: that the contact has of
// its two bodies
template <class Constants, class Real>
APF_INLINE Real force_at(const Constants &c, const Real &s, const Real &closing_speed,
                         const Real &mass, double step)
{
  const Real s2 = s * s, s3 = s2 * s;
  const Real eta = stable_dashpot(lagging_dashpot(c, s, 0.5 * step), c.kn * s2, mass, step);
  return c.K * s3 * (s3 - c.neck6) + eta * closing_speed;
}

// What a body's load has beside the forces of its contacts.
struct DueLoad {
  int row;
  double f[3];
};

// f is added to the load of j along the normal, and taken from that of i
template <class Row> void push_apart(Row *rows, int i, int j, double f, std::vector<DueLoad> &due)
{
  Row &a = rows[i], &b = rows[j];
  double d2 = 0.0;
  for (int c = 0; c < Row::dim; c++) d2 += (b.x[c] - a.x[c]) * (b.x[c] - a.x[c]);
  const double scale = f / std::sqrt(d2);
  DueLoad on_i{i, {}}, on_j{j, {}};
  for (int c = 0; c < Row::dim; c++) {
    on_j.f[c] = scale * (b.x[c] - a.x[c]);
    on_i.f[c] = -on_j.f[c];
    a.f[c] += on_i.f[c];
    b.f[c] += on_j.f[c];
  }
  due.push_back(on_i);
  due.push_back(on_j);
}

// Contact k has just been made. Positions are those of its rows, velocities those that led there in
// the time step.
template <class Row>
void correct_touch(const ContactList &list, int k, Row *rows, double step,
                   std::vector<DueLoad> &due)
{
  const auto c = list.constants_of(k);
  const auto approach = Approach::of(rows[list.i[k]], rows[list.j[k]], c.radius_sum);
  const double moved = step * approach.closing_speed;
  if (!(moved > 0.0) || -approach.gap > moved) return;     // it was there before: no jump
  const double touching = std::cbrt(4.0) * c.root_unit;    // where the overlap is 0
  const double share = -approach.gap / moved - 0.5;
  push_apart(rows, list.i[k], list.j[k],
             share * force_at(c, touching, approach.closing_speed, c.crowd_mass, step), due);
}

// Contact k has just ended.
template <class Row>
void correct_end(const ContactList &list, int k, Row *rows, double step, std::vector<DueLoad> &due)
{
  const auto c = list.constants_of(k);
  const auto approach = Approach::of(rows[list.i[k]], rows[list.j[k]], c.radius_sum);
  const double moved = -step * approach.closing_speed;
  const double beyond = c.break_overlap + approach.gap;
  if (!(moved > 0.0) || beyond > moved) return;
  const double s = jkr_root(c.break_overlap, c.root_scale, c.root_unit);
  push_apart(rows, list.i[k], list.j[k],
             (0.5 - beyond / moved) * force_at(c, s, approach.closing_speed, c.crowd_mass, step),
             due);
}

}    // namespace apf

#endif
