#include "wall_bridges.h"

#include "argument_reader.h"
#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "fix_wall_levelset.h"
#include "math_extra.h"
#include "modify.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

WallBridges::WallBridges(LAMMPS *lmp, FixWallLevelset *fix) :
    Pointers(lmp), wall(fix), rows(domain->dimension == 2)
{
}

void WallBridges::parse_film(const char *command, int narg, char **arg, int &iarg)
{
  if (narg < iarg + 2) utils::missing_cmd_args(FLERR, "fix wall/levelset film", error);
  first_film = ArgumentReader(lmp, command, arg).number(iarg + 1, "film");
  const double most = std::max(std::max(domain->prd[0], domain->prd[1]), domain->prd[2]);
  if (!(first_film >= 0.0 && first_film <= most))
    error->all(FLERR, iarg + 1,
               "{} film must be in [0, {:.4g}], the longest side of the box, got {}", command, most,
               arg[iarg + 1]);
  if (!wall->coefficient.bridge.inventory())
    error->all(FLERR, iarg, "{} film needs a law with keyword inventory", command);
  if (domain->dimension == 2)
    error->all(FLERR, iarg,
               "{} film is for three dimensions: a wall in the plane has a length, of which a "
               "thickness makes no volume",
               command);
  iarg += 2;
}

void WallBridges::init()
{
  const auto &model = wall->coefficient.bridge;
  apf::BridgeChoice choice;
  choice.planar = rows.planar();
  choice.include(model);
  kernel = apf::bridge_kernel(choice);
  frozen_bits = frozen_groups(lmp);
  check_inventory();
}

// Liquid is either of the bodies, everywhere, or made and lost with bridges, everywhere.
void WallBridges::check_inventory() const
{
  const bool wanted = wall->coefficient.bridge.inventory();
  const FixContactHistory *keeper = nullptr;
  for (const auto &fix : modify->get_fix_by_style("^contact/history")) {
    const auto *history = dynamic_cast<FixContactHistory *>(fix);
    if (history->keeps_liquid()) keeper = history;
  }
  if (wanted && !keeper)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix wall/levelset {} keyword inventory needs a pair style granular/adhesive with "
               "keyword inventory, which keeps the liquid of the particles",
               wall->id);
  if (keeper && !wanted)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix wall/levelset {} keyword bridge needs keyword inventory, as the pair style has "
               "it: else the liquid of the bridges would come from nowhere",
               wall->id);
  if (wanted && keeper != wall->lender)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix wall/levelset {} keyword inventory needs the level of run_style respa of the "
               "pair style, which keeps the liquid: remove fix_modify respa",
               wall->id);
}

/* ---------------------------------------------------------------------- */

void WallBridges::find_again()
{
  list.clear();
  surface_of.clear();
  unsettled.clear();
  joined.assign(atom->nmax, 0);
  for (int i = 0; i < atom->nlocal; i++)
    for (int s = 0; s < static_cast<int>(wall->surfaces.size()); s++)
      if (const auto memory = wall->store.bridges.find(i, s)) add(i, s, *memory, false);
}

void WallBridges::store_into(ContactStore &store) const
{
  for (int b = 0; b < size(); b++) store.bridges.add(list.source[b], surface_of[b], list.memory(b));
}

void WallBridges::add_counts(double *counts) const
{
  for (const int i : list.source) counts[i] += 1.0;
}

double WallBridges::count(int i) const
{
  double n = 0.0;
  for (unsigned bits = i < static_cast<int>(joined.size()) ? joined[i] : 0; bits; bits >>= 1)
    n += bits & 1;
  return n;
}

/* ---------------------------------------------------------------------- */

void WallBridges::measure_films()
{
  if (first_film < 0.0) return;
  wall->ledger.begin_films(first_film);
  films = wall->ledger.films();
  thickest_film = *std::max_element(films.begin(), films.end());
}

double WallBridges::film_at(int i, int surface) const
{
  return films.empty() ? 0.0 : films[wall->zone_of(i, surface)];
}

// Liquid that a new bridge gets: of the particle's, and of the film under the particle.
apf::BridgeMemory WallBridges::intake(int i, double film) const
{
  const auto &model = wall->coefficient.bridge;
  const double r = atom->radius[i];
  apf::BridgeMemory memory;
  if (!model.inventory()) {
    memory.volume_i = model.volume(r);
    return memory;
  }
  memory.volume_i = model.intake * wall->lender->liquid(i);
  memory.volume_j = model.intake * film * apf::pi * r * r;
  const double share = std::min(1.0, model.largest_volume(r) / memory.volume());
  if (share < 1.0) {
    memory.volume_i *= share;
    memory.volume_j *= share;
  }
  return memory;
}

