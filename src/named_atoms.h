// The few atoms of all ranks that a message names, the worst ones first.

#ifndef APF_NAMED_ATOMS_H
#define APF_NAMED_ATOMS_H

#include "lmptype.h"

#include <mpi.h>

#include <string>
#include <vector>

namespace LAMMPS_NS {

class NamedAtoms {
 public:
  void add(tagint id, double depth) { here.push_back({depth, id}); }

  void gather(MPI_Comm world);    // collective; the rest is the same on all ranks after it
  bigint number() const { return all; }
  double deepest() const { return worst.front().depth; }
  std::string ids() const;    // as in "12, 7, 30 and 5 more"

 private:
  struct Named {
    double depth;
    tagint id;
    bool operator<(const Named &other) const
    {
      return depth != other.depth ? depth > other.depth : id < other.id;
    }
  };
  static constexpr int most = 5;    // that are named
  std::vector<Named> here, worst;
  bigint all = 0;
};

}    // namespace LAMMPS_NS

#endif
