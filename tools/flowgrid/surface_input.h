// Surfaces from files of triangles.

#ifndef FLOWGRID_SURFACE_INPUT_H
#define FLOWGRID_SURFACE_INPUT_H

#include "surface.h"

namespace flowgrid {

// Adds what is in "FILE" or "FILE:NAME" (.stl, .vtp or .obj; NAME is that of the file if it is not
// given), lengths times scale. Throws std::runtime_error.
void read_surface(const std::string &words, double scale, Surface &surface);

}    // namespace flowgrid

#endif
