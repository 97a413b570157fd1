// Thermal motion: a random force on the velocity and a random torque on the spin of a sphere, each
// constant over a time h, with components of variance
//   2 kT k/h,   k the resistance that damps the same motion (fluctuation-dissipation theorem)
// Relaxation over the step is exact (relaxation.h). With z = h k/m the leapfrog velocities then are
//   v' = e^-z v + (1 - e^-z) B/k,  <B^2> = 2 kT k/h:
// displacements h v' add up to a diffusion coefficient of kT/k for every z, short or long steps
// alike. What the step does not resolve lacks in kinetic energy: m <v'^2> = kT tanh(z/2)/(z/2) for
// velocities of half steps, and m <v^2> = kT phi(z) for velocities at steps, their means.
// D. L. Ermak, H. Buckholz, J. Comput. Phys. 35, 169 (1980), doi:10.1016/0021-9991(80)90084-4

#ifndef APF_BROWNIAN_H
#define APF_BROWNIAN_H

#include "../contact/vector.h"

namespace apf {

// Standard deviation of one component of the random force or torque; 0 in a step of no time, where
// nothing moves.
template <class Real>
APF_INLINE Real thermal_amplitude(double kT, const Real &resistance, double time)
{
  using std::sqrt;
  const double variance = 2.0 * kT / time;    // at unit resistance, the same for all particles
  const double amplitude = std::isfinite(variance) ? std::sqrt(variance) : 0.0;
  return amplitude * sqrt(resistance);    // kT may be 0, the root of Packs not
}

}    // namespace apf

#endif
