// Distances to surfaces of triangles and to walls of meshes against closed forms; the wall as
// triangles.

#include "meshes.h"
#include "program.h"
#include "walls.h"

#include <vtkDoubleArray.h>
#include <vtkMassProperties.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

using namespace flowgrid;

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
  const auto run = flowgrid_with(poiseuille + " " + (folder / "p.vtkhdf") +
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

// What is told before a long mapping, and before anything is written.
TEST(Walls, isosurface_does_not_write_over_a_surface_that_is_read)
{
  const Folder folder;
  const std::string cube_file = folder / "cube.stl", out = folder / "out.vtkhdf";
  write_stl(cube_file, cube());
  fs::create_symlink(cube_file, folder.path / "link.stl");
  const auto contents = [&] {
    std::ifstream in(cube_file);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const auto before = contents();
  for (const std::string name : {"cube.stl", "./cube.stl", "link.stl"}) {
    const auto run =
        flowgrid_with(out + " --spacing 0.1 --bounds -0.5 1.5 -0.5 1.5 -0.5 1.5 --wall-surface " +
                      cube_file + ":cube --isosurface " + (folder / name));
    EXPECT_EQ(run.status, 1) << run.text;
    EXPECT_NE(run.text.find(name + ": --isosurface would write over the file of --wall-surface"),
              std::string::npos)
        << run.text;
    EXPECT_EQ(contents(), before);
    EXPECT_FALSE(fs::exists(out));
  }
}

TEST(Walls, a_missing_surface_is_told_before_the_mapping)
{
  const Folder folder;
  const auto run = flowgrid_with(poiseuille + " " + (folder / "out.vtkhdf") +
                                 " --spacing 0.05 --planar 0.05 --wall-surface none.stl:none");
  EXPECT_EQ(run.status, 1);
  EXPECT_EQ(run.text, "flowgrid: none.stl: does not exist\n");
}

// A sphere across periodic borders, given once.
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
