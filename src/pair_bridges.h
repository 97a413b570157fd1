// Liquid bridges between particles, for pair style granular/adhesive: which pairs are joined, their
// forces, the liquid that they take and give back.

#ifndef APF_PAIR_BRIDGES_H
#define APF_PAIR_BRIDGES_H

#include "contact/bridge_kernel.h"
#include "contact/candidates.h"
#include "pair_index.h"
#include "pointers.h"

#include <vector>

namespace LAMMPS_NS {

class PairBridges : protected Pointers {
 public:
  PairBridges(class LAMMPS *lmp, class PairGranularAdhesive *style) : Pointers(lmp), pair(style) {}

  void serve(class FixContactHistory *fix) { store = fix; }
  void init();                               // no laws yet
  void include(const apf::BridgeModel &);    // a law that some pair of types has

  // a new neighbour list: its pairs one after another, in the order of the pair style's candidates
  void begin_list();
  void add_candidate(int i, int j, const class NearestImages &images);

  // bridges form; all: of all pairs, or of those near each other. step: since the last look
  void detect(bool all, double step);
  int add_forces(apf::Bodies &, const apf::ContactTimes &, apf::BridgeParts *);
  void remove_ruptured(bool in_sub_step);
  void share_masses();

  // what FixContacts asks of the pair style
  void find_fastest(apf::LookAhead &);
  void find_approaching(apf::LookAhead &, std::vector<int> &near_touch);
  template <class Row> bool find_near(const Row *rows, apf::LookAhead &ahead)
  {
    return meetings.find_near(rows, ahead);
  }
  void find_stiffest(apf::Stiffest &);

  // liquid on the particles, where there is an inventory: what was taken since it was settled last
  // is cut down to what there was
  void settle();
  void fill_new_atoms();

  const apf::BridgeList &all() const { return list; }
  void evaluate(const apf::ContactTimes &);    // parts of all bridges as they are now
  PairIndex::Found find(int i, int j) const { return number_of.find(i, j); }
  std::vector<apf::BridgeParts> parts;

  double memory_usage() const { return list.memory_usage() + meetings.memory_usage(); }

 private:
  class PairGranularAdhesive *pair;
  class FixContactHistory *store = nullptr;
  apf::BridgeList list;
  apf::BridgeChoice choice;
  apf::BridgeKernel kernel = nullptr;
  apf::Candidates meetings;       // pairs with the distance at which they are joined
  std::vector<char> unsettled;    // of each pair: its bridge has formed since liquid was settled
  PairIndex number_of;

  double forming_distance(int i, int j) const;
  apf::BridgeMemory intake(int i, int j) const;
  void form(int k, const apf::Approach &, double step);
  int number_of_kind(int i, int j);    // in list.kinds
  double mass_left(int i, int j, double zi, double zj) const;
};

}    // namespace LAMMPS_NS

#endif
