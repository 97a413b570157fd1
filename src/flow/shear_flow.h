// Simple shear without walls: u = rate (x_g - origin) along the flow axis, x_g the coordinate along
// the gradient axis. A sphere that no other torque acts on spins with half the vorticity, rate/2.

#ifndef APF_SHEAR_FLOW_H
#define APF_SHEAR_FLOW_H

#include "parallel_flow.h"

namespace apf {

struct ShearFlow {
  int flow;         // axis along which the fluid moves: 0 = x, 1 = y, 2 = z
  int across;       // axis along which its velocity changes
  double origin;    // coordinate where it is at rest                 [length]
  double rate;      // du/dx_g                                        [1/time]

  Vec3 velocity(const double *x) const { return rate * (x[across] - origin) * unit_vector(flow); }
  Gradient gradient(const double *) const
  {
    Gradient g;
    g.d[flow][across] = rate;
    return g;
  }
};

}    // namespace apf

#endif
