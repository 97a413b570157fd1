// Walk, inverse map and weights. Facts: linear fields are exact in bi- and trilinear cells, smooth
// ones of second order; VTK's own locator; closed forms of the shapes of meshes.

#include "finder.h"
#include "mapping.h"
#include "meshes.h"
#include "report.h"

#include "gtest/gtest.h"

#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkStaticCellLocator.h>
#include <vtkUnstructuredGrid.h>

#include <random>

using namespace flowgrid;

namespace {

Grid grid_of(std::array<int, 3> n, Point origin, Point spacing)
{
  Grid grid;
  grid.n = n;
  grid.origin = origin;
  grid.spacing = spacing;
  return grid;
}

// largest error of a mapped function, and the share of nodes inside
double error(const Mesh &mesh, const Grid &grid, const std::function<double(const Point &)> &f,
             double *share = nullptr)
{
  const Mapping map(mesh, grid);
  std::vector<double> values;
  for (const auto &p : mesh.points) values.push_back(f(p));
  const auto mapped = map.apply(values, 1);
  double largest = 0.0;
  size_t node = 0;
  for (int k = 0; k < grid.n[2]; k++)
    for (int j = 0; j < grid.n[1]; j++)
      for (int i = 0; i < grid.n[0]; i++, node++)
        if (map.inside(node))
          largest = std::max(largest, std::fabs(mapped[node] - f(grid.node(i, j, k))));
        else
          EXPECT_EQ(mapped[node], 0.0);
  if (share) *share = static_cast<double>(map.count_inside()) / grid.nodes();
  return largest;
}

double linear(const Point &x)
{
  return 0.7 - 1.3 * x[0] + 2.1 * x[1] + 0.4 * x[2];
}

}    // namespace

TEST(Mapping, linear_fields_are_exact_on_distorted_blocks)
{
  double share;
  const Grid space = grid_of({41, 21, 17}, {0.0, 0.0, 0.0}, {0.05, 0.05, 0.0625});
  EXPECT_LT(error(two_blocks(6, false), space, linear, &share), 1e-12);
  EXPECT_EQ(share, 1.0);
  const Grid plane = grid_of({41, 21, 1}, {0.0, 0.0, 0.0}, {0.05, 0.05, 1.0});
  EXPECT_LT(error(two_blocks(6, true), plane, linear, &share), 1e-12);
  EXPECT_EQ(share, 1.0);
}

TEST(Mapping, linear_fields_are_exact_at_nodes_that_rounding_puts_outside)
{
  // by less than 1e-6 of half a cell: such nodes are inside, and the cell's functions go on
  for (const bool flat : {false, true})
    for (const double beyond : {2e-8, -2e-8}) {
      double share;
      const Grid grid = grid_of({41, 21, flat ? 1 : 17}, {-beyond, beyond, flat ? 0.0 : -beyond},
                                {0.05 * (1 + 1e-9), 0.05, 0.0625});
      EXPECT_LT(error(two_blocks(6, flat), grid, linear, &share), 1e-13);
      EXPECT_EQ(share, 1.0);
    }
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.add(Shape::TETRA, {0, 1, 2, 3});
  mesh.link();
  EXPECT_LT(error(mesh, grid_of({2, 2, 2}, {-5e-7, -5e-7, -5e-7}, {0.3, 0.3, 0.3}), linear), 1e-14);
}

TEST(Mapping, divergence_of_a_linear_field_without_any_is_rounding)
{
  // in the plane and in space, on a mesh in single precision
  for (const bool flat : {false, true}) {
    Mesh mesh = two_blocks(6, flat);
    std::vector<double> u;
    for (auto &p : mesh.points) {
      for (double &x : p) x = static_cast<float>(x);
      u.insert(u.end(), {0.7 * p[0] + p[1], -0.7 * p[1] - p[2] + p[0], 0.3 * p[0]});
    }
    const Grid grid =
        grid_of({41, 21, flat ? 1 : 21}, {0.0, 0.0, 0.0}, {0.05, 0.05, flat ? 1.0 : 0.05});
    const Mapping map(mesh, grid);
    EXPECT_EQ(map.count_inside(), grid.nodes());
    EXPECT_LT(quality(map, map.apply(u, 3), {}).divergence_max, 1e-14);
  }
}

TEST(Mapping, smooth_fields_are_of_second_order)
{
  auto f = [](const Point &x) {
    return std::sin(2.0 * x[0] + x[1]) * std::cos(1.5 * x[1] - x[2]);
  };
  const Grid grid = grid_of({37, 19, 19}, {0.01, 0.01, 0.01}, {0.053, 0.053, 0.053});
  const double coarse = error(two_blocks(6, false), grid, f);
  const double fine = error(two_blocks(12, false), grid, f);
  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.25);
  EXPECT_LT(fine, 0.01);
}

