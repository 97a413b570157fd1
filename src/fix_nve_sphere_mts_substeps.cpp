// Collision steps of a particle step, in the rows of the particles; the inner loops touch nothing
// else.

#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "domain.h"
#include "fix_contact_history.h"
#include "force.h"
#include "pair_granular_adhesive.h"

#include <algorithm>

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
  const auto tiles = form_tiles(moving, held);
  Row *rows = bodies.rows<Row>();
  const auto kicks = begin_steps(moving, rows);

  const double dt = collision_step();
  const apf::ContactTimes times{dt, 0.5 * dt, dt};
  substep_ghosts = 0;
  auto move = [&](int tile) {
    for (int k = tiles.first(tile); k < tiles.first(tile + 1); k++) {
      kicks[k].apply(rows[moving[k]]);
      apf::drift(rows[moving[k]], dt);
    }
  };
  auto step_together = [&] {    // tile 0: what has to do with ghosts and with all keepers
    for (int step = 1; step < n_collision; step++) {
      substep_ghosts =
          foresight.exchange.forward(rows, 1.0 - static_cast<double>(step) / n_collision);
      for (const int i : held) bodies.clear_loads(i, i + 1);
      for (const int i : foresight.exchange.ghosts()) bodies.clear_loads(i, i + 1);
      for (auto *keeper : keepers) keeper->sub_step(times);
      if (force->newton_pair) foresight.exchange.reverse(rows);
      move(0);
    }
  };
  auto step_alone = [&](int tile) {
    for (int step = 1; step < n_collision; step++) {
      history->sub_step(times);
      move(tile);
    }
  };

  if (tiles.size() == 1) {
    step_together();
  } else {
    auto &pair = history->served();
    pair.part(islands);
    for (int tile = 0; tile < tiles.size(); tile++) {
      pair.enter_tile(tile);
      if (tile == 0)
        step_together();
      else
        step_alone(tile);
      pair.leave_tile();
    }
    pair.join_tiles();
  }

  for (const int i : moving) {
    bodies.position(i, atom->x[i]);
    bodies.motion(i, atom->v[i], atom->omega[i]);
  }
}

// Half a kick by the forces as they stand, and the first drift; returns the kicks to come.
template <class Row>
std::vector<apf::Kick<Row>> FixNVESphereMTS::begin_steps(const std::vector<int> &moving, Row *rows)
{
  const double dt = collision_step();
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
  return kicks;
}

// The tiles (contact/islands.h) of bodies, which come into the order of these; a single one where
// several would gain nothing.
apf::ByTile FixNVESphereMTS::form_tiles(std::vector<int> &moving, const std::vector<int> &held)
{
  const int n = static_cast<int>(moving.size());
  auto &pair = history->served();
  const int pairs = pair.pairs_to_step();
  apf::ByTile tiles;
  tiles.sort(n, 1, [](int) {
    return 0;
  });
  if (n_collision == 1 || pairs < 2 * pairs_of_tile || !pair.has_tiles()) return tiles;

  islands.begin(atom->nlocal + atom->nghost);
  for (const int i : held) islands.pin(i);
  foresight.exchange.pin(islands);
  for (auto *keeper : keepers) keeper->pin(islands);
  pair.join_bodies(islands);
  islands.form_tiles(moving, pairs_of_tile);
  if (islands.pinned() > pairs / 2) return tiles;

  tiles.sort(n, islands.size(), [&](int k) {
    return islands.tile_of(moving[k]);
  });
  std::vector<int> in_order(n);
  for (int k = 0; k < n; k++) in_order[k] = moving[tiles.begin(0)[k]];
  moving.swap(in_order);
  return tiles;
}
