#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "fix_flow_force.h"
#include "force.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr const char *command = "Fix nve/sphere/mts";

// Distance looked ahead over that of the approach; LookAhead::struck has the bound for impacts.
static constexpr double lookahead_safety = 2.0;
static constexpr double big = 1.0e300;
static constexpr int too_many = 1000000;

/* ---------------------------------------------------------------------- */

FixNVESphereMTS::FixNVESphereMTS(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), exchange(world)
{
  check_spheres(lmp, command, 2);
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  create_attribute = 1;
  maxexchange = 7;
  comm_forward = 2;
  comm_reverse = 6;

  auto missing = [&](const std::string &word) {
    utils::missing_cmd_args(FLERR, "fix nve/sphere/mts " + word, error);
  };
  if (narg < 4) missing("collision");
  if (strcmp(arg[3], "collision") != 0)
    error->all(FLERR, 3, "{} begins with keyword collision, got {}", command, arg[3]);
  if (narg < 5) missing("collision");
  const std::string how = arg[4];
  int iarg = 5;
  if (how == "tolerance") {
    if (narg < 6) missing("collision tolerance");
    rule.tolerance = utils::numeric(FLERR, arg[iarg], false, lmp);
    if (!(rule.tolerance > 0.0 && rule.tolerance <= 0.08))
      error->all(FLERR, iarg, "{} collision tolerance must be in (0, 0.08], got {}", command,
                 arg[iarg]);
    iarg++;
  } else if (how != "auto") {
    fixed_steps = utils::is_integer(how) ? utils::inumeric(FLERR, arg[4], false, lmp) : 0;
    if (fixed_steps < 1 || fixed_steps > too_many)
      error->all(FLERR, 4,
                 "{} collision must be auto, tolerance T or a number of steps from 1 to {}, got {}",
                 command, too_many, arg[4]);
  }
  for (; iarg < narg; iarg += 2) {
    const std::string word = arg[iarg];
    if (word != "safety" && word != "fluid" && word != "lookahead")
      error->all(FLERR, iarg, "{} keyword must be safety, fluid or lookahead, got {}", command,
                 word);
    if (iarg + 1 == narg) missing(word);
    const char *value = arg[iarg + 1];
    if (word == "safety") {
      rule.kappa = utils::numeric(FLERR, value, false, lmp);
      if (!(rule.kappa > 0.0 && rule.kappa <= apf::largest_stable_kappa))
        error->all(FLERR, iarg + 1, "{} safety must be in (0, {}], got {}", command,
                   apf::largest_stable_kappa, value);
      if (how != "auto")
        error->all(FLERR, iarg, "{} safety goes with collision auto only, got collision {}",
                   command, how);
    } else if (word == "fluid") {
      fluid_every = utils::inumeric(FLERR, value, false, lmp);
      if (fluid_every < 1)
        error->all(FLERR, iarg + 1, "{} fluid must be >= 1, got {}", command, value);
    } else {
      lookahead = utils::logical(FLERR, value, false, lmp);
    }
  }
  if (fixed_steps) n_collision = fixed_steps;

  FixNVESphereMTS::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

FixNVESphereMTS::~FixNVESphereMTS()
{
  atom->delete_callback(id, Atom::GROW);
}

int FixNVESphereMTS::setmask()
{
  return INITIAL_INTEGRATE | FINAL_INTEGRATE | POST_NEIGHBOR | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::init()
{
  auto refuse = [&](const std::string &what, const std::string &why) {
    error->all(FLERR, Error::NOLASTLINE, "{} cannot work with {}: {}", command, what, why);
  };
  if (utils::strmatch(update->integrate_style, "^respa"))
    refuse("run_style " + std::string(update->integrate_style),
           "it sub-steps contacts by itself; use run_style verlet");
  if (update->whichflag == 2)
    refuse("minimize", "minimisers move particles without steps in time; unfix it first");
  for (const auto &fix : modify->get_fix_list())
    if (fix->time_integrate && fix != this)
      refuse(fmt::format("fix {} {}", fix->id, fix->style),
             fmt::format("its particles would stand still in collision steps; unfix {} or fix {}. "
                         "Particles outside the group of fix {} do not move",
                         fix->id, id, id));

  const auto histories = modify->get_fix_by_style("^contact/history");
  if (histories.size() != 1)
    error->all(FLERR, Error::NOLASTLINE, "{} needs one pair style granular/adhesive, got {}",
               command, histories.size());
  history = dynamic_cast<FixContactHistory *>(histories[0]);
  if (force->pair_match("^hybrid/scaled", 0))
    refuse("pair_style hybrid/scaled", "collision steps take contact forces unscaled");
  keepers.clear();
  fluids.clear();
  for (const auto &fix : modify->get_fix_list()) {
    if (auto *keeper = dynamic_cast<FixContacts *>(fix)) keepers.push_back(keeper);
    if (auto *fluid = dynamic_cast<FixFlowForce *>(fix)) fluids.push_back(fluid);
  }
  // the pair style computes first: its velocities and forces serve walls as well
  std::stable_partition(keepers.begin(), keepers.end(), [this](const FixContacts *keeper) {
    return keeper == history;
  });

  for (const auto &fix : modify->get_fix_list())
    if (utils::strmatch(fix->style, "^(set|ave)force") && comm->me == 0)
      error->warning(FLERR,
                     "{} {}: fix {} {} does not hold particles against their contacts; use fix "
                     "freeze, or leave them out of the group of fix {}",
                     command, id, fix->id, fix->style, id);

  const auto freezes = modify->get_fix_by_style("^freeze");
  freeze_group_bit = freezes.empty() ? 0 : freezes[0]->groupbit;
  if (!fixed_steps && n_collision == 1)
    n_collision = std::max(1,
                           static_cast<int>(std::ceil(
                               update->dt * history->stiffest_possible().frequency / rule.kappa)));
}

void FixNVESphereMTS::setup(int)
{
  run_totals = Totals();
  warned_of_skin = false;
  run_totals.late_before = late_contacts();
}

// In a run's first step, when the fixes that come after this one have been set up as well.
void FixNVESphereMTS::find_slow_largest()
{
  gather_loads();
  slow_largest = 0.0;
  for (int i = 0; i < atom->nlocal; i++)
    slow_largest =
        std::max(slow_largest, MathExtra::len3(slow_of(i, &values[6 * i], &values[6 * i + 3]).a));
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
   a new neighbour list: rows are new as well
------------------------------------------------------------------------- */

void FixNVESphereMTS::post_neighbor()
{
  owners_known = false;
  x_built.assign(&atom->x[0][0], &atom->x[0][0] + 3 * static_cast<size_t>(atom->nlocal));
}

/* ----------------------------------------------------------------------
   the particle step: all but the forces at its end
------------------------------------------------------------------------- */

void FixNVESphereMTS::initial_integrate(int /*vflag*/)
{
  if (run_totals.particle_steps == 0) find_slow_largest();
  const auto extremes = find_extremes();
  demand_neighbours(extremes);
  look_ahead();
  choose_steps();

  drift_free();
  if (domain->dimension == 2)
    sub_step_active<apf::PlaneRow>();
  else
    sub_step_active<apf::SpaceRow>();
  activity.assign(ahead.activity.begin(), ahead.activity.begin() + atom->nlocal);
  activity.resize(atom->nmax, apf::FREE);
}

// Every particle gets the kick of half the step with which it moved last.
void FixNVESphereMTS::final_integrate()
{
  gather_loads();
  const double half = 0.5 * collision_step();
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    if (activity[i] == apf::FREE)
      kick_free(i, &values[6 * i], half);
    else
      kick_atom(i, half);
  }
  end_slow_kicks();
}

/* ---------------------------------------------------------------------- */

FixNVESphereMTS::Extremes FixNVESphereMTS::find_extremes() const
{
  double most[11];
  std::fill(most, most + 11, -big);
  double &speed2 = most[6], &acceleration2 = most[7], &displacement2 = most[8];
  speed2 = displacement2 = 0.0;
  acceleration2 = slow_largest * slow_largest;
  auto &bodies = history->bodies();
  for (int i = 0; i < atom->nlocal; i++) {
    const double *v = atom->v[i], *x = atom->x[i], *built = &x_built[3 * i];
    for (int c = 0; c < 3; c++) {
      most[c] = std::max(most[c], v[c]);
      most[3 + c] = std::max(most[3 + c], -v[c]);
    }
    most[9] = std::max(most[9], atom->rmass[i]);
    most[10] = std::max(most[10], -atom->rmass[i]);
    speed2 = std::max(speed2, MathExtra::lensq3(v));
    const double moved[3] = {x[0] - built[0], x[1] - built[1], x[2] - built[2]};
    displacement2 = std::max(displacement2, MathExtra::lensq3(moved));
    double load[3] = {}, torque[3] = {};
    bodies.add_load_to(i, load, torque);
    if (history->count(i) == 0.0 && MathExtra::lensq3(load) == 0.0)
      acceleration2 = std::max(acceleration2,
                               MathExtra::lensq3(atom->f[i]) / (atom->rmass[i] * atom->rmass[i]));
  }
  double all[11];
  MPI_Allreduce(most, all, 11, MPI_DOUBLE, MPI_MAX, world);
  double spread2 = 0.0;
  for (int c = 0; c < 3; c++)
    spread2 += all[c] > -big ? (all[c] + all[3 + c]) * (all[c] + all[3 + c]) : 0.0;
  const double heaviest = all[9], lightest = -all[10];
  const double struck = heaviest > 0.0 ? 2.0 * heaviest / (heaviest + lightest) : 1.0;
  return {std::sqrt(spread2), std::sqrt(all[6]), std::sqrt(all[7]), std::sqrt(all[8]), struck};
}

/* ----------------------------------------------------------------------
   the neighbour list must hold, at the start of each particle step, all pairs that are looked at:
   it is built anew at the end of this step if it might not do so at the next
------------------------------------------------------------------------- */

void FixNVESphereMTS::demand_neighbours(const Extremes &now)
{
  constexpr double growth = 1.2;    // of speeds within one step
  const double dt = update->dt, skin = neighbor->skin;
  ahead.reach = lookahead ? lookahead_safety * dt : 0.0;
  ahead.struck = lookahead ? (1.0 + now.struck) * dt : 0.0;
  ahead.margin = lookahead ? history->longest_neck() : 0.0;
  ahead.extra = now.acceleration * dt;
  // walls are at rest
  ahead.limit = keepers.size() > 1 ? std::max(now.spread, now.speed) : now.spread;
  const double fastest = now.spread + ahead.extra;
  const double distance = ahead.reach * fastest;
  if (lookahead && fastest * dt > skin)
    error->all(
        FLERR, Error::NOLASTLINE,
        "{} {}: particles whose velocities differ by {:.3g} may approach by {:.3g} in a "
        "timestep of {:.3g}, farther than the neighbor skin of {:.3g} lets contacts be seen: "
        "use timestep {:.2g} or smaller, or neighbor {:.2g} bin or larger",
        command, id, now.spread, fastest * dt, dt, skin, 0.4 * skin / fastest, 1.2 * distance);
  if (distance > skin) {
    ahead.reach = skin / fastest;
    ahead.struck = std::min(ahead.struck, ahead.reach);
    if (comm->me == 0 && !warned_of_skin)
      error->warning(FLERR,
                     "{} {}: looks ahead by {:.3g} timesteps instead of {}, for want of neighbor "
                     "skin: use neighbor {:.2g} bin or larger, or a smaller timestep",
                     command, id, ahead.reach / dt, lookahead_safety, 1.2 * distance);
    warned_of_skin = true;
  }
  const double displacement = now.displacement + growth * now.speed * dt;
  if (domain->box_change_size || domain->box_change_shape ||
      2.0 * displacement + growth * std::min(distance, skin) > skin)
    next_reneighbor = update->ntimestep;
}

/* ----------------------------------------------------------------------
   which particles are sub-stepped
------------------------------------------------------------------------- */

void FixNVESphereMTS::look_ahead()
{
  ahead.begin(atom->nlocal + atom->nghost);
  ahead.acceleration = surface_accelerations();
  const auto &bodies = history->bodies();
  for (int i = 0; i < atom->nlocal + atom->nghost; i++) {
    double load[3] = {}, torque[3] = {};
    bodies.add_load_to(i, load, torque);    // also of contacts that have ended
    if (MathExtra::lensq3(load) > 0.0) ahead.come_near(i);
  }
  for (auto *keeper : keepers) keeper->find_fastest(ahead);
  MPI_Allreduce(MPI_IN_PLACE, &ahead.fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  ahead.limit = std::max(ahead.limit, ahead.fastest);
  for (auto *keeper : keepers) keeper->find_approaching(ahead);
  share_activity();
  MPI_Allreduce(MPI_IN_PLACE, &ahead.fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  // what may be struck may strike others, also on other ranks
  for (int more = lookahead; more;) {
    more = 0;
    for (auto *keeper : keepers) more |= keeper->find_near(ahead);
    MPI_Allreduce(MPI_IN_PLACE, &more, 1, MPI_INT, MPI_MAX, world);
    if (more) share_activity();
  }

  if (!owners_known) know_owners();
  std::vector<char> wanted(atom->nlocal, 0);
  exchange.choose(ahead.used, domain, domain->deform_vremap, history->bodies(), wanted);
  for (int i = 0; i < atom->nlocal; i++)
    if (wanted[i]) ahead.come_near(i);
}

// Owners learn what pairs of other ranks found, ghosts what their owners know.
void FixNVESphereMTS::share_activity()
{
  message = Message::ACTIVITY;
  if (force->newton_pair) comm->reverse_comm(this, 1);
  comm->forward_comm(this, 1);
}

void FixNVESphereMTS::know_owners()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  owner_rank.assign(nall, comm->me);
  owner_row.resize(nall);
  for (int i = 0; i < nlocal; i++) owner_row[i] = i;
  message = Message::OWNERS;
  comm->forward_comm(this, 2);
  exchange.set_owners(nlocal, {owner_rank.begin() + nlocal, owner_rank.end()},
                      {owner_row.begin() + nlocal, owner_row.end()});
  owners_known = true;
}

int FixNVESphereMTS::pack_forward_comm(int n, int *list, double *buf, int /*pbc_flag*/,
                                       int * /*pbc*/)
{
  int m = 0;
  for (int k = 0; k < n; k++) {
    const int i = list[k];
    if (message == Message::ACTIVITY) {
      buf[m++] = ahead.activity[i];
    } else if (message == Message::VALUES) {
      buf[m++] = values[i];
    } else {
      buf[m++] = owner_rank[i];
      buf[m++] = owner_row[i];
    }
  }
  return m;
}

void FixNVESphereMTS::unpack_forward_comm(int n, int first, double *buf)
{
  for (int i = first; i < first + n; i++)
    if (message == Message::ACTIVITY) {
      ahead.activity[i] = static_cast<char>(*buf++);
    } else if (message == Message::VALUES) {
      values[i] = *buf++;
    } else {
      owner_rank[i] = static_cast<int>(*buf++);
      owner_row[i] = static_cast<int>(*buf++);
    }
}

int FixNVESphereMTS::pack_reverse_comm(int n, int first, double *buf)
{
  if (message == Message::LOADS) {
    std::copy_n(&values[6 * first], 6 * n, buf);
    return 6 * n;
  }
  for (int k = 0; k < n; k++) buf[k] = ahead.activity[first + k];
  return n;
}

void FixNVESphereMTS::unpack_reverse_comm(int n, int *list, double *buf)
{
  if (message == Message::LOADS) {
    for (int k = 0; k < n; k++)
      for (int c = 0; c < 6; c++) values[6 * list[k] + c] += *buf++;
    return;
  }
  for (int k = 0; k < n; k++)
    if (buf[k] == apf::ACTIVE)
      ahead.activity[list[k]] = apf::ACTIVE;
    else if (buf[k] == apf::NEAR_ACTIVE && ahead.activity[list[k]] == apf::FREE)
      ahead.activity[list[k]] = apf::NEAR_ACTIVE;
}

/* ----------------------------------------------------------------------
   by all forces as they stand, of local and ghost atoms: |f|/m + r |torque|/I
------------------------------------------------------------------------- */

std::vector<double> FixNVESphereMTS::surface_accelerations()
{
  values.assign(atom->nlocal + atom->nghost, 0.0);
  for (int i = 0; i < atom->nlocal; i++)
    values[i] =
        (MathExtra::len3(atom->f[i]) + 2.5 * MathExtra::len3(atom->torque[i]) / atom->radius[i]) /
        atom->rmass[i];
  message = Message::VALUES;
  comm->forward_comm(this, 1);
  return std::move(values);
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
  stiffest.acceleration = ahead.acceleration;
  stiffest.v45 = std::pow(ahead.fastest, 0.8);
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
    if (n > too_many)
      error->all(FLERR, Error::NOLASTLINE,
                 "{} {}: a timestep of {:.3g} takes {:.3g} collision steps, more than {}: use a "
                 "smaller timestep",
                 command, id, update->dt, n, too_many);
    n_collision = std::max(1, static_cast<int>(n));
  }

  kappa_now = std::sqrt(frequency2) * collision_step();

  auto &run = run_totals;
  run.fewest = run.particle_steps ? std::min(run.fewest, n_collision) : n_collision;
  run.most = std::max(run.most, n_collision);
  run.particle_steps++;
  run.collision_steps += n_collision;
  all_collision_steps += n_collision;
  active_now = 0;
  for (int i = 0; i < atom->nlocal; i++) active_now += ahead.activity[i] != apf::FREE;
  run.active += active_now;
  run.atoms += atom->nlocal;
  if (demand >= run.demand) {
    run.demand = demand;
    run.mode = apf::mode_names[all.mode];
  }
}

/* ----------------------------------------------------------------------
   what acts on atom i besides the given contact force and torque
------------------------------------------------------------------------- */

apf::Slow FixNVESphereMTS::slow_of(int i, const double *contact_force,
                                   const double *contact_torque) const
{
  apf::Slow slow;
  if (atom->mask[i] & freeze_group_bit || !(atom->mask[i] & groupbit)) return slow;
  const double r = atom->radius[i], m = atom->rmass[i];
  slow.inv_mass = contact_share(i) / m;
  slow.inv_inertia = 2.5 / (m * r * r);
  for (int c = 0; c < 3; c++) {
    slow.a[c] = atom->f[i][c] / m - slow.inv_mass * contact_force[c];
    slow.alpha[c] = slow.inv_inertia * (atom->torque[i][c] - contact_torque[c]);
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
  const double zero[3] = {};
  const auto kick = apf::Kick<apf::SpaceRow>::of(slow_of(i, zero, zero), time);
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
  const double dt = update->dt, no_load[6] = {};
  for (int i = 0; i < atom->nlocal; i++) {
    if (ahead.activity[i] != apf::FREE || !(atom->mask[i] & groupbit)) continue;
    if (activity[i] == apf::FREE)
      kick_free(i, no_load, 0.0);
    else
      kick_atom(i, 0.5 * dt);    // f has the resistance of a collision step
    for (int c = 0; c < 3; c++) atom->x[i][c] += dt * atom->v[i][c];
  }
}

// Half a step of velocity Verlet; flow/force's resistance is meant for it. A contact that nobody
// foresaw gives both its bodies the kick of half a collision step.
void FixNVESphereMTS::kick_free(int i, const double *load, double load_time)
{
  const double r = atom->radius[i], m = atom->rmass[i], time = 0.5 * update->dt;
  const double angular = 2.5 / (m * r * r), share = contact_share(i);
  for (int c = 0; c < 3; c++) {
    const double f = atom->f[i][c], torque = atom->torque[i][c];
    atom->v[i][c] += (time * f - (time - load_time) * share * load[c]) / m;
    atom->omega[i][c] += angular * (time * (torque - load[3 + c]) + load_time * load[3 + c]);
  }
}

// loads of contacts on local atoms, those of other ranks included
void FixNVESphereMTS::gather_loads()
{
  const auto &bodies = history->bodies();
  values.assign(6 * (atom->nlocal + atom->nghost), 0.0);
  for (int i = 0; i < atom->nlocal + atom->nghost; i++)
    bodies.add_load_to(i, &values[6 * i], &values[6 * i + 3]);
  message = Message::LOADS;
  if (force->newton_pair) comm->reverse_comm(this, 6);
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
    const auto now = slow_of(i, &values[6 * i], &values[6 * i + 3]);
    slow_largest = std::max(slow_largest, now.inv_mass > 0.0 ? MathExtra::len3(now.a) : 0.0);
    const double time = time_left(now.rate), spin_time = time_left(now.spin_rate);
    for (int c = 0; c < 3; c++) {
      atom->v[i][c] += time * (now.a[c] - slow_before[i][c]);
      atom->omega[i][c] += spin_time * (now.alpha[c] - slow_before[i][3 + c]);
    }
  }
}

/* ----------------------------------------------------------------------
   collision steps in the rows of the particles; the inner loop touches nothing else
------------------------------------------------------------------------- */

template <class Row> void FixNVESphereMTS::sub_step_active()
{
  const double dt = collision_step();
  const bool newton = force->newton_pair;
  auto &bodies = history->bodies();
  Row *rows = bodies.rows<Row>();
  if (newton) exchange.reverse(rows);    // contact forces of other ranks on particles of this one

  std::vector<int> moving, held;
  std::vector<apf::Kick<Row>> kicks;
  for (int i = 0; i < atom->nlocal; i++) {
    if (ahead.activity[i] == apf::FREE) continue;
    bodies.place(i, atom->x[i]);
    bodies.set_motion(i, atom->v[i], atom->omega[i]);
    if (!(atom->mask[i] & groupbit)) {
      held.push_back(i);
      continue;
    }
    double f[3] = {}, torque[3] = {};
    bodies.add_load_to(i, f, torque);
    const auto slow = slow_of(i, f, torque);
    std::copy_n(slow.a, 3, slow_before[i].begin());
    std::copy_n(slow.alpha, 3, slow_before[i].begin() + 3);
    apf::Kick<Row>::of(slow, 0.5 * dt).apply(rows[i]);
    apf::drift(rows[i], dt);
    moving.push_back(i);
    kicks.push_back(apf::Kick<Row>::of(slow, dt));
  }

  const apf::ContactTimes times{dt, 0.5 * dt, dt};
  const int n = static_cast<int>(moving.size());
  for (int step = 1; step < n_collision; step++) {
    exchange.forward(rows, 1.0 - static_cast<double>(step) / n_collision);
    for (const int i : held) bodies.clear_loads(i, i + 1);
    for (const int i : exchange.ghosts()) bodies.clear_loads(i, i + 1);
    for (auto *keeper : keepers) keeper->sub_step(times);
    if (newton) exchange.reverse(rows);
    for (int k = 0; k < n; k++) {
      kicks[k].apply(rows[moving[k]]);
      apf::drift(rows[moving[k]], dt);
    }
  }

  for (const int i : moving) {
    bodies.position(i, atom->x[i]);
    bodies.motion(i, atom->v[i], atom->omega[i]);
  }
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::post_run()
{
  auto &run = run_totals;
  if (run.particle_steps == 0) return;
  bigint mine[2] = {run.active, run.atoms}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_LMP_BIGINT, MPI_SUM, world);
  const bigint late = late_contacts() - run.late_before;
  if (comm->me != 0) return;
  utils::logmesg(
      lmp,
      "{} {}: {} particle steps of {:.4g}, {} collision steps, {} to {} in a particle "
      "step\n  sub-stepped {:.1f} % of the particles; finest step set by {} mode of contacts; "
      "contacts found late {}\n",
      command, id, run.particle_steps, update->dt, run.collision_steps, run.fewest, run.most,
      100.0 * all[0] / std::max<bigint>(all[1], 1), run.mode, late);
}

bigint FixNVESphereMTS::late_contacts() const
{
  bigint mine = 0, all;
  for (const auto *keeper : keepers) mine += keeper->late_so_far();
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  return all + late_before_restart;
}

/* ----------------------------------------------------------------------
   collision steps of the last particle step, fraction of atoms sub-stepped in it, contacts,
   collision steps and contacts found late since the fix was defined, largest omega dt
------------------------------------------------------------------------- */

double FixNVESphereMTS::compute_vector(int n)
{
  if (n == 0) return n_collision;
  if (n == 1) {
    bigint all;
    MPI_Allreduce(&active_now, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
    return atom->natoms ? static_cast<double>(all) / atom->natoms : 0.0;
  }
  if (n == 2) {
    double mine = 0.0, all;
    for (auto *keeper : keepers) mine += keeper->contacts_here();
    MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, MPI_SUM, world);
    return all;
  }
  if (n == 3) return static_cast<double>(all_collision_steps);
  if (n == 4) return static_cast<double>(late_contacts());
  return kappa_now;
}

void *FixNVESphereMTS::extract(const char *name, int &dim)
{
  dim = 0;
  if (strcmp(name, "fluid_every") == 0) return &fluid_every;
  return nullptr;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::grow_arrays(int nmax)
{
  activity.resize(nmax, apf::FREE);
  slow_before.resize(nmax);
}

void FixNVESphereMTS::copy_arrays(int i, int j, int /*delflag*/)
{
  activity[j] = activity[i];
  slow_before[j] = slow_before[i];
}

void FixNVESphereMTS::set_arrays(int i)
{
  activity[i] = apf::FREE;
}

int FixNVESphereMTS::pack_exchange(int i, double *buf)
{
  buf[0] = activity[i];
  std::copy(slow_before[i].begin(), slow_before[i].end(), buf + 1);
  return 7;
}

int FixNVESphereMTS::unpack_exchange(int i, double *buf)
{
  activity[i] = static_cast<char>(buf[0]);
  std::copy_n(buf + 1, 6, slow_before[i].begin());
  return 7;
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::write_restart(FILE *fp)
{
  const double late = static_cast<double>(late_contacts());
  if (comm->me != 0) return;
  const double state[3] = {static_cast<double>(n_collision),
                           static_cast<double>(all_collision_steps), late};
  const int bytes = sizeof(state);
  fwrite(&bytes, sizeof(int), 1, fp);
  fwrite(state, sizeof(double), 3, fp);
}

void FixNVESphereMTS::restart(char *buf)
{
  const auto *state = reinterpret_cast<const double *>(buf);
  if (!fixed_steps) n_collision = static_cast<int>(state[0]);
  all_collision_steps = static_cast<bigint>(state[1]);
  late_before_restart = static_cast<bigint>(state[2]);
}

double FixNVESphereMTS::memory_usage()
{
  return activity.capacity() + ahead.activity.capacity() + ahead.used.capacity() +
      slow_before.capacity() * sizeof(slow_before[0]) + x_built.capacity() * sizeof(double) +
      (owner_rank.capacity() + owner_row.capacity()) * sizeof(int);
}