TEST(Mapping, a_hole_is_outside_and_what_lies_behind_it_is_found)
{
  const Mesh mesh = ring(96);
  double share;
  const Grid grid = grid_of({121, 121, 1}, {-3.0, -3.0, 0.0}, {0.05, 0.05, 1.0});
  EXPECT_LT(error(mesh, grid, linear, &share), 1e-12);
  // area of two regular polygons of 96 corners, of the radii 3 and 1, over that of the square
  const double polygon = 48.0 * std::sin(2.0 * 3.14159265358979323846 / 96.0);
  EXPECT_NEAR(share * 121 * 121 / (120 * 120), (9.0 - 1.0) * polygon / 36.0, 0.003);
}

TEST(Mapping, simplices_are_exact_for_linear_fields)
{
  Mesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.add(Shape::TETRA, {0, 1, 2, 3});
  mesh.add(Shape::TETRA, {1, 2, 3, 4});
  mesh.link();
  EXPECT_EQ(mesh.across[0][0], 1) << "across the face opposite to corner 0";
  EXPECT_EQ(mesh.across[1][3], 0);
  double share;
  EXPECT_LT(error(mesh, grid_of({21, 21, 21}, {0, 0, 0}, {0.05, 0.05, 0.05}), linear, &share),
            1e-13);
  EXPECT_NEAR(share, 0.5, 0.08);    // 1/6 + 1/3, and the nodes of the faces
}

TEST(Finder, agrees_with_the_locator_of_vtk)
{
  const Mesh mesh = two_blocks(7, false);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto &p : mesh.points) points->InsertNextPoint(p.data());
  grid->SetPoints(points);
  for (int c = 0; c < mesh.size(); c++) {
    vtkIdType of[8];
    std::copy_n(mesh.corners[c].begin(), 8, of);
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, of);
  }
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(grid);
  locator->BuildLocator();

  Finder finder(mesh);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> number(-0.05, 1.05);
  int start = -1, inside = 0, other = 0;
  for (int n = 0; n < 10000; n++) {
    double x[3] = {2.0 * number(random), number(random), number(random)};
    Local local;
    const int found = finder.find(x, start, local);
    if (found >= 0) start = found;
    const auto theirs = locator->FindCell(x);
    inside += found >= 0;
    other += found != theirs;
    if (found < 0) continue;
    double back[3] = {};
    for (int k = 0; k < 8; k++)
      for (int c = 0; c < 3; c++)
        back[c] += local.weight[k] * mesh.points[mesh.corners[found][k]][c];
    for (int c = 0; c < 3; c++) EXPECT_NEAR(back[c], x[c], 1e-12);
  }
  // faces of the bricks are curved; VTK counts a point near one with a tolerance of its own
  EXPECT_LE(other, 5);
  EXPECT_NEAR(inside, 10000.0 * std::pow(1.0 / 1.1, 3), 300.0);
}

TEST(Finder, walks_a_few_cells_from_node_to_node)
{
  const Mesh mesh = two_blocks(20, false);
  const Mapping map(mesh, grid_of({101, 51, 51}, {0, 0, 0}, {0.02, 0.02, 0.02}));
  EXPECT_EQ(map.count_inside(), map.grid.nodes());
  EXPECT_LT(static_cast<double>(map.walked) / map.grid.nodes(), 3.0);
  EXPECT_GE(static_cast<double>(map.walked) / map.grid.nodes(), 0.99);
  EXPECT_LT(map.searched, 51 * 51);
}

TEST(Report, divergence_and_slip_are_those_of_the_field)
{
  const Mesh mesh = two_blocks(4, true);
  const Grid grid = grid_of({41, 21, 1}, {0.0, 0.0, 0.0}, {0.05, 0.05, 1.0});
  const Mapping map(mesh, grid);
  std::vector<double> u;
  for (int j = 0; j < 21; j++)
    for (int i = 0; i < 41; i++) {
      const Point x = grid.node(i, j, 0);
      u.insert(u.end(), {x[0], -0.5 * x[1], 0.0});    // divergence 1/2, fastest at (2, 1)
    }
  const auto q = quality(map, u, {{1.025, 0.0, 0.0}, {0.0, 0.5, 0.0}});
  const double fastest = std::hypot(2.0, 0.5);
  EXPECT_NEAR(q.fastest, fastest, 1e-12);
  EXPECT_NEAR(q.divergence_max, 0.5 * 0.05 / fastest, 1e-12);
  EXPECT_NEAR(q.divergence_rms, 0.5 * 0.05 / fastest, 1e-12);
  EXPECT_NEAR(q.slip, 1.025 / fastest, 1e-12);
  EXPECT_EQ(q.walls_seen, 2u);
  EXPECT_EQ(quality(map, u, {{1.025, -0.1, 0.0}, {3.0, 0.5, 0.0}}).walls_seen, 0u);
}
