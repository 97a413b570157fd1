#include "particle_look_ahead.h"

#include "atom.h"
#include "atom_rows.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "math_extra.h"
#include "meeting_velocities.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

// Distance looked ahead over that of the approach; LookAhead::struck has the bound for impacts.
static constexpr double lookahead_safety = 2.0;
static constexpr double growth = 1.2;    // of speeds within one step, but for impacts

/* ---------------------------------------------------------------------- */

ParticleLookAhead::ParticleLookAhead(LAMMPS *lmp, Fix *carrier, const char *command) :
    Pointers(lmp), exchange(world), carrier(carrier), command(command)
{
}

void ParticleLookAhead::init(FixContactHistory *of_pairs, const std::vector<FixContacts *> &all)
{
  history = of_pairs;
  keepers = all;
}

void ParticleLookAhead::list_was_built()
{
  owners_known = false;
  x_built.assign(&atom->x[0][0], &atom->x[0][0] + 3 * static_cast<size_t>(atom->nlocal));
}

/* ---------------------------------------------------------------------- */

bool ParticleLookAhead::look(double slow_largest)
{
  ahead.begin(atom->nlocal + atom->nghost);
  const bool rebuild = set_reach(find_extremes(slow_largest));
  find_active();
  if (!owners_known) know_owners();
  std::vector<char> wanted(atom->nlocal, 0);
  exchange.choose(ahead.used, domain, domain->deform_vremap, history->bodies(), wanted);
  for (int i = 0; i < atom->nlocal; i++)
    if (wanted[i]) ahead.come_near(i);
  return rebuild;
}

/* ----------------------------------------------------------------------
   in one pass, for it costs memory traffic: also the accelerations of surfaces by all forces as
   they stand, |f|/m + r |torque|/I
------------------------------------------------------------------------- */

ParticleLookAhead::Extremes ParticleLookAhead::find_extremes(double slow_largest)
{
  MeetingVelocities velocities;
  double acceleration2 = slow_largest * slow_largest, displacement2 = 0.0;
  double heaviest = 0.0, lightest = std::numeric_limits<double>::max();
  const auto &bodies = history->bodies();
  const auto *xs = rows_of(atom->x), *vs = rows_of(atom->v), *fs = rows_of(atom->f);
  const auto *torques = rows_of(atom->torque);
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = xs[i], *built = &x_built[3 * i], mass = atom->rmass[i];
    velocities.include(vs[i]);
    heaviest = std::max(heaviest, mass);
    lightest = std::min(lightest, mass);
    const double moved[3] = {x[0] - built[0], x[1] - built[1], x[2] - built[2]};
    displacement2 = std::max(displacement2, MathExtra::lensq3(moved));
    const double f2 = MathExtra::lensq3(fs[i]), torque2 = MathExtra::lensq3(torques[i]);
    ahead.acceleration[i] = (std::sqrt(f2) + 2.5 * std::sqrt(torque2) / atom->radius[i]) / mass;
    double load[3] = {}, torque[3] = {};
    bodies.add_load_to(i, load, torque);
    if (history->count(i) == 0.0 && MathExtra::lensq3(load) == 0.0)
      acceleration2 = std::max(acceleration2, f2 / (mass * mass));
  }
  velocities.include_others(atom, domain, bodies, keepers, lookahead_safety * update->dt);

  double most[4 + MeetingVelocities::size] = {acceleration2, displacement2, heaviest, -lightest};
  velocities.pack(most + 4);
  MPI_Allreduce(MPI_IN_PLACE, most, 4 + MeetingVelocities::size, MPI_DOUBLE, MPI_MAX, world);
  velocities.unpack(most + 4);
  heaviest = most[2];
  lightest = -most[3];
  const double struck = heaviest > 0.0 ? 2.0 * heaviest / (heaviest + lightest) : 1.0;
  const double spread = velocities.spread(), fastest = velocities.fastest();
  // what a wall strikes leaves it no faster than it came
  const double after = velocities.walls_move() ? fastest + spread
                                               : std::max(growth, struck) * fastest;
  return {spread, after, std::sqrt(most[0]), std::sqrt(most[1]), struck};
}

/* ----------------------------------------------------------------------
   the neighbour list must hold, at the start of each particle step, all pairs that are looked at:
   it is built anew at the end of this step if it might not do so at the next
------------------------------------------------------------------------- */

