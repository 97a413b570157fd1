// Distances to the walls that the command line names, into the file; what they are worth, on the
// terminal.

#ifndef FLOWGRID_WALL_OUTPUT_H
#define FLOWGRID_WALL_OUTPUT_H

#include "options.h"
#include "surface.h"
#include "vtkhdf_writer.h"

namespace flowgrid {

// Half as wide as strips must be that stand for walls in a plane grid               [length]
double strip_half_width(const Options &o, const Grid &grid);

// mesh: walls of the mesh, if they are wanted. Throws std::runtime_error.
void write_walls(const Options &o, const Grid &grid, const Surface *mesh, VtkhdfWriter &writer);

}    // namespace flowgrid

#endif
