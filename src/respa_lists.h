// Neighbour lists of contacts under run_style respa. LAMMPS looks at the begin of an outermost step
// whether the particles have moved by half the skin, and then lets them move through all inner
// steps of it: pairs that come near each other on the way are not in the list and would be found
// only when they overlap, too deep. Here the way of the step is counted before it is gone.

#ifndef APF_RESPA_LISTS_H
#define APF_RESPA_LISTS_H

#include "contact/bodies.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class RespaLists : protected Pointers {
 public:
  RespaLists(LAMMPS *lmp, const char *command) : Pointers(lmp), command(command) {}

  void list_was_built();    // rows are new

  // At the begin of an outermost step, when forces are those of its level: whether the list has to
  // be built for it. kicked: these forces are not contacts', so that they add to all approaches. An
  // error if the skin is thinner than an approach. rows: of all atoms. Collective.
  bool too_old_for_step(bool kicked, const apf::Bodies &rows,
                        const std::vector<class FixContacts *> &keepers);

  double memory_usage() const { return x_built.capacity() * sizeof(double); }    // [bytes]

 private:
  const char *command;
  std::vector<double> x_built;    // positions when the list was built, [atoms][3]
};

}    // namespace LAMMPS_NS

#endif
