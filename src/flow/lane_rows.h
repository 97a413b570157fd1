// Rows of numbers, one row a particle as particle codes keep them, to the arrays of a block and
// back. Compiled for several instruction sets.

#ifndef APF_LANE_ROWS_H
#define APF_LANE_ROWS_H

#include "fluid_block.h"

#include <vector>

namespace apf {

constexpr int sum_parts = 16;

struct LaneRows {
  // n rows of three numbers, one after another; to and from: three arrays
  void (*take)(const double *rows, int n, Lanes *to);
  void (*add)(const Lanes *from, int n, double *rows);
  // whole rows of `width` >= 4 numbers, from as many arrays
  void (*put)(const Lanes *const *from, int width, int n, double *rows);
  // adds n numbers to parts of a sum: additions need not wait for each other
  void (*add_up)(const Lanes &, int n, double *parts);
};

struct LaneRowsBuild {
  const char *name;
  LaneRows functions;
};
const std::vector<LaneRowsBuild> &lane_rows_builds();
LaneRows lane_rows();

}    // namespace apf

#endif
