#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "atom_rows.h"
#include "box_images.h"
#include "comm.h"
#include "error.h"
#include "fix_contact_history.h"
#include "fix_flow_force.h"
#include "math_extra.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using namespace FixConst;

// LAMMPS's arrays of what moves a particle that nothing touches
struct FixNVESphereMTS::FreeMotion {
  double (*x)[3], (*v)[3], (*omega)[3];
  const double (*f)[3], (*torque)[3], *radius, *mass;

  explicit FreeMotion(const Atom *atom) :
      x(rows_of(atom->x)), v(rows_of(atom->v)), omega(rows_of(atom->omega)), f(rows_of(atom->f)),
      torque(rows_of(atom->torque)), radius(atom->radius), mass(atom->rmass)
  {
  }
};

/* ---------------------------------------------------------------------- */

FixNVESphereMTS::~FixNVESphereMTS()
{
  atom->delete_callback(id, Atom::GROW);
}

int FixNVESphereMTS::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | PRE_EXCHANGE | PRE_NEIGHBOR | POST_NEIGHBOR |
      POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::setup(int)
{
  guard.prepared();
  foresight.begin_run();
  begin_totals();
  int held_that_move = 0;
  for (int i = 0; i < atom->nlocal; i++)
    held_that_move |= !(atom->mask[i] & groupbit) && MathExtra::lensq3(atom->v[i]) > 0.0;
  MPI_Allreduce(MPI_IN_PLACE, &held_that_move, 1, MPI_INT, MPI_MAX, world);
  if (held_that_move && comm->me == 0)
    error->warning(FLERR,
                   "{} {}: particles outside its group have velocities, which contacts take for "
                   "true though these particles stand still: set them to 0",
                   command, id);
}

// In a run's first step, when the fixes that come after this one have been set up as well.
void FixNVESphereMTS::find_slow_largest()
{
  foresight.gather_loads();
  slow_largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    slow_largest = std::max(slow_largest, slow_of(i).mean_acceleration(atom->v[i], update->dt));
}

/* ---------------------------------------------------------------------- */

double FixNVESphereMTS::collision_step() const
{
  return update->dt / n_collision;
}

double FixNVESphereMTS::largest_step(const apf::StiffestMode &mode) const
{
  if (fixed_steps) return collision_step();
  return std::min(collision_step(), apf::largest_stable_kappa / mode.frequency);
}

double FixNVESphereMTS::step_of(int i) const
{
  return activity[i] == apf::FREE ? update->dt : collision_step();
}

/* ----------------------------------------------------------------------
   the particle step: all but the forces at its end
------------------------------------------------------------------------- */

void FixNVESphereMTS::initial_integrate(int /*vflag*/)
{
  guard.require(this);
  history->require_lists();
  if (run_totals.particle_steps == 0) find_slow_largest();
  if (foresight.look(slow_largest)) next_reneighbor = update->ntimestep;
  choose_steps();
  fit_due();

  drift_free();
  sub_step_active();
  std::copy_n(foresight.ahead.activity.begin(), atom->nlocal + atom->nghost, activity.begin());
}

/* ----------------------------------------------------------------------
   Lists and forces at the end of a step are those of the box at its end, to which fix deform brings
   it only after them: else a run that begins, whose box is where it is, would see images jump. In a
   box that changes lists are made at each step.
------------------------------------------------------------------------- */

void FixNVESphereMTS::pre_exchange()
{
  if (foresight.box_lag() == 0.0) return;
  std::copy_n(atom->image, atom->nlocal, image_before.begin());
  std::copy_n(&domain->h[3], 3, tilts_before);
}

// Of a pair that is seen across a boundary from both sides LAMMPS's list keeps one. Which one, is
// decided in a triclinic box by where the two are, in an orthogonal one by the bins they are in,
// which match from both sides in the box as it is only.
void FixNVESphereMTS::pre_neighbor()
{
  if (domain->triclinic) go_with_box();
}

void FixNVESphereMTS::post_neighbor()
{
  if (!domain->triclinic) go_with_box();
  foresight.list_was_built();
  foresight.share(activity);    // ghosts are new
}

void FixNVESphereMTS::go_with_box()
{
  const double lag = foresight.box_lag();
  if (lag == 0.0) return;
  // what has been wrapped has gone along vectors of the box as it is; flags that change with a flip
  // of the box do not tell of that
  if (std::equal(tilts_before, tilts_before + 3, &domain->h[3]))
    for (int i = 0; i < atom->nlocal; i++) {
      int now[3], before[3];
      wraps_of(atom->image[i], now);
      wraps_of(image_before[i], before);
      const double n[3] = {double(now[0] - before[0]), double(now[1] - before[1]),
                           double(now[2] - before[2])};
      double rate[3];
      sum_of_box_vectors(n, domain->h_rate, rate);
      for (int c = 0; c < 3; c++) atom->x[i][c] -= lag * rate[c];
    }
  foresight.move_images(lag);
}

