// What fix nve/sphere/mts tells: the summary of a run, its global vector, restart files.

#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_contacts.h"
#include "math_const.h"
#include "restart_state.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::post_run()
{
  auto &run = run_totals;
  if (run.particle_steps == 0) return;
  bigint mine[2] = {run.active, run.atoms}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint late = late_contacts() - run.late_before;
  const double contacts = compute_vector(2);
  const bool touched = total(&FixContacts::changes_so_far) > run.changes_before;
  if (comm->me == 0)
    utils::logmesg(lmp,
                   "{} {}: {} particle steps of {:.4g}, {} collision steps, {} to {} in a particle "
                   "step\n  sub-stepped {:.1f} % of the particles, {:.0f} contacts at the end; {}; "
                   "contacts found late {}\n",
                   command, id, run.particle_steps, update->dt, run.collision_steps, run.fewest,
                   run.most, 100.0 * all[0] / std::max<bigint>(all[1], 1), contacts, finest_step(),
                   late);
  if (late > 0 && foresight.on && comm->me == 0)
    error->warning(
        FLERR,
        "{} {}: {} contacts were found late, some with far too much energy: use a smaller "
        "timestep or a larger neighbor skin, or see which command moves particles between two "
        "steps",
        command, id, late);
  constexpr double unstable_kappa = 2.0;    // of velocity Verlet
  if (fixed_steps && touched && run.kappa > unstable_kappa && comm->me == 0)
    error->warning(
        FLERR,
        "{} {}: {} collision steps are too few for impacts as fast as were in view, omega "
        "dt = {:.3g}: above {} a contact gains energy; use collision {:.0f} or more",
        command, id, fixed_steps, run.kappa, unstable_kappa, accurate_steps());
  begin_totals();    // also for a run without setup
}

// The step may be what is wrong; more often a mass is: both are told, with the contact that asks
// for so many.
void FixNVESphereMTS::refuse_steps(double n, const apf::Stiffest &here)
{
  struct {
    double value;
    int rank;
  } demand{here.demand2, comm->me}, mass{std::numeric_limits<double>::max(), comm->me};
  MPI_Allreduce(MPI_IN_PLACE, &demand, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  double contact[3] = {here.of2, here.mass, static_cast<double>(here.mode)};
  MPI_Bcast(contact, 3, MPI_DOUBLE, demand.rank, world);

  double lightest[3] = {};    // ID, type, radius
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit) || !(atom->rmass[i] < mass.value)) continue;
    mass.value = atom->rmass[i];
    lightest[0] = static_cast<double>(atom->tag[i]);
    lightest[1] = atom->type[i];
    lightest[2] = atom->radius[i];
  }
  MPI_Allreduce(MPI_IN_PLACE, &mass, 1, MPI_DOUBLE_INT, MPI_MINLOC, world);
  MPI_Bcast(lightest, 3, MPI_DOUBLE, mass.rank, world);
  const double r = lightest[2], volume = 4.0 / 3.0 * MathConst::MY_PI * r * r * r;
  error->all(FLERR, Error::NOLASTLINE,
             "{} {}: a timestep of {:.3g} takes {:.3g} collision steps, more than {}: the {} mode "
             "of a contact has omega = {:.3g}, of an effective mass of {:.3g}; the lightest "
             "particle, ID {:.0f} of type {:.0f}, has a mass of {:.3g}, a diameter of {:.3g} and a "
             "density of {:.3g}: are these, and the stiffness, in order and in units {}? If so, "
             "use timestep {:.2g} or smaller",
             command, id, update->dt, n, too_many, apf::mode_names[static_cast<int>(contact[2])],
             std::sqrt(contact[0]), contact[1], lightest[0], lightest[1], mass.value, 2.0 * r,
             mass.value / volume, update->unit_style, 0.9 * update->dt * too_many / n);
}

void FixNVESphereMTS::begin_totals()
{
  run_totals = Totals();
  run_totals.late_before = late_contacts();
  run_totals.changes_before = total(&FixContacts::changes_so_far);
}

// sum over all contacts and ranks of what their keepers count; between runs some may be gone
bigint FixNVESphereMTS::total(bigint (FixContacts::*count)() const) const
{
  bigint mine = 0, all;
  for (const auto *keeper : FixContacts::all_of(modify)) mine += (keeper->*count)();
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all;
}

bigint FixNVESphereMTS::late_contacts() const
{
  return total(&FixContacts::late_so_far) + late_before_restart;
}

// collision steps with which the stiffest contact that the run had would be accurate
double FixNVESphereMTS::accurate_steps() const
{
  return std::ceil(fixed_steps * run_totals.kappa / apf::accurate_kappa);
}

// what asked for it, or what the script's number of steps is worth and which one would be accurate
std::string FixNVESphereMTS::finest_step() const
{
  const auto &run = run_totals;
  if (!fixed_steps)
    return fmt::format("finest step set by {} mode of contacts, omega dt at most {:.2g}", run.mode,
                       run.kappa);
  if (run.kappa == 0.0) return "no contacts";
  auto text =
      fmt::format("stiffest mode of contacts {}, {:.3g} collision steps in its period, omega dt at "
                  "most {:.3g}",
                  run.mode, MathConst::MY_2PI / run.kappa, run.kappa);
  if (run.kappa > apf::accurate_kappa)
    text += fmt::format(" (collision {:.0f} gives {})", accurate_steps(), apf::accurate_kappa);
  return text;
}

/* ----------------------------------------------------------------------
   collision steps of the last particle step, fraction of atoms sub-stepped in it, contacts,
   collision steps and contacts found late since the fix was defined, largest omega dt
------------------------------------------------------------------------- */

double FixNVESphereMTS::compute_vector(int n)
{
  if (n == 0) return n_collision;
  if (n == 1) {
    // atoms may have come and gone since
    bigint mine[2] = {active_now, atoms_now}, all[2];
    MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
    return all[1] ? static_cast<double>(all[0]) / all[1] : 0.0;
  }
  if (n == 2) {
    double mine = 0.0, all;
    for (const auto *keeper : FixContacts::all_of(modify)) mine += keeper->contacts_here();
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
  }
  if (n == 3) return static_cast<double>(all_collision_steps);
  if (n == 4) return static_cast<double>(late_contacts());
  return kappa_now;
}

/* ----------------------------------------------------------------------
   fluid_every      int, particle steps of a fluid step
   substep_ghosts   int, ghosts of this rank that a collision step of the last particle step
                    brings up to date
------------------------------------------------------------------------- */

void *FixNVESphereMTS::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "fluid_every") == 0) return &fluid_every;
  if (strcmp(name, "substep_ghosts") == 0) return &substep_ghosts;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::write_restart(FILE *fp)
{
  const double late = static_cast<double>(late_contacts());
  if (comm->me != 0) return;
  RestartState::write(
      lmp, this, {static_cast<double>(n_collision), static_cast<double>(all_collision_steps), late},
      fp);
}

void FixNVESphereMTS::restart(char *buf)
{
  RestartState state(lmp, this, buf);
  const double steps = state.whole(1.0, too_many);
  if (!fixed_steps) n_collision = static_cast<int>(steps);
  all_collision_steps = static_cast<bigint>(state.whole(0.0, most_counted));
  late_before_restart = static_cast<bigint>(state.whole(0.0, most_counted));
  state.end();
}

double FixNVESphereMTS::memory_usage()
{
  return activity.capacity() + slow_before.capacity() * sizeof(slow_before[0]) +
      foresight.memory_usage() + islands.memory_usage();
}
