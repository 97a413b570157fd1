// The program: files that VTK wrote come out as VTKHDF that VTK and APF read; errors name what is
// wrong.

#include "linear_fields.h"
#include "meshes.h"
#include "program.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkHDFReader.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <fstream>

using namespace flowgrid;

namespace {

template <class Writer> void write(const std::string &path, vtkDataObject *set)
{
  vtkNew<Writer> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(set);
  writer->Write();
}

template <class DataSet> void set_fields(DataSet *set)
{
  vtkNew<vtkDoubleArray> u, p;
  u->SetName("U");
  u->SetNumberOfComponents(3);
  p->SetName("p");
  for (vtkIdType k = 0; k < set->GetNumberOfPoints(); k++) {
    double x[3];
    set->GetPoint(k, x);
    u->InsertNextTuple(velocity(x).data());
    p->InsertNextValue(pressure(x));
  }
  set->GetPointData()->AddArray(u);
  set->GetPointData()->AddArray(p);
}

// a distorted structured block, shifted along x
vtkSmartPointer<vtkStructuredGrid> block(int n, double shift)
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k <= n; k++)
    for (int j = 0; j <= n; j++)
      for (int i = 0; i <= n; i++) {
        Point x = bend({double(i) / n, double(j) / n, double(k) / n});
        x[0] += shift;
        points->InsertNextPoint(x.data());
      }
  grid->SetDimensions(n + 1, n + 1, n + 1);
  grid->SetPoints(points);
  set_fields(grid.Get());
  return grid;
}

}    // namespace

TEST(Program, maps_a_structured_grid_and_two_blocks_of_it)
{
  const Folder folder;
  write<vtkXMLStructuredGridWriter>(folder / "one.vts", block(5, 0.0));
  auto run = flowgrid_with(folder / "one.vts" + " " + (folder / "one.vtkhdf") + " --spacing 0.1");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "one.vtkhdf"), 11 * 11 * 11);

  vtkNew<vtkMultiBlockDataSet> both;
  both->SetBlock(0, block(5, 0.0));
  both->SetBlock(1, block(5, 1.0));
  write<vtkXMLMultiBlockDataWriter>(folder / "both.vtm", both);
  run = flowgrid_with((folder / "both.vtm") + " " + (folder / "both.vtkhdf") +
                      " --spacing 0.1 0.2 0.25 --compress");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("21 x 6 x 5 nodes, 630 inside"), std::string::npos) << run.text;
  EXPECT_EQ(expect_linear(folder / "both.vtkhdf"), 630);
}

TEST(Program, vtk_reads_what_it_writes)
{
  const Folder folder;
  write<vtkXMLStructuredGridWriter>(folder / "one.vts", block(5, 0.0));
  for (const std::string &more : {std::string(""), std::string(" --planar 0.5")}) {
    const auto run = flowgrid_with(folder / "one.vts" + " " + (folder / "one.vtkhdf") +
                                   " --spacing 0.125 --bounds 0.25 0.75 0 1 0.25 0.75" + more);
    ASSERT_EQ(run.status, 0) << run.text;
    vtkNew<vtkHDFReader> reader;
    reader->SetFileName((folder / "one.vtkhdf").c_str());
    reader->Update();
    auto *image = vtkImageData::SafeDownCast(reader->GetOutput());
    ASSERT_NE(image, nullptr);
    EXPECT_EQ(image->GetNumberOfPoints(), more.empty() ? 5 * 9 * 5 : 5 * 9 * 2);
    auto *u = image->GetPointData()->GetArray("velocity");
    ASSERT_NE(u, nullptr);
    for (vtkIdType k = 0; k < (more.empty() ? image->GetNumberOfPoints() : 45); k++) {
      double x[3];
      image->GetPoint(k, x);
      if (!more.empty()) EXPECT_EQ(x[2], 0.5);
      for (int c = 0; c < 3; c++) EXPECT_NEAR(u->GetComponent(k, c), velocity(x)[c], 1e-12);
    }
  }
}

TEST(Program, wedges_and_lengths_to_scale)
{
  // a cube of two wedges, in millimetres
  const Folder folder;
  vtkNew<vtkUnstructuredGrid> grid;
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (int k = 0; k < 8; k++) points->InsertNextPoint(k & 1, k >> 1 & 1, k >> 2);
  grid->SetPoints(points);
  const vtkIdType a[6] = {0, 1, 2, 4, 5, 6}, b[6] = {1, 3, 2, 5, 7, 6};
  grid->InsertNextCell(VTK_WEDGE, 6, a);
  grid->InsertNextCell(VTK_WEDGE, 6, b);
  set_fields(grid.Get());
  write<vtkXMLUnstructuredGridWriter>(folder / "wedges.vtu", grid);
  const auto run = flowgrid_with((folder / "wedges.vtu") + " " + (folder / "wedges.vtkhdf") +
                                 " --spacing 1e-4 --scale 1e-3");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "wedges.vtkhdf", 1e-3), 1331);
}

