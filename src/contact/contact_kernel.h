// Runs the contact law over a ContactList: gathers blocks of contacts into small arrays, lets the
// compiler turn the law into vector instructions, scatters forces.

#ifndef APF_CONTACT_KERNEL_H
#define APF_CONTACT_KERNEL_H

#include "bodies.h"
#include "contact_law.h"

namespace apf {

// Which sub-models some contact of the list uses, and whether it lives in the xy plane.
struct KernelChoice {
  bool planar = false, adhesion = false, sliding = false, twisting = false, rolling = false;

  void include(const ContactModel &model)
  {
    adhesion |= model.adhesive();
    sliding |= model.sliding();
    twisting |= model.twisting;
    rolling |= model.rolling();
  }
};

using ContactKernel = int (*)(ContactList &list, Bodies &bodies, ContactTimes times,
                              ContactParts *parts);

// The kernel for a choice. kernel(list, bodies, times, parts):
//   adds forces and torques of all contacts to the loads of the bodies' rows, whose velocities are
//   times.behind older than their positions,
//   advances the histories by times.advance (0: evaluates only), sets list.overlap,
//   and, where parts is not null, fills parts[0 .. list.size()-1].
// Returns how many contacts are beyond the end of their neck: these exert nothing, the caller
// removes them (list.ended).
ContactKernel contact_kernel(const KernelChoice &choice);

// The same, built for one instruction set; contact_kernel() takes the best this processor has.
namespace baseline {
  ContactKernel contact_kernel(const KernelChoice &choice);
}
namespace avx2 {
  ContactKernel contact_kernel(const KernelChoice &choice);
}

}    // namespace apf

#endif
