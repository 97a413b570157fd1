#include "cloud_sum.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

CloudSum::CloudSum(LAMMPS *lmp, Fix *owner, const CellGrid &_fluid, double _radius, bool _walled,
                   int which) :
    grid(lmp, owner, _fluid.n, 1, which),
    fluid(_fluid), radius(_radius), walled(_walled)
{
  grid.set_up(reach(fluid, radius));
}

int CloudSum::reach(const CellGrid &grid, double radius)
{
  int cells = 1;
  for (int c = 0; c < grid.dimension(); c++)
    cells = std::max(cells, apf::cloud_cells(radius, grid.spacing[c]));
  return cells;
}

// ns for a cell of a cloud, a cell along one of its axes, and a cell of the grid with its ghosts:
// bench/concentration.py
static constexpr double cell_cost = 0.3, axis_cost = 14.0, grid_cost = 4.0;

double CloudSum::cost(const CellGrid &grid, double radius, double particles, bool walled)
{
  double cells = walled ? 2.0 : 1.0, along = 0.0, all = 1.0;
  for (int c = 0; c < grid.dimension(); c++) {
    const int width = 2 * apf::cloud_cells(radius, grid.spacing[c]) + 1;
    cells *= std::min(width, grid.n[c]);
    along += width;
    all *= grid.n[c] + (grid.periodic[c] ? width : 0);
  }
  return particles * (cells * cell_cost + along * axis_cost) + all * grid_cost;
}

/* ---------------------------------------------------------------------- */

bool CloudSum::add(const double *x, double amount)
{
  for (int c = 0; c < 3; c++) {
    const double at = (x[c] - grid.origin[c]) * grid.inverse_spacing[c];
    const int reach = apf::cloud_cells(radius, grid.spacing[c]);
    const int lowest = grid.periodic[c] ? static_cast<int>(std::floor(at)) - reach : 0;
    const int highest = grid.periodic[c] ? lowest + 2 * reach : grid.n[c] - 1;
    weights[c].set(at, radius * grid.inverse_spacing[c], lowest, highest);
    const int end = weights[c].first + static_cast<int>(weights[c].w.size()) - 1;
    if (weights[c].w.empty() || weights[c].first < grid.first[c] || end > grid.last[c])
      return false;
  }
  auto for_lines = [&](auto act) {
    for (size_t z = 0; z < weights[2].w.size(); z++)
      for (size_t y = 0; y < weights[1].w.size(); y++) {
        const double yz = weights[2].w[z] * weights[1].w[y];
        const int cy = weights[1].first + static_cast<int>(y);
        const int cz = weights[2].first + static_cast<int>(z);
        act(yz, grid.at(weights[0].first, cy, cz), fluid.at(weights[0].first, cy, cz));
      }
  };
  const size_t nx = weights[0].w.size();
  const double *wx = weights[0].w.data();
  if (walled) {
    double share = 0.0;
    for_lines([&](double yz, const double *, const double *open) {
      for (size_t k = 0; k < nx; k++) share += yz * wx[k] * open[k];
    });
    if (share == 0.0) return true;    // deep in a wall
    amount /= share;
  }
  for_lines([&](double yz, double *to, const double *open) {
    if (walled)
      for (size_t k = 0; k < nx; k++) to[k] += amount * yz * wx[k] * open[k];
    else
      for (size_t k = 0; k < nx; k++) to[k] += amount * yz * wx[k];
  });
  return true;
}
