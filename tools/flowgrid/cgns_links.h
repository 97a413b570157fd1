// A CGNS file may have nodes that are in other files, which its library would read, whichever they
// are. They are not trusted with the names, and none is read.

#ifndef FLOWGRID_CGNS_LINKS_H
#define FLOWGRID_CGNS_LINKS_H

#include <string>

namespace flowgrid {

// Both kinds of CGNS files, HDF5 and ADF. Throws std::runtime_error for one that needs another.
void check_cgns_links(const std::string &path);

}    // namespace flowgrid

#endif
