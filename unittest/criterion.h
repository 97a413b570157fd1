// A criterion of the list of hard cases: checked, and kept in the record of the test with what was
// measured, for tools/cases, which makes the table of the documentation.

#ifndef APF_TEST_CRITERION_H
#define APF_TEST_CRITERION_H

#include "gtest/gtest.h"

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>

// Limits of rounding are those of optimised builds. Where laws are called and not inlined, as with
// sanitizers and for coverage, numbers round otherwise.
#ifdef NDEBUG
constexpr double unoptimised = 1.0;
#else
constexpr double unoptimised = 100.0;
#endif

// Of several of one name in a test the one nearest to a limit is kept. why_not: see expect_unmet.
inline void record_criterion(const std::string &what, double measured, double low, double high,
                             const std::string &why_not = "")
{
  static std::map<std::string, double> margins;
  const auto *test = testing::UnitTest::GetInstance()->current_test_info();
  // an error counts from 0 on: the largest is the worst, not the one that is nearest to 0
  const double span = high > low ? high - low : 1.0;
  const double margin =
      (low == 0.0 ? high - measured : std::min(measured - low, high - measured)) / span;
  const auto known = margins.emplace(test->name() + what, margin);
  if (!known.second && margin >= known.first->second) return;
  known.first->second = margin;
  char numbers[96];
  snprintf(numbers, sizeof(numbers), "%.4g|%.10g|%.10g", measured, low, high);
  testing::Test::RecordProperty(what, numbers + (why_not.empty() ? "" : "|" + why_not));
}

// low <= measured <= high
//   what   begins with the number of the case, as in "C4 missed impacts of 1e5, mts"
inline void expect_criterion(const std::string &what, double measured, double low, double high)
{
  EXPECT_GE(measured, low) << what;
  EXPECT_LE(measured, high) << what;
  record_criterion(what, measured, low, high);
}

// A criterion of the list that is known not to be met, and why not: the row says NO. What is
// measured must be as bad as it is said to be and no worse: should the criterion be met one day,
// the row is to be one of those above.
//   worst   0 < high < measured <= worst
inline void expect_unmet(const std::string &what, double measured, double low, double high,
                         double worst, const std::string &why_not)
{
  EXPECT_GT(measured, high) << what << " is met";
  EXPECT_LE(measured, worst) << what;
  record_criterion(what, measured, low, high, why_not);
}

#endif
