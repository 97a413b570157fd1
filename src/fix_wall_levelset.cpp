#include "fix_wall_levelset.h"

#include "atom.h"
#include "comm.h"
#include "compute_aggregate_contact.h"
#include "contact/jump.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "math_extra.h"
#include "modify.h"
#include "particle_checks.h"
#include "respa.h"
#include "type_sizes.h"
#include "update.h"

#include <cmath>
#include <cstring>
#include <limits>
#include <set>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr const char *command = "Fix wall/levelset";

/* ---------------------------------------------------------------------- */

FixWallLevelset::FixWallLevelset(LAMMPS *lmp, int narg, char **arg) :
    FixContacts(lmp, narg, arg), motion(lmp), kernel(nullptr), rows(domain->dimension == 2),
    bridges(lmp, this)
{
  check_spheres(lmp, command, 2);
  scalar_flag = 1;
  vector_flag = 1;
  size_vector = 12;
  global_freq = 1;
  extscalar = 1;
  extvector = -1;    // forces and torques are extensive, counts are not to be divided by atoms
  extlist = new int[12]{1, 1, 1, 1, 1, 1, 0, 0, 0, 0, 1, 1};
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
  respa_level_support = 1;
  dynamic_group_allow = 1;

  int iarg = 3;
  surfaces = parse_surfaces(lmp, command, narg, arg, iarg, grid);
  coefficient = parse_contact(lmp, command, narg, arg, iarg, 0);
  const auto names = surface_names(surfaces, grid.get());
  while (iarg < narg) {
    if (strcmp(arg[iarg], "move") == 0) {
      motion.parse(command, narg, arg, iarg);
    } else if (strcmp(arg[iarg], "resolution") == 0) {
      if (narg < iarg + 2) utils::missing_cmd_args(FLERR, "fix wall/levelset resolution", error);
      resolution = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
      if (!(resolution > 0.0))
        error->all(FLERR, iarg + 1, "{} resolution must be > 0, got {}", command, arg[iarg + 1]);
      if (!grid) error->all(FLERR, iarg, "{} resolution is for walls from a file", command);
      iarg += 2;
    } else if (strcmp(arg[iarg], "film") == 0) {
      bridges.parse_film(command, narg, arg, iarg);
    } else if (strcmp(arg[iarg], "zone") == 0) {
      ledger.parse(command, names, narg, arg, iarg);
    } else {
      error->all(FLERR, iarg,
                 "{} keyword {} is unknown; known are {}, move, resolution, film, zone", command,
                 arg[iarg], contact_keywords);
    }
  }
  ledger.complete(names, grid.get());
  array_flag = 1;
  size_array_rows = ledger.n_zones() + 1;
  size_array_cols = WallLedger::N_COLUMNS;
  extarray = 0;    // for the counts in it
  wet = coefficient.bridge.present();
  choice.planar = domain->dimension == 2;
  choice.include(coefficient.model);
  kernel = apf::contact_kernel(choice);
  register_with_atoms();
}

FixWallLevelset::~FixWallLevelset()
{
  delete[] extlist;
}

/* ---------------------------------------------------------------------- */

