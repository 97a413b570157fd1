// Velocities of all bodies that may meet: particles, walls, and images where the box is sheared or
// stretched. With walls among them, what follows is the same for who moves along.

#ifndef APF_MEETING_VELOCITIES_H
#define APF_MEETING_VELOCITIES_H

#include "contact/bodies.h"
#include "timestep/look_ahead.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class MeetingVelocities {
 public:
  // of a particle, and of one that cannot be moved
  void include(const double *v) { bodies.include(v); }
  void include_held()
  {
    const double rest[3] = {};
    walls.include(rest);
  }
  // of all images, by their rows, and of the walls that particles may touch within that time
  void include_others(const class Atom *, const class Domain *, const apf::Bodies &rows,
                      const std::vector<class FixContacts *> &keepers, double time);

  // what ranks tell each other: the largest of each of these numbers
  static constexpr int size = 18;
  void pack(double *) const;
  void unpack(const double *);

  double spread() const;    // no two that may meet differ by more
  // a frame in which walls rest, or the middle of all velocities if there are none
  void frame(double *v) const { (walls.empty() ? bodies : walls).middle(v); }
  double fastest(const double *in) const;    // of particles and images in a frame
  double fastest_wall(const double *in) const { return walls.farthest_from(in); }

  // what a script may change if bodies with this spread and acceleration approach farther in a
  // timestep than the neighbor skin lets them be seen; enough: of the skin
  static std::string cure(double spread, double acceleration, double skin, double enough);

 private:
  apf::VelocityRange bodies, images, walls;
};

}    // namespace LAMMPS_NS

#endif
