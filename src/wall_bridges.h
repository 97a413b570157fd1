// Liquid bridges between particles and the surfaces of a wall, for fix wall/levelset.

#ifndef APF_WALL_BRIDGES_H
#define APF_WALL_BRIDGES_H

#include "contact/bridge_kernel.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class WallBridges : protected Pointers {
 public:
  WallBridges(class LAMMPS *lmp, class FixWallLevelset *fix);

  // film THICKNESS, with iarg at the word film; iarg is left behind the last word
  void parse_film(const char *command, int narg, char **arg, int &iarg);
  void init();
  int size() const { return list.size(); }
  void find_again();    // after the neighbour list was built
  void store_into(class ContactStore &) const;
  void add_counts(double *) const;
  double count(int i) const;    // of atom i

  void measure_films();    // called by all ranks
  void detect(double step);
  int add_forces(const apf::ContactTimes &, std::vector<apf::DueLoad> &due);
  void remove_ruptured(bool in_sub_step);
  void share_masses();
  struct Loads {    // on the wall
    double capillary[3], viscous[3], energy;
  };
  Loads loads();                      // as the last forces were
  double liquid_held() const;         // in the bridges
  double liquid_from_wall() const;    // ... the part that the wall gave

  // copies of particles and foot points, as the wall's own: two rows a bridge, its atom in atoms()
  const apf::Bodies &copies() const { return rows; }
  const std::vector<int> &atoms() const { return list.source; }
  const std::vector<int> &surfaces() const { return surface_of; }

  // sub-steps, see FixContacts
  void find_fastest(apf::LookAhead &);
  void find_approaching(apf::LookAhead &);
  void find_near(const apf::LookAhead &);
  void find_stiffest(apf::Stiffest &);
  void sub_detect(double step);
  void settle();

  // for output, [atoms]
  int *counts_of_atoms();
  double *liquid_of_atoms();
  void count_where_dry_contact_is_not(std::vector<int> &counts) const;

  double memory_usage() const { return list.memory_usage() + rows.memory_usage(); }

 private:
  class FixWallLevelset *wall;
  apf::BridgeList list;    // source: the atom
  apf::BridgeKernel kernel = nullptr;
  int frozen_bits = 0;
  std::vector<int> surface_of;     // of each bridge
  std::vector<char> unsettled;     // of each bridge: formed since liquid was settled
  std::vector<unsigned> joined;    // per atom: bit s set if a bridge joins it to surface s
  apf::Bodies rows;
  std::vector<int> counts;
  std::vector<double> volumes;
  struct Place {
    int i, surface;
    double gap;    // to where the bridge forms
  };
  std::vector<Place> near, perhaps;    // may form within the particle step; if the atom is struck

  double first_film = -1.0;     // of the wall; < 0: it gives no liquid                   [length]
  std::vector<double> films;    // of each zone, at the last particle step; empty if it gives none
  double thickest_film = 0.0;

  void check_inventory() const;
  double film_at(int i, int surface) const;
  double forming_distance(int i, double film) const;    // of the centre to the wall
  apf::BridgeMemory intake(int i, double film) const;
  void try_to_form(int i, int surface, double step);
  int number_of_kind(int i, int surface);    // in list.kinds
  void add(int i, int surface, const apf::BridgeMemory &, bool is_new);
  void gather();
};

}    // namespace LAMMPS_NS

#endif
