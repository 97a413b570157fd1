#include "fix_wall_levelset.h"

#include "argument_reader.h"
#include "atom.h"
#include "comm.h"
#include "compute_aggregate_contact.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "given_once.h"
#include "lost_state.h"
#include "modify.h"
#include "named_atoms.h"
#include "particle_checks.h"
#include "respa.h"
#include "type_sizes.h"
#include "update.h"

#include <cstring>
#include <set>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixWallLevelset::FixWallLevelset(LAMMPS *lmp, int narg, char **arg) :
    FixContacts(lmp, narg, arg), motion(lmp), kernel(nullptr), rows(domain->dimension == 2),
    bridges(lmp, this)
{
  check_spheres(lmp, command, 2);
  scalar_flag = 1;
  vector_flag = 1;
  size_vector = n_loads + n_bridge_loads;
  global_freq = 1;
  extscalar = 1;
  extvector = -1;    // forces and torques are extensive, counts are not to be divided by atoms
  extensive.assign(size_vector, 1);
  std::fill_n(extensive.begin() + 6, 4, 0);
  extlist = extensive.data();
  energy_global_flag = 1;
  virial_global_flag = virial_peratom_flag = 1;
  respa_level_support = 1;
  dynamic_group_allow = 1;

  int iarg = 3;
  surfaces = parse_surfaces(lmp, command, narg, arg, iarg, grid);
  coefficient = parse_contact(lmp, command, narg, arg, iarg, 0);
  const auto names = surface_names(surfaces, grid.get());
  parse_keywords(names, narg, arg, iarg);
  ledger.complete(names, grid.get());
  array_flag = 1;
  size_array_rows = ledger.n_zones() + 1;
  size_array_cols = WallLedger::N_COLUMNS;
  extarray = 0;    // for the counts in it
  for (const auto &surface : surfaces) clearances.include(surface);
  wet = coefficient.bridge.present();
  choice.planar = domain->dimension == 2;
  choice.include(coefficient.model);
  kernel = apf::contact_kernel(choice);
  register_with_atoms();
}

FixWallLevelset::~FixWallLevelset() = default;

/* ---------------------------------------------------------------------- */

// what follows the contact law
void FixWallLevelset::parse_keywords(const std::vector<std::string> &names, int narg, char **arg,
                                     int iarg)
{
  GivenOnce given(lmp, command);
  while (iarg < narg) {
    if (strcmp(arg[iarg], "move") != 0 && strcmp(arg[iarg], "zone") != 0)
      given.add(arg[iarg], iarg);
    if (strcmp(arg[iarg], "move") == 0) {
      motion.parse(command, narg, arg, iarg);
    } else if (strcmp(arg[iarg], "resolution") == 0) {
      if (narg < iarg + 2) utils::missing_cmd_args(FLERR, "fix wall/levelset resolution", error);
      resolution =
          ArgumentReader(lmp, command, arg).number(iarg + 1, "resolution", Range::above(0.0));
      if (!grid) error->all(FLERR, iarg, "{} resolution is for walls from a file", command);
      iarg += 2;
    } else if (strcmp(arg[iarg], "film") == 0) {
      bridges.parse_film(command, narg, arg, iarg);
    } else if (strcmp(arg[iarg], "zone") == 0) {
      ledger.parse(command, names, narg, arg, iarg);
    } else if (is_contact_keyword(arg[iarg])) {
      error->all(FLERR, iarg,
                 "{} keyword {} is one of the contact law: it must come before move, resolution, "
                 "film and zone",
                 command, arg[iarg]);
    } else {
      error->all(FLERR, iarg,
                 "{} keyword {} is unknown; known are {}, move, resolution, film, zone", command,
                 arg[iarg], contact_keywords);
    }
  }
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
  check_direction(lmp, fmt::format("{} {}", command, id));
  check_diameters(lmp, fmt::format("{} {}", command, id));
  check_cleared(lmp, fmt::format("{} {}", command, id), this);
  check_group(lmp, fmt::format("{} {} touches", command, id), this);
  LostState::warn(
      lmp, this,
      "springs of contacts with this wall, its bridges and its counts are gone, and one "
      "that moves is in its first place");
  warn_of_same_walls();
  frozen = frozen_groups(lmp);
  motion.init(id);
  rebuild = true;    // atoms may have come, gone or moved since the last run
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

  check_particles();
}

