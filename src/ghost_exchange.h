// Positions, velocities and loads of the ghost atoms that sub-steps need, sent straight between the
// ranks that own and that use them: LAMMPS's own exchange would send all ghosts, dimension by
// dimension.

#ifndef APF_GHOST_EXCHANGE_H
#define APF_GHOST_EXCHANGE_H

#include "contact/bodies.h"
#include "contact/islands.h"

#include <mpi.h>
#include <vector>

namespace LAMMPS_NS {
class Domain;

class GhostExchange {
 public:
  explicit GhostExchange(MPI_Comm world);

  // Owners of ghosts nlocal .. nlocal+nghost-1: rank and local index. Collective.
  void set_owners(int nlocal, std::vector<int> rank, std::vector<int> index);

  // Ghosts to keep up to date: those with used[row] != 0. Owners learn which of their atoms are
  // wanted and mark these in wanted[row]. lag: from the box as it is to that of the particle step's
  // end, to which images move on. Collective.
  void choose(const std::vector<char> &used, const Domain *domain, double lag,
              const apf::Bodies &bodies, std::vector<char> &wanted);

  // owners' positions and velocities go to ghosts; collective. left: share of the particle step to
  // come. Returns how many ghosts here it has brought up to date.
  template <class Row> int forward(Row *rows, double left);
  // loads of ghosts are added to those of their owners, and cleared; collective
  template <class Row> void reverse(Row *rows);

  const std::vector<int> &ghosts() const { return chosen; }
  // these, and the own atoms that others have as ghosts, have to do with others
  void pin(apf::Islands &) const;

 private:
  struct Image {
    int ghost;                 // row here
    double shift[3], dv[3];    // from the owner, at the end of the particle step
    double to_come[3];         // of the shift within it; 0 in a box that does not change
  };
  struct Partner {
    int rank;
    std::vector<int> sent;        // local rows that the partner has as ghosts
    std::vector<Image> images;    // ghosts here that the partner owns
    std::vector<double> out, in;
  };

  MPI_Comm world;
  int me, nprocs;
  int first = 0;                             // row of the first ghost
  std::vector<int> owner_rank, owner_row;    // of each ghost
  std::vector<Partner> partners;             // without this rank
  Partner self;                              // periodic images of own atoms
  std::vector<int> partner_of_rank;
  std::vector<int> chosen;
  std::vector<MPI_Request> requests;

  // every partner's `out` is sent and `in` filled; none of them may be touched until finish()
  void start(int tag);
  void finish();

  Partner &partner(int rank) { return rank == me ? self : partners[partner_of_rank[rank]]; }
};

}    // namespace LAMMPS_NS

#endif
