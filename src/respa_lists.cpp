#include "respa_lists.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

// A light particle that a heavy one strikes leaves with up to twice its speed.
static constexpr double struck = 2.0;
static constexpr double big = 1.0e300;

/* ---------------------------------------------------------------------- */

void RespaLists::list_was_built()
{
  const double *x = atom->nlocal ? atom->x[0] : nullptr;
  x_built.assign(x, x + 3 * static_cast<size_t>(atom->nlocal));
}

/* ---------------------------------------------------------------------- */

bool RespaLists::too_old_for_step(bool kicked)
{
  double most[8];    // velocities, velocities turned, acceleration^2, displacement^2
  std::fill(most, most + 6, -big);
  double &acceleration2 = most[6], &displacement2 = most[7];
  acceleration2 = displacement2 = 0.0;
  const bool known = x_built.size() == 3 * static_cast<size_t>(atom->nlocal);
  if (!known) displacement2 = big;
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = atom->x[i], *v = atom->v[i];
    for (int c = 0; c < 3; c++) {
      most[c] = std::max(most[c], v[c]);
      most[3 + c] = std::max(most[3 + c], -v[c]);
    }
    const double m = atom->rmass[i];
    if (kicked) acceleration2 = std::max(acceleration2, MathExtra::lensq3(atom->f[i]) / (m * m));
    if (!known) continue;
    const double *built = &x_built[3 * static_cast<size_t>(i)];
    const double moved[3] = {x[0] - built[0], x[1] - built[1], x[2] - built[2]};
    displacement2 = std::max(displacement2, MathExtra::lensq3(moved));
  }
  double all[8], spread2 = 0.0;
  MPI_Allreduce(most, all, 8, MPI_DOUBLE, MPI_MAX, world);
  for (int c = 0; c < 3; c++)
    spread2 += all[c] > -big ? (all[c] + all[3 + c]) * (all[c] + all[3 + c]) : 0.0;

  const double dt = update->dt, skin = neighbor->skin;
  const double v = std::sqrt(spread2), a = std::sqrt(all[6]), approach = (v + a * dt) * dt;
  if (approach > skin) {
    // by speed and acceleration the way of this step is 0.4 of the skin
    const double way = 0.4 * skin;
    error->all(FLERR, Error::NOLASTLINE,
               "{}: particles whose velocities differ by {:.3g}, and that gain up to {:.3g}, may "
               "approach by {:.3g} in a timestep of {:.3g} of run_style respa, farther than the "
               "neighbor skin of {:.3g} lets contacts be seen: use timestep {:.2g} or smaller, or "
               "neighbor {:.2g} bin or larger",
               command, v, a * dt, approach, dt, skin,
               2.0 * way / (v + std::sqrt(v * v + 4.0 * a * way)), 1.2 * struck * approach);
  }
  return domain->box_change_size || domain->box_change_shape ||
      2.0 * std::sqrt(all[7]) + struck * approach > skin;
}
