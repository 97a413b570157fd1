// The program: files that VTK wrote, and a case that OpenFOAM computed, come out as VTKHDF that VTK
// and APF read; wrong input gives a message and an exit code.

#include "flow/vtkhdf_file.h"
#include "meshes.h"
#include "program.h"

#include "gtest/gtest.h"

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
#include <sstream>

using namespace flowgrid;

namespace {

Point velocity(const double *x)
{
  return {1.0 + x[1], 0.5 * x[2] - x[0], 0.25};
}
double pressure(const double *x)
{
  return 3.0 - x[0] + 2.0 * x[1];
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

// the linear fields above at every node that is inside, read by APF's reader; how many there were
int expect_linear(const std::string &file, int frame = 0, double scale = 1.0)
{
  const apf::VtkhdfFile hdf(file);
  const auto &g = hdf.grid();
  const auto u = hdf.read("velocity", 3, frame, g.n[2]), p = hdf.read("pressure", 1, frame, g.n[2]),
             inside = hdf.read("inside", 1, frame, g.n[2]);
  int count = 0;
  for (size_t node = 0; node < g.nodes(); node++) {
    const size_t at[3] = {node % g.n[0], node / g.n[0] % g.n[1], node / g.n[0] / g.n[1]};
    double x[3];
    for (int c = 0; c < 3; c++) x[c] = (g.origin[c] + at[c] * g.spacing[c]) / scale;
    if (inside[node] == 0.0) {
      EXPECT_EQ(u[3 * node], 0.0);
      continue;
    }
    count++;
    for (int c = 0; c < 3; c++) EXPECT_NEAR(u[3 * node + c], velocity(x)[c], 1e-12);
    EXPECT_NEAR(p[node], pressure(x), 1e-12);
  }
  return count;
}

}    // namespace

TEST(Program, maps_a_structured_grid_and_two_blocks_of_it)
{
  const Folder folder;
  vtkNew<vtkXMLStructuredGridWriter> one;
  one->SetFileName((folder / "one.vts").c_str());
  one->SetInputData(block(5, 0.0));
  one->Write();
  auto run = flowgrid_with(folder / "one.vts" + " " + (folder / "one.vtkhdf") + " --spacing 0.1");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "one.vtkhdf"), 11 * 11 * 11);

  vtkNew<vtkMultiBlockDataSet> both;
  both->SetBlock(0, block(5, 0.0));
  both->SetBlock(1, block(5, 1.0));
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetFileName((folder / "both.vtm").c_str());
  writer->SetInputData(both);
  writer->Write();
  run = flowgrid_with((folder / "both.vtm") + " " + (folder / "both.vtkhdf") +
                      " --spacing 0.1 0.2 0.25 --compress");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("21 x 6 x 5 nodes, 630 inside"), std::string::npos) << run.text;
  EXPECT_EQ(expect_linear(folder / "both.vtkhdf"), 630);
}

TEST(Program, vtk_reads_what_it_writes)
{
  const Folder folder;
  vtkNew<vtkXMLStructuredGridWriter> one;
  one->SetFileName((folder / "one.vts").c_str());
  one->SetInputData(block(5, 0.0));
  one->Write();
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
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  writer->SetFileName((folder / "wedges.vtu").c_str());
  writer->SetInputData(grid);
  writer->Write();
  const auto run = flowgrid_with((folder / "wedges.vtu") + " " + (folder / "wedges.vtkhdf") +
                                 " --spacing 1e-4 --scale 1e-3");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "wedges.vtkhdf", 0, 1e-3), 1331);
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
  vtkNew<vtkXMLStructuredGridWriter> writer;
  writer->SetFileName((folder / "cells.vts").c_str());
  writer->SetInputData(grid);
  writer->Write();
  const auto run =
      flowgrid_with((folder / "cells.vts") + " " + (folder / "cells.vtkhdf") + " --spacing 0.05");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "cells.vtkhdf"), 21 * 21 * 21);
}

namespace {

// by write_blocks.py, which knows neither VTK nor CGNS's library: the linear fields on two blocks
void write_blocks(const std::string &words)
{
  ASSERT_EQ(std::system((std::string(FLOWGRID_BLOCKS) + " " + words).c_str()), 0)
      << "needs Debian's python3-h5py";
}

}    // namespace

TEST(Program, plot3d_of_several_blocks)
{
  for (const std::string how : {"ascii", "binary", "fortran"}) {
    const Folder folder;
    const std::string grid = folder / "g.xyz", solution = folder / "g.q", out = folder / "g.vtkhdf";
    write_blocks("plot3d " + grid + " " + solution + " " + how);
    const auto run =
        flowgrid_with(grid + " " + out + " --solution " + solution + " --spacing 0.05");
    EXPECT_EQ(run.status, 0) << how << run.text;
    EXPECT_EQ(expect_linear(out), 41 * 21 * 21) << how;
  }
}

