// Compiled once per instruction set (CMakeLists.txt); APF_ISA names the namespace of this copy.

#include "fluid_forces.h"

#include "accelerated_fluid.h"
#include "brownian.h"
#include "cunningham.h"
#include "di_felice.h"
#include "magnus.h"
#include "philox.h"
#include "relaxation.h"
#include "saffman.h"
#include "schiller_naumann.h"
#include "stokes.h"

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

using Real = Pack<APF_REGISTER_BYTES>;
using Vector = Vector3<Real>;
static_assert(block_width % Real::width == 0, "groups fill a block");

APF_INLINE Vector load(const Lanes (&a)[3], int l)
{
  return {Real::load(&a[0][l]), Real::load(&a[1][l]), Real::load(&a[2][l])};
}
APF_INLINE void store(const Vector &v, Lanes (&a)[3], int l)
{
  v.x.store(&a[0][l]);
  v.y.store(&a[1][l]);
  v.z.store(&a[2][l]);
}

// Random numbers of a block, as many as there are components of force or torque; in the plane some
// stay 0.
class Noise {
 public:
  enum Motion { TRANSLATION, ROTATION };

  Noise(const FluidModel &model, const ForceBlock &block, Motion motion)
  {
    const auto step = static_cast<std::uint64_t>(model.step);
    for (int l = 0; l < block_width; l++) {
      word[0][l] = block.tag[l] & 0xffffffff;
      word[1][l] = block.tag[l] >> 32;
      word[2][l] = step & 0xffffffff;
      word[3][l] = step >> 32;
    }
    philox(word, model.seed, motion);
    in_plane = !model.planar || motion == TRANSLATION ? 1.0 : 0.0;
    out_of_plane = !model.planar || motion == ROTATION ? 1.0 : 0.0;
  }

  APF_INLINE Vector at(int l) const
  {
    Real number[4], x, y, z, unused;
    for (int w = 0; w < 4; w++) {
      double words[Real::width];
      for (int k = 0; k < Real::width; k++) words[k] = static_cast<double>(word[w][l + k]);
      number[w] = Real::load(words);
    }
    normal_pair(number[0], number[1], x, y);
    normal_pair(number[2], number[3], z, unused);
    return {in_plane * x, in_plane * y, out_of_plane * z};
  }

 private:
  std::uint64_t word[4][block_width];
  double in_plane, out_of_plane;
};

