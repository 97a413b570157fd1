// Flows along one coordinate axis e_f: a velocity w(x) e_f has the vorticity grad w x e_f.

#ifndef APF_PARALLEL_FLOW_H
#define APF_PARALLEL_FLOW_H

#include "../contact/vector.h"

namespace apf {

// unit vector of a coordinate axis: 0 = x, 1 = y, 2 = z
inline Vec3 unit_vector(int axis)
{
  return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0};
}

}    // namespace apf

#endif
