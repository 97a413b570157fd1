// What LAMMPS throws away of a restart file. A fix gets its part where it is given; the first
// command that prepares a run, be it write_data or run 0, throws away the parts of fixes that are
// not there yet. A fix that comes later under such a name begins anew, and says so.

#ifndef APF_LOST_STATE_H
#define APF_LOST_STATE_H

#include <string>
#include <utility>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;
class Modify;

class LostState {
 public:
  // by who is there in LAMMPS::init() before Modify::init(), as pair styles are
  void note(Modify *);
  // A warning where the state of this fix is lost, once.
  //   means   for the fix, as in "springs of its contacts are gone"
  static void warn(LAMMPS *, const Fix *, const std::string &means);

 private:
  std::vector<std::pair<std::string, std::string>> lost;    // ID, style
  bool take(const Fix *);
};

}    // namespace LAMMPS_NS

#endif
