// Pairs of bodies near enough to touch before the next look at the neighbour list, and which of
// them are in contact. Finding first touches costs one distance per pair and step.

#ifndef APF_CANDIDATES_H
#define APF_CANDIDATES_H

#include <vector>

namespace apf {

struct Candidates {
  std::vector<int> i, j;         // rows of the two bodies
  std::vector<double> touch2;    // (r_i + r_j)^2                            [length^2]
  std::vector<char> closed;      // in contact

  int size() const { return static_cast<int>(i.size()); }

  void clear()
  {
    i.clear();
    j.clear();
    touch2.clear();
    closed.clear();
  }

  int add(int body_i, int body_j, double radius_sum)
  {
    i.push_back(body_i);
    j.push_back(body_j);
    touch2.push_back(radius_sum * radius_sum);
    closed.push_back(0);
    return size() - 1;
  }

  // calls touches(k) for every pair that is not closed and overlaps; x is [rows][3], contiguous
  template <class Action> void detect(const double *x, Action touches) const
  {
    for (int k = 0; k < size(); k++) {
      const double *xi = x + 3 * i[k], *xj = x + 3 * j[k];
      const double dx = xj[0] - xi[0], dy = xj[1] - xi[1], dz = xj[2] - xi[2];
      if (dx * dx + dy * dy + dz * dz <= touch2[k] && !closed[k]) touches(k);
    }
  }

  // [bytes]
  double memory_usage() const
  {
    return i.capacity() * (2.0 * sizeof(int) + sizeof(double) + sizeof(char));
  }
};

}    // namespace apf

#endif
