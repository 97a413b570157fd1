// A sphere in a flow, for the tests of fix flow/field and fix flow/force.

#ifndef APF_TEST_FLOW_SCENE_H
#define APF_TEST_FLOW_SCENE_H

#include "scenes.h"

// A sphere with d = 1 and mass pi/6 at (5,5,5); in a fluid of viscosity mu = 1/18 its relaxation
// time is rho d^2/(18 mu) = 1, and 0.3 for its spin.
inline const std::string one_sphere = R"(
units lj
atom_style sphere
atom_modify map array
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 5 5 5
set type 1 diameter 1.0 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
)";
inline const std::string fluid = " density 0.5 viscosity $(1/18)\n";
inline const double resistance = pi / 6.0;                                // 3 pi mu d
inline const std::string syrup = " density 0.5 viscosity $(1e4/18)\n";    // tau = 1e-4

inline std::string properties(double density, double viscosity)
{
  return " density " + digits(density) + " viscosity " + digits(viscosity) + "\n";
}
inline std::string timestep(double step)
{
  return "timestep " + digits(step) + "\n";
}

#endif
