// The words of the command line.

#ifndef FLOWGRID_OPTIONS_H
#define FLOWGRID_OPTIONS_H

#include "vector.h"

#include <array>
#include <string>

namespace flowgrid {

struct Options {
  std::string input;    // empty: a geometry without a flow
  std::string output, velocity, pressure, times = "last", solution, isosurface;
  std::vector<double> spacing, bounds;
  std::vector<std::string> walls, shapes, surfaces;
  std::vector<double> fluid_at;
  double planar = NAN, scale = 1.0;
  double particle = 0.0;    // largest diameter, 0 if it is not known                  [length]
  double exact = 0.0;       // distances that are exact, 0: default                    [length]
  double band = 20.0;       // [cells]
  double crease = 30.0;     // [degrees]
  std::array<bool, 3> periodic{};    // walls go on beyond the grid as at its other end
  bool compress = false, mesh_walls = false;

  bool has_walls() const { return mesh_walls || !shapes.empty() || !surfaces.empty(); }
};

// Ends the program with status 2 for wrong words, with 0 after --help.
Options parse(int argc, char **argv);
[[noreturn]] void usage(const std::string &why);
double number(const std::string &option, const char *word);

}    // namespace flowgrid

#endif
