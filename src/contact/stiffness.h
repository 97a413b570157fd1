// Eigenfrequencies of one contact at rest, which limit the time step.
//
//   normal      sqrt(k / m),                k = dF/d(overlap) = (6/5) E a0 at equilibrium
//   tangential  sqrt(k_T (1/m + 5/(2 m))),  k_T = 8 G a0: sliding springs also turn the spheres
//   twisting    sqrt(k_Q / I),              k_Q = k_T a0^2 / 2
//   rolling     sqrt(4 F_C R / I)
// with m and I the effective mass and moment of inertia; a contact without adhesion is taken at an
// overlap of 1 % of R.

#ifndef APF_STIFFNESS_H
#define APF_STIFFNESS_H

#include "contact_model.h"

#include <algorithm>
#include <initializer_list>
#include <utility>

namespace apf {

// omega dt of one contact: velocity Verlet goes unstable at 2; twelve contacts on a particle (FCC)
// raise its frequency by up to sqrt(6), hence 2 / sqrt(6).
constexpr double largest_stable_kappa = 0.8;
constexpr double accurate_kappa = 0.3;

enum ContactMode { NONE, NORMAL, TANGENTIAL, TWISTING, ROLLING };
constexpr const char *mode_names[] = {"no", "normal", "tangential", "twisting", "rolling"};

struct StiffestMode {
  double frequency = 0.0;    // at rest                                                [1/time]
  double overlap = 1.0;      // at rest                                                [length]
  double least = 0.0;        // overlap below which stiffness does not fall: at rest, 0 for Hertz
  double impact = 0.0;       // an impact at the speed v compresses by impact v^(4/5) (Hertz)
  ContactMode mode = NONE;

  const char *name() const { return mode_names[mode]; }
  bool operator<(const StiffestMode &other) const { return frequency < other.frequency; }
};

// The stiffest mode of many contacts, as they may become when bodies meet at a speed v: stiffnesses
// grow at most as the contact radius, and that as the root of the overlap.
struct Stiffest {
  double v45 = 0.0;           // v^(4/5)
  double frequency2 = 0.0;    // frequency squared                                   [1/time^2]
  ContactMode mode = NONE;

  void include(const StiffestMode &mode, double overlap)
  {
    const double deepest = std::max({overlap, mode.impact * v45, mode.least});
    const double f2 = mode.frequency * mode.frequency * std::sqrt(deepest / mode.overlap);
    if (f2 <= frequency2) return;
    frequency2 = f2;
    this->mode = mode.mode;
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
  const double kq = model.twisting ? 0.5 * kt * a * a : 0.0;
  const double restore = std::pow(model.stiffness_scale, -0.4);
  const double kr = model.rolling() ? 4.0 * normal.pulloff_force() * restore * bodies.R : 0.0;
  const double overlap = adhesive ? normal.equilibrium_overlap() : 0.01 * bodies.R;
  const double least = adhesive ? overlap : 0.0;
  // (1/2) m v^2 = (8/15) E sqrt(R) overlap^(5/2)
  const double impact = std::pow(15.0 * bodies.m / (16.0 * E * std::sqrt(bodies.R)), 0.4);

  StiffestMode worst;
  for (const auto &[frequency, mode] : {std::pair(std::sqrt(kn / bodies.m), NORMAL),
                                        std::pair(std::sqrt(3.5 * kt / bodies.m), TANGENTIAL),
                                        std::pair(std::sqrt(kq / bodies.I), TWISTING),
                                        std::pair(std::sqrt(kr / bodies.I), ROLLING)})
    worst = std::max(worst, StiffestMode{frequency, overlap, least, impact, mode});
  return worst;
}

}    // namespace apf

#endif
