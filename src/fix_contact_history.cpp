#include "fix_contact_history.h"

#include "atom.h"
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
