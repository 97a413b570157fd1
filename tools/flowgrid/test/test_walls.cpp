// Distances to walls against closed forms: shapes, surfaces of triangles, walls of meshes.

#include "flow/vtkhdf_file.h"
#include "meshes.h"
#include "program.h"
#include "vector.h"

#include "gtest/gtest.h"

#include <hdf5.h>
#include <vtkDoubleArray.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>

using namespace flowgrid;

namespace {

constexpr double pi = 3.14159265358979323846;

// arrays of a file, at their places
struct Distances {
  apf::VtkhdfFile file;
  int layers;

  explicit Distances(const std::string &path) : file(path), layers(file.grid().n[2])
  {
    if (layers == 2) layers = 1;
  }
  // Calls f(x, distance) for all nodes with |distance| <= most, which are exact; how many.
  template <class F> int for_near(const std::string &name, double most, F f) const
  {
    const auto &g = file.grid();
    const auto values = file.read(name, 1, 0, layers);
    int count = 0;
    for (size_t node = 0; node < values.size(); node++) {
      if (std::fabs(values[node]) > most) continue;
      const size_t at[3] = {node % g.n[0], node / g.n[0] % g.n[1], node / g.n[0] / g.n[1]};
      Point x;
      for (int c = 0; c < 3; c++) x[c] = g.origin[c] + at[c] * g.spacing[c];
      f(x, values[node]);
      count++;
    }
    return count;
  }
  template <class F> int expect(const std::string &name, double most, double error, F exact) const
  {
    return for_near(name, most, [&](const Point &x, double d) {
      EXPECT_NEAR(d, exact(x), error) << name << " at " << x[0] << " " << x[1] << " " << x[2];
    });
  }
};

double surface_error(const std::string &path, const std::string &array)
{
  double value = -1.0;
  const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t at = H5Aopen_by_name(file, ("VTKHDF/PointData/" + array).c_str(), "surface_error",
                                   H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(at, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(at);
  H5Fclose(file);
  return value;
}

using Triangle = std::array<Point, 3>;

void write_stl(const std::string &path, const std::vector<Triangle> &triangles)
{
  std::ofstream out(path);
  out.precision(9);
  out << "solid s\n";
  for (const auto &t : triangles) {
    out << "facet normal 0 0 0\nouter loop\n";
    for (const auto &p : t) out << "vertex " << p[0] << " " << p[1] << " " << p[2] << "\n";
    out << "endloop\nendfacet\n";
  }
  out << "endsolid s\n";
}

// the unit cube, normals outward
std::vector<Triangle> cube()
{
  const int quads[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                           {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
  std::vector<Triangle> result;
  for (const auto &q : quads) {
    Point x[4];
    for (int k = 0; k < 4; k++) x[k] = {double(q[k] & 1), double(q[k] >> 1 & 1), double(q[k] >> 2)};
    result.push_back({x[0], x[1], x[2]});
    result.push_back({x[0], x[2], x[3]});
  }
  return result;
}

// a sphere of radius 0.5, of 2 n x n facets on meridians and circles
std::vector<Triangle> sphere(int n)
{
  const auto at = [&](int i, int j) {
    const double a = pi * i / n, b = pi * (j % (2 * n)) / n;
    const double s = i == 0 || i == n ? 0.0 : std::sin(a);
    return Point{0.5 * s * std::cos(b), 0.5 * s * std::sin(b), 0.5 * std::cos(a)};
  };
  std::vector<Triangle> result;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < 2 * n; j++) {
      if (i > 0) result.push_back({at(i, j), at(i + 1, j), at(i, j + 1)});
      if (i < n - 1) result.push_back({at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return result;
}

double outside_cube(const Point &x)
{
  double out = 0.0, in = -1e300;
  for (const double c : x) {
    const double over = std::max(-c, c - 1.0);
    in = std::max(in, over);
    out += over > 0.0 ? over * over : 0.0;
  }
  return in > 0.0 ? std::sqrt(out) : in;
}

}    // namespace

TEST(Walls, circle)
{
  const Folder folder;
  const auto run = flowgrid_with("--shape 'c: disc(0.1,0.2, 1)' " + (folder / "c.vtkhdf") +
                                 " --spacing 0.05 --bounds -2 2 -2 2 0 0 --planar 0");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "c.vtkhdf");
  for (const char *name : {"distance", "distance_c"}) {
    const int count = d.expect(name, 0.199, 1e-13, [](const Point &x) {
      return std::hypot(x[0] - 0.1, x[1] - 0.2) - 1.0;
    });
    EXPECT_NEAR(count, 2 * pi * 0.398 / 0.0025, 30);
    // marched: to second order
    d.expect(name, 0.6, 2e-3, [](const Point &x) {
      return std::hypot(x[0] - 0.1, x[1] - 0.2) - 1.0;
    });
    EXPECT_EQ(surface_error(folder / "c.vtkhdf", name), 0.0);
  }
}

TEST(Walls, oblique_plane)
{
  const Folder folder;
  const auto run = flowgrid_with("--shape 'p: plane(0.1,0,0, 1,2,3)' " + (folder / "p.vtkhdf") +
                                 " --spacing 0.1 0.12 0.09 --bounds -1 1 -1 1 -1 1 --exact 0.5");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "p.vtkhdf");
  EXPECT_GT(d.expect("distance_p", 0.5, 1e-12,
                     [](const Point &x) {
                       return (x[0] - 0.1 + 2 * x[1] + 3 * x[2]) / std::sqrt(14.0);
                     }),
            2000);
}

TEST(Walls, duct_is_cut_along_its_edges)
{
  const Folder folder;
  const auto run =
      flowgrid_with("--shape 'duct: inside(box(0,0,-9, 1,2,9))' " + (folder / "d.vtkhdf") +
                    " --spacing 0.1 --bounds -0.3 1.3 -0.3 2.3 0 1");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "d.vtkhdf");
  int seen[4] = {};
  for (const char *name :
       {"distance_duct", "distance_duct_2", "distance_duct_3", "distance_duct_4"}) {
    // each is the distance to one plane, also beyond the edges
    const auto plane = [](int n, const Point &x) {
      return n == 0 ? x[0] : n == 1 ? 1.0 - x[0] : n == 2 ? x[1] : 2.0 - x[1];
    };
    for (int n = 0; n < 4; n++) {
      double worst = 0.0;
      d.for_near(name, 0.25, [&](const Point &x, double value) {
        worst = std::max(worst, std::fabs(value - plane(n, x)));
      });
      seen[n] += worst < 1e-12;
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_FALSE(d.file.has("distance_duct_5"));
  d.for_near("distance", 0.35, [](const Point &x, double value) {
    if (x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 2)
      EXPECT_NEAR(value, std::min({x[0], 1.0 - x[0], x[1], 2.0 - x[1]}), 1e-12);
  });
}

TEST(Walls, convex_edges_are_round_and_stay_in_one_piece)
{
  const Folder folder;
  write_stl(folder / "cube.stl", cube());
  for (const std::string &words : {std::string("--shape 'cube: box(0,0,0, 1,1,1)' "),
                                   "--wall-surface " + (folder / "cube.stl") + " "}) {
    const auto run = flowgrid_with(words + (folder / "b.vtkhdf") +
                                   " --spacing 0.1 --bounds -0.5 1.5 -0.5 1.5 -0.5 1.5");
    ASSERT_EQ(run.status, 0) << run.text;
    EXPECT_NE(run.text.find("1 piece(s) in 1 array(s)"), std::string::npos) << run.text;
    const Distances d(folder / "b.vtkhdf");
    EXPECT_GT(d.expect("distance_cube", 0.39, 1e-12, outside_cube), 4000);
  }
}

TEST(Walls, rim_of_a_hole_and_the_floor_below_a_post)
{
  const Folder folder;
  auto run =
      flowgrid_with("--shape 'h: difference(box(-9,-9,-9, 9,9,0), cylinder(0,0,-8, 0,0,1, 0.5))' " +
                    (folder / "h.vtkhdf") + " --spacing 0.1 --bounds -1 1 -1 1 -0.5 0.8");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances hole(folder / "h.vtkhdf");
  hole.expect("distance_h", 0.39, 1e-12, [](const Point &x) {
    const double r = std::hypot(x[0], x[1]);
    if (x[2] <= 0.0) return r < 0.5 ? 0.5 - r : std::max(x[2], 0.5 - r);
    return r < 0.5 ? std::hypot(0.5 - r, x[2]) : x[2];
  });

  // the post goes on below the floor, the floor below the post
  run = flowgrid_with("--shape 'floor: plane(0,0,0, 0,0,1)' "
                      "--shape 'post: cylinder(0,0,0, 0,0,5, 0.5)' " +
                      (folder / "p.vtkhdf") + " --spacing 0.1 --bounds -1 1 -1 1 -0.3 1");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances post(folder / "p.vtkhdf");
  EXPECT_GT(post.expect("distance_post", 0.2, 1e-12,
                        [](const Point &x) {
                          return std::hypot(x[0], x[1]) - 0.5;
                        }),
            500);
  post.expect("distance_floor", 0.2, 1e-12, [](const Point &x) {
    return x[2];
  });
}

TEST(Walls, step_of_a_polygon_has_two_pieces)
{
  const Folder folder;
  const auto run =
      flowgrid_with("--shape 'step: polygon(-9,-9, 9,-9, 9,0, 0,0, 0,1, -9,1)' " +
                    (folder / "s.vtkhdf") + " --spacing 0.1 --bounds -2 3 -0.4 3 0 0 --planar 0");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "s.vtkhdf");
  d.expect("distance_step", 0.39, 1e-13, [](const Point &x) {
    return x[1];
  });
  d.expect("distance_step_2", 0.39, 1e-13, [](const Point &x) {
    if (x[0] > 0.0 && x[1] > 1.0) return std::hypot(x[0], x[1] - 1.0);
    return std::max(x[0], x[1] - 1.0);
  });
}

TEST(Walls, facets_of_a_sphere_do_not_show)
{
  // facets are 0.0021 off; what is left falls faster than by the square of their size
  const Folder folder;
  double worst[2] = {}, stated[2] = {};
  for (const int n : {12, 24}) {
    write_stl(folder / "s.stl", sphere(n));
    const auto run =
        flowgrid_with("--wall-surface " + (folder / "s.stl") + ":ball " + (folder / "s.vtkhdf") +
                      " --spacing 0.1 --bounds -1 1 -1 1 -1 1 --exact 0.2");
    ASSERT_EQ(run.status, 0) << run.text;
    const Distances d(folder / "s.vtkhdf");
    d.for_near("distance_ball", 0.19, [&](const Point &x, double value) {
      const double exact = std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]) - 0.5;
      worst[n == 24] = std::max(worst[n == 24], std::fabs(value - exact));
    });
    stated[n == 24] = surface_error(folder / "s.vtkhdf", "distance_ball");
  }
  EXPECT_LT(worst[1], 1e-4);
  EXPECT_GT(worst[0] / worst[1], 6.0);
  for (int k = 0; k < 2; k++) {
    EXPECT_GT(stated[k], 0.3 * worst[k]);
    EXPECT_LT(stated[k], 30.0 * worst[k]);
  }
}

TEST(Walls, cylinder_in_a_mesh)
{
  // a ring of cells around a resting circle; its outer border moves
  const Folder folder;
  const Mesh mesh = ring(64);
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  vtkNew<vtkDoubleArray> u;
  u->SetName("U");
  u->SetNumberOfComponents(3);
  for (const auto &p : mesh.points) {
    points->InsertNextPoint(p.data());
    const double r = std::hypot(p[0], p[1]);
    const double v[3] = {r < 1.0 + 1e-9 ? 0.0 : r - 1.0, 0.0, 0.0};
    u->InsertNextTuple(v);
  }
  grid->SetPoints(points);
  for (int c = 0; c < mesh.size(); c++) {
    vtkIdType corners[4];
    for (int k = 0; k < 4; k++) corners[k] = mesh.corners[c][k];
    grid->InsertNextCell(VTK_QUAD, 4, corners);
  }
  grid->GetPointData()->AddArray(u);
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName((folder / "ring.vtu").c_str());
  writer->SetInputData(grid);
  writer->Write();
  const auto run = flowgrid_with((folder / "ring.vtu") + " " + (folder / "ring.vtkhdf") +
                                 " --spacing 0.1 --distance");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "ring.vtkhdf");
  // facets would be 1.2e-3 off
  EXPECT_GT(d.expect("distance_wall", 0.35, 1e-5,
                     [](const Point &x) {
                       return std::hypot(x[0], x[1]) - 1.0;
                     }),
            300);
}

TEST(Walls, walls_of_an_openfoam_case)
{
  const Folder folder;
  const auto run =
      flowgrid_with(std::string(FLOWGRID_DATA) + "/poiseuille " + (folder / "p.vtkhdf") +
                    " --spacing 0.05 --planar 0.05 --distance --times all");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "p.vtkhdf");
  EXPECT_EQ(d.file.times().size(), 2u);
  d.expect("distance", 0.19, 1e-12, [](const Point &x) {
    return std::min(x[1], 1.0 - x[1]);
  });
}

