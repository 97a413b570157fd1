// Gridded flows without LAMMPS. Facts: linear fields are interpolated exactly, smooth ones to second
// order, periodic ones repeat, solenoidal ones stay so; no-slip at walls that cross the grid.

#include "flow/grid_flow.h"
#include "flow/wall_extension.h"

#include "gtest/gtest.h"

#include <cmath>
#include <functional>
#include <random>

using namespace apf;

namespace {

constexpr double pi = 3.14159265358979323846;

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

Lattice box(int dims, int nx, int ny, int nz, double spacing = 1.0)
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
std::vector<Vec3> points_in(const Lattice &grid, int n, unsigned seed = 1)
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

double component(const Vec3 &a, int k)
{
  return k == 0 ? a.x : k == 1 ? a.y : a.z;
}

}    // namespace

TEST(GridFlow, linear_field_is_exact)
{
  const double A[3][3] = {{0.4, -1.1, 0.6}, {2.0, 0.3, -0.8}, {-0.5, 0.9, 1.7}};
  for (int dims : {2, 3})
    for (int n : {2, 3, 9}) {
      const auto u = [&](const double *x) {
        Vec3 r{0.1, -0.2, 0.3};
        for (int k = 0; k < dims; k++)
          r = r + x[k] * Vec3{A[0][k], A[1][k], dims == 3 ? A[2][k] : 0.0};
        return dims == 3 ? r : Vec3{r.x, r.y, 0.0};
      };
      const Gridded field(box(dims, n, n + 1, n + 2), u);
      const auto points = points_in(field.grid, 61);
      const auto out = field.at(points);
      for (int l = 0; l < 61; l++) {
        const double x[3] = {points[l].x, points[l].y, points[l].z};
        for (int a = 0; a < 3; a++) {
          EXPECT_NEAR(out.velocity[a][l], component(u(x), a), 1e-12);
          for (int b = 0; b < 3; b++)
            EXPECT_NEAR(out.gradient[a][b][l], a < dims && b < dims ? A[a][b] : 0.0, 1e-12);
          EXPECT_EQ(out.rate[a][l], 0.0);
        }
        EXPECT_NEAR(out.vorticity[2][l], A[1][0] - A[0][1], 1e-12);
        EXPECT_NEAR(out.vorticity[0][l], dims == 3 ? A[2][1] - A[1][2] : 0.0, 1e-12);
        EXPECT_NEAR(out.vorticity[1][l], dims == 3 ? A[0][2] - A[2][0] : 0.0, 1e-12);
      }
    }
}
