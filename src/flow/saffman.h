// Lift of a sphere that moves through a shear flow, IIHR Report 459, eq (9), with the mass that the
// report left out, and without its 0/0 at rest:
//   F = -1.615 rho_f d^2 sqrt(nu/|om|) (v - u) x om
// A particle that leads the fluid goes where the fluid is slower. Valid for Re = |v - u| d/nu << 1,
// Re_G = |om| d^2/nu << 1 and Re << sqrt(Re_G).
// P. G. Saffman, J. Fluid Mech. 22, 385 (1965), doi:10.1017/S0022112065000824; corrigendum
// J. Fluid Mech. 31, 624 (1968)

#ifndef APF_SAFFMAN_H
#define APF_SAFFMAN_H

#include "../contact/vector.h"

namespace apf {

// slip: v - u, vorticity: om = curl u
template <class Real>
APF_INLINE Vector3<Real> saffman_lift(double fluid_density, double viscosity, const Real &diameter,
                                      const Vector3<Real> &slip, const Vector3<Real> &vorticity)
{
  using std::sqrt;
  // 81.2/(16 pi), from Saffman's integral
  constexpr double coefficient = 1.615;
  const Real root_om = sqrt(sqrt(larger(norm2(vorticity), 1.0e-280)));    // sqrt |om|
  const Real factor =
      -(coefficient * std::sqrt(fluid_density * viscosity)) * diameter * diameter / root_om;
  return factor * cross(slip, vorticity);
}

}    // namespace apf

#endif