TEST(Program, linear_fields_of_cells_are_exact)
{
  // the value of a cell is that at the mean of its corners
  const Folder folder;
  auto grid = block(6, 0.0);
  vtkNew<vtkDoubleArray> u, p;
  u->SetName("U");
  u->SetNumberOfComponents(3);
  p->SetName("p");
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); c++) {
    auto *cell = grid->GetCell(c);
    double centre[3] = {};
    for (int k = 0; k < 8; k++)
      for (int n = 0; n < 3; n++) centre[n] += cell->GetPoints()->GetPoint(k)[n] / 8.0;
    u->InsertNextTuple(velocity(centre).data());
    p->InsertNextValue(pressure(centre));
  }
  grid->GetPointData()->Initialize();
  grid->GetCellData()->AddArray(u);
  grid->GetCellData()->AddArray(p);
  write<vtkXMLStructuredGridWriter>(folder / "cells.vts", grid);
  const auto run =
      flowgrid_with((folder / "cells.vts") + " " + (folder / "cells.vtkhdf") + " --spacing 0.05");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "cells.vtkhdf"), 21 * 21 * 21);
}

TEST(Program, surfaces_beside_a_mesh_in_space_are_left_out)
{
  // one without the fields, one with other ones
  const Folder folder;
  vtkNew<vtkImageData> bare, other;
  for (auto *surface : {bare.Get(), other.Get()}) {
    surface->SetDimensions(3, 3, 1);
    surface->SetSpacing(0.5, 0.5, 1.0);
  }
  set_fields(other.Get());
  other->GetPointData()->GetArray("U")->Fill(77.0);
  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, bare);
  blocks->SetBlock(1, block(4, 0.0));
  blocks->SetBlock(2, other);
  write<vtkXMLMultiBlockDataWriter>(folder / "mixed.vtm", blocks);
  const auto run =
      flowgrid_with((folder / "mixed.vtm") + " " + (folder / "mixed.vtkhdf") + " --spacing 0.05");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "mixed.vtkhdf"), 21 * 21 * 21);
}

TEST(Program, slip_is_not_reported_where_no_wall_is_known)
{
  const Folder folder;
  write<vtkXMLStructuredGridWriter>(folder / "one.vts", block(5, 0.0));    // w = 0.25 everywhere
  const std::string out = " " + (folder / "out.vtkhdf") + " ";
  const struct {
    std::string words, is;
  } table[] = {
      {(folder / "one.vts") + out + "--spacing 0.1", "no walls known: no patch is one"},
      {poiseuille + out + "--spacing 0.05 --planar 0.05 --bounds 1 2 0.3 0.7 0 0",
       "68 points, none of them within the grid"},
      {poiseuille + out + "--spacing 0.05 --planar 0.05", "68 points; largest velocity there"},
      {poiseuille + out + "--spacing 0.05 --planar 0.05 --bounds 1 2 0 0.7 0 0",
       "10 of 68 points; largest velocity there"},
  };
  for (const auto &row : table) {
    const auto run = flowgrid_with(row.words);
    EXPECT_EQ(run.status, 0) << run.text;
    EXPECT_NE(run.text.find("walls    " + row.is), std::string::npos) << row.words << run.text;
    EXPECT_EQ(run.text.find("largest velocity there") != std::string::npos,
              row.is.find("largest velocity there") != std::string::npos)
        << run.text;
  }
}

TEST(Program, bar_of_every_long_stage_on_a_terminal_only)
{
  const Folder folder;
  const std::string words = poiseuille + " " + (folder / "p.vtkhdf") +
      " --spacing 0.05 --planar 0.05 --distance --particle 0.1";
  const auto quiet = flowgrid_with(words);
  EXPECT_EQ(quiet.status, 0) << quiet.text;
  EXPECT_EQ(quiet.text.find('\r'), std::string::npos) << quiet.text;
  EXPECT_EQ(quiet.text.find('#'), std::string::npos) << quiet.text;

  const auto run = flowgrid_on_terminal(words);
  EXPECT_EQ(run.status, 0) << run.text;
  for (const std::string stage :
       {"reading", "cells", "fitting", "mapping", "writing", "walls", "checking"}) {
    std::vector<int> percents;
    const std::string head = "\r" + stage + std::string(8 - stage.size(), ' ') + " ";
    for (size_t at = run.text.find(head); at != std::string::npos; at = run.text.find(head, at + 1))
      percents.push_back(std::stoi(run.text.substr(at + head.size(), 4)));
    ASSERT_GE(percents.size(), 2u) << stage << "\n" << run.text;
    EXPECT_EQ(percents.back(), 100) << stage;
    EXPECT_LE(percents.size(), 4u * 101) << stage << " is shown when it has changed";
  }
  // the bar is as long as it says, and gone before the report and at the end
  const size_t full = run.text.find("\rmapping  100 % [" + std::string(40, '#') + "]");
  ASSERT_NE(full, std::string::npos) << run.text;
  const std::string erase = "\r\033[K";
  EXPECT_EQ(run.text.find(erase, full), run.text.find("grid     81 x 21") - erase.size());
  EXPECT_LT(run.text.rfind('#'), run.text.rfind(erase));
}

