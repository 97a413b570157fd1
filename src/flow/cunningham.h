// Slip of a gas at spheres not much larger than the mean free path of its molecules. Resistances
// are divided by
//   drag     C = 1 + Kn (1.257 + 0.400 exp(-1.10/Kn)),  Kn = 2 lambda/d
//   torque   C = 1 + 3 * 1.257 Kn
// Drag: C. N. Davies, Proc. Phys. Soc. 57, 259 (1945), doi:10.1088/0959-5309/57/4/301, fitted to
// oil drops, for all Kn. Torque: slip flow with the same slip length 1.257 lambda, for small Kn
// (A. B. Basset, A Treatise on Hydrodynamics, vol. 2, Cambridge 1888: a sphere with slip length s
// turns against 8 pi mu r^3/(1 + 3 s/r)); at large Kn it leaves too much torque, by up to 1.6.

#ifndef APF_CUNNINGHAM_H
#define APF_CUNNINGHAM_H

#include "elementary.h"

namespace apf {

constexpr double slip_length = 1.257;    // over the mean free path

// mean_free_path > 0
template <class Real> APF_INLINE Real slip_correction(double mean_free_path, const Real &diameter)
{
  const Real inverse = (0.5 / mean_free_path) * diameter;    // 1/Kn
  return 1.0 + (slip_length + 0.400 * exponential(-1.10 * inverse)) / inverse;
}
template <class Real>
APF_INLINE Real spin_slip_correction(double mean_free_path, const Real &diameter)
{
  return 1.0 + 6.0 * slip_length * mean_free_path / diameter;
}

}    // namespace apf

#endif