TEST(Program, plot3d_of_one_block_in_the_plane)
{
  // density 2, velocity (1 + y, -x), gamma 1.4
  const Folder folder;
  const std::string grid = folder / "g.x", solution = folder / "g.q", out = folder / "g.vtkhdf";
  std::ofstream(grid) << "3 2\n0 0.5 1 0 0.5 1\n0 0 0 1 1 1\n";
  std::ofstream(solution) << "3 2\n0.5 0 1 0\n2 2 2 2 2 2\n2 2 2 4 4 4\n0 -1 -2 0 -1 -2\n"
                             "9 9 9 9 9 9\n";
  const auto run = flowgrid_with(grid + " " + out + " --solution " + solution + " --spacing 0.25");
  ASSERT_EQ(run.status, 0) << run.text;
  const apf::VtkhdfFile hdf(out);
  const auto u = hdf.read("velocity", 3, 0, 1);
  ASSERT_EQ(hdf.grid().n[0], 5);
  for (int j = 0; j < 5; j++)
    for (int i = 0; i < 5; i++) {
      EXPECT_NEAR(u[3 * (5 * j + i)], 1.0 + 0.25 * j, 1e-6);
      EXPECT_NEAR(u[3 * (5 * j + i) + 1], -0.25 * i, 1e-6);
    }
}

TEST(Program, plot3d_that_cannot_be_mapped_is_refused)
{
  const Folder folder;
  std::ofstream(folder / "g.q") << "3 2\n0.5 0 1 0\n2 2 2 2 2 2\n2 2 2 4 4 4\n0 -1 -2 0 -1 -2\n"
                                   "9 9 9 9 9 9\n";
  const std::string rest = " " + (folder / "out.vtkhdf") + " --spacing 0.25";
  const std::string q = " --solution " + (folder / "g.q");
  std::ofstream(folder / "short.x") << "3 2\n0 0.5 1 0 0.5 1\n0 0 0 1 1\n";
  std::ofstream(folder / "blank.x") << "3 2\n0 0.5 1 0 0.5 1\n0 0 0 1 1 1\n1 1 0 1 1 1\n";
  const struct {
    std::string words, message;
  } table[] = {
      {(folder / "short.x") + rest + q, "holds more or fewer numbers than a PLOT3D grid"},
      {(folder / "blank.x") + rest + q, "has blanked points"},
      {(folder / "blank.x") + rest, "a PLOT3D grid needs its solution"},
      {(folder / "blank.x") + rest + " --solution none.q", "none.q: does not exist"},
  };
  for (const auto &row : table) {
    const auto run = flowgrid_with(row.words);
    EXPECT_EQ(run.status, 1) << row.words;
    EXPECT_NE(run.text.find(row.message), std::string::npos) << row.words << "\n" << run.text;
  }
}

TEST(Program, cgns_with_values_at_points_and_in_cells)
{
  for (const std::string where : {"Vertex", "CellCenter"}) {
    const Folder folder;
    const std::string file = folder / "g.cgns", out = folder / "g.vtkhdf";
    write_blocks("cgns " + file + " " + where);
    const auto run = flowgrid_with(file + " " + out + " --spacing 0.05");
    EXPECT_EQ(run.status, 0) << where << run.text;
    EXPECT_EQ(expect_linear(out), 41 * 21 * 21) << where;
  }
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
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetFileName((folder / "mixed.vtm").c_str());
  writer->SetInputData(blocks);
  writer->Write();
  const auto run =
      flowgrid_with((folder / "mixed.vtm") + " " + (folder / "mixed.vtkhdf") + " --spacing 0.05");
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_EQ(expect_linear(folder / "mixed.vtkhdf"), 21 * 21 * 21);
}

namespace {

const std::string poiseuille = std::string(FLOWGRID_DATA) + "/poiseuille";

// the velocity on 81 x 21 nodes of a case like that
std::vector<double> velocity_of_case(const std::string &folder, const std::string &out,
                                     const std::string &more = "")
{
  const auto run = flowgrid_with(folder + " " + out + " --spacing 0.05 --planar 0.05" + more);
  EXPECT_EQ(run.status, 0) << run.text;
  EXPECT_NE(run.text.find("68 points"), std::string::npos) << "walls are known\n" << run.text;
  return run.status ? std::vector<double>() : apf::VtkhdfFile(out).read("velocity", 3, 0, 1);
}

}    // namespace

TEST(Program, binary_and_compressed_cases)
{
  // data/binary: the numbers of data/poiseuille, as foamFormatConvert writes them
  const Folder folder;
  const auto text = velocity_of_case(poiseuille, folder / "text.vtkhdf");
  const auto binary =
      velocity_of_case(std::string(FLOWGRID_DATA) + "/binary", folder / "binary.vtkhdf");
  fs::copy(poiseuille, folder / "zipped", fs::copy_options::recursive);
  ASSERT_EQ(
      std::system(("gzip -r " + (folder / "zipped/4") + " " + (folder / "zipped/constant/polyMesh"))
                      .c_str()),
      0);
  const auto zipped = velocity_of_case(folder / "zipped", folder / "zipped.vtkhdf");
  EXPECT_EQ(zipped, text);
  ASSERT_EQ(binary.size(), text.size());
  for (size_t k = 0; k < text.size(); k++) EXPECT_NEAR(binary[k], text[k], 1e-12);
}