// Every particle gets the kick of half the step with which it moved last.
void FixNVESphereMTS::final_integrate()
{
  foresight.gather_loads();
  const double half = 0.5 * collision_step();
  const FreeMotion motion(atom);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (activity[i] == apf::FREE)
      kick_free(motion, i, half);
    else
      kick_atom(i, half);
  }
  end_slow_kicks();
}

/* ----------------------------------------------------------------------
   number of collision steps: as the script says, or omega dt <= kappa for the stiffest mode of all
   contacts that there are or may be within the step
------------------------------------------------------------------------- */

void FixNVESphereMTS::choose_steps()
{
  apf::Stiffest stiffest;
  stiffest.rule = rule;
  stiffest.step = update->dt;
  stiffest.extra = foresight.ahead.extra;
  stiffest.strike = foresight.ahead.strike();
  stiffest.acceleration = foresight.ahead.acceleration.data();
  stiffest.v45 = std::pow(foresight.ahead.fastest, 0.8);
  for (auto *keeper : keepers) keeper->find_stiffest(stiffest);
  struct {
    double demand2;
    int mode;
  } mine{stiffest.demand2, stiffest.mode}, all;
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE_INT, MPI_MAXLOC, world);
  const double demand = std::sqrt(all.demand2);
  double frequency2;
  MPI_Allreduce(&stiffest.frequency2, &frequency2, 1, MPI_DOUBLE, MPI_MAX, world);
  if (!fixed_steps) {
    const double n = std::ceil(demand * update->dt);
    if (n > too_many) refuse_steps(n, stiffest);
    n_collision = std::max(1, static_cast<int>(n));
  }

  kappa_now = std::sqrt(frequency2) * collision_step();

  auto &run = run_totals;
  run.fewest = run.particle_steps ? std::min(run.fewest, n_collision) : n_collision;
  run.most = std::max(run.most, n_collision);
  run.kappa = std::max(run.kappa, kappa_now);
  run.particle_steps++;
  run.collision_steps += n_collision;
  all_collision_steps += n_collision;
  active_now = 0;
  atoms_now = atom->nlocal;
  for (int i = 0; i < atom->nlocal; i++) active_now += !foresight.free(i);
  run.active += active_now;
  run.atoms += atoms_now;
  if (demand >= run.finest) {
    run.finest = demand;
    run.mode = apf::mode_names[all.mode];
  }
}

/* ----------------------------------------------------------------------
   The impulse that is due where contacts have just been made or ended stands in the last forces as
   a force for the length of that collision step, and half of it has acted. Where steps are of
   another length now, another force gives the other half.
------------------------------------------------------------------------- */

void FixNVESphereMTS::fit_due()
{
  const double more = 2.0 * history->times().behind / collision_step() - 1.0;
  if (more == 0.0) return;
  int any = 0;
  for (const auto *keeper : keepers) any |= keeper->has_due();
  MPI_Allreduce(MPI_IN_PLACE, &any, 1, MPI_INT, MPI_MAX, world);
  if (!any) return;
  const double no_torque[3] = {};
  for (auto *keeper : keepers) {
    const auto loads = keeper->due_loads();
    for (int i = 0; i < atom->nlocal; i++) {
      const double *load = &loads[3 * i];
      if (load[0] == 0.0 && load[1] == 0.0 && load[2] == 0.0) continue;
      const double f[3] = {more * load[0], more * load[1], more * load[2]};
      history->bodies().add_load(i, f, no_torque);
      const double share = contact_share(i);
      for (int c = 0; c < 3; c++) atom->f[i][c] += share * f[c];
    }
  }
}

/* ----------------------------------------------------------------------
   what acts on atom i besides contacts; `all`: with these, as forces stand in f and torque
------------------------------------------------------------------------- */

apf::Slow FixNVESphereMTS::slow_of(int i, bool all) const
{
  apf::Slow slow;
  if (atom->mask[i] & freeze_group_bit || !(atom->mask[i] & groupbit)) return slow;
  const double r = atom->radius[i], m = atom->rmass[i];
  double load[3] = {}, torque[3] = {};
  if (!all) history->bodies().add_load_to(i, load, torque);
  slow.inv_mass = contact_share(i) / m;
  slow.inv_inertia = 2.5 / (m * r * r);
  for (int c = 0; c < 3; c++) {
    slow.a[c] = atom->f[i][c] / m - slow.inv_mass * load[c];
    slow.alpha[c] = slow.inv_inertia * (atom->torque[i][c] - torque[c]);
  }
  for (const auto *fluid : fluids) fluid->relax(i, slow);
  return slow;
}

