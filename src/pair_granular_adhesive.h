#ifdef PAIR_CLASS
// clang-format off
PairStyle(granular/adhesive,PairGranularAdhesive);
// clang-format on
#else

#ifndef LMP_PAIR_GRANULAR_ADHESIVE_H
#define LMP_PAIR_GRANULAR_ADHESIVE_H

#include "pair.h"

#include "contact/candidates.h"
#include "contact/contact_kernel.h"
#include "contact/contact_tiles.h"
#include "contact_checks.h"
#include "contact_keywords.h"
#include "pair_bridges.h"
#include "pair_index.h"
#include "run_guard.h"
#include "type_sizes.h"

#include <array>
#include <initializer_list>

namespace LAMMPS_NS {

class PairGranularAdhesive : public Pair {
 public:
  PairGranularAdhesive(class LAMMPS *);
  ~PairGranularAdhesive() override;

  void compute(int, int) override;
  void settings(int, char **) override;
  void coeff(int, char **) override;
  void init_style() override;
  void setup() override;
  void reset_dt() override;
  double init_one(int, int) override;
  void write_restart(FILE *) override;
  void read_restart(FILE *) override;
  void write_data(FILE *) override;
  void write_data_all(FILE *) override;
  double single(int, int, int, int, double, double, double, double &) override;
  void *extract(const char *, int &) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;
  double memory_usage() override;

  // for the fix that keeps histories
  const apf::ContactList &closed_contacts() const { return contacts; }
  const apf::BridgeList *liquid_bridges() const { return wet ? &bridges.all() : nullptr; }
  void settle_bridges() { bridges.settle(); }
  double longest_neck() const { return neck_max; }
  double longest_reach() const { return reach_max; }    // of necks and bridges
  bool remembers() const;    // whether contacts have more than the places of their particles
  bool planar() const { return choice.planar; }
  void list_was_built() { rebuild = true; }
  apf::StiffestMode stiffest_possible() const;    // of any two particles
  const ContactCoeff &coeff_of_types(int i, int j) const { return coefficients[i][j]; }

  // sub-steps of a particle step, see FixContacts
  bool slides() const;
  void find_fastest(apf::LookAhead &);
  void find_approaching(apf::LookAhead &);
  bool find_near(apf::LookAhead &);
  void find_stiffest(apf::Stiffest &);
  void sub_step(const apf::ContactTimes &);

  // tiles of bodies whose collision steps are taken apart from the rest, see contact/islands.h
  bool has_tiles() const { return !wet; }    // bridges look through all pairs
  int pairs_to_step() const { return contacts.size() + static_cast<int>(candidates.near.size()); }
  void join_bodies(apf::Islands &) const;
  void part(const apf::Islands &);
  void enter_tile(int tile) { tiles.enter(tile, contacts, candidates.near); }
  void leave_tile() { tiles.leave(contacts, candidates.near); }
  void join_tiles() { tiles.join(contacts); }

  // for its bridges; of two atoms, or of a candidate
  const ContactCoeff &coeff_of(int i, int j) const;
  apf::ContactBodies bodies_of(int i, int j, double zi, double zj) const;
  apf::ContactBodies bodies_of_bridge(int i, int j, double zi, double zj) const;
  int law_of(int i, int j) const;    // number of the coefficient
  bool is_closed(int candidate) const { return candidates.closed[candidate]; }

 private:
  [[noreturn]] void refuse_damaged(int i, int j);    // coefficients of a restart file
  void parse_types(const char *word, int iarg, int &lo, int &hi) const;
  apf::Candidates candidates;    // pairs of the neighbour list
  apf::ContactList contacts;
  apf::ContactTiles tiles;
  apf::KernelChoice choice;
  apf::ContactKernel kernel = nullptr;
  PairBridges bridges;
  bool wet = false;                                       // some coefficient has bridges
  std::vector<std::vector<ContactCoeff>> coefficients;    // [1..ntypes][1..ntypes]

  RunGuard guard;
  class FixContactHistory *store = nullptr;    // histories between rebuilds, velocities
  std::string id_store;
  bool rebuild = true;       // neighbour list is newer than candidates
  bool new_list = true;      // candidates are new, and passages were not looked for
  double neck_max = 0.0;     // longest neck of any pair of types
  double reach_max = 0.0;    // and longest neck or bridge
  int freeze_group_bit = 0;
  class Fix *rigid = nullptr;
  std::vector<double> mass_rigid;    // of the body an atom belongs to, 0 if none
  TypeSizes sizes;
  std::array<int, 3> lists_told{0, 1, 0};    // of neigh_modify: delay, every, once
  TimestepCheck timestep;

  // values per pair that single() offers; energies by part that compute pair offers
  static constexpr int n_contact_parts = 11, n_parts = n_contact_parts + 6;
  static constexpr int bridge_energy = 4, n_energies = 5;

  // parts of all contacts at one timestep, for single()
  struct KeptParts : apf::ContactReader {
    std::vector<apf::ContactParts> of;
    void read(int k, const apf::ContactParts &p) override { of[k] = p; }
  } parts;
  PairIndex index_of_pair;
  bigint parts_step = -1;

  template <class Has> bool some_coeff(const Has &) const;    // of whose model has(model) is true
  bool has_springs() const;                                   // of sliding, twisting or rolling
  void allocate();
  void find_special_bodies();
  void find_rigid_masses();
  void build_candidates();
  void detect(bool all, double step);
  void check_touch(const apf::Approach &, int contact);
  void check_passages();
  std::string ids_of(int i, int j) const;    // for errors
  void close(int candidate, const apf::ContactHistory &);
  int number_of_kind(int i, int j);    // in contacts.kinds
  double overlap_at_rest(int i, int j) const;
  void check_places();
  const apf::StiffestMode &mode_of(int i, int j)
  {
    return contacts.kinds[number_of_kind(i, j)].mode;
  }
  void share_masses();
  void correct_ends(double step);
  double init_bridge(int i, int j, double ri, double rj);
  void remove_ended(bool in_sub_step);
  // adds up energies, virial and stress of contacts while their forces are computed
  struct Tally : apf::ContactReader {
    Tally(PairGranularAdhesive &style, int flag) : pair(style), eflag(flag) {}
    void read(int k, const apf::ContactParts &) override;
    PairGranularAdhesive &pair;
    int eflag;
  };
  void tally_bridges(int eflag);
  void tally_pair(int i, int j, int eflag, const double (&f)[3], int first,
                  std::initializer_list<double> energies);
  void evaluate_parts();
  double single_contact(int i, int j, double rsq, double &fforce);
  double single_bridge(int i, int j, double rsq, double &fforce);
};

}    // namespace LAMMPS_NS

#endif
#endif
