// `run N pre no` prepares nothing: whether all fixes are those with which a run was prepared last,
// and the box is the one in which it ended.

#ifndef APF_RUN_GUARD_H
#define APF_RUN_GUARD_H

#include "pointers.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class RunGuard : protected Pointers {
 public:
  explicit RunGuard(LAMMPS *lmp) : Pointers(lmp) {}

  // where a style is set up for a run, after its init(): it knows all fixes, and the box, as they
  // are
  void prepared();
  // the box, also where a run ends, in which fixes and borders may have changed it
  void note_box();
  // its coefficients are others: what was prepared is out of date
  void forget() { fixes.clear(); }
  // Before a style looks at what it knows of others: an error if fixes were made, replaced or taken
  // away since. LAMMPS's own lists of who acts when are out of date then, too.
  //   who   the error names it; nullptr: the pair style
  void require(const class Fix *who) const;
  // Before anything has moved in a run's first step: an error if a command has changed the box
  // since the last one.
  void require_box(const std::string &who) const;

 private:
  struct Known {
    int instance;    // numbers of fixes never come again, places in memory do
    std::string id;
  };
  std::vector<Known> fixes;

  std::string changed() const;

  using Box = std::array<double, 16>;    // tilt, whether triclinic; borders and kinds of boundaries
  Box box{};
  bool knows_box = false;
  Box box_now() const;
  bool holds_box() const;
};

}    // namespace LAMMPS_NS

#endif
