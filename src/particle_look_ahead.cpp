#include "particle_look_ahead.h"

#include "atom.h"
#include "atom_rows.h"
#include "box_images.h"
#include "comm.h"
#include "error.h"
#include "fix_contact_history.h"
#include "force.h"
#include "math_extra.h"
#include "meeting_velocities.h"
#include "named_atoms.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

// distance looked ahead over that of the approach
static constexpr double lookahead_safety = 2.0;
static constexpr double growth = 1.2;    // of speeds within one step, but for impacts

/* ---------------------------------------------------------------------- */

ParticleLookAhead::ParticleLookAhead(LAMMPS *lmp, Fix *carrier, const char *command) :
    Pointers(lmp), exchange(world), carrier(carrier), command(command)
{
}

void ParticleLookAhead::init(FixContactHistory *of_pairs, const std::vector<FixContacts *> &all,
                             int frozen)
{
  freeze_group_bit = frozen;
  history = of_pairs;
  keepers = all;
  friction = std::any_of(keepers.begin(), keepers.end(), [](const FixContacts *keeper) {
    return keeper->slides();
  });
}

void ParticleLookAhead::list_was_built()
{
  owners_known = false;
  x_built.assign(&atom->x[0][0], &atom->x[0][0] + 3 * static_cast<size_t>(atom->nlocal));
}

double ParticleLookAhead::box_lag() const
{
  if (box_every == 0) return 0.0;
  const bigint now = update->ntimestep;
  const bigint moved = (update->setupflag ? now : now - 1) / box_every * box_every;
  return static_cast<double>(now - moved) * update->dt;
}

// No image moves by more after the neighbour list was built.                              [length]
double ParticleLookAhead::farthest_lag() const
{
  if (box_every == 0 || domain->triclinic) return 0.0;
  double rates[6], most[3];
  for (int c = 0; c < 6; c++) rates[c] = std::fabs(domain->h_rate[c]);
  const double one[3] = {1.0, 1.0, 1.0};
  sum_of_box_vectors(one, rates, most);
  return box_every * update->dt * MathExtra::len3(most);
}

void ParticleLookAhead::move_images(double time)
{
  const int nlocal = atom->nlocal, nall = nlocal + atom->nghost;
  position_of_owner.resize(nall);
  for (int i = 0; i < nlocal; i++) std::copy_n(atom->x[i], 3, position_of_owner[i].begin());
  message = Message::POSITIONS;
  comm->forward_comm(carrier, 3);
  for (int i = nlocal; i < nall; i++) {
    double n[3], now[3], rate[3];
    image_number(domain, position_of_owner[i].data(), atom->x[i], n);
    sum_of_box_vectors(n, domain->h, now);
    sum_of_box_vectors(n, domain->h_rate, rate);
    for (int c = 0; c < 3; c++) atom->x[i][c] = position_of_owner[i][c] + now[c] + time * rate[c];
  }
}

void ParticleLookAhead::share(std::vector<char> &activity)
{
  shared = &activity;
  message = Message::SHARED;
  comm->forward_comm(carrier, 1);
}

/* ---------------------------------------------------------------------- */

bool ParticleLookAhead::look(double slow_largest)
{
  ahead.begin(atom->nlocal + atom->nghost);
  ahead.radius = atom->radius;
  const bool rebuild = set_reach(find_extremes(slow_largest));
  find_active();
  if (!owners_known) know_owners();
  std::vector<char> wanted(atom->nlocal, 0);
  exchange.choose(ahead.used, domain, box_every ? box_lag() : update->dt, history->bodies(),
                  wanted);
  for (int i = 0; i < atom->nlocal; i++)
    if (wanted[i]) come_near(i);
  return rebuild;
}

/* ----------------------------------------------------------------------
   in one pass, for it costs memory traffic: also the accelerations of surfaces by all forces as
   they stand, |f|/m + r |torque|/I
------------------------------------------------------------------------- */

