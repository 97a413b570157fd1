#include "pair_granular_adhesive.h"

#include "atom.h"
#include "comm.h"
#include "contact/jump.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_contact_history.h"
#include "force.h"
#include "group.h"
#include "memory.h"
#include "modify.h"
#include "neigh_list.h"
#include "neighbor.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

static constexpr int n_contact_parts = 11;
static constexpr int n_parts = n_contact_parts + 6;    // values per pair that single() offers
static constexpr int n_energies = 5;                   // energies by part that compute pair offers

/* ---------------------------------------------------------------------- */

PairGranularAdhesive::PairGranularAdhesive(LAMMPS *lmp) : Pair(lmp), bridges(lmp, this)
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
  ev_init(eflag, vflag);
  if (rebuild) {
    find_rigid_masses();
    build_candidates();
  }
  const auto times = store->take_velocities();
  auto &bodies = store->bodies();
  const double no_torque[3] = {};
  for (const auto &load : store->due) bodies.add_load(load.row, load.f, no_torque);
  if (wet) {
    store->settle_liquid();
    bridges.detect(true, times.advance);
  }
  // contacts open with first touch and end with the neck
  detect(true, times.advance);
  if (store->count_contacts()) share_masses();
  for (const auto *touched : {&contacts.i, &contacts.j})
    for (const int i : *touched) bodies.touch(i);

  const bool tallied = evflag != 0;
  if (tallied) parts.resize(contacts.size());
  const int ended = kernel(contacts, bodies, times, tallied ? parts.data() : nullptr);
  if (wet && tallied) bridges.parts.resize(bridges.all().size());
  const int ruptured =
      wet ? bridges.add_forces(bodies, times, tallied ? bridges.parts.data() : nullptr) : 0;

  // a ghost's force belongs to another rank, which has computed it as well where newton is off
  if (ended) correct_ends(times.advance);
  const int n = force->newton_pair ? atom->nlocal + atom->nghost : atom->nlocal;
  if (n)
    bodies.add_loads_to_all(n, reinterpret_cast<double(*)[3]>(atom->f[0]),
                            reinterpret_cast<double(*)[3]>(atom->torque[0]));
  if (tallied) tally(eflag);
  parts = std::vector<apf::ContactParts>();    // memory is for steps that look at them
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
      if (mine)
        store->note_touch(approach, candidates.touch[k],
                          kind_of(i, j).mode);    // one of the ranks that see it
      close(k, apf::ContactHistory());
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

