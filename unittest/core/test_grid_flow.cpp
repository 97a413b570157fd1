// Gridded flows without LAMMPS. Facts: linear fields are interpolated exactly, smooth ones to
// second order, periodic ones repeat, solenoidal ones stay so; no-slip at walls that cross the
// grid.

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

namespace {

// a smooth field without divergence, in the plane if dims is 2
struct Swirl {
  int dims;
  Vec3 operator()(const double *x) const
  {
    const double z = dims == 3 ? x[2] : 0.0;
    return {std::sin(x[0]) * std::cos(x[1]) * std::cos(z),
            -std::cos(x[0]) * std::sin(x[1]) * std::cos(z),
            dims == 3 ? std::cos(2.0 * x[0]) * std::sin(x[1]) : 0.0};
  }
  double slope(const double *x, int a, int b) const
  {
    const double e = 1e-5;
    double right[3] = {x[0], x[1], x[2]}, left[3] = {x[0], x[1], x[2]};
    right[b] += e;
    left[b] -= e;
    return (component((*this)(right), a) - component((*this)(left), a)) / (2.0 * e);
  }
};

struct Errors {
  double velocity = 0.0, gradient = 0.0, divergence = 0.0;    // largest ones
};

Errors errors_of(const Gridded &field, const Swirl &u, const std::vector<Vec3> &points)
{
  Errors worst;
  const auto out = field.at(points);
  for (std::size_t l = 0; l < points.size(); l++) {
    const double x[3] = {points[l].x, points[l].y, points[l].z};
    double divergence = 0.0;
    for (int a = 0; a < 3; a++) {
      divergence += out.gradient[a][a][l];
      worst.velocity = std::max(worst.velocity, std::fabs(out.velocity[a][l] - component(u(x), a)));
      for (int b = 0; b < 3; b++)
        worst.gradient =
            std::max(worst.gradient, std::fabs(out.gradient[a][b][l] - u.slope(x, a, b)));
    }
    worst.divergence = std::max(worst.divergence, std::fabs(divergence));
  }
  return worst;
}

double order(double coarse, double fine)
{
  return std::log2(coarse / fine);
}

}    // namespace

TEST(GridFlow, smooth_field_is_of_second_order)
{
  for (int dims : {2, 3})
    for (bool periodic : {false, true}) {
      const Swirl swirl{dims};
      Errors errors[2];
      for (int fine = 0; fine < 2; fine++) {
        Lattice grid{};
        grid.dims = dims;
        for (int k = 0; k < 3; k++) {
          const int cells = (fine + 1) * (20 + 4 * k);
          grid.periodic[k] = periodic;
          grid.n[k] = k == dims ? 1 : cells + (periodic ? 0 : 1);
          grid.spacing[k] = 2.0 * pi / cells;
        }
        errors[fine] = errors_of(Gridded(grid, swirl), swirl, points_in(grid, 64));
      }
      EXPECT_NEAR(order(errors[0].velocity, errors[1].velocity), 2.0, 0.3) << dims << periodic;
      EXPECT_NEAR(order(errors[0].gradient, errors[1].gradient), 2.0, 0.3) << dims << periodic;
      EXPECT_NEAR(order(errors[0].divergence, errors[1].divergence), 2.0, 0.5) << dims << periodic;
      EXPECT_LT(errors[1].velocity, 0.02);
      EXPECT_LT(errors[1].divergence, 0.1);
    }
}

TEST(GridFlow, periodic_directions_repeat)
{
  const Swirl swirl{3};
  Lattice grid = box(3, 8, 9, 10);
  grid.periodic[0] = grid.periodic[2] = true;
  const Gridded field(grid, swirl);
  auto points = points_in(grid, 64);
  const auto here = field.at(points);
  for (auto &p : points) {
    p.x += 3.0 * 8 * grid.spacing[0];
    p.z -= 2.0 * 10 * grid.spacing[2];
  }
  bool inside = false;
  const auto there = field.at(points, Detail::GRADIENT, &inside);
  EXPECT_TRUE(inside);
  for (int l = 0; l < 64; l++)
    for (int a = 0; a < 3; a++) {
      EXPECT_NEAR(there.velocity[a][l], here.velocity[a][l], 1e-12);
      EXPECT_NEAR(there.gradient[0][a][l], here.gradient[0][a][l], 1e-12);
    }
}

