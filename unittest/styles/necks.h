// Which pairs are in contact, from compute pair/local: contacts that end are counted from lists,
// whatever energy says.

#ifndef APF_TEST_NECKS_H
#define APF_TEST_NECKS_H

#include "simulation.h"

#include <algorithm>
#include <cstdint>
#include <iterator>

using Necks = std::vector<uint64_t>;    // pairs of IDs, sorted

// rows of compute `loc` and the IDs of compute `ids` beside them, on one rank
const std::string local_contacts = "compute loc all pair/local p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11\n"
                                   "compute ids all property/local patom1 patom2\n";

struct LocalRow {
  const double *p;    // p[1] = overlap, as the page of the pair style counts
  uint64_t a, b;      // IDs
};

inline std::vector<LocalRow> contacts_of(Simulation &sim)
{
  const auto of = [&sim](const char *compute, int what) {
    return lammps_extract_compute(sim.lammps(), compute, LMP_STYLE_LOCAL, what);
  };
  auto **row = static_cast<double **>(of("loc", LMP_TYPE_ARRAY));
  auto **ids = static_cast<double **>(of("ids", LMP_TYPE_ARRAY));
  const int rows = *static_cast<int *>(of("loc", LMP_SIZE_ROWS));
  const int columns = *static_cast<int *>(of("loc", LMP_SIZE_COLS));
  std::vector<LocalRow> all;
  for (int r = 0; r < rows; r++) expect_finite(row[r], columns, "compute pair/local");
  for (int r = 0; r < rows; r++)
    if (row[r][1] != 0.0)    // contact radius
      all.push_back(
          {row[r] - 1, static_cast<uint64_t>(ids[r][0]), static_cast<uint64_t>(ids[r][1])});
  return all;
}

inline Necks necks_of(const std::vector<LocalRow> &contacts)
{
  Necks necks;
  for (const auto &one : contacts)
    necks.push_back(std::min(one.a, one.b) << 32 | std::max(one.a, one.b));
  std::sort(necks.begin(), necks.end());
  return necks;
}

// those that are in `before` and not in `now`
inline size_t ended(const Necks &before, const Necks &now)
{
  Necks lost;
  std::set_difference(before.begin(), before.end(), now.begin(), now.end(),
                      std::back_inserter(lost));
  return lost.size();
}

#endif
