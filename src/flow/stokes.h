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

namespace apf {

namespace sphere {
  constexpr double pi = 3.14159265358979323846;
  inline double volume(double diameter)
  {
    return pi / 6.0 * diameter * diameter * diameter;
  }
  inline double moment_of_inertia(double mass, double diameter)
  {
    return 0.1 * mass * diameter * diameter;
  }
}    // namespace sphere

// force per slip velocity                                           [mass/time]
inline double stokes_resistance(double viscosity, double diameter)
{
  return 3.0 * sphere::pi * viscosity * diameter;
}

// torque per slip angular velocity                                  [mass length^2/time]
inline double stokes_spin_resistance(double viscosity, double diameter)
{
  return sphere::pi * viscosity * diameter * diameter * diameter;
}

// mass whose weight is the weight in the fluid; negative if the particle rises     [mass]
inline double buoyant_mass(double mass, double diameter, double fluid_density)
{
  return mass - fluid_density * sphere::volume(diameter);
}

// Reynolds number of the particle, |v - u| d rho_f/mu
inline double particle_reynolds(double slip, double diameter, double fluid_density,
                                double viscosity)
{
  return slip * diameter * fluid_density / viscosity;
}

// drag law with f = 1; linear, so that its relaxation time does not depend on the slip
struct StokesDrag {
  static constexpr bool linear = true;
  static double factor(double) { return 1.0; }
};

}    // namespace apf

#endif
