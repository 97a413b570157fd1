// Runs the contact law over a ContactList, a block of contacts at a time: gathers what the law
// needs of their bodies into vector registers, one contact per lane, and scatters forces.

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

// Gets what each contact exerts while the kernel runs: there may be millions, too many to keep.
// No reader stands here, or each instruction set would compile its own (test instruction_sets).
class ContactReader {
 public:
  virtual void read(int k, const ContactParts &) = 0;

 protected:
  ~ContactReader() = default;
};

using ContactKernel = int (*)(ContactList &list, Bodies &bodies, ContactTimes times,
                              ContactReader *reader);

// The kernel for a choice. kernel(list, bodies, times, reader):
//   adds forces and torques of all contacts to the loads of the bodies' rows, whose velocities are
//   times.behind older than their positions,
//   advances the histories by times.advance (0: evaluates only), sets list.overlap,
//   and, where reader is not null, gives it the parts of contacts 0 .. list.size()-1.
// Returns how many contacts are beyond the end of their neck: these exert nothing, the caller
// removes them (list.ended).
ContactKernel contact_kernel(const KernelChoice &choice);

// The same source built for one instruction set.
struct KernelBuild {
  const char *name;
  ContactKernel (*kernel)(const KernelChoice &choice);
};

// The builds that this processor can run, from the most modest to the best. contact_kernel() takes
// the best, or the one that the environment variable APF_ISA names.
const std::vector<KernelBuild> &kernel_builds();

}    // namespace apf

#endif
