#include "fix_contact_history.h"

#include "atom.h"
#include "box_images.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "force.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_granular_adhesive.h"
#include "particle_checks.h"
#include "respa.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixContactHistory::FixContactHistory(LAMMPS *lmp, int narg, char **arg) :
    FixContacts(lmp, narg, arg)
{
  if (narg != 3) error->all(FLERR, 3, "Fix contact/history takes no arguments, got {}", arg[3]);
  comm_forward = 6;
  comm_reverse = 1 + PartnerRecords<apf::ContactHistory>::record_size;
  register_with_atoms();
}

int FixContactHistory::setmask()
{
  return FixContacts::setmask() | PRE_NEIGHBOR | MIN_PRE_NEIGHBOR | INITIAL_INTEGRATE_RESPA;
}

/* ---------------------------------------------------------------------- */

void FixContactHistory::init()
{
  FixContacts::init();
  if (!pair)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix contact/history is internal to pair style granular/adhesive: use that instead");
  check_diameters(lmp, "Pair granular/adhesive");
  const auto *respa = dynamic_cast<Respa *>(update->integrate);
  outermost = respa ? respa->nlevels - 1 : -1;
  force_reneighbor = respa ? 1 : 0;
  next_reneighbor = -1;
  if (respa && respa->level_pair < 0)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair granular/adhesive acts on one level of run_style respa: use keyword pair, not "
               "inner, middle, outer or hybrid");

  // histories must stand with their atoms before another fix moves these to other ranks
  for (const auto &fix : modify->get_fix_list()) {
    if (fix == this) break;
    if (fix->pre_exchange_migrate)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair style granular/adhesive must be defined before fix {} {}, which moves atoms "
                 "between ranks",
                 fix->id, fix->style);
  }
}

/* ---------------------------------------------------------------------- */

int FixContactHistory::level() const
{
  return dynamic_cast<Respa *>(update->integrate)->level_pair;
}

void FixContactHistory::initial_integrate_respa(int /*vflag*/, int ilevel, int /*iloop*/)
{
  if (ilevel == outermost &&
      lists.too_old_for_step(level() < outermost, velocities.bodies, keepers))
    next_reneighbor = update->ntimestep;
}

bool FixContactHistory::stores_alone() const
{
  return !force->newton_pair;
}

void FixContactHistory::share_velocities()
{
  comm->forward_comm(this);
}

/* ----------------------------------------------------------------------
   sub-steps: the pair style has the contacts
------------------------------------------------------------------------- */

bool FixContactHistory::slides() const
{
  return pair->slides();
}

void FixContactHistory::find_fastest(apf::LookAhead &ahead)
{
  pair->find_fastest(ahead);
}

void FixContactHistory::find_approaching(apf::LookAhead &ahead)
{
  pair->find_approaching(ahead);
}

bool FixContactHistory::find_near(apf::LookAhead &ahead)
{
  return pair->find_near(ahead);
}

void FixContactHistory::find_stiffest(apf::Stiffest &stiffest)
{
  pair->find_stiffest(stiffest);
}

void FixContactHistory::settle_bridges()
{
  pair->settle_bridges();
}

void FixContactHistory::sub_step(const apf::ContactTimes &times)
{
  contacts_change();
  pair->sub_step(times);
}

/* ----------------------------------------------------------------------
   liquid: what ranks took and gave goes to the owners, who tell how much there is now
------------------------------------------------------------------------- */

void FixContactHistory::begin_liquid(int i, double volume)
{
  if (std::isnan(store.liquid[i])) store.liquid[i] = volume;
}

void FixContactHistory::settle_liquid()
{
  if (!keeps_liquid()) return;
  int moved = liquid_moved;
  MPI_Allreduce(MPI_IN_PLACE, &moved, 1, MPI_INT, MPI_MAX, world);
  if (!moved) return;
  const int nlocal = atom->nlocal;
  accounts.resize(2 * store.liquid.size(), 0.0);
  give_to_owners(accounts, 2);
  settled.assign(accounts.size(), 1.0);
  for (int i = 0; i < nlocal; i++) {
    const double taken = accounts[2 * i], there = store.liquid[i] + accounts[2 * i + 1];
    if (taken > 0.0) settled[2 * i + 1] = std::min(1.0, std::max(0.0, there) / taken);
    store.liquid[i] = there - settled[2 * i + 1] * taken;
  }
  tell_ghosts();
  for (auto *keeper : all_of(modify)) keeper->settle_bridges();    // also between runs
  accounts.clear();
  liquid_moved = false;
}

