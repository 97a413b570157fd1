// Forces of contacts and bridges between particles, and which pairs are joined by them. What the
// script says is read in pair_granular_adhesive_input.cpp, output is made in _output.cpp.

#include "pair_granular_adhesive.h"

#include "atom.h"
#include "atom_rows.h"
#include "box_images.h"
#include "comm.h"
#include "contact/jump.h"
#include "fix_contact_history.h"
#include "force.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

PairGranularAdhesive::PairGranularAdhesive(LAMMPS *lmp) : Pair(lmp), bridges(lmp, this), guard(lmp)
{
  single_enable = 1;
  single_extra = n_parts;
  svector = new double[n_parts];
  nextra = n_energies;
  pvector = new double[n_energies];
  restartinfo = 1;
  writedata = 1;
  finitecutflag = 1;
  no_virial_fdotr_compute = 1;
  centroidstressflag = CENTROID_NOTAVAIL;
  comm_forward = 1;    // mass of rigid bodies

  // The fix that keeps histories must stand before fixes that add, delete or move atoms, yet it can
  // take them from a restart file only if it is made after the file is read: a placeholder keeps
  // its place until init_style(). Numbered within this LAMMPS, so that a restart finds the same ID.
  int n = 0;
  for (const auto &fix : modify->get_fix_list())
    if (utils::strmatch(fix->id, "^CONTACT_HISTORY_")) n++;
  id_store = fmt::format("CONTACT_HISTORY_{}", n);
  modify->add_fix(id_store + "_PLACE all DUMMY");
}

/* ---------------------------------------------------------------------- */

