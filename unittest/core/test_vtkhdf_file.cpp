// The reader of VTKHDF files without LAMMPS: right files give their numbers, wrong ones an error
// that says what is wrong, before anything is allocated.

#include "flow/vtkhdf_file.h"

#include "vtkhdf_writer.h"

#include "gtest/gtest.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unistd.h>

using apf::VtkhdfFile;

namespace {

class Vtkhdf : public testing::Test {
 protected:
  const std::string path = (std::filesystem::temp_directory_path() /
                            ("apf_vtkhdf_" + std::to_string(getpid()) + ".vtkhdf"))
                               .string();
  ~Vtkhdf() override { std::filesystem::remove(path); }

  // 3 x 4 x 5 nodes
  void write(
      const std::function<void(VtkhdfWriter &)> &change =
          [](VtkhdfWriter &) {
          },
      const std::vector<double> &times = {}, hid_t type = H5T_NATIVE_DOUBLE) const
  {
    VtkhdfWriter writer(path, {3, 4, 5}, {-1, 0, 2}, {0.5, 1, 2});
    if (!times.empty()) writer.steps(times);
    writer.field("velocity", 3, velocity, times, type);
    change(writer);
  }
  static void velocity(const double *x, double t, double *u)
  {
    u[0] = 100.0 * x[0] + t;
    u[1] = 10.0 * x[1];
    u[2] = x[2];
  }
  std::vector<double> read(int frame = 0, const char *array = "velocity", int components = 3) const
  {
    const VtkhdfFile file(path);
    return file.read(array, components, frame, file.grid().n[2]);
  }
  std::string error(int frame = 0, const char *array = "velocity", int components = 3) const
  {
    try {
      read(frame, array, components);
    } catch (const std::runtime_error &problem) {
      return problem.what();
    }
    return "";
  }
  // the error of a file with something changed
  std::string error_with(const std::function<void(VtkhdfWriter &)> &change,
                         const std::vector<double> &times = {}) const
  {
    write(change, times);
    return error();
  }
  void expect(const std::string &text, const std::vector<std::string> &words) const
  {
    for (const auto &word : words)
      EXPECT_NE(text.find(word), std::string::npos) << "'" << word << "' not in: " << text;
  }
};

}    // namespace

TEST_F(Vtkhdf, gives_grid_and_velocity)
{
  for (const bool single : {false, true}) {
    write(
        [](VtkhdfWriter &) {
        },
        {}, single ? H5T_NATIVE_FLOAT : H5T_NATIVE_DOUBLE);
    const VtkhdfFile file(path);
    const int n[3] = {3, 4, 5};
    const double origin[3] = {-1, 0, 2}, spacing[3] = {0.5, 1, 2};
    for (int k = 0; k < 3; k++) {
      EXPECT_EQ(file.grid().n[k], n[k]);
      EXPECT_EQ(file.grid().origin[k], origin[k]);
      EXPECT_EQ(file.grid().spacing[k], spacing[k]);
    }
    EXPECT_TRUE(file.times().empty());
    EXPECT_TRUE(file.has("velocity"));
    EXPECT_FALSE(file.has("distance"));
    const auto u = read();
    const std::size_t node = 2 + 3 * (1 + 4 * 3);    // at (0, 1, 8)
    EXPECT_EQ(u[3 * node], 0.0);
    EXPECT_EQ(u[3 * node + 1], 10.0);
    EXPECT_EQ(u[3 * node + 2], 8.0);
    EXPECT_EQ(u[0], -100.0);
  }
}

TEST_F(Vtkhdf, extent_moves_the_origin)
{
  write([](VtkhdfWriter &w) {
    w.integers("WholeExtent", {2, 4, -1, 2, 0, 4});
  });
  const VtkhdfFile file(path);
  EXPECT_EQ(file.grid().origin[0], 0.0);
  EXPECT_EQ(file.grid().origin[1], -1.0);
  EXPECT_EQ(file.grid().n[1], 4);
}

TEST_F(Vtkhdf, lowest_layers_alone)
{
  write();
  const VtkhdfFile file(path);
  const auto u = file.read("velocity", 3, 0, 1);
  ASSERT_EQ(u.size(), 36u);
  EXPECT_EQ(u[35], 2.0);
}

TEST_F(Vtkhdf, planar_files_with_and_without_z)
{
  for (const bool flat : {false, true}) {
    {
      VtkhdfWriter writer(path, {2, 3, 1}, {0, 0, 0}, {1, 1, 1});
      std::vector<double> u(18), s(6);
      for (int k = 0; k < 18; k++) u[k] = k;
      for (int k = 0; k < 6; k++) s[k] = -k;
      writer.array("velocity",
                   flat ? std::vector<hsize_t>{3, 2, 3} : std::vector<hsize_t>{1, 3, 2, 3}, u);
      writer.array("distance", flat ? std::vector<hsize_t>{3, 2} : std::vector<hsize_t>{1, 3, 2, 1},
                   s);
    }
    EXPECT_EQ(read()[17], 17.0);
    EXPECT_EQ(read(0, "distance", 1)[5], -5.0);
  }
}

