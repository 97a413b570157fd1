// How much the velocities of bodies that are near each other differ, where those of all differ too
// much, as across a large box that is sheared.

#ifndef APF_SPREAD_NEARBY_H
#define APF_SPREAD_NEARBY_H

#include "look_ahead.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace apf {

// No two bodies within reach of each other differ by more. By bins that are at least as wide, and
// few, so that a look costs little more than a pass over all.
//   Rows    x[i][c], v[i][c] of n bodies                                  [length], [velocity]
template <class Places, class Velocities>
double spread_nearby(const Places &x, const Velocities &v, int n, double reach)
{
  constexpr int most_bins = 32;    // along an axis
  if (n == 0) return 0.0;
  double low[3], per_bin[3];
  int bins[3];
  for (int c = 0; c < 3; c++) {
    double high = low[c] = x[0][c];
    for (int i = 1; i < n; i++) {
      low[c] = std::min(low[c], x[i][c]);
      high = std::max(high, x[i][c]);
    }
    const double length = high - low[c];
    bins[c] = std::clamp(static_cast<int>(std::min(length / reach, 1.0 * most_bins)), 1, most_bins);
    per_bin[c] = length > 0.0 ? bins[c] / length : 0.0;
  }
  const auto index = [&](const int(&at)[3]) {
    return (at[2] * bins[1] + at[1]) * bins[0] + at[0];
  };

  std::vector<VelocityRange> ranges(bins[0] * bins[1] * bins[2]);
  for (int i = 0; i < n; i++) {
    int at[3];
    for (int c = 0; c < 3; c++)
      at[c] = std::min(static_cast<int>((x[i][c] - low[c]) * per_bin[c]), bins[c] - 1);
    ranges[index(at)].include(v[i]);
  }

  double most = 0.0;
  int at[3], by[3];
  for (at[2] = 0; at[2] < bins[2]; at[2]++)
    for (at[1] = 0; at[1] < bins[1]; at[1]++)
      for (at[0] = 0; at[0] < bins[0]; at[0]++) {
        const auto &own = ranges[index(at)];
        if (own.empty()) continue;
        VelocityRange around;
        for (by[2] = -1; by[2] <= 1; by[2]++)
          for (by[1] = -1; by[1] <= 1; by[1]++)
            for (by[0] = -1; by[0] <= 1; by[0]++) {
              const int other[3] = {at[0] + by[0], at[1] + by[1], at[2] + by[2]};
              bool inside = true;
              for (int c = 0; c < 3; c++) inside = inside && other[c] >= 0 && other[c] < bins[c];
              if (inside) around.include(ranges[index(other)]);
            }
        most = std::max(most, own.spread(around));
      }
  return most;
}

}    // namespace apf

#endif
