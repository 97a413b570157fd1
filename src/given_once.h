// Keywords of a command that may be given once: of two values one would count for nothing.

#ifndef APF_GIVEN_ONCE_H
#define APF_GIVEN_ONCE_H

#include "error.h"
#include "pointers.h"

#include <set>
#include <string>

namespace LAMMPS_NS {

class GivenOnce : protected Pointers {
 public:
  // command: begins errors, as in "Fix flow/force"
  GivenOnce(LAMMPS *lmp, const char *command) : Pointers(lmp), command(command) {}

  // iarg: where the word stands in the command, for errors
  void add(const std::string &word, int iarg)
  {
    if (!words.insert(word).second)
      error->all(FLERR, iarg, "{} keyword {} is given twice", command, word);
  }

 private:
  const char *command;
  std::set<std::string> words;
};

}    // namespace LAMMPS_NS

#endif
