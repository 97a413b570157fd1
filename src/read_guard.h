// HDF5 trusts what stands in a file: a damaged one may make it crash or read on without an end, and
// nothing would say which file it was. As long as a ReadGuard lives a crash of the program is
// preceded by a line that names the file, and then takes the way that it would have taken; and when
// its thread has had more time of the processor than the work is worth, the program ends with such
// a line and status 1. One at a time.

#ifndef LMP_READ_GUARD_H
#define LMP_READ_GUARD_H

#include <cstddef>
#include <string>

namespace LAMMPS_NS {

class ReadGuard {
 public:
  // what: of both lines' beginning, as "Fix flow/field file air.vtkhdf"; numbers: how many the work
  // reads from the file, 0 if it looks at names and attributes only
  explicit ReadGuard(const std::string &what, std::size_t numbers = 0);
  ~ReadGuard();
  ReadGuard(const ReadGuard &) = delete;
  ReadGuard &operator=(const ReadGuard &) = delete;
};

}    // namespace LAMMPS_NS

#endif
