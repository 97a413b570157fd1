// Spring, dashpot and slider in series: the form shared by sliding, twisting and rolling resistance
// (IIHR Report 459, eqs 25, 29, 35; Cundall and Strack, doi:10.1680/geot.1979.29.1.47).
//
//   force = -(k xi + eta v), scaled back to `limit` along itself where it is larger
//
// The direction of the trial force, not of the velocity, decides where it slips (radial return), so
// the force neither flips nor vanishes when the velocity does; xi is set back so that spring and
// dashpot give the limit again.

#ifndef APF_SLIDER_H
#define APF_SLIDER_H

#include "vector.h"

namespace apf {

// Displacement is double (planar sliding and rolling, twisting) or Vec3 (tangent plane).
//   k      spring constant; > 0
//   eta    dashpot constant
//   limit  largest force
//   v, dt  velocity of the slip and time since the last call; dt = 0 leaves the history alone
//   xi     spring elongation, updated
template <class Displacement>
APF_INLINE Displacement slider_force(double k, double eta, double limit, const Displacement &v,
                                     double dt, Displacement &xi)
{
  const Displacement stretched = xi + dt * v;
  const Displacement trial = k * stretched + eta * v;
  const double size = std::sqrt(norm2(trial)) + 1.0e-300;
  const double share = limit < size ? limit / size : 1.0;
  const Displacement force = share * trial;
  const Displacement slipped = (1.0 / k) * (force - eta * v);
  const double slips = (share < 1.0 && dt > 0.0) ? 1.0 : 0.0;
  xi = stretched + slips * (slipped - stretched);
  return -force;
}

}    // namespace apf

#endif