TEST(Program, inlet_without_gradient_has_the_values_of_cells)
{
  // as where pressure drives the flow; the flow in the first cells is still nearly uniform
  const Folder folder;
  fs::copy(poiseuille, folder / "case", fs::copy_options::recursive);
  std::ostringstream text;
  text << std::ifstream(folder / "case/4/U").rdbuf();
  std::string fields = text.str();
  const size_t inlet = fields.find("inlet"), end = fields.find('}', inlet);
  ASSERT_NE(end, std::string::npos);
  fields.replace(inlet, end - inlet, "inlet { type zeroGradient; ");
  std::ofstream(folder / "case/4/U") << fields;
  const auto u = velocity_of_case(folder / "case", folder / "out.vtkhdf");
  ASSERT_EQ(u.size(), 3u * 81 * 21);
  for (int j = 4; j <= 16; j += 4) {
    const double *first = &u[3 * 81 * j];    // nodes 0.05 apart, cells 0.25 long
    for (int c = 0; c < 2; c++) EXPECT_NEAR(first[c], first[3 * 2 + c], 0.08) << j;
    EXPECT_GT(std::fabs(first[0] - 1.0), 1e-3) << "not the inlet that was";
  }
}

TEST(Program, poiseuille_flow_of_openfoam)
{
  // data/poiseuille: icoFoam's result on 16 x 10 cells, 4 long and 1 wide, mean velocity 1
  const Folder folder;
  const auto run =
      flowgrid_with(poiseuille + " " + (folder / "p.vtkhdf") + " --spacing 0.05 --planar 0.05");
  ASSERT_EQ(run.status, 0) << run.text;
  const apf::VtkhdfFile hdf(folder / "p.vtkhdf");
  const auto &g = hdf.grid();
  ASSERT_EQ(g.n[0], 81);
  ASSERT_EQ(g.n[1], 21);
  const auto u = hdf.read("velocity", 3, 0, 1);
  double largest = 0.0;
  for (int j = 0; j < 21; j++) {
    const double y = 0.05 * j;
    const double *at = &u[3 * (j * 81 + 75)];
    EXPECT_NEAR(at[0], 6.0 * y * (1.0 - y), 0.08) << y;
    EXPECT_NEAR(at[1], 0.0, 0.01) << y;
    largest = std::max(largest, at[0]);
    if (j > 1 && j < 19) EXPECT_NEAR(u[3 * j * 81], 1.0, 1e-6) << "inlet, " << y;
  }
  EXPECT_NEAR(largest, 1.5, 0.05);
  for (int i = 0; i < 81; i++) {
    EXPECT_EQ(u[3 * i], 0.0) << "the wall below rests";
    EXPECT_NEAR(u[3 * (20 * 81 + i)], 0.0, 1e-14) << "the wall above rests";
  }
}

TEST(Program, slip_is_not_reported_where_no_wall_is_known)
{
  const Folder folder;
  vtkNew<vtkXMLStructuredGridWriter> one;
  one->SetFileName((folder / "one.vts").c_str());
  one->SetInputData(block(5, 0.0));    // w = 0.25 everywhere
  one->Write();
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
      percents.push_back(std::atoi(run.text.c_str() + at + head.size()));
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

TEST(Program, times_of_a_case_become_a_series)
{
  const Folder folder;
  auto run = flowgrid_with(poiseuille + " " + (folder / "all.vtkhdf") +
                           " --spacing 0.1 --planar 0.05 --times all");
  ASSERT_EQ(run.status, 0) << run.text;
  run = flowgrid_with(poiseuille + " " + (folder / "last.vtkhdf") + " --spacing 0.1 --planar 0.05");
  ASSERT_EQ(run.status, 0) << run.text;
  const apf::VtkhdfFile all(folder / "all.vtkhdf"), last(folder / "last.vtkhdf");
  ASSERT_EQ(all.times().size(), 2u);
  EXPECT_EQ(all.times()[0], 0.0);
  EXPECT_EQ(all.read("velocity", 3, 1, 1), last.read("velocity", 3, 0, 1));
  EXPECT_NE(all.read("velocity", 3, 0, 1), last.read("velocity", 3, 0, 1));
}

TEST(Program, wrong_input_is_named)
{
  const Folder folder;
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 3, 3);
  vtkNew<vtkXMLImageDataWriter> writer;
  writer->SetInputData(image);
  writer->SetFileName((folder / "empty.vti").c_str());
  writer->Write();
  set_fields(image.Get());
  writer->SetFileName((folder / "good.vti").c_str());
  writer->Write();
  image->GetPointData()->GetArray("U")->SetComponent(5, 1, NAN);
  writer->SetFileName((folder / "nan.vti").c_str());
  writer->Write();
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
