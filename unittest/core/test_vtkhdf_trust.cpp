// A VTKHDF file is not trusted: it holds its numbers itself, and what it says of their size is
// checked before there is memory for them. The other file of these tests is right in itself, so
// only the rule keeps it from being read.

#include "flow/vtkhdf_file.h"
#include "fuzz/child.h"
#include "vtkhdf_writer.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <functional>

#include <sys/stat.h>
#include <unistd.h>

using apf::VtkhdfFile;

namespace {

class VtkhdfTrust : public testing::Test {
 protected:
  const std::string folder =
      std::filesystem::temp_directory_path() / ("apf-trust-" + std::to_string(getpid()));
  const std::string other = folder + "/other.h5", path = folder + "/file.h5";

  void SetUp() override
  {
    std::filesystem::create_directories(folder);
    write(other, true);
  }
  void TearDown() override { std::filesystem::remove_all(folder); }

  static void write(const std::string &to, bool velocity)
  {
    VtkhdfWriter file(to, {2, 2, 2}, {0, 0, 0}, {1, 1, 1});
    if (velocity) file.array("velocity", {2, 2, 2, 3}, std::vector<double>(24, 1.0));
  }

  // the error of a file without a velocity that is then changed through HDF5
  std::string error_of(const std::function<void(hid_t)> &change)
  {
    write(path, false);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    change(file);
    H5Fclose(file);
    try {
      VtkhdfFile(path).read("velocity", 3, 0, 2);
    } catch (std::runtime_error &error) {
      return error.what();
    }
    return "read";
  }