int FixWallLevelset::setmask()
{
  return FixContacts::setmask() | POST_FORCE | POST_FORCE_RESPA | MIN_POST_FORCE;
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::init()
{
  FixContacts::init();
  check_units(lmp, command);
  motion.init();
  ledger.init(fmt::format("{} {}", command, id));
  aggregates = ComputeAggregateContact::of_all(lmp, force->pair);
  rigid = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (fix->rigid_flag) rigid = fix;

  if (const auto *respa = dynamic_cast<Respa *>(update->integrate))
    if (respa_level >= respa->nlevels)
      error->all(FLERR, Error::NOLASTLINE, "{} respa level must be in [1, {}], got {}", command,
                 respa->nlevels, respa_level + 1);

  // the pair style computes first and on the same level: its velocities serve here too
  lender = nullptr;
  for (const auto &fix : modify->get_fix_by_style("^contact/history")) {
    auto *history = dynamic_cast<FixContactHistory *>(fix);
    if (!utils::strmatch(update->integrate_style, "^respa") || history->level() == level())
      lender = history;
  }

  if (wet) bridges.init();

  // the smallest and lightest particle, there or to come, decides about overlap and time step
  const auto sizes = TypeSizes::find(lmp, command, igroup);
  const double r = sizes.smallest_radius(), m = sizes.smallest_mass();
  if (r == 0.0) return;
  for (const auto &surface : surfaces)
    if (surface.shape == apf::Surface::Shape::cylinder && surface.side < 0.0 &&
        surface.radius <= 1.1 * sizes.largest_radius())
      error->all(FLERR, Error::NOLASTLINE,
                 "{} {}: the radius of a cylinder around the fluid must be > 1.1 times that of the "
                 "largest particle, {}, got {}",
                 command, id, sizes.largest_radius(), surface.radius);
  if (grid) check_grid(r, sizes.largest_radius());
  check_reach(r);
  std::set<double> contact_radii;    // one message for all surfaces of the same
  for (const auto &surface : surfaces) {
    const auto bodies = bodies_at(surface, r, m);
    if (!contact_radii.insert(bodies.R).second) continue;
    check_overlap(lmp, fmt::format("Fix wall/levelset {}", id), coefficient.model, bodies.R, r);
    if (step_is_given() && m > 0.0)    // LAMMPS's own inserters do not tell the mass
      check_timestep(lmp, fmt::format("Fix wall/levelset {}", id),
                     apf::stiffest_mode(coefficient.model, bodies), step_of_level());
  }
}

// A particle beyond a fixed border of the box is lost, before it comes to a plane farther out.
void FixWallLevelset::check_reach(double smallest)
{
  if (comm->me != 0) return;
  for (const auto &surface : surfaces) {
    if (surface.shape != apf::Surface::Shape::plane) continue;
    const int dim = surface.dim, upper = surface.side < 0.0;
    const double border = upper ? domain->boxhi[dim] : domain->boxlo[dim];
    const double beyond = (border - surface.origin[0]) * surface.side;
    if (domain->boundary[dim][upper] == 1 && beyond > smallest)
      error->warning(FLERR,
                     "{} {}: the plane {} = {} is {:.3g} outside of the box, whose fixed border is "
                     "at {}: particles are lost before they touch it",
                     command, id, "xyz"[dim], surface.origin[0], beyond, border);
  }
}

apf::ContactBodies FixWallLevelset::bodies_at(const apf::Surface &surface, double r, double m)
{
  auto bodies = apf::ContactBodies::wall(r, m, 0.4 * m * r * r);
  bodies.R = surface.contact_radius(r);
  return bodies;
}

// The numbers of a grid must be good enough for the particles that are there or will be inserted.
void FixWallLevelset::check_grid(double smallest, double largest)
{
  grid->check_box(Error::NOLASTLINE);
  const auto normal = coefficient.model.normal(smallest);
  constexpr double without_adhesion = 1.0e-3;    // what delta_C of micron-sized dust is to R
  const double allowed = resolution *
      (coefficient.model.adhesive() ? normal.pulloff_overlap() : without_adhesion * smallest);
  const double now[3] = {smallest, largest, allowed};
  if (std::equal(now, now + 3, checked_for)) return;
  std::copy(now, now + 3, checked_for);
  grid->check(surfaces, smallest, largest, allowed);
}

/* ----------------------------------------------------------------------
   level of r-RESPA: that of fix_modify, else the pair style's, else the outermost
------------------------------------------------------------------------- */

int FixWallLevelset::level() const
{
  const auto *respa = dynamic_cast<Respa *>(update->integrate);
  if (respa_level >= 0) return respa_level;    // fix_modify counts from 1, this from 0
  return respa->level_pair >= 0 ? respa->level_pair : respa->nlevels - 1;
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::setup(int vflag)
{
  motion.take_speeds();
  if (auto *respa = dynamic_cast<Respa *>(update->integrate)) {
    respa->copy_flevel_f(level());
    post_force(vflag);
    respa->copy_f_flevel(level());
  } else
    post_force(vflag);
}

void FixWallLevelset::min_setup(int vflag)
{
  post_force(vflag);
}

void FixWallLevelset::min_post_force(int vflag)
{
  post_force(vflag);
}

void FixWallLevelset::post_force_respa(int vflag, int ilevel, int)
{
  if (ilevel == level()) post_force(vflag);
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::post_force(int vflag)
{
  v_init(vflag);
  touched.resize(atom->nmax, 0);
  if (rebuild) find_again();
  ledger.move_regions();
  const auto times = lender ? lender->times() : take_velocities();
  if (lender) recall_due(times);
  motion.pose.advance(times.advance);
  contacts_change();
  const int before = contacts.size();
  if (wet) {
    bridges.measure_films();
    bridges.detect(times.advance);
  }
  detect();
  follow_curvature();
  share_masses();
  const bool goes_on = !due.empty();
  const int ended = add_forces(times, before);
  const int ruptured = wet ? bridges.add_forces(times, due) : 0;
  ledger.clear_loads();
  loads_summed = settled = false;
  tally(rows, contacts.source, surface_of);
  if (wet) {
    return_loads(bridges.copies(), bridges.atoms());
    tally(bridges.copies(), bridges.atoms(), bridges.surfaces());
  }
  if (goes_on) add_due();
  if (ended) remove_ended(false);
  if (ruptured) bridges.remove_ruptured(false);
  motion.take_speeds();
}

apf::Foot FixWallLevelset::foot_of(int surface, const double *x) const
{
  if (!motion.pose.moves) return surfaces[surface].foot(x);
  double y[3], at[3];
  motion.pose.to_frame(x, y);
  apf::Foot foot = surfaces[surface].foot(y);
  motion.pose.to_space(foot.at, at);
  std::copy(at, at + 3, foot.at);
  return foot;
}

bool FixWallLevelset::farther(int surface, const double *x, double than) const
{
  if (!motion.pose.moves) return surfaces[surface].farther(x, than);
  double y[3];
  motion.pose.to_frame(x, y);
  return surfaces[surface].farther(y, than);
}

// The particles' rows: position and velocity of the last forces, and the loads of all contacts.
apf::Bodies &FixWallLevelset::particles()
{
  return lender ? lender->bodies() : velocities.bodies;
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::detect()
{
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
    for (int i = 0; i < atom->nlocal; i++)
      if (atom->mask[i] & groupbit && !farther(s, atom->x[i], atom->radius[i])) touch(i, s);
}

// closes the contact if there is one and it is new
void FixWallLevelset::touch(int i, int surface)
{
  if (touched[i] >> surface & 1) return;
  double x[3];
  particles().position(i, x);
  const auto foot = foot_of(surface, x);
  if (foot.distance > atom->radius[i]) return;
  if (foot.distance <= 0.0)
    error->one(FLERR, Error::NOLASTLINE,
               "{} {}: the centre of atom {} is outside the fluid, {} behind the wall; put it "
               "inside, or use a smaller timestep",
               command, id, atom->tag[i], -foot.distance);
  const Marks others = zones_of(i);
  close(i, surface, apf::ContactHistory());
  note_touch(approach_of(i, foot), atom->radius[i], contacts.mode(contacts.size() - 1));
  captured += 1.0;
  ledger.begin(zone_of(i, surface), others);
}

void FixWallLevelset::close(int i, int surface, const apf::ContactHistory &history)
{
  const int k = contacts.size();
  auto bodies = bodies_of(i, surface, atom->x[i]);
  contacts.add(2 * k, 2 * k + 1, i, contacts.kinds.find(surface, coefficient.model, bodies),
               history);
  bodies.crowding = crowding(i) + 1.0;
  contacts.set_crowding(k, bodies);
  surface_of.push_back(surface);
  touched[i] |= 1u << surface;
  count_anew();
}

apf::ContactBodies FixWallLevelset::bodies_of(int i, int surface, const double *x) const
{
  const double r = atom->radius[i];
  auto bodies = bodies_at(surfaces[surface], r, atom->rmass[i]);
  if (rigid) {
    int dim;
    const auto *body = static_cast<int *>(rigid->extract("body", dim));
    const auto *mass = static_cast<double *>(rigid->extract("masstotal", dim));
    if (body && mass && body[i] >= 0) bodies.m = mass[body[i]];
  }
  double y[3];
  motion.pose.to_frame(x, y);
  bodies.turning = surfaces[surface].turning(y, r);
  return bodies;
}

// An atom's mass is shared by the dashpots of all its contacts.
void FixWallLevelset::share_masses()
{
  const bigint now[2] = {changes, lender ? lender->counted() : 0};
  if (std::equal(now, now + 2, shared_at)) return;
  std::copy(now, now + 2, shared_at);
  for (int k = 0; k < contacts.size(); k++) {
    const int i = contacts.source[k];
    auto bodies = bodies_of(i, surface_of[k], atom->x[i]);
    bodies.crowding = crowding(i);
    contacts.set_crowding(k, bodies);
  }
  if (wet) bridges.share_masses();
}

// contacts of an atom, with particles and with this wall, and bridges
double FixWallLevelset::crowding(int i) const
{
  double n = lender ? lender->pair_count(i) : 0.0;
  for (unsigned bits = touched[i]; bits; bits >>= 1) n += bits & 1;
  return n + (wet ? bridges.count(i) : 0.0);
}

// Normals of walls whose curvature is not the same everywhere turn as fast as that where a particle
// is now, to 1/16.
void FixWallLevelset::follow_curvature()
{
  if (!grid) return;
  for (int k = 0; k < contacts.size(); k++) {
    const int i = contacts.source[k], s = surface_of[k];
    if (surfaces[s].uniform) continue;
    const int kind = contacts.kinds.find(s, coefficient.model, bodies_of(i, s, atom->x[i]));
    if (kind != contacts.kind[k]) contacts.change_kind(k, kind);
  }
}

void FixWallLevelset::add_counts(double *counts)
{
  if (rebuild) find_again();
  for (int i : contacts.source) counts[i] += 1.0;
  if (wet) bridges.add_counts(counts);
}

void FixWallLevelset::remove_ended(bool in_sub_step)
{
  for (int k = contacts.size() - 1; k >= 0; k--) {
    if (!contacts.ended(k)) continue;
    if (in_sub_step) near.push_back({contacts.source[k], surface_of[k]});
    touched[contacts.source[k]] &= ~(1u << surface_of[k]);
    ledger.end(zone_of(contacts.source[k], surface_of[k]), zones_of(contacts.source[k]));
    contacts.remove(k);
    surface_of[k] = surface_of.back();
    surface_of.pop_back();
    if (k < contacts.size()) {
      contacts.i[k] = 2 * k;
      contacts.j[k] = 2 * k + 1;
    }
    detached += 1.0;
    count_anew();
  }
}

// of the foot of a particle
int FixWallLevelset::zone_of(int i, int surface)
{
  double x[3];
  particles().position(i, x);
  return ledger.zone_of(surface, foot_of(surface, x).at);
}

// ... and of all feet on surfaces that it touches
Marks FixWallLevelset::zones_of(int i)
{
  Marks zones = 0;
  for (int s = 0; touched[i] >> s; s++)
    if (touched[i] >> s & 1) zones |= ledger.mark(zone_of(i, s));
  return zones;
}

/* ----------------------------------------------------------------------
   rows of the kernel: particle and foot point
------------------------------------------------------------------------- */

void FixWallLevelset::gather()
{
  const int n = contacts.size();
  rows.resize(2 * n);
  for (int k = 0; k < n; k++) copy_rows(rows, k, contacts.source[k], surface_of[k]);
  rows.clear_loads(0, 2 * n);
}

// rows 2k and 2k+1: a particle and its foot point on a surface
void FixWallLevelset::copy_rows(apf::Bodies &to, int k, int i, int surface)
{
  const auto &from = particles();
  double x[3];
  from.position(i, x);
  const auto foot = foot_of(surface, x);
  if (foot.distance <= 0.0 || !foot.exists)
    error->one(FLERR, Error::NOLASTLINE,
               "{} {}: the centre of atom {} passed the wall; use a smaller timestep or a larger E",
               command, id, atom->tag[i]);
  to.copy_row(from, i, 2 * k);
  to.place(2 * k + 1, foot.at);
  if (!motion.pose.moves) return;
  const auto v = motion.pose.velocity_at(foot.at), &w = motion.pose.spin;
  const double v_wall[3] = {v.x, v.y, v.z}, spin[3] = {w.x, w.y, w.z};
  to.set_motion(2 * k + 1, v_wall, spin);
}

// Forces of all contacts, those from number `made` on being new; returns how many have ended.
int FixWallLevelset::add_forces(const apf::ContactTimes &times, int made)
{
  gather();
  const int ended = kernel(contacts, rows, times, nullptr);
  std::vector<apf::DueLoad> of_rows;
  if (times.advance > 0.0 && (ended || made < contacts.size()))
    rows.with_rows([&](auto *r) {
      for (int k = made; k < contacts.size(); k++)
        apf::correct_touch(contacts, k, r, times.advance, of_rows);
      for (int k = 0; k < contacts.size(); k++)
        if (contacts.ended(k)) apf::correct_end(contacts, k, r, times.advance, of_rows);
    });
  for (const auto &load : of_rows)
    if (load.row % 2 == 0)
      due.push_back({contacts.source[load.row / 2], {load.f[0], load.f[1], load.f[2]}});
  return_loads(rows, contacts.source);
  return ended;
}

// What is due from the last run acts along the line through a particle's centre and its foot point.
void FixWallLevelset::add_due()
{
  const double no_torque[3] = {};
  for (const auto &[i, f] : due) {
    particles().add_load(i, f, no_torque);
    const double *x = atom->x[i];
    int nearest = 0;    // surface; the contact itself may be gone
    double least = std::numeric_limits<double>::max();
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
      const double d = foot_of(s, x).distance;
      if (d < least) nearest = s;
      least = std::min(least, d);
    }
    auto &loads = ledger.load(zone_of(i, nearest));
    for (int c = 0; c < 3; c++) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      atom->f[i][c] += f[c];
      loads[c] -= f[c];
      loads[3 + c] -= x[a] * f[b] - x[b] * f[a];
    }
  }
}

// what the wall exerts on particles goes to their rows
void FixWallLevelset::return_loads(const apf::Bodies &from, const std::vector<int> &atoms)
{
  auto &to = particles();
  for (int k = 0; k < static_cast<int>(atoms.size()); k++) {
    double f[3] = {}, torque[3] = {};
    from.add_load_to(2 * k, f, torque);
    to.add_load(atoms[k], f, torque);
  }
}

// ... and to LAMMPS: forces on particles and on the wall, virial
void FixWallLevelset::tally(const apf::Bodies &from, const std::vector<int> &atoms,
                            const std::vector<int> &surfaces_of)
{
  for (int k = 0; k < static_cast<int>(atoms.size()); k++) {
    const int i = atoms[k];
    double f[3] = {}, torque[3] = {}, on_wall[3] = {}, moment[3] = {}, foot[3];
    from.add_load_to(2 * k, f, torque);
    from.add_load_to(2 * k + 1, on_wall, moment);
    from.position(2 * k + 1, foot);
    auto &loads = ledger.load(ledger.zone_of(surfaces_of[k], foot));
    for (int c = 0; c < 3; c++) {
      atom->f[i][c] += f[c];
      atom->torque[i][c] += torque[c];
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      loads[c] += on_wall[c];
      loads[3 + c] += foot[a] * on_wall[b] - foot[b] * on_wall[a] + moment[c];
    }
    if (evflag) {
      const double *x = atom->x[i];
      const double d[3] = {x[0] - foot[0], x[1] - foot[1], x[2] - foot[2]};
      double virial_of_contact[6] = {d[0] * f[0], d[1] * f[1], d[2] * f[2],
                                     d[0] * f[1], d[0] * f[2], d[1] * f[2]};
      int one = i;
      v_tally(1, &one, 1.0, virial_of_contact);
    }
  }
}

/* ----------------------------------------------------------------------
   sub-steps, see FixContacts
------------------------------------------------------------------------- */

void FixWallLevelset::find_fastest(apf::LookAhead &ahead)
{
  if (wet) bridges.find_fastest(ahead);
  if (contacts.size() == 0) return;
  gather();    // contacts may have ended since the last forces
  rows.with_rows([&](const auto *r) {
    ahead.fastest = std::max(ahead.fastest, contacts.find_fastest(r, update->dt, [&](int k) {
      return ahead.acceleration[contacts.source[k]];
    }));
  });
}

void FixWallLevelset::find_approaching(apf::LookAhead &ahead)
{
  near.clear();
  perhaps.clear();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *x = atom->x[i];
    const double farthest = ahead.farthest() + ahead.reach * speed_near(x);
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
      const bool closed = touched[i] >> s & 1;
      if (!closed && farther(s, x, farthest + atom->radius[i])) continue;
      const auto approach = approach_of(i, foot_of(s, x));
      if (!closed && approach.gap > farthest) continue;
      if (closed || approach.gap <= ahead.distance(approach.closing_speed)) {
        ahead.meet(i, approach.relative_speed);
        if (!closed) near.push_back({i, s});
      } else {
        perhaps.push_back({i, s, approach.gap});
      }
    }
  }
  if (wet) bridges.find_approaching(ahead);
}

