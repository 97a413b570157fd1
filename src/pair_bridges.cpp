#include "pair_bridges.h"

#include "atom.h"
#include "box_images.h"
#include "domain.h"
#include "fix_contact_history.h"
#include "force.h"
#include "pair_granular_adhesive.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void PairBridges::init()
{
  list.kinds.forget();
  choice = apf::BridgeChoice();
  choice.planar = domain->dimension == 2;
}

void PairBridges::include(const apf::BridgeModel &model)
{
  choice.include(model);
  kernel = apf::bridge_kernel(choice);
}

/* ---------------------------------------------------------------------- */

void PairBridges::begin_list()
{
  list.clear();
  meetings.clear();
  unsettled.clear();
}

void PairBridges::add_candidate(int i, int j, const NearestImages &images)
{
  const int k = meetings.add(i, j, forming_distance(i, j));
  unsettled.push_back(0);
  const auto memory = store->find_bridge(i, atom->tag[j]);
  if (!memory || !pair->coeff_of(i, j).bridge.present()) return;
  if (!images.nearest(atom->x[i], atom->x[j])) return;
  list.add(i, j, k, number_of_kind(i, j), *memory, false);
  meetings.closed[k] = 1;
  store->count_anew();
}

// of the centres, at which a bridge forms; 0 where none does. Films may be thicker than their
// bridge would hold: it forms where it does.
double PairBridges::forming_distance(int i, int j) const
{
  const auto &model = pair->coeff_of(i, j).bridge;
  if (!model.present()) return 0.0;
  const double ri = atom->radius[i], rj = atom->radius[j];
  if (model.forming == apf::Forming::contact) return ri + rj;
  auto film = [&](int of, double r) {
    return apf::film_thickness(r, model.inventory() ? store->liquid(of) : model.liquid_of(r));
  };
  const double hold = model.rupture_at_rest(intake(i, j).volume());
  return ri + rj + std::min(film(i, ri) + film(j, rj), hold);
}

int PairBridges::number_of_kind(int i, int j)
{
  const auto &coeff = pair->coeff_of(i, j);
  return list.kinds.find(pair->law_of(i, j), apf::WetContact{coeff.bridge, coeff.model},
                         pair->bodies_of_bridge(i, j, 1.0, 1.0));
}

/* ---------------------------------------------------------------------- */

void PairBridges::detect(bool all, double step)
{
  store->bodies().with_rows([&](const auto *rows) {
    auto joins = [&](int k) {
      form(k, apf::Approach::of(rows[meetings.i[k]], rows[meetings.j[k]], meetings.touch[k]), step);
    };
    if (all)
      meetings.detect(rows, joins);
    else
      meetings.detect_near(rows, joins);
  });
}

// approach.gap: to the distance at which the bridge forms
void PairBridges::form(int k, const apf::Approach &approach, double step)
{
  const int i = meetings.i[k], j = meetings.j[k];
  auto memory = intake(i, j);
  if (memory.volume() == 0.0) return;    // dry particles
  const double moved = step * approach.closing_speed;
  const double gap = meetings.touch[k] - atom->radius[i] - atom->radius[j];
  if (moved > 0.0 && -approach.gap <= moved) memory.formed = gap;    // else it was there before
  if (pair->coeff_of(i, j).bridge.inventory()) {
    store->take_liquid(i, memory.volume_i);
    store->take_liquid(j, memory.volume_j);
    unsettled[k] = 1;
  }
  const int added = list.add(i, j, k, number_of_kind(i, j), memory, true);
  list.set_mass(added, mass_left(i, j, store->count(i) + 1.0, store->count(j) + 1.0));
  meetings.closed[k] = 1;
  store->bodies().touch(i);
  store->bodies().touch(j);
  store->count_anew();
}

// liquid that a new bridge gets from its two particles
apf::BridgeMemory PairBridges::intake(int i, int j) const
{
  const auto &model = pair->coeff_of(i, j).bridge;
  const double smaller = std::min(atom->radius[i], atom->radius[j]);
  apf::BridgeMemory memory;
  if (!model.inventory()) {
    memory.volume_i = memory.volume_j = 0.5 * model.volume(smaller);
    return memory;
  }
  memory.volume_i = model.intake * store->liquid(i);
  memory.volume_j = model.intake * store->liquid(j);
  const double share = std::min(1.0, model.largest_volume(smaller) / memory.volume());
  if (share < 1.0) {
    memory.volume_i *= share;
    memory.volume_j *= share;
  }
  return memory;
}

/* ---------------------------------------------------------------------- */

int PairBridges::add_forces(apf::Bodies &bodies, const apf::ContactTimes &times,
                            apf::BridgeParts *to)
{
  for (int b = 0; b < list.size(); b++) list.set_touching(b, pair->is_closed(list.source[b]));
  return apf::add_bridge_forces(kernel, list, bodies, times, store->due, to);
}

