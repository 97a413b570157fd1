// Fluid that moves everywhere with one velocity.

#ifndef APF_UNIFORM_FLOW_H
#define APF_UNIFORM_FLOW_H

#include "fluid_block.h"

namespace apf {

struct UniformFlow {
  Vec3 speed;    // velocity of the fluid                          [length/time]

  Vec3 velocity(const double *) const { return speed; }
  Gradient gradient(const double *) const { return {}; }
};

}    // namespace apf

#endif