TEST(GridFlow, points_outside_are_told_and_take_the_border)
{
  for (int dims : {2, 3}) {
    const Lattice grid = box(dims, 4, 5, 6);
    const Gridded field(grid, Swirl{dims});
    const double end = grid.origin[1] + 4 * grid.spacing[1];
    const double h = grid.spacing[1], z = grid.origin[2] + 0.5;
    const auto inside = [&](double y) {
      bool yes = false;
      field.at({{0.5, 0.4, z}, {0.5, y, z}}, Detail::VELOCITY, &yes);
      return yes;
    };
    EXPECT_TRUE(inside(end));
    EXPECT_TRUE(inside(end + 1e-7 * h)) << "rounding";
    EXPECT_FALSE(inside(end + 1e-5 * h));
    EXPECT_TRUE(inside(grid.origin[1]));
    EXPECT_FALSE(inside(grid.origin[1] - 1e-5 * h));
    EXPECT_FALSE(inside(1e300));
    EXPECT_FALSE(inside(-1e300));
    EXPECT_FALSE(inside(std::nan("")));
    EXPECT_FALSE(inside(INFINITY));
    const auto out = field.at({{0.5, end, z}, {0.5, end + 7.0, z}, {0.5, std::nan(""), z}});
    EXPECT_EQ(out.velocity[0][1], out.velocity[0][0]);
    EXPECT_TRUE(std::isfinite(out.velocity[0][2]));
  }
}

TEST(GridFlow, in_the_plane_z_is_ignored)
{
  const Gridded field(box(2, 6, 7, 1), Swirl{2});
  bool inside = false;
  const auto out = field.at({{0.5, 0.4, 0.0}, {0.5, 0.4, 77.0}}, Detail::GRADIENT, &inside);
  EXPECT_TRUE(inside);
  EXPECT_EQ(out.velocity[0][0], out.velocity[0][1]);
  EXPECT_EQ(out.velocity[2][1], 0.0);
}

TEST(GridFlow, less_detail_gives_the_same_numbers)
{
  for (int dims : {2, 3}) {
    const Lattice grid = box(dims, 6, 7, 8);
    const auto points = points_in(grid, 40);
    const auto whole = Gridded(grid, Swirl{dims}).at(points);
    for (const Detail built : {Detail::VELOCITY, Detail::VORTICITY, Detail::GRADIENT})
      for (const Detail asked : {Detail::VELOCITY, Detail::VORTICITY}) {
        if (asked > built) continue;
        const auto out = Gridded(grid, Swirl{dims}, built).at(points, asked);
        for (int l = 0; l < 40; l++)
          for (int a = 0; a < 3; a++) {
            EXPECT_EQ(out.velocity[a][l], whole.velocity[a][l]);
            if (asked == Detail::VORTICITY) {
              EXPECT_EQ(out.vorticity[a][l], whole.vorticity[a][l]);
            }
          }
      }
  }
}

TEST(GridFlow, a_points_place_in_the_block_does_not_matter)
{
  for (int dims : {2, 3}) {
    const Gridded field(box(dims, 6, 7, 8), Swirl{dims});
    const auto points = points_in(field.grid, 64);
    const auto all = field.at(points);
    for (int l = 0; l < 64; l++) {
      const auto one = field.at({points[l]});
      for (int a = 0; a < 3; a++) {
        EXPECT_EQ(one.velocity[a][0], all.velocity[a][l]);
        EXPECT_EQ(one.gradient[0][a][0], all.gradient[0][a][l]);
      }
    }
  }
}

