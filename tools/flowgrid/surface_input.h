// Surfaces from files of triangles.

#ifndef FLOWGRID_SURFACE_INPUT_H
#define FLOWGRID_SURFACE_INPUT_H

#include "surface.h"

namespace flowgrid {

// The file that "FILE" or "FILE:NAME" names. Throws std::runtime_error if it does not exist.
std::string surface_file(const std::string &words);

// Adds what is in "FILE" or "FILE:NAME" (.stl, .vtp or .obj; NAME is that of the file if it is not
// given), lengths times scale. Throws std::runtime_error.
void read_surface(const std::string &words, double scale, Surface &surface);

}    // namespace flowgrid

#endif
