// Writes small VTKHDF files for tests, right ones and, by replacing or removing parts, wrong ones.

#ifndef APF_TEST_VTKHDF_WRITER_H
#define APF_TEST_VTKHDF_WRITER_H

#include <hdf5.h>

#include <array>
#include <cstring>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

class VtkhdfWriter {
 public:
  using Triple = std::array<double, 3>;
  using Counts = std::array<int, 3>;

  VtkhdfWriter(const std::string &path, Counts nodes, Triple origin, Triple spacing) :
      n(nodes), o(origin), h(spacing),
      file(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT))
  {
    if (file < 0) throw std::runtime_error("cannot write " + path);
    root = H5Gcreate2(file, "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    points = H5Gcreate2(root, "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    text("Type", "ImageData");
    integers("Version", {2, 2});
    integers("WholeExtent", {0, n[0] - 1, 0, n[1] - 1, 0, n[2] - 1});
    numbers("Origin", {o[0], o[1], o[2]});
    numbers("Spacing", {h[0], h[1], h[2]});
    numbers("Direction", {1, 0, 0, 0, 1, 0, 0, 0, 1});
  }
  ~VtkhdfWriter()
  {
    if (series >= 0) H5Gclose(series);
    H5Gclose(points);
    H5Gclose(root);
    H5Fclose(file);
  }
  VtkhdfWriter(const VtkhdfWriter &) = delete;
  VtkhdfWriter &operator=(const VtkhdfWriter &) = delete;

  // ---- attributes; those that exist are replaced

  void remove(const char *attribute) { H5Adelete(root, attribute); }
  void numbers(const char *name, const std::vector<double> &a)
  {
    attribute(root, name, H5T_NATIVE_DOUBLE, a.size(), a.data());
  }
  void integers(const char *name, const std::vector<int> &a)
  {
    attribute(root, name, H5T_NATIVE_INT, a.size(), a.data());
  }
  // variable: of variable length, as h5py writes it, in a heap of the file
  void text(const char *name, const std::string &word, bool variable = false)
  {
    if (H5Aexists(root, name) > 0) H5Adelete(root, name);
    const hid_t type = H5Tcopy(H5T_C_S1), space = H5Screate(H5S_SCALAR);
    H5Tset_size(type, variable ? H5T_VARIABLE : word.size());
    const hid_t id = H5Acreate2(root, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    const char *const begin = word.c_str();
    H5Awrite(id, type, variable ? static_cast<const void *>(&begin) : begin);
    H5Aclose(id);
    H5Sclose(space);
    H5Tclose(type);
  }

  // ---- arrays

  // any shape; `type` is that in the file
  void array(const std::string &name, const std::vector<hsize_t> &dims,
             const std::vector<double> &values, hid_t type = H5T_NATIVE_DOUBLE)
  {
    dataset(points, name.c_str(), dims, values, type);
  }

  // all in chunks that are not there but for the first one
  void mostly_missing(const std::string &name, const std::vector<hsize_t> &dims,
                      const std::vector<hsize_t> &chunk)
  {
    const int rank = static_cast<int>(dims.size());
    const hid_t space = H5Screate_simple(rank, dims.data(), nullptr);
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE),
                one = H5Screate_simple(rank, chunk.data(), nullptr);
    H5Pset_chunk(list, rank, chunk.data());
    const hid_t id =
        H5Dcreate2(points, name.c_str(), H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    const std::vector<hsize_t> start(rank, 0);
    H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, chunk.data(), nullptr);
    const std::vector<double> zeros(H5Sget_simple_extent_npoints(one), 0.0);
    H5Dwrite(id, H5T_NATIVE_DOUBLE, one, space, H5P_DEFAULT, zeros.data());
    H5Dclose(id);
    H5Pclose(list);
    H5Sclose(one);
    H5Sclose(space);
  }

  // `components` numbers per node from f(x, numbers), for each of the times
  using Field = std::function<void(const double *x, double t, double *numbers)>;
  void field(const std::string &name, int components, const Field &f,
             const std::vector<double> &times = {}, hid_t type = H5T_NATIVE_DOUBLE)
  {
    std::vector<hsize_t> dims = {hsize_t(n[2]), hsize_t(n[1]), hsize_t(n[0])};
    if (components > 1) dims.push_back(components);
    if (!times.empty()) dims.insert(dims.begin(), times.size());
    std::vector<double> values;
    for (std::size_t t = 0; t < (times.empty() ? 1 : times.size()); t++)
      for (int k = 0; k < n[2]; k++)
        for (int j = 0; j < n[1]; j++)
          for (int i = 0; i < n[0]; i++) {
            const double x[3] = {o[0] + i * h[0], o[1] + j * h[1], o[2] + k * h[2]};
            double node[3] = {};
            f(x, times.empty() ? 0.0 : times[t], node);
            values.insert(values.end(), node, node + components);
          }
    array(name, dims, values, type);
  }

  // ---- series

  void steps(const std::vector<double> &times, int nsteps = -1)
  {
    if (nsteps == -1) nsteps = static_cast<int>(times.size());
    series = H5Gcreate2(root, "Steps", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    attribute(series, "NSteps", H5T_NATIVE_INT, 1, &nsteps);
    if (!times.empty()) dataset(series, "Values", {times.size()}, times, H5T_NATIVE_DOUBLE);
  }
  void offsets(const std::string &name, const std::vector<double> &frames)
  {
    const hid_t group =
        H5Gcreate2(series, "PointDataOffsets", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    dataset(group, name.c_str(), {frames.size()}, frames, H5T_NATIVE_LLONG);
    H5Gclose(group);
  }

 private:
  Counts n;
  Triple o, h;
  hid_t file, root, points, series = -1;

  static void attribute(hid_t at, const char *name, hid_t type, hsize_t count, const void *values)
  {
    if (H5Aexists(at, name) > 0) H5Adelete(at, name);
    const hid_t space = count == 1 ? H5Screate(H5S_SCALAR) : H5Screate_simple(1, &count, nullptr);
    const hid_t id = H5Acreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(id, type, values);
    H5Aclose(id);
    H5Sclose(space);
  }
  static void dataset(hid_t at, const char *name, const std::vector<hsize_t> &dims,
                      const std::vector<double> &values, hid_t type)
  {
    const hid_t space = H5Screate_simple(static_cast<int>(dims.size()), dims.data(), nullptr);
    const hid_t id = H5Dcreate2(at, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    if (!values.empty())
      H5Dwrite(id, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(id);
    H5Sclose(space);
  }
};

#endif
