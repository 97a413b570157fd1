// Laminar flow in a round pipe along a coordinate axis (Hagen-Poiseuille flow):
//   u = umax (1 - r^2/R^2),  r = distance to the pipe's axis
// 0 at the wall, umax on the axis; the mean is umax/2. Outside the pipe fluid is at rest.
// G. K. Batchelor, An Introduction to Fluid Dynamics, section 4.2, doi:10.1017/CBO9780511800955

#ifndef APF_PIPE_FLOW_H
#define APF_PIPE_FLOW_H

#include "parallel_flow.h"

namespace apf {

struct PipeFlow {
  int flow;            // the pipe's axis: 0 = x, 1 = y, 2 = z
  int across[2];       // the two other axes, ascending
  double centre[2];    // where the pipe's axis crosses them           [length]
  double radius;       // R                                            [length]
  double umax;         // velocity on the axis                         [length/time]

  Vec3 velocity(const double *x) const
  {
    const double a = x[across[0]] - centre[0];
    const double b = x[across[1]] - centre[1];
    const double rest = 1.0 - (a * a + b * b) / (radius * radius);
    return (rest > 0.0 ? umax * rest : 0.0) * unit_vector(flow);
  }
  Gradient gradient(const double *x) const
  {
    const double a = x[across[0]] - centre[0];
    const double b = x[across[1]] - centre[1];
    const double slope = a * a + b * b <= radius * radius ? -2.0 * umax / (radius * radius) : 0.0;
    Gradient g;
    g.d[flow][across[0]] = slope * a;
    g.d[flow][across[1]] = slope * b;
    return g;
  }
};

}    // namespace apf

#endif
