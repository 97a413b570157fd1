// Lift of a sphere that spins other than the fluid, IIHR Report 459, eq (10):
//   F = -(3/4) rho_f V (om/2 - Om) x (v - u)  =  pi rho_f r^3 (Om - om/2) x (v - u)
// S. I. Rubinow, J. B. Keller, J. Fluid Mech. 11, 447 (1961), doi:10.1017/S0022112061000640; for
// Re = |v - u| d/nu << 1.

#ifndef APF_MAGNUS_H
#define APF_MAGNUS_H

#include "../contact/vector.h"

namespace apf {

// displaced: rho_f V, spin_slip: Om - om/2, slip: v - u
template <class Real>
APF_INLINE Vector3<Real> magnus_lift(const Real &displaced, const Vector3<Real> &spin_slip,
                                     const Vector3<Real> &slip)
{
  return (0.75 * displaced) * cross(spin_slip, slip);
}

}    // namespace apf

#endif
