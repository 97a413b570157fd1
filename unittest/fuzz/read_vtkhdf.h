// Reads all of a VTKHDF file as the fixes do: it is refused by an error with a reason, or all of it
// is finite and as long as its grid says. Nothing of it stays open.

#ifndef APF_FUZZ_READ_VTKHDF_H
#define APF_FUZZ_READ_VTKHDF_H

#include "require.h"

#include "flow/vtkhdf_file.h"

#include <hdf5.h>

#include <cmath>
#include <csignal>
#include <new>
#include <stdexcept>
#include <sys/wait.h>
#include <unistd.h>
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

// Whether a handle is open that can be closed: those that HDF5 itself refuses to close, or crashes
// at, as it does with some damaged files, nobody can. Another process tries.
inline bool one_can_be_closed()
{
  static ssize_t refused = 0;
  const ssize_t open = H5Fget_obj_count(H5F_OBJ_ALL, H5F_OBJ_ALL);
  if (open <= refused) return false;
  refused = open;
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGSEGV, SIG_DFL);
    signal(SIGABRT, SIG_DFL);
    std::vector<hid_t> handles(open);
    H5Fget_obj_ids(H5F_OBJ_ALL, H5F_OBJ_ALL, open, handles.data());
    bool any = false;
    H5E_BEGIN_TRY
    {
      for (const hid_t handle : handles) any |= H5Idec_ref(handle) >= 0;
    }
    H5E_END_TRY;
    _exit(any);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return child < 0 || (WIFEXITED(status) && WEXITSTATUS(status) == 1);
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
