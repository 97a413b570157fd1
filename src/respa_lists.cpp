#include "respa_lists.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "meeting_velocities.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <limits>

using namespace LAMMPS_NS;

// A light particle that a heavy one strikes leaves with up to twice its speed.
static constexpr double struck = 2.0;

/* ---------------------------------------------------------------------- */

void RespaLists::list_was_built()
{
  const double *x = atom->nlocal ? atom->x[0] : nullptr;
  x_built.assign(x, x + 3 * static_cast<size_t>(atom->nlocal));
}

/* ---------------------------------------------------------------------- */

bool RespaLists::too_old_for_step(bool kicked, const apf::Bodies &rows,
                                  const std::vector<FixContacts *> &keepers)
{
  MeetingVelocities velocities;
  double acceleration2 = 0.0, displacement2 = 0.0;
  const bool known = x_built.size() == 3 * static_cast<size_t>(atom->nlocal);
  if (!known) displacement2 = std::numeric_limits<double>::max();
  for (int i = 0; i < atom->nlocal; i++) {
    const double *x = atom->x[i], m = atom->rmass[i];
    velocities.include(atom->v[i]);
    if (kicked) acceleration2 = std::max(acceleration2, MathExtra::lensq3(atom->f[i]) / (m * m));
    if (!known) continue;
    const double *built = &x_built[3 * static_cast<size_t>(i)];
    const double moved[3] = {x[0] - built[0], x[1] - built[1], x[2] - built[2]};
    displacement2 = std::max(displacement2, MathExtra::lensq3(moved));
  }
  velocities.include_others(atom, domain, rows, keepers, struck * update->dt);
  double most[2 + MeetingVelocities::size] = {acceleration2, displacement2};
  velocities.pack(most + 2);
  MPI_Allreduce(MPI_IN_PLACE, most, 2 + MeetingVelocities::size, MPI_DOUBLE, MPI_MAX, world);
  velocities.unpack(most + 2);

  const double dt = update->dt, skin = neighbor->skin;
  const double v = velocities.spread(), a = std::sqrt(most[0]), approach = (v + a * dt) * dt;
  if (atom->natoms > 1 && approach > skin)
    error->all(FLERR, Error::NOLASTLINE,
               "{}: bodies whose velocities differ by {:.3g}, and that gain up to {:.3g}, may "
               "approach by {:.3g} in a timestep of {:.3g} of run_style respa, farther than the "
               "neighbor skin of {:.3g} lets contacts be seen: {}",
               command, v, a * dt, approach, dt, skin,
               MeetingVelocities::cure(v, a, skin, 1.2 * struck * approach));
  return domain->box_change_size || domain->box_change_shape ||
      2.0 * std::sqrt(most[1]) + struck * approach > skin;
}
