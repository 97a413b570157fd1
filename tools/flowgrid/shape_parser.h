// Reads "NAME: SHAPE", as in "step: difference(box(0,0,0, 9,2,1), cylinder(4,2,0, 4,2,1, 0.5))".

#ifndef FLOWGRID_SHAPE_PARSER_H
#define FLOWGRID_SHAPE_PARSER_H

#include "periods.h"
#include "shape_tree.h"

namespace flowgrid {

// Adds the solid to the tree, where it is periodic with the copies of its parts. Throws
// std::runtime_error that points at the word.
void parse_shape(const std::string &text, const Periods &periods, ShapeTree &tree);

// Throws if a name cannot be part of the name of an array.
void check_zone_name(const std::string &name);

}    // namespace flowgrid

#endif
