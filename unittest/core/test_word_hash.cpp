// What a hash is to tell apart: other diameters of all particles, of one, and two that are swapped.

#include "flow/word_hash.h"

#include "gtest/gtest.h"

#include <cmath>
#include <random>
#include <vector>

using apf::WordHash;

namespace {

// radii, masses and types of spheres of density 1
WordHash of(const std::vector<double> &radii)
{
  const int n = static_cast<int>(radii.size());
  std::vector<double> masses;
  masses.reserve(n);
  for (const double r : radii) masses.push_back(4.0 / 3.0 * M_PI * r * r * r);
  const std::vector<int> types(n, 1);
  return WordHash(n).add(radii.data(), n).add(masses.data(), n).add(types.data(), n);
}

// Powers of two change exponents alone.
TEST(WordHash, all_diameters_changed_are_told_apart)
{
  int same = 0;
  for (int n = 1; n <= 3000; n++)
    for (const double factor : {2.0, 4.0, 0.5, 1.5})
      same += of(std::vector<double>(n, 0.5)) == of(std::vector<double>(n, 0.5 * factor));
  EXPECT_EQ(same, 0);
  for (const int n : {1631, 4096, 100000})
    EXPECT_FALSE(of(std::vector<double>(n, 0.5)) == of(std::vector<double>(n, 1.0))) << n;
}

TEST(WordHash, one_diameter_changed_and_two_swapped_are_told_apart)
{
  std::mt19937 random(1);
  int same = 0, tried = 0;
  while (tried < 20000) {
    std::vector<double> radii(20 + random() % 200);
    for (double &r : radii) r = random() % 2 ? 0.5 : 1.0;
    auto other = radii;
    const size_t i = random() % radii.size(), j = random() % radii.size();
    if (tried % 2)
      std::swap(other[i], other[j]);
    else
      other[i] *= 2.0;
    if (other == radii) continue;
    tried++;
    same += of(radii) == of(other);
  }
  EXPECT_EQ(same, 0);
  const std::vector<double> radii(10, 0.5);
  EXPECT_TRUE(of(radii) == of(radii));
}

}    // namespace
