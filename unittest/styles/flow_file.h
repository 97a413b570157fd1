// Spheres in a flow from a file, for the tests of fix flow/field file.

#ifndef APF_TEST_FLOW_FILE_H
#define APF_TEST_FLOW_FILE_H

#include "flow_scene.h"
#include "temporary_file.h"

inline const std::string spheres = R"(
units lj
atom_style sphere
atom_modify map array sort 0 0
boundary p f p
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 2 1 5
create_atoms 1 single 5 5 5
create_atoms 1 single 7 8.7 2
set type 1 diameter 0.5 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
timestep 0.01
)";

// spheres that follow the fluid within a step of it
inline const std::string light = " density 0.5 viscosity 1e4\n";

// 4 U s (1 - s) with U = 2 and s = y/10
inline void parabola(const double *x, double, double *u)
{
  u[0] = 8.0 * x[1] / 10.0 * (1.0 - x[1] / 10.0);
}

#endif