TEST(Walls, triangles_are_put_right_or_refused)
{
  const Folder folder;
  auto bad = cube();
  bad.push_back(bad[3]);
  std::swap(bad[5][1], bad[5][2]);
  bad.push_back({bad[0][0], bad[0][0], bad[0][1]});
  // one side of a triangle in two, with a triangle without area in between
  const Triangle whole = bad[1];
  const Point middle{0.5 * (whole[0][0] + whole[1][0]), 0.5 * (whole[0][1] + whole[1][1]), 0.0};
  bad[1] = {whole[0], middle, whole[2]};
  bad.push_back({middle, whole[1], whole[2]});
  bad.push_back({whole[0], whole[1], middle});
  write_stl(folder / "bad.stl", bad);
  const std::string rest =
      " " + (folder / "b.vtkhdf") + " --spacing 0.1 --bounds -0.5 1.5 -0.5 1.5 -0.5 1.5";
  auto run = flowgrid_with("--wall-surface " + (folder / "bad.stl") + ":cube" + rest);
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("1 duplicate and 2 degenerate ones removed, 1 turned round"),
            std::string::npos)
      << run.text;
  Distances(folder / "b.vtkhdf").expect("distance_cube", 0.39, 1e-12, outside_cube);

  auto leaky = cube();
  leaky.pop_back();
  write_stl(folder / "leaky.stl", leaky);
  run = flowgrid_with("--wall-surface " + (folder / "leaky.stl") + rest);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.text.find("is not closed: 3 edges"), std::string::npos) << run.text;

  auto finned = cube();
  finned.push_back({Point{0, 0, 1}, Point{1, 1, 1}, Point{0.5, 0.5, 1.5}});
  write_stl(folder / "finned.stl", finned);
  run = flowgrid_with("--wall-surface " + (folder / "finned.stl") + rest);
  EXPECT_EQ(run.status, 1);
  EXPECT_NE(run.text.find("more than two triangles"), std::string::npos) << run.text;

  // the fluid may be inside
  write_stl(folder / "cube.stl", cube());
  run = flowgrid_with("--wall-surface " + (folder / "cube.stl") + ":room --fluid-at 0.5 0.5 0.5" +
                      rest);
  ASSERT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("6 piece(s)"), std::string::npos) << run.text;
}