TEST(GridFlow, series_is_linear_in_time)
{
  for (int dims : {2, 3}) {
    const Swirl swirl{dims};
    const auto later = [&](const double *x) {
      return 3.0 * swirl(x);
    };
    Gridded field(box(dims, 6, 7, 8), swirl);
    const auto points = points_in(field.grid, 64);
    const auto first = field.at(points);
    field.add_frame(later, 0.25, 4.0);
    const auto now = field.at(points);
    for (int l = 0; l < 64; l++)
      for (int a = 0; a < 3; a++) {
        EXPECT_NEAR(now.velocity[a][l], 1.5 * first.velocity[a][l], 1e-13);
        EXPECT_NEAR(now.rate[a][l], 0.5 * first.velocity[a][l], 1e-13);
        EXPECT_NEAR(now.vorticity[a][l], 1.5 * first.vorticity[a][l], 1e-13);
        EXPECT_NEAR(now.gradient[a][0][l], 1.5 * first.gradient[a][0][l], 1e-13);
      }
  }
}

TEST(GridFlow, instruction_sets_agree)
{
  for (int dims : {2, 3}) {
    Gridded field(box(dims, 6, 7, 8), Swirl{dims});
    field.add_frame(
        [](const double *x) {
          return Vec3{x[0], x[1] * x[0], 1.0};
        },
        0.3, 2.0);
    const auto points = points_in(field.grid, 63);
    PointBlock block;
    block.n = 63;
    for (int l = 0; l < 63; l++) {
      const double x[3] = {points[l].x, points[l].y, points[l].z};
      block.set(l, x);
    }
    FluidBlock reference;
    for (const auto &build : grid_sampler_builds()) {
      FluidBlock out;
      build.sampler(field.flow.view, block, Detail::GRADIENT, out);
      if (std::string(build.name) == "baseline") reference = out;
      for (int l = 0; l < 63; l++)
        for (int a = 0; a < 3; a++) {
          EXPECT_NEAR(out.velocity[a][l], reference.velocity[a][l], 1e-14) << build.name;
          EXPECT_NEAR(out.vorticity[a][l], reference.vorticity[a][l], 1e-14) << build.name;
          EXPECT_NEAR(out.rate[a][l], reference.rate[a][l], 1e-14) << build.name;
          for (int b = 0; b < 3; b++)
            EXPECT_NEAR(out.gradient[a][b][l], reference.gradient[a][b][l], 1e-14) << build.name;
        }
    }
  }
}

// ---- walls

