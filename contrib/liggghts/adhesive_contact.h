// What the three contact models of this folder share: the history of a contact between two spheres
// or a sphere and a wall, and the call of the contact law, which is src/contact/contact_law.h.
//
// LIGGGHTS stores histories as numbers of a contact, and turns the sign of those registered with
// "1" when it exchanges i and j. Vectors are those of contact_law.h: the normal points from i to j.

#ifndef APF_ADHESIVE_CONTACT_H
#define APF_ADHESIVE_CONTACT_H

#include "contact/contact_kind.h"
#include "contact/contact_law.h"

#include <string>

namespace apf {

using Space = SpaceFrame<double>;

// Names under which a model leaves the offset of its history in LIGGGHTS's list, for the normal
// model to find; what is not there (-1) is not modelled.
namespace history {
  constexpr const char *contact = "apf contact";    // mass (0: no contact), normal
  constexpr const char *sliding = "apf sliding";    // springs of sliding and of twisting
  constexpr const char *rolling = "apf rolling";    // spring of rolling
}    // namespace history

// Three numbers of a history; returns the first one's offset.
template <class HistorySetup>
int add_vector(HistorySetup *setup, std::string name, const char *sign)
{
  const int offset = setup->add_history_value(name + "_x", sign);
  setup->add_history_value(name + "_y", sign);
  setup->add_history_value(name + "_z", sign);
  return offset;
}

inline Vec3 vector_of(const double *u)
{
  return {u[0], u[1], u[2]};
}
inline void copy(const Vec3 &u, double *to)
{
  to[0] = u.x;
  to[1] = u.y;
  to[2] = u.z;
}

// adds to the load of a body, LIGGGHTS's ForceData
template <class Load> void add(const Vec3 &force, const Vec3 &torque, Load &load)
{
  copy(vector_of(load.delta_F) + force, load.delta_F);
  copy(vector_of(load.delta_torque) + torque, load.delta_torque);
}

// The history of one contact: numbers that LIGGGHTS owns.
struct StoredContact {
  double *contact, *sliding, *twisting, *rolling;    // null: not modelled

  ContactMemory<Space> load() const
  {
    ContactMemory<Space> memory{};
    memory.normal = vector_of(contact + 1);
    if (sliding) memory.sliding = vector_of(sliding);
    if (twisting) memory.twisting = *twisting;
    if (rolling) memory.rolling = vector_of(rolling);
    return memory;
  }
  void store(double mass, const ContactMemory<Space> &memory) const
  {
    contact[0] = mass;
    copy(memory.normal, contact + 1);
    if (sliding) copy(memory.sliding, sliding);
    if (twisting) *twisting = memory.twisting;
    if (rolling) copy(memory.rolling, rolling);
  }
  bool exists() const { return contact[0] > 0.0; }
  void end() const { store(0.0, {}); }
};

// The law, composed of the parts whose history there is.
template <bool... chosen>
ContactOutput<Space> law_of(const StoredContact &stored, const ContactConstants &c,
                            const ContactInput<Space> &in, ContactTimes times,
                            ContactMemory<Space> &memory)
{
  constexpr int n = sizeof...(chosen);
  if constexpr (n == 3) {
    return contact_law<Space, true, chosen...>(c, in, times, memory);
  } else {
    const double *part[] = {stored.sliding, stored.twisting, stored.rolling};
    return part[n] ? law_of<chosen..., true>(stored, c, in, times, memory)
                   : law_of<chosen..., false>(stored, c, in, times, memory);
  }
}

}    // namespace apf

#endif
