// Fluid that moves everywhere with one velocity.

#ifndef APF_UNIFORM_FLOW_H
#define APF_UNIFORM_FLOW_H

#include "../contact/vector.h"

namespace apf {

struct UniformFlow {
  Vec3 speed;    // velocity of the fluid                          [length/time]

  Vec3 velocity(const double *) const { return speed; }
  Vec3 vorticity(const double *) const { return {0.0, 0.0, 0.0}; }
};

}    // namespace apf

#endif
