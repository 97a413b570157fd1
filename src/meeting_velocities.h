// Velocities of all bodies that may meet: particles, walls, and images where the box is sheared or
// stretched. With walls among them, what follows is the same for who moves along.

#ifndef APF_MEETING_VELOCITIES_H
#define APF_MEETING_VELOCITIES_H

#include "contact/bodies.h"
#include "timestep/look_ahead.h"

#include <vector>

namespace LAMMPS_NS {

class MeetingVelocities {
 public:
  // of a particle
  void include(const double *v) { bodies.include(v); }
  // of all images, by their rows, and of the walls that particles may touch within that time
  void include_others(const class Atom *, const class Domain *, const apf::Bodies &rows,
                      const std::vector<class FixContacts *> &keepers, double time);

  // what ranks tell each other: the largest of each of these numbers
  static constexpr int size = 13;
  void pack(double *) const;
  void unpack(const double *);

  double spread() const { return bodies.spread(images); }    // no two that may meet differ by more
  double fastest() const { return bodies.fastest(); }        // of particles and walls
  bool walls_move() const { return moving_walls; }

 private:
  apf::VelocityRange bodies, images;
  bool moving_walls = false;
};

}    // namespace LAMMPS_NS

#endif