// Part of a contact's force that moves atom i and stands in f; the rest moves fluid (added mass).
double FixNVESphereMTS::contact_share(int i) const
{
  double share = 1.0;
  for (const auto *fluid : fluids) share *= fluid->share(i);
  return share;
}

// the kick of all forces as they stand in f and torque
void FixNVESphereMTS::kick_atom(int i, double time)
{
  const auto kick = apf::Kick<apf::SpaceRow>::of(slow_of(i, true), time);
  apf::SpaceRow row{};
  std::copy_n(atom->v[i], 3, row.v);
  std::copy_n(atom->omega[i], 3, row.omega);
  kick.apply(row);
  std::copy_n(row.v, 3, atom->v[i]);
  std::copy_n(row.omega, 3, atom->omega[i]);
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::drift_free()
{
  const double dt = update->dt;
  const FreeMotion motion(atom);
  for (int i = 0; i < atom->nlocal; i++) {
    if (!foresight.free(i) || !(atom->mask[i] & groupbit)) continue;
    if (activity[i] == apf::FREE)
      kick_free(motion, i, 0.5 * dt);
    else
      kick_atom(i, 0.5 * dt);    // f has the resistance of a collision step
    for (int c = 0; c < 3; c++) motion.x[i][c] += dt * motion.v[i][c];
  }
}

// Half a step of velocity Verlet; flow/force's resistance is meant for it. A contact that nobody
// foresaw gives both its bodies a kick as long as it says.
void FixNVESphereMTS::kick_free(const FreeMotion &motion, int i, double load_time)
{
  const double r = motion.radius[i], time = 0.5 * update->dt;
  const double linear = 1.0 / motion.mass[i], angular = 2.5 * linear / (r * r);
  double *v = motion.v[i], *omega = motion.omega[i];
  for (int c = 0; c < 3; c++) {
    v[c] += linear * time * motion.f[i][c];
    omega[c] += angular * time * motion.torque[i][c];
  }
  if (!history->bodies().may_have_load(i)) return;
  double load[3] = {}, moment[3] = {};
  history->bodies().add_load_to(i, load, moment);
  const double more = load_time - time, share = contact_share(i);
  for (int c = 0; c < 3; c++) {
    v[c] += linear * more * share * load[c];
    omega[c] += angular * more * moment[c];
  }
}

/* ----------------------------------------------------------------------
   Slow forces have acted as they were at the begin of the step. What they have changed by since
   acts half a step long, as in velocity Verlet: else a force that varies in space, as a spring's,
   would bring energy in every step.
------------------------------------------------------------------------- */

void FixNVESphereMTS::end_slow_kicks()
{
  slow_largest = 0.0;
  const double dt = update->dt, half = 0.5 * collision_step();
  auto time_left = [&](double rate) {    // the last kick had the new forces
    return std::max(0.0, dt * apf::ramp_decay(dt * rate) - half * apf::mean_decay(half * rate));
  };
  for (int i = 0; i < atom->nlocal; i++) {
    if (activity[i] == apf::FREE || !(atom->mask[i] & groupbit)) continue;
    const auto now = slow_of(i);
    if (now.inv_mass > 0.0)
      slow_largest = std::max(slow_largest, now.mean_acceleration(atom->v[i], dt));
    const double time = time_left(now.rate), spin_time = time_left(now.spin_rate);
    for (int c = 0; c < 3; c++) {
      atom->v[i][c] += time * (now.a[c] - slow_before[i][c]);
      atom->omega[i][c] += spin_time * (now.alpha[c] - slow_before[i][3 + c]);
    }
  }
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::grow_arrays(int nmax)
{
  activity.resize(nmax, apf::FREE);
  slow_before.resize(nmax);
  image_before.resize(nmax);
}

void FixNVESphereMTS::copy_arrays(int i, int j, int /*delflag*/)
{
  activity[j] = activity[i];
  slow_before[j] = slow_before[i];
  image_before[j] = image_before[i];
}

void FixNVESphereMTS::set_arrays(int i)
{
  activity[i] = apf::FREE;
  image_before[i] = atom->image[i];
}

int FixNVESphereMTS::pack_exchange(int i, double *buf)
{
  buf[0] = activity[i];
  std::copy(slow_before[i].begin(), slow_before[i].end(), buf + 1);
  buf[7] = ubuf(image_before[i]).d;
  return 8;
}

int FixNVESphereMTS::unpack_exchange(int i, double *buf)
{
  activity[i] = static_cast<char>(buf[0]);
  std::copy_n(buf + 1, 6, slow_before[i].begin());
  image_before[i] = static_cast<imageint>(ubuf(buf[7]).i);
  return 8;
}
