// Drag of a sphere among others, IIHR Report 459, eqs (3), (4): F = 3 pi mu d f (u - v),
//   f = (1 - c)^(-beta),  beta = 3.7 - 0.65 exp(-(1.5 - log10 Re)^2/2)
// c: volume of particles per volume. R. Di Felice, Int. J. Multiphase Flow 20, 153 (1994),
// doi:10.1016/0301-9322(94)90011-6 (the logarithm is decimal there; the report prints ln). The
// exponent holds for equal superficial velocities, (1 - c) times the slip u - v between the grains;
// with that slip the factor is (1 - c)^(1 - beta). The report has the former for the latter.
// Di Felice fitted beta for 0.01 < Re < 1e4, below which it is constant to 0.002; but he multiplies
// the drag of a lone sphere at that Re, the report that of Stokes, which bounds the law to its Re.

#ifndef APF_DI_FELICE_H
#define APF_DI_FELICE_H

#include "elementary.h"

namespace apf {

// densest random packing; overlapping particle clouds may exceed it, and even 1
constexpr double max_concentration = 0.64;

// SUPERFICIAL: exponent 1 - beta instead of -beta
template <bool SUPERFICIAL> struct DiFeliceDrag {
  static constexpr bool linear = false;
  template <class Real>
  static APF_INLINE Real factor(const Real &reynolds, const Real &concentration)
  {
    const Real c = smaller(larger(concentration, 0.0), max_concentration);
    const Real k = 1.5 - 0.4342944819032518 * logarithm(larger(reynolds, 1.0e-200));
    const Real beta = 3.7 - 0.65 * exponential(-0.5 * k * k);
    return exponential(((SUPERFICIAL ? 1.0 : 0.0) - beta) * logarithm(1.0 - c));
  }
};

}    // namespace apf

#endif
