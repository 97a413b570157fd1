// Keywords of fix flow/force, and what it checks before a run.

#include "fix_flow_force.h"

#include "argument_reader.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_concentration.h"
#include "fix_flow_field.h"
#include "force.h"
#include "given_once.h"
#include "math_const.h"
#include "modify.h"
#include "particle_checks.h"
#include "type_sizes.h"
#include "update.h"

#include "flow/di_felice.h"
#include "flow/relaxation.h"
#include "flow/schiller_naumann.h"
#include "flow/stokes.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void FixFlowForce::parse(int narg, char **arg)
{
  const struct {
    const char *word;
    int nvalues;
    int (FixFlowForce::*parse)(int, int, char **);
  } keywords[] = {{"drag", 1, &FixFlowForce::parse_drag},
                  {"torque", 1, &FixFlowForce::parse_switch},
                  {"gravity", 3, &FixFlowForce::parse_gravity},
                  {"lift", 1, &FixFlowForce::parse_lift},
                  {"magnus", 1, &FixFlowForce::parse_switch},
                  {"added_mass", 1, &FixFlowForce::parse_switch},
                  {"pressure", 1, &FixFlowForce::parse_switch},
                  {"brownian", 2, &FixFlowForce::parse_brownian},
                  {"cunningham", 1, &FixFlowForce::parse_cunningham},
                  {"concentration", 1, &FixFlowForce::parse_concentration},
                  {"peratom", 1, &FixFlowForce::parse_switch},
                  {"feedback", 1, &FixFlowForce::parse_feedback}};
  GivenOnce given(lmp, command);
  int iarg = 4;
  while (iarg < narg) {
    const std::string word = arg[iarg];
    given.add(word, iarg);
    int next = 0;
    for (const auto &keyword : keywords) {
      if (word != keyword.word) continue;
      if (iarg + keyword.nvalues >= narg)
        utils::missing_cmd_args(FLERR, "fix flow/force " + word, error);
      next = (this->*keyword.parse)(iarg, narg, arg);
    }
    if (!next)
      error->all(FLERR, iarg,
                 "Fix flow/force keyword must be drag, torque, gravity, lift, magnus, added_mass, "
                 "pressure, brownian, cunningham, concentration, peratom or feedback, got {}",
                 word);
    iarg = next;
  }
  if (model.drag == apf::FluidModel::NONE)
    error->all(FLERR, "Fix flow/force requires keyword drag");
  const bool concentrated = concentration >= 0.0 || cloud;
  if (model.hindered() && !concentrated)
    error->all(FLERR, "Fix flow/force drag difelice requires keyword concentration");
  if (!model.hindered() && concentrated && !feedback)
    error->all(FLERR,
               "Fix flow/force keyword concentration goes with drag difelice or feedback yes only, "
               "got drag {}",
               model.drag == apf::FluidModel::STOKES ? "stokes" : "schiller");
}

/* ----------------------------------------------------------------------
   parse a keyword at iarg, which has its values; return index of the next one
------------------------------------------------------------------------- */

int FixFlowForce::parse_drag(int iarg, int narg, char **arg)
{
  using Model = apf::FluidModel;
  constexpr Model::Drag laws[] = {Model::STOKES, Model::SCHILLER, Model::DI_FELICE};
  const ArgumentReader reader(lmp, command, arg);
  model.drag = laws[reader.choice(iarg + 1, "drag", {"stokes", "schiller", "difelice"})];
  const bool superficial = model.drag == Model::DI_FELICE && iarg + 2 < narg &&
      strcmp(arg[iarg + 2], "superficial") == 0;
  if (superficial) model.drag = Model::DI_FELICE_SUPERFICIAL;
  return iarg + (superficial ? 3 : 2);
}

int FixFlowForce::parse_switch(int iarg, int /*narg*/, char **arg)
{
  const std::string word = arg[iarg];
  bool &which = word == "torque" ? model.torque
      : word == "magnus"         ? model.magnus
      : word == "added_mass"     ? model.added_mass
      : word == "peratom"        ? per_atom
                                 : model.pressure;
  which = ArgumentReader(lmp, command, arg).yes(iarg + 1, word);
  return iarg + 2;
}

int FixFlowForce::parse_lift(int iarg, int /*narg*/, char **arg)
{
  ArgumentReader(lmp, command, arg).choice(iarg + 1, "lift", {"saffman"});
  model.lift = true;
  return iarg + 2;
}

int FixFlowForce::parse_gravity(int iarg, int /*narg*/, char **arg)
{
  const ArgumentReader reader(lmp, command, arg);
  model.gravity.x = reader.number(iarg + 1, "gravity");
  model.gravity.y = reader.number(iarg + 2, "gravity");
  model.gravity.z = reader.number(iarg + 3, "gravity");
  if (domain->dimension == 2 && model.gravity.z != 0.0)
    error->all(FLERR, iarg + 3,
               "Fix flow/force gravity along z must be 0 in a 2d simulation, got {}",
               arg[iarg + 3]);
  model.weight = true;
  return iarg + 4;
}

