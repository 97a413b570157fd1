// Fields that are linear in space, which a mapping keeps exactly.

#ifndef FLOWGRID_TEST_LINEAR_FIELDS_H
#define FLOWGRID_TEST_LINEAR_FIELDS_H

#include "flow/vtkhdf_file.h"
#include "vector.h"

#include "gtest/gtest.h"

namespace flowgrid {

inline Point velocity(const double *x)
{
  return {1.0 + x[1], 0.5 * x[2] - x[0], 0.25};
}
inline double pressure(const double *x)
{
  return 3.0 - x[0] + 2.0 * x[1];
}

// the linear fields at every node that is inside, read by APF's reader; how many there were
inline int expect_linear(const std::string &file, double scale = 1.0)
{
  const apf::VtkhdfFile hdf(file);
  const auto &g = hdf.grid();
  const auto u = hdf.read("velocity", 3, 0, g.n[2]), p = hdf.read("pressure", 1, 0, g.n[2]),
             inside = hdf.read("inside", 1, 0, g.n[2]);
  int count = 0;
  for (size_t node = 0; node < g.nodes(); node++) {
    const size_t at[3] = {node % g.n[0], node / g.n[0] % g.n[1], node / g.n[0] / g.n[1]};
    double x[3];
    for (int c = 0; c < 3; c++) x[c] = (g.origin[c] + at[c] * g.spacing[c]) / scale;
    if (inside[node] == 0.0) {
      EXPECT_EQ(u[3 * node], 0.0);
      continue;
    }
    count++;
    for (int c = 0; c < 3; c++) EXPECT_NEAR(u[3 * node + c], velocity(x)[c], 1e-12);
    EXPECT_NEAR(p[node], pressure(x), 1e-12);
  }
  return count;
}

}    // namespace flowgrid

#endif