  static void external(hid_t file, const std::string &to, const char *object, const char *name)
  {
    H5Lcreate_external(to.c_str(), object, file, name, H5P_DEFAULT, H5P_DEFAULT);
  }
  static void data(hid_t file, const char *name, hid_t list)
  {
    const hsize_t dims[4] = {2, 2, 2, 3};
    const hid_t space = H5Screate_simple(4, dims, nullptr);
    const hid_t id =
        H5Dcreate2(file, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    EXPECT_GE(id, 0);
    H5Dclose(id);
    H5Sclose(space);
    H5Pclose(list);
  }
};

constexpr const char *velocity = "VTKHDF/PointData/velocity";

}    // namespace

TEST_F(VtkhdfTrust, hard_and_soft_links_within_the_file_are_followed)
{
  EXPECT_EQ(error_of([&](hid_t file) {
              H5Ldelete(file, "VTKHDF/PointData", H5P_DEFAULT);
              const hid_t from = H5Fopen(other.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
              H5Ocopy(from, "VTKHDF/PointData", file, "elsewhere", H5P_DEFAULT, H5P_DEFAULT);
              H5Fclose(from);
              H5Lcreate_soft("/elsewhere", file, "VTKHDF/PointData", H5P_DEFAULT, H5P_DEFAULT);
            }),
            "read");
}

TEST_F(VtkhdfTrust, links_to_other_files_are_refused)
{
  const std::string refused = "is a link to another file";
  EXPECT_NE(error_of([&](hid_t file) {
              external(file, other, velocity, velocity);
            }).find("velocity " + refused),
            std::string::npos);
  EXPECT_NE(error_of([&](hid_t file) {
              H5Ldelete(file, "VTKHDF/PointData", H5P_DEFAULT);
              external(file, other, "VTKHDF/PointData", "VTKHDF/PointData");
            }).find("PointData " + refused),
            std::string::npos);
  EXPECT_NE(error_of([&](hid_t file) {
              H5Ldelete(file, "VTKHDF", H5P_DEFAULT);
              external(file, "../" + folder + "/other.h5", "VTKHDF", "VTKHDF");
            }).find("VTKHDF " + refused),
            std::string::npos);
  // behind a soft link the link itself is not seen, but not followed either
  EXPECT_EQ(error_of([&](hid_t file) {
              external(file, other, velocity, "bridge");
              H5Lcreate_soft("/bridge", file, velocity, H5P_DEFAULT, H5P_DEFAULT);
            }),
            "array velocity must be a dataset of HDF5");
}

TEST_F(VtkhdfTrust, numbers_in_other_files_are_refused)
{
  const std::string refused =
      "array velocity has its numbers in another file: the file must hold its data itself";
  EXPECT_EQ(error_of([&](hid_t file) {
              const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
              H5Pset_external(list, "/etc/passwd", 0, 192);
              data(file, velocity, list);
            }),
            refused);
  EXPECT_EQ(error_of([&](hid_t file) {
              const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
              const hsize_t dims[4] = {2, 2, 2, 3};
              const hid_t space = H5Screate_simple(4, dims, nullptr);
              H5Pset_virtual(list, space, other.c_str(), velocity, space);
              H5Sclose(space);
              data(file, velocity, list);
            }),
            refused);
}

TEST_F(VtkhdfTrust, links_in_a_circle_end)
{
  EXPECT_EQ(error_of([&](hid_t file) {
              H5Lcreate_soft(velocity, file, velocity, H5P_DEFAULT, H5P_DEFAULT);
            }),
            "array velocity must be a dataset of HDF5");
}

TEST_F(VtkhdfTrust, steps_that_are_not_there_get_no_memory)
{
  EXPECT_EQ(error_of([&](hid_t file) {
              const hid_t root = H5Gopen2(file, "VTKHDF", H5P_DEFAULT);
              const hid_t steps = H5Gcreate2(root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
              const long long n = 1 << 24;
              const hid_t scalar = H5Screate(H5S_SCALAR);
              const hid_t count =
                  H5Acreate2(steps, "NSteps", H5T_NATIVE_LLONG, scalar, H5P_DEFAULT, H5P_DEFAULT);
              H5Awrite(count, H5T_NATIVE_LLONG, &n);
              const hsize_t dims = n;
              const hid_t space = H5Screate_simple(1, &dims, nullptr);
              const hid_t values = H5Dcreate2(steps, "Values", H5T_NATIVE_DOUBLE, space,
                                              H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
              H5Aclose(count);
              for (const hid_t id : {values, steps, root}) H5Oclose(id);
              H5Sclose(space);
              H5Sclose(scalar);
            }),
            "Steps/Values has no data");
}

// A pipe to which nobody writes would be waited for, in a child that is ended then.
TEST_F(VtkhdfTrust, what_is_not_a_regular_file_is_not_opened)
{
  const std::string pipe = folder + "/pipe", link = folder + "/link";
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::filesystem::create_symlink(pipe, link);
  const auto said = [](const std::string &of) {
    const auto ended = fuzz::in_child(
        [&](int out) {
          std::string text = "read";
          try {
            const VtkhdfFile file(of);
          } catch (std::runtime_error &error) {
            text = error.what();
          }
          return ::write(out, text.data(), text.size()) < 0;
        },
        1, RLIM_INFINITY);
    return ended.death + ended.text;
  };
  for (const std::string &one : {pipe, link, std::string("/dev/zero"), std::string("/dev/null")})
    EXPECT_EQ(said(one), "is not a regular file") << one;
  EXPECT_EQ(said(folder), "is a folder, not a file");
  EXPECT_EQ(said(folder + "/none"), "cannot be opened: No such file or directory");
  std::filesystem::create_symlink(other, folder + "/good");
  EXPECT_EQ(said(folder + "/good"), "read");
}

// Names go into messages as they are: nothing in them is a format or a path.
TEST_F(VtkhdfTrust, names_are_only_names)
{
  EXPECT_EQ(error_of([&](hid_t file) {
              for (const char *name : {"%s%n", "{}", "..", "distance_a b"})
                data(file, (std::string("VTKHDF/PointData/") + name).c_str(),
                     H5Pcreate(H5P_DATASET_CREATE));
            }),
            "has no point array velocity; it has %s%n .. distance_a b {}");
}