namespace {

struct WallErrors {
  double velocity = 0.0, gradient = 0.0, slip = 0.0;    // near the wall; at the wall itself
};

// a flow with walls and the distance to them, on a square of the given number of cells
struct Walled {
  Field velocity;
  std::function<double(const double *)> distance;
  double lo, hi;    // of the square or cube, along each axis
};

WallErrors wall_errors(const Walled &flow, int dims, int cells, bool reconstruct)
{
  Lattice grid{};
  grid.dims = dims;
  for (int k = 0; k < 3; k++) {
    grid.n[k] = k < dims ? cells + 1 : 1;
    grid.origin[k] = k < dims ? flow.lo : 0.0;
    grid.spacing[k] = (flow.hi - flow.lo) / cells;
  }
  const double h = grid.spacing[0];
  const Gridded field(grid, flow.velocity, Detail::GRADIENT, flow.distance, reconstruct);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> in(flow.lo + 4.0 * h, flow.hi - 4.0 * h);
  WallErrors worst;
  for (int n = 0; n < 40000; n++) {
    const Vec3 p{in(random), in(random), dims == 3 ? in(random) : 0.0};
    const double x[3] = {p.x, p.y, p.z}, s = flow.distance(x);
    if (s < 0.0 || s > 1.5 * h) continue;
    const auto out = field.at({p});
    const Vec3 exact = flow.velocity(x);
    for (int a = 0; a < 3; a++) {
      const double error = std::fabs(out.velocity[a][0] - component(exact, a));
      worst.velocity = std::max(worst.velocity, error);
      if (s < 0.02 * h) worst.slip = std::max(worst.slip, std::fabs(out.velocity[a][0]));
      for (int b = 0; b < dims; b++) {
        double right[3] = {x[0], x[1], x[2]}, left[3] = {x[0], x[1], x[2]};
        right[b] += 1e-6;
        left[b] -= 1e-6;
        const double slope =
            (component(flow.velocity(right), a) - component(flow.velocity(left), a)) / 2e-6;
        worst.gradient = std::max(worst.gradient, std::fabs(out.gradient[a][b][0] - slope));
      }
    }
  }
  EXPECT_GT(worst.velocity, 0.0) << "no point near the wall";
  return worst;
}

// Poiseuille's flow between walls that no line of the grid is parallel to
Walled oblique_channel(double width)
{
  const double t = 0.4;    // angle
  Walled flow;
  flow.lo = -1.0;
  flow.hi = 1.0;
  const auto height = [=](const double *x) {
    return 0.5 * width - std::fabs(x[1] * std::cos(t) - x[0] * std::sin(t));
  };
  flow.distance = height;
  flow.velocity = [=](const double *x) {
    const double s = height(x);
    return 4.0 * s * (width - s) / (width * width) * Vec3{std::cos(t), std::sin(t), 0.0};
  };
  return flow;
}

// Kuwabara's flow around a cylinder of radius 1, solid fraction alpha
// S. Kuwabara, J. Phys. Soc. Japan 14, 527 (1959), doi:10.1143/JPSJ.14.527
Walled cylinder()
{
  const double alpha = pi / 64.0;
  const double Ku = -0.5 * std::log(alpha) - 0.75 + alpha - 0.25 * alpha * alpha;
  Walled flow;
  flow.lo = -2.03;
  flow.hi = 1.97;
  flow.distance = [](const double *x) {
    return std::hypot(x[0], x[1]) - 1.0;
  };
  flow.velocity = [=](const double *x) {    // psi = (y/2 Ku) f(r), u = dpsi/dy, v = -dpsi/dx
    const double r2 = x[0] * x[0] + x[1] * x[1];
    const double f = std::log(r2) - 1.0 + alpha + (1.0 - 0.5 * alpha) / r2 - 0.5 * alpha * r2;
    const double f_r = 2.0 / r2 - 2.0 * (1.0 - 0.5 * alpha) / (r2 * r2) - alpha;    // f'/r
    return 0.5 / Ku * Vec3{f + x[1] * x[1] * f_r, -x[0] * x[1] * f_r, 0.0};
  };
  return flow;
}

// Stokes's flow around a sphere of radius 1
Walled sphere_flow()
{
  Walled flow;
  flow.lo = -1.93;
  flow.hi = 2.01;
  flow.distance = [](const double *x) {
    return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 1.0;
  };
  flow.velocity = [](const double *x) {
    const double r2 = x[0] * x[0] + x[1] * x[1] + x[2] * x[2], r = std::sqrt(r2);
    const double across = 0.75 * (1.0 - 1.0 / r2) / (r * r2) * x[0];
    return Vec3{1.0 - 0.75 / r - 0.25 / (r * r2), 0.0, 0.0} - across * Vec3{x[0], x[1], x[2]};
  };
  return flow;
}

// a flow in a square duct, turned: the walls meet in corners, and a node may see two of them
Walled square()
{
  const double t = 0.3;
  const auto across = [=](const double *x, int k) {
    return k == 0 ? x[0] * std::cos(t) + x[1] * std::sin(t)
                  : x[1] * std::cos(t) - x[0] * std::sin(t);
  };
  Walled flow;
  flow.lo = -1.67;
  flow.hi = 1.63;
  flow.distance = [=](const double *x) {
    const double a = std::fabs(across(x, 0)) - 1.0, b = std::fabs(across(x, 1)) - 1.0;
    return -std::hypot(std::max(a, 0.0), std::max(b, 0.0)) - std::min(std::max(a, b), 0.0);
  };
  flow.velocity = [=](const double *x) {
    const double u = std::cos(0.5 * pi * across(x, 0)) * std::cos(0.5 * pi * across(x, 1));
    return Vec3{u, -u, 0.0};
  };
  return flow;
}

}    // namespace

