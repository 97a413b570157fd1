#ifdef FIX_CLASS
// clang-format off
FixStyle(contact/history,FixContactHistory);
// clang-format on
#else

#ifndef LMP_FIX_CONTACT_HISTORY_H
#define LMP_FIX_CONTACT_HISTORY_H

#include "fix_contacts.h"

#include "lost_state.h"
#include "respa_lists.h"

namespace LAMMPS_NS {

// Serves one pair style granular/adhesive, which creates it: keeps its contacts, makes the
// neighbour list reach to the end of the longest neck, and keeps the velocities of the last forces.

class FixContactHistory : public FixContacts {
 public:
  FixContactHistory(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void initial_integrate_respa(int, int, int) override;
  void setup_pre_exchange() override;
  void setup_pre_neighbor() override { pre_neighbor(); }
  void pre_neighbor() override;
  void min_pre_neighbor() override { pre_neighbor(); }
  void post_neighbor() override;
  double memory_usage() override;

  int pack_reverse_comm(int, int, double *) override;
  void unpack_reverse_comm(int, int *, double *) override;
  int pack_forward_comm(int, int *, double *, int, int *) override;
  void unpack_forward_comm(int, int, double *) override;

  bool slides() const override;
  void find_fastest(apf::LookAhead &) override;
  void find_approaching(apf::LookAhead &) override;
  bool find_near(apf::LookAhead &) override;
  void find_stiffest(apf::Stiffest &) override;
  void settle_bridges() override;
  void sub_step(const apf::ContactTimes &) override;
  double contacts_here() const override;
  double longest_neck() const;
  apf::StiffestMode stiffest_possible() const;
  using FixContacts::fault_of_touch;
  using FixContacts::following_timestep;
  using FixContacts::follows_given_steps;
  using FixContacts::note_touch;
  using FixContacts::or_collision_steps;
  using FixContacts::step_is_given;
  using FixContacts::steps;

  void serve(class PairGranularAdhesive *style) { pair = style; }
  class PairGranularAdhesive &served() const { return *pair; }

  // the error of atom i, which touches a partner through more than one of its images
  [[noreturn]] void refuse_images(int i, tagint partner, const char *does = "touches",
                                  const char *wider = "") const;

  // history of atom i's contact with the atom of that ID at the last rebuild, if there was one
  std::optional<apf::ContactHistory> find(int i, tagint partner) const
  {
    return store.contacts.find(i, partner);
  }
  std::optional<apf::BridgeMemory> find_bridge(int i, tagint partner) const
  {
    return store.bridges.find(i, partner);
  }

  // Liquid on particles, where bridges take theirs from there. Ranks see what others have taken or
  // given when it is settled, at each particle step: then all bridges of a particle that together
  // took more than it had get the same part of what they asked for.
  void keep_liquid() { store.keep_liquid(); }
  bool keeps_liquid() const { return store.keeps_liquid(); }
  double *all_liquid() { return store.liquid.data(); }      // of local atoms
  double liquid(int i) const { return store.liquid[i]; }    // of local and ghost atoms
  void begin_liquid(int i, double volume);                  // of a new atom; else nothing
  void take_liquid(int i, double volume) { account(i)[0] += volume; }
  void give_liquid(int i, double volume) { account(i)[1] += volume; }
  double granted(int i) const { return settled[2 * i + 1]; }    // of what was taken     [-]
  void settle_liquid();                                         // collective
  void share_liquid();        // tells ghosts, and new atoms; collective
  void end_lost_bridges();    // at the first forces of a run

  // Counts contacts, with particles and walls, where some were made or have ended on any rank since
  // the last count; returns whether so. Collective.
  bool count_contacts();
  double count(int i) const { return at(counts, i); }    // of local and ghost atoms
  double pair_count(int i) const
  {
    return at(pair_counts, i);
  }                                                   // with particles only, local atoms
  bigint counted() const { return times_counted; }    // so often until now
  using FixContacts::count_anew;
  using FixContacts::due;

  // positions and velocities of the last forces, and these forces; local and ghost atoms
  apf::Bodies &bodies() { return velocities.bodies; }
  LostState lost;    // of other fixes
  int level() const override;
  using FixContacts::last_times;
  using FixContacts::step_of_level;
  using FixContacts::take_velocities;
  using FixContacts::times;

 protected:
  void store_contacts() override;
  template <class List, class Records>
  void check_images(const List &, const Records &, const char *does, const char *wider) const;
  void before_storing() override;
  void add_counts(double *) override;
  bool stores_alone() const override;
  void collect_due(std::vector<double> &) override;

 private:
  void share_velocities() override;

  class PairGranularAdhesive *pair = nullptr;
  int outermost = -1;    // level of run_style respa, if that integrates
  RespaLists lists{lmp, "Pair granular/adhesive"};
  double radius_growth = 0.0;
  std::vector<double> counts, pair_counts;
  // what communication carries: numbers [local and ghost atoms][columns], else velocities and
  // histories
  std::vector<double> *carried = nullptr;
  int columns = 1;
  bigint changes_counted = -1;
  bigint times_counted = 0;
  std::vector<int> sent;    // records that each ghost has sent to its owner

  std::vector<double> accounts;    // [local and ghost atoms][taken, given] since settled
  std::vector<double> settled;     // [local and ghost atoms][liquid, part granted]
  bool liquid_moved = false;       // on this rank, since settled
  double *account(int i)
  {
    liquid_moved = true;
    if (accounts.empty()) accounts.assign(2 * store.liquid.size(), 0.0);
    return &accounts[2 * i];
  }
  void tell_ghosts();

  void give_to_owners(std::vector<double> &, int columns);
  template <class Records> void send_to_owners(Records &);
  enum class Sent { CONTACTS, BRIDGES } sending = Sent::CONTACTS;
  static double at(const std::vector<double> &numbers, int i)    // 0 before the first count
  {
    return i < static_cast<int>(numbers.size()) ? numbers[i] : 0.0;
  }
};

}    // namespace LAMMPS_NS

#endif
#endif
