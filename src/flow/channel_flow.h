// Laminar flow between two parallel walls (plane Poiseuille flow):
//   u = 4 umax s (1 - s),  s = (x_w - lo)/(hi - lo),  along the flow axis
// 0 at the walls, umax in the middle; the mean is (2/3) umax. Outside the walls fluid is at rest.
// G. K. Batchelor, An Introduction to Fluid Dynamics, section 4.2, doi:10.1017/CBO9780511800955

#ifndef APF_CHANNEL_FLOW_H
#define APF_CHANNEL_FLOW_H

#include "parallel_flow.h"

namespace apf {

struct ChannelFlow {
  int flow;     // axis along which the fluid moves: 0 = x, 1 = y, 2 = z
  int wall;     // axis normal to the walls
  double lo;    // where the walls are                             [length]
  double hi;
  double umax;    // velocity in the middle                          [length/time]

  Vec3 velocity(const double *x) const
  {
    const double s = (x[wall] - lo) / (hi - lo);
    return inside(s) * (4.0 * umax * s * (1.0 - s)) * unit_vector(flow);
  }
  Gradient gradient(const double *x) const
  {
    const double s = (x[wall] - lo) / (hi - lo);
    Gradient g;
    g.d[flow][wall] = inside(s) * 4.0 * umax * (1.0 - 2.0 * s) / (hi - lo);
    return g;
  }

 private:
  static double inside(double s) { return s >= 0.0 && s <= 1.0 ? 1.0 : 0.0; }
};

}    // namespace apf

#endif