// Films may be thicker than their bridge would hold: it forms where it does.
double WallBridges::forming_distance(int i, double film) const
{
  const auto &model = wall->coefficient.bridge;
  const double r = atom->radius[i];
  if (model.forming == apf::Forming::contact) return r;
  const double own = model.inventory() ? wall->lender->liquid(i) : model.liquid_of(r);
  const double hold = model.rupture_at_rest(intake(i, film).volume());
  return r + std::min(film + apf::film_thickness(r, own), hold);
}

int WallBridges::number_of_kind(int i, int surface)
{
  const auto &law = wall->coefficient;
  auto bodies = wall->bodies_of(i, surface, atom->x[i]);
  if (atom->mask[i] & frozen_bits) bodies.m *= immovable;
  return list.kinds.find(surface, apf::WetContact{law.bridge, law.model}, bodies);
}

void WallBridges::add(int i, int surface, const apf::BridgeMemory &memory, bool is_new)
{
  const int b = list.add(0, 0, i, number_of_kind(i, surface), memory, is_new);
  surface_of.push_back(surface);
  unsettled.push_back(is_new && wall->coefficient.bridge.inventory());
  joined[i] |= 1u << surface;
  list.set_mass(b, list.mass_alone(b) / (wall->crowding(i) + 1.0));
  wall->count_anew();
}

void WallBridges::try_to_form(int i, int surface, double step)
{
  if (joined[i] >> surface & 1) return;
  double x[3];
  wall->particles().position(i, x);
  const auto foot = wall->foot_of(surface, x);
  if (foot.distance > forming_distance(i, thickest_film)) return;
  const double film = film_at(i, surface), at = forming_distance(i, film);
  auto memory = intake(i, film);
  if (foot.distance > at || memory.volume() == 0.0) return;
  const double moved = step * wall->approach_of(i, foot).closing_speed;
  if (moved > 0.0 && at - foot.distance <= moved) memory.formed = at - atom->radius[i];
  if (wall->coefficient.bridge.inventory()) {
    wall->lender->take_liquid(i, memory.volume_i);
    if (memory.volume_j > 0.0) wall->ledger.liquid[wall->zone_of(i, surface)] -= memory.volume_j;
  }
  add(i, surface, memory, true);
}

void WallBridges::detect(double step)
{
  joined.resize(atom->nmax, 0);
  for (int s = 0; s < static_cast<int>(wall->surfaces.size()); s++)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & wall->groupbit &&
          !wall->farther(s, atom->x[i], forming_distance(i, thickest_film)))
        try_to_form(i, s, step);
}

void WallBridges::sub_detect(double step)
{
  for (const auto &place : near) try_to_form(place.i, place.surface, step);
}

/* ---------------------------------------------------------------------- */

void WallBridges::gather()
{
  rows.resize(2 * size());
  for (int b = 0; b < size(); b++) {
    list.i[b] = 2 * b;
    list.j[b] = 2 * b + 1;
    wall->copy_rows(rows, b, list.source[b], surface_of[b]);
  }
  rows.clear_loads(0, 2 * size());
}

int WallBridges::add_forces(const apf::ContactTimes &times, std::vector<apf::DueLoad> &due)
{
  gather();
  for (int b = 0; b < size(); b++)
    list.set_touching(b, wall->touched[list.source[b]] >> surface_of[b] & 1);
  std::vector<apf::DueLoad> of_rows;
  const int ended = apf::add_bridge_forces(kernel, list, rows, times, of_rows);
  for (const auto &load : of_rows)
    if (load.row % 2 == 0)
      due.push_back({list.source[load.row / 2], {load.f[0], load.f[1], load.f[2]}});
  return ended;
}

void WallBridges::remove_ruptured(bool in_sub_step)
{
  const auto &model = wall->coefficient.bridge;
  for (int b = size() - 1; b >= 0; b--) {
    if (!list.ended(b)) continue;
    const int i = list.source[b];
    if (model.inventory()) {
      const auto &memory = list.memory(b);
      if (unsettled[b]) {    // takes what it asked for; settle() will not see it any more
        wall->lender->give_liquid(i, -memory.volume_i);
        wall->lender->take_liquid(i, -memory.volume_i);
      }
      const double left = model.sharing == apf::Sharing::even ? 0.5 * memory.volume()
                                                              : memory.volume_j;
      wall->lender->give_liquid(i, memory.volume() - left);
      if (left > 0.0) wall->ledger.liquid[wall->zone_of(i, surface_of[b])] += left;
    }
    if (in_sub_step) near.push_back({i, surface_of[b], 0.0});
    joined[i] &= ~(1u << surface_of[b]);
    list.remove(b);
    surface_of[b] = surface_of.back();
    surface_of.pop_back();
    unsettled[b] = unsettled.back();
    unsettled.pop_back();
    wall->count_anew();
  }
}

void WallBridges::share_masses()
{
  for (int b = 0; b < size(); b++)
    list.set_mass(b, list.mass_alone(b) / wall->crowding(list.source[b]));
}

