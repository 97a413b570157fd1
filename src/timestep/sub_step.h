// One body's part in the sub-steps of a particle step: leapfrog under the contact forces, which are
// new in each sub-step, beside slow forces and the fluid's resistance, which are given for the
// whole step. Resistance relaxes the velocity exactly for any length of the sub-step
// (flow/relaxation.h), so what the fluid does to a body that a contact holds is right as well.
//
//   dv/dt = f/m + a - rate v          a: slow forces and rate x velocity of the fluid
//
// Slow forces act evenly over the sub-steps. Given as a kick at each end of the step, as r-RESPA
// does it, they would shake contacts with an amplitude that grows with the particle step, and
// mobilise friction that the same force at rest does not. What they have changed by at the end of
// the step is given half a step long (fix nve/sphere/mts), which makes the order two.

#ifndef APF_SUB_STEP_H
#define APF_SUB_STEP_H

#include "../contact/bodies.h"
#include "../flow/relaxation.h"

namespace apf {

// What acts on a body through a particle step besides contacts. A body without inverse inertia
// keeps its velocity.
struct Slow {
  double inv_mass = 0.0, inv_inertia = 0.0;    // [1/mass], [1/(mass length^2)]
  double a[3] = {0.0, 0.0, 0.0};               // acceleration                 [velocity/time]
  double alpha[3] = {0.0, 0.0, 0.0};           // angular acceleration         [1/time^2]
  double rate = 0.0, spin_rate = 0.0;          // of relaxation                [1/time]

  // mean acceleration over a time h of a body with velocity v, where relaxation slows it down
  double mean_acceleration(const double *v, double h) const
  {
    double sum = 0.0;
    for (int c = 0; c < 3; c++) sum += (a[c] - rate * v[c]) * (a[c] - rate * v[c]);
    return std::sqrt(sum) * mean_decay(h * rate);
  }
};

// The change of velocities in one kick: v += gain f + push - fade v.
template <class Row> struct Kick {
  double gain, fade, push[Row::dim];
  double spin_gain, spin_fade, spin_push[Row::spin_dim];

  // the kick of a time h
  static Kick of(const Slow &s, double h)
  {
    Kick k;
    const double t = h * mean_decay(h * s.rate), t_spin = h * mean_decay(h * s.spin_rate);
    k.gain = t * s.inv_mass;
    k.fade = t * s.rate;
    k.spin_gain = t_spin * s.inv_inertia;
    k.spin_fade = t_spin * s.spin_rate;
    for (int c = 0; c < Row::dim; c++) k.push[c] = t * s.a[c];
    for (int c = 0; c < Row::spin_dim; c++)
      k.spin_push[c] = t_spin * s.alpha[c + 3 - Row::spin_dim];
    return k;
  }

  // uses the row's load and clears it
  void apply(Row &row) const
  {
    for (int c = 0; c < Row::dim; c++) {
      row.v[c] += gain * row.f[c] + push[c] - fade * row.v[c];
      row.f[c] = 0.0;
    }
    for (int c = 0; c < Row::spin_dim; c++) {
      row.omega[c] += spin_gain * row.torque[c] + spin_push[c] - spin_fade * row.omega[c];
      row.torque[c] = 0.0;
    }
  }
};

template <class Row> void drift(Row &row, double dt)
{
  for (int c = 0; c < Row::dim; c++) row.x[c] += dt * row.v[c];
}

}    // namespace apf

#endif