TEST(Walls, narrow_places_are_named)
{
  const Folder folder;
  const std::string words = "--shape 'low: plane(0,0,0, 0,1,0)' --shape 'high: "
                            "plane(0,0.5,0, 0,-1,0)' " +
      (folder / "n.vtkhdf") + " --spacing 0.05 --bounds 0 1 0 0.5 0 0 --planar 0 --particle ";
  EXPECT_NE(flowgrid_with(words + "0.6").text.find("a gap is narrower than a particle: 0.5"),
            std::string::npos);
  EXPECT_EQ(flowgrid_with(words + "0.4").text.find("narrower"), std::string::npos);
}

TEST(Walls, isosurface_holds_the_volume_of_a_sphere)
{
  const Folder folder;
  const auto run =
      flowgrid_with("--shape 's: sphere(0,0,0, 0.5)' " + (folder / "s.vtkhdf") +
                    " --spacing 0.05 --bounds -1 1 -1 1 -1 1 --isosurface " + (folder / "s.vtp"));
  ASSERT_EQ(run.status, 0) << run.text;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "s.vtp").c_str());
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(reader->GetOutputPort());
  EXPECT_NEAR(mass->GetVolume(), pi / 6.0, 0.01 * pi / 6.0);
  EXPECT_NEAR(mass->GetSurfaceArea(), pi, 0.01 * pi);
}

