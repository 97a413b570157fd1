#include "compute_wall_deposit.h"

#include "compute_aggregate_contact.h"
#include "fix_wall_levelset.h"

#include "flow/particle_slab.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "memory.h"
#include "modify.h"
#include "update.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;

static constexpr const char *command = "Compute wall/deposit";

/* ---------------------------------------------------------------------- */

ComputeWallDeposit::ComputeWallDeposit(LAMMPS *lmp, int narg, char **arg) : Compute(lmp, narg, arg)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "compute wall/deposit", error);
  wall_id = arg[3];
  if (narg > 4 && strcmp(arg[4], "zone") != 0)
    error->all(FLERR, 4, "{} keyword {} is unknown; known is zone", command, arg[4]);
  if (narg == 5) utils::missing_cmd_args(FLERR, "compute wall/deposit zone", error);
  if (narg > 5) zone = arg[5];
  if (narg > 6) error->all(FLERR, 6, "{} takes one zone, got also {}", command, arg[6]);
  find_wall(3);

  peratom_flag = 1;
  size_peratom_cols = 0;
  vector_flag = 1;
  size_vector = N_COLUMNS;
  array_flag = 1;
  size_array_rows = wall->zones().n_zones() + 1;
  size_array_cols = N_COLUMNS;
  extvector = extarray = 0;    // counts are not to be divided by the number of atoms
  vector = new double[N_COLUMNS]();
  memory->create(array, size_array_rows, size_array_cols, "wall/deposit:array");
}

ComputeWallDeposit::~ComputeWallDeposit()
{
  memory->destroy(vector_atom);
  memory->destroy(array);
  delete[] vector;
}

void ComputeWallDeposit::init()
{
  find_wall(Error::NOLASTLINE);
  if (wall->zones().n_zones() + 1 != size_array_rows)
    error->all(FLERR, Error::NOLASTLINE,
               "{} {}: fix {} has other zones than when the compute was defined; define it again",
               command, id, wall_id);
}

// iarg: where the ID of the wall stands, or Error::NOLASTLINE outside of the command
void ComputeWallDeposit::find_wall(int iarg)
{
  wall = dynamic_cast<FixWallLevelset *>(modify->get_fix_by_id(wall_id));
  if (!wall)
    error->all(FLERR, iarg, "{} needs the ID of a fix wall/levelset, got {}", command, wall_id);
  const auto &zones = wall->zones();
  chosen = zone.empty() ? zones.n_zones() : zones.find(zone);
  if (chosen < 0)
    error->all(FLERR, iarg == Error::NOLASTLINE ? iarg : iarg + 2,
               "{}: fix {} has no zone {}; its zones are {}", command, wall_id, zone,
               zones.names());
}

/* ---------------------------------------------------------------------- */

void ComputeWallDeposit::compute_peratom()
{
  if (invoked_peratom != update->ntimestep) measure();
}

void ComputeWallDeposit::compute_vector()
{
  if (invoked_vector != update->ntimestep) measure();
}

void ComputeWallDeposit::compute_array()
{
  if (invoked_array != update->ntimestep) measure();
}

// all outputs, so that those that are asked for later cost nothing
void ComputeWallDeposit::measure()
{
  if (update->whichflag == 0) find_wall(Error::NOLASTLINE);    // it may be gone since the last run
  invoked_peratom = invoked_vector = invoked_array = update->ntimestep;
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->destroy(vector_atom);
    memory->create(vector_atom, nmax, "wall/deposit:vector_atom");
  }
  const auto touches = wall->touches();
  for (int row = 0; row < size_array_rows; row++) {
    const auto of_row = measure_row(row, touches);
    std::copy(of_row.begin(), of_row.end(), array[row]);
  }
  std::copy_n(array[chosen], N_COLUMNS, vector);
}

// Particles know which surfaces their aggregate touches in the zone: their height is above the
// nearest of these, however near they may have come to another.
ComputeWallDeposit::Row ComputeWallDeposit::measure_row(int row,
                                                        const std::vector<WallTouch> &touches)
{
  const bool whole = row == size_array_rows - 1;
  std::vector<Marks> surfaces(atom->nlocal, 0);
  for (const auto &touch : touches)
    if (whole || touch.zone == row) surfaces[touch.i] |= Marks(1) << touch.surface;
  if (auto *aggregates = wall->all_aggregates()) aggregates->spread(surfaces);

  double sums[2] = {};                   // particles, volume
  double highest = 0.0, beyond = 0.0;    // beyond: of those farther than distances are known
  for (int i = 0; i < atom->nlocal; i++) {
    const bool counts = surfaces[i] && (atom->mask[i] & groupbit);
    const double reach = wall->reach(surfaces[i]);
    const double distance = counts ? std::min(wall->distance(atom->x[i], surfaces[i]), reach) : 0.0;
    const double height = counts ? distance + atom->radius[i] : 0.0;
    if (row == chosen) vector_atom[i] = height;
    if (!counts) continue;
    constexpr double rounding = 1.0e-9;
    if (distance >= (1.0 - rounding) * reach) beyond = std::max(beyond, height);
    highest = std::max(highest, height);
    sums[0] += 1.0;
    sums[1] += apf::particle_volume(atom->radius[i], domain->dimension == 2);
  }
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, world);
  double most[2] = {highest, beyond};
  MPI_Allreduce(MPI_IN_PLACE, most, 2, MPI_DOUBLE, MPI_MAX, world);
  if (row == chosen && most[1] > 0.0) warn_beyond(most[1]);
  return {sums[0], most[0], wall->zones().per_area(sums[1], row)};
}

void ComputeWallDeposit::warn_beyond(double height)
{
  if (!warned && comm->me == 0)
    error->warning(FLERR,
                   "{} {}: particles of the deposit are beyond the band of the wall's file, and "
                   "count as if they were {:.3g} high; make the file with a wider band",
                   command, id, height);
  warned = true;
}

double ComputeWallDeposit::memory_usage()
{
  return static_cast<double>(nmax) * sizeof(double);
}