TEST(GridWalls, reconstructed_velocity_is_of_second_order_next_to_walls)
{
  const struct {
    const char *name;
    Walled flow;
    int dims, cells;
  } table[] = {{"channel", oblique_channel(1.1), 2, 40},
               {"cylinder", cylinder(), 2, 40},
               {"square", square(), 2, 40},
               {"sphere", sphere_flow(), 3, 30}};
  for (const auto &row : table) {
    const auto coarse = wall_errors(row.flow, row.dims, row.cells, true);
    const auto fine = wall_errors(row.flow, row.dims, 2 * row.cells, true);
    EXPECT_NEAR(order(coarse.velocity, fine.velocity), 2.0, 0.25) << row.name;
    EXPECT_LT(fine.velocity, 0.002) << row.name;
    EXPECT_LT(fine.slip, 0.0025) << row.name;
    // the channel's slope is exact, the square's is but for the corners
    if (row.name == std::string("cylinder") || row.name == std::string("sphere")) {
      EXPECT_NEAR(order(coarse.gradient, fine.gradient), 1.8, 0.25) << row.name;
    }
    EXPECT_LT(fine.gradient, 0.06) << row.name;
  }
}

TEST(GridWalls, plain_velocity_is_of_first_order_next_to_walls)
{
  const auto coarse = wall_errors(cylinder(), 2, 40, false);
  const auto fine = wall_errors(cylinder(), 2, 80, false);
  EXPECT_NEAR(order(coarse.velocity, fine.velocity), 1.0, 0.2);
  EXPECT_NEAR(order(coarse.gradient, fine.gradient), 0.0, 0.2) << "slopes do not converge";
  EXPECT_GT(fine.slip, 10.0 * wall_errors(cylinder(), 2, 80, true).slip);
}

TEST(GridWalls, parabola_between_walls_off_the_nodes_is_exact_on_nodes)
{
  // u is quadratic in the distance: u/phi is linear, and the fit finds it
  for (int dims : {2, 3}) {
    Lattice grid = box(dims, 6, 17, 6);
    grid.origin[1] = -1.0;
    const double lo = 0.317, hi = 9.1;
    const auto distance = [=](const double *x) {
      return std::min(x[1] - lo, hi - x[1]);
    };
    const auto u = [=](const double *x) {
      return Vec3{(x[1] - lo) * (hi - x[1]), 0.0, 0.0};
    };
    const Gridded field(grid, u, Detail::GRADIENT, distance);
    for (int j : {1, 15}) {    // layers next to the walls, outside the fluid
      const double x[3] = {grid.origin[0] + grid.spacing[0], -1.0 + j * grid.spacing[1],
                           grid.origin[2]};
      ASSERT_LT(distance(x), 0.0);
      const auto out = field.at({{x[0], x[1], x[2]}});
      EXPECT_NEAR(out.velocity[0][0], u(x).x, 1e-6);
      EXPECT_NEAR(out.gradient[0][1][0], lo + hi - 2.0 * x[1], 1e-6);
      EXPECT_NEAR(out.distance[0], distance(x), 1e-12);
    }
  }
}

TEST(GridWalls, narrow_gap_keeps_its_flow)
{
  // three cells and a bit wide: nodes of one wall must not see those of the other
  const auto smart = wall_errors(oblique_channel(0.17), 2, 40, true);
  const auto plain = wall_errors(oblique_channel(0.17), 2, 40, false);
  EXPECT_LT(smart.velocity, 0.09);    // trilinear between its few nodes: h^2 u''/8 = 0.09
  EXPECT_GT(plain.velocity, 0.18);
  EXPECT_LT(smart.gradient, 0.5 * plain.gradient);
}

TEST(GridWalls, thin_plate_and_solid_stay_at_rest)
{
  const Lattice grid = box(2, 20, 20, 1);
  const auto uniform = [](const double *) {
    return Vec3{1.0, 2.0, 0.0};
  };
  const double y = grid.origin[1] + 7 * grid.spacing[1];
  const Gridded plate(grid, uniform, Detail::VELOCITY, [=](const double *x) {
    return std::fabs(x[1] - y) - 1e-3;
  });
  EXPECT_NEAR(plate.at({{3.0, y, 0.0}}, Detail::VELOCITY).velocity[0][0], 0.0, 1e-14);
  const Gridded solid(grid, uniform, Detail::VELOCITY, [](const double *) {
    return -1.0;
  });
  EXPECT_EQ(solid.at({{3.0, y, 0.0}}, Detail::VELOCITY).velocity[1][0], 0.0);
}
