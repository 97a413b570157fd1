// libFuzzer: VTKHDF files that HDF5 itself wrote, right but for some parts: types, extents, shapes,
// chunks, missing data, links, files named within. Built and run by unittest/fuzz/run.

#include "choices.h"
#include "input_folder.h"
#include "read_vtkhdf.h"

#include <hdf5.h>

#include <algorithm>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <vector>

namespace {

using fuzz::Choices;
using Dims = std::vector<hsize_t>;

constexpr long long whole_numbers[] = {0,       1,       2,         3,         -1,
                                       -2,      7,       100,       1 << 16,   INT_MAX / 2,
                                       INT_MAX, INT_MIN, 1ll << 40, LLONG_MAX, LLONG_MIN};
constexpr double reals[] = {1.0,    0.5,   0.0,      -1.0,      1e-300, 1e300,
                            -1e308, 1e308, INFINITY, -INFINITY, NAN,    5e-324};

hid_t number_type(Choices &choices, hid_t right)
{
  const hid_t types[] = {right,          H5T_NATIVE_INT,   H5T_NATIVE_LLONG,  H5T_NATIVE_UCHAR,
                         H5T_IEEE_F32BE, H5T_NATIVE_FLOAT, H5T_NATIVE_DOUBLE, H5T_NATIVE_LDOUBLE,
                         H5T_STD_U64BE,  H5T_STD_REF_OBJ,  H5T_NATIVE_OPAQUE, H5T_NATIVE_B8,
                         H5T_C_S1,       H5T_UNIX_D32LE};
  return choices.of(types);
}

// rank and lengths, spoilt now and then
hid_t space_of(Choices &choices, Dims dims)
{
  switch (choices.of(0, {1, 2, 3, 4, 5, 6})) {
    case 1:
      return H5Screate(H5S_NULL);
    case 2:
      return H5Screate(H5S_SCALAR);
    case 3:
      dims.insert(dims.begin(), choices.of<hsize_t>(1, {2, 3, 1000}));
      break;
    case 4:
      if (!dims.empty()) dims.pop_back();
      break;
    case 5:
      for (auto &n : dims)
        n = choices.of<hsize_t>(n, {n + 1, n - 1, 0, 1, 1 << 20, hsize_t(1) << 40});
      break;
    case 6:
      dims.assign(H5S_MAX_RANK, 1);
      break;
    default:
      break;
  }
  if (dims.empty()) return H5Screate(H5S_SCALAR);
  return H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
}

// written as far as HDF5 converts; the rest of a larger attribute is 0
void write_attribute(Choices &choices, hid_t at, const char *name, hid_t memory_type,
                     const void *values, std::size_t count)
{
  if (choices.spoil()) return;
  const hid_t type = number_type(choices, memory_type), space = space_of(choices, {count});
  const hid_t id = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  const auto points = H5Sget_simple_extent_npoints(space);
  if (id >= 0 && points > 0 && points < 4096) {
    std::vector<char> all(points * 16, 0);
    const std::size_t bytes = count * H5Tget_size(memory_type);
    if (bytes <= all.size()) std::copy_n(static_cast<const char *>(values), bytes, all.begin());
    H5Awrite(id, memory_type, all.data());
  }
  if (id >= 0) H5Aclose(id);
  if (space >= 0) H5Sclose(space);
}

void write_text(Choices &choices, hid_t at, const char *name, const char *right)
{
  if (choices.spoil()) return;
  static const std::string longer(300, '%');
  const char *word =
      choices.of(right, {"", "%s%n", "UnstructuredGrid", "ImageData2", longer.c_str()});
  const hid_t type = H5Tcopy(H5T_C_S1), space = space_of(choices, {});
  const bool variable = choices.spoil();
  H5Tset_size(type, variable ? H5T_VARIABLE : std::max<std::size_t>(1, std::strlen(word)));
  const hid_t id = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  if (id >= 0 && H5Sget_simple_extent_npoints(space) == 1 && !choices.spoil())
    H5Awrite(id, type, variable ? static_cast<const void *>(&word) : word);
  if (id >= 0) H5Aclose(id);
  H5Sclose(space);
  H5Tclose(type);
}

// layout, filters, and where the raw data are said to be
hid_t storage(Choices &choices, const Dims &dims)
{
  const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
  switch (choices.of(0, {1, 2, 3, 4, 5})) {
    case 1:
      H5Pset_external(list, "/etc/passwd", 0, H5F_UNLIMITED);
      break;
    case 2:
      H5Pset_layout(list, H5D_COMPACT);
      break;
    case 3:
    case 4: {
      Dims chunk(dims.size(), 1);
      if (!chunk.empty()) H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data());
      if (choices.spoil()) H5Pset_deflate(list, 9);
      break;
    }
    case 5:
      H5Pset_alloc_time(list, H5D_ALLOC_TIME_LATE);
      break;
    default:
      break;
  }
  return list;
}

