#include "vtkhdf_file.h"

#include "hdf5_input.h"
#include "regular_file.h"
#include "word_hash.h"

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <limits>
#include <utility>

#include <sys/stat.h>

namespace apf {

using namespace hdf5;

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "handles of HDF5 1.10 and later");

namespace {

  constexpr std::uint64_t most_nodes = std::uint64_t(1) << 40;    // offsets stay exact in a double
  constexpr std::uint64_t most_steps = std::uint64_t(1) << 24;
  // Beyond anything physical, and beyond the largest float, which some programs write where there
  // is no fluid. Squares are numbers yet, so are sums of splines.
  constexpr double largest_value = 1e100;
  constexpr std::size_t most_told = 50;    // names in an error

  std::uint64_t hash_of(const std::vector<double> &values)
  {
    return WordHash(values.size()).add(values.data(), values.size()).value();
  }

  // What differs once a file was written to: its size, when it was written, and when anything of it
  // was changed, which no program sets back; none of a file that is not there.
  std::array<long long, 4> stamp_of(const std::string &path)
  {
    struct stat now {};
    if (stat(path.c_str(), &now) != 0) return {};
    std::error_code none;
    const auto written = std::filesystem::last_write_time(path, none);
#ifdef __linux__
    const long long nanoseconds = now.st_ctim.tv_nsec;
#else
    const long long nanoseconds = 0;
#endif
    return {now.st_size, written.time_since_epoch().count(), now.st_ctime, nanoseconds};
  }

}    // namespace

/* ---------------------------------------------------------------------- */

VtkhdfFile::VtkhdfFile(const std::string &path_in) : path(path_in)
{
  const Quiet quiet;
  try {
    open();
    read_grid();
    read_steps();
  } catch (...) {
    close();
    throw;
  }
}

VtkhdfFile::~VtkhdfFile()
{
  close();
}

void VtkhdfFile::close()
{
  if (points >= 0) H5Gclose(points);
  if (file >= 0) H5Fclose(file);
}

void VtkhdfFile::open()
{
  if (const std::string why = why_not_a_file(path); !why.empty()) fail(why);
  if (std::FILE *readable = std::fopen(path.c_str(), "rb"))
    std::fclose(readable);
  else
    fail(std::string("cannot be opened: ") + std::strerror(errno));
  if (H5Fis_hdf5(path.c_str()) <= 0) fail("is not an HDF5 file");
  file = H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  // HDF5 shares a file that this program has open already, and takes it to be as it was
  hsize_t bytes = 0;
  if (file < 0 || H5Fget_filesize(file, &bytes) < 0 || std::filesystem::file_size(path) < bytes)
    fail("is a damaged or truncated HDF5 file");
  stamp = stamp_of(path);
}

// A file that was removed is still there for those who have it open.
void VtkhdfFile::check_unchanged() const
{
  const auto now = stamp_of(path), gone = decltype(now){};
  if (now == gone || now == stamp) return;
  // its permissions or links may have changed, or its time was set back: what was read last tells
  bool same = now[0] == stamp[0] && now[1] == stamp[1] && !last.array.empty();
  if (same) {
    const Handle data(open_array(points, last.array, "array " + last.array), H5Dclose);
    same = hash_of(values(data, last)) == last.hash;
  }
  if (!same) fail("was changed after it had been opened");
  stamp = now;
}

