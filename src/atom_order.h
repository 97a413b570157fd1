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

// of owned atoms
class AtomSizes {
 public:
  void note(const Atom *atom) { now = of(atom); }
  bool hold(const Atom *atom) const { return now == of(atom); }

 private:
  apf::WordHash now;

  static apf::WordHash of(const Atom *atom)
  {
    const int n = atom->nlocal;
    return apf::WordHash(n).add(atom->radius, n).add(atom->rmass, n).add(atom->type, n);
  }
};

// of owned atoms
class AtomPlaces {
 public:
  void note(const Atom *atom) { now = of(atom); }
  bool hold(const Atom *atom) const { return now == of(atom); }

 private:
  apf::WordHash now;

  static apf::WordHash of(const Atom *atom)
  {
    apf::WordHash hash(atom->nlocal);
    for (int i = 0; i < atom->nlocal; i++) hash.add(atom->x[i], 3);
    return hash;
  }
};

}    // namespace LAMMPS_NS

#endif