// Bridges whose particles a command has deleted, moved apart, or given types without bridges: what
// is left gets its own share back. By distance, as the neighbour list does, since only one of the
// two owners has the pair in its list.
void FixContactHistory::end_lost_bridges()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  std::unordered_multimap<tagint, int> images;
  for (int i = 0; i < nall; i++) images.emplace(atom->tag[i], i);
  const double reach = pair->longest_reach() + neighbor->skin;
  auto together = [&](int i, int j) {
    double d[3];
    MathExtra::sub3(atom->x[i], atom->x[j], d);
    return pair->coeff_of_types(atom->type[i], atom->type[j]).bridge.present() &&
        MathExtra::len3(d) < atom->radius[i] + atom->radius[j] + reach;
  };
  for (int i = 0; i < nlocal; i++)
    store.bridges.keep_if(i, [&](tagint partner, const apf::BridgeMemory &memory) {
      const auto [first, last] = images.equal_range(partner);
      const bool kept = std::any_of(first, last, [&](const auto &image) {
        return together(i, image.second);
      });
      if (!kept) store.liquid[i] += memory.volume_i;
      return kept;
    });
}

void FixContactHistory::share_liquid()
{
  if (!keeps_liquid()) return;
  settled.assign(2 * store.liquid.size(), 1.0);
  tell_ghosts();
}

void FixContactHistory::tell_ghosts()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  for (int i = 0; i < nlocal; i++) settled[2 * i] = store.liquid[i];
  carried = &settled;
  columns = 2;
  comm->forward_comm(this, 2);
  carried = nullptr;
  for (int i = nlocal; i < nall; i++) store.liquid[i] = settled[2 * i];
}

double FixContactHistory::contacts_here() const
{
  const auto &contacts = pair->closed_contacts();
  if (force->newton_pair) return contacts.size();
  double n = 0.0;
  for (const int j : contacts.j) n += j < atom->nlocal ? 1.0 : 0.5;
  return n;
}

double FixContactHistory::longest_neck() const
{
  return pair->longest_neck();
}

apf::StiffestMode FixContactHistory::stiffest_possible() const
{
  return pair->stiffest_possible();
}

/* ----------------------------------------------------------------------
   contacts of each atom, which share its mass between their dashpots; counted from what is closed
   now, so that neither ranks nor rebuilds of the neighbour list matter
------------------------------------------------------------------------- */

bool FixContactHistory::count_contacts()
{
  bigint changed = 0;
  for (const auto *keeper : keepers) changed += keeper->changes_so_far();
  int recount = changed != changes_counted;
  changes_counted = changed;
  if (comm->nprocs > 1) MPI_Allreduce(MPI_IN_PLACE, &recount, 1, MPI_INT, MPI_MAX, world);
  if (!recount) return false;
  times_counted++;

  counts.assign(atom->nmax, 0.0);
  add_counts(counts.data());
  if (force->newton_pair) give_to_owners(counts, 1);
  pair_counts.assign(counts.begin(), counts.begin() + atom->nlocal);
  for (auto *keeper : keepers)
    if (keeper != this) keeper->count_into(counts.data());
  carried = &counts;
  columns = 1;
  comm->forward_comm(this, 1);
  carried = nullptr;
  return true;
}

// what ghosts have is added to what their owners have
void FixContactHistory::give_to_owners(std::vector<double> &numbers, int of_each)
{
  carried = &numbers;
  columns = of_each;
  comm->reverse_comm(this, columns);
  carried = nullptr;
}

void FixContactHistory::collect_due(std::vector<double> &loads)
{
  if (force->newton_pair) give_to_owners(loads, 3);
}

void FixContactHistory::add_counts(double *to)
{
  const auto &contacts = pair->closed_contacts();
  for (int k = 0; k < contacts.size(); k++) {
    to[contacts.i[k]] += 1.0;
    if (contacts.j[k] < atom->nlocal || force->newton_pair) to[contacts.j[k]] += 1.0;
  }
  const auto *bridges = pair->liquid_bridges();
  for (int k = 0; bridges && k < bridges->size(); k++) {
    to[bridges->i[k]] += 1.0;
    if (bridges->j[k] < atom->nlocal || force->newton_pair) to[bridges->j[k]] += 1.0;
  }
}

