// Spheres sorted into cells, to ask whether another would touch one of them. Only cells that hold a
// sphere take memory. A periodic direction is wrapped.

#ifndef APF_SPHERE_GRID_H
#define APF_SPHERE_GRID_H

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <vector>

namespace apf {

class SphereGrid {
 public:
  // period: length of the box along each axis, 0 if not periodic [length]; reach: centres farther
  // apart than this are never asked about [length]
  SphereGrid(const double *period, double reach)
  {
    for (int c = 0; c < 3; c++) {
      length[c] = period[c];
      count[c] = std::max(1.0, std::min(std::floor(period[c] / reach), double(1 << 20)));
      size[c] = period[c] > 0.0 ? period[c] / count[c] : reach;
    }
  }

  void add(const double *x, double radius)
  {
    int64_t cell[3];
    locate(x, cell);
    const auto [place, is_new] = first.try_emplace(key(cell), -1);
    spheres.push_back({{x[0], x[1], x[2]}, radius, place->second});
    place->second = static_cast<int>(spheres.size()) - 1;
  }

  // whether all surfaces are at least `gap` away from that of a sphere at x
  bool is_free(const double *x, double radius, double gap) const
  {
    int64_t home[3];
    locate(x, home);
    for (int n = 0; n < 27; n++) {
      int64_t cell[3] = {home[0] + n / 9 - 1, home[1] + n / 3 % 3 - 1, home[2] + n % 3 - 1};
      const auto found = first.find(key(cell));
      if (found == first.end()) continue;
      for (int s = found->second; s >= 0; s = spheres[s].next) {
        const double least = radius + spheres[s].radius + gap;
        if (distance2(x, spheres[s].x) < least * least) return false;
      }
    }
    return true;
  }

 private:
  struct Sphere {
    double x[3], radius;
    int next;    // in the same cell, -1 at the end
  };
  double length[3], count[3], size[3];
  std::vector<Sphere> spheres;
  std::unordered_map<int64_t, int> first;    // sphere of a cell

  void locate(const double *x, int64_t *cell) const
  {
    for (int c = 0; c < 3; c++) cell[c] = static_cast<int64_t>(std::floor(x[c] / size[c]));
  }

  int64_t key(const int64_t *cell) const
  {
    int64_t result = 0;
    for (int c = 0; c < 3; c++) {
      const auto n = static_cast<int64_t>(count[c]);
      const int64_t wrapped = length[c] > 0.0 ? (cell[c] % n + n) % n : cell[c];
      result = (result << 21) | (wrapped & 0x1fffff);
    }
    return result;
  }

  double distance2(const double *a, const double *b) const
  {
    double sum = 0.0;
    for (int c = 0; c < 3; c++) {
      double d = a[c] - b[c];
      if (length[c] > 0.0) d -= length[c] * std::round(d / length[c]);
      sum += d * d;
    }
    return sum;
  }
};

}    // namespace apf

#endif
