// What contacts know of atoms by their numbers on this rank, and commands between runs may change:
// which atom has which number, diameters, masses and types, and places.

#ifndef APF_ATOM_ORDER_H
#define APF_ATOM_ORDER_H

#include "atom.h"
#include "flow/word_hash.h"

namespace LAMMPS_NS {

// of owned atoms and ghosts
class AtomOrder {
 public:
  void note(const Atom *atom)
  {
    noted = true;
    now = of(atom);
  }
  // whether it is as when it was noted; true before that
  bool holds(const Atom *atom) const { return !noted || now == of(atom); }

 private:
  bool noted = false;
  apf::WordHash now;

  static apf::WordHash of(const Atom *atom)
  {
    const int all = atom->nlocal + atom->nghost;
    return apf::WordHash(atom->nlocal).add(&all, 1).add(atom->tag, atom->tag_enable ? all : 0);
  }
};

// What of() says of owned atoms, as it was noted
template <apf::WordHash (*of)(const Atom *)> class NotedAtoms {
 public:
  void note(const Atom *atom) { now = of(atom); }
  bool hold(const Atom *atom) const { return now == of(atom); }

 private:
  apf::WordHash now;
};

inline apf::WordHash hash_of_sizes(const Atom *atom)
{
  const int n = atom->nlocal;
  return apf::WordHash(n).add(atom->radius, n).add(atom->rmass, n).add(atom->type, n);
}

inline apf::WordHash hash_of_places(const Atom *atom)
{
  apf::WordHash hash(atom->nlocal);
  for (int i = 0; i < atom->nlocal; i++) hash.add(atom->x[i], 3);
  return hash;
}

using AtomSizes = NotedAtoms<hash_of_sizes>;
using AtomPlaces = NotedAtoms<hash_of_places>;

}    // namespace LAMMPS_NS

#endif
