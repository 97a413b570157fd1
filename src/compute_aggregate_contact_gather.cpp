// What compute aggregate/contact takes from pair styles and walls: contacts, bridges and liquid of
// the particles of its group.

#include "compute_aggregate_contact.h"

#include "contact/bridge_list.h"
#include "contact/contact_list.h"

#include "atom.h"
#include "comm.h"
#include "fix.h"
#include "force.h"
#include "math_extra.h"
#include "modify.h"
#include "pair_hybrid.h"

#include <algorithm>
#include <cmath>
#include <unordered_set>

using namespace LAMMPS_NS;

namespace {

// PairHybrid shows its sub-styles to derived classes only
struct SubStyles : PairHybrid {
  static std::vector<Pair *> of(Pair *pair)
  {
    auto *hybrid = dynamic_cast<PairHybrid *>(pair);
    if (!hybrid) return {pair};
    Pair **first = hybrid->*(&SubStyles::styles);
    return std::vector<Pair *>(first, first + hybrid->*(&SubStyles::nstyles));
  }
};

// what the pair styles that keep contacts have under a name
template <class What> std::vector<const What *> extract_all(Pair *pair, const char *name)
{
  std::vector<const What *> lists;
  if (!pair) return lists;
  for (auto *style : SubStyles::of(pair)) {
    int dim;
    const void *list = style->extract(name, dim);
    if (list) lists.push_back(static_cast<const What *>(list));
  }
  return lists;
}

std::vector<const apf::ContactList *> contact_lists(Pair *pair)
{
  return extract_all<apf::ContactList>(pair, "contact_list");
}

}    // namespace

/* ---------------------------------------------------------------------- */

bool ComputeAggregateContact::keeps_contacts(Pair *pair)
{
  return !contact_lists(pair).empty();
}

// Contacts know atoms by their numbers. Between runs commands may give atoms and ghosts others; the
// pairs of the lists are then not as far apart as these say. Collective.
bool ComputeAggregateContact::atoms_have_changed() const
{
  constexpr double rounding = 1.0e-6;
  const int n = atom->nlocal + atom->nghost;
  int changed = 0;
  auto look_at = [&](int i, int j, double gap) {
    changed = changed || i >= n || j >= n;
    if (changed) return;
    double d[3];
    MathExtra::sub3(atom->x[j], atom->x[i], d);
    const double reach = atom->radius[i] + atom->radius[j];
    changed = std::fabs(MathExtra::len3(d) - reach - gap) > rounding * reach;
  };
  for (const auto *list : contact_lists(force->pair))
    for (int k = 0; k < list->size(); k++) look_at(list->i[k], list->j[k], -list->overlap(k));
  for (const auto *list : extract_all<apf::BridgeList>(force->pair, "bridge_list"))
    for (int k = 0; k < list->size(); k++) look_at(list->i[k], list->j[k], list->gap(k));
  MPI_Allreduce(MPI_IN_PLACE, &changed, 1, MPI_INT, MPI_MAX, world);
  return changed;
}

void ComputeAggregateContact::gather_contacts()
{
  contacts.clear();
  n_pair_contacts.assign(label.size(), 0);
  n_bridges.assign(label.size(), 0);
  liquid.assign(label.size(), 0.0);
  for (const auto *on_atoms : extract_all<double>(force->pair, "liquid"))
    for (int i = 0; i < atom->nlocal; i++) liquid[i] += on_atoms[i];
  std::unordered_set<bigint> touching;    // pairs of atoms
  const auto bridges = extract_all<apf::BridgeList>(force->pair, "bridge_list");
  auto bind = [this](int i, int j) {
    contacts.push_back({i, j, i});
    n_pair_contacts[i]++;
    n_pair_contacts[j]++;
  };
  auto pair_of = [](int i, int j) {
    return static_cast<bigint>(std::min(i, j)) << 32 | std::max(i, j);
  };
  for (const auto *list : contact_lists(force->pair)) {
    for (int k = 0; k < list->size(); k++) {
      const int i = list->i[k], j = list->j[k];
      if (!label[i] || !label[j] || list->ended(k)) continue;
      bind(i, j);
      if (!bridges.empty()) touching.insert(pair_of(i, j));
    }
  }
  for (const auto *list : bridges)
    for (int k = 0; k < list->size(); k++) {
      const int i = list->i[k], j = list->j[k];
      liquid[i] += list->memory(k).volume_i;
      liquid[j] += list->memory(k).volume_j;
      if (!label[i] || !label[j]) continue;
      if (!touching.count(pair_of(i, j))) bind(i, j);
      n_bridges[i]++;
      n_bridges[j]++;
    }

  // newton off: the owner of a ghost has the contact as well and has counted it
  if (!force->newton_pair) return;
  reverse = CONTACTS;
  comm->reverse_comm(this, 3);
}

void ComputeAggregateContact::gather_wall_contacts()
{
  const int nlocal = atom->nlocal;
  n_wall_contacts.assign(nlocal, 0);
  for (auto *fix : modify->get_fix_list()) {
    int dim;
    const auto *of_fix = static_cast<const int *>(fix->extract("wall_contacts", dim));
    if (!of_fix) continue;
    for (int i = 0; i < nlocal; i++)
      if (label[i]) n_wall_contacts[i] += of_fix[i];
    const auto *bridges = static_cast<const int *>(fix->extract("wall_bridges", dim));
    const auto *held = static_cast<const double *>(fix->extract("wall_liquid", dim));
    for (int i = 0; bridges && i < nlocal; i++)
      if (label[i]) {
        n_bridges[i] += bridges[i];
        liquid[i] += held[i];
      }
  }
}