// The smallest and lightest particle, there or to come, decides about overlap and time step.
void FixWallLevelset::check_particles()
{
  const auto sizes = TypeSizes::find(lmp, command, igroup);
  const double r = sizes.smallest_radius(), m = sizes.smallest_mass();
  overlap_at_rest = 0.0;
  check_borders(sizes.largest_radius());
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
  const apf::WetContact wet_contact{coefficient.bridge, coefficient.model};
  std::set<double> contact_radii;    // one message for all surfaces of the same
  apf::StiffestMode stiffest;
  for (const auto &surface : surfaces) {
    const auto bodies = bodies_at(surface, r, m);
    if (!contact_radii.insert(bodies.R).second) continue;
    overlap_at_rest = std::max(overlap_at_rest, apf::overlap_at_rest(wet_contact, bodies.R) / r);
    check_overlap(lmp, fmt::format("Fix wall/levelset {}", id), wet_contact, bodies.R, r);
    if (m > 0.0)    // LAMMPS's own inserters do not tell it
      stiffest = std::max(stiffest, apf::stiffest_mode(wet_contact, bodies, r));
  }
  timestep = {};
  if (step_is_given() && stiffest.frequency > 0.0)
    timestep.begin(lmp, fmt::format("Fix wall/levelset {}", id), stiffest, step_of_level());
}

// between runs, by command timestep, the integrator that was known may be gone
void FixWallLevelset::reset_dt()
{
  if (update->whichflag == 1 && step_is_given()) timestep.changed(lmp, step_of_level());
}

// Walls have no periodic images: none may be seen from beyond a periodic border.
void FixWallLevelset::check_borders(double largest)
{
  for (const auto &surface : surfaces) {
    if (surface.shape == apf::Surface::Shape::plane && domain->periodicity[surface.dim])
      error->all(FLERR, Error::NOLASTLINE,
                 "{} {}: plane needs a box that is not periodic in {}, or particles touch through "
                 "it: change_box must leave boundary f or s there",
                 command, id, "xyz"[surface.dim]);
    if (surface.shape == apf::Surface::Shape::cylinder) warn_of_borders(surface, largest);
  }
}

void FixWallLevelset::warn_of_borders(const apf::Surface &cylinder, double largest)
{
  if (comm->me != 0 || domain->triclinic) return;
  double axis[3];
  for (int c = 0; c < 3; c++) axis[c] = 0.5 * (domain->boxlo[c] + domain->boxhi[c]);
  axis[cylinder.first()] = cylinder.origin[0];
  axis[cylinder.second()] = cylinder.origin[1];
  if (motion.pose.moves) {
    const double y[3] = {axis[0], axis[1], axis[2]};
    motion.pose.to_space(y, axis);
  }
  const bool inside = cylinder.side < 0.0;
  const double reach = cylinder.radius + (inside ? 0.0 : largest);
  std::string borders;
  for (const int c : {cylinder.first(), cylinder.second()})
    for (const double side : {-1.0, 1.0}) {
      const double border = side < 0.0 ? domain->boxlo[c] : domain->boxhi[c];
      if (domain->periodicity[c] && side * (border - axis[c]) <= reach)
        borders += fmt::format("{}{} = {:.6g}", borders.empty() ? "" : ", ", "xyz"[c], border);
    }
  if (borders.empty()) return;
  error->warning(
      FLERR, "{} {}: the cylinder {} the periodic border {}, {}; use boundary f, or {}", command,
      id, inside ? "around the fluid reaches" : "comes within a particle's radius of", borders,
      inside ? "through which particles pass or touch" : "beyond which particles do not meet it",
      inside ? "a box that the cylinder lies in" : "move it away from the border");
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
  const double of_bridges = wet ? coefficient.bridge.longest(largest) : 0.0;
  const double now[4] = {smallest, largest, allowed, of_bridges};
  if (std::equal(now, now + 4, checked_for)) return;
  std::copy(now, now + 4, checked_for);
  grid->check(surfaces, smallest, largest, allowed);
  if (wet) grid->check_bridges(surfaces, smallest, largest + of_bridges);
}

