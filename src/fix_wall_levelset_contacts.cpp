// Which particles touch the wall where: contacts are made, found again, and end.

#include "fix_wall_levelset.h"

#include "atom.h"
#include "error.h"
#include "fix_contact_history.h"
#include "math_extra.h"
#include "update.h"

#include <algorithm>
#include <limits>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

// x as the wall's own frame sees it, in which its shape was given
const double *FixWallLevelset::in_frame(const double *x, double *y) const
{
  if (!motion.pose.moves) return x;
  motion.pose.to_frame(x, y);
  return y;
}

apf::Foot FixWallLevelset::foot_of(int surface, const double *x, double *kappa) const
{
  double y[3], at[3];
  apf::Foot foot = surfaces[surface].foot(in_frame(x, y), kappa);
  if (!motion.pose.moves) return foot;
  motion.pose.to_space(foot.at, at);
  std::copy(at, at + 3, foot.at);
  return foot;
}

bool FixWallLevelset::farther(int surface, const double *x, double than) const
{
  double y[3];
  return surfaces[surface].farther(in_frame(x, y), than);
}

// whether a particle is farther than that from all surfaces; may say no where it is
bool FixWallLevelset::far_from_all(int i, double than) const
{
  double y[3];
  return !touched[i] && clearances.at_least(i, in_frame(atom->x[i], y)) > than;
}

double FixWallLevelset::distance(const double *x) const
{
  return nearest(x, ~Marks(0)).distance;
}

double FixWallLevelset::distance(const double *x, Marks of_surfaces) const
{
  return nearest(x, of_surfaces).distance;
}

FixWallLevelset::Nearest FixWallLevelset::nearest(const double *x, Marks of_surfaces) const
{
  double space[3];
  const double *y = in_frame(x, space);
  Nearest found{0, std::numeric_limits<double>::max()};
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
    if (!(of_surfaces >> s & 1)) continue;
    const double d = surfaces[s].distance(y);
    if (d < found.distance) found = {s, d};
  }
  return found;
}

double FixWallLevelset::reach(Marks of_surfaces) const
{
  double least = std::numeric_limits<double>::infinity();
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
    if (of_surfaces >> s & 1) least = std::min(least, surfaces[s].reach);
  return least;
}

/* ---------------------------------------------------------------------- */

void FixWallLevelset::detect()
{
  double space[3];
  const double step = follows_given_steps() ? step_now() : 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(atom->mask[i] & groupbit)) continue;
    const double *y = in_frame(atom->x[i], space);
    if (clearances.at_least(i, y) > atom->radius[i]) continue;
    look_around(i, y);
    const double r = atom->radius[i];
    if (step > 0.0 && !(atom->mask[i] & frozen) &&
        (motion.pose.moves || step * step * MathExtra::lensq3(atom->v[i]) > r * r))
      check_passage(i, step);
  }
}

double FixWallLevelset::step_now() const
{
  return (lender ? lender->times() : times()).step;
}

// A particle that flies through a rod or an edge in one step of that length ends the run.
void FixWallLevelset::check_passage(int i, double step)
{
  const double r = atom->radius[i];
  double v[3] = {atom->v[i][0], atom->v[i][1], atom->v[i][2]};
  if (motion.pose.moves) {    // as the wall sees it
    const auto of_wall = motion.pose.velocity_at(atom->x[i]);
    v[0] -= of_wall.x;
    v[1] -= of_wall.y;
    v[2] -= of_wall.z;
  }
  const double speed = MathExtra::len3(v);
  if (speed * step <= r) return;
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
    if (touched[i] >> s & 1) continue;
    auto at = [&](double ago) {
      double x[3];
      for (int c = 0; c < 3; c++) x[c] = atom->x[i][c] - ago * v[c];
      return foot_of(s, x).distance;
    };
    if (at(step) <= r) continue;    // it has touched
    const int looks = static_cast<int>(std::min(1000.0, 4.0 * speed * step / r));
    for (int n = 1; n < looks; n++)
      if (at(step * n / looks) < r)
        error->one(
            FLERR, Error::NOLASTLINE,
            "{} {}: atom {} flew through the wall{} unseen: it moves by {:.3g} in a step "
            "of {:.3g}, and its radius is {:.3g}; use timestep {:.2g} or smaller{}",
            command, id, atom->tag[i], of_file(), speed * step, step, r,
            following_timestep(apf::stiffest_mode(coefficient.model, bodies_of(i, s)), speed),
            or_collision_steps());
  }
}

