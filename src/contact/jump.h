// The force of an adhesive contact jumps when bodies first touch, from 0 to -8/9 F_C, and when
// their neck ends, from -5/9 F_C to 0 (damping jumps along). Leapfrog steps see that up to a step
// late; with nothing done about it a collision gains or loses (force jump) x (distance of half a
// step) by chance, an error of first order in the step and the largest of all in the sticking
// velocity. When the jump came is known from the overlap and the speed, so the kick of the step in
// which it is seen gets the impulse that is missing, or gives back what was too much.
//
// How much is that? Leapfrog steps of a smooth force do not keep the energy of the law but one that
// is close to it (backward analysis; Hairer, Lubich, Wanner, doi:10.1007/3-540-30666-8, IX): with
// the overlap x, its speed v, the elastic force F, its slope k = dF/dx and the time step h,
//
//   (1/2) m v^2 + U + h^2 (k v^2 / 12 - F^2 / (24 m))    at the positions of steps
//   (1/2) m v^2 + U - h^2 (k v^2 / 24 - F^2 / (12 m))    half way between them
//
// Outside of contacts both are (1/2) m v^2. So the speed after a touch is the one with which the
// first of them stays what it was before; that after an end is given by the second, half a step
// before the last position with a contact: k has a pole at the end of the neck, and too close to it
// the series says nothing. Damping has no energy: it gets what is due by its value at the jump, a
// time t ago:
//
//   touch:   force x (t + step/2) is due, force x step is given
//   end:     force x (step/2 - t) is due, nothing is given
//
// Half of the kick may belong to the next run; who looks at the contacts again finds no trace of
// it, so it is noted.

#ifndef APF_JUMP_H
#define APF_JUMP_H

#include "bodies.h"
#include "contact_law.h"

namespace apf {

// The elastic law of a contact, and the mass that it moves.
struct Spring {
  JKR law;
  double mass;

  Spring(const ContactConstants &c, double mass) :
      law{c.R, c.K, c.neck6 > 0.0 ? c.root_unit : 0.0}, mass(mass)
  {
  }
  // what leapfrog steps keep beside (1/2) m v^2 and U, at a position and between two
  double at_position(double s, double v, double step) const
  {
    const double F = law.force(s);
    return step * step * (law.stiffness(s) * v * v / 12.0 - F * F / (24.0 * mass));
  }
  double between_positions(double s, double v, double step) const
  {
    const double F = law.force(s);
    return step * step * (F * F / (12.0 * mass) - law.stiffness(s) * v * v / 24.0);
  }
  // the speed that is left of v when `rise` is taken from the kinetic energy; 0 if there is less
  double speed_after(double v, double rise) const
  {
    return std::sqrt(std::max(v * v - 2.0 * rise / mass, 0.0));
  }
};

// What led two bodies to where they are, in a time step at constant velocities.
struct LastStep {
  double overlap;    // now                                                              [length]
  double moved;      // by which it grew                                                 [length]

  // turning: see ContactBodies
  template <class Row>
  static LastStep of(const Row &i, const Row &j, const ContactConstants &c, double step)
  {
    const auto now = Approach::of(i, j, c.radius_sum);
    const double distance = now.gap + c.radius_sum;
    const double speed = now.closing_speed, moved = step * speed;
    const double across2 = now.relative_speed * now.relative_speed - speed * speed;
    const double more = moved * (2.0 * distance + moved) + c.turning * step * step * across2;
    const double before = std::sqrt(std::max(distance * distance + more, 0.0));
    return {-now.gap, more / (before + distance)};
  }
};

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
  const auto last = LastStep::of(rows[list.i[k]], rows[list.j[k]], c, step);
  if (!(last.moved > 0.0) || last.overlap > last.moved) return;    // it was there before: no jump
  const Spring spring(c, list.mode(k).mass);
  const double v = last.moved / step, s = spring.law.root(last.overlap);
  const double touching = spring.law.root(0.0);
  const double rise =
      spring.law.energy(s) - spring.law.energy(touching) + spring.at_position(s, v, step);
  // half of the step's kick comes after this position, and is right as it is
  const double elastic =
      2.0 * rise / (v + spring.speed_after(v, rise)) / step - 0.5 * spring.law.force(s);
  const double share = last.overlap / last.moved - 0.5;
  push_apart(rows, list.i[k], list.j[k],
             elastic + share * damping_at(c, touching, v, c.crowd_mass, step), due);
}

// Contact k has just ended.
template <class Row>
void correct_end(const ContactList &list, int k, Row *rows, double step, std::vector<DueLoad> &due)
{
  const auto c = list.constants_of(k);
  const auto last = LastStep::of(rows[list.i[k]], rows[list.j[k]], c, step);
  const double beyond = c.break_overlap - last.overlap;
  if (!(last.moved < 0.0) || beyond > -last.moved) return;
  const Spring spring(c, list.mode(k).mass);
  const double v = -last.moved / step, position = last.overlap - last.moved;
  const double end = spring.law.root(c.break_overlap), ending = spring.law.energy(end);
  double s = spring.law.root(position);
  const double kick = step * spring.law.force(s) / spring.mass;    // at that position
  double left;                                                     // of the speed
  if (kick < 0.0) {                                                // half a step before, deeper
    const double before = v - kick;
    s = spring.law.root(position + 0.5 * step * before);
    left = spring.speed_after(
        before, ending - spring.law.energy(s) - spring.between_positions(s, before, step));
  } else {    // it repels, so the end of the neck is not near
    const double then = v - 0.5 * kick;
    left =
        spring.speed_after(then, ending - spring.law.energy(s) - spring.at_position(s, then, step));
  }
  const double elastic = spring.mass * (left - v) / step;
  push_apart(rows, list.i[k], list.j[k],
             elastic + (0.5 + beyond / last.moved) * damping_at(c, end, -v, c.crowd_mass, step),
             due);
}

}    // namespace apf

#endif
