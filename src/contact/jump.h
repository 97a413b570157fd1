// The force of an adhesive contact jumps when bodies first touch, from 0 to -8/9 F_C, and when
// their neck ends, from -5/9 F_C to 0 (damping jumps along). Leapfrog steps see that up to a step
// late; with nothing done about it a collision gains or loses (force jump) x (distance of half a
// step) by chance, an error of first order in the step and the largest of all in the sticking
// velocity. When the jump came is known from the overlap and the speed, so the kick of the step in
// which it is seen gets the impulse that is missing, or gives back what was too much.
//
//   touch, a time t ago:   force x (t + step/2) is due, force x step is given
//   end,   a time t ago:   force x (step/2 - t) is due, nothing is given

#ifndef APF_JUMP_H
#define APF_JUMP_H

#include "bodies.h"
#include "contact_law.h"

namespace apf {

// normal force at s, elastic and damping, > 0 repels; s = sqrt(a/R)
inline double force_at(const ContactConstants &c, double s, double closing_speed, double step)
{
  const double s3 = s * s * s, neck3 = c.neck * c.neck * c.neck;
  const double eta = stable_dashpot(c.eta * s, c.K * c.inv_R * s * s, c.crowd_mass, step);
  return c.K * s3 * (s3 - 6.0 * neck3) + eta * closing_speed;
}

// f is added to the load of j along the normal, and taken from that of i
template <class Row> void push_apart(Row &i, Row &j, double f)
{
  double d2 = 0.0;
  for (int c = 0; c < Row::dim; c++) d2 += (j.x[c] - i.x[c]) * (j.x[c] - i.x[c]);
  const double scale = f / std::sqrt(d2);
  for (int c = 0; c < Row::dim; c++) {
    const double along = scale * (j.x[c] - i.x[c]);
    i.f[c] -= along;
    j.f[c] += along;
  }
}

// Contact k has just been made. Positions are those of its rows, velocities those that led there in
// the time step.
template <class Row> void correct_touch(const ContactList &list, int k, Row *rows, double step)
{
  Row &i = rows[list.i[k]], &j = rows[list.j[k]];
  const auto c = list.constants_of(k);
  const auto approach = Approach::of(i, j, c.radius_sum);
  const double moved = step * approach.closing_speed;
  if (!(moved > 0.0) || -approach.gap > moved) return;    // it was there before: no jump
  const double touching = std::cbrt(4.0) * c.neck;        // where the overlap is 0
  push_apart(i, j,
             (-approach.gap / moved - 0.5) * force_at(c, touching, approach.closing_speed, step));
}

// Contact k has just ended.
template <class Row> void correct_end(const ContactList &list, int k, Row *rows, double step)
{
  Row &i = rows[list.i[k]], &j = rows[list.j[k]];
  const auto c = list.constants_of(k);
  const auto approach = Approach::of(i, j, c.radius_sum);
  const double moved = -step * approach.closing_speed;
  const double beyond = c.break_overlap + approach.gap;
  if (!(moved > 0.0) || beyond > moved) return;
  const double s = jkr_root(c.break_overlap, c.inv_R, c.neck);
  push_apart(i, j, (0.5 - beyond / moved) * force_at(c, s, approach.closing_speed, step));
}

}    // namespace apf

#endif
