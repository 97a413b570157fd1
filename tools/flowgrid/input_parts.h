// The files that an input consists of. A file that names others, as a .vtm does, is not trusted
// with the names: it may name only what is in its own folder or below, and nothing is read that is
// not a regular file.

#ifndef FLOWGRID_INPUT_PARTS_H
#define FLOWGRID_INPUT_PARTS_H

#include <string>

namespace flowgrid {

// That it is there and is a regular file: a pipe would be waited for, a device has no end. Throws
// std::runtime_error.
void check_is_file(const std::string &path);

// Whether a name, which goes on from the folder of the file that holds it, stays in that folder or
// below.
bool is_below(const std::string &name);

// Bytes of a file and of those that it names, or of all in the folder of an OpenFOAM case, each
// file once; INFINITY if they are not known. Throws std::runtime_error for a name that leaves the
// folder, a file that is a block of itself, and what is not a regular file.
double bytes_of_input(const std::string &path);

}    // namespace flowgrid

#endif