// A cube whose walls lie on the borders of the grid has six faces.
TEST(Walls, isosurface_has_walls_along_the_border)
{
  const Folder folder;
  const auto run = flowgrid_with(
      "--shape 'c: inside(box(0,0,0, 0.3,0.3,0.3))' " + (folder / "c.vtkhdf") +
      " --spacing 0.02 --bounds 0 0.3 0 0.3 0 0.3 --isosurface " + (folder / "c.vtp"));
  ASSERT_EQ(run.status, 0) << run.text;
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName((folder / "c.vtp").c_str());
  vtkNew<vtkMassProperties> mass;
  mass->SetInputConnection(reader->GetOutputPort());
  const double chamfers = 12 * 0.3 * 0.02 * (2.0 - std::sqrt(2.0));    // a cell wide
  EXPECT_NEAR(mass->GetSurfaceArea(), 6 * 0.3 * 0.3 - chamfers, 0.005);
}

// A bar with round ends, whose discs touch its faces: one piece wherever the nodes are.
TEST(Walls, faces_that_touch_smoothly_are_one_piece)
{
  const Folder folder;
  const std::string path = folder / "bar.vtkhdf";
  for (const std::string spacing : {"0.3", "0.2", "0.15", "0.07", "0.031"}) {
    const auto run =
        flowgrid_with(path +
                      " --bounds 0 3 0 2.4 0 0 --planar 0 --exact 0.3 --shape \"bar: union("
                      "rectangle(1,1, 2,1.4), disc(1,1.2, 0.2), disc(2,1.2, 0.2))\" --spacing " +
                      spacing);
    ASSERT_EQ(run.status, 0) << run.text;
    EXPECT_NE(run.text.find("1 piece(s) in 1 array(s)"), std::string::npos) << run.text;
    const Distances file(path);
    const int count = file.expect("distance_bar", 0.29, 1e-14, [](const Point &x) {
      const double along = std::max({1.0 - x[0], x[0] - 2.0, 0.0});
      return std::hypot(along, x[1] - 1.2) - 0.2;
    });
    EXPECT_GT(count, 10);
  }
}