void PairGranularAdhesive::find_fastest(apf::LookAhead &ahead)
{
  store->bodies().with_rows([&](const auto *rows) {
    ahead.fastest = std::max(ahead.fastest, contacts.find_fastest(rows, update->dt, [&](int k) {
      return ahead.acceleration[contacts.i[k]] + ahead.acceleration[contacts.j[k]];
    }));
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
  const bool any = candidates.find_near(ahead);
  return (wet && bridges.find_near(ahead)) || any;
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
      stiffest.include_near(kind_of(i, j).mode, approach);
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

/* ----------------------------------------------------------------------
   candidates = pairs of a new neighbour list; closed contacts are found again by atom ID
------------------------------------------------------------------------- */

void PairGranularAdhesive::build_candidates()
{
  const double *radius = atom->radius;
  const tagint *tag = atom->tag;
  candidates.clear();
  contacts.clear();
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
    const auto *history = store->find(i, tag[j]);
    if (history) close(k, *history);
    if (wet) bridges.add_candidate(i, j);
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
  rebuild = false;
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::close(int k, const apf::ContactHistory &history)
{
  const int i = candidates.i[k], j = candidates.j[k];
  const int added = contacts.add(i, j, k, number_of_kind(i, j), history);
  contacts.set_crowding(added, bodies_of(i, j, store->count(i) + 1.0, store->count(j) + 1.0));
  candidates.closed[k] = 1;
  store->bodies().touch(i);
  store->bodies().touch(j);
  store->count_anew();
}

const ContactCoeff &PairGranularAdhesive::coeff_of(int i, int j) const
{
  return coefficients[atom->type[i]][atom->type[j]];
}

int PairGranularAdhesive::number_of_kind(int i, int j)
{
  const int ti = atom->type[i], tj = atom->type[j];
  return contacts.kinds.find(ti * (atom->ntypes + 1) + tj, coefficients[ti][tj].model,
                             bodies_of(i, j, 1.0, 1.0));
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
      contacts.remove(k);
    }
}

/* ----------------------------------------------------------------------
   energy, virial and stress of all contacts from their parts
------------------------------------------------------------------------- */

void PairGranularAdhesive::tally(int eflag)
{
  for (int n = 0; n < n_energies; n++) pvector[n] = 0.0;
  const double *const *x = atom->x;
  for (int k = 0; k < contacts.size(); k++) {
    const auto &p = parts[k];
    const int i = contacts.i[k], j = contacts.j[k];
    const double energies[] = {p.elastic_energy, p.sliding_energy, p.rolling_energy,
                               p.twisting_energy};
    // with newton off both ranks of a pair count it, each half
    const double share = (force->newton_pair || j < atom->nlocal) ? 1.0 : 0.5;
    double energy = 0.0;
    for (int n = 0; n < 4; n++) {
      pvector[n] += share * energies[n];
      energy += energies[n];
    }
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, eflag ? energy : 0.0, 0.0, p.force[0],
                 p.force[1], p.force[2], x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
  }
  if (!wet) return;
  const auto &all = bridges.all();
  for (int k = 0; k < all.size(); k++) {
    const auto &p = bridges.parts[k];
    const int i = all.i[k], j = all.j[k];
    pvector[4] += p.energy * ((force->newton_pair || j < atom->nlocal) ? 1.0 : 0.5);
    ev_tally_xyz(i, j, atom->nlocal, force->newton_pair, eflag ? p.energy : 0.0, 0.0, p.force[0],
                 p.force[1], p.force[2], x[i][0] - x[j][0], x[i][1] - x[j][1], x[i][2] - x[j][2]);
  }
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::settings(int narg, char **arg)
{
  if (narg > 0)
    error->all(FLERR, 1, "Pair style granular/adhesive takes no arguments, got {}", arg[0]);
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::allocate()
{
  allocated = 1;
  const int n = atom->ntypes + 1;
  memory->create(setflag, n, n, "pair:setflag");
  memory->create(cutsq, n, n, "pair:cutsq");
  for (int i = 1; i < n; i++)
    for (int j = i; j < n; j++) setflag[i][j] = 0;
  coefficients.assign(n, std::vector<ContactCoeff>(n));
}

/* ---------------------------------------------------------------------- */

// LAMMPS's own reader of ranges throws what nobody catches at words such as -* and 1e20
void PairGranularAdhesive::parse_types(const char *word, int iarg, int &lo, int &hi) const
{
  try {
    utils::bounds(FLERR, word, 1, atom->ntypes, lo, hi, error);
  } catch (std::logic_error &) {
    error->all(FLERR, iarg,
               "Pair granular/adhesive atom types must be a number or a range within "
               "1 to {}, got {}",
               atom->ntypes, word);
  }
}

void PairGranularAdhesive::coeff(int narg, char **arg)
{
  if (narg < 3) utils::missing_cmd_args(FLERR, "pair_coeff granular/adhesive", error);
  if (!allocated) allocate();

  // where arg[0] stands in the input line: 0, or behind the style names of pair_style hybrid
  const int offset = force->pair_match("^hybrid", 0) ? 1 : 0;
  int ilo, ihi, jlo, jhi;
  parse_types(arg[0], offset, ilo, ihi);
  parse_types(arg[1], offset + 1, jlo, jhi);
  int iarg = 2;
  const auto coeff = parse_contact(lmp, "Pair granular/adhesive", narg, arg, iarg, offset);
  if (iarg < narg)
    error->all(FLERR, iarg + offset, "Pair granular/adhesive keyword {} is unknown; known are {}",
               arg[iarg], contact_keywords);

  int count = 0;
  for (int i = ilo; i <= ihi; i++)
    for (int j = MAX(jlo, i); j <= jhi; j++) {
      coefficients[i][j] = coefficients[j][i] = coeff;
      setflag[i][j] = 1;
      count++;
    }
  if (count == 0)
    error->all(FLERR, 1, "Pair_coeff types {} {} name no pair with I <= J", arg[0], arg[1]);
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::init_style()
{
  check_spheres(lmp, "Pair granular/adhesive", Error::NOLASTLINE);
  if (atom->tag_enable == 0)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair granular/adhesive needs atom IDs: remove atom_modify id no");
  if (comm->ghost_velocity == 0)
    error->all(FLERR, Error::NOLASTLINE,
               "Pair granular/adhesive needs velocities of ghost atoms: add comm_modify vel yes");
  for (int n = 1; n < 4; n++)
    if (force->special_lj[n] != 0.0 && force->special_lj[n] != 1.0)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair granular/adhesive takes special_bonds lj factors 0 or 1, got {}",
                 force->special_lj[n]);

  check_units(lmp, "Pair granular/adhesive");
  neighbor->add_request(this, NeighConst::REQ_SIZE);

  const auto freezes = modify->get_fix_by_style("^freeze");
  if (freezes.size() > 1)
    error->all(FLERR, Error::NOLASTLINE, "Pair granular/adhesive allows one fix freeze, got {}",
               freezes.size());
  freeze_group_bit = freezes.empty() ? 0 : freezes[0]->groupbit;

  rigid = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (fix->rigid_flag) {
      if (rigid)
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair granular/adhesive allows one fix rigid, got {} and {}", rigid->id,
                   fix->id);
      rigid = fix;
    }

  if (!modify->get_fix_by_id(store ? id_store : id_store + "_PLACE"))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair granular/adhesive lost its fix {}: do not unfix it, repeat pair_style",
               id_store);
  if (!store) {
    store = dynamic_cast<FixContactHistory *>(
        modify->replace_fix(id_store + "_PLACE", id_store + " all contact/history", 1));
    store->serve(this);
    bridges.serve(store);
  }
  sizes = TypeSizes::find(lmp, "Pair granular/adhesive");
  check_scene(lmp, "Pair granular/adhesive", 2.0 * sizes.largest_radius());
  neck_max = reach_max = 0.0;    // init_one finds them
  wet = false;
  contacts.kinds.forget();
  choice = apf::KernelChoice();
  choice.planar = domain->dimension == 2;
}

/* ---------------------------------------------------------------------- */

double PairGranularAdhesive::init_one(int i, int j)
{
  if (setflag[i][j] == 0)
    coefficients[i][j] = coefficients[j][i] =
        ContactCoeff::mixed(coefficients[i][i], coefficients[j][j]);
  const auto &model = coefficients[i][j].model;
  choice.include(model);
  kernel = apf::contact_kernel(choice);

  // a type without particles so far gets the cut-off of the largest one
  const double any = sizes.largest_radius();
  const double ri = sizes.radius_max[i] > 0.0 ? sizes.radius_max[i] : any;
  const double rj = sizes.radius_max[j] > 0.0 ? sizes.radius_max[j] : any;
  if (any == 0.0) return 0.0;
  const double neck = model.normal(ri * rj / (ri + rj)).pulloff_overlap();
  neck_max = MAX(neck_max, neck);
  const double reach = MAX(neck, init_bridge(i, j, ri, rj));
  reach_max = MAX(reach_max, reach);
  if (sizes.radius_max[i] > 0.0 && sizes.radius_max[j] > 0.0) {
    // the smaller particle sinks deepest into the largest one
    const std::string who = fmt::format("Pair granular/adhesive types {} {}", i, j);
    const double a = sizes.radius_min[i], b = sizes.radius_min[j];
    const double A = sizes.radius_max[i], B = sizes.radius_max[j];
    if (a / B < b / A)
      check_overlap(lmp, who, model, a * B / (a + B), a);
    else
      check_overlap(lmp, who, model, A * b / (A + b), b);
  }
  return ri + rj + reach;
}

// Returns how far bridges between two types reach.
double PairGranularAdhesive::init_bridge(int i, int j, double ri, double rj)
{
  const auto &model = coefficients[i][j].bridge;
  if (!model.present()) return 0.0;
  wet = true;
  if (model.inventory()) {
    if (!force->newton_pair)
      error->all(FLERR, Error::NOLASTLINE,
                 "Pair granular/adhesive keyword inventory needs newton on: a bridge across ranks "
                 "takes its liquid once");
    store->keep_liquid();
  }
  return model.longest(MIN(ri, rj));
}

/* ----------------------------------------------------------------------
   the stiffest mode of any pair of types against the step of this level
------------------------------------------------------------------------- */

void PairGranularAdhesive::setup()
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (store->keeps_liquid() && coefficients[i][j].bridge.present() &&
          !coefficients[i][j].bridge.inventory())
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair granular/adhesive keyword inventory must be given for all pairs of types "
                   "with bridges or for none; types {} {} have none",
                   i, j);
  if (store->step_is_given())
    check_timestep(lmp, "Pair granular/adhesive", stiffest_possible(), store->step_of_level());
}

apf::StiffestMode PairGranularAdhesive::stiffest_possible() const
{
  apf::StiffestMode worst;
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      const double mi = sizes.mass_min[i], mj = sizes.mass_min[j];
      if (mi == 0.0 || mj == 0.0) continue;
      const double ri = sizes.radius_min[i], rj = sizes.radius_min[j];
      const double inv_I = 2.5 / (mi * ri * ri) + 2.5 / (mj * rj * rj);
      const auto bodies = apf::ContactBodies::pair(ri, rj, mi * mj / (mi + mj), 1.0 / inv_I);
      worst = std::max(worst, apf::stiffest_mode(coefficients[i][j].model, bodies));
    }
  return worst;
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

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::write_restart(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      if (setflag[i][j]) fwrite(&coefficients[i][j], sizeof(ContactCoeff), 1, fp);
    }
}

