// Gridded flows next to walls, without LAMMPS.

#include "compare.h"
#include "gridded.h"

#include "gtest/gtest.h"

using namespace apf;

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
      worst.velocity = apf_test::larger(worst.velocity, error);
      if (s < 0.02 * h) worst.slip = apf_test::larger(worst.slip, std::fabs(out.velocity[a][0]));
      for (int b = 0; b < dims; b++) {
        double right[3] = {x[0], x[1], x[2]}, left[3] = {x[0], x[1], x[2]};
        right[b] += 1e-6;
        left[b] -= 1e-6;
        const double slope =
            (component(flow.velocity(right), a) - component(flow.velocity(left), a)) / 2e-6;
        worst.gradient = apf_test::larger(worst.gradient, std::fabs(out.gradient[a][b][0] - slope));
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