void VtkhdfFile::read_grid()
{
  if (!exists(file, "VTKHDF")) fail("has no group VTKHDF");
  const Handle group(open_group(file, "VTKHDF"), H5Gclose);
  if (!group) fail("has no group VTKHDF");
  const std::string type = read_text(group, "Type");
  if (type != "ImageData") fail("Type must be ImageData, got " + type);
  int version[2];
  read_attribute(group, "Version", H5T_NATIVE_INT, 2, version);
  if (version[0] < 1 || version[0] > 2)
    fail("Version must be 1.x or 2.x, got " + std::to_string(version[0]) + "." +
         std::to_string(version[1]));

  long long extent[6];
  double direction[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  read_attribute(group, "WholeExtent", H5T_NATIVE_LLONG, 6, extent);
  read_attribute(group, "Origin", H5T_NATIVE_DOUBLE, 3, image.origin);
  read_attribute(group, "Spacing", H5T_NATIVE_DOUBLE, 3, image.spacing);
  if (H5Aexists(group, "Direction") > 0)
    read_attribute(group, "Direction", H5T_NATIVE_DOUBLE, 9, direction);
  for (int k = 0; k < 9; k++)
    if (!(std::fabs(direction[k] - (k % 4 == 0 ? 1.0 : 0.0)) < 1e-12))
      fail("Direction must be the unit matrix: the grid's axes are those of the box");

  std::uint64_t nodes = 1;
  for (int k = 0; k < 3; k++) {
    const char axis = "xyz"[k];
    const long long lo = extent[2 * k], hi = extent[2 * k + 1];
    constexpr long long far = std::numeric_limits<int>::max() / 2;
    if (lo < -far || hi > far || lo > hi)
      fail(std::string("WholeExtent along ") + axis + " must be ascending and within +-" +
           std::to_string(far) + ", got " + std::to_string(lo) + " " + std::to_string(hi));
    image.n[k] = static_cast<int>(hi - lo + 1);
    nodes *= image.n[k];
    if (nodes > most_nodes) fail("WholeExtent has more than 2^40 nodes");
    if (!(image.spacing[k] > 0.0) || !std::isfinite(image.spacing[k]))
      fail(std::string("Spacing along ") + axis + " must be > 0, got " + text_of(image.spacing[k]));
    image.origin[k] += lo * image.spacing[k];
    if (!std::isfinite(image.origin[k]) ||
        !std::isfinite(image.origin[k] + image.n[k] * image.spacing[k]))
      fail(std::string("Origin and Spacing along ") + axis + " must be finite");
  }

  if (!exists(group, "PointData")) fail("has no group VTKHDF/PointData");
  points = open_group(group, "PointData");
  if (points < 0) fail("has no group VTKHDF/PointData");
}

void VtkhdfFile::read_steps()
{
  if (!exists(file, "VTKHDF/Steps")) return;
  const Handle steps(open_group(file, "VTKHDF/Steps"), H5Gclose);
  if (!steps) fail("Steps must be a group");
  long long n;
  read_attribute(steps, "NSteps", H5T_NATIVE_LLONG, 1, &n);
  if (n < 1 || n > static_cast<long long>(most_steps))
    fail("Steps attribute NSteps must be in [1, 2^24], got " + std::to_string(n));

  if (!exists(steps, "Values")) fail("Steps has no array Values, the times of the steps");
  const Handle values(open_array(steps, "Values", "Steps/Values"), H5Dclose);
  const Handle space(H5Dget_space(values), H5Sclose), type(H5Dget_type(values), H5Tclose);
  if (dims_of(space) != Dims{std::uint64_t(n)} || !is_number(type))
    fail("Steps/Values must be " + std::to_string(n) + " numbers, as NSteps says, but has shape " +
         text_of(dims_of(space)));
  check_storage(values, static_cast<double>(n), "Steps/Values");
  std::vector<double> times(n);
  if (H5Dread(values, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, times.data()) < 0)
    fail("cannot read Steps/Values");
  for (long long s = 0; s < n; s++)
    if (!std::isfinite(times[s]) || (s > 0 && !(times[s] > times[s - 1])))
      fail("Steps/Values must ascend, got " + text_of(times[s]) + " at step " + std::to_string(s));
  nsteps = n;
  if (n > 1) step_times = std::move(times);
}

/* ---------------------------------------------------------------------- */

bool VtkhdfFile::has(const std::string &array) const
{
  const Quiet quiet;
  return exists(points, array.c_str());
}

std::vector<std::string> VtkhdfFile::arrays() const
{
  const Quiet quiet;
  return names();
}

std::vector<std::string> VtkhdfFile::names() const
{
  std::vector<std::string> all;
  const auto add = [](hid_t, const char *name, const H5L_info_t *, void *to) -> herr_t {
    static_cast<std::vector<std::string> *>(to)->emplace_back(name);
    return 0;
  };
  if (H5Literate(points, H5_INDEX_NAME, H5_ITER_INC, nullptr, add, &all) < 0)
    fail("cannot read the names of its point arrays: the file is damaged");
  return all;
}

// Where a frame is along the array's dimension of time: the file may let frames share data.
std::uint64_t VtkhdfFile::frame_offset(const std::string &array, int frame) const
{
  const std::string path = "VTKHDF/Steps/PointDataOffsets/" + array;
  if (nsteps == 0 || !exists(file, "VTKHDF/Steps/PointDataOffsets") || !exists(file, path.c_str()))
    return frame;
  const Handle offsets(open_array(file, path, "Steps/PointDataOffsets/" + array), H5Dclose);
  const Handle space(H5Dget_space(offsets), H5Sclose), type(H5Dget_type(offsets), H5Tclose);
  if (dims_of(space) != Dims{nsteps} || H5Tget_class(type) != H5T_INTEGER)
    fail("Steps/PointDataOffsets/" + array + " must be " + std::to_string(nsteps) +
         " whole numbers, as NSteps says, but has shape " + text_of(dims_of(space)));
  check_storage(offsets, static_cast<double>(nsteps), "Steps/PointDataOffsets/" + array);
  std::vector<long long> values(nsteps);
  if (H5Dread(offsets, H5T_NATIVE_LLONG, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()) < 0)
    fail("cannot read Steps/PointDataOffsets/" + array);
  if (values[frame] < 0)
    fail("Steps/PointDataOffsets/" + array + " must be >= 0, got " + std::to_string(values[frame]));
  return values[frame];
}

VtkhdfFile::Shape VtkhdfFile::shape(const std::string &array, const Dims &dims, int components,
                                    int frame) const
{
  const Dims nodes = {std::uint64_t(image.n[2]), std::uint64_t(image.n[1]),
                      std::uint64_t(image.n[0])};
  const std::uint64_t offset = frame_offset(array, frame);
  for (const bool flat : {false, true})
    for (const bool bare : {false, true})
      for (const bool has_time : {false, true}) {
        if (flat && nodes[0] != 1) continue;      // VTK drops z from planar images
        if (bare && components != 1) continue;    // and the components of scalars
        if (has_time && dims.empty()) continue;
        Dims expected(nodes.begin() + flat, nodes.end());
        if (!bare) expected.push_back(components);
        if (has_time) expected.insert(expected.begin(), dims[0]);
        if (dims != expected) continue;
        if (has_time && nsteps == 0 && dims[0] != 1)
          fail("array " + array + " has " + std::to_string(dims[0]) +
               " frames, but the file has no group Steps that says when");
        if (has_time && offset >= dims[0])
          fail("array " + array + " has " + std::to_string(dims[0]) + " frames, but step " +
               std::to_string(frame) + " is to be frame " + std::to_string(offset));
        return {has_time, flat, has_time ? offset : 0};
      }
  Dims wanted = nodes;
  if (components > 1) wanted.push_back(components);
  fail("array " + array + " must have shape " + text_of(wanted) +
       (components > 1 ? " (z, y, x, component)" : " (z, y, x)") + " as WholeExtent says" +
       (nsteps == 0 ? "" : ", after one dimension for time") + ", got " + text_of(dims));
}

// the array, open
std::int64_t VtkhdfFile::find(const std::string &array) const
{
  check_unchanged();
  if (exists(points, array.c_str())) return open_array(points, array, "array " + array);
  const auto all = names();
  std::string list;
  for (std::size_t k = 0; k < all.size() && k < most_told; k++) list += " " + all[k];
  if (all.size() > most_told) list += " and " + std::to_string(all.size() - most_told) + " more";
  fail("has no point array " + array + "; it has" + (list.empty() ? " none" : list));
}

VtkhdfFile::Shape VtkhdfFile::checked(std::int64_t data, const std::string &array, int components,
                                      int frame) const
{
  const Handle space(H5Dget_space(data), H5Sclose), type(H5Dget_type(data), H5Tclose);
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_FLOAT || (size != 4 && size != 8))
    fail("array " + array + " must be of type float or double");
  const Shape part = shape(array, dims_of(space), components, frame);
  check_storage(data, static_cast<double>(image.nodes()) * components, "array " + array);
  return part;
}