bool ParticleLookAhead::set_reach(const Extremes &now)
{
  const double dt = update->dt, skin = neighbor->skin;
  ahead.reach = on ? lookahead_safety * dt : 0.0;
  ahead.struck = on ? (1.0 + now.struck) * dt : 0.0;
  ahead.margin = on ? history->longest_neck() : 0.0;
  ahead.extra = now.acceleration * dt;
  ahead.limit = now.spread;
  const double fastest = now.spread + ahead.extra;
  const double longest = std::max(ahead.reach, ahead.struck);
  const double distance = longest * fastest;
  const bool pairs = on && atom->natoms > 1;    // a single particle needs no list for its walls
  if (pairs && fastest * dt > skin) {
    // by speed and acceleration the way of this step is 0.4 of the skin
    const double way = 0.4 * skin, v = now.spread, a = now.acceleration;
    error->all(FLERR, Error::NOLASTLINE,
               "{} {}: bodies whose velocities differ by {:.3g}, and that gain up to {:.3g}, may "
               "approach by {:.3g} in a timestep of {:.3g}, farther than the neighbor skin of "
               "{:.3g} lets contacts be seen: use timestep {:.2g} or smaller, or neighbor {:.2g} "
               "bin or larger",
               command, carrier->id, v, ahead.extra, fastest * dt, dt, skin,
               2.0 * way / (v + std::sqrt(v * v + 4.0 * a * way)), 1.2 * distance);
  }
  if (pairs && distance > skin) {
    ahead.reach = std::min(ahead.reach, skin / fastest);
    ahead.struck = std::min(ahead.struck, skin / fastest);
    if (comm->me == 0 && !warned_of_skin)
      error->warning(
          FLERR,
          "{} {}: looks ahead by {:.3g} timesteps instead of {:.3g}, for want of neighbor "
          "skin: use neighbor {:.2g} bin or larger, or a smaller timestep",
          command, carrier->id, skin / fastest / dt, longest / dt, 1.2 * distance);
    warned_of_skin = true;
  }
  const double displacement = now.displacement + now.speed * dt;
  return domain->box_change_size || domain->box_change_shape ||
      2.0 * displacement + growth * std::min(distance, skin) > skin;
}

/* ----------------------------------------------------------------------
   which particles are sub-stepped
------------------------------------------------------------------------- */

void ParticleLookAhead::find_active()
{
  message = Message::ACCELERATION;
  comm->forward_comm(carrier, 1);
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
  for (int more = on; more;) {
    more = 0;
    for (auto *keeper : keepers) more |= keeper->find_near(ahead);
    MPI_Allreduce(MPI_IN_PLACE, &more, 1, MPI_INT, MPI_MAX, world);
    if (more) share_activity();
  }
}

// Owners learn what pairs of other ranks found, ghosts what their owners know.
void ParticleLookAhead::share_activity()
{
  message = Message::ACTIVITY;
  if (force->newton_pair) comm->reverse_comm(carrier, 1);
  comm->forward_comm(carrier, 1);
}

void ParticleLookAhead::know_owners()
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  owner_rank.assign(nall, comm->me);
  owner_row.resize(nall);
  for (int i = 0; i < nlocal; i++) owner_row[i] = i;
  message = Message::OWNERS;
  comm->forward_comm(carrier, 2);
  exchange.set_owners(nlocal, {owner_rank.begin() + nlocal, owner_rank.end()},
                      {owner_row.begin() + nlocal, owner_row.end()});
  owner_rank = owner_row = std::vector<int>();
  owners_known = true;
}

// Contacts put loads on ghosts, which their owners are to have: before LAMMPS's forces come anew.
void ParticleLookAhead::gather_loads()
{
  message = Message::LOADS;
  if (force->newton_pair) comm->reverse_comm(carrier, 6);
}

/* ---------------------------------------------------------------------- */

int ParticleLookAhead::pack_forward(int n, const int *list, double *buf) const
{
  double *const start = buf;
  for (int k = 0; k < n; k++) {
    const int i = list[k];
    if (message == Message::ACTIVITY) {
      *buf++ = ahead.activity[i];
    } else if (message == Message::ACCELERATION) {
      *buf++ = ahead.acceleration[i];
    } else {
      *buf++ = owner_rank[i];
      *buf++ = owner_row[i];
    }
  }
  return static_cast<int>(buf - start);
}

void ParticleLookAhead::unpack_forward(int n, int first, const double *buf)
{
  for (int i = first; i < first + n; i++)
    if (message == Message::ACTIVITY) {
      ahead.activity[i] = static_cast<char>(*buf++);
    } else if (message == Message::ACCELERATION) {
      ahead.acceleration[i] = *buf++;
    } else {
      owner_rank[i] = static_cast<int>(*buf++);
      owner_row[i] = static_cast<int>(*buf++);
    }
}

int ParticleLookAhead::pack_reverse(int n, int first, double *buf)
{
  if (message == Message::ACTIVITY) {
    std::copy_n(ahead.activity.data() + first, n, buf);
    return n;
  }
  auto &bodies = history->bodies();
  std::fill_n(buf, 6 * n, 0.0);
  for (int k = 0; k < n; k++) bodies.add_load_to(first + k, buf + 6 * k, buf + 6 * k + 3);
  bodies.clear_loads(first, first + n);
  return 6 * n;
}

void ParticleLookAhead::unpack_reverse(int n, const int *list, const double *buf)
{
  for (int k = 0; k < n; k++)
    if (message == Message::ACTIVITY)
      ahead.activity[list[k]] = std::max(ahead.activity[list[k]], static_cast<char>(buf[k]));
    else
      history->bodies().add_load(list[k], buf + 6 * k, buf + 6 * k + 3);
}

/* ---------------------------------------------------------------------- */

double ParticleLookAhead::memory_usage() const
{
  return ahead.activity.capacity() + ahead.used.capacity() +
      (ahead.acceleration.capacity() + x_built.capacity()) * sizeof(double);
}
