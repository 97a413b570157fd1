// The numbers by which a scene is judged before it runs.
//
// IIHR Report 459 builds its three time steps of one speed U and one length L of the flow,
//   fluid step      f1 L/U
//   particle step   f2 d/U
//   collision step  f3 d (rho^2/(E^2 U))^(1/5)       E effective modulus, f2 = f3 = 10 f1
// and describes a scene by
//   Stokes number        tau U/L                     tau = m/(3 pi mu d)
//   adhesion parameter   phi = gamma/(rho U^2 r)     r radius of the particle, the smaller of two
//   stiffness parameter  lambda = E/(rho U^2)

#ifndef APF_SCALES_H
#define APF_SCALES_H

#include "../contact/bridge_list.h"
#include "../contact/jkr.h"
#include "../contact/stiffness.h"
#include "../flow/stokes.h"

namespace apf {

constexpr double report_f1 = 0.01, report_f2 = 0.1, report_f3 = 0.1;    // of its channel  [-]

// one scene, as far as its numbers need it
struct SceneScales {
  double U;         // speed                                                  [length/time]
  double L;         // length of the flow                                           [length]
  double step;      // particle step                                                  [time]
  double spread;    // largest difference of two particles' velocities           [velocity]

  double fluid_step() const { return report_f1 * L / U; }
  double particle_step(double d) const { return report_f2 * d / U; }
  double collision_step(double d, double rho, double E) const
  {
    return report_f3 * d * std::pow(rho * rho / (E * E * U), 0.2);
  }
  double adhesion(double gamma, double rho, double r) const { return gamma / (rho * U * U * r); }
  double stiffness(double E, double rho) const { return E / (rho * U * U); }
  double stokes_number(double tau) const { return tau * U / L; }
  double flow_reynolds(double density, double viscosity) const
  {
    return particle_reynolds(U, L, density, viscosity);
  }
  double amplify = 1.0;    // of speeds by impacts, see amplification()                    [-]
  // Skin with which fix nve/sphere/mts looks two steps ahead, with room for 20 %.
  double least_skin() const { return 1.2 * std::max(2.0, 1.0 + amplify) * spread * step; }
};

// tau_p                                                                           [time]
inline double relaxation_time(double mass, double d, double viscosity)
{
  return mass / stokes_resistance(viscosity, d);
}

// Re_G = |om| d^2/nu
inline double gradient_reynolds(double vorticity, double d, double density, double viscosity)
{
  return particle_reynolds(vorticity * d, d, density, viscosity);
}

// one contact
struct ContactScales {
  double contact_radius;    // a0 at rest                                           [length]
  double neck_length;       // delta_C                                              [length]
  double rest_overlap;      // by adhesion and a bridge                             [length]
  double impact_overlap;    // of an impact at the speed U, Hertz                   [length]
  double pulloff_force;     // F_C                                                   [force]
  double sticking_speed;    // V_s: an undamped impact below it sticks            [velocity]
  StiffestMode rest;        // of the contact at rest, and of a bridge between its bodies
  double collision_step;    // accurate also for an impact at the speed U             [time]

  static ContactScales make(const WetContact &wet, const ContactBodies &bodies,
                            double smaller_radius, double U)
  {
    const JKR normal = wet.dry.normal(bodies.R);
    ContactScales c{};
    c.pulloff_force = normal.pulloff_force();
    c.neck_length = normal.pulloff_overlap();
    c.contact_radius = normal.equilibrium_radius();
    c.rest_overlap = overlap_at_rest(wet, bodies.R);
    // (1/2) m V_s^2 = work from first touch (s^3 = 4 m^3) to the end of the neck
    const double touch = std::cbrt(4.0) * normal.neck;
    const double end = normal.root(-wet.dry.neck_share() * normal.pulloff_overlap());
    c.sticking_speed = std::sqrt(2.0 * (normal.energy(end) - normal.energy(touch)) / bodies.m);
    const StiffestMode dry = stiffest_mode(wet.dry, bodies);
    c.rest = stiffest_mode(wet, bodies, smaller_radius);
    Stiffest finest;
    finest.v45 = std::pow(U, 0.8);
    for (const auto &mode : {dry, c.rest}) finest.include(mode, 0.0, U * U);
    c.impact_overlap = dry.impact * finest.v45;
    c.collision_step = 1.0 / std::sqrt(finest.demand2);
    return c;
  }
};

}    // namespace apf

#endif