void PairBridges::remove_ruptured(bool in_sub_step)
{
  for (int b = list.size() - 1; b >= 0; b--) {
    if (!list.ended(b)) continue;
    const int k = list.source[b], i = list.i[b], j = list.j[b];
    const auto &model = pair->coeff_of(i, j).bridge;
    if (model.inventory()) {
      const auto &memory = list.memory(b);
      if (unsettled[k]) {    // it takes what it asked for; settle() will not see it any more
        store->give_liquid(i, -memory.volume_i);
        store->give_liquid(j, -memory.volume_j);
        store->take_liquid(i, -memory.volume_i);
        store->take_liquid(j, -memory.volume_j);
        unsettled[k] = 0;
      }
      const bool even = model.sharing == apf::Sharing::even;
      store->give_liquid(i, even ? 0.5 * memory.volume() : memory.volume_i);
      store->give_liquid(j, even ? 0.5 * memory.volume() : memory.volume_j);
    }
    meetings.closed[k] = 0;
    if (in_sub_step) meetings.near.push_back(k);
    store->count_anew();
    list.remove(b);
  }
}

// The masses of particles are shared by all their contacts and bridges, zi and zj of them.
double PairBridges::mass_left(int i, int j, double zi, double zj) const
{
  const auto bodies = pair->bodies_of_bridge(i, j, zi, zj);
  return bodies.m / bodies.crowding;
}

void PairBridges::share_masses()
{
  for (int b = 0; b < list.size(); b++) {
    const int i = list.i[b], j = list.j[b];
    list.set_mass(b, mass_left(i, j, store->count(i), store->count(j)));
  }
}

/* ----------------------------------------------------------------------
   sub-steps of a particle step: bodies joined by a bridge take part in them
------------------------------------------------------------------------- */

void PairBridges::find_fastest(apf::LookAhead &ahead)
{
  store->bodies().with_rows([&](const auto *rows) {
    const double most = list.fastest(rows, update->dt, [&](int b) {
      return ahead.acceleration[list.i[b]] + ahead.acceleration[list.j[b]];
    });
    ahead.may_move(most, most);
  });
}

// A bridge may pull its bodies into contact: they are near touch, too.
void PairBridges::find_approaching(apf::LookAhead &ahead, std::vector<int> &near_touch)
{
  store->bodies().with_rows([&](const auto *rows) {
    meetings.find_approaching(rows, ahead);
    for (int b = 0; b < list.size(); b++) {
      const int i = list.i[b], j = list.j[b], k = list.source[b];
      const auto approach = apf::Approach::of(rows[i], rows[j], 0.0);
      ahead.meet(i, approach.relative_speed, ahead.speed_of(rows, i));
      ahead.meet(j, approach.relative_speed, ahead.speed_of(rows, j));
      if (!pair->is_closed(k)) near_touch.push_back(k);
    }
  });
}

void PairBridges::find_stiffest(apf::Stiffest &stiffest)
{
  store->bodies().with_rows([&](const auto *rows) {
    list.find_stiffest(rows, stiffest);
    for (const int k : meetings.near) {
      const int i = meetings.i[k], j = meetings.j[k];
      const double volume = intake(i, j).volume();
      if (volume == 0.0) continue;
      const auto mode = apf::capillary_mode(list.constants(number_of_kind(i, j), volume));
      stiffest.include_near(mode, apf::Approach::of(rows[i], rows[j], meetings.touch[k]),
                            stiffest.acceleration[i] + stiffest.acceleration[j]);
    }
  });
}

/* ----------------------------------------------------------------------
   liquid
------------------------------------------------------------------------- */

// Films have become thicker or thinner, and bridges that took too much get less.
void PairBridges::settle()
{
  for (int b = 0; b < list.size(); b++) {
    const int k = list.source[b], i = list.i[b], j = list.j[b];
    if (!unsettled[k]) continue;
    unsettled[k] = 0;
    const double share_i = store->granted(i), share_j = store->granted(j);
    if (share_i == 1.0 && share_j == 1.0) continue;
    auto memory = list.memory(b);
    memory.volume_i *= share_i;
    memory.volume_j *= share_j;
    list.refill(b, memory);
  }
  for (int k = 0; k < meetings.size(); k++)
    meetings.touch[k] = forming_distance(meetings.i[k], meetings.j[k]);
}

void PairBridges::fill_new_atoms()
{
  if (!store->keeps_liquid()) return;
  for (int i = 0; i < atom->nlocal; i++)
    store->begin_liquid(i, pair->coeff_of(i, i).bridge.liquid_of(atom->radius[i]));
}

/* ----------------------------------------------------------------------
   output
------------------------------------------------------------------------- */

void PairBridges::evaluate(const apf::ContactTimes &times)
{
  parts.resize(list.size());
  auto bodies = store->bodies();    // a copy: loads stay as they are
  add_forces(bodies, times, parts.data());
  number_of.number(list);
}