// How a particle moves against the wall's material; where there is no foot, as if straight at it.
apf::Approach FixWallLevelset::approach_of(int i, const apf::Foot &foot)
{
  double v[3], omega[3], x[3], n[3];
  particles().motion(i, v, omega);
  particles().position(i, x);
  if (motion.pose.moves) {
    const auto v_wall = motion.pose.velocity_at(foot.at);
    v[0] -= v_wall.x;
    v[1] -= v_wall.y;
    v[2] -= v_wall.z;
  }
  const double speed = MathExtra::len3(v);
  if (!foot.exists) return {foot.distance - atom->radius[i], speed, speed};
  MathExtra::sub3(foot.at, x, n);
  return {foot.distance - atom->radius[i], MathExtra::dot3(v, n) / MathExtra::len3(n), speed};
}

double FixWallLevelset::speed_near(const double *x) const
{
  if (!motion.pose.moves) return 0.0;
  const auto v = motion.pose.velocity_at(x);
  return std::sqrt(norm2(v));
}

// A wall is struck, but strikes nothing in turn.
bool FixWallLevelset::find_near(apf::LookAhead &ahead)
{
  size_t left = 0;
  for (const auto &candidate : perhaps) {
    if (ahead.activity[candidate.i] == apf::FREE || candidate.gap > ahead.distance_if_struck())
      perhaps[left++] = candidate;
    else
      near.push_back({candidate.i, candidate.surface});
  }
  perhaps.resize(left);
  if (wet) bridges.find_near(ahead);
  return false;
}

