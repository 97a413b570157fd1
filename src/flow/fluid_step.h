// Mean drag and torque of the fluid on a sphere over one time step (relaxation.h), for any drag law
// F = 3 pi mu d f(Re) (u - v). The other forces on the sphere are given and constant over the step.
// A law that is not linear takes its factor f at the slip in mid-step: that makes it second order.

#ifndef APF_FLUID_STEP_H
#define APF_FLUID_STEP_H

#include "relaxation.h"
#include "stokes.h"

namespace apf {

template <class Law> class FluidStep {
 public:
  // step: the time over which a force acts on the velocity         [time]
  FluidStep(double fluid_density, double viscosity, double step) :
      density(fluid_density), mu(viscosity), h(step)
  {
  }

  // The sphere that the next calls are about; neighbours in memory are often alike.
  void set_sphere(double diameter, double mass)
  {
    if (diameter == d && mass == m) return;
    d = diameter;
    m = mass;
    k = stokes_resistance(mu, d);
    k_spin = stokes_spin_resistance(mu, d);
    stokes_rate = k / m;
    stokes_spin_rate = k_spin / sphere::moment_of_inertia(m, d);
    phi = mean_decay(h * stokes_rate);
    phi_spin = mean_decay(h * stokes_spin_rate);
  }

  // rates at which velocity and angular velocity relax towards the fluid's   [1/time]
  double rate(const Vec3 &slip) const
  {
    if constexpr (Law::linear)
      return stokes_rate;
    else
      return stokes_rate * factor(slip);
  }
  double spin_rate() const { return stokes_spin_rate; }

  // weight less buoyancy in the gravity g
  Vec3 gravity(const Vec3 &g) const { return buoyant_mass(m, d, density) * g; }

  // slip: v - u, other: sum of all other forces
  Vec3 drag(const Vec3 &slip, const Vec3 &other) const
  {
    if constexpr (Law::linear) {
      return mean_resistance(k, phi, slip, other);
    } else {
      const double k_start = k * factor(slip);
      const double phi_half = mean_decay(0.5 * h * k_start / m);
      const Vec3 middle = slip + (0.5 * h * phi_half / m) * (other - k_start * slip);
      const double k_mid = k * factor(middle);
      return mean_resistance(k_mid, mean_decay(h * k_mid / m), slip, other);
    }
  }

  // slip: Om - om/2, other: sum of all other torques
  Vec3 torque(const Vec3 &slip, const Vec3 &other) const
  {
    return mean_resistance(k_spin, phi_spin, slip, other);
  }

 private:
  double factor(const Vec3 &slip) const
  {
    return Law::factor(particle_reynolds(std::sqrt(norm2(slip)), d, density, mu));
  }

  double density, mu;    // of the fluid
  double h;              // time step
  double d = -1.0;       // diameter and mass of the sphere
  double m = -1.0;
  double k = 0.0, k_spin = 0.0;    // its resistances at f = 1
  double stokes_rate = 0.0, stokes_spin_rate = 0.0;
  double phi = 1.0, phi_spin = 1.0;    // and the decays over a step that belong to them
};

}    // namespace apf

#endif