int FixFlowForce::parse_brownian(int iarg, int /*narg*/, char **arg)
{
  const ArgumentReader reader(lmp, command, arg);
  const double temperature = reader.number(iarg + 1, "brownian temperature", Range::from(0.0));
  const int seed = reader.integer(iarg + 2, "brownian seed", Range::above(0));
  if (!atom->tag_enable) error->all(FLERR, iarg, "Fix flow/force brownian requires atom IDs");
  model.brownian = true;
  time_depend = 1;    // else reset_timestep would bring the same random numbers again
  model.kT = force->boltz * temperature;
  model.seed = static_cast<std::uint32_t>(seed);
  return iarg + 3;
}

int FixFlowForce::parse_cunningham(int iarg, int /*narg*/, char **arg)
{
  model.mean_free_path = ArgumentReader(lmp, command, arg)
                             .number(iarg + 1, "cunningham mean free path", Range::above(0.0));
  return iarg + 2;
}

int FixFlowForce::parse_concentration(int iarg, int /*narg*/, char **arg)
{
  if (!utils::is_double(arg[iarg + 1])) {
    concentration_id = arg[iarg + 1];
    cloud = find_concentration(iarg + 1);
    return iarg + 2;
  }
  concentration = ArgumentReader(lmp, command, arg)
                      .number(iarg + 1, "concentration", Range::from(0.0, apf::max_concentration));
  return iarg + 2;
}

// yes: on the grid of fix flow/concentration; NX NY NZ: on one of its own
int FixFlowForce::parse_feedback(int iarg, int narg, char **arg)
{
  const std::string value = arg[iarg + 1];
  if (value == "no") return iarg + 2;
  if (value == "yes") {
    if (!cloud)
      error->all(FLERR, iarg + 1,
                 "Fix flow/force feedback yes takes the grid of fix flow/concentration: name that "
                 "with keyword concentration before it, or write feedback NX NY NZ; got {}",
                 concentration >= 0.0 ? fmt::format("concentration {}", concentration) : "none");
    feedback = std::make_unique<FlowFeedback>(lmp, this, cloud->cells());
    return iarg + 2;
  }
  if (!utils::is_integer(value))
    error->all(FLERR, iarg + 1,
               "Fix flow/force feedback must be yes, no or numbers of cells, got {}", value);
  if (iarg + 4 > narg) utils::missing_cmd_args(FLERR, "fix flow/force feedback", error);
  std::array<int, 3> cells;
  const ArgumentReader reader(lmp, command, arg);
  for (int c = 0; c < 3; c++)
    cells[c] = reader.integer(iarg + 1 + c, "feedback number of cells", Range::from(1));
  if (domain->dimension == 2 && cells[2] != 1)
    error->all(FLERR, iarg + 3,
               "Fix flow/force feedback number of cells must be 1 along z in a 2d simulation, got "
               "{}",
               arg[iarg + 3]);
  check_orthogonal(lmp, "Fix flow/force feedback needs", iarg);
  feedback = std::make_unique<FlowFeedback>(lmp, this, cells);
  return iarg + 4;
}

FixFlowConcentration *FixFlowForce::find_concentration(int iarg)
{
  auto *fix = modify->get_fix_by_id(concentration_id);
  if (!fix)
    error->all(FLERR, iarg, "Fix flow/force concentration fix {} does not exist", concentration_id);
  auto *result = dynamic_cast<FixFlowConcentration *>(fix);
  if (!result)
    error->all(FLERR, iarg,
               "Fix flow/force concentration fix {} must be of style flow/concentration, got {}",
               concentration_id, fix->style);
  return result;
}

/* ---------------------------------------------------------------------- */

FixFlowField *FixFlowForce::find_field(int iarg)
{
  auto *fix = modify->get_fix_by_id(field_id);
  if (!fix) error->all(FLERR, iarg, "Fix flow/force field fix {} does not exist", field_id);
  auto *result = dynamic_cast<FixFlowField *>(fix);
  if (!result)
    error->all(FLERR, iarg, "Fix flow/force field fix {} must be of style flow/field, got {}",
               field_id, fix->style);
  return result;
}

/* ---------------------------------------------------------------------- */

namespace {
// A density that no matter has: osmium is the heaviest, 2.26e4 kg/m^3. In units lj it is some
// number of diameters, and the density of particles of the order of 1.
double heaviest_matter(const std::string &units)
{
  constexpr double si = 2.5e4;    // [kg/m^3]
  if (units == "cgs") return 1.0e-3 * si;
  if (units == "micro") return 1.0e-3 * si;    // picogram / micrometer^3
  if (units == "nano") return 1.0e-6 * si;     // attogram / nanometer^3
  return si;
}
}    // namespace

