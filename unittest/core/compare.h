// Arrays of numbers beside each other.

#ifndef APF_TEST_COMPARE_H
#define APF_TEST_COMPARE_H

#include "criterion.h"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace apf_test {

constexpr double rounding_of_builds = 1e-12 * unoptimised;    // of the kernels

// The larger one; infinite if either is no number, which std::max would pass over.
inline double larger(double a, double b)
{
  return std::isnan(a) || std::isnan(b) ? HUGE_VAL : std::max(a, b);
}

inline double largest(const std::vector<double> &values)
{
  double m = 0.0;
  for (const double value : values) m = larger(m, std::fabs(value));
  return m;
}

// Rows of some components each, for instance the forces on bodies, beside each other.
//   scale      of each row, for instance the sum of the magnitudes of what acts on the body; where
//              it is 0 the two are the same
//   tolerance  of that
inline void expect_same(const std::vector<double> &a, const std::vector<double> &b,
                        const std::vector<double> &scale, double tolerance)
{
  ASSERT_EQ(a.size(), b.size());
  ASSERT_FALSE(scale.empty());
  const size_t components = a.size() / scale.size();
  for (size_t c = 0; c < a.size(); c++)
    ASSERT_LE(std::fabs(a[c] - b[c]), tolerance * scale[c / components])
        << a[c] << " and " << b[c] << ", component " << c % components << " of row "
        << c / components;
}

}    // namespace apf_test

#endif
