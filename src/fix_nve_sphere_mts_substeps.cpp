// Collision steps of a particle step, in the rows of the particles; the inner loops touch nothing
// else.

#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "domain.h"
#include "fix_contact_history.h"
#include "force.h"
#include "pair_granular_adhesive.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;

namespace {

// Pairs of a tile: in space their contacts, rows and kicks take some 200 kB, and a cache of the
// second level has a megabyte or more.
constexpr int pairs_of_tile = 1000;

}    // namespace

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::sub_step_active()
{
  if (domain->dimension == 2)
    sub_step_active<apf::PlaneRow>();
  else
    sub_step_active<apf::SpaceRow>();
}

template <class Row> void FixNVESphereMTS::sub_step_active()
{
  auto &bodies = history->bodies();
  std::vector<int> moving, held;
  moving.reserve(active_now);
  for (int i = 0; i < atom->nlocal; i++) {
    if (foresight.free(i)) continue;
    bodies.touch(i);    // also by contacts of its images
    bodies.place(i, atom->x[i]);
    bodies.set_motion(i, atom->v[i], atom->omega[i]);
    (atom->mask[i] & groupbit ? moving : held).push_back(i);
  }
  const auto last_of_tile = form_tiles(moving, held);

  const double dt = collision_step();
  Row *rows = bodies.rows<Row>();
  std::vector<apf::Kick<Row>> kicks;
  kicks.reserve(moving.size());
  for (const int i : moving) {
    const auto slow = slow_of(i);
    std::copy_n(slow.a, 3, slow_before[i].begin());
    std::copy_n(slow.alpha, 3, slow_before[i].begin() + 3);
    apf::Kick<Row>::of(slow, 0.5 * dt).apply(rows[i]);
    apf::drift(rows[i], dt);
    kicks.push_back(apf::Kick<Row>::of(slow, dt));
  }

  const apf::ContactTimes times{dt, 0.5 * dt, dt};
  auto move = [&](int first, int last) {
    for (int k = first; k < last; k++) {
      kicks[k].apply(rows[moving[k]]);
      apf::drift(rows[moving[k]], dt);
    }
  };
  auto step_together = [&](int last) {    // the bodies that have to do with others, and all keepers
    for (int step = 1; step < n_collision; step++) {
      foresight.exchange.forward(rows, 1.0 - static_cast<double>(step) / n_collision);
      for (const int i : held) bodies.clear_loads(i, i + 1);
      for (const int i : foresight.exchange.ghosts()) bodies.clear_loads(i, i + 1);
      for (auto *keeper : keepers) keeper->sub_step(times);
      if (force->newton_pair) foresight.exchange.reverse(rows);
      move(0, last);
    }
  };
  auto step_alone = [&](int first, int last) {
    for (int step = 1; step < n_collision; step++) {
      history->sub_step(times);
      move(first, last);
    }
  };

  const int tiles = static_cast<int>(last_of_tile.size());
  if (tiles == 1) {
    step_together(last_of_tile[0]);
  } else {
    auto &pair = history->served();
    pair.part(islands);
    for (int t = 0; t < tiles; t++) {
      pair.enter_tile(t);
      if (t == 0)
        step_together(last_of_tile[0]);
      else
        step_alone(last_of_tile[t - 1], last_of_tile[t]);
      pair.leave_tile();
    }
    pair.join_tiles();
  }

  for (const int i : moving) {
    bodies.position(i, atom->x[i]);
    bodies.motion(i, atom->v[i], atom->omega[i]);
  }
}

/* ----------------------------------------------------------------------
   Puts bodies in the order of their tiles (contact/islands.h) and tells where each ends. There is
   one tile where several would gain nothing.
------------------------------------------------------------------------- */

std::vector<int> FixNVESphereMTS::form_tiles(std::vector<int> &moving, const std::vector<int> &held)
{
  const int n = static_cast<int>(moving.size());
  auto &pair = history->served();
  if (n_collision == 1 || pair.pairs_to_step() < 2 * pairs_of_tile || !pair.has_tiles()) return {n};

  islands.begin(atom->nlocal + atom->nghost);
  for (const int i : held) islands.pin(i);
  foresight.exchange.pin(islands);
  for (auto *keeper : keepers) keeper->pin(islands);
  pair.join_bodies(islands);
  islands.form_tiles(moving, pairs_of_tile);
  if (islands.size() == 1) return {n};

  std::vector<int> last(islands.size(), 0);
  for (const int i : moving) last[islands.tile_of(i)]++;
  std::partial_sum(last.begin(), last.end(), last.begin());
  apf::ByTile order;
  order.sort(n, islands.size(), [&](int k) {
    return islands.tile_of(moving[k]);
  });
  std::vector<int> in_order(n);
  for (int k = 0; k < n; k++) in_order[k] = moving[order.begin(0)[k]];
  moving.swap(in_order);
  return last;
}
