#include "wall_report.h"

#include "progress.h"

#include "../../src/wall/grid_distance.h"

#include <random>

namespace flowgrid {

WallQuality wall_quality(const Wall &wall, const Grid &grid, const LevelSet &levels,
                         const DistanceArray &array, double low, double high, double band)
{
  constexpr size_t most = 100000;    // points looked at
  const auto lattice = lattice_of(grid);
  std::vector<double> coefficients(apf::GridDistance::size(lattice));
  const auto jumps =
      apf::GridDistance::write_coefficients(lattice, array.values, coefficients.data());
  const apf::GridDistance field(lattice, coefficients.data(), jumps);

  // nodes with three cells of the band around them
  std::vector<size_t> nodes;
  const double widest =
      *std::max_element(grid.spacing.begin(), grid.spacing.begin() + lattice.dims);
  for (size_t node = 0; node < grid.nodes(); node++)
    if (array.values[node] > 0.0 && array.values[node] < band - 3.0 * widest &&
        levels.whole()[node] > 0.0)
      nodes.push_back(node);
  WallQuality q;
  if (nodes.empty()) return q;

  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> offset(-0.5, 0.5);
  double sum = 0.0;
  size_t count = 0;
  const size_t step = std::max<size_t>(nodes.size() / most, 1);
  for (size_t n = 0; n < nodes.size(); n += step) {
    if (count % 1024 == 0) show_progress("checking", 1.0 * n / nodes.size());
    const size_t node = nodes[n];
    Point x = grid.node(static_cast<int>(node % grid.n[0]),
                        static_cast<int>(node / grid.n[0] % grid.n[1]),
                        static_cast<int>(node / lattice.stride(2)));
    for (int c = 0; c < lattice.dims; c++) {
      const double end = grid.origin[c] + (grid.n[c] - 1) * grid.spacing[c];
      x[c] += offset(random) * grid.spacing[c];
      x[c] = std::min(std::max(x[c], grid.origin[c]), end);
    }
    Point slope;
    const double phi = field.distance(x.data(), slope.data());
    const double off = std::fabs(length(slope) - 1.0);
    q.slope_max = std::max(q.slope_max, off);
    sum += off * off;
    count++;
    if (phi < low || phi > high) continue;
    double exact = unknown;
    for (const int piece : array.pieces) {
      const double d = wall.distance(piece, x, 1.5 * high);
      if (!std::isnan(d) && !(std::fabs(d) >= std::fabs(exact))) exact = d;
    }
    if (!std::isfinite(exact)) continue;
    q.points++;
    if (std::fabs(phi - exact) <= q.error) continue;
    q.error = std::fabs(phi - exact);
    q.error_at = x;
  }
  q.slope_rms = std::sqrt(sum / count);
  show_progress("checking", 1.0);
  return q;
}

// Midway between walls that face each other the slopes from both sides cancel; at a corner of 90
// degrees 0.71 of them is left.
Narrows find_narrows(const Grid &grid, const std::vector<double> &distance, double diameter)
{
  constexpr double cancels = 0.5;
  const auto lattice = lattice_of(grid);
  Narrows found;
  apf::for_each_node(lattice, [&](int i, int j, int k, size_t node) {
    const double phi = distance[node];
    if (std::fabs(phi) > 0.5 * diameter) return;
    const int at[3] = {i, j, k};
    double squared = 0.0, widest = 0.0;
    for (int c = 0; c < lattice.dims; c++) {
      if (at[c] == 0 || at[c] == grid.n[c] - 1) return;
      const auto s = lattice.stride(c);
      const double slope = (distance[node + s] - distance[node - s]) / (2.0 * grid.spacing[c]);
      squared += slope * slope;
      widest = std::max(widest, grid.spacing[c]);
    }
    if (squared > cancels * cancels) return;
    double &least = phi > 0.0 ? found.gap : found.solid;
    if (2.0 * std::fabs(phi) >= least) return;
    least = 2.0 * std::fabs(phi);
    (phi > 0.0 ? found.gap_at : found.solid_at) = grid.node(i, j, k);
  });
  return found;
}

}    // namespace flowgrid