void FixFlowForce::check_particles()
{
  const double *radius = atom->radius;
  const int *mask = atom->mask;
  int points = 0;
  double densest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double r = radius[i];
    if (r == 0.0) points++;
    if (r > 0.0)
      densest = MAX(densest, atom->rmass[i] / (4.0 / 3.0 * MathConst::MY_PI * r * r * r));
  }
  int points_all;
  MPI_Allreduce(&points, &points_all, 1, MPI_INT, MPI_SUM, world);
  if (points_all)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix flow/force requires particles of radius > 0, got {} of radius 0", points_all);
  TypeSizes::find(lmp, command, igroup);    // refuses sizes that are no numbers

  // the mass of a sphere whose diameter was set after its density is that of the old diameter
  double densest_all;
  MPI_Allreduce(&densest, &densest_all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (densest_all > 1.0e5 * field->density && comm->me == 0)
    error->warning(FLERR,
                   "Fix flow/force {}: particles have a density of up to {:.3g}, {:.3g} times that "
                   "of the fluid, {:.3g}, of fix {}; {}",
                   id, densest_all, densest_all / field->density, field->density, field_id,
                   densest_all > heaviest_matter(update->unit_style)
                       ? "set diameter before density, as in: set group all diameter D density RHO"
                       : "are its density and viscosity in order and in the units of the input?");
}

/* ---------------------------------------------------------------------- */

bool FixFlowForce::shares_atoms(int bit) const
{
  int mine = 0, all;
  for (int i = 0; i < atom->nlocal; i++) mine |= atom->mask[i] & groupbit && atom->mask[i] & bit;
  MPI_Allreduce(&mine, &all, 1, MPI_INT, MPI_MAX, world);
  return all;
}

void FixFlowForce::warn_of_second_drag()
{
  bool later = false;
  for (const auto &fix : modify->get_fix_by_style("^flow/force")) {
    const auto *other = dynamic_cast<FixFlowForce *>(fix);
    if (other && later && shares_atoms(other->groupbit) && comm->me == 0) {
      error->warning(FLERR,
                     "Fix flow/force {} and fix {} act on the same particles, which get the drag "
                     "of both",
                     id, other->id);
      if (model.brownian && other->model.brownian && model.seed == other->model.seed)
        error->warning(FLERR,
                       "Fix flow/force {} and fix {} have the same brownian seed {}: their random "
                       "forces are not independent",
                       id, other->id, model.seed);
    }
    later = later || fix == this;
  }
}

void FixFlowForce::check_other_fixes()
{
  warn_of_second_drag();
  check_cleared(lmp, fmt::format("{} {}", command, id), this);
  if (feedback) check_orthogonal(lmp, "Fix flow/force feedback needs", Error::NOLASTLINE);
  if (model.weight && norm2(model.gravity) > 0.0)
    for (const auto &other : modify->get_fix_by_style("^gravity"))
      if (shares_atoms(other->groupbit) && comm->me == 0)
        error->warning(FLERR,
                       "Fix flow/force {}: keyword gravity and fix {} gravity both act on the same "
                       "particles: their weight counts twice",
                       id, other->id);
  if (!model.added_mass) return;
  if (utils::strmatch(update->integrate_style, "^respa"))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix flow/force {} added_mass cannot work with run_style respa: forces of other "
               "levels would move particles without the fluid that moves along; use run_style "
               "verlet, with fix nve/sphere/mts for short contacts",
               id);
  for (const auto &other : modify->get_fix_by_style("^flow/force"))
    if (other != this && shares_atoms(other->groupbit))
      error->all(FLERR, Error::NOLASTLINE,
                 "Fix flow/force {} added_mass and fix {} act on the same particles: one fix must "
                 "have all their forces",
                 id, other->id);
}

/* ----------------------------------------------------------------------
   Forces of fixes that come later take no part in the balance with the drag, and move a particle
   1/phi times as fast as they should, phi(h/tau) of relaxation.h.
------------------------------------------------------------------------- */

bool FixFlowForce::adds_forces(Fix *other) const
{
  if (!(modify->get_fix_mask(other) & FixConst::POST_FORCE) || other->time_integrate) return false;
  // under fix nve/sphere/mts particles relax together with the forces of their contacts
  if (utils::strmatch(other->style, "^wall/levelset")) return !sub_stepper;
  // those that set forces or torques, or take a part of them, and those that measure
  for (const char *style :
       {"^setforce", "^aveforce", "^lineforce", "^planeforce", "^freeze", "^enforce2d",
        "^settorque", "^add/heat", "^store/", "^numdiff", "^nonaffine", "^pair$", "^flow/force"})
    if (utils::strmatch(other->style, style)) return false;
  return model.torque || !utils::strmatch(other->style, "^addtorque/atom");
}

