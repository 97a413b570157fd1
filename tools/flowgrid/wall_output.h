// Distances to the walls that the command line names, into the file; what they are worth, on the
// terminal.

#ifndef FLOWGRID_WALL_OUTPUT_H
#define FLOWGRID_WALL_OUTPUT_H

#include "options.h"
#include "vtkhdf_writer.h"

namespace flowgrid {

// Throws std::runtime_error.
void write_walls(const Options &o, const Grid &grid, VtkhdfWriter &writer);

}    // namespace flowgrid

#endif
