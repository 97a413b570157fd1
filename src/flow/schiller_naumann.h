// Drag of a sphere at Reynolds numbers up to about 800: F = 3 pi mu d f (u - v),
//   f = 1 + 0.15 Re^0.687
// L. Schiller, A. Naumann, Z. Ver. Dtsch. Ing. 77, 318 (1933); R. Clift, J. R. Grace, M. E. Weber,
// Bubbles, Drops and Particles, Academic Press 1978, table 5.1, ISBN 978-0-12-176950-5

#ifndef APF_SCHILLER_NAUMANN_H
#define APF_SCHILLER_NAUMANN_H

#include "elementary.h"

namespace apf {

struct SchillerNaumannDrag {
  static constexpr bool linear = false;
  static constexpr double largest_reynolds = 800.0;    // for which it is meant
  // second argument: volume fraction of particles, which this law does not know
  template <class Real> static APF_INLINE Real factor(const Real &reynolds, const Real &)
  {
    return 1.0 + 0.15 * exponential(0.687 * logarithm(larger(reynolds, 1.0e-200)));
  }
};

}    // namespace apf

#endif