ParticleLookAhead::Extremes ParticleLookAhead::find_extremes(double slow_largest)
{
  MeetingVelocities velocities;
  double acceleration2 = slow_largest * slow_largest, displacement2 = 0.0, spin2 = 0.0;
  double heaviest = 0.0, lightest = std::numeric_limits<double>::max();
  bool held = false;
  double nothing = 0.0;    // NAN where a number is not finite, which comparisons pass over
  const auto &bodies = history->bodies();
  const auto *xs = rows_of(atom->x), *vs = rows_of(atom->v), *fs = rows_of(atom->f);
  const auto *torques = rows_of(atom->torque), *omegas = rows_of(atom->omega);
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = xs[i], *built = &x_built[3 * i], mass = atom->rmass[i];
    velocities.include(vs[i]);
    if (moves(i)) {
      heaviest = std::max(heaviest, mass);
      lightest = std::min(lightest, mass);
    } else {
      held = true;
    }
    const double r = atom->radius[i];
    if (friction) spin2 = std::max(spin2, r * r * MathExtra::lensq3(omegas[i]));
    const double moved[3] = {x[0] - built[0], x[1] - built[1], x[2] - built[2]};
    displacement2 = std::max(displacement2, MathExtra::lensq3(moved));
    const double f2 = MathExtra::lensq3(fs[i]), torque2 = MathExtra::lensq3(torques[i]);
    nothing += 0.0 * (MathExtra::lensq3(vs[i]) + MathExtra::lensq3(omegas[i]) + f2 + torque2);
    ahead.acceleration[i] = (std::sqrt(f2) + 2.5 * std::sqrt(torque2) / r) / mass;
    double load[3] = {}, torque[3] = {};
    bodies.add_load_to(i, load, torque);
    if (history->count(i) == 0.0 && MathExtra::lensq3(load) == 0.0)
      acceleration2 = std::max(acceleration2, f2 / (mass * mass));
  }
  if (held) velocities.include_held();
  velocities.include_others(atom, domain, bodies, keepers, lookahead_safety * update->dt);

  constexpr int others = 6;
  double most[others + MeetingVelocities::size] = {
      acceleration2, displacement2, spin2, heaviest, -lightest, nothing != 0.0 ? 1.0 : 0.0};
  velocities.pack(most + others);
  MPI_Allreduce(MPI_IN_PLACE, most, others + MeetingVelocities::size, MPI_DOUBLE, MPI_MAX, world);
  if (most[5] != 0.0) refuse_not_finite();
  velocities.unpack(most + others);
  velocities.frame(ahead.frame);
  ahead.walls = velocities.fastest_wall(ahead.frame);
  ahead.limit = velocities.fastest(ahead.frame) + apf::LookAhead::spin_share * std::sqrt(most[2]);
  ahead.amplify = apf::amplification(most[3], -most[4]);
  return {velocities.spread(), std::sqrt(most[0]), std::sqrt(most[1])};
}

// collective
void ParticleLookAhead::refuse_not_finite()
{
  NamedAtoms not_finite;
  for (int i = 0; i < atom->nlocal; i++)
    for (const auto *of : {atom->v[i], atom->omega[i], atom->f[i], atom->torque[i]})
      if (!std::isfinite(MathExtra::lensq3(of))) {
        not_finite.add(atom->tag[i], 0.0);
        break;
      }
  not_finite.gather(world);
  error->all(
      FLERR, Error::NOLASTLINE,
      "{} {}: velocity, spin, force or torque is no finite number for {} particles (IDs {}); "
      "look at them in the step before, and at the fixes that act on them",
      command, carrier->id, not_finite.number(), not_finite.ids());
}

// whether collisions move a body
bool ParticleLookAhead::moves(int i) const
{
  return atom->mask[i] & carrier->groupbit && !(atom->mask[i] & freeze_group_bit);
}

/* ----------------------------------------------------------------------
   the neighbour list must hold, at the start of each particle step, all pairs that are looked at:
   it is built anew at the end of this step if it might not do so at the next
------------------------------------------------------------------------- */

