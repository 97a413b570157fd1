// What pair style granular/adhesive takes from the script, and what it cannot work with.

#include "pair_granular_adhesive.h"

#include "atom.h"
#include "comm.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "fix_contact_history.h"
#include "force.h"
#include "math_extra.h"
#include "memory.h"
#include "modify.h"
#include "named_atoms.h"
#include "neighbor.h"
#include "particle_checks.h"

#include "timestep/first_touch.h"
#include "update.h"

#include <algorithm>
#include <stdexcept>

using namespace LAMMPS_NS;

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
  guard.forget();

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
  check_direction(lmp, "Pair granular/adhesive");
  check_box_rates(lmp, "Pair granular/adhesive");
  neighbor->add_request(this, NeighConst::REQ_SIZE);

  find_special_bodies();

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
  store->lost.note(modify);
  sizes = TypeSizes::find(lmp, "Pair granular/adhesive");
  check_scene(lmp, "Pair granular/adhesive", 2.0 * sizes.largest_radius());
  neck_max = reach_max = 0.0;    // init_one finds them
  wet = false;
  contacts.kinds.forget();
  bridges.init();
  choice = apf::KernelChoice();
  choice.planar = domain->dimension == 2;
}

// frozen particles, and those of rigid bodies
void PairGranularAdhesive::find_special_bodies()
{
  const auto freezes = modify->get_fix_by_style("^freeze");
  if (freezes.size() > 1)
    error->all(FLERR, Error::NOLASTLINE, "Pair granular/adhesive allows one fix freeze, got {}",
               freezes.size());
  freeze_group_bit = frozen_groups(lmp);

  rigid = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (fix->rigid_flag) {
      if (rigid)
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair granular/adhesive allows one fix rigid, got {} and {}", rigid->id,
                   fix->id);
      rigid = fix;
    }
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
    const apf::WetContact wet{coefficients[i][j].bridge, model};
    if (a / B < b / A)
      check_overlap(lmp, who, wet, a * B / (a + B), a);
    else
      check_overlap(lmp, who, wet, A * b / (A + b), b);
  }
  return ri + rj + reach;
}

// Returns how far bridges between two types reach.
double PairGranularAdhesive::init_bridge(int i, int j, double ri, double rj)
{
  const auto &model = coefficients[i][j].bridge;
  if (!model.present()) return 0.0;
  wet = true;
  bridges.include(model);
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
  guard.prepared();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = 1; j <= atom->ntypes; j++)
      if (store->keeps_liquid() && coefficients[i][j].bridge.present() &&
          !coefficients[i][j].bridge.inventory())
        error->all(FLERR, Error::NOLASTLINE,
                   "Pair granular/adhesive keyword inventory must be given for all pairs of types "
                   "with bridges or for none; types {} {} have none",
                   i, j);
  if (update->whichflag == 2 && has_springs() && comm->me == 0)
    error->warning(FLERR,
                   "Pair granular/adhesive: springs of sliding, twisting and rolling do not follow "
                   "particles that a minimiser moves, so that energy may rise: let a damped run "
                   "come to rest, or minimise with pair_coeff without friction");
  const std::array lists = {neighbor->delay, neighbor->every, neighbor->build_once};
  if (update->whichflag == 1 && update->nsteps > 0 && lists != lists_told &&
      utils::strmatch(update->integrate_style, "^verlet") &&
      modify->get_fix_by_style("^nve/sphere/mts").empty()) {
    check_list_age(lmp, "Pair granular/adhesive");
    lists_told = lists;
  }
  timestep = {};
  if (store->step_is_given())
    timestep.begin(lmp, "Pair granular/adhesive", stiffest_possible(), store->step_of_level());
}

// between runs, by command timestep, the integrator that was known may be gone
void PairGranularAdhesive::reset_dt()
{
  if (update->whichflag == 1 && store->step_is_given())
    timestep.changed(lmp, store->step_of_level());
}

// Particles that overlap where a run begins, and have no contact yet: what comes of them looks like
// something else.
void PairGranularAdhesive::check_places()
{
  NamedAtoms together, pressed;
  for (int k = 0; k < candidates.size(); k++) {
    if (candidates.closed[k]) continue;
    const int i = candidates.i[k], j = candidates.j[k];
    double d[3];
    MathExtra::sub3(atom->x[i], atom->x[j], d);
    const double distance = MathExtra::len3(d), smaller = MIN(atom->radius[i], atom->radius[j]);
    const double overlap = candidates.touch[k] - distance;
    if (distance == 0.0)
      together.add(atom->tag[i], overlap);
    else if (apf::inside_each_other(overlap, smaller, overlap_at_rest(i, j)))
      pressed.add(atom->tag[i], overlap / smaller);
  }
  together.gather(world);
  if (together.number() > 0)
    error->all(
        FLERR, Error::NOLASTLINE,
        "Pair granular/adhesive: pairs of particles at one place, between which no direction "
        "is: {} (of IDs {}); delete_atoms overlap takes one of each out",
        together.number(), together.ids());
  pressed.gather(world);
  if (pressed.number() > 0 && comm->me == 0)
    error->warning(
        FLERR,
        "Pair granular/adhesive: pairs that begin inside each other and will be shot "
        "apart: {} (of IDs {}), up to {:.3g} of the smaller radius deep; place particles "
        "apart, as create_atoms with overlap does, or take one of each out with "
        "delete_atoms overlap",
        pressed.number(), pressed.ids(), pressed.deepest());
}

double PairGranularAdhesive::overlap_at_rest(int i, int j) const
{
  const auto &coeff = coeff_of(i, j);
  const double ri = atom->radius[i], rj = atom->radius[j];
  return apf::overlap_at_rest({coeff.bridge, coeff.model}, ri * rj / (ri + rj));
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
      const auto &coeff = coefficients[i][j];
      worst = std::max(worst,
                       apf::stiffest_mode({coeff.bridge, coeff.model}, bodies, std::min(ri, rj)));
    }
  return worst;
}
