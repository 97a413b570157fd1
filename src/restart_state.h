// Numbers of a style in restart files. LAMMPS hands a fix its part of a file without its length,
// and whoever wrote it: a mark with the number of the format and the count of numbers come
// first, and are looked at before anything else is believed. Of a number only what it may be is
// believed: else it is an error that names the style.

#ifndef APF_RESTART_STATE_H
#define APF_RESTART_STATE_H

#include "pointers.h"

#include "argument_reader.h"

#include <cstdio>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// To be raised with any change of what a style writes into restart files.
constexpr int restart_format = 1;

// Numbers one after another, which may be any.
class RestartNumbers : protected Pointers {
 public:
  // together: all ranks read the same numbers; else each its own
  RestartNumbers(LAMMPS *lmp, const class Fix *owner, const double *numbers, size_t count,
                 bool together) :
      Pointers(lmp),
      owner(owner), at(numbers), left(count), together(together)
  {
  }

  // the next one, which is finite and in the range
  double next(const Range &range = Range());
  // ... and whole, so that it can become an index, a count or one of several choices
  double whole(double low, double high);
  bool yes() { return whole(0.0, 1.0) == 1.0; }
  size_t count() { return static_cast<size_t>(whole(0.0, static_cast<double>(left))); }
  const double *next(size_t count);    // finite ones
  void skip_id();    // the bits of an atom's ID, or of the number of a wall's surface
  const double *bits(size_t count);            // ... or whatever they are
  const double *data() const { return at; }    // of those that are left
  // a count of characters and these, one a number, to be compared and printed: what is no character
  // that can be printed is refused
  std::string text();
  // a number that counts itself and those after it, and these: what a fix keeps with an atom
  RestartNumbers part();
  void end();    // all must have been taken by then

  // errors
  [[noreturn]] void damaged();
  [[noreturn]] void refuse(const std::string &why, const std::string &cure);

 protected:
  const Fix *owner;
  const double *at;
  size_t left;

 private:
  const bool together;
};

// What a fix has written, as Fix::restart() gets it.
class RestartState : public RestartNumbers {
 public:
  RestartState(LAMMPS *lmp, const Fix *owner, const char *buffer);

  // by rank 0, in Fix::write_restart(); a disk that is full is an error
  static void write(LAMMPS *lmp, const Fix *owner, const std::vector<double> &numbers, FILE *);
};

constexpr double most_counted = 9007199254740992.0;    // 2^53: doubles tell whole numbers apart

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
