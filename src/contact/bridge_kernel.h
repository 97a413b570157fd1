// Runs the laws of liquid bridges over a BridgeList, a block of bridges at a time, as
// contact_kernel.h does it for contacts.

#ifndef APF_BRIDGE_KERNEL_H
#define APF_BRIDGE_KERNEL_H

#include "bridge_list.h"

namespace apf {

// Which sub-models some bridge of the list uses, and whether it lives in the xy plane.
struct BridgeChoice {
  bool planar = false, viscous = false, fitted = false, tangential = false;

  void include(const BridgeModel &model)
  {
    viscous |= model.mu > 0.0;
    fitted |= model.capillary == Capillary::willett;
    tangential |= model.tangential;
  }
};

using BridgeKernel = int (*)(BridgeList &list, Bodies &bodies, ContactTimes times,
                             BridgeParts *parts);

// The kernel for a choice. kernel(list, bodies, times, parts):
//   adds forces and torques of all bridges to the loads of the bodies' rows and, where parts is not
//   null, fills parts[0 .. list.size()-1].
// Returns how many bridges have ruptured: these exert nothing, the caller removes them
// (list.ended).
BridgeKernel bridge_kernel(const BridgeChoice &choice);

// the same source built for one instruction set, see KernelBuild
struct BridgeBuild {
  const char *name;
  BridgeKernel (*kernel)(const BridgeChoice &choice);
};
const std::vector<BridgeBuild> &bridge_builds();

// The kernel with what bridges exert too much or too little that formed or ruptured in the step.
inline int add_bridge_forces(BridgeKernel kernel, BridgeList &list, Bodies &bodies,
                             const ContactTimes &times, std::vector<DueLoad> &due,
                             BridgeParts *parts = nullptr)
{
  const bool goes_on = times.advance > 0.0;
  if (goes_on) list.grow_older();
  const int ended = kernel(list, bodies, times, parts);
  if (goes_on)
    bodies.with_rows([&](auto *rows) {
      list.correct_jumps(rows, times.advance, ended, due);
    });
  return ended;
}

}    // namespace apf

#endif
