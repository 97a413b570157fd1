// Eigenfrequencies of one contact at rest, which limit the time step.
//
//   normal      sqrt(k / m),                k = dF/d(overlap) = (6/5) E a0 at equilibrium
//   tangential  sqrt(k_T (1/m + 5/(2 m))),  k_T = 8 G a0: sliding springs also turn the spheres
//   rolling     sqrt(4 F_C R / I)
// with m and I the effective mass and moment of inertia; a contact without adhesion is taken at an
// overlap of 1 % of R. Twisting, sqrt(k_T a0^2 / (2 I)), is slower than the tangential mode up to
// a0 = 1.67 r of the smaller sphere, and above 1.22 r the overlap at rest stops the run.

#ifndef APF_STIFFNESS_H
#define APF_STIFFNESS_H

#include "../timestep/look_ahead.h"
#include "contact_model.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace apf {

// omega dt of one contact: velocity Verlet goes unstable at 2; twelve contacts on a particle (FCC)
// raise its frequency by up to sqrt(6), hence 2 / sqrt(6).
constexpr double largest_stable_kappa = 0.8;
constexpr double accurate_kappa = 0.3;

enum ContactMode { NONE, NORMAL, TANGENTIAL, ROLLING, BRIDGE };
constexpr const char *mode_names[] = {"no", "normal", "tangential", "rolling", "bridge"};

struct StiffestMode {
  double frequency = 0.0;    // at rest                                                [1/time]
  double overlap = 1.0;      // at rest                                                [length]
  double least = 0.0;        // overlap below which stiffness does not fall: at rest, 0 for Hertz
  double impact = 0.0;       // an impact at the speed v compresses by impact v^(4/5) (Hertz)
  double mass = 1.0;         // effective mass                                           [mass]
  double slow2 = 0.0;        // 2 F_C delta_C / m: adhesion rules slower contacts [velocity^2]
  ContactMode mode = NONE;

  const char *name() const { return mode_names[mode]; }
  bool operator<(const StiffestMode &other) const { return frequency < other.frequency; }
};

// How fine a step must be: omega step <= kappa. Either kappa is the same for all contacts, or it
// follows from a tolerance T for the error of energy that leapfrog steps make,
//   (1/2) m v^2 (omega step)^2 / 8 <= T max(F_C delta_C, (1/2) m v^2),
// v the speed with which the contact may come to move: contacts at rest take the largest stable
// step, and impacts too fast for adhesion one that depends on T only.
struct StepRule {
  double kappa = accurate_kappa;
  double tolerance = 0.0;    // T; 0 = kappa as it is                                        [-]

  double kappa2(double slow2, double speed2) const
  {
    const double k2 = 8.0 * tolerance * (slow2 > speed2 ? slow2 / speed2 : 1.0);
    return tolerance == 0.0 ? kappa * kappa : std::min(k2, largest_kappa2());
  }
  double largest_kappa2() const
  {
    const double largest = tolerance == 0.0 ? kappa : largest_stable_kappa;
    return largest * largest;
  }
};

// The contact that demands the finest step, of many. Stiffnesses grow at most as the contact
// radius, and that as the root of the overlap, with an impact at the speed v in view.
struct Stiffest {
  StepRule rule;
  double step = 0.0;      // the particle step                                     [time]
  double extra = 0.0;     // speed that forces may add in free flight           [velocity]
  double strike = 0.0;    // that strikes may add to an approach                 [velocity]
  double v45 = 0.0;       // v^(4/5)                                    [velocity^(4/5)]
  const double *acceleration = nullptr;    // of each body's surface    [velocity/time]
  double frequency2 = 0.0;    // largest of all contacts, squared                   [1/time^2]
  double demand2 = 0.0;       // largest (frequency / kappa)^2 = 1/step^2            [1/time^2]
  // of the contact that demands it:
  ContactMode mode = NONE;
  double of2 = 0.0;     // its frequency, squared                                   [1/time^2]
  double mass = 0.0;    // its effective mass                                           [mass]