// Spheres whose numbers fill a register.
template <class Law> class FluidGroup {
 public:
  APF_INLINE FluidGroup(const FluidModel &_model, const FluidBlock &_fluid, ForceBlock &_block,
                        int lane) :
      model(_model),
      fluid(_fluid), block(_block), first(lane), mass(Real::load(&_block.mass[lane])),
      diameter(Real::load(&_block.diameter[lane])), step(Real::load(&_block.step[lane])),
      displaced(displaced_mass(diameter, _model.density)), u(load(_fluid.velocity, lane))
  {
    k = stokes_resistance(model.viscosity, diameter);
    k_spin = stokes_spin_resistance(model.viscosity, diameter);
    if (model.mean_free_path > 0.0) {
      k = k / slip_correction(model.mean_free_path, diameter);
      k_spin = k_spin / spin_slip_correction(model.mean_free_path, diameter);
    }
    if (model.hindered()) concentration = Real::load(&block.concentration[first]);
    if (model.torque || model.magnus)
      spin_slip = load(block.spin, first) - 0.5 * load(fluid.vorticity, first);
  }

  // the torque over the step, and the spin in its middle
  APF_INLINE void turn(const Noise *noise)
  {
    const Real inverse_inertia = 1.0 / sphere::moment_of_inertia(mass, diameter);
    const Real step_per_inertia = step * inverse_inertia;
    Vector other = load(block.other_torque, first), random{0.0, 0.0, 0.0};
    if (noise) {
      random = thermal_amplitude(model.kT, k_spin, model.step_length) * noise->at(first);
      other = other + random;
    }
    const Real z = step_per_inertia * k_spin, half_phi = mean_decay(0.5 * z);
    const Real phi = mean_decay_of_both_halves(z, half_phi);
    store(mean_resistance(k_spin, phi, spin_slip, other) + random, block.torque, first);
    (k_spin * inverse_inertia).store(&block.spin_rate[first]);
    if (model.magnus) spin_slip = mid_slip(step_per_inertia, k_spin, half_phi, spin_slip, other);
  }

  APF_INLINE void move(const Noise *noise)
  {
    const Real inertia = model.added_mass ? mass + added_mass_coefficient * displaced : mass;
    const Real inverse_inertia = 1.0 / inertia, step_per_mass = step * inverse_inertia;
    const Vector slip = load(block.velocity, first) - u;
    const Vector outer = load(block.other_force, first), steady = steady_forces(noise);
    Vector other = outer + steady, middle = slip;
    const Real k_first = resistance(slip), z = step_per_mass * k_first;
    const Real half_phi = mean_decay(0.5 * z);
    if (!Law::linear || model.slip_forces())
      middle = mid_slip(step_per_mass, k_first, half_phi, slip, other + slip_forces(slip).sum());
    const SlipForces forces = slip_forces(middle);
    other = other + forces.sum();
    const Real k_mid = Law::linear ? k_first : resistance(middle);
    const Real phi = Law::linear ? mean_decay_of_both_halves(z, half_phi)
                                 : mean_decay(step_per_mass * k_mid);
    const Vector drag = mean_resistance(k_mid, phi, slip, other);

    Vector given = other - outer + drag;
    (k_mid * inverse_inertia).store(&block.rate[first]);
    store(drag, block.force[DRAG], first);
    if (model.lift) store(forces.lift, block.force[LIFT], first);
    if (model.magnus) store(forces.magnus, block.force[MAGNUS], first);
    if (model.added_mass) {
      const Real share = mass * inverse_inertia;
      share.store(&block.share[first]);
      const Vector rest = (share - 1.0) * (other + drag);    // -c_M rho_f V dv/dt
      given = given + rest;
      store(forces.added_mass + rest, block.force[ADDED_MASS], first);
    }
    store(given, block.given, first);
  }

 private:
  struct SlipForces {
    Vector lift{0.0, 0.0, 0.0}, magnus{0.0, 0.0, 0.0}, added_mass{0.0, 0.0, 0.0};

    APF_INLINE Vector sum() const { return lift + magnus + added_mass; }
  };

  const FluidModel &model;
  const FluidBlock &fluid;
  ForceBlock &block;
  const int first;    // lane
  const Real mass, diameter, step, displaced;
  Real k, k_spin, concentration = 0.0;    // resistances at vanishing slip, f = 1
  const Vector u;
  Vector spin_slip{0.0, 0.0, 0.0};

  // of the fluid as a point with this velocity sees it
  APF_INLINE Vector acceleration(const Vector &velocity) const
  {
    const Vector gradient[3] = {load(fluid.gradient[0], first), load(fluid.gradient[1], first),
                                load(fluid.gradient[2], first)};
    return acceleration_along(velocity, load(fluid.rate, first), gradient);
  }

  APF_INLINE Real factor(const Real &slip_velocity) const
  {
    return Law::factor(particle_reynolds(slip_velocity, diameter, model.density, model.viscosity),
                       concentration);
  }
  APF_INLINE Real resistance(const Vector &slip) const
  {
    if constexpr (Law::linear)
      return k;
    else
      return k * factor(sqrt(norm2(slip)));
  }

  // those that do not depend on the velocity
  APF_INLINE Vector steady_forces(const Noise *noise) const
  {
    Vector sum{0.0, 0.0, 0.0};
    auto act = [&](FluidForce which, const Vector &force) {
      store(force, block.force[which], first);
      sum = sum + force;
    };
    if (model.weight) {
      const Vector g{model.gravity.x, model.gravity.y, model.gravity.z};
      act(WEIGHT, (mass - displaced) * g);
    }
    if (model.pressure) act(PRESSURE, displaced * acceleration(u));
    if (noise)
      act(BROWNIAN,
          thermal_amplitude(model.kT, k * factor(0.0), model.step_length) * noise->at(first));
    return sum;
  }

  APF_INLINE SlipForces slip_forces(const Vector &slip) const
  {
    SlipForces of;
    if (model.lift)
      of.lift = saffman_lift(model.density, model.viscosity, diameter, slip,
                             load(fluid.vorticity, first));
    if (model.magnus) of.magnus = magnus_lift(displaced, spin_slip, slip);
    if (model.added_mass)
      of.added_mass = (added_mass_coefficient * displaced) * acceleration(u + slip);
    return of;
  }
};

template <class Law>
static void forces_by(const FluidModel &model, const FluidBlock &fluid, ForceBlock &block)
{
  if (model.brownian) {
    const Noise noise(model, block, Noise::TRANSLATION);
    const Noise spin_noise(model, block, Noise::ROTATION);
    for (int l = 0; l < block.n; l += Real::width) {
      FluidGroup<Law> group(model, fluid, block, l);
      if (model.torque) group.turn(&spin_noise);
      group.move(&noise);
    }
  } else {
    for (int l = 0; l < block.n; l += Real::width) {
      FluidGroup<Law> group(model, fluid, block, l);
      if (model.torque) group.turn(nullptr);
      group.move(nullptr);
    }
  }
}

void fluid_forces(const FluidModel &model, const FluidBlock &fluid, ForceBlock &block)
{
  switch (model.drag) {
    case FluidModel::SCHILLER:
      forces_by<SchillerNaumannDrag>(model, fluid, block);
      break;
    case FluidModel::DI_FELICE:
      forces_by<DiFeliceDrag<false>>(model, fluid, block);
      break;
    case FluidModel::DI_FELICE_SUPERFICIAL:
      forces_by<DiFeliceDrag<true>>(model, fluid, block);
      break;
    default:
      forces_by<StokesDrag>(model, fluid, block);
  }
}

}    // namespace apf::APF_ISA
