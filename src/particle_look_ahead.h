// Which particles take part in the collision steps of a particle step, on all ranks, and which
// ghosts they need: the look-ahead of timestep/look_ahead.h over all contacts and walls.

#ifndef APF_PARTICLE_LOOK_AHEAD_H
#define APF_PARTICLE_LOOK_AHEAD_H

#include "ghost_exchange.h"
#include "pointers.h"
#include "timestep/look_ahead.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {

class ParticleLookAhead : protected Pointers {
 public:
  static constexpr int forward_size = 3, reverse_size = 6;    // doubles per atom of messages

  // messages go through that fix; off: only particles that touch take part
  ParticleLookAhead(LAMMPS *lmp, class Fix *carrier, const char *command);
  bool on = true;

  void init(class FixContactHistory *history, const std::vector<class FixContacts *> &keepers,
            int freeze_group_bit);
  void begin_run() { warned_of_skin = false; }
  void list_was_built();                      // rows are new
  void share(std::vector<char> &activity);    // with ghosts, as owners know it; collective
  // fix deform moves the box after the forces of every so many steps; 0: before them, or not at all
  int box_every = 0;
  // by which the box is behind what it should be where forces are computed           [time]
  double box_lag() const;
  // ghosts of a new list to where they will be in the box that much later; collective
  void move_images(double time);

  // Looks at a particle step. slow_largest: acceleration of sub-stepped atoms here. Returns whether
  // the neighbour list must be built anew at the end of the step. Collective.
  bool look(double slow_largest);
  // loads that ghosts' rows have go to the rows of their owners; collective
  void gather_loads();

  bool free(int i) const { return ahead.activity[i] == apf::FREE; }
  apf::LookAhead ahead;
  GhostExchange exchange;    // of the ghosts that collision steps need

  int pack_forward(int n, const int *list, double *buf) const;
  void unpack_forward(int n, int first, const double *buf);
  int pack_reverse(int n, int first, double *buf);
  void unpack_reverse(int n, const int *list, const double *buf);

  double memory_usage() const;    // [bytes]

 private:
  class Fix *carrier;
  const char *command;
  class FixContactHistory *history = nullptr;
  int freeze_group_bit = 0;
  std::vector<class FixContacts *> keepers;
  bool friction = false;    // of any contact that there may be
  bool warned_of_skin = false;

  std::vector<double> x_built;    // positions when the neighbour list was built, [atoms][3]
  bool owners_known = false;
  std::vector<int> owner_rank, owner_row;    // of local and ghost atoms, while these are told
  std::vector<char> *shared = nullptr;       // while it is told
  std::vector<std::array<double, 3>> position_of_owner;    // of ghosts, while it is told
  enum class Message { OWNERS, ACTIVITY, SHARED, ACCELERATION, POSITIONS, LOADS };
  Message message = Message::OWNERS;

  // global maxima at the start of a particle step
  struct Extremes {
    double spread;          // of velocities, with images and walls: no two differ by more
                            //                                                       [velocity]
    double acceleration;    // of particles that touch nothing                  [velocity/time]
    double displacement;    // since the neighbour list was built                      [length]
  };

  Extremes find_extremes(double slow_largest);
  bool moves(int i) const;
  void refuse_not_finite();    // numbers that are not finite
  void come_near(int i);
  double farthest_lag() const;
  bool set_reach(const Extremes &);
  void find_active();
  void share_activity();
  void know_owners();
};

}    // namespace LAMMPS_NS

#endif