// The same surface in two fixes counts twice for particles of both groups.
void FixWallLevelset::warn_of_same_walls()
{
  const auto names = surface_names(surfaces, grid.get());
  bool later = false;
  for (const auto &fix : modify->get_fix_by_style("^wall/levelset")) {
    const auto *other = dynamic_cast<FixWallLevelset *>(fix);
    const bool before = later;
    later = later || fix == this;
    if (!other || !before || !motion.same_as(other->motion)) continue;
    const auto others = surface_names(other->surfaces, other->grid.get());
    std::string same;
    for (size_t s = 0; s < surfaces.size(); s++)
      for (size_t t = 0; t < other->surfaces.size(); t++)
        if (grid ? other->grid && grid->name() == other->grid->name() && names[s] == others[t]
                 : surfaces[s].same_as(other->surfaces[t]))
          same += (same.empty() ? "" : ", ") + names[s];
    if (same.empty() || !shares_atoms(other) || comm->me != 0) continue;
    error->warning(
        FLERR,
        "{} {} and fix {} are the same wall ({}) for the same particles, which it "
        "touches twice, with twice the force: give one fix only, or groups that share no "
        "particle",
        command, id, other->id, same);
  }
}

// ... now, or when particles enter
bool FixWallLevelset::shares_atoms(const Fix *other) const
{
  int mine = igroup == other->igroup, all;
  for (int i = 0; i < atom->nlocal; i++)
    mine |= atom->mask[i] & groupbit && atom->mask[i] & other->groupbit;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all;
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

std::string FixWallLevelset::of_file() const
{
  return grid ? " of file " + grid->name() : "";
}

// Particles that were put into the wall or behind it: named here, where a run begins, since what
// comes of them in it looks like something else.
void FixWallLevelset::check_places()
{
  if (rebuild) find_again();
  constexpr double much = 0.1;    // of the radius
  NamedAtoms behind, pressed;
  double space[3];
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double r = atom->radius[i], *y = in_frame(atom->x[i], space);
    double least = r;    // distance of the nearest surface that holds no contact yet
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
      if (!(touched[i] >> s & 1) && !surfaces[s].farther(y, least))
        least = std::min(least, surfaces[s].distance(y));
    const double overlap = (r - least) / r;
    if (least <= 0.0)
      behind.add(atom->tag[i], 0.0 - least);    // no -0
    else if (overlap > much && overlap > 2.0 * overlap_at_rest)
      pressed.add(atom->tag[i], overlap);
  }
  const char *cure =
      "let the region of create_atoms end a radius before the wall, or take them out "
      "with delete_atoms";
  behind.gather(world);
  if (behind.number() > 0)
    error->all(FLERR, Error::NOLASTLINE,
               "{} {}: particles with the centre outside the fluid: {} (IDs {}), up to {:.3g} "
               "behind the wall; is the wall{} where it should be, and the fluid on its right "
               "side? If so, {}",
               command, id, behind.number(), behind.ids(), behind.deepest(), of_file(), cure);
  pressed.gather(world);
  if (pressed.number() > 0 && comm->me == 0)
    error->warning(FLERR,
                   "{} {}: particles that begin inside the wall and will be shot out of it: {} "
                   "(IDs {}), up to {:.3g} of their radius deep; {}",
                   command, id, pressed.number(), pressed.ids(), pressed.deepest(), cure);
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::setup(int vflag)
{
  FixContacts::setup(vflag);
  check_places();
  if (auto *respa = dynamic_cast<Respa *>(update->integrate)) {
    respa->copy_flevel_f(level());
    post_force(vflag);
    respa->copy_f_flevel(level());
  } else
    post_force(vflag);
}

void FixWallLevelset::min_setup(int vflag)
{
  check_places();
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
  guard.require(this);
  v_init(vflag);
  if (rebuild) find_again();
  ledger.move_regions();
  const auto times = lender ? lender->times() : take_velocities();
  if (lender) recall_due(times);
  if (update->setupflag) {
    if (times.behind > 0.0)
      motion.pose.recall_motion();
    else
      motion.take_speeds();
  }
  motion.pose.advance(times.advance);
  contacts_change();
  const int before = contacts.size();
  if (wet) {
    bridges.measure_films();
    bridges.detect(times.advance);
  }
  detect();
  share_masses();
  gather(true);
  const bool goes_on = !due.empty();
  const int ended = add_forces(times, before);
  const int ruptured = wet ? bridges.add_forces(times, due) : 0;
  ledger.clear_loads();
  loads_summed = bridge_loads_summed = settled = false;
  tally(rows, contacts.source, surface_of);
  if (wet) {
    return_loads(bridges.copies(), bridges.atoms());
    tally(bridges.copies(), bridges.atoms(), bridges.surfaces());
  }
  if (goes_on) add_due();
  if (ended) remove_ended(false);
  if (ruptured) bridges.remove_ruptured(false);
  motion.pose.remember_motion();
  motion.take_speeds();
}