TEST_F(Vtkhdf, series)
{
  write(
      [](VtkhdfWriter &) {
      },
      {0.5, 1.0, 4.0});
  const VtkhdfFile file(path);
  EXPECT_EQ(file.times(), (std::vector<double>{0.5, 1.0, 4.0}));
  EXPECT_EQ(read(0)[0], -99.5);
  EXPECT_EQ(read(2)[0], -96.0);
}

TEST_F(Vtkhdf, steps_may_share_frames)
{
  write(
      [](VtkhdfWriter &w) {
        w.offsets("velocity", {2, 0, 2});
      },
      {0.5, 1.0, 4.0});
  EXPECT_EQ(read(0)[0], -96.0);
  EXPECT_EQ(read(1)[0], -99.5);
  EXPECT_EQ(read(2)[0], -96.0);
  expect(error_with(
             [](VtkhdfWriter &w) {
               w.offsets("velocity", {3, 0, 2});
             },
             {0.5, 1.0, 4.0}),
         {"velocity has 3 frames", "step 0 is to be frame 3"});
  expect(error_with(
             [](VtkhdfWriter &w) {
               w.offsets("velocity", {-1, 0, 2});
             },
             {0.5, 1.0, 4.0}),
         {"PointDataOffsets/velocity must be >= 0, got -1"});
  expect(error_with(
             [](VtkhdfWriter &w) {
               w.offsets("velocity", {0, 0});
             },
             {0.5, 1.0, 4.0}),
         {"PointDataOffsets/velocity must be 3 whole numbers", "shape [2]"});
}

TEST_F(Vtkhdf, one_step_is_steady)
{
  write(
      [](VtkhdfWriter &) {
      },
      {7.0});
  EXPECT_TRUE(VtkhdfFile(path).times().empty());
  EXPECT_EQ(read()[0], -93.0);
}

TEST_F(Vtkhdf, errors_of_files)
{
  std::filesystem::remove(path);
  expect(error(), {"cannot be opened", "No such file"});
  std::ofstream(path) << "This is not a grid.";
  expect(error(), {"not an HDF5 file"});
  hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  H5Fclose(file);
  expect(error(), {"no group VTKHDF"});

  write();
  const auto size = std::filesystem::file_size(path);
  for (const double part : {0.95, 0.5, 0.2}) {
    write();
    std::filesystem::resize_file(path, static_cast<std::uintmax_t>(part * size));
    expect(error(), {"truncated"});
  }
}

TEST_F(Vtkhdf, errors_of_attributes)
{
  const auto error_of = [this](const std::function<void(VtkhdfWriter &)> &change) {
    return error_with(change);
  };
  using W = VtkhdfWriter;
  for (const char *name : {"Type", "Version", "WholeExtent", "Origin", "Spacing"})
    expect(error_of([=](W &w) {
             w.remove(name);
           }),
           {std::string("attribute ") + name + " is missing"});
  EXPECT_EQ(error_of([](W &w) {
              w.remove("Direction");
            }),
            "")
      << "it has a default";
  expect(error_of([](W &w) {
           w.text("Type", "PolyData");
         }),
         {"ImageData, got PolyData"});
  expect(error_of([](W &w) {
           w.integers("Type", {1});
         }),
         {"Type must be a word"});
  expect(error_of([](W &w) {
           w.integers("Version", {3, 0});
         }),
         {"Version", "got 3.0"});
  expect(error_of([](W &w) {
           w.integers("Version", {2});
         }),
         {"Version must be 2 numbers"});
  expect(error_of([](W &w) {
           w.text("Origin", "here");
         }),
         {"Origin must be 3 numbers"});
  expect(error_of([](W &w) {
           w.numbers("Origin", {1, 2});
         }),
         {"Origin must be 3 numbers"});
  expect(error_of([](W &w) {
           w.numbers("Origin", {1, INFINITY, 2});
         }),
         {"along y must be finite"});
  expect(error_of([](W &w) {
           w.numbers("Spacing", {1, 1, 0});
         }),
         {"along z must be > 0, got 0"});
  expect(error_of([](W &w) {
           w.numbers("Spacing", {-1, 1, 1});
         }),
         {"along x must be > 0, got -1"});
  expect(error_of([](W &w) {
           w.numbers("Spacing", {1, NAN, 1});
         }),
         {"along y must be > 0"});
  expect(error_of([](W &w) {
           w.numbers("Direction", {0, 1, 0, 1, 0, 0, 0, 0, 1});
         }),
         {"Direction must be the unit matrix"});
  expect(error_of([](W &w) {
           w.integers("WholeExtent", {0, 2, 0, 3, 4, 0});
         }),
         {"along z must be ascending", "got 4 0"});
  expect(error_of([](W &w) {
           w.integers("WholeExtent", {0, 2000000000, 0, 3, 0, 4});
         }),
         {"along x", "got 0 2000000000"});
  expect(error_of([](W &w) {
           w.integers("WholeExtent", {0, 1 << 20, 0, 1 << 20, 0, 1 << 20});
         }),
         {"more than 2^40 nodes"});
}