// Ghosts of a sheared periodic box move relative to their owners, as CommBrick does it for v.
int FixContactHistory::pack_forward_comm(int n, int *list, double *buf, int pbc_flag, int *pbc)
{
  if (carried) {
    for (int k = 0; k < n; k++)
      buf = std::copy_n(carried->data() + columns * list[k], columns, buf);
    return columns * n;
  }
  double dv[3] = {0.0, 0.0, 0.0};
  if (pbc_flag && domain->deform_vremap) {
    dv[0] = pbc[0] * domain->h_rate[0] + pbc[5] * domain->h_rate[5] + pbc[4] * domain->h_rate[4];
    dv[1] = pbc[1] * domain->h_rate[1] + pbc[3] * domain->h_rate[3];
    dv[2] = pbc[2] * domain->h_rate[2];
  }
  for (int k = 0; k < n; k++, buf += 6) {
    const int i = list[k];
    velocities.bodies.motion(i, buf, buf + 3);
    if (domain->deform_vremap && (atom->mask[i] & domain->deform_groupbit))
      for (int c = 0; c < 3; c++) buf[c] += dv[c];
  }
  return 6 * n;
}

void FixContactHistory::unpack_forward_comm(int n, int first, double *buf)
{
  if (carried) {
    std::copy_n(buf, columns * n, carried->data() + columns * first);
    return;
  }
  for (int i = first; i < first + n; i++, buf += 6) velocities.bodies.set_motion(i, buf, buf + 3);
}

/* ----------------------------------------------------------------------
   the neighbour list compares distances with sums of radii: for the time of its build all particles
   are larger by half the longest neck or bridge, so that none is lost, whatever the skin
------------------------------------------------------------------------- */

void FixContactHistory::pre_neighbor()
{
  radius_growth = 0.5 * pair->longest_reach();
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) atom->radius[i] += radius_growth;
}

void FixContactHistory::post_neighbor()
{
  FixContacts::post_neighbor();
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) atom->radius[i] -= radius_growth;
  pair->list_was_built();
  if (outermost >= 0) lists.list_was_built();
}

double FixContactHistory::memory_usage()
{
  return FixContacts::memory_usage() + lists.memory_usage();
}

void FixContactHistory::before_storing()
{
  settle_liquid();
}

/* ----------------------------------------------------------------------
   each contact goes to both its atoms, also to those of other ranks
------------------------------------------------------------------------- */

void FixContactHistory::store_contacts()
{
  const auto &contacts = pair->closed_contacts();
  const tagint *tag = atom->tag;
  const int nlocal = atom->nlocal;
  const auto *bridges = pair->liquid_bridges();
  // about as many come from ghosts on other ranks as go there
  auto room = [&](const auto &list) {
    const auto shared = std::count_if(list.j.begin(), list.j.end(), [&](int j) {
      return j >= nlocal;
    });
    return list.size() + shared + shared / 4;
  };
  store.start(nlocal + atom->nghost, room(contacts), bridges ? room(*bridges) : 0, pair->planar());
  for (int i = 0; i < nlocal; i++) store.set_owner(i, tag[i]);
  auto keep = [&](auto &records, int i, int j, const auto &memory) {
    if (j < nlocal || force->newton_pair)
      records.add(i, j, tag[i], tag[j], memory);
    else
      records.add(i, tag[j], memory);
  };
  for (int k = 0; k < contacts.size(); k++)
    keep(store.contacts, contacts.i[k], contacts.j[k], contacts.history_of(k));
  if (force->newton_pair) send_to_owners(store.contacts);
  if (bridges) {
    for (int k = 0; k < bridges->size(); k++)
      keep(store.bridges, bridges->i[k], bridges->j[k], bridges->memory(k));
    if (force->newton_pair) send_to_owners(store.bridges);
  }
  check_images();
}

// A pair that is joined by two images at once would find one memory for both.
void FixContactHistory::check_images() const
{
  if (NearestImages(domain).width() > 2.0 * (neighbor->cutneighmax - neighbor->skin)) return;
  for (int i = 0; i < atom->nlocal; i++) {
    if (const tagint partner = store.contacts.repeated(i)) refuse_images(i, partner);
    if (const tagint partner = store.bridges.repeated(i))
      refuse_images(i, partner, "has liquid bridges with", " and bridges");
  }
}

