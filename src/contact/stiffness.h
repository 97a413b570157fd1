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

namespace apf {

// omega dt of one contact: velocity Verlet goes unstable at 2; twelve contacts on a particle (FCC)
// raise its frequency by up to sqrt(6), hence 2 / sqrt(6).
constexpr double largest_stable_kappa = 0.8;
constexpr double accurate_kappa = 0.3;

struct StiffestMode {
  double frequency = 0.0;    // [1/time]
  const char *name = "normal";

  bool operator<(const StiffestMode &other) const { return frequency < other.frequency; }
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

  StiffestMode worst;
  for (const StiffestMode &mode : {StiffestMode{std::sqrt(kn / bodies.m), "normal"},
                                   StiffestMode{std::sqrt(3.5 * kt / bodies.m), "tangential"},
                                   StiffestMode{std::sqrt(kq / bodies.I), "twisting"},
                                   StiffestMode{std::sqrt(kr / bodies.I), "rolling"}})
    worst = std::max(worst, mode);
  return worst;
}

}    // namespace apf

#endif
