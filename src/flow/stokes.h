// A sphere in creeping flow, IIHR Report 459, eqs (2), (5), (11):
//   drag      F = 3 pi mu d f (u - v)            f = 1 for Stokes, larger in other laws
//   torque    M = pi mu d^3 (om/2 - Om)
//   gravity   F = (m - rho_f V) g                weight less buoyancy, m g (1 - rho_f/rho_p)
// u, om: velocity and vorticity of the undisturbed fluid at the centre; v, Om: velocity and angular
// velocity of the particle. Drag and torque pull the particle towards the fluid's motion.
// Drag and torque: G. K. Batchelor, An Introduction to Fluid Dynamics, section 4.9,
// doi:10.1017/CBO9780511800955; M. R. Maxey, J. J. Riley, Phys. Fluids 26, 883 (1983),
// doi:10.1063/1.864230; S. I. Rubinow, J. B. Keller, J. Fluid Mech. 11, 447 (1961),
// doi:10.1017/S0022112061000640

#ifndef APF_STOKES_H
#define APF_STOKES_H

#include "../contact/vector.h"

namespace apf {

namespace sphere {
  template <class Real> APF_INLINE Real volume(const Real &diameter)
  {
    return pi / 6.0 * diameter * diameter * diameter;
  }
  template <class Real> APF_INLINE Real moment_of_inertia(const Real &mass, const Real &diameter)
  {
    return 0.1 * mass * diameter * diameter;
  }
}    // namespace sphere

// force per slip velocity                                           [mass/time]
template <class Real> APF_INLINE Real stokes_resistance(double viscosity, const Real &diameter)
{
  return 3.0 * pi * viscosity * diameter;
}

// torque per slip angular velocity                                  [mass length^2/time]
template <class Real> APF_INLINE Real stokes_spin_resistance(double viscosity, const Real &diameter)
{
  return pi * viscosity * diameter * diameter * diameter;
}

// mass of the fluid that a sphere displaces, chi m in the report    [mass]
template <class Real> APF_INLINE Real displaced_mass(const Real &diameter, double fluid_density)
{
  return fluid_density * sphere::volume(diameter);
}

// Reynolds number of the particle, |v - u| d rho_f/mu
template <class Real>
APF_INLINE Real particle_reynolds(const Real &slip, const Real &diameter, double fluid_density,
                                  double viscosity)
{
  return slip * diameter * (fluid_density / viscosity);
}

// drag law with f = 1; linear: its relaxation time does not depend on the slip
struct StokesDrag {
  static constexpr bool linear = true;
  static constexpr double largest_reynolds = 1.0;    // for which it is meant
  template <class Real> static APF_INLINE Real factor(const Real &, const Real &)
  {
    return Real(1.0);
  }
};

}    // namespace apf

#endif
