// Signed distance in a band around a wall, from its values at nodes near the wall.
//
//   |grad phi| = 1
//
// is solved from the known nodes outward in the order of |phi|, by upwind differences of second
// order, (3 phi - 4 phi_1 + phi_2)/2h, where both nodes upwind are known and the farther one is
// nearer to the wall; else of first order. The node of smallest |phi| is found by a heap, so the
// cost is n log n. Both sides of the wall are marched at once, each from nodes of its own sign.
// J. A. Sethian, PNAS 93, 1591 (1996), doi:10.1073/pnas.93.4.1591
// J. A. Sethian, SIAM Review 41, 199 (1999), doi:10.1137/S0036144598347059

#ifndef APF_FAST_MARCHING_H
#define APF_FAST_MARCHING_H

#include "../flow/lattice.h"

#include <cmath>
#include <functional>
#include <limits>
#include <queue>
#include <utility>
#include <vector>

namespace apf {

class FastMarching {
 public:
  static constexpr int default_band = 20;    // cells

  // seeds: signed distance at nodes where it is known, NaN at others                  [length]
  // Returns it at all nodes; those of |phi| > band get band with the sign of their side. Seeds keep
  // their value, except beyond the band. Without any seed all nodes get +band.
  static std::vector<double> fill(const Lattice &grid, const std::vector<double> &seeds,
                                  double band)
  {
    FastMarching march(grid, seeds, band);
    march.run();
    march.set_far_nodes();
    return std::move(march.phi);
  }

 private:
  enum class State : char { far, trial, known };
  using Entry = std::pair<double, std::size_t>;    // |phi|, node

  const Lattice &grid;
  const double band;
  std::vector<double> phi;
  std::vector<State> state;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> nearest;

  FastMarching(const Lattice &grid, const std::vector<double> &seeds, double band) :
      grid(grid), band(band), phi(seeds), state(seeds.size(), State::far)
  {
    for (std::size_t node = 0; node < phi.size(); node++)
      if (!std::isnan(phi[node])) state[node] = State::known;
    for (std::size_t node = 0; node < phi.size(); node++)
      if (state[node] == State::known) update_around(node);
  }

  // An entry is stale if its node has become known, or nearer than when it was pushed.
  void run()
  {
    while (!nearest.empty()) {
      const auto [distance, node] = nearest.top();
      nearest.pop();
      if (distance > band) return;
      if (state[node] == State::known || distance > std::fabs(phi[node])) continue;
      state[node] = State::known;
      update_around(node);
    }
  }

  // node some steps away along an axis, -1 beyond the border
  std::ptrdiff_t neighbor(std::size_t node, int axis, int steps) const
  {
    const std::size_t stride = grid.stride(axis);
    const int i = static_cast<int>(node / stride % grid.n[axis]);
    const int to = grid.wrap(axis, i + steps);
    return to < 0 ? -1 : std::ptrdiff_t(node) + (to - i) * std::ptrdiff_t(stride);
  }

  void update_around(std::size_t node)
  {
    const double side = std::signbit(phi[node]) ? -1.0 : 1.0;
    for (int axis = 0; axis < grid.dims; axis++)
      for (const int step : {-1, 1}) {
        const auto next = neighbor(node, axis, step);
        if (next < 0 || state[next] == State::known) continue;
        const double distance = solve(next, side);
        if (state[next] == State::trial && distance >= std::fabs(phi[next])) continue;
        state[next] = State::trial;
        phi[next] = side * distance;
        nearest.push({distance, next});
      }
  }

  // What an axis adds to the equation: (slope phi - rest)^2
  struct Upwind {
    double first;          // |phi| of the next node upwind
    double slope, rest;    // of the difference, of either order
  };

  // |phi| from known nodes upwind that lie on a side of the wall
  double solve(std::size_t node, double side) const
  {
    Upwind upwind[3], low[3];
    int n = 0;
    for (int axis = 0; axis < grid.dims; axis++) {
      const double h = grid.spacing[axis];
      double first = std::numeric_limits<double>::infinity(), second = first;
      for (const int step : {-1, 1}) {
        const double one = known(neighbor(node, axis, step), side);
        if (!(one < first)) continue;
        first = one;
        second = known(neighbor(node, axis, 2 * step), side);
      }
      if (std::isinf(first)) continue;
      low[n] = upwind[n] = {first, 1.0 / h, first / h};
      if (second <= first) upwind[n] = {first, 1.5 / h, (2.0 * first - 0.5 * second) / h};
      n++;
    }
    const double distance = root(upwind, n);
    return distance >= 0.0 ? distance : root(low, n);
  }

  double known(std::ptrdiff_t node, double side) const
  {
    if (node < 0 || state[node] != State::known || std::signbit(phi[node]) != (side < 0.0))
      return std::numeric_limits<double>::infinity();
    return std::fabs(phi[node]);
  }

  // Root of sum (slope phi - rest)^2 = 1 over the axes whose nodes upwind are nearer to the wall
  // than itself: the farthest are left out until this is so. -1 if there is none.
  static double root(Upwind *axes, int n)
  {
    for (int k = 1; k < n; k++)
      for (int m = k; m > 0 && axes[m].first < axes[m - 1].first; m--)
        std::swap(axes[m], axes[m - 1]);
    for (; n > 0; n--) {
      double a = 0.0, b = 0.0, c = -1.0;
      for (int k = 0; k < n; k++) {
        a += axes[k].slope * axes[k].slope;
        b += axes[k].slope * axes[k].rest;
        c += axes[k].rest * axes[k].rest;
      }
      const double square = b * b - a * c;
      if (square < 0.0) continue;
      const double distance = (b + std::sqrt(square)) / a;
      if (distance >= axes[n - 1].first) return distance;
    }
    return -1.0;
  }

  // Nodes that were not reached: on which side they are spreads from those that were.
  void set_far_nodes()
  {
    std::vector<std::size_t> border;
    for (std::size_t node = 0; node < phi.size(); node++) {
      if (state[node] != State::far) border.push_back(node);
      if (std::fabs(phi[node]) > band) phi[node] = std::copysign(band, phi[node]);
    }
    while (!border.empty()) {
      const std::size_t node = border.back();
      border.pop_back();
      for (int axis = 0; axis < grid.dims; axis++)
        for (const int step : {-1, 1}) {
          const auto next = neighbor(node, axis, step);
          if (next < 0 || state[next] != State::far) continue;
          state[next] = State::known;
          phi[next] = std::copysign(band, phi[node]);
          border.push_back(next);
        }
    }
    for (double &value : phi)
      if (std::isnan(value)) value = band;
  }
};

}    // namespace apf

#endif
