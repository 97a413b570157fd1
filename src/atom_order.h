// Which atom has which number on this rank, owned or ghost. Lists of contacts hold numbers;
// commands between runs may give atoms others.

#ifndef APF_ATOM_ORDER_H
#define APF_ATOM_ORDER_H

#include "atom.h"

#include <cstdint>

namespace LAMMPS_NS {

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
  std::uint64_t now = 0;

  static std::uint64_t of(const Atom *atom)
  {
    constexpr std::uint64_t prime = 0x100000001b3;    // of the hash FNV-1a
    const int all = atom->nlocal + atom->nghost;
    std::uint64_t hash = atom->nlocal * prime + all;
    for (int i = 0; atom->tag_enable && i < all; i++) hash = (hash ^ atom->tag[i]) * prime;
    return hash;
  }
};

}    // namespace LAMMPS_NS

#endif
