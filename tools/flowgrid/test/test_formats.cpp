// What flowgrid reads besides files of VTK: PLOT3D, CGNS, and a case that OpenFOAM computed.

#include "linear_fields.h"
#include "program.h"

#include <fstream>
#include <sstream>

using namespace flowgrid;

namespace {

// by write_blocks.py, which knows neither VTK nor CGNS's library: the linear fields on two blocks
void write_blocks(const std::string &words)
{
  ASSERT_EQ(std::system((std::string(FLOWGRID_BLOCKS) + " " + words).c_str()), 0)
      << "needs Debian's python3-h5py";
}

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
