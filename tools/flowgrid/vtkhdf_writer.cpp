#include "vtkhdf_writer.h"

#include <numeric>

namespace flowgrid {

VtkhdfWriter::VtkhdfWriter(const std::string &path, const Grid &_grid,
                           const std::vector<double> &times, bool _compress) :
    grid(_grid),
    layers(std::max(_grid.n[2], 2)), frames(static_cast<int>(times.size())), compress(_compress),
    output(path)
{
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  file = H5Fcreate(output.while_written().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  check(file >= 0, "cannot be created");
  root = H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  points = H5Gcreate2(root, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);

  const hid_t type = H5Tcopy(H5T_C_S1), scalar = H5Screate(H5S_SCALAR);
  H5Tset_size(type, 9);
  const hid_t id = H5Acreate2(root, "Type", type, scalar, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(id, type, "ImageData");
  H5Aclose(id);
  H5Sclose(scalar);
  H5Tclose(type);
  const long long version[2] = {frames ? 2 : 1, 0};
  const int extent[6] = {0, grid.n[0] - 1, 0, grid.n[1] - 1, 0, layers - 1};
  const double direction[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  attribute(root, "Version", H5T_NATIVE_LLONG, 2, version);
  attribute(root, "WholeExtent", H5T_NATIVE_INT, 6, extent);
  attribute(root, "Origin", H5T_NATIVE_DOUBLE, 3, grid.origin.data());
  attribute(root, "Spacing", H5T_NATIVE_DOUBLE, 3, grid.spacing.data());
  attribute(root, "Direction", H5T_NATIVE_DOUBLE, 9, direction);
  if (!frames) return;

  const hid_t steps = H5Gcreate2(root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  attribute(steps, "NSteps", H5T_NATIVE_INT, 1, &frames);
  const hsize_t count = frames;
  const hid_t space = H5Screate_simple(1, &count, nullptr);
  const hid_t values =
      H5Dcreate2(steps, "Values", H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  check(H5Dwrite(values, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()) >= 0,
        "cannot be written");
  H5Dclose(values);
  H5Sclose(space);
  offsets = H5Gcreate2(steps, "PointDataOffsets", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  H5Gclose(steps);
}

VtkhdfWriter::~VtkhdfWriter()
{
  for (const hid_t group : {offsets, points, root})
    if (group >= 0) H5Gclose(group);
  if (file >= 0) H5Fclose(file);
}

void VtkhdfWriter::close()
{
  for (hid_t *group : {&offsets, &points, &root}) {
    if (*group >= 0) H5Gclose(*group);
    *group = -1;
  }
  const bool good = H5Fclose(file) >= 0;
  file = -1;
  check(good, "cannot be written: is the disk full?");
  output.keep();
}

void VtkhdfWriter::write(const std::string &name, int components, int frame,
                         const std::vector<double> &values)
{
  const bool exists = H5Lexists(points, name.c_str(), H5P_DEFAULT) > 0;
  const hid_t set = exists ? H5Dopen2(points, name.c_str(), H5P_DEFAULT)
                           : create(name, components, false);
  put(set, frame, values);
  H5Dclose(set);
}

void VtkhdfWriter::write_distance(const std::string &name, const std::vector<double> &values,
                                  double surface_error)
{
  const hid_t set = create(name, 1, true);
  put(set, 0, values);
  attribute(set, "surface_error", H5T_NATIVE_DOUBLE, 1, &surface_error);
  H5Dclose(set);
}

void VtkhdfWriter::put(hid_t set, int frame, const std::vector<double> &values)
{
  check(set >= 0, "cannot be written");
  const hid_t space = H5Dget_space(set);
  const int rank = H5Sget_simple_extent_ndims(space);
  hsize_t count[5], start[5] = {};
  H5Sget_simple_extent_dims(space, count, nullptr);
  const int z = frames ? 1 : 0;    // which dimension is that of the layers
  if (frames) {
    count[0] = 1;
    start[0] = frame;
  }
  count[z] = grid.n[2];
  for (int copy = 0; copy < layers / grid.n[2]; copy++) {
    start[z] = copy * grid.n[2];
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start, nullptr, count, nullptr);
    const hid_t memory = H5Screate_simple(rank, count, nullptr);
    const bool good =
        H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, values.data()) >= 0;
    H5Sclose(memory);
    check(good, "cannot be written: is the disk full?");
  }
  H5Sclose(space);
}

// steady: all times of a series have the same values
hid_t VtkhdfWriter::create(const std::string &name, int components, bool steady)
{
  std::vector<hsize_t> dims;
  if (frames) dims.push_back(steady ? 1 : frames);
  for (const int n : {layers, grid.n[1], grid.n[0]}) dims.push_back(n);
  if (components > 1) dims.push_back(components);
  const int rank = static_cast<int>(dims.size());
  const hid_t space = H5Screate_simple(rank, dims.data(), nullptr);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  if (compress) {
    std::vector<hsize_t> chunk = dims;
    if (frames) chunk[0] = 1;
    chunk[frames ? 1 : 0] = 1;
    H5Pset_chunk(how, rank, chunk.data());
    H5Pset_shuffle(how);
    H5Pset_deflate(how, 6);
  }
  const hid_t set =
      H5Dcreate2(points, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, how, H5P_DEFAULT);
  H5Pclose(how);
  H5Sclose(space);
  if (!frames) return set;

  std::vector<long long> first(frames, 0);
  if (!steady) std::iota(first.begin(), first.end(), 0);
  const hsize_t count = frames;
  const hid_t line = H5Screate_simple(1, &count, nullptr);
  const hid_t of = H5Dcreate2(offsets, name.c_str(), H5T_NATIVE_LLONG, line, H5P_DEFAULT,
                              H5P_DEFAULT, H5P_DEFAULT);
  H5Dwrite(of, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, first.data());
  H5Dclose(of);
  H5Sclose(line);
  return set;
}

void VtkhdfWriter::attribute(hid_t at, const char *name, hid_t type, hsize_t count,
                             const void *values)
{
  const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
  const hid_t id = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(id, type, values);
  H5Aclose(id);
  H5Sclose(space);
}

void VtkhdfWriter::check(bool good, const char *what) const
{
  if (!good) output.fail(what);
}

}    // namespace flowgrid
