// The wall as triangles: where the distance on a grid is 0, by VTK.

#ifndef FLOWGRID_ISOSURFACE_H
#define FLOWGRID_ISOSURFACE_H

#include "mapping.h"

#include <string>

namespace flowgrid {

// path: .vtp or .stl. A grid of one layer gives a strip as wide as a cell. Returns the number of
// triangles. Throws std::runtime_error if the file cannot be written.
long write_isosurface(const std::string &path, const Grid &grid,
                      const std::vector<double> &distance);

}    // namespace flowgrid

#endif