void FixWallLevelset::sub_step(const apf::ContactTimes &times)
{
  motion.pose.advance(times.advance);
  const int before = contacts.size();
  for (const auto &[i, s] : near) touch(i, s);
  if (wet) bridges.sub_detect(times.advance);
  const int ended = add_forces(times, before);
  if (wet) {
    const int ruptured = bridges.add_forces(times, due);
    return_loads(bridges.copies(), bridges.atoms());
    if (ruptured) bridges.remove_ruptured(true);
  }
  contacts_change();
  if (ended) remove_ended(true);
}

void FixWallLevelset::settle_bridges()
{
  if (wet) bridges.settle();
}

void FixWallLevelset::find_stiffest(apf::Stiffest &stiffest)
{
  contacts.find_stiffest(stiffest, [&](int k) {
    return stiffest.acceleration[contacts.source[k]];
  });
  for (const auto &[i, s] : near) {
    const double *x = atom->x[i];
    const auto bodies = bodies_of(i, s, x);
    const int kind = contacts.kinds.find(s, coefficient.model, bodies);
    stiffest.include_near(contacts.kinds[kind].mode, approach_of(i, foot_of(s, x)));
  }
  if (wet) bridges.find_stiffest(stiffest);
}

/* ----------------------------------------------------------------------
   contacts through a rebuild of the neighbour list: partner = number of the surface
------------------------------------------------------------------------- */