void PairGranularAdhesive::read_restart(FILE *fp)
{
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      auto &coeff = coefficients[i][j];
      if (comm->me == 0) utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      if (!setflag[i][j]) continue;
      if (comm->me == 0) utils::sfread(FLERR, &coeff, sizeof(coeff), 1, fp, nullptr, error);
      MPI_Bcast(&coeff, sizeof(coeff), MPI_BYTE, 0, world);
      coefficients[j][i] = coeff;
    }
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    utils::print(fp, "{} {}\n", i, coefficients[i][i].words());
}

// A line can name one material only. Mixed pairs come back by mixing again; where the script named
// a pair of unlike types, that line is written.
void PairGranularAdhesive::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (setflag[i][j]) utils::print(fp, "{} {} {}\n", i, j, coefficients[i][j].words());
}

/* ----------------------------------------------------------------------
   parts of all contacts as they are now
------------------------------------------------------------------------- */

void PairGranularAdhesive::evaluate_parts()
{
  if (parts_step == update->ntimestep) return;
  parts_step = update->ntimestep;
  parts.resize(contacts.size());
  index_of_pair.clear();
  auto bodies = store->bodies();    // a copy: loads stay as they are
  kernel(contacts, bodies, store->last_times(), parts.data());
  for (int k = 0; k < contacts.size(); k++)
    index_of_pair[(static_cast<uint64_t>(contacts.i[k]) << 32) |
                  static_cast<uint32_t>(contacts.j[k])] = k;
  if (wet) bridges.evaluate(store->last_times());
}

