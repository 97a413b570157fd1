// What time steps cannot follow: impacts that are over before two of them have passed, bodies that
// something has put into each other, and pairs that fly through each other between two positions.
//
// How much leapfrog steps of length h make of the energy of undamped head-on impacts of duration T,
// on the mean of all phases: 1.0 times at h = 0.4 T, 1.8 times at 0.5 T, 19 times at T; beyond that
// bodies fly through each other. T is that of Hertz's law with the speed that adhesion adds; for a
// neck at rest T = 2 h is at omega h = 1.96, beside the limit of stability 2.

#ifndef APF_FIRST_TOUCH_H
#define APF_FIRST_TOUCH_H

#include "../contact/stiffness.h"

#include <algorithm>
#include <cmath>

namespace apf {

constexpr double fewest_steps = 2.0;    // of an impact                                        [-]
constexpr double good_steps = 20.0;     // with which energy is right to 0.1 %                   [-]

// Duration of an impact at that speed, compression and restitution: by Hertz's law, of the speed
// and what first touch sets free, U(0) - U(rest) = 0.607082 F_C delta_C.
constexpr double hertz_duration = 2.9432751;    // over (deepest overlap / speed)             [-]
inline double speed2_of_impact(const StiffestMode &contact, double speed)
{
  return speed * speed + 0.607082 * contact.slow2;
}
inline double impact_duration(const StiffestMode &contact, double speed)
{
  return hertz_duration * contact.impact * std::pow(speed2_of_impact(contact, speed), -0.1);
}

// much more than at rest: what has put them there is no impact
inline bool inside_each_other(double overlap, double smaller_radius, double overlap_at_rest)
{
  constexpr double much = 0.1;
  return overlap > much * smaller_radius && overlap > 2.0 * overlap_at_rest;
}

struct FirstTouch {
  double overlap;           // found                                                   [length]
  double speed;             // of approach, when the bodies touched                  [velocity]
  double relative_speed;    // of the centres                                        [velocity]

  // How bodies that overlap came so, at constant velocities. turning: see ContactBodies
  static FirstTouch of(const Approach &now, double radius_sum, double turning)
  {
    const double overlap = -now.gap, v2 = now.relative_speed * now.relative_speed;
    if (overlap >= radius_sum) return {overlap, now.relative_speed, now.relative_speed};
    const double along2 = now.closing_speed * now.closing_speed;
    const double turned = overlap * (2.0 * radius_sum - overlap) / (radius_sum * radius_sum);
    const double speed2 = along2 + turning * turned * (v2 - along2);
    return {overlap, std::sqrt(std::max(speed2, 0.0)), now.relative_speed};
  }

  // step: without drag, which makes longer ones stable
  bool too_fast(const StiffestMode &contact, double step) const
  {
    // without a root: contacts that begin are many in a gas
    const double x = hertz_duration / fewest_steps * contact.impact / step, x2 = x * x;
    return speed2_of_impact(contact, speed) > x2 * x2 * x2 * x2 * x2;
  }
  // Farther in each other than a step of their own and what adhesion presses them can bring them,
  // so that their springs throw them apart faster than they can have come.
  bool thrown_apart(const JKR &law, const StiffestMode &contact, double smaller_radius,
                    double step) const
  {
    constexpr double rounding = 1.1;
    if (overlap <= rounding * relative_speed * step ||
        !inside_each_other(overlap, smaller_radius, contact.least))
      return false;
    return speed_apart(law, contact.mass) > relative_speed;
  }
  double speed_apart(const JKR &law, double mass) const
  {
    const double energy = law.energy(law.root(overlap)) - law.energy(law.root(0.0));
    return std::sqrt(std::max(2.0 * energy / mass, 0.0));
  }
};

// Pairs that pass within their distance of touch in a step are in the list before it or after it
// unless they move farther than that against each other: twice the half chord of the circle of the
// list (touch + skin) that grazes the one of touch.
inline double longest_way_shown(double touch, double skin)
{
  return 2.0 * std::sqrt(skin * (2.0 * touch + skin));
}

// Two bodies apart from each other that fly on as they do.
struct Passage {
  double nearest2 = 0.0;    // distance at which they pass, squared                  [length^2]
  double until = 0.0;       // time until then, < 0 if it is over                        [time]
  double before2 = 0.0;     // distance a step ago, squared                          [length^2]
  double speed = 0.0;       // relative                                              [velocity]

  template <class Row> static Passage of(const Row &i, const Row &j, double step)
  {
    Passage p;
    double d2 = 0.0, v2 = 0.0, dv = 0.0;
    for (int c = 0; c < Row::dim; c++) {
      const double d = j.x[c] - i.x[c], v = i.v[c] - j.v[c], ago = d + step * v;
      d2 += d * d;
      v2 += v * v;
      dv += d * v;
      p.before2 += ago * ago;
    }
    p.until = v2 > 0.0 ? dv / v2 : 0.0;
    p.nearest2 = d2 - dv * p.until;
    p.speed = std::sqrt(v2);
    return p;
  }
  // Unseen: in the last step or one of those for which a list with this skin is sure to be kept, if
  // they move by more than half of that in it.
  bool through(double touch, double step, double skin) const
  {
    if (nearest2 >= touch * touch || speed * step <= 0.5 * touch) return false;
    return until > 0.0 ? (until - step) * speed < skin : until > -step && before2 > touch * touch;
  }
};

}    // namespace apf

#endif
