// HDF5 trusts what stands in a file: a damaged one may make it crash, and nothing would say which
// file it was. As long as a CrashLine lives a crash of the program is preceded by its line; then it
// takes the way that it would have taken. One at a time.

#ifndef LMP_CRASH_LINE_H
#define LMP_CRASH_LINE_H

#include <string>

namespace LAMMPS_NS {

class CrashLine {
 public:
  explicit CrashLine(const std::string &text);
  ~CrashLine();
  CrashLine(const CrashLine &) = delete;
  CrashLine &operator=(const CrashLine &) = delete;
};

}    // namespace LAMMPS_NS

#endif