TEST_F(Vtkhdf, errors_of_arrays)
{
  write();
  expect(error(0, "distance", 1), {"no point array distance", "it has velocity"});
  expect(error(0, "velocity", 1), {"velocity must have shape [5][4][3]", "got [5][4][3][3]"});
  const auto error_of = [this](const std::vector<hsize_t> &dims, std::size_t count,
                               hid_t type = H5T_NATIVE_DOUBLE) {
    write([&](VtkhdfWriter &w) {
      w.array("u", dims, std::vector<double>(count, 1.0), type);
    });
    return error(0, "u");
  };
  expect(error_of({5, 4, 3}, 60), {"shape [5][4][3][3] (z, y, x, component)", "got [5][4][3]"});
  expect(error_of({3, 4, 5, 3}, 180), {"got [3][4][5][3]"});
  expect(error_of({5, 4, 4, 3}, 240), {"got [5][4][4][3]"});
  expect(error_of({2, 5, 4, 3, 3}, 360), {"has 2 frames", "no group Steps"});
  expect(error_of({5, 4, 3, 3}, 180, H5T_NATIVE_INT), {"float or double"});
  expect(error_of({5, 4, 3, 3}, 0), {"u has no data"});
  EXPECT_EQ(error_of({1, 5, 4, 3, 3}, 180), "");

  write([](VtkhdfWriter &w) {
    w.integers("WholeExtent", {0, 9999, 0, 9999, 0, 9999});    // 24 Tbytes
  });
  expect(error(), {"velocity must have shape [10000][10000][10000][3]", "got [5][4][3][3]"});
  // an array of that size of which a chunk of 64 nodes is written
  {
    VtkhdfWriter writer(path, {10000, 10000, 10000}, {0, 0, 0}, {1, 1, 1});
    writer.mostly_missing("velocity", {10000, 10000, 10000, 3}, {4, 4, 4, 3});
  }
  expect(error(), {"velocity has 1536 bytes of data", "not complete"});
}

TEST_F(Vtkhdf, numbers_that_are_none_are_located)
{
  for (const double bad : {std::nan(""), HUGE_VAL, 1e308, -1.7e308, 1.001e100, -1.001e100}) {
    write([=](VtkhdfWriter &w) {
      w.field("u", 3, [=](const double *x, double, double *u) {
        u[1] = x[0] == 0.0 && x[1] == 1.0 && x[2] == 8.0 ? bad : 0.0;
      });
    });
    expect(error(0, "u"),
           {"array u is", "node (2 1 3)", "position (0 1 8): must be within +-1e+100"});
  }
  write([](VtkhdfWriter &w) {
    w.field("u", 3, [](const double *x, double, double *u) {
      u[1] = x[0] == 0.0 ? 1e100 : -1e100;
    });
  });
  EXPECT_EQ(error(0, "u"), "");
  write(
      [](VtkhdfWriter &w) {
        w.field("u", 3,
                [](const double *, double t, double *u) {
                  u[0] = t > 1.5 ? NAN : t;
                },
                {1, 2});
      },
      {1, 2});
  EXPECT_EQ(error(0, "u"), "");
  expect(error(1, "u"), {"node (0 0 0)", "step 1"});
}

TEST_F(Vtkhdf, errors_of_steps)
{
  const auto error_of = [this](const std::vector<double> &times, int n) {
    return error_with([&](VtkhdfWriter &w) {
      w.steps(times, n);
    });
  };
  expect(error_of({0, 1, 2}, 2), {"Steps/Values must be 2 numbers", "shape [3]"});
  expect(error_of({0, 1}, 0), {"NSteps must be in", "got 0"});
  expect(error_of({0, 1}, -5), {"NSteps must be in", "got -5"});
  expect(error_of({0, 1}, 2000000000), {"NSteps must be in"});
  expect(error_of({}, 3), {"no array Values"});
  expect(error_of({0, 1, 1}, 3), {"must ascend, got 1 at step 2"});
  expect(error_of({0, NAN}, 2), {"must ascend", "step 1"});
  EXPECT_EQ(error_of({0, 1}, 2), "") << "an array without time does not change";
}
