// Coordinates in single precision are taken for the decimal numbers that they stand for: 0.006 is
// not exactly the end of a box otherwise.

#ifndef FLOWGRID_DECIMALS_H
#define FLOWGRID_DECIMALS_H

#include <cstdio>
#include <cstdlib>

namespace flowgrid {

inline double as_written(double x)
{
  char digits[32];
  snprintf(digits, sizeof(digits), "%.7g", x);
  return std::strtod(digits, nullptr);
}

}    // namespace flowgrid

#endif
