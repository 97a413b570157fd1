// Particles in the plane: each counts in a slab as thick as its own diameter.

#ifndef APF_PARTICLE_SLAB_H
#define APF_PARTICLE_SLAB_H

#include "../contact/vector.h"

namespace apf {

// what is divided by when a quantity is to be one per depth of the plane [length]; 1 in space [-]
inline double slab_depth(double radius, bool planar)
{
  return planar ? 2.0 * radius : 1.0;
}

// volume of a sphere [length^3], in the plane per depth, pi d^2 / 6 [length^2]
inline double particle_volume(double radius, bool planar)
{
  return 4.0 / 3.0 * pi * radius * radius * radius / slab_depth(radius, planar);
}

}    // namespace apf

#endif
