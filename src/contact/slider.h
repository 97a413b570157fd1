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

#include <type_traits>

namespace apf {

// Displacement is a Real (planar sliding and rolling, twisting) or a vector of the tangent plane.
// One step in two parts, so that several sliders may share a division.
template <class Real, class Displacement> struct Slider {
  static constexpr bool straight = std::is_same_v<Real, Displacement>;

  Displacement stretched, dashpot, trial;
  Real size;    // of the trial force; never 0

  //   k      spring constant
  //   eta    dashpot constant
  //   v, dt  velocity of the slip and time since the last step
  //   xi     spring elongation
  APF_INLINE Slider(const Real &k, const Real &eta, const Displacement &v, double dt,
                    const Displacement &xi) :
      stretched(xi + Real(dt) * v),
      dashpot(eta * v), trial(k * stretched + dashpot)
  {
    using std::sqrt;
    if constexpr (straight)
      size = magnitude(trial);
    else
      size = sqrt(norm2(trial) + 1.0e-200);
  }

  //   limit     largest force
  //   inv_size  1 / size; not used by a Real
  //   inv_k     1 / k; 0 where there is no spring
  //   xi        becomes the new elongation
  APF_INLINE Displacement force(const Real &limit, const Real &inv_size, const Real &inv_k,
                                Displacement &xi) const
  {
    Displacement held;
    if constexpr (straight)
      held = smaller(larger(trial, -limit), limit);
    else
      held = smaller(limit * inv_size, 1.0) * trial;
    xi = select(limit < size, inv_k * (held - dashpot), stretched);
    return -held;
  }
};

}    // namespace apf

#endif
