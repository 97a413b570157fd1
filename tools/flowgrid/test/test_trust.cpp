// Files are not trusted: what they say of sizes and of points is checked before it is used, and
// where VTK crashes on one the program says on which.

#include "program.h"

#include "gtest/gtest.h"

#include <hdf5.h>

#include <fstream>
#include <functional>
#include <sys/resource.h>
#include <sys/stat.h>

using namespace flowgrid;

namespace {

std::string vtu(const std::string &corners, const std::string &ends, const std::string &types,
                const std::string &cells = "1")
{
  return "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" "
         "header_type=\"UInt64\"><UnstructuredGrid>"
         "<Piece NumberOfPoints=\"4\" NumberOfCells=\"" +
      cells +
      "\"><PointData><DataArray type=\"Float64\" Name=\"U\" NumberOfComponents=\"3\" "
      "format=\"ascii\">"
      "0 0 0 1 0 0 0 1 0 0 0 1</DataArray></PointData><Points><DataArray type=\"Float64\" "
      "NumberOfComponents=\"3\" format=\"ascii\">0 0 0 1 0 0 0 1 0 0 0 "
      "1</DataArray></Points><Cells>"
      "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">" +
      corners + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" + ends +
      "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" + types +
      "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

// a .vtm of one block, or of many
std::string blocks(const std::string &name, int count = 1)
{
  std::string text =
      "<VTKFile type=\"vtkMultiBlockDataSet\" version=\"1.0\"><vtkMultiBlockDataSet>";
  for (int k = 0; k < count; k++)
    text += "<DataSet index=\"" + std::to_string(k) + "\" file=\"" + (k % 2 ? "./" : "") + name +
        "\"/>";
  return text + "</vtkMultiBlockDataSet></VTKFile>";
}

class Trust : public testing::Test {
 protected:
  const Folder folder;

  Result run(const std::string &name, const std::string &contents, const std::string &words = "")
  {
    std::ofstream(folder / name, std::ios::binary) << contents;
    return flowgrid_with((folder / name) + " " + (folder / "out.vtkhdf") + " --spacing 0.3 " +
                         words);
  }
  Result run_surface(const std::string &name, const std::string &contents)
  {
    std::ofstream(folder / name, std::ios::binary) << contents;
    return flowgrid_with((folder / "out.vtkhdf") +
                         " --spacing 0.3 --bounds -1 1 -1 1 -1 1 --wall-surface " +
                         (folder / name));
  }
  // refused, by a message with the name of the file and these words
  void expect_refused(const Result &result, const std::string &name, const std::string &words)
  {
    EXPECT_EQ(result.status, 1) << result.text;
    EXPECT_NE(result.text.find((folder / name) + ": "), std::string::npos) << result.text;
    EXPECT_NE(result.text.find(words), std::string::npos) << result.text;
  }
};

}    // namespace

TEST_F(Trust, a_tetrahedron_is_read)
{
  EXPECT_EQ(run("good.vtu", vtu("0 1 2 3", "4", "10")).status, 0);
}

TEST_F(Trust, corners_must_be_points_of_the_mesh)
{
  expect_refused(run("far.vtu", vtu("0 1 2 99", "4", "10")), "far.vtu",
                 "a cell has point 99, but there are 4 points");
  expect_refused(run("far.vtu", vtu("0 1 2 -1", "4", "10")), "far.vtu", "a cell has point -1");
  expect_refused(run("far.vtu", vtu("0 1 2 9223372036854775807", "4", "10")), "far.vtu",
                 "a cell has point 92233720368547758");
}

TEST_F(Trust, cells_must_have_the_corners_of_their_type)
{
  expect_refused(run("few.vtu", vtu("0 1 2", "3", "10")), "few.vtu",
                 "cell 0 has 3 corners, but its type has 4");
  expect_refused(run("type.vtu", vtu("0 1 2 3", "4", "200")), "type.vtu",
                 "cell 0 is of the type 200, which VTK does not know");
  expect_refused(run("few.vtu", vtu("0 1 2 3", "4", "12")), "few.vtu", "but its type has 8");
}

TEST_F(Trust, points_must_be_numbers_that_make_a_mesh)
{
  for (const std::string x : {"1e200", "-1e101"}) {
    auto text = vtu("0 1 2 3", "4", "10");
    const std::string last = "0 0 1</DataArray></Points>";
    ASSERT_NE(text.find(last), std::string::npos);
    text.replace(text.find(last), 5, "0 0 " + x);
    expect_refused(run("far.vtu", text), "far.vtu", "point 3 is not finite, or beyond 1e100");
  }
}

// All points of a solid cell in a plane, and all in one: no cell holds a node.
TEST_F(Trust, cells_without_a_volume)
{
  for (const std::string z : {"0 0 0", "1 1 0"}) {
    auto text = vtu("0 1 2 3", "4", "10");
    const std::string last = "0 0 1</DataArray></Points>";
    text.replace(text.find(last), 5, z);
    const auto result = run("flat.vtu", text);
    EXPECT_TRUE(result.status == 0 || result.status == 1) << result.text;
    EXPECT_EQ(result.text.find("damaged"), std::string::npos) << result.text;
  }
}

TEST_F(Trust, lists_of_corners_must_ascend)
{
  expect_refused(run("end.vtu", vtu("0 1 2 3 0 1 2 3", "-4 8", "10 10", "2")), "end.vtu", "");
  expect_refused(run("end.vtu", vtu("0 1 2 3", "400000000", "10")), "end.vtu", "");
}

TEST_F(Trust, sizes_that_are_not_there)
{
  expect_refused(run("huge.vtu", vtu("0 1 2 3", "4", "10", "4000000000000")), "huge.vtu", "");
  expect_refused(
      run("huge.vti",
          "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 100000 0 "
          "100000 0 100000\" Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 100000 0 "
          "100000 0 100000\"><PointData/></Piece></ImageData></VTKFile>"),
      "huge.vti", "");
  expect_refused(run("huge.vtk",
                     "# vtk DataFile Version 3.0\nx\nASCII\nDATASET UNSTRUCTURED_GRID\n"
                     "POINTS 99999999999 float\n0 0 0\n"),
                 "huge.vtk", "");
}

// VTK makes room for them before it looks.
TEST_F(Trust, points_of_less_than_no_components)
{
  auto text = vtu("0 1 2 3", "4", "10");
  text.replace(text.find("Components=\"3"), 13, "Components=\"-3");
  expect_refused(run("less.vtu", text), "less.vtu", "is damaged; VTK says: ");
}

TEST_F(Trust, surfaces_that_say_more_than_they_have)
{
  std::string stl(80, 'x');
  stl += "\xff\xff\xff\xff" + std::string(50, '\xff');
  expect_refused(run_surface("huge.stl", stl), "huge.stl",
                 "says that it has 4294967295 triangles, but is too short for them");
  expect_refused(run_surface("far.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 99\n"), "far.obj",
                 "a cell has point 98, but there are 3 points");
}

TEST_F(Trust, plot3d_of_a_part_of_a_block)
{
  std::ofstream(folder / "q") << "0\n";
  const std::string words = "--solution " + (folder / "q");
  for (const char *text : {"2.5 2 2 2 2 2 2\n", "-1 2 2\n", "1e9 2 2 2\n", " \n"})
    expect_refused(run("part.xyz", text, words), "part.xyz", "");
}

// A right mesh beside the folder of the .vtm is not read, however its name is written; within the
// folder it is, by a link, too.
TEST_F(Trust, blocks_are_in_the_folder_of_their_file)
{
  fs::create_directories(folder / "case/blocks");
  const std::string mesh = vtu("0 1 2 3", "4", "10"), refused = "is not in its folder or below";
  std::ofstream(folder / "mesh.vtu") << mesh;
  std::ofstream(folder / "case/blocks/mesh.vtu") << mesh;
  fs::create_symlink(folder / "mesh.vtu", folder / "case/link.vtu");
  for (const std::string name : {"blocks/mesh.vtu", "./blocks//mesh.vtu", "link.vtu"})
    EXPECT_EQ(run("case/good.vtm", blocks(name)).status, 0) << name;
  for (const std::string &name :
       {std::string("../mesh.vtu"), std::string("blocks/../../mesh.vtu"), folder / "mesh.vtu",
        std::string("&#46;&#46;/mesh.vtu"), std::string("&#x2e;.&#47;mesh.vtu"),
        std::string("c:mesh.vtu"), std::string("~/mesh.vtu"), std::string("..\\mesh.vtu")})
    expect_refused(run("case/bad.vtm", blocks(name)), "case/bad.vtm", refused);
  auto spaced = blocks("../mesh.vtu");
  spaced.replace(spaced.find("file="), 5, "file\n = ");
  expect_refused(run("case/spaced.vtm", spaced), "case/spaced.vtm", refused);
  // the type is what is written in the file
  expect_refused(run("case/other.vtu", blocks("../mesh.vtu")), "case/other.vtu", refused);
  expect_refused(run("case/pieces.vtu",
                     "<VTKFile type=\"PUnstructuredGrid\" version=\"0.1\"><PUnstructuredGrid "
                     "GhostLevel=\"0\"><PPoints><PDataArray type=\"Float64\" "
                     "NumberOfComponents=\"3\"/></PPoints><Piece "
                     "Source=\"../mesh.vtu\"/></PUnstructuredGrid></VTKFile>"),
                 "case/pieces.vtu", refused);
  expect_refused(run("format.vtm", blocks("%s%n")), "format.vtm", "");
}

// A pipe to which nobody writes would be waited for.
TEST_F(Trust, what_is_not_a_regular_file)
{
  const std::string words = " " + (folder / "out.vtkhdf") + " --spacing 0.3 --planar 0.05 ",
                    why = "is not a regular file";
  for (const char *pipe : {"pipe.vtu", "pipe.stl", "pipe.q"})
    ASSERT_EQ(mkfifo((folder / pipe).c_str(), 0600), 0);
  fs::create_directories(folder / "folder.vtu");
  for (const std::string name : {"pipe.vtu", "./pipe.vtu", "folder.vtu"}) {
    expect_refused(run("blocks.vtm", blocks(name)), "blocks.vtm", "names ");
    expect_refused(run("blocks.vtm", blocks(name)), "blocks.vtm", why);
  }
  expect_refused(flowgrid_with((folder / "pipe.vtu") + words), "pipe.vtu", why);
  expect_refused(flowgrid_with((folder / "out.vtkhdf") +
                               " --spacing 0.3 --bounds 0 1 0 1 0 1 --wall-surface " +
                               (folder / "pipe.stl")),
                 "pipe.stl", why);
  std::ofstream(folder / "grid.xyz") << "2 1 1\n0 1 0 0 0 0\n";
  expect_refused(flowgrid_with((folder / "grid.xyz") + words + "--solution " + (folder / "pipe.q")),
                 "pipe.q", why);
  fs::copy(poiseuille, folder / "case", fs::copy_options::recursive);
  ASSERT_EQ(flowgrid_with((folder / "case") + words).status, 0);
  for (const std::string part : {"case/constant/polyMesh/points", "case/4/U"}) {
    fs::rename(folder / part, folder / "part");
    ASSERT_EQ(mkfifo((folder / part).c_str(), 0600), 0);
    expect_refused(flowgrid_with((folder / "case") + words), part, why);
    fs::rename(folder / "part", folder / part);
  }
}

// The numbers of a field are in another file. Within the case it is read, however it is named; the
// same file beside the case is not, however the #include is written.
TEST_F(Trust, files_that_a_case_includes_are_in_its_folder)
{
  fs::copy(poiseuille, folder / "case", fs::copy_options::recursive);
  fs::create_directories(folder / "case/parts");
  fs::create_directory_symlink(folder / "case/parts", folder / "case/4/link");
  const std::string field = folder / "case/4/U", refused = "which is not in the folder of the case";
  std::ifstream in(field);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const size_t begin = text.find("internalField"), end = text.find("boundaryField");
  ASSERT_LT(begin, end);
  ASSERT_NE(end, std::string::npos);
  const std::string numbers = text.substr(begin, end - begin);
  for (const char *name : {"outside", "case/inside", "case/4/inside", "case/parts/inside"})
    std::ofstream(folder / name) << numbers;
  const auto with = [&](const std::string &directive) {
    std::ofstream(field) << text.substr(0, begin) << directive << '\n' << text.substr(end);
    return flowgrid_with((folder / "case") + " " + (folder / "out.vtkhdf") +
                         " --spacing 0.3 --planar 0.05");
  };
  for (const std::string &name :
       {std::string("inside"), std::string("./inside"), std::string("../inside"),
        std::string("../4/inside"), std::string("link/inside"), std::string("$FOAM_CASE/inside"),
        folder / "case/inside"})
    EXPECT_EQ(with("#include \"" + name + "\"").status, 0) << name;
  for (const std::string &name :
       {std::string("../../outside"), std::string("link/../../../outside"), folder / "outside",
        std::string("$FOAM_CASE/../outside"), std::string("$HOME/outside"),
        std::string("~/outside"), std::string("$FOAM_CASE//etc/hostname")})
    expect_refused(with("#include \"" + name + "\""), "case/4/U", refused);
  for (const std::string directive :
       {"# include \"../../outside\"", "#/* x */include // y\n\"../../outside\"",
        "#\"in\\clude\" \"../../outside\"", "#sinclude \"../../outside\"",
        "#includeIfPresent \"../../outside\"", "#include ../../outside", "#include \"../../none\""})
    expect_refused(with(directive), "case/4/U", "it is not read");
  // a compressed file, and one that is included
  with("#include \"../../outside\"");
  ASSERT_EQ(std::system(("gzip " + field).c_str()), 0);
  expect_refused(flowgrid_with((folder / "case") + " " + (folder / "out.vtkhdf") +
                               " --spacing 0.3 --planar 0.05"),
                 "case/4/U.gz", refused);
  fs::remove(field + ".gz");
  std::ofstream(folder / "case/inside") << "#include \"../outside\"\n";
  expect_refused(with("#include \"../inside\""), "case/4/../inside", refused);
  // what begins in one goes on in the other
  std::ofstream(folder / "case/inside") << "#inc";
  expect_refused(with("#include \"../inside\"\nlude \"../../outside\""), "case/4/../inside",
                 "has an #include without a plain name");
  fs::remove(folder / "case/inside");
  ASSERT_EQ(mkfifo((folder / "case/inside").c_str(), 0600), 0);
  expect_refused(with("#include \"../inside\""), "case/4/U", "is not a regular file");
  // of other files nothing is included
  std::ofstream(folder / "case/parts/code.C") << "#include \"../../outside\"\n";
  EXPECT_EQ(with(numbers).status, 0);
}

// A node of a CGNS file in another one, right in itself, and the numbers of an array.
TEST_F(Trust, nodes_of_cgns_files_are_in_the_file)
{
  const std::string right = folder / "right.cgns", file = folder / "file.cgns",
                    node = "Base/Zone1/GridCoordinates";
  ASSERT_EQ(std::system((std::string(FLOWGRID_BLOCKS) + " cgns " + right + " Vertex").c_str()), 0);
  const auto with = [&](const std::function<void(hid_t)> &change) {
    fs::copy_file(right, file, fs::copy_options::overwrite_existing);
    const hid_t id = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(id);
    H5Fclose(id);
    return flowgrid_with(file + " " + (folder / "out.vtkhdf") + " --spacing 0.3");
  };
  EXPECT_EQ(with([](hid_t) {
            }).status,
            0);
  const auto by_link = [&](hid_t id) {
    ASSERT_GE(H5Ldelete(id, node.c_str(), H5P_DEFAULT), 0);
    ASSERT_GE(
        H5Lcreate_external(right.c_str(), node.c_str(), id, node.c_str(), H5P_DEFAULT, H5P_DEFAULT),
        0);
  };
  expect_refused(with(by_link), "file.cgns", node + " is a link to another file: it is not read");
  const auto beside = [&](hid_t id) {
    const hsize_t one = 1;
    const hid_t space = H5Screate_simple(1, &one, nullptr), list = H5Pcreate(H5P_DATASET_CREATE);
    H5Pset_external(list, right.c_str(), 0, 8);
    H5Dclose(H5Dcreate2(id, "Base/more", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT));
    H5Pclose(list);
    H5Sclose(space);
  };
  expect_refused(with(beside), "file.cgns", "Base/more has its numbers in another file");

  std::string adf = "@(#)ADF Database Version B02012>" + std::string(1 << 20, ' ');
  adf.replace(adf.size() - 300, 4, "NoDe");
  const auto as_adf = [&](const std::string &type) {
    adf.replace(adf.size() - 300 + 96, type.size(), type);
    return run("adf.cgns", adf);
  };
  expect_refused(as_adf("LK"), "adf.cgns", "has a node that is a link");
  expect_refused(as_adf("R8"), "adf.cgns", "");    // by VTK: it is none
  EXPECT_EQ(as_adf("R8").text.find("has a node that is a link"), std::string::npos);
}

TEST_F(Trust, a_block_of_itself)
{
  expect_refused(run("self.vtm", blocks("self.vtm")), "self.vtm", "is a block of itself");
  std::ofstream(folder / "one.vtm") << blocks("./two.vtm");
  expect_refused(run("two.vtm", blocks("one.vtm")), "two.vtm", "is a block of itself");
}

// A case may have as much memory as its files are worth, whichever way it is named.
TEST_F(Trust, sizes_that_a_case_does_not_have)
{
  fs::copy(FLOWGRID_DATA "/poiseuille", folder / "case", fs::copy_options::recursive);
  const std::string points = folder / "case/constant/polyMesh/points";
  std::ifstream in(points);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const std::string count = "\n374\n";
  ASSERT_NE(text.find(count), std::string::npos);
  text.replace(text.find(count), count.size(), "\n400000000\n");    // 4.8 Gbytes
  std::ofstream(points) << text;
  fs::create_directory_symlink(folder.path, folder / "case/loop");
  for (const std::string name : {"case", "case/a.foam", "case/a.OpenFOAM"}) {
    if (name != "case") std::ofstream(folder / name) << "";
    expect_refused(
        flowgrid_with((folder / name) + " " + (folder / "out.vtkhdf") + " --spacing 0.3"), name,
        "asks for more memory than there is, or is damaged");
  }
}

// A block of 25000 elements without sense, for which VTK's time goes with the square of their
// number, named 100 times: a minute or two. It counts once, and with 100 kbytes it has 22 s of the
// processor.
TEST_F(Trust, a_case_that_is_read_without_end)
{
  std::string block =
      "<VTKFile type=\"ImageData\" version=\"1.0\"><ImageData WholeExtent=\"0 1 0 1 0 1\" "
      "Origin=\"0 0 0\" Spacing=\"1 1 1\"><Piece Extent=\"0 1 0 1 0 1\"><PointData>";
  for (int k = 0; k < 25000; k++) block += "<a/>";
  std::ofstream(folder / "b.vti") << block << "</PointData></Piece></ImageData></VTKFile>";
  const std::string many = blocks("b.vti", 100);
  const double limit = 20.0 +
      (static_cast<double>(fs::file_size(folder / "b.vti")) + static_cast<double>(many.size())) /
          5e4;
  const auto seconds_of_children = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
        1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  const double before = seconds_of_children();
  expect_refused(run("many.vtm", many), "many.vtm",
                 "VTK works on this file for far longer than its size is worth; it is damaged");
  const double used = seconds_of_children() - before;
  EXPECT_GT(used, limit - 1.5);
  EXPECT_LT(used, limit + 4.0);
}

// Names of patches are not expressions.
TEST_F(Trust, words_of_a_case_are_taken_as_they_are)
{
  fs::copy(FLOWGRID_DATA "/poiseuille", folder / "case", fs::copy_options::recursive);
  const std::string boundary = folder / "case/constant/polyMesh/boundary";
  std::ifstream in(boundary);
  const std::string text{std::istreambuf_iterator<char>(in), {}}, old = "walls";
  ASSERT_NE(text.find(old), std::string::npos);
  for (const std::string name : {"w[", "w+"}) {
    std::string other = text;
    other.replace(other.find(old), old.size(), name);
    std::ofstream(boundary) << other;
    const auto result = flowgrid_with((folder / "case") + " " + (folder / "out.vtkhdf") +
                                      " --spacing 0.3 --planar 0.05");
    EXPECT_EQ(result.status, 0) << name << result.text;
  }
}

// As a full disk: no file may grow beyond 8 kbytes. What was there before stays as it was.
TEST_F(Trust, a_full_disk_costs_nothing)
{
  const auto contents = [&](const std::string &name) {
    std::ifstream in(folder / name, std::ios::binary);
    return std::string{std::istreambuf_iterator<char>(in), {}};
  };
  const std::string shape = " --bounds -1 1 -1 1 -1 1 --shape 's: sphere(0,0,0, 0.5)'",
                    full = "trap '' XFSZ; ulimit -f 16;";
  const auto words = [&](const std::string &out, const std::string &spacing) {
    return (folder / out) + shape + " --spacing " + spacing;
  };
  ASSERT_EQ(flowgrid_with(words("out.vtkhdf", "0.5")).status, 0);
  const auto before = contents("out.vtkhdf");
  expect_refused(flowgrid_with(words("out.vtkhdf", "0.1"), full), "out.vtkhdf",
                 "is the disk full?");
  EXPECT_EQ(contents("out.vtkhdf"), before);

  // three surfaces in few cells: their triangles need more room than the grid
  const std::string shells = " --bounds -1 1 -1 1 -1 1 --spacing 0.2 --isosurface " +
      (folder / "wall.stl") +
      " --shape 's: union(difference(sphere(0,0,0, 0.9), sphere(0,0,0, 0.65)), sphere(0,0,0, "
      "0.35))'";
  ASSERT_EQ(flowgrid_with((folder / "shells.vtkhdf") + shells).status, 0);
  const auto grid = fs::file_size(folder / "shells.vtkhdf");
  const auto surface = contents("wall.stl");
  ASSERT_GT(surface.size(), grid + 1024);
  expect_refused(flowgrid_with((folder / "other.vtkhdf") + shells,
                               "trap '' XFSZ; ulimit -f " + std::to_string(grid / 512 + 1) + ";"),
                 "wall.stl", "is the disk full?");
  EXPECT_EQ(contents("wall.stl"), surface);
  EXPECT_FALSE(fs::exists(folder / "other.vtkhdf"));
  for (const auto &entry : fs::directory_iterator(folder.path))
    EXPECT_NE(entry.path().extension(), ".part") << entry.path();
}

TEST_F(Trust, output_must_be_a_file)
{
  fs::create_symlink("/dev/full", folder / "full.vtkhdf");
  const auto result = flowgrid_with(
      (folder / "full.vtkhdf") + " --bounds 0 1 0 1 0 1 --spacing 0.5 --shape 's: disc(0,0, 1)'");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.text.find("full.vtkhdf: is not a file that can be written"), std::string::npos)
      << result.text;
}

// CGNS's library ends the program, and knows no name.
TEST_F(Trust, what_ends_the_program_is_named)
{
  expect_refused(run("text.cgns", "no mesh"), "text.cgns", "VTK failed while it read this file");
}

TEST_F(Trust, shapes_within_shapes_end)
{
  std::string deep = "a: ";
  for (int k = 0; k < 10000; k++) deep += "inside(";
  const auto result = flowgrid_with((folder / "out.vtkhdf") +
                                    " --spacing 0.3 --bounds 0 1 0 1 0 1 --shape '" + deep + "'");
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.text.find("shapes may be nested 100 deep"), std::string::npos);
}
