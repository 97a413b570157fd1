#include "fix_contacts.h"

#include "atom.h"
#include "comm.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_force.h"
#include "fix_nve_sphere_mts.h"
#include "modify.h"
#include "particle_checks.h"
#include "respa.h"
#include "restart_state.h"
#include "timestep/first_touch.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;
using namespace FixConst;

/* ---------------------------------------------------------------------- */

FixContacts::FixContacts(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), velocities(domain->dimension == 2), guard(lmp)
{
  restart_peratom = 1;
  restart_global = 1;    // write_restart() also brings the per-atom data up to date
  create_attribute = 1;
  maxexchange_dynamic = 1;
  maxexchange = UsedVelocity::size + 1;
  FixContacts::grow_arrays(atom->nmax);
}

// Not in the constructor: when that of a derived class throws, LAMMPS does not know the fix yet,
// and delete_callback() would throw in turn, from a destructor.
void FixContacts::register_with_atoms()
{
  atom->add_callback(Atom::GROW);
  atom->add_callback(Atom::RESTART);
  registered = true;
}

FixContacts::~FixContacts()
{
  if (!registered) return;
  atom->delete_callback(id, Atom::GROW);
  atom->delete_callback(id, Atom::RESTART);
}

int FixContacts::setmask()
{
  return INITIAL_INTEGRATE | PRE_EXCHANGE | MIN_PRE_EXCHANGE | POST_NEIGHBOR | MIN_POST_NEIGHBOR |
      POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixContacts::init()
{
  keepers = all_of(modify);
  sub_stepper = nullptr;
  drags.clear();
  for (const auto &fix : modify->get_fix_list()) {
    if (auto *stepper = dynamic_cast<FixNVESphereMTS *>(fix)) sub_stepper = stepper;
    if (const auto *drag = dynamic_cast<FixFlowForce *>(fix)) drags.push_back(drag);
  }
  limited = !modify->get_fix_by_style("^nve/limit").empty();
}

std::vector<FixContacts *> FixContacts::all_of(Modify *modify)
{
  std::vector<FixContacts *> all;
  for (const auto &fix : modify->get_fix_list())
    if (auto *keeper = dynamic_cast<FixContacts *>(fix)) all.push_back(keeper);
  return all;
}

bool FixContacts::lists_hold(LAMMPS *lmp)
{
  int hold = 1;
  for (const auto *keeper : all_of(lmp->modify)) hold = hold && keeper->order.holds(lmp->atom);
  MPI_Allreduce(MPI_IN_PLACE, &hold, 1, MPI_INT, MPI_MIN, lmp->world);
  return hold;
}

/* ----------------------------------------------------------------------
   At the first forces of a run velocities stand at the time of the positions, unless the run goes
   on from where another ended: then the last forces are computed again, as they were.
------------------------------------------------------------------------- */

const apf::ContactTimes &FixContacts::take_velocities()
{
  require_lists();
  if (finite_is_due(lmp) && keepers.front() == this) check_finite(lmp, name());
  const double step = step_of_level();
  contacts_change();
  const double last_behind = taken.behind;
  taken = {step, 0.5 * step, step};
  if (!update->setupflag) {
    velocities.use(atom);
    recall_due(taken);
    return taken;
  }
  taken.advance = 0.0;
  int goes_on = velocities.goes_on(atom);
  MPI_Allreduce(MPI_IN_PLACE, &goes_on, 1, MPI_INT, MPI_MIN, world);
  if (goes_on) {
    taken.behind = last_behind;
    velocities.use_positions(atom);
    share_velocities();
  } else {
    taken.behind = 0.0;
    velocities.use(atom);
  }
  recall_due(taken);
  return taken;
}

// A run without setup takes the lists of the one before.
void FixContacts::require_lists()
{
  if (!run_ended) return;
  run_ended = false;
  if (!lists_hold(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "Fix {} {}: a command since the last run has moved or renumbered atoms or their "
               "ghosts, as write_restart does, and contacts were not found again: use run without "
               "pre no",
               style, id);
}

void FixContacts::initial_integrate(int /*vflag*/)
{
  if (begins) require_unchanged();
  begins = false;
}

void FixContacts::require_unchanged()
{
  const bool first = comes_first();
  if (first) guard.require_box(name());
  int same[] = {order.holds(atom), sizes.hold(atom), !first || places.hold(atom)};
  MPI_Allreduce(MPI_IN_PLACE, same, 3, MPI_INT, MPI_MIN, world);
  if (!same[0]) return;    // another error tells
  if (!same[1])
    error->all(FLERR, Error::NOLASTLINE,
               "{}: a command since the last run has changed diameters, masses or types of atoms, "
               "and their laws were not found again: use run without pre no",
               name());
  if (!same[2])
    error->all(FLERR, Error::NOLASTLINE,
               "{}: a command since the last run has moved atoms, and forces are those of where "
               "they were: use run without pre no",
               name());
}

bool FixContacts::comes_first() const
{
  if (keepers.front() != this) return false;
  for (const auto &fix : modify->get_fix_list()) {
    if (fix == this) break;
    if (modify->get_fix_mask(fix) & INITIAL_INTEGRATE) return false;
  }
  return true;
}

std::string FixContacts::name() const
{
  return utils::strmatch(style, "^contact/history") ? "Pair granular/adhesive"
                                                    : fmt::format("Fix {} {}", style, id);
}

void FixContacts::recall_due(const apf::ContactTimes &times)
{
  due.clear();
  if (times.advance > 0.0 || times.behind == 0.0) return;
  for (int i = 0; i < atom->nlocal; i++) {
    const auto &f = velocities.due_load(i);
    if (f[0] != 0.0 || f[1] != 0.0 || f[2] != 0.0) due.push_back({i, {f[0], f[1], f[2]}});
  }
}

apf::ContactTimes FixContacts::last_times() const
{
  return {0.0, taken.behind, taken.step};
}

bool FixContacts::steps(int i) const
{
  return sub_stepper && sub_stepper->steps(i);
}

void FixContacts::note_touch(const apf::Approach &approach, double radius_sum,
                             const apf::StiffestMode &mode, bool foreseen)
{
  if (!sub_stepper || update->setupflag) return;
  if (!foreseen) {
    late++;
    return;
  }
  constexpr double rounding = 1.1;
  const double step = sub_stepper->largest_step(mode);
  const double moved = step * approach.relative_speed;
  const double turning = 0.5 * moved * moved / radius_sum;    // of a pair that grazes
  if (-approach.gap > rounding * (step * std::max(approach.closing_speed, 0.0) + turning)) late++;
}

bool FixContacts::follows_given_steps() const
{
  return !sub_stepper && !limited && !update->setupflag && update->whichflag == 1;
}

// Each body answers by its share of what a force on both moves them.
double FixContacts::step_without_drag(const apf::ContactList &list, int k, double step) const
{
  if (drags.empty()) return step;
  const auto mobility = [&](int i) {
    double least = 1.0;
    for (const auto *drag : drags) least = std::min(least, drag->mobility(i, step));
    return least;
  };
  const int i = list.i[k], j = list.j[k];
  const auto &c = list.kinds.constants(list.kind[k]);
  double mean = mobility(i);
  if (c.radius_sum > c.radius_i) {
    const double mi = atom->rmass[i], mj = atom->rmass[j];
    mean = (mj * mean + mi * mobility(j)) / (mi + mj);
  }
  return step * std::sqrt(mean);
}

std::string FixContacts::or_collision_steps() const
{
  return has_rigid_bodies(lmp) ? "" : ", or fix nve/sphere/mts";
}

std::string FixContacts::fault_of_touch(const apf::Approach &approach, const apf::ContactList &list,
                                        int k, double step) const
{
  if (!follows_given_steps()) return {};
  const auto &c = list.kinds.constants(list.kind[k]);
  const auto &mode = list.mode(k);
  const auto touch = apf::FirstTouch::of(approach, c.radius_sum, c.turning);
  if (touch.too_fast(mode, step_without_drag(list, k, step)))
    return fmt::format("meet at a speed of {:.3g}, for {:.3g} by their stiffness, too short for "
                       "steps of {:.3g}: found {:.3g} inside each other; use timestep {:.2g} or "
                       "smaller, or a smaller Young's modulus{}",
                       touch.speed, apf::impact_duration(mode, touch.speed), step, touch.overlap,
                       following_timestep(mode, touch.speed), or_collision_steps());
  const double other = c.radius_sum - c.radius_i;
  const double smaller = other > 0.0 ? std::min(c.radius_i, other) : c.radius_i;
  const apf::JKR law = apf::Spring(list.constants_of(k), mode.mass).law;
  if (!touch.thrown_apart(law, mode, smaller, step)) return {};
  return fmt::format("have come {:.3g} inside each other in a step of {:.3g}, not by their "
                     "velocities, which differ by {:.3g}, and would be thrown apart at {:.3g}; "
                     "insert particles where none are, let boxes and walls move slower, and the "
                     "neighbor list be built often enough (neigh_modify delay 0 every 1)",
                     touch.overlap, step, touch.relative_speed, touch.speed_apart(law, mode.mass));
}

double FixContacts::following_timestep(const apf::StiffestMode &mode, double speed) const
{
  return apf::impact_duration(mode, speed) / apf::good_steps * update->dt / step_of_level();
}

bool FixContacts::step_is_given() const
{
  return !sub_stepper || sub_stepper->fixed_number();
}

double FixContacts::step_of_level() const
{
  if (sub_stepper) return sub_stepper->collision_step();
  const auto *respa = dynamic_cast<Respa *>(update->integrate);
  return respa ? respa->step[level()] : update->dt;
}

/* ----------------------------------------------------------------------
   contacts are put where their atoms can take them along:
   before atoms move, at the end of a run (atoms may be deleted after it), for restart files
------------------------------------------------------------------------- */

void FixContacts::pre_exchange()
{
  if (!stored) {
    before_storing();
    store_contacts();
  }
  stored = true;
  maxexchange = UsedVelocity::size + store.max_size(atom->nlocal);
}

void FixContacts::post_run()
{
  if (keepers.front() == this) check_finite(lmp, name());
  pre_exchange();
  velocities.remember(atom, due_loads());
  if (!begins || update->whichflag == 2) {    // else a run of no steps, which found nothing anew
    sizes.note(atom);
    places.note(atom);
    guard.note_box();
  }
  begins = true;
  run_ended = true;
}

std::vector<double> FixContacts::due_loads()
{
  std::vector<double> loads(3 * static_cast<size_t>(atom->nlocal + atom->nghost), 0.0);
  for (const auto &load : due)
    for (int c = 0; c < 3; c++) loads[3 * load.row + c] += load.f[c];
  collect_due(loads);
  return loads;
}

void FixContacts::write_restart(FILE *fp)
{
  if (update->whichflag) post_run();    // within a run; else the end of the last run has done it
  auto state = global_state();
  state.insert(state.begin(), taken.behind);
  if (comm->me == 0) RestartState::write(lmp, this, state, fp);
}

void FixContacts::restart(char *buf)
{
  RestartState state(lmp, this, buf);
  taken.behind = state.next(Range::from(0.0));
  set_global_state(state);
  state.end();
}

/* ---------------------------------------------------------------------- */

void FixContacts::grow_arrays(int nmax)
{
  store.grow(nmax);
  velocities.grow(nmax);
}

// A fix that comes first may delete atoms before pre_exchange() is called here.
void FixContacts::copy_arrays(int i, int j, int /*delflag*/)
{
  if (!stored && stores_alone()) store_contacts();
  stored = stored || stores_alone();
  store.copy(i, j);
  velocities.copy(i, j);
}

void FixContacts::set_arrays(int i)
{
  store.insert(i);
  velocities.insert(i);
}

int FixContacts::pack_exchange(int i, double *buf)
{
  const int m = velocities.pack(i, buf);
  return m + store.pack(i, buf + m);
}

int FixContacts::unpack_exchange(int i, double *buf)
{
  return unpack(i, buf);
}

int FixContacts::unpack(int i, const double *buf)
{
  store.insert(i);
  const int m = velocities.unpack(i, buf);
  const int n = store.unpack(i, buf + m);
  maxexchange = MAX(maxexchange, m + n);    // the atom may go on to another rank as it is
  return m + n;
}

int FixContacts::pack_restart(int i, double *buf)
{
  buf[0] = 1 + pack_exchange(i, buf + 1);
  return static_cast<int>(buf[0]);
}

void FixContacts::unpack_restart(int i, int nth)
{
  RestartNumbers row(lmp, this, atom->extra[i], atom->nextra_store, false);
  for (int n = 0; n < nth; n++) row.part();    // of other fixes
  auto mine = row.part();
  const double *const packed = mine.data();
  UsedVelocity::check(mine);
  ContactStore::check(mine);
  mine.end();
  unpack(i, packed);
}

int FixContacts::size_restart(int i)
{
  return 1 + UsedVelocity::size + store.size(i);
}

// Called on all ranks, since rank 0 writes it for all.
int FixContacts::maxsize_restart()
{
  const int mine = store.max_size(atom->nlocal);
  int largest;
  MPI_Allreduce(&mine, &largest, 1, MPI_INT, MPI_MAX, world);
  return 1 + UsedVelocity::size + largest;
}

double FixContacts::memory_usage()
{
  return store.memory_usage() + velocities.memory_usage();
}
