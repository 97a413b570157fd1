// A field of the points of a mesh.

#ifndef FLOWGRID_FIELD_H
#define FLOWGRID_FIELD_H

#include <string>
#include <vector>

namespace flowgrid {

struct Field {
  std::string name;
  int components = 0;
  std::vector<double> values;    // components fastest
};

}    // namespace flowgrid

#endif
