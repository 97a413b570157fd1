// Rows and lanes. Facts: every number goes where its place says, and nothing else is touched.

#include "flow/lane_rows.h"

#include "gtest/gtest.h"

using namespace apf;

namespace {

constexpr double untouched = -7.0;

}    // namespace

TEST(LaneRows, every_number_goes_to_its_place)
{
  for (const auto &build : lane_rows_builds())
    for (int n = 0; n <= block_width; n++) {
      std::vector<double> rows(3 * (block_width + 1), untouched);
      for (int k = 0; k < 3 * n; k++) rows[k] = k;
      alignas(64) Lanes lanes[3];
      for (auto &of : lanes) std::fill_n(of, block_width, untouched);
      build.functions.take(rows.data(), n, lanes);
      for (int l = 0; l < block_width; l++)
        for (int c = 0; c < 3; c++)
          ASSERT_EQ(lanes[c][l], l < n ? 3 * l + c : untouched) << build.name << n;
      build.functions.add(lanes, n, rows.data());
      for (int k = 0; k < 3 * block_width + 3; k++)
        ASSERT_EQ(rows[k], k < 3 * n ? 2 * k : untouched) << build.name << n;
    }
}

TEST(LaneRows, whole_rows_of_any_width)
{
  alignas(64) Lanes lanes[21];
  for (int c = 0; c < 21; c++)
    for (int l = 0; l < block_width; l++) lanes[c][l] = 100 * l + c;
  std::vector<const Lanes *> from;
  for (const auto &of : lanes) from.push_back(&of);
  for (const auto &build : lane_rows_builds())
    for (int width : {6, 9, 12, 15, 18, 21})
      for (int n : {0, 1, 3, 4, 7, 63, 64}) {
        std::vector<double> rows(21 * (block_width + 1), untouched);
        build.functions.put(from.data(), width, n, rows.data());
        for (int k = 0; k < 21 * (block_width + 1); k++)
          ASSERT_EQ(rows[k], k < n * width ? 100 * (k / width) + k % width : untouched)
              << build.name << width << n;
      }
}

TEST(LaneRows, parts_add_up_to_the_sum)
{
  alignas(64) Lanes lanes;
  for (int l = 0; l < block_width; l++) lanes[l] = l + 1;
  for (const auto &build : lane_rows_builds())
    for (int n = 0; n <= block_width; n++) {
      double parts[sum_parts] = {}, sum = 0.0;
      for (int twice = 0; twice < 2; twice++) build.functions.add_up(lanes, n, parts);
      for (double part : parts) sum += part;
      ASSERT_EQ(sum, n * (n + 1)) << build.name;
    }
}