// The triangles of a wall are a wall themselves, without being told where the fluid is.
TEST(Walls, isosurface_is_a_surface_with_normals_into_the_fluid)
{
  const Folder folder;
  const std::string bounds = " --spacing 0.1 --bounds 0 2 0 2 0 2 ";
  const std::string shape = "--shape \"s: sphere(1,1,1, 0.6)\" --isosurface ";
  for (const std::string name : {"s.stl", "s.vtp"}) {
    const std::string surface = folder / name, path = folder / "of_triangles.vtkhdf";
    ASSERT_EQ(flowgrid_with(folder / "of_shape.vtkhdf" + bounds + shape + surface).status, 0);
    const auto run = flowgrid_with(path + bounds + "--wall-surface " + surface);
    ASSERT_EQ(run.status, 0) << run.text;
    const Distances file(path);
    EXPECT_GT(file.expect("distance", 0.3, 5e-3,
                          [](const Point &x) {
                            return std::hypot(x[0] - 1.0, x[1] - 1.0, x[2] - 1.0) - 0.6;
                          }),
              1000);
  }
}

// A disc across a periodic border, given once: distances to the nearest copy, and the same at both
// ends. A bar that ends at the border has no end there.
TEST(Walls, periodic_walls_go_on_at_the_other_end)
{
  const Folder folder;
  const std::string path = folder / "periodic.vtkhdf";
  const std::string words = path +
      " --spacing 0.1 --bounds 0 4 0 3 0 0 --planar 0 --band 12 "
      "--shape \"post: disc(0.3,1.5, 0.5)\" "
      "--shape \"bar: rectangle(0,-1, 4,0.2)\" --periodic x";
  const auto run = flowgrid_with(words);
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances file(path);
  const auto post = [](const Point &x) {
    double least = 1e300;
    for (const double at : {-3.7, 0.3, 4.3})
      least = std::min(least, std::hypot(x[0] - at, x[1] - 1.5) - 0.5);
    return least;
  };
  EXPECT_GT(file.expect("distance_post", 0.39, 1e-14, post), 100);
  EXPECT_GT(file.expect("distance_post", 1.0, 0.03, post), 400);    // by fast marching
  EXPECT_GT(file.expect("distance_bar", 0.39, 1e-14,
                        [](const Point &x) {
                          return x[1] - 0.2;
                        }),
            200);
  for (const std::string array : {"distance", "distance_post", "distance_bar"}) {
    const auto values = file.file.read(array, 1, 0, 1);
    for (int j = 0; j < 31; j++) EXPECT_EQ(values[41 * j], values[41 * j + 40]) << array;
  }
  EXPECT_NE(run.text.find("distance_bar: bar at x = 0 to 4 y = 0.2\n"), std::string::npos)
      << run.text;
}