  // A pair that does not touch, of bodies with a sum of accelerations. If it will in the step as
  // it flies, first touch sets U(0) - U(rest) = 0.607082 F_C delta_C free. Where neither that nor
  // what moves in contacts now can bring it together, which nothing foresees, stable steps will do.
  void include_near(const StiffestMode &contact, const Approach &approach,
                    double relative_acceleration)
  {
    const double closing = approach.closing_speed + extra, speed = approach.relative_speed + extra;
    const double adhesion2 = approach.gap <= closing * step ? 0.607082 * contact.slow2 : 0.0;
    const bool touches = approach.gap <= (closing + relative_acceleration * step + strike) * step;
    demand(contact, 0.0,
           touches ? rule.kappa2(contact.slow2, speed * speed + adhesion2) : rule.largest_kappa2());
  }

  // A contact whose surfaces move at a relative speed, squared. Within the step it may come to move
  // as fast as present accelerations make it, or as its springs can, whose energy per mass
  // energy_per_mass() returns; that costs a root of the law and is asked for only where it matters.
  template <class Energy>
  void include(const StiffestMode &contact, double overlap, double speed2,
               double relative_acceleration, Energy energy_per_mass)
  {
    const double speed = std::sqrt(speed2) + relative_acceleration * step;
    const double f2 = frequency2_of(contact, overlap);
    if (f2 <= demand2 * rule.kappa2(contact.slow2, speed * speed))
      frequency2 = std::max(frequency2, f2);
    else
      // (at rest the energy is 0 but for rounding)
      include(contact, overlap,
              std::min(speed * speed, speed2 + std::max(0.0, 2.0 * energy_per_mass())));
  }

  // speed2: the largest that may come about, squared
  void include(const StiffestMode &contact, double overlap, double speed2)
  {
    demand(contact, overlap, rule.kappa2(contact.slow2, speed2));
  }

 private:
  void demand(const StiffestMode &contact, double overlap, double kappa2)
  {
    const double f2 = frequency2_of(contact, overlap);
    frequency2 = std::max(frequency2, f2);
    if (f2 <= demand2 * kappa2) return;
    demand2 = f2 / kappa2;
    mode = contact.mode;
    of2 = f2;
    mass = contact.mass;
  }
  double frequency2_of(const StiffestMode &contact, double overlap) const
  {
    const double deepest = std::max({overlap, contact.impact * v45, contact.least});
    return contact.frequency * contact.frequency * std::sqrt(deepest / contact.overlap);
  }
};

inline StiffestMode stiffest_mode(const ContactModel &model, const ContactBodies &bodies)
{
  const JKR normal = model.normal(bodies.R);
  const double E = model.surface.E * model.stiffness_scale;
  const double G = model.surface.G * model.stiffness_scale;
  const bool adhesive = model.adhesive();
  const double a = adhesive ? normal.equilibrium_radius() : 0.1 * bodies.R;
  const double kn = (adhesive ? 1.2 : 2.0) * E * a;
  const double kt = model.sliding() ? 8.0 * G * a : 0.0;
  const double restore = std::pow(model.stiffness_scale, -0.4);
  const double kr = model.rolling() ? 4.0 * normal.pulloff_force() * restore * bodies.R : 0.0;
  const double overlap = adhesive ? normal.equilibrium_overlap() : 0.01 * bodies.R;
  const double least = adhesive ? overlap : 0.0;
  // (1/2) m v^2 = (8/15) E sqrt(R) overlap^(5/2)
  const double impact = std::pow(15.0 * bodies.m / (16.0 * E * std::sqrt(bodies.R)), 0.4);

  const double slow2 = 2.0 * normal.pulloff_force() * normal.pulloff_overlap() / bodies.m;

  StiffestMode worst;
  for (const auto &[frequency, mode] : {std::pair(std::sqrt(kn / bodies.m), NORMAL),
                                        std::pair(std::sqrt(3.5 * kt / bodies.m), TANGENTIAL),
                                        std::pair(std::sqrt(kr / bodies.I), ROLLING)})
    worst = std::max(worst, StiffestMode{frequency, overlap, least, impact, bodies.m, slow2, mode});
  return worst;
}

}    // namespace apf

#endif
