// Pairs of bodies near enough to touch before the next look at the neighbour list, and which of
// them are in contact. Finding first touches costs one distance per pair and step.

#ifndef APF_CANDIDATES_H
#define APF_CANDIDATES_H

#include "../timestep/look_ahead.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace apf {

struct Candidates {
  std::vector<int> i, j;        // rows of the two bodies
  std::vector<double> touch;    // r_i + r_j                                  [length]
  std::vector<char> closed;     // in contact
  std::vector<int> near;        // pairs that may touch within the present particle step

  int size() const { return static_cast<int>(i.size()); }

  void clear()
  {
    i.clear();
    j.clear();
    touch.clear();
    closed.clear();
    near.clear();
  }

  void reserve(int pairs)
  {
    i.reserve(pairs);
    j.reserve(pairs);
    touch.reserve(pairs);
    closed.reserve(pairs);
  }

  int add(int body_i, int body_j, double radius_sum)
  {
    i.push_back(body_i);
    j.push_back(body_j);
    touch.push_back(radius_sum);
    closed.push_back(0);
    return size() - 1;
  }

  // calls touches(k) for every pair that is not closed and overlaps
  template <class Row, class Action> void detect(const Row *rows, Action touches) const
  {
    constexpr int together = 8;    // most pairs of an aggregate are closed: these at a glance
    static constexpr char all_closed[together] = {1, 1, 1, 1, 1, 1, 1, 1};
    const int n = size();
    for (int first = 0; first < n; first += together) {
      const int end = std::min(first + together, n);
      if (end - first == together && std::memcmp(&closed[first], all_closed, together) == 0)
        continue;
      for (int k = first; k < end; k++)
        if (!closed[k] && overlap(k, rows)) touches(k);
    }
  }
  // the same for the pairs near each other
  template <class Row, class Action> void detect_near(const Row *rows, Action touches) const
  {
    for (const int k : near)
      if (overlap(k, rows) && !closed[k]) touches(k);
  }

  // Look-ahead, first part: bodies that touch or approach become active; those pairs come into
  // `near`, and pairs that may meet if one is struck into `perhaps`.
  template <class Row> void find_approaching(const Row *rows, LookAhead &ahead)
  {
    near.clear();
    perhaps.clear();
    const double farthest = ahead.farthest();
    for (int k = 0; k < size(); k++) {
      const Row &a = rows[i[k]], &b = rows[j[k]];
      const double most = touch[k] + farthest;
      if (distance2(a, b) > most * most) continue;
      const auto approach = Approach::of(a, b, touch[k]);
      if (closed[k] || approach.gap <= ahead.distance(approach.closing_speed)) {
        ahead.meet(i[k], approach.relative_speed, ahead.speed_of(rows, i[k]));
        ahead.meet(j[k], approach.relative_speed, ahead.speed_of(rows, j[k]));
        if (!closed[k]) {
          near.push_back(k);
          ahead.approach(approach);
        }
      } else {
        const double i_to_j = speed_towards(a, b, ahead.frame);
        perhaps.push_back({k, approach.gap, i_to_j, approach.closing_speed - i_to_j});
      }
    }
  }

  // Second part, when the activities of all bodies and the swiftest of them are known; returns
  // whether bodies have become active by it, and others may therefore follow.
  template <class Row> bool find_near(const Row *rows, LookAhead &ahead)
  {
    bool any = false;
    for (bool more = true; more;) {
      more = false;
      size_t left = 0;
      for (const auto &pair : perhaps) {
        const int a = i[pair.k], b = j[pair.k];
        const double after = ahead.after_impacts();
        const double speed_a = ahead.free(a) ? pair.i_to_j : after;
        const double speed_b = ahead.free(b) ? pair.j_to_i : after;
        if ((ahead.free(a) && ahead.free(b)) ||
            pair.gap > ahead.distance_if_struck(speed_a, speed_b)) {
          perhaps[left++] = pair;
          continue;
        }
        more |= ahead.free(a) || ahead.free(b);
        near.push_back(pair.k);
        ahead.come_near(a, ahead.speed_of(rows, a));
        ahead.come_near(b, ahead.speed_of(rows, b));
      }
      perhaps.resize(left);
      any |= more;
    }
    return any;
  }

  // [bytes]
  double memory_usage() const
  {
    return i.capacity() * (2.0 * sizeof(int) + sizeof(double) + sizeof(char)) +
        near.capacity() * sizeof(int) + perhaps.capacity() * sizeof(Pair);
  }

 private:
  struct Pair {
    int k;
    double gap;               // [length]
    double i_to_j, j_to_i;    // speeds towards each other in the frame    [velocity]
  };
  std::vector<Pair> perhaps;

  template <class Row> static double distance2(const Row &a, const Row &b)
  {
    double sum = 0.0;
    for (int c = 0; c < Row::dim; c++) sum += (b.x[c] - a.x[c]) * (b.x[c] - a.x[c]);
    return sum;
  }
  template <class Row> static double speed_towards(const Row &a, const Row &b, const double *frame)
  {
    double sum = 0.0;
    for (int c = 0; c < Row::dim; c++) sum += (b.x[c] - a.x[c]) * (a.v[c] - frame[c]);
    return sum / std::sqrt(distance2(a, b));
  }
  template <class Row> bool overlap(int k, const Row *rows) const
  {
    return distance2(rows[i[k]], rows[j[k]]) <= touch[k] * touch[k];
  }
};

}    // namespace apf

#endif