WallBridges::Loads WallBridges::loads()
{
  gather();
  std::vector<apf::BridgeParts> parts(size());
  kernel(list, rows, wall->lender ? wall->lender->last_times() : wall->last_times(), parts.data());
  Loads sum{};
  for (int b = 0; b < size(); b++) {
    double x[3], foot[3], normal[3];
    rows.position(list.i[b], x);
    rows.position(list.j[b], foot);
    MathExtra::sub3(foot, x, normal);
    MathExtra::norm3(normal);
    for (int c = 0; c < 3; c++) {
      const double pull = -parts[b].capillary * normal[c];
      sum.capillary[c] += pull;
      sum.viscous[c] -= parts[b].force[c] + pull;
    }
    sum.energy += parts[b].energy;
  }
  return sum;
}

double WallBridges::liquid_held() const
{
  double sum = 0.0;
  for (int b = 0; b < size(); b++) sum += list.memory(b).volume();
  return sum;
}

double WallBridges::liquid_from_wall() const
{
  double sum = 0.0;
  for (int b = 0; b < size(); b++) sum += list.memory(b).volume_j;
  return sum;
}

/* ---------------------------------------------------------------------- */

void WallBridges::find_fastest(apf::LookAhead &ahead)
{
  gather();
  rows.with_rows([&](const auto *r) {
    const double most = list.fastest(r, update->dt, [&](int b) {
      return ahead.acceleration[list.source[b]];
    });
    ahead.may_move(most, most);
  });
}

void WallBridges::find_approaching(apf::LookAhead &ahead)
{
  near.clear();
  perhaps.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & wall->groupbit)) continue;
    const double *x = atom->x[i];
    const double at = forming_distance(i, thickest_film), beyond = at - atom->radius[i];
    const double farthest = ahead.farthest() + ahead.reach * wall->speed_near(x);
    for (int s = 0; s < static_cast<int>(wall->surfaces.size()); s++) {
      const bool bridged = joined[i] >> s & 1;
      if (!bridged && wall->farther(s, x, farthest + at)) continue;
      const auto approach = wall->approach_of(i, wall->foot_of(s, x));
      const Place place{i, s, approach.gap - beyond};
      if (bridged) {
        ahead.meet(i, approach.relative_speed, wall->speed_of(i, ahead));
        if (!(wall->touched[i] >> s & 1)) wall->near.push_back({i, s});    // it pulls
      } else if (place.gap <= ahead.distance(approach.closing_speed)) {
        ahead.meet(i, approach.relative_speed, wall->speed_of(i, ahead));
        near.push_back(place);
        ahead.approach({place.gap, approach.closing_speed, approach.relative_speed});
      } else if (place.gap <= farthest) {
        perhaps.push_back(place);
      }
    }
  }
}

void WallBridges::find_near(const apf::LookAhead &ahead)
{
  size_t left = 0;
  for (const auto &place : perhaps) {
    if (ahead.free(place.i) ||
        place.gap > ahead.distance_if_struck(ahead.after_impacts(), ahead.walls))
      perhaps[left++] = place;
    else
      near.push_back(place);
  }
  perhaps.resize(left);
}

void WallBridges::find_stiffest(apf::Stiffest &stiffest)
{
  gather();
  rows.with_rows([&](const auto *r) {
    list.find_stiffest(r, stiffest);
  });
  for (const auto &place : near) {
    const double volume = intake(place.i, film_at(place.i, place.surface)).volume();
    if (volume == 0.0) continue;
    const int kind = number_of_kind(place.i, place.surface);
    const auto mode = apf::capillary_mode(list.constants(kind, volume));
    auto approach = wall->approach_of(place.i, wall->foot_of(place.surface, atom->x[place.i]));
    approach.gap = place.gap;
    stiffest.include_near(mode, approach, stiffest.acceleration[place.i]);
  }
}

void WallBridges::settle()
{
  for (int b = 0; b < size(); b++) {
    if (!unsettled[b]) continue;
    unsettled[b] = 0;
    auto memory = list.memory(b);
    memory.volume_i *= wall->lender->granted(list.source[b]);
    list.refill(b, memory);
  }
}

/* ---------------------------------------------------------------------- */

int *WallBridges::counts_of_atoms()
{
  counts.assign(atom->nmax, 0);
  for (const int i : list.source) counts[i]++;
  return counts.data();
}

double *WallBridges::liquid_of_atoms()
{
  volumes.assign(atom->nmax, 0.0);
  for (int b = 0; b < size(); b++) volumes[list.source[b]] += list.memory(b).volume_i;
  return volumes.data();
}

void WallBridges::count_where_dry_contact_is_not(std::vector<int> &of_atoms) const
{
  for (int b = 0; b < size(); b++) {
    const int i = list.source[b];
    if (!(wall->touched[i] >> surface_of[b] & 1)) of_atoms[i]++;
  }
}