void VtkhdfFile::check(const std::string &array, int components) const
{
  const Quiet quiet;
  const Handle data(find(array), H5Dclose);
  checked(data, array, components, 0);
}

std::vector<double> VtkhdfFile::read(const std::string &array, int components, int frame,
                                     int layers) const
{
  const Quiet quiet;
  const Handle data(find(array), H5Dclose);
  Read what{array, components, frame, layers};
  auto numbers = values(data, what);
  check_values(array, components, frame, numbers);
  what.hash = hash_of(numbers);
  last = what;
  return numbers;
}

std::vector<double> VtkhdfFile::values(std::int64_t data, const Read &what) const
{
  const Handle space(H5Dget_space(data), H5Sclose);
  const Shape part = checked(data, what.array, what.components, what.frame);
  const Dims dims = dims_of(space);
  std::vector<hsize_t> start(dims.size(), 0), count(dims.begin(), dims.end());
  if (part.has_time) {
    start[0] = part.offset;
    count[0] = 1;
  }
  if (!part.flat) count[part.has_time ? 1 : 0] = what.layers;
  H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr);
  const Handle memory(H5Screate_simple(static_cast<int>(count.size()), count.data(), nullptr),
                      H5Sclose);
  std::vector<double> numbers(std::size_t(image.n[0]) * image.n[1] * what.layers * what.components);
  if (H5Dread(data, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, numbers.data()) < 0)
    fail("cannot read array " + what.array + ": the file is damaged or truncated");
  return numbers;
}

void VtkhdfFile::check_values(const std::string &array, int components, int frame,
                              const std::vector<double> &values) const
{
  const std::size_t plane = std::size_t(image.n[0]) * image.n[1];
  for (std::size_t v = 0; v < values.size(); v++) {
    if (std::fabs(values[v]) <= largest_value) continue;    // nan is not
    const std::size_t node = v / components;
    const std::size_t index[3] = {node % image.n[0], node % plane / image.n[0], node / plane};
    std::string where, at;
    for (int k = 0; k < 3; k++) {
      where += (k ? " " : "") + std::to_string(index[k]);
      at += (k ? " " : "") + text_of(image.origin[k] + index[k] * image.spacing[k]);
    }
    fail("array " + array + " is " + text_of(values[v]) + " at node (" + where + "), position (" +
         at + ")" + (step_times.empty() ? "" : ", step " + std::to_string(frame)) +
         ": must be within +-" + text_of(largest_value));
  }
}

}    // namespace apf
