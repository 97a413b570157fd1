// Numbers of a style in restart files. LAMMPS hands a fix its part of a file without its length,
// and whoever wrote it: a mark with the number of the format and the count of numbers come
// first, and are looked at before anything else is believed.

#ifndef APF_RESTART_STATE_H
#define APF_RESTART_STATE_H

#include "pointers.h"

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// To be raised with any change of what a style writes into restart files.
constexpr int restart_format = 1;

class RestartState : protected Pointers {
 public:
  // buffer: as Fix::restart() gets it
  RestartState(LAMMPS *lmp, const class Fix *owner, const char *buffer);

  // by rank 0, in Fix::write_restart(); a disk that is full is an error
  static void write(LAMMPS *lmp, const Fix *owner, const std::vector<double> &numbers, FILE *);

  double next();
  const double *next(size_t count);
  size_t count();    // the next number, as a count of those that come after it
  // a count of characters and these, one a number, to be compared and printed: what is no character
  // that can be printed is refused
  std::string text();
  void end();    // all must have been taken by then

 private:
  const Fix *owner;
  const double *at;
  size_t left;

  [[noreturn]] void refuse(const std::string &why);
};

// of ASCII
inline bool is_printable(double letter)
{
  return letter >= 32.0 && letter <= 126.0;
}

// Mark of the format in a restart file of this version of APF, 8 bytes.
struct RestartMark {
  char name[3] = {'A', 'P', 'F'};
  char format = restart_format;
  unsigned count = 0;

  bool known() const;
};

}    // namespace LAMMPS_NS

#endif