void FixContactHistory::refuse_images(int i, tagint partner, const char *does,
                                      const char *wider) const
{
  error->one(
      FLERR, Error::NOLASTLINE,
      "Pair granular/adhesive: particle {} {} {} through two faces of the box at once: it is "
      "{:.6g} thick along a periodic axis, and must be thicker than two diameters{}",
      atom->tag[i], does, partner == atom->tag[i] ? "itself" : fmt::format("particle {}", partner),
      NearestImages(domain).width(), wider);
}

/* ----------------------------------------------------------------------
   delete_atoms and reset_atoms may have numbered atoms anew since the last run; new ones may have
   the IDs of those that were deleted
------------------------------------------------------------------------- */

void FixContactHistory::setup_pre_exchange()
{
  const tagint *tag = atom->tag;
  std::vector<tagint> mine;    // old ID, new ID
  int seen[2] = {0, 0};        // atoms that were here, and those that are new or have another ID
  for (int i = 0; i < atom->nlocal; i++) {
    const tagint old = store.owner(i);
    seen[old != tag[i]] = 1;
    if (old == 0) continue;
    seen[0] = 1;
    mine.push_back(old);
    mine.push_back(tag[i]);
  }
  MPI_Allreduce(MPI_IN_PLACE, seen, 2, MPI_INT, MPI_MAX, world);
  if (!seen[0] || !seen[1]) return;

  const int n = static_cast<int>(mine.size());
  std::vector<int> counts(comm->nprocs), starts(comm->nprocs, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, world);
  for (int p = 1; p < comm->nprocs; p++) starts[p] = starts[p - 1] + counts[p - 1];
  std::vector<tagint> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), n, MPI_LMP_TAGINT, all.data(), counts.data(), starts.data(),
                 MPI_LMP_TAGINT, world);
  std::unordered_map<tagint, tagint> new_id;
  for (size_t k = 0; k < all.size(); k += 2) new_id[all[k]] = all[k + 1];
  for (int i = 0; i < atom->nlocal; i++)
    if (store.owner(i) != 0) store.renumber(i, tag[i], new_id);
}

/* ----------------------------------------------------------------------
   what ghosts hold goes to their owners, a contact a ghost and round: messages of fixed size, which
   tiled decompositions need; a ghost that passes on another rank's contacts has more rounds to go
------------------------------------------------------------------------- */

template <class Records> void FixContactHistory::send_to_owners(Records &records)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  sending = std::is_same_v<Records, PartnerRecords<apf::BridgeMemory>> ? Sent::BRIDGES
                                                                       : Sent::CONTACTS;
  sent.assign(nall, 0);
  while (true) {
    int left = 0;
    for (int i = nlocal; i < nall; i++) left = MAX(left, records.count(i) - sent[i]);
    MPI_Allreduce(MPI_IN_PLACE, &left, 1, MPI_INT, MPI_MAX, world);
    if (left == 0) return;
    comm->reverse_comm(this);
  }
}

int FixContactHistory::pack_reverse_comm(int n, int first, double *buf)
{
  if (carried) {
    std::copy_n(carried->data() + columns * first, columns * n, buf);
    return columns * n;
  }
  auto pack = [&](const auto &records) {
    for (int k = 0; k < n; k++, buf += comm_reverse) {
      const int i = first + k;
      const bool some = sent[i] < records.count(i);
      buf[0] = some;
      if (some) records.pack_record(i, sent[i]++, buf + 1);
    }
  };
  if (sending == Sent::CONTACTS)
    pack(store.contacts);
  else
    pack(store.bridges);
  return n * comm_reverse;
}

void FixContactHistory::unpack_reverse_comm(int n, int *list, double *buf)
{
  if (carried) {
    for (int k = 0; k < n; k++)
      for (int c = 0; c < columns; c++) (*carried)[columns * list[k] + c] += *buf++;
    return;
  }
  for (int k = 0; k < n; k++, buf += comm_reverse) {
    if (buf[0] == 0.0) continue;
    if (sending == Sent::CONTACTS)
      store.contacts.unpack_record(list[k], buf + 1);
    else
      store.bridges.unpack_record(list[k], buf + 1);
  }
}