// Closes the contacts of a particle at y, and takes note of how far the other surfaces are.
void FixWallLevelset::look_around(int i, const double *y)
{
  const double r = atom->radius[i];
  double least = std::numeric_limits<double>::max();
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
    if (touched[i] >> s & 1) continue;
    double d = surfaces[s].at_least(y);
    if (d < 2.0 * r) d = surfaces[s].distance(y);    // worth to know better
    if (d <= r) touch(i, s, steps(i));
    if (!(touched[i] >> s & 1)) least = std::min(least, d);
  }
  clearances.note(i, y, least);
}

// closes the contact if there is one and it is new
void FixWallLevelset::touch(int i, int surface, bool foreseen)
{
  if (touched[i] >> surface & 1) return;
  double x[3];
  particles().position(i, x);
  const auto foot = foot_of(surface, x);
  if (foot.distance > atom->radius[i]) return;
  if (foot.distance <= 0.0)
    error->one(FLERR, Error::NOLASTLINE,
               "{} {}: the centre of atom {} is outside the fluid, {} behind the wall{}; put it "
               "inside, or use a smaller timestep",
               command, id, atom->tag[i], -foot.distance, of_file());
  const Marks others = zones_of(i);
  close(i, surface, apf::ContactHistory());
  const auto approach = approach_of(i, foot);
  const int k = contacts.size() - 1;
  note_touch(approach, atom->radius[i], contacts.mode(k), foreseen);
  const bool held = atom->mask[i] & frozen;    // no force moves it
  const auto fault = held ? std::string() : fault_of_touch(approach, contacts, k, step_now());
  if (!fault.empty())
    error->one(FLERR, Error::NOLASTLINE, "{} {}: atom {} and the wall{} {}", command, id,
               atom->tag[i], of_file(), fault);
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
  turning_of.push_back(bodies.turning);
  touched[i] |= 1u << surface;
  count_anew();
}

// without how the normal turns, which depends on the place
apf::ContactBodies FixWallLevelset::bodies_of(int i, int surface) const
{
  auto bodies = bodies_at(surfaces[surface], atom->radius[i], atom->rmass[i]);
  if (rigid) {
    int dim;
    const auto *body = static_cast<int *>(rigid->extract("body", dim));
    const auto *mass = static_cast<double *>(rigid->extract("masstotal", dim));
    if (body && mass && body[i] >= 0) bodies.m = mass[body[i]];
  }
  return bodies;
}

apf::ContactBodies FixWallLevelset::bodies_of(int i, int surface, const double *x) const
{
  auto bodies = bodies_of(i, surface);
  const auto &of = surfaces[surface];
  double y[3], kappa[2] = {};
  if (!of.uniform) of.foot(in_frame(x, y), kappa);
  bodies.turning = of.turning(kappa[0], atom->radius[i]);
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
    auto bodies = bodies_of(i, surface_of[k]);
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
    const int i = contacts.source[k], s = surface_of[k];
    if (in_sub_step) near.push_back({i, s});
    touched[i] &= ~(1u << s);
    clearances.forget(i);
    ledger.end(zone_of(i, s), zones_of(i));
    contacts.remove(k);
    surface_of[k] = surface_of.back();
    surface_of.pop_back();
    turning_of[k] = turning_of.back();
    turning_of.pop_back();
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

// Between runs commands may have renumbered atoms and deleted regions.
void FixWallLevelset::check_lists()
{
  if (update->whichflag) return;
  ledger.find_regions(fmt::format("{} {}", command, id));
  if (!lists_hold(lmp))
    error->all(FLERR, Error::NOLASTLINE,
               "{} {} is asked for its contacts after atoms were moved or renumbered, as by "
               "delete_atoms, and before contacts were found again: use run 0 first",
               command, id);
}

std::vector<WallTouch> FixWallLevelset::touches()
{
  check_lists();
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

/* ----------------------------------------------------------------------
   contacts through a rebuild of the neighbour list: partner = number of the surface
------------------------------------------------------------------------- */

void FixWallLevelset::before_storing()
{
  if (wet && lender) lender->settle_liquid();
}

void FixWallLevelset::store_contacts()
{
  store.start(atom->nlocal, contacts.size(), wet ? bridges.size() : 0, rows.planar());
  for (int k = 0; k < contacts.size(); k++)
    store.contacts.add(contacts.source[k], surface_of[k], contacts.history_of(k));
  if (wet) bridges.store_into(store);
}

void FixWallLevelset::post_neighbor()
{
  FixContacts::post_neighbor();
  rebuild = true;
}

void FixWallLevelset::find_again()
{
  rebuild = false;
  touched.assign(atom->nmax, 0);
  clearances.resize(atom->nmax);
  clearances.forget_all();
  contacts.clear();
  surface_of.clear();
  turning_of.clear();
  if (wet) bridges.find_again();
  for (int i = 0; i < atom->nlocal; i++)
    for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
      if (const auto history = store.contacts.find(i, s)) close(i, s, *history);
}
