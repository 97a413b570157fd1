// Reads all of a VTKHDF file as the fixes do: it is refused by an error with a reason, or all of it
// is finite and as long as its grid says. Nothing of it stays open.

#ifndef APF_FUZZ_READ_VTKHDF_H
#define APF_FUZZ_READ_VTKHDF_H

#include "child.h"
#include "require.h"

#include "flow/vtkhdf_file.h"

#include <hdf5.h>

#include <algorithm>
#include <cmath>
#include <new>
#include <set>
#include <stdexcept>
#include <vector>

namespace fuzz {

inline void require_reason(const std::string &text)
{
  require_reason(text,
                 {"HDF5", "VTKHDF", "Type", "Version", "WholeExtent", "Spacing", "Origin",
                  "Direction", "Steps", "Values", "is a link", "array", "attribute", "opened"});
}

// whether there is such an array
inline bool read_array(const apf::VtkhdfFile &file, const std::string &array, int components,
                       int frame)
{
  try {
    const auto &grid = file.grid();
    const auto values = file.read(array, components, frame, grid.n[2]);
    require(values.size() == grid.nodes() * components, "an array is as long as the grid says");
    for (const double value : values) require(std::isfinite(value), "values are finite");
    return true;
  } catch (std::bad_alloc &) {    // the fixes say that the file is too large
  } catch (std::runtime_error &error) {
    require_reason(error.what());
  }
  return false;
}

// HDF5 closes at exit what is open, and may crash at it as well.
inline const herr_t left_open_at_exit = H5dont_atexit();

// Whether a handle is open that can be closed: those that HDF5 itself refuses to close, or crashes
// at, as it does with some damaged files, nobody can. A child tries each.
inline bool one_can_be_closed()
{
  static std::set<hid_t> tried;
  const ssize_t open = H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL);
  if (open <= static_cast<ssize_t>(tried.size())) return false;
  std::vector<hid_t> handles(open);
  H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_ALL, open, handles.data());
  constexpr int closed = 7;    // no status of a sanitizer
  return std::any_of(handles.begin(), handles.end(), [](hid_t handle) {
    if (!tried.insert(handle).second) return false;
    const auto ended = in_child(
        [handle](int) {
          signal(SIGSEGV, SIG_DFL);    // no report
          herr_t failed = -1;
          H5E_BEGIN_TRY
          {
            failed = H5Idec_ref(handle);
          }
          H5E_END_TRY;
          return failed < 0 ? 0 : closed;
        },
        5, RLIM_INFINITY);
    return ended.status == closed;
  });
}

// whether a grid and at least one array were read
inline bool read_vtkhdf(const std::string &path)
{
  bool right = false;
  try {
    const apf::VtkhdfFile file(path);
    const auto &grid = file.grid();
    for (int k = 0; k < 3; k++)
      require(grid.n[k] > 0 && grid.spacing[k] > 0.0 && std::isfinite(grid.origin[k]), "a grid");
    const int frames = file.times().empty() ? 1 : static_cast<int>(file.times().size());
    auto names = file.arrays();
    if (names.size() > 3) names.resize(3);
    names.insert(names.end(), {"velocity", "distance"});
    for (const int frame : {0, frames - 1})
      for (const int components : {1, 3})
        for (const auto &array : names) right |= read_array(file, array, components, frame);
  } catch (std::runtime_error &error) {
    require_reason(error.what());
  }
  require(!one_can_be_closed(), "no handle of HDF5 is left open");
  return right;
}

}    // namespace fuzz

#endif