TEST(Program, wrong_input_is_named)
{
  const Folder folder;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  write<vtkXMLImageDataWriter>(folder / "empty.vti", image);
  set_fields(image.Get());
  write<vtkXMLImageDataWriter>(folder / "good.vti", image);
  image->GetPointData()->GetArray("U")->SetComponent(5, 1, NAN);
  write<vtkXMLImageDataWriter>(folder / "nan.vti", image);
  std::ofstream(folder / "broken.vtu") << "<VTKFile type=\"Unstr";
  fs::create_directories(folder.path / "nocase");

  const std::string out = " " + (folder / "out.vtkhdf") + " ", good = (folder / "good.vti");
  struct Row {
    std::string words;
    int status;
    std::string message;
  };
  const Row rows[] = {
      {"", 2, "INPUT and OUTPUT are needed"},
      {good + out, 2, "--spacing is needed"},
      {good + out + "--spacing 1 --compress --spacing 2", 2, "--spacing is given twice"},
      {good + out + "--spacing 1 --shape 'a: disc(0,0, 1)' --isosurface a.ply", 2,
       "--isosurface must end in .vtp or .stl, got a.ply"},
      {good + out + "--spacing 0", 2, "--spacing must be > 0, got 0"},
      {good + out + "--spacing x", 2, "takes a number, got x"},
      {good + out + "--spacing 1 --speed 3", 2, "there is no option --speed"},
      {good + out + "--spacing 1 --bounds 1 0 0 1 0 1", 2, "along x must not be below"},
      {good + out + "--spacing 1 --scale -1", 2, "--scale must be > 0, got -1"},
      {(folder / "none.vtu") + out + "--spacing 1", 1, "none.vtu: does not exist"},
      {(folder / "empty.vti") + out + "--spacing 1", 1, "has no array U or velocity"},
      {good + out + "--spacing 1 --velocity W", 1, "there are: U, p"},
      {good + out + "--spacing 1 --bounds 5 6 0 1 0 1", 1, "5 to 6 along x miss the mesh"},
      {good + out + "--spacing 9", 1, "is wider than the bounds"},
      {good + out + "--spacing 1e-9", 1, "more than 2e9 nodes"},
      {good + out + "--spacing 1 --planar 7", 1, "--planar must lie within the mesh"},
      {(folder / "nan.vti") + out + "--spacing 1", 1, "array U is not finite at point 5"},
      {(folder / "broken.vtu") + out + "--spacing 1", 1, "cannot be read"},
      {(folder / "nocase") + out + "--spacing 1", 1, "is no OpenFOAM case"},
      {good + " /nowhere/out.vtkhdf --spacing 1", 1, "/nowhere/out.vtkhdf: cannot be created"},
      {good + out + "--spacing 1 --bounds 5e-7 6e-7 0 1 0 1", 1,
       "--spacing 1 along x is wider than the bounds, 1e-07"},
      {good + out + "--spacing 1 --times 0:1", 1, "has no times, --times 0:1 is for a series"},
      {good + out + "--spacing 1 --distance", 1, "has no walls for --distance"},
      {good + out + "--spacing 1 --wall roof", 1, "--wall is for OpenFOAM cases"},
      {good + " " + good + " --spacing 1", 2, "OUTPUT must end in .vtkhdf, got " + good},
      {poiseuille + out + "--spacing 0.1 --wall roof", 1, "has no patch roof"},
  };
  for (const auto &row : rows) {
    const auto run = flowgrid_with(row.words);
    EXPECT_EQ(run.status, row.status) << row.words << "\n" << run.text;
    EXPECT_NE(run.text.find(row.message), std::string::npos) << row.words << "\n" << run.text;
  }
  EXPECT_EQ(flowgrid_with("--help").status, 0);
}
