// Analytic flows on grids, for the tests of gridded flows.

#ifndef APF_TEST_GRIDDED_H
#define APF_TEST_GRIDDED_H

#include "flow/grid_flow.h"
#include "flow/wall_extension.h"

#include <cmath>
#include <functional>
#include <random>

namespace apf {

using Field = std::function<Vec3(const double *)>;

// a field on a grid, as the reader of files makes it
struct Gridded {
  Lattice grid;
  Detail detail;
  std::vector<double> records[2];
  GridFlow flow;

  Gridded(const Lattice &lattice, const Field &u, Detail wanted = Detail::GRADIENT,
          const std::function<double(const double *)> &distance = {}, bool reconstruct = true) :
      grid(lattice),
      detail(wanted)
  {
    fill(0, u, distance, reconstruct);
  }
  void add_frame(const Field &u, double share, double interval)
  {
    fill(1, u, {}, false);
    flow.view.share = share;
    flow.view.per_time = 1.0 / interval;
  }
  void fill(int frame, const Field &u, const std::function<double(const double *)> &distance,
            bool reconstruct)
  {
    std::vector<double> velocity, phi;
    for_each_node(grid, [&](int i, int j, int k, std::size_t) {
      const double x[3] = {grid.origin[0] + i * grid.spacing[0],
                           grid.origin[1] + j * grid.spacing[1],
                           grid.origin[2] + k * grid.spacing[2]};
      if (distance) phi.push_back(distance(x));
      const Vec3 v = distance && !(phi.back() > 0.0) ? Vec3{0, 0, 0} : u(x);
      velocity.insert(velocity.end(), {v.x, v.y, v.z});
    });
    if (distance && reconstruct) WallExtension(grid, phi, velocity).fill();
    records[frame].resize(frame_size(grid, detail));
    write_records(grid, detail, velocity, phi, records[frame].data());
    const GridView old = flow.view;
    flow.view = grid_view(grid, detail);
    flow.view.frame[0] = frame ? old.frame[0] : records[0].data();
    flow.view.frame[1] = frame ? records[1].data() : nullptr;
  }

  FluidBlock at(const std::vector<Vec3> &points, Detail wanted = Detail::GRADIENT,
                bool *inside = nullptr) const
  {
    PointBlock block;
    FluidBlock out;
    block.n = static_cast<int>(points.size());
    for (int l = 0; l < block.n; l++) {
      const double x[3] = {points[l].x, points[l].y, points[l].z};
      block.set(l, x);
    }
    const bool ok = flow.sample(block, wanted, out);
    if (inside) *inside = ok;
    return out;
  }
};

inline Lattice box(int dims, int nx, int ny, int nz, double spacing = 1.0)
{
  Lattice grid{};
  grid.dims = dims;
  const int n[3] = {nx, ny, dims == 2 ? 1 : nz};
  const double aspect[3] = {1.0, 0.7, 1.3};
  for (int k = 0; k < 3; k++) {
    grid.n[k] = n[k];
    grid.origin[k] = dims == 2 && k == 2 ? 0.0 : 0.3 * k - 0.2;
    grid.spacing[k] = spacing * aspect[k];
  }
  return grid;
}

// points all over a grid, its borders among them
inline std::vector<Vec3> points_in(const Lattice &grid, int n, unsigned seed = 1)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> in(0.0, 1.0);
  std::vector<Vec3> points;
  for (int p = 0; p < n; p++) {
    double x[3];
    for (int k = 0; k < 3; k++) {
      const double s = p == 0 ? 0.0 : p == 1 ? 1.0 : in(random);
      x[k] = grid.origin[k] + s * (grid.n[k] - (grid.periodic[k] ? 0 : 1)) * grid.spacing[k];
    }
    points.push_back({x[0], x[1], x[2]});
  }
  return points;
}

inline double component(const Vec3 &a, int k)
{
  return k == 0 ? a.x : k == 1 ? a.y : a.z;
}

inline double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

}    // namespace apf

#endif
