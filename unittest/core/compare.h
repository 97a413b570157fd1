// Arrays of numbers beside each other.

#ifndef APF_TEST_COMPARE_H
#define APF_TEST_COMPARE_H

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace apf_test {

inline double largest(const std::vector<double> &values)
{
  double m = 0.0;
  for (const double value : values) m = std::max(m, std::fabs(value));
  return m;
}

// tolerance: of the largest of b
inline void expect_same(const std::vector<double> &a, const std::vector<double> &b,
                        double tolerance)
{
  const double scale = largest(b) + 1e-30;
  for (size_t c = 0; c < a.size(); c++)
    ASSERT_NEAR((a[c] - b[c]) / scale, 0.0, tolerance) << "component " << c;
}

}    // namespace apf_test

#endif
