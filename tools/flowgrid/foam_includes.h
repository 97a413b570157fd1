// Files of an OpenFOAM case have VTK read others by #include, #sinclude and #includeIfPresent; of
// other directives, as #includeEtc, #calc or #codeStream, it reads no file and runs nothing. They
// are not trusted with the names: only what is in the folder of the case is included.

#ifndef FLOWGRID_FOAM_INCLUDES_H
#define FLOWGRID_FOAM_INCLUDES_H

#include <string>

namespace flowgrid {

// Looks at all files of a case that VTK may read, and at those that they include. Throws
// std::runtime_error for a name that leaves the case, or cannot be told, and for what is not a
// regular file.
void check_includes(const std::string &folder);

}    // namespace flowgrid

#endif
