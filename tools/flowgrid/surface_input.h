// Surfaces from files of triangles.

#ifndef FLOWGRID_SURFACE_INPUT_H
#define FLOWGRID_SURFACE_INPUT_H

#include "surface.h"

namespace flowgrid {

// "FILE" or "FILE:NAME", FILE .stl, .vtp or .obj; NAME is that of the file if it is not given.
// Throws std::runtime_error if there is no such file, or NAME cannot be part of an array's.
struct SurfaceWords {
  explicit SurfaceWords(const std::string &words);
  std::string file, name;
};

// Adds what is in it, lengths times scale. Throws std::runtime_error.
void read_surface(const SurfaceWords &words, double scale, Surface &surface);

}    // namespace flowgrid

#endif