bool ParticleLookAhead::set_reach(const Extremes &now)
{
  const double dt = update->dt, box_way = farthest_lag(), skin = neighbor->skin - box_way;
  ahead.step = on ? dt : 0.0;
  ahead.reach = on ? lookahead_safety * dt : 0.0;
  ahead.margin = on ? history->longest_neck() : 0.0;
  ahead.extra = now.acceleration * dt;
  const double fastest = now.spread + ahead.extra;
  const double longest =
      std::max(lookahead_safety * now.spread, (1.0 + ahead.amplify) * ahead.limit);
  const double distance = on ? longest * dt + ahead.reach * ahead.extra : 0.0;
  const bool pairs = on && atom->natoms > 1;    // a single particle needs no list for its walls
  if (pairs && fastest * dt > skin)
    error->all(
        FLERR, Error::NOLASTLINE,
        "{} {}: bodies whose velocities differ by {:.3g}, and that gain up to {:.3g}, may "
        "approach by {:.3g} in a timestep of {:.3g}, farther than the neighbor skin of "
        "{:.3g}{} lets contacts be seen: {}",
        command, carrier->id, now.spread, ahead.extra, fastest * dt, dt, neighbor->skin,
        box_way > 0.0 ? fmt::format(", less {:.3g} by which fix deform moves images in its {} "
                                    "timesteps,",
                                    box_way, box_every)
                      : "",
        MeetingVelocities::cure(now.spread, now.acceleration, skin, 1.2 * distance + box_way));
  if (pairs && distance > skin) {
    const double less = skin / distance;
    ahead.reach *= less;
    ahead.step *= less;
    if (comm->me == 0 && !warned_of_skin)
      error->warning(
          FLERR,
          "{} {}: looks ahead by {:.3g} timesteps instead of {:.3g}, for want of neighbor "
          "skin: use neighbor {:.2g} bin or larger, or a smaller timestep",
          command, carrier->id, lookahead_safety * less, lookahead_safety,
          1.2 * distance + box_way);
    warned_of_skin = true;
  }
  // of particles, after impacts
  const double speed = MathExtra::len3(ahead.frame) + 2.0 * ahead.walls +
      std::max(growth, ahead.amplify) * ahead.limit;
  const double displacement = now.displacement + speed * dt;
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
    if (MathExtra::lensq3(load) > 0.0) come_near(i);
  }
  for (auto *keeper : keepers) keeper->find_fastest(ahead);
  double most[4] = {ahead.released, ahead.fastest};
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  ahead.released = most[0];
  ahead.fastest = most[1];
  for (auto *keeper : keepers) keeper->find_approaching(ahead);
  share_activity();
  auto know_speeds = [&] {
    most[0] = ahead.swiftest;
    most[1] = ahead.fastest;
    most[3] = ahead.striking;
    MPI_Allreduce(MPI_IN_PLACE, most, 4, MPI_DOUBLE, MPI_MAX, world);
    ahead.swiftest = most[0];
    ahead.fastest = most[1];
    ahead.striking = most[3];
  };
  know_speeds();
  // what may be struck may strike others, also on other ranks; these may be swifter
  for (bool more = on; more;) {
    const double known = ahead.swiftest;
    bool joined = false;
    for (auto *keeper : keepers) joined |= keeper->find_near(ahead);
    most[2] = joined;
    know_speeds();
    more = most[2] > 0.0 || ahead.swiftest > known;
    if (more) share_activity();
  }
}

void ParticleLookAhead::come_near(int i)
{
  history->bodies().with_rows([&](const auto *rows) {
    ahead.come_near(i, ahead.speed_of(rows, i));
  });
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
    } else if (message == Message::SHARED) {
      *buf++ = (*shared)[i];
    } else if (message == Message::ACCELERATION) {
      *buf++ = ahead.acceleration[i];
    } else if (message == Message::POSITIONS) {
      buf = std::copy_n(position_of_owner[i].begin(), 3, buf);
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
    } else if (message == Message::SHARED) {
      (*shared)[i] = static_cast<char>(*buf++);
    } else if (message == Message::ACCELERATION) {
      ahead.acceleration[i] = *buf++;
    } else if (message == Message::POSITIONS) {
      std::copy_n(buf, 3, position_of_owner[i].begin());
      buf += 3;
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
      (ahead.acceleration.capacity() + x_built.capacity() + 3 * position_of_owner.capacity()) *
      sizeof(double);
}
