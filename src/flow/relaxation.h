// Force of a resistance over a time step of any length.
//   m dw/dt = -k w + F,  w = v - u the slip, k the resistance, F all other forces
// has, for constant k and F, an exact solution. Its change over a step h is that of the mean force
//   phi(z) (F - k w0),  phi(z) = (1 - exp(-z))/z,  z = h k/m,  w0 the slip when the step begins.
// A resistance of -k w0 phi - F (1 - phi) brings it about, next to F. A kick with it is stable for
// every h; where F and resistance balance, that balance is exact: the slip is F/k.
// S. M. Cox, P. C. Matthews, J. Comput. Phys. 176, 430 (2002), doi:10.1006/jcph.2002.6995

#ifndef APF_RELAXATION_H
#define APF_RELAXATION_H

#include "elementary.h"

#include <cmath>

namespace apf {

// phi(z), mean of exp(-t) over 0 < t < z; z >= 0
template <class Real> APF_INLINE Real mean_decay(const Real &z)
{
  const Real positive = larger(z, 1.0e-290);
  return -exponential_less_one(-positive) / positive;
}

// phi(z) from half = phi(z/2)
template <class Real> APF_INLINE Real mean_decay_of_both_halves(const Real &z, const Real &half)
{
  return half * (1.0 - 0.25 * z * half);
}

// The same of t exp(-z (1 - t)) over 0 < t < 1: what is left of a force that grows through a step
inline double ramp_decay(double z)
{
  if (z < 1.0e-3) return 1.0 / 2.0 - z * (1.0 / 6.0 - z / 24.0);
  return (1.0 - mean_decay(z)) / z;
}

// The square of a step in which a contact is as stable as in this one, over that of this one: an
// oscillator of frequency w whose velocity relaxes by exp(-z) in each leapfrog step h is stable for
// (w h)^2 (1 - exp(-z)) / z < 2 (1 + exp(-z)), without drag for (w h)^2 < 4.                  [-]
inline double mobility_in_steps(double z)
{
  return z > 0.0 ? 2.0 * std::tanh(0.5 * z) / z : 1.0;
}

// Mean resistance over the step, phi = mean_decay(h k/m); positive along -slip.
template <class Real>
APF_INLINE Vector3<Real> mean_resistance(const Real &k, const Real &phi, const Vector3<Real> &slip,
                                         const Vector3<Real> &other)
{
  return -((phi * k) * slip) - (1.0 - phi) * other;
}

// The slip in mid-step. Where resistance or other forces depend on the slip they are those of this
// one, which makes the step second order; at a fixed point it is the slip itself.
// half_phi = mean_decay(h k/2m)
template <class Real>
APF_INLINE Vector3<Real> mid_slip(const Real &step_per_mass, const Real &k, const Real &half_phi,
                                  const Vector3<Real> &slip, const Vector3<Real> &other)
{
  return slip + (0.5 * step_per_mass * half_phi) * (other - k * slip);
}

}    // namespace apf

#endif
