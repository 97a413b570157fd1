// Impacts that given time steps cannot follow end the run, see timestep/first_touch.h.

#include "pair_granular_adhesive.h"

#include "atom.h"
#include "atom_rows.h"
#include "error.h"
#include "fix_contact_history.h"
#include "math_extra.h"
#include "neighbor.h"
#include "timestep/first_touch.h"
#include "timestep/spread_nearby.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

std::string PairGranularAdhesive::ids_of(int i, int j) const
{
  const auto [first, second] = std::minmax(atom->tag[i], atom->tag[j]);
  return fmt::format("{} and {}", first, second);
}

// A contact that steps of this length do not follow ends the run before its force has acted.
void PairGranularAdhesive::check_touch(const apf::Approach &approach, int k)
{
  const int i = contacts.i[k], j = contacts.j[k];
  if (atom->mask[i] & atom->mask[j] & freeze_group_bit) return;    // no force moves them
  const auto fault = store->fault_of_touch(approach, contacts, k, store->times().step);
  if (!fault.empty())
    error->one(FLERR, Error::NOLASTLINE, "Pair granular/adhesive: particles {} {}", ids_of(i, j),
               fault);
}

// Pairs of a new list that pass through each other between two positions of steps of this length.
void PairGranularAdhesive::check_passages()
{
  new_list = false;
  const double step = store->times().step, touch = 2.0 * sizes.smallest_radius();
  const int n = atom->nlocal + atom->nghost;
  const auto *v = rows_of(atom->v);
  double fastest2 = 0.0;
  for (int i = 0; i < n; i++) fastest2 = std::max(fastest2, MathExtra::lensq3(v[i]));
  if (2.0 * std::sqrt(fastest2) * step <= 0.5 * touch) return;
  apf::VelocityRange velocities;
  for (int i = 0; i < n; i++) velocities.include(v[i]);
  double spread = velocities.spread(velocities);
  if (spread * step <= 0.5 * touch) return;
  const double shown = apf::longest_way_shown(touch, neighbor->skin);
  if (atom->natoms > 1 && spread * step > shown) {
    // of those that can meet: in a box that is sheared the others differ more
    const double largest = 2.0 * sizes.largest_radius();
    spread = apf::spread_nearby(rows_of(atom->x), v, n, largest + spread * step);
    if (spread * step > shown)
      error->one(FLERR, Error::NOLASTLINE,
                 "Pair granular/adhesive: particles whose velocities differ by {:.3g} move by "
                 "{:.3g} against each other in a step of {:.3g}, farther than the {:.3g} within "
                 "which a neighbor skin of {:.3g} shows all that meet; use a smaller timestep{}",
                 spread, spread * step, step, shown, neighbor->skin, store->or_collision_steps());
  }
  store->bodies().with_rows([&](const auto *rows) {
    for (int k = 0; k < candidates.size(); k++) {
      const int i = candidates.i[k], j = candidates.j[k];
      if (candidates.closed[k] || (atom->mask[i] & atom->mask[j] & freeze_group_bit)) continue;
      const auto passage = apf::Passage::of(rows[i], rows[j], step);
      if (!passage.through(candidates.touch[k], step, neighbor->skin)) continue;
      error->one(FLERR, Error::NOLASTLINE,
                 "Pair granular/adhesive: particles {} {} unseen: they move by {:.3g} against each "
                 "other in a step of {:.3g}, and touch at {:.3g}; use timestep {:.2g} or smaller{}",
                 ids_of(i, j),
                 passage.until > 0.0 ? "may fly through each other" : "flew through each other",
                 passage.speed * step, step, candidates.touch[k],
                 store->following_timestep(mode_of(i, j), passage.speed),
                 store->or_collision_steps());
    }
  });
}
