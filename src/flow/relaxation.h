// Force of a resistance over a time step of any length.
//   m dw/dt = -k w + F,  w = v - u the slip, k the resistance, F all other forces
// has, for constant k and F, an exact solution. Its change over a step h is that of the mean force
//   phi(z) (F - k w0),  phi(z) = (1 - exp(-z))/z,  z = h k/m,  w0 the slip when the step begins.
// A resistance of -k w0 phi - F (1 - phi) brings it about, next to F. A kick with it is stable for
// every h; where F and resistance balance, that balance is exact: the slip is F/k.
// S. M. Cox, P. C. Matthews, J. Comput. Phys. 176, 430 (2002), doi:10.1006/jcph.2002.6995

#ifndef APF_RELAXATION_H
#define APF_RELAXATION_H

#include "../contact/vector.h"

#include <cmath>

namespace apf {

// phi(z), mean of exp(-t) over 0 < t < z; z >= 0
inline double mean_decay(double z)
{
  if (z < 1.0e-3) return 1.0 - z * (1.0 / 2.0 - z * (1.0 / 6.0 - z / 24.0));    // to 1e-14
  return -std::expm1(-z) / z;
}

// The same of t exp(-z (1 - t)) over 0 < t < 1: what is left of a force that grows through a step
inline double ramp_decay(double z)
{
  if (z < 1.0e-3) return 1.0 / 2.0 - z * (1.0 / 6.0 - z / 24.0);
  return (1.0 - mean_decay(z)) / z;
}

// Mean resistance over the step, phi = mean_decay(h k/m); positive along -slip.
inline Vec3 mean_resistance(double k, double phi, const Vec3 &slip, const Vec3 &other)
{
  return -((phi * k) * slip) - (1.0 - phi) * other;
}

}    // namespace apf

#endif