double PairGranularAdhesive::single(int i, int j, int, int, double rsq, double, double,
                                    double &fforce)
{
  evaluate_parts();
  fforce = 0.0;
  std::fill(svector, svector + n_parts, 0.0);
  return single_contact(i, j, rsq, fforce) + (wet ? single_bridge(i, j, rsq, fforce) : 0.0);
}

double PairGranularAdhesive::single_contact(int i, int j, double rsq, double &fforce)
{
  auto key = [](int a, int b) {
    return (static_cast<uint64_t>(a) << 32) | static_cast<uint32_t>(b);
  };
  auto found = index_of_pair.find(key(i, j));
  double sign = 1.0;    // of tangential parts: they are those on the first atom
  if (found == index_of_pair.end()) {
    found = index_of_pair.find(key(j, i));
    sign = -1.0;
  }
  if (found == index_of_pair.end()) return 0.0;

  const auto &p = parts[found->second];
  fforce += (p.elastic + p.damping) / sqrt(rsq);
  double *out = svector;
  *out++ = p.overlap;
  *out++ = p.contact_radius;
  *out++ = p.elastic;
  *out++ = p.damping;
  for (double component : p.sliding) *out++ = sign * component;
  for (double component : p.rolling) *out++ = sign * component;
  *out++ = p.twisting;
  return p.elastic_energy + p.sliding_energy + p.rolling_energy + p.twisting_energy;
}

double PairGranularAdhesive::single_bridge(int i, int j, double rsq, double &fforce)
{
  const auto *p = bridges.part_of(i, j);
  double sign = 1.0;
  if (!p) {
    std::swap(i, j);
    sign = -1.0;
    p = bridges.part_of(i, j);
  }
  if (!p) return 0.0;
  fforce += (p->viscous - p->capillary) / sqrt(rsq);
  double *out = svector + n_contact_parts;
  *out++ = p->capillary;
  *out++ = p->viscous;
  for (double component : p->tangential) *out++ = sign * component;
  *out++ = bridges.volume_of(i, j);
  return p->energy;
}

/* ---------------------------------------------------------------------- */

void *PairGranularAdhesive::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "contact_list") == 0) return &contacts;
  if (strcmp(name, "bridge_list") == 0)
    return wet ? const_cast<apf::BridgeList *>(&bridges.all()) : nullptr;
  if (strcmp(name, "liquid") == 0) {
    if (!store || !store->keeps_liquid()) return nullptr;
    store->settle_liquid();    // all ranks ask for it
    return store->all_liquid();
  }
  return nullptr;
}

/* ---------------------------------------------------------------------- */

double PairGranularAdhesive::memory_usage()
{
  return Pair::memory_usage() + bridges.memory_usage() + contacts.memory_usage() +
      candidates.memory_usage() + parts.capacity() * sizeof(apf::ContactParts);
}
