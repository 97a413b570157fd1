// Drag of a sphere among others, IIHR Report 459, eqs (3), (4): F = 3 pi mu d f (u - v),
//   f = (1 - c)^(-beta),  beta = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2)
// c: volume of particles per volume. R. Di Felice, Int. J. Multiphase Flow 20, 153 (1994),
// doi:10.1016/0301-9322(94)90011-6 (the logarithm is decimal there; the report prints ln).

#ifndef APF_DI_FELICE_H
#define APF_DI_FELICE_H

#include <algorithm>
#include <cmath>

namespace apf {

// densest random packing; overlapping particle clouds may exceed it, and even 1
constexpr double max_concentration = 0.64;

inline double di_felice_factor(double reynolds, double concentration)
{
  const double c = std::clamp(concentration, 0.0, max_concentration);
  const double k = 1.5 - std::log10(reynolds);    // +infinity at rest: beta = 3.7
  return std::pow(1.0 - c, -(3.7 - 0.65 * std::exp(-0.5 * k * k)));
}

}    // namespace apf

#endif
