// Forces on a sphere in fluid that accelerates, IIHR Report 459, eqs (6) to (8):
//   pressure    F = rho_f V Du/Dt                       Du/Dt = du/dt|_x + (u.grad) u
//   added mass  F = rho_f V c_M (du/dt - dv/dt)         du/dt = du/dt|_x + (v.grad) u,  c_M = 1/2
// The former is what the fluid would need itself, the latter pays for the fluid that the sphere
// moves along. du/dt follows the particle, as the report and Maxey and Riley have it; with Du/Dt
// instead, as T. R. Auton, J. C. R. Hunt, M. Prud'Homme, J. Fluid Mech. 197, 241 (1988),
// doi:10.1017/S0022112088003246, have it for inviscid flow, the force differs by
// rho_f V c_M ((v - u).grad) u, which is small where the slip is.
// The term with dv/dt stands on the left: the sphere moves as if its mass were m + c_M rho_f V.
// M. R. Maxey, J. J. Riley, Phys. Fluids 26, 883 (1983), doi:10.1063/1.864230

#ifndef APF_ACCELERATED_FLUID_H
#define APF_ACCELERATED_FLUID_H

#include "../contact/vector.h"

namespace apf {

constexpr double added_mass_coefficient = 0.5;    // c_M of a sphere

// Acceleration of the fluid that a point with this velocity sees: Du/Dt with the fluid's own, du/dt
// with the particle's. rate: du/dt at a fixed point, gradient[a][b] = du_a/dx_b.
template <class Real>
APF_INLINE Vector3<Real> acceleration_along(const Vector3<Real> &velocity,
                                            const Vector3<Real> &rate,
                                            const Vector3<Real> (&gradient)[3])
{
  return {rate.x + dot(gradient[0], velocity), rate.y + dot(gradient[1], velocity),
          rate.z + dot(gradient[2], velocity)};
}

}    // namespace apf

#endif