void write_array(Choices &choices, hid_t at, const char *name, hid_t right_type, const Dims &dims)
{
  switch (choices.of(0, {1, 2, 3, 4, 5, 6})) {
    case 1:
      return;
    case 2:
      H5Lcreate_external("/etc/hostname", "/", at, name, H5P_DEFAULT, H5P_DEFAULT);
      return;
    case 3:
      H5Lcreate_soft("/VTKHDF", at, name, H5P_DEFAULT, H5P_DEFAULT);
      return;
    case 4:
      H5Lcreate_soft(name, at, name, H5P_DEFAULT, H5P_DEFAULT);    // to itself
      return;
    case 5:
      H5Gclose(H5Gcreate2(at, name, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
      return;
    case 6: {
      const hid_t type = H5Tcopy(H5T_NATIVE_INT);
      H5Tcommit2(at, name, type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Tclose(type);
      return;
    }
    default:
      break;
  }
  const hid_t type = number_type(choices, right_type), space = space_of(choices, dims);
  const hid_t list = storage(choices, dims);
  const hid_t id = H5Dcreate2(at, name, type, space, H5P_DEFAULT, list, H5P_DEFAULT);
  const auto points = H5Sget_simple_extent_npoints(space);
  if (id >= 0 && points > 0 && points <= 1 << 16 && !choices.spoil()) {
    std::vector<double> values(points);
    for (std::size_t n = 0; n < values.size(); n++) values[n] = static_cast<double>(n);
    values[values.size() / 2] = choices.of(reals);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }
  if (id >= 0) H5Dclose(id);
  H5Pclose(list);
  H5Sclose(space);
}

void write_grid(Choices &choices, hid_t root, const Dims &n)
{
  write_text(choices, root, "Type", "ImageData");
  const long long version[2] = {choices.of(2ll, {1ll, 3ll, 0ll, -1ll}), 0};
  write_attribute(choices, root, "Version", H5T_NATIVE_LLONG, version, 2);
  long long extent[6];
  double origin[3], spacing[3], direction[9];
  for (int k = 0; k < 3; k++) {
    const long long shift = choices.next() % 3;
    extent[2 * k] = choices.spoil() ? choices.of(whole_numbers) : shift;
    extent[2 * k + 1] = choices.spoil() ? choices.of(whole_numbers)
                                        : shift + static_cast<long long>(n[k]) - 1;
    origin[k] = choices.of(reals);
    spacing[k] = choices.of(reals);
  }
  for (int k = 0; k < 9; k++) direction[k] = k % 4 ? choices.of(reals) - 1.0 : choices.of(reals);
  write_attribute(choices, root, "WholeExtent", H5T_NATIVE_LLONG, extent, 6);
  write_attribute(choices, root, "Origin", H5T_NATIVE_DOUBLE, origin, 3);
  write_attribute(choices, root, "Spacing", H5T_NATIVE_DOUBLE, spacing, 3);
  if (choices.spoil()) write_attribute(choices, root, "Direction", H5T_NATIVE_DOUBLE, direction, 9);
}

void write_steps(Choices &choices, hid_t root, hsize_t frames)
{
  const hid_t steps = H5Gcreate2(root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const long long said = choices.spoil() ? choices.of(whole_numbers)
                                         : static_cast<long long>(frames);
  write_attribute(choices, steps, "NSteps", H5T_NATIVE_LLONG, &said, 1);
  write_array(choices, steps, "Values", H5T_NATIVE_DOUBLE, {frames});
  if (choices.spoil()) {
    const hid_t group =
        H5Gcreate2(steps, "PointDataOffsets", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    write_array(choices, group, "velocity", H5T_NATIVE_LLONG, {frames});
    H5Gclose(group);
  }
  H5Gclose(steps);
}

void write_file(Choices &choices, hid_t file)
{
  if (choices.spoil()) return;
  const hid_t root = H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  const Dims n = {2 + choices.next() % 3, 2 + choices.next() % 3, 1 + choices.next() % 3};
  const hsize_t frames = choices.next() % 4;
  write_grid(choices, root, n);
  if (frames > 0) write_steps(choices, root, frames);
  if (choices.spoil())
    H5Lcreate_external("/etc/hostname", "/x", root, "PointData", H5P_DEFAULT, H5P_DEFAULT);
  const hid_t points = H5Gcreate2(root, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  if (points >= 0) {
    const char *const names[] = {"distance",         "%s%n",         "distance_{}",
                                 "distance_../../x", "distance_a b", "pressure"};
    Dims dims = {n[2], n[1], n[0]};
    if (frames > 0) dims.insert(dims.begin(), frames);
    write_array(choices, points, choices.of(names), H5T_NATIVE_DOUBLE, dims);
    dims.push_back(3);
    write_array(choices, points, "velocity", H5T_NATIVE_DOUBLE, dims);
    H5Gclose(points);
  }
  H5Gclose(root);
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Choices choices(data, size);
  static const hid_t in_memory = [] {
    const hid_t list = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(list, 1 << 14, 0);
    return list;
  }();
  const hid_t file = H5Fcreate("parts", H5F_ACC_TRUNC, H5P_DEFAULT, in_memory);
  fuzz::require(file >= 0, "HDF5 makes a file in memory");
  write_file(choices, file);
  H5Fflush(file, H5F_SCOPE_LOCAL);
  std::vector<char> image(H5Fget_file_image(file, nullptr, 0));
  H5Fget_file_image(file, image.data(), image.size());
  H5Fclose(file);

  // at last bytes of it are changed, too
  while (choices.spoil() && !image.empty()) {
    const std::size_t where = (choices.next() << 8) + choices.next();
    image[where % image.size()] = static_cast<char>(choices.next());
  }
  if (const char *kept = std::getenv("APF_FUZZ_KEEP"))    // to be tried on the fixes themselves
    std::ofstream(kept, std::ios::binary).write(image.data(), static_cast<long>(image.size()));
  static const fuzz::InputFolder folder;
  const auto *bytes = reinterpret_cast<const unsigned char *>(image.data());
  fuzz::tally.count(fuzz::read_vtkhdf(folder.write("input.vtkhdf", bytes, image.size())));
  return 0;
}