PairGranularAdhesive::~PairGranularAdhesive()
{
  delete[] svector;
  delete[] pvector;
  const std::string id_now = store ? id_store : id_store + "_PLACE";
  if (modify->get_fix_by_id(id_now)) modify->delete_fix(id_now);
  if (allocated) {
    memory->destroy(setflag);
    memory->destroy(cutsq);
  }
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::compute(int eflag, int vflag)
{
  guard.require(nullptr);
  ev_init(eflag, vflag);
  if (rebuild) {
    find_rigid_masses();
    build_candidates();
  }
  auto &bodies = store->bodies();
  const bool forgets = bodies.forgets_touched();
  const auto times = store->take_velocities();
  const double no_torque[3] = {};
  for (const auto &load : store->due) bodies.add_load(load.row, load.f, no_torque);
  if (wet) {
    store->settle_liquid();
    bridges.detect(true, times.advance);
  }
  // contacts open with first touch and end with the neck
  detect(true, times.advance);
  if (new_list && store->follows_given_steps()) check_passages();
  if (store->count_contacts()) share_masses();
  if (forgets) {
    auto touch_all = [&bodies](const auto &list) {
      for (const int i : list.i) bodies.touch(i);
      for (const int j : list.j) bodies.touch(j);
    };
    touch_all(contacts);
    touch_all(bridges.all());
  }

  const bool tallied = evflag != 0;
  if (tallied) std::fill(pvector, pvector + n_energies, 0.0);
  Tally tally(*this, eflag);
  const int ended = kernel(contacts, bodies, times, tallied ? &tally : nullptr);
  if (wet && tallied) bridges.parts.resize(bridges.all().size());
  const int ruptured =
      wet ? bridges.add_forces(bodies, times, tallied ? bridges.parts.data() : nullptr) : 0;

  // a ghost's force belongs to another rank, which has computed it as well where newton is off
  if (ended) correct_ends(times.advance);
  const int n = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  if (n) bodies.add_loads_to_all(n, rows_of(atom->f), rows_of(atom->torque));
  if (tallied && wet) tally_bridges(eflag);
  parts.of = std::vector<apf::ContactParts>();    // memory is for steps that look at them
  if (ended) remove_ended(false);
  if (ruptured) bridges.remove_ruptured(false);
  parts_step = -1;
}

/* ---------------------------------------------------------------------- */

// step: since positions were looked at before, 0 if they were not
void PairGranularAdhesive::detect(bool all, double step)
{
  store->bodies().with_rows([&](auto *rows) {
    auto touches = [&](int k) {
      const auto approach =
          apf::Approach::of(rows[candidates.i[k]], rows[candidates.j[k]], candidates.touch[k]);
      const int i = candidates.i[k], j = candidates.j[k];
      const bool mine = force->newton_pair || j < atom->nlocal || atom->tag[i] < atom->tag[j];
      if (mine) {    // one of the ranks that see it
        const bool foreseen = !all || (store->steps(i) && store->steps(j));
        store->note_touch(approach, candidates.touch[k], mode_of(i, j), foreseen);
      }
      close(k, apf::ContactHistory());
      if (mine) check_touch(approach, contacts.size() - 1);
      store->bodies().touch(i);
      store->bodies().touch(j);
      if (step > 0.0) apf::correct_touch(contacts, contacts.size() - 1, rows, step, store->due);
    };
    if (all)
      candidates.detect(rows, touches);
    else
      candidates.detect_near(rows, touches);
  });
}

/* ----------------------------------------------------------------------
   sub-steps of a particle step
------------------------------------------------------------------------- */

template <class Has> bool PairGranularAdhesive::some_coeff(const Has &has) const
{
  for (const auto &of_type : coefficients)
    for (const auto &coeff : of_type)
      if (has(coeff.model)) return true;
  return false;
}

bool PairGranularAdhesive::slides() const
{
  return some_coeff([](const apf::ContactModel &model) {
    return model.sliding();
  });
}

bool PairGranularAdhesive::has_springs() const
{
  return some_coeff([](const apf::ContactModel &model) {
    return model.sliding() || model.twisting || model.rolling();
  });
}

// Elastic contacts alone are what their particles' places say, through however many images.
bool PairGranularAdhesive::remembers() const
{
  return wet || has_springs() || some_coeff([](const apf::ContactModel &model) {
           return model.adhesive() || model.alpha > 0.0;
         });
}

void PairGranularAdhesive::find_fastest(apf::LookAhead &ahead)
{
  store->bodies().with_rows([&](const auto *rows) {
    contacts.find_fastest(rows, update->dt, ahead, [&](int k) {
      return ahead.acceleration[contacts.i[k]] + ahead.acceleration[contacts.j[k]];
    });
  });
  if (wet) bridges.find_fastest(ahead);
}

void PairGranularAdhesive::find_approaching(apf::LookAhead &ahead)
{
  store->bodies().with_rows([&](const auto *rows) {
    candidates.find_approaching(rows, ahead);
  });
  if (wet) bridges.find_approaching(ahead, candidates.near);
}

bool PairGranularAdhesive::find_near(apf::LookAhead &ahead)
{
  bool any = false;
  store->bodies().with_rows([&](const auto *rows) {
    any = candidates.find_near(rows, ahead);
    if (wet) any |= bridges.find_near(rows, ahead);
  });
  return any;
}

void PairGranularAdhesive::find_stiffest(apf::Stiffest &stiffest)
{
  contacts.find_stiffest(stiffest, [&](int k) {
    return stiffest.acceleration[contacts.i[k]] + stiffest.acceleration[contacts.j[k]];
  });
  store->bodies().with_rows([&](const auto *rows) {
    for (const int k : candidates.near) {
      const int i = candidates.i[k], j = candidates.j[k];
      const auto approach = apf::Approach::of(rows[i], rows[j], candidates.touch[k]);
      stiffest.include_near(mode_of(i, j), approach,
                            stiffest.acceleration[i] + stiffest.acceleration[j]);
    }
  });
  if (wet) bridges.find_stiffest(stiffest);
}

// Masses are shared anew at the next particle step; contacts made until then count their bodies'
// contacts as they were, so that ranks agree.
void PairGranularAdhesive::sub_step(const apf::ContactTimes &times)
{
  if (wet) bridges.detect(false, times.advance);
  detect(false, times.advance);
  const int ended = kernel(contacts, store->bodies(), times, nullptr);
  const int ruptured = wet ? bridges.add_forces(store->bodies(), times, nullptr) : 0;
  if (ended) {
    correct_ends(times.advance);
    remove_ended(true);
  }
  if (ruptured) bridges.remove_ruptured(true);
}

void PairGranularAdhesive::join_bodies(apf::Islands &islands) const
{
  for (int k = 0; k < contacts.size(); k++) islands.join(contacts.i[k], contacts.j[k]);
  for (const int k : candidates.near) islands.join(candidates.i[k], candidates.j[k]);
}

void PairGranularAdhesive::part(const apf::Islands &islands)
{
  tiles.part(
      contacts, candidates.near, islands.size(),
      [&](int k) {
        return islands.tile_of(contacts.i[k]);
      },
      [&](int n) {
        return islands.tile_of(candidates.i[candidates.near[n]]);
      });
}

/* ----------------------------------------------------------------------
   candidates = pairs of a new neighbour list; closed contacts are found again by atom ID
------------------------------------------------------------------------- */

void PairGranularAdhesive::build_candidates()
{
  const double *radius = atom->radius;
  const tagint *tag = atom->tag;
  const double *const *x = atom->x;
  const NearestImages images(domain);
  const bool one_image = remembers();
  candidates.clear();
  contacts.clear();
  if (update->setupflag && store->keeps_liquid()) store->end_lost_bridges();
  if (wet) {
    bridges.fill_new_atoms();
    store->share_liquid();
    bridges.begin_list();
  }

  int pairs = 0;
  for (int ii = 0; ii < list->inum; ii++) pairs += list->numneigh[list->ilist[ii]];
  candidates.reserve(pairs);

  auto add = [&](int i, int jmasked) {
    if (force->special_lj[sbmask(jmasked)] == 0.0) return;
    const int j = jmasked & NEIGHMASK;
    const int k = candidates.add(i, j, radius[i] + radius[j]);
    const auto history = store->find(i, tag[j]);
    if (history && (!one_image || images.nearest(x[i], x[j]))) close(k, *history);
    if (wet) bridges.add_candidate(i, j, images);
  };
  // First pairs of a few particles, then their second ones, and so on: contacts that share a body
  // are not next to each other, where each would wait for the load that the one before puts on it.
  constexpr int together = 32;
  for (int first = 0; first < list->inum; first += together) {
    const int end = std::min(first + together, list->inum);
    bool more = true;
    for (int jj = 0; more; jj++) {
      more = false;
      for (int ii = first; ii < end; ii++) {
        const int i = list->ilist[ii];
        if (jj >= list->numneigh[i]) continue;
        add(i, list->firstneigh[i][jj]);
        more = true;
      }
    }
  }
  store->bodies().forget_touched();
  rebuild = false;
  new_list = true;
  if (update->setupflag) check_places();
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::close(int k, const apf::ContactHistory &history)
{
  const int i = candidates.i[k], j = candidates.j[k];
  if (atom->tag[i] == atom->tag[j] && remembers()) {
    // in a layer as thick as a sphere it only seems to touch itself
    constexpr double just = 1.0 - 1e-9;
    double d[3];
    MathExtra::sub3(atom->x[i], atom->x[j], d);
    if (MathExtra::len3(d) >= just * candidates.touch[k]) return;
    store->refuse_images(i, atom->tag[j]);
  }
  const int added = contacts.add(i, j, k, number_of_kind(i, j), history);
  contacts.set_crowding(added, bodies_of(i, j, store->count(i) + 1.0, store->count(j) + 1.0));
  candidates.closed[k] = 1;
  store->count_anew();
}

const ContactCoeff &PairGranularAdhesive::coeff_of(int i, int j) const
{
  return coefficients[atom->type[i]][atom->type[j]];
}

int PairGranularAdhesive::law_of(int i, int j) const
{
  return atom->type[i] * (atom->ntypes + 1) + atom->type[j];
}

int PairGranularAdhesive::number_of_kind(int i, int j)
{
  return contacts.kinds.find(law_of(i, j), coeff_of(i, j).model, bodies_of(i, j, 1.0, 1.0));
}

/* ----------------------------------------------------------------------
   radii and effective inertia; frozen particles and rigid bodies count as LAMMPS counts them;
   zi, zj contacts share the two particles
------------------------------------------------------------------------- */

apf::ContactBodies PairGranularAdhesive::bodies_of(int i, int j, double zi, double zj) const
{
  const double ri = atom->radius[i], rj = atom->radius[j];
  double mi = atom->rmass[i], mj = atom->rmass[j];
  double inv_Ii = 2.5 / (mi * ri * ri), inv_Ij = 2.5 / (mj * rj * rj);
  if (rigid) {
    if (mass_rigid[i] > 0.0) mi = mass_rigid[i];
    if (mass_rigid[j] > 0.0) mj = mass_rigid[j];
  }
  double inv_mi = 1.0 / mi, inv_mj = 1.0 / mj;
  const bool frozen_i = atom->mask[i] & freeze_group_bit,
             frozen_j = atom->mask[j] & freeze_group_bit;
  if (frozen_i && !frozen_j) inv_mi = inv_Ii = 0.0;
  if (frozen_j && !frozen_i) inv_mj = inv_Ij = 0.0;
  auto bodies = apf::ContactBodies::pair(ri, rj, 1.0 / (inv_mi + inv_mj), 1.0 / (inv_Ii + inv_Ij));
  bodies.crowding = (zi * inv_mi + zj * inv_mj) * bodies.m;
  return bodies;
}

// Two frozen particles, too, move as they are made to, whatever a bridge between them exerts: its
// viscous force is that of their speed.
apf::ContactBodies PairGranularAdhesive::bodies_of_bridge(int i, int j, double zi, double zj) const
{
  auto bodies = bodies_of(i, j, zi, zj);
  if (atom->mask[i] & atom->mask[j] & freeze_group_bit) bodies.m *= immovable;
  return bodies;
}

/* ----------------------------------------------------------------------
   the masses of particles are shared by the dashpots of all their contacts
------------------------------------------------------------------------- */

void PairGranularAdhesive::share_masses()
{
  for (int k = 0; k < contacts.size(); k++) {
    const int i = contacts.i[k], j = contacts.j[k];
    contacts.set_crowding(k, bodies_of(i, j, store->count(i), store->count(j)));
  }
  if (wet) bridges.share_masses();
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::correct_ends(double step)
{
  if (step == 0.0) return;
  store->bodies().with_rows([&](auto *rows) {
    for (int k = 0; k < contacts.size(); k++)
      if (contacts.ended(k)) apf::correct_end(contacts, k, rows, step, store->due);
  });
}

void PairGranularAdhesive::remove_ended(bool in_sub_step)
{
  for (int k = contacts.size() - 1; k >= 0; k--)
    if (contacts.ended(k)) {
      candidates.closed[contacts.source[k]] = 0;
      if (in_sub_step) candidates.near.push_back(contacts.source[k]);
      store->count_anew();
      store->bodies().forget_touched();
      contacts.remove(k);
    }
}

/* ----------------------------------------------------------------------
   masses of rigid bodies, for the effective mass of a contact
------------------------------------------------------------------------- */

void PairGranularAdhesive::find_rigid_masses()
{
  if (!rigid) return;
  int dim;
  const auto *body = static_cast<int *>(rigid->extract("body", dim));
  const auto *mass = static_cast<double *>(rigid->extract("masstotal", dim));
  mass_rigid.assign(atom->nmax, 0.0);
  if (!body || !mass) return;    // a style without: particles count by themselves
  for (int i = 0; i < atom->nlocal; i++)
    if (body[i] >= 0) mass_rigid[i] = mass[body[i]];
  comm->forward_comm(this);
}

int PairGranularAdhesive::pack_forward_comm(int n, int *sent, double *buf, int /*pbc_flag*/,
                                            int * /*pbc*/)
{
  for (int k = 0; k < n; k++) buf[k] = mass_rigid[sent[k]];
  return n;
}

void PairGranularAdhesive::unpack_forward_comm(int n, int first, double *buf)
{
  for (int k = 0; k < n; k++) mass_rigid[first + k] = buf[k];
}
