#include "level_set.h"
#include "decimals.h"

#include "progress.h"

#include <stdexcept>

namespace flowgrid {

namespace {

  // stage: of so many, for the progress
  template <class Distance>
  std::vector<double> seeds(const Grid &grid, size_t stage, size_t stages, Distance distance)
  {
    std::vector<double> values(grid.nodes());
    size_t node = 0;
    for (int k = 0; k < grid.n[2]; k++)
      for (int j = 0; j < grid.n[1]; j++) {
        show_progress("walls", (stage + 1.0 * node / grid.nodes()) / stages);
        for (int i = 0; i < grid.n[0]; i++) values[node++] = distance(grid.node(i, j, k));
      }
    return values;
  }

  std::string place(const Grid &grid, size_t node)
  {
    std::string text;
    for (int c = 0; c < 3; c++) {
      text += text_of(grid.origin[c] + node % grid.n[c] * grid.spacing[c]) + " ";
      node /= grid.n[c];
    }
    return text;
  }

  // Along periods the last node is the first one again.
  std::vector<double> fill(const Grid &grid, const Periods &periods,
                           const std::vector<double> &known, double band)
  {
    auto lattice = lattice_of(grid);
    for (int c = 0; c < lattice.dims; c++) {
      lattice.periodic[c] = periods.along(c);
      lattice.n[c] -= periods.along(c);
    }
    std::vector<double> different;
    apf::for_each_node(lattice, [&](int i, int j, int k, size_t) {
      different.push_back(known[i + size_t(grid.n[0]) * (j + size_t(grid.n[1]) * k)]);
    });
    const auto filled = apf::FastMarching::fill(lattice, different, band);
    std::vector<double> all;
    for (int k = 0; k < grid.n[2]; k++)
      for (int j = 0; j < grid.n[1]; j++)
        for (int i = 0; i < grid.n[0]; i++)
          all.push_back(filled[lattice.node(i % lattice.n[0], j % lattice.n[1], k % lattice.n[2])]);
    return all;
  }

}    // namespace

LevelSet::LevelSet(const Wall &wall, const Grid &grid, const Periods &periods, double exact,
                   double band)
{
  const auto lattice = lattice_of(grid);
  share_arrays(wall, band);
  const size_t stages = 1 + list.size();
  const auto near = seeds(grid, 0, stages, [&](const Point &x) {
    return wall.distance(x, exact);
  });
  for (const double value : near) seeded += !std::isnan(value);
  if (!seeded) throw std::runtime_error("no wall lies within the grid or near it");
  all = fill(grid, periods, near, band);

  const double tiny = 1e-9 * lattice.spacing[0];
  std::vector<double> least(grid.nodes(), band);
  size_t stage = 0;
  for (auto &array : list) {
    const auto known = seeds(grid, ++stage, stages, [&](const Point &x) {
      double nearest = unknown;
      for (const int piece : array.pieces) {
        const double d = wall.distance(piece, x, exact);
        if (!std::isnan(d) && !(std::fabs(d) >= std::fabs(nearest))) nearest = d;
      }
      return nearest;
    });
    array.values = fill(grid, periods, known, band);
    for (size_t node = 0; node < all.size(); node++) {
      double &value = array.values[node];
      if (all[node] > -tiny && value < -2.0 * tiny) value = band;    // another side of a thin wall
      if (value < least[node]) least[node] = value;
    }
  }
  for (size_t node = 0; node < all.size(); node++)
    if (near[node] > 0.0 && least[node] - near[node] > 1e-3 * lattice.spacing[0])
      throw std::runtime_error(
          "the wall cannot be cut into pieces along its concave creases: near " +
          place(grid, node) + "the wall is " + text_of(near[node]) + " away, its pieces are " +
          text_of(least[node]));
  show_progress("walls", 1.0);
}

// A piece joins the first array of its zone all pieces of which are two bands away.
void LevelSet::share_arrays(const Wall &wall, double band)
{
  const auto &pieces = wall.pieces();
  for (int p = 0; p < static_cast<int>(pieces.size()); p++) {
    DistanceArray *home = nullptr;
    for (auto &array : list) {
      bool fits = pieces[array.pieces[0]].zone == pieces[p].zone;
      for (const int other : array.pieces)
        fits = fits && pieces[other].bounds.distance(pieces[p].bounds) > 2.0 * band;
      if (fits && !home) home = &array;
    }
    if (!home) {
      const auto taken = [&](const std::string &name) {
        return std::any_of(list.begin(), list.end(), [&](const DistanceArray &array) {
          return array.name == name;
        });
      };
      const std::string name = "distance_" + pieces[p].zone;
      std::string free = name;
      for (int number = 2; taken(free); number++) free = name + "_" + std::to_string(number);
      list.emplace_back();
      home = &list.back();
      home->name = free;
    }
    home->pieces.push_back(p);
    home->surface_error = std::max(home->surface_error, pieces[p].surface_error);
  }
  if (list.size() > most_arrays)
    throw std::runtime_error("the wall has " + std::to_string(list.size()) +
                             " pieces between concave creases, more than " +
                             std::to_string(most_arrays) +
                             " arrays; a larger --crease makes fewer");
}

}    // namespace flowgrid
