// Numbers as people write them. Coordinates in single precision are taken for the decimal numbers
// that they stand for: 0.006 is not exactly the end of a box otherwise.

#ifndef FLOWGRID_DECIMALS_H
#define FLOWGRID_DECIMALS_H

#include <cstdio>
#include <cstdlib>
#include <string>

namespace flowgrid {

inline std::string text_of(double x)
{
  char digits[32];
  snprintf(digits, sizeof(digits), "%.7g", x);
  return digits;
}

inline double as_written(double x)
{
  return std::strtod(text_of(x).c_str(), nullptr);
}

}    // namespace flowgrid

#endif
