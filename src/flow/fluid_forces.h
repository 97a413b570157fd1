// All forces of the fluid on a block of spheres over one time step. The laws are in headers of
// their own; which of them act is the FluidModel's. Drag comes last, since it relaxes the velocity
// under the sum of all other forces (relaxation.h).

#ifndef APF_FLUID_FORCES_H
#define APF_FLUID_FORCES_H

#include "fluid_block.h"

#include <cstdint>
#include <vector>

namespace apf {

// What acts on the spheres, and between which constants.
struct FluidModel {
  enum Drag { NONE, STOKES, SCHILLER, DI_FELICE, DI_FELICE_SUPERFICIAL };

  Drag drag = NONE;
  bool torque = false, lift = false, magnus = false, added_mass = false, pressure = false;
  bool weight = false, brownian = false;
  Vec3 gravity{0.0, 0.0, 0.0};    // acceleration, without buoyancy        [length/time^2]
  double mean_free_path = 0.0;    // of a gas that slips at the spheres, 0: it does not [length]
  double kT = 0.0;                // of Brownian motion                    [energy]
  std::uint32_t seed = 0;

  double density = 0.0;      // of the fluid                          [mass/length^3]
  double viscosity = 0.0;    // dynamic                               [pressure time]

  bool planar = false;         // spheres in the xy plane
  std::int64_t step = 0;       // number of the time step, for random numbers
  double step_length = 0.0;    // for which a random force stays           [time]

  bool hindered() const { return drag == DI_FELICE || drag == DI_FELICE_SUPERFICIAL; }
  // forces that depend on the slip velocity, but not along it
  bool slip_forces() const { return lift || magnus || added_mass; }
  Detail detail() const
  {
    if (pressure || added_mass) return Detail::GRADIENT;
    return torque || lift || magnus ? Detail::VORTICITY : Detail::VELOCITY;
  }
};

enum FluidForce { DRAG, WEIGHT, LIFT, MAGNUS, ADDED_MASS, PRESSURE, BROWNIAN, n_fluid_forces };

// The spheres of a block. In the plane the components that leave it must be 0.
struct ForceBlock {
  int n = 0;    // in use, <= block_width; the others must hold numbers, with diameter and mass > 0
  alignas(64) Lanes diameter, mass;
  Lanes step;                               // time for which the forces act        [time]
  Lanes velocity[3], spin[3];               // v, Om
  Lanes other_force[3], other_torque[3];    // what else acts
  Lanes concentration;                      // where the drag is hindered
  std::uint64_t tag[block_width];           // where there are random numbers

  // results: means over the step
  Lanes force[n_fluid_forces][3];    // of those that act
  Lanes torque[3];
  // To be added to the other forces, so that all together are mass times acceleration: the sum of
  // the fluid's forces. With added mass it depends on the other forces: they also move fluid.
  Lanes given[3];
  Lanes share;              // of any force that moves the sphere, m/(m + added mass)
  Lanes rate, spin_rate;    // at which v and Om relax to the fluid's          [1/time]
};

using FluidForces = void (*)(const FluidModel &model, const FluidBlock &fluid, ForceBlock &block);

// The builds that this processor can run, and the one that is chosen (instruction_set.h).
struct FluidForcesBuild {
  const char *name;
  FluidForces forces;
};
const std::vector<FluidForcesBuild> &fluid_forces_builds();
FluidForces fluid_forces();

}    // namespace apf

#endif
