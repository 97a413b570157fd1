// Flows along one coordinate axis.

#ifndef APF_PARALLEL_FLOW_H
#define APF_PARALLEL_FLOW_H

#include "fluid_block.h"

namespace apf {

// unit vector of a coordinate axis: 0 = x, 1 = y, 2 = z
inline Vec3 unit_vector(int axis)
{
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

}    // namespace apf

#endif
