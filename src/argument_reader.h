// Numbers and choices among the words of a command. A word that cannot be taken is an error that
// names command, argument, range and value, and points at it:
//   Fix inlet/flow gap must be a number >= 0, got wide
//   Fix inlet/flow every must be >= 1, got 0

#ifndef APF_ARGUMENT_READER_H
#define APF_ARGUMENT_READER_H

#include "pointers.h"

#include <cmath>
#include <initializer_list>
#include <string>

namespace LAMMPS_NS {

// What a number may be: low < x <= high, or low <= x <= high; all without bounds.
struct Range {
  double low = -INFINITY, high = INFINITY;
  bool with_low = true;

  static constexpr Range above(double low, double high = INFINITY) { return {low, high, false}; }
  static constexpr Range from(double low, double high = INFINITY) { return {low, high, true}; }

  constexpr bool holds(double x) const { return (with_low ? x >= low : x > low) && x <= high; }
  std::string words() const;    // "> 0", ">= 0" or "in (0, 1]"; empty without bounds
};

class ArgumentReader : protected Pointers {
 public:
  // command: begins errors, as in "Fix inlet/flow"
  // offset: added to an argument's index in errors: words of the input line before arg[0]
  ArgumentReader(LAMMPS *lmp, const std::string &command, char **arg, int offset = 0) :
      Pointers(lmp), command(command), arg(arg), offset(offset)
  {
  }

  // arg[iarg]; name: what the number is, behind the command in errors
  double number(int iarg, const std::string &name, const Range &range = Range()) const;
  int integer(int iarg, const std::string &name, const Range &range = Range()) const;

  // which of the words arg[iarg] is
  int choice(int iarg, const std::string &name, std::initializer_list<const char *> words) const;
  bool yes(int iarg, const std::string &name) const
  {
    return choice(iarg, name, {"yes", "no"}) == 0;
  }

 private:
  const std::string command;
  char **arg;
  const int offset;

  double in_range(int iarg, const std::string &name, const Range &range, double largest) const;
  [[noreturn]] void refuse(int iarg, const std::string &name, const std::string &demand) const;
};

}    // namespace LAMMPS_NS

#endif