void FixFlowForce::warn_of_later_forces()
{
  std::string later, bodies;
  bool after = false;
  for (const auto &other : modify->get_fix_list()) {
    if (after && adds_forces(other) && (other->igroup == igroup || shares_atoms(other->groupbit)))
      later += fmt::format("{}fix {} {}", later.empty() ? "" : ", ", other->id, other->style);
    after = after || other == this;
    if (other->rigid_flag && shares_atoms(other->groupbit))
      bodies = fmt::format("fix {} {}", other->id, other->style);
  }
  if (later.empty() && bodies.empty()) return;

  double rate = 0.0;
  for_blocks([&] {
    fluid_forces(model, block->fluid, block->forces);
    for (int l = 0; l < block->forces.n; l++) rate = std::max(rate, block->forces.rate[l]);
  });
  MPI_Allreduce(MPI_IN_PLACE, &rate, 1, MPI_DOUBLE, MPI_MAX, world);
  const auto sizes = TypeSizes::find(lmp, command, igroup);    // particles to come included
  const double d = 2.0 * sizes.smallest_radius(), m = sizes.smallest_mass();
  if (rate == 0.0 && m > 0.0) rate = stokes_rate(d, m);
  const double ratio = step() * rate;
  constexpr double much = 0.1;    // forces 5 % too large
  if (ratio <= much || comm->me != 0) return;
  if (!bodies.empty())
    error->warning(FLERR,
                   "Fix flow/force {}: the timestep is up to {:.3g} times the relaxation time of "
                   "particles of {}, whose bonds take no part in the balance with the drag: bodies "
                   "settle and turn with errors, of 3 % at 0.1 where one diameter is twice the "
                   "other; timestep {:.3g} makes it 0.1",
                   id, ratio, bodies, update->dt * much / ratio);
  if (later.empty()) return;
  error->warning(FLERR,
                 "Fix flow/force {} stands before {}: the timestep is up to {:.3g} times the "
                 "relaxation time of particles, which forces of later fixes move up to {:.3g} "
                 "times as fast as they should, and where walls hold them drag is too small; "
                 "define fix flow/force after all fixes that apply forces",
                 id, later, ratio, 1.0 / apf::mean_decay(ratio));
}

/* ----------------------------------------------------------------------
   warn once per run of particles for which a law does not hold
------------------------------------------------------------------------- */

void FixFlowForce::warn_of_ranges()
{
  if (warned) return;
  const bool schiller = model.drag == apf::FluidModel::SCHILLER;
  const double limit =    // difelice multiplies Stokes's drag
      schiller ? apf::SchillerNaumannDrag::largest_reynolds : apf::StokesDrag::largest_reynolds;
  bigint mine[3] = {}, all[3];    // beyond the range of the drag, of the lift; particles
  for_blocks([&] {
    const auto &b = *block;
    const double per_nu = model.density / model.viscosity;
    for (int l = 0; l < b.forces.n; l++) {
      double slip2 = 0.0, om2 = 0.0;
      for (int c = 0; c < 3; c++) {
        const double slip = b.forces.velocity[c][l] - b.fluid.velocity[c][l];
        slip2 += slip * slip;
        if (model.lift) om2 += b.fluid.vorticity[c][l] * b.fluid.vorticity[c][l];
      }
      const double d = b.forces.diameter[l], Re = std::sqrt(slip2) * d * per_nu;
      const double Re_G = std::sqrt(om2) * d * d * per_nu;
      mine[0] += Re > limit;
      mine[1] += Re_G > 0.0 && (Re > 1.0 || Re_G > 1.0 || Re > std::sqrt(Re_G));
      mine[2]++;
    }
  });
  MPI_Allreduce(mine, all, 3, MPI_LMP_BIGINT, MPI_SUM, world);
  if (!all[0] && !all[1]) return;
  warned = true;
  if (comm->me != 0) return;
  std::string text;
  if (all[0])
    text += fmt::format("drag {} is meant for Re <= {}, exceeded by {} of {} particles",
                        schiller               ? "schiller"
                            : model.hindered() ? "difelice"
                                               : "stokes",
                        limit, all[0], all[2]);
  if (all[1])
    text += fmt::format("{}lift saffman is meant for Re <= 1, Re_G <= 1, Re <= sqrt(Re_G), not met "
                        "by {} of {} particles",
                        text.empty() ? "" : "; ", all[1], all[2]);
  error->warning(FLERR, "Fix flow/force {}, step {}: {}", id, update->ntimestep, text);
}