// ... of triangles too
TEST(Walls, periodic_surface_of_triangles)
{
  const Folder folder;
  auto triangles = sphere(24);
  for (auto &t : triangles)
    for (auto &p : t) p = p + Point{0.2, 1.0, 0.1};
  write_stl(folder / "s.stl", triangles);
  const std::string path = folder / "periodic.vtkhdf";
  const auto run = flowgrid_with(path +
                                 " --spacing 0.1 --bounds 0 2.5 0 2 0 2.5 --band 6 "
                                 "--wall-surface " +
                                 (folder / "s.stl") + " --periodic xz");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances file(path);
  const int count = file.expect("distance_s", 0.39, 2e-5, [](const Point &x) {
    double least = 1e300;
    for (const double a : {0.2, 2.7})
      for (const double b : {0.1, 2.6})
        least = std::min(least, std::hypot(x[0] - a, x[1] - 1.0, x[2] - b) - 0.5);
    return least;
  });
  EXPECT_GT(count, 2000);
}

TEST(Walls, periods_that_cannot_be_are_refused)
{
  const Folder folder;
  const std::string words = folder / "periodic.vtkhdf" +
      " --bounds 0 4 0 3 0 0 --planar 0 --shape \"post: disc(0.3,1.5, 0.5)\" --spacing ";
  const auto expect = [&](const std::string &more, const std::string &text) {
    const auto run = flowgrid_with(words + more);
    EXPECT_NE(run.status, 0);
    EXPECT_NE(run.text.find(text), std::string::npos) << run.text;
  };
  expect("0.11 --periodic y", "--periodic y needs a --spacing that divides");
  expect("0.1 --periodic w", "--periodic takes x, y, z, got w");
  expect("0.1 --periodic z", "--periodic z needs a grid in space");
  expect("0.1 --periodic x --shape \"p: plane(1,0,0, 1,1,0)\"",
         "a plane across a --periodic direction");
}

TEST(Walls, wrong_shapes_are_pointed_at)
{
  const Folder folder;
  const std::string rest = " " + (folder / "w.vtkhdf") + " --spacing 0.1 --bounds 0 1 0 1 0 1";
  struct Row {
    std::string words;
    int status;
    std::string message;
  };
  const Row rows[] = {
      {"--shape 'a: cone(0,0,0,1)'", 1, "there is no shape cone; there are box"},
      {"--shape 'a: sphere(0,0,0)'", 1, "sphere takes 4 numbers, got 3"},
      {"--shape 'a: sphere(0,0,0,-1)'", 1, "a radius must be > 0"},
      {"--shape 'a: sphere(0,0,0,1) b'", 1, "nothing may follow the shape"},
      {"--shape 'sphere(0,0,0,1)'", 1, "expected :"},
      {"--shape 'a: box(1,0,0, 0,1,1)'", 1, "must lie above the first along x"},
      {"--shape 'a: extrude(0,1, polygon(0,0, 1,1, 1,0, 0,1))'", 1, "crosses or touches itself"},
      {"--shape 'a: plane(0,0,0, 0,0,0)'", 1, "the normal of a plane must not be 0"},
      {"--shape 'a: sphere(9,9,9, 1)'", 1, "no face of a --shape lies in the grid"},
      {"--shape 'a: sphere(0,0,0,1)' --shape 'a: sphere(1,0,0,1)'", 1, "there are two shapes a"},
      {"--shape 'a: sphere(0,0,0,1)' --planar 0", 1, "in a plane grid shapes are of"},
      {"--wall-surface none.stl", 1, "none.stl: does not exist"},
      {"--shape 'a: sphere(0,0,0,1)' --particle 0", 2, "--particle must be > 0, got 0"},
      {"--shape 'a: sphere(0,0,0,1)' --band 1", 2, "--band must be 4 cells or more"},
  };
  for (const auto &row : rows) {
    const auto run = flowgrid_with(row.words + rest);
    EXPECT_EQ(run.status, row.status) << row.words << "\n" << run.text;
    EXPECT_NE(run.text.find(row.message), std::string::npos) << row.words << "\n" << run.text;
  }
}
