// How a wall moves, as a script says it: speeds that are numbers or equal-style variables, held
// over each step.

#ifndef LMP_WALL_MOTION_H
#define LMP_WALL_MOTION_H

#include "pointers.h"

#include "wall/wall_pose.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class WallMotion : protected Pointers {
 public:
  apf::WallPose pose;

  explicit WallMotion(LAMMPS *lmp) : Pointers(lmp) {}

  // move linear VX VY VZ | move rotate PX PY PZ WX WY WZ; iarg stands at `move` and is left behind
  // the last value
  void parse(const char *command, int narg, char **arg, int &iarg);
  void init(const char *id);    // of the fix, for errors
  void take_speeds();           // of the step that begins now

  bool varies() const { return by_variables; }
  bool same_as(const WallMotion &) const;    // where it is, and how it moves on

  // the largest speed of the wall within a distance of its centre of rotation         [velocity]
  double fastest(double reach) const;

 private:
  struct Speed {
    double value = 0.0;
    std::string variable;    // or none
    int index = -1;
  };
  Speed linear[3], turn[3];
  bool by_variables = false, moved = false, turned = false;
  std::string command, id;

  void find_variables();
};

}    // namespace LAMMPS_NS

#endif