void FixWallLevelset::before_storing()
{
  if (wet && lender) lender->settle_liquid();
}

void FixWallLevelset::store_contacts()
{
  store.start(atom->nlocal, contacts.size(), wet ? bridges.size() : 0);
  for (int k = 0; k < contacts.size(); k++)
    store.contacts.add(contacts.source[k], surface_of[k], contacts.history_of(k));
  if (wet) bridges.store_into(store);
}

void FixWallLevelset::post_neighbor()
{
  rebuild = true;
}

void FixWallLevelset::find_again()
{
  rebuild = false;
  touched.resize(atom->nmax, 0);
  contacts.clear();
  surface_of.clear();
  std::fill(touched.begin(), touched.end(), 0u);
  if (wet) bridges.find_again();
  for (int i = 0; i < atom->nlocal; i++)
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
      if (const auto *history = store.contacts.find(i, s)) close(i, s, *history);
}

/* ---------------------------------------------------------------------- */

double FixWallLevelset::distance(const double *x) const
{
  return distance(x, ~Marks(0));
}

double FixWallLevelset::distance(const double *x, Marks of_surfaces) const
{
  double y[3], nearest = std::numeric_limits<double>::max();
  motion.pose.to_frame(x, y);
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
    if (of_surfaces >> s & 1) nearest = std::min(nearest, surfaces[s].distance(y));
  return nearest;
}

double FixWallLevelset::reach(Marks of_surfaces) const
{
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
    if (of_surfaces >> s & 1) least = std::min(least, surfaces[s].reach);
  return least;
}

/* ----------------------------------------------------------------------
   [0] elastic and adhesive energy of all wall contacts
------------------------------------------------------------------------- */

double FixWallLevelset::compute_scalar()
{
  double energy = 0.0;
  if (contacts.size() > 0) {
    std::vector<apf::ContactParts> parts(contacts.size());
    gather();    // remove_ended() has renumbered the rows
    kernel(contacts, rows, lender ? lender->last_times() : last_times(), parts.data());
    for (const auto &p : parts)
      energy += p.elastic_energy + p.sliding_energy + p.rolling_energy + p.twisting_energy;
  }
  if (wet) energy += bridges.energy();
  double all;
  MPI_Allreduce(&energy, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

// force 3, torque about the origin 3, contacts, contacts begun, contacts ended, bridges, liquid in
// them, liquid left on the wall
double FixWallLevelset::compute_vector(int n)
{
  if (!loads_summed) {
    before_storing();
    double mine[12];
    const auto loads = ledger.total_load();
    std::copy(loads.begin(), loads.end(), mine);
    mine[6] = contacts.size();
    mine[7] = captured;
    mine[8] = detached;
    mine[9] = bridges.size();
    mine[10] = bridges.liquid_held();
    mine[11] = ledger.total_liquid() + bridges.liquid_from_wall();
    MPI_Allreduce(mine, all_loads, 12, MPI_DOUBLE, MPI_SUM, world);
    loads_summed = true;
  }
  return all_loads[n];
}

// rows: zones of the wall, and the whole of it
double FixWallLevelset::compute_array(int row, int column)
{
  if (!settled) ledger.settle(touches(), aggregates.get());
  settled = true;
  return ledger.entry(row, column);
}

std::vector<WallTouch> FixWallLevelset::touches()
{
  if (rebuild) find_again();
  std::vector<WallTouch> all;
  for (int k = 0; k < contacts.size(); k++) {
    const int i = contacts.source[k], s = surface_of[k];
    all.push_back({i, s, zone_of(i, s), true});
  }
  for (int b = 0; b < bridges.size(); b++) {
    const int i = bridges.atoms()[b], s = bridges.surfaces()[b];
    if (!(touched[i] >> s & 1)) all.push_back({i, s, zone_of(i, s), false});
  }
  return all;
}

std::vector<double> FixWallLevelset::global_state() const
{
  double mine[2] = {captured, detached}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  std::vector<double> state = {all[0], all[1], motion.pose.moves ? 1.0 : 0.0};
  state.resize(3 + apf::WallPose::state_size);
  motion.pose.write(&state[3]);
  const auto of_zones = ledger.state();
  state.insert(state.end(), of_zones.begin(), of_zones.end());
  return state;
}

void FixWallLevelset::set_global_state(const double *state)
{
  if (comm->me == 0) {    // counts are sums over ranks
    captured = state[0];
    detached = state[1];
  }
  if (state[2] != 0.0 && motion.pose.moves) motion.pose.read(state + 3);
  ledger.set_state(state + 3 + apf::WallPose::state_size, fmt::format("{} {}", command, id));
}

/* ----------------------------------------------------------------------
   "wall_contacts": int[nlocal], closed contacts of each atom with this wall, or bridges without
   "wall_bridges": int[nlocal]; "wall_liquid": double[nlocal], the atom's share in these bridges
------------------------------------------------------------------------- */

void *FixWallLevelset::extract(const char *name, int &dim)
{
  dim = 1;
  if (strcmp(name, "wall_bridges") == 0) return wet ? bridges.counts_of_atoms() : nullptr;
  if (strcmp(name, "wall_liquid") == 0) return wet ? bridges.liquid_of_atoms() : nullptr;
  if (strcmp(name, "wall_contacts") != 0) return nullptr;
  count_of_atom.assign(atom->nmax, 0);
  for (int i : contacts.source) count_of_atom[i]++;
  if (wet) bridges.count_where_dry_contact_is_not(count_of_atom);
  return count_of_atom.data();
}

/* ---------------------------------------------------------------------- */

int FixWallLevelset::image(int *&objects, double **&values)
{
  drawn = std::make_unique<WallImage>(surfaces, grid.get(), domain);
  if (motion.pose.moves) drawn->move(motion.pose);
  objects = drawn->objects.data();
  values = drawn->rows.data();
  return static_cast<int>(drawn->objects.size());
}

/* ---------------------------------------------------------------------- */

double FixWallLevelset::memory_usage()
{
  return FixContacts::memory_usage() + contacts.memory_usage() + bridges.memory_usage() +
      touched.capacity() * sizeof(unsigned) + rows.memory_usage() +
      (grid ? grid->memory_usage() : 0.0);
}
