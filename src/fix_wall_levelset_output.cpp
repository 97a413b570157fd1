// What a wall tells: energy, loads and counts, its part of restart files, its picture.

#include "fix_wall_levelset.h"

#include "atom.h"
#include "comm.h"
#include "compute_aggregate_contact.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "restart_state.h"
#include "update.h"

#include <cstring>

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   [0] elastic and adhesive energy of all wall contacts
------------------------------------------------------------------------- */

double FixWallLevelset::compute_scalar()
{
  struct Sum : apf::ContactReader {
    double energy = 0.0;
    void read(int, const apf::ContactParts &p) override { energy += p.energy(); }
  } sum;
  check_lists();
  if (contacts.size() > 0) {
    gather();    // remove_ended() has renumbered the rows
    kernel(contacts, rows, lender ? lender->last_times() : last_times(), &sum);
  }
  double energy = sum.energy;
  if (wet) energy += bridges.loads().energy;
  double all;
  MPI_Allreduce(&energy, &all, 1, MPI_DOUBLE, MPI_SUM, world);
  return all;
}

// force 3, torque about the origin 3, contacts, contacts begun, contacts ended, bridges, liquid in
// them, liquid left on the wall; of bridges: capillary force 3, viscous force 3, energy
double FixWallLevelset::compute_vector(int n)
{
  if (n >= n_loads) return bridge_load(n - n_loads);
  if (!loads_summed) {
    if (wet) check_lists();    // liquid is settled with ghosts
    before_storing();
    double mine[n_loads];
    const auto loads = ledger.total_load();
    std::copy(loads.begin(), loads.end(), mine);
    mine[6] = contacts.size();
    mine[7] = captured;
    mine[8] = detached;
    mine[9] = bridges.size();
    mine[10] = bridges.liquid_held();
    mine[11] = ledger.total_liquid() + bridges.liquid_from_wall();
    MPI_Allreduce(mine, all_loads, n_loads, MPI_DOUBLE, MPI_SUM, world);
    loads_summed = true;
  }
  return all_loads[n];
}

double FixWallLevelset::bridge_load(int n)
{
  if (wet && !bridge_loads_summed) {
    const auto mine = bridges.loads();
    static_assert(sizeof(mine) == n_bridge_loads * sizeof(double));
    MPI_Allreduce(&mine, all_bridge_loads, n_bridge_loads, MPI_DOUBLE, MPI_SUM, world);
    bridge_loads_summed = true;
  }
  return all_bridge_loads[n];
}

// rows: zones of the wall, and the whole of it
double FixWallLevelset::compute_array(int row, int column)
{
  if (!settled)
    ledger.settle(touches(), aggregates.get());
  else if (update->whichflag == 0)
    ledger.find_regions(fmt::format("{} {}", command, id));    // one may be gone
  settled = true;
  return ledger.entry(row, column);
}

/* ---------------------------------------------------------------------- */

std::vector<double> FixWallLevelset::global_state() const
{
  double mine[2] = {captured, detached}, all[2];
  MPI_Allreduce(mine, all, 2, MPI_DOUBLE, MPI_SUM, world);
  std::vector<double> state = {all[0], all[1], motion.pose.moves ? 1.0 : 0.0};
  state.resize(3 + apf::WallPose::state_size);
  motion.pose.write(&state[3]);
  const auto of_zones = ledger.state();
  state.insert(state.end(), of_zones.begin(), of_zones.end());
  return state;
}

void FixWallLevelset::set_global_state(RestartState &state)
{
  for (auto *count : {&captured, &detached}) {
    const double saved = state.whole(0.0, most_counted);
    if (comm->me == 0) *count = saved;    // they are sums over ranks
  }
  const bool moved = state.yes();
  const double *pose = state.next(apf::WallPose::state_size);
  if (moved && motion.pose.moves && !motion.pose.read(pose)) state.damaged();
  if (moved && !motion.pose.moves && comm->me == 0)
    error->warning(FLERR,
                   "{} {}: the wall of the restart file moves, this one has no keyword move and "
                   "goes on at rest in its first place; give move as before, with velocities of 0 "
                   "if it is to rest where it was",
                   command, id);
  ledger.set_state(state, fmt::format("{} {}", command, id));
}

/* ----------------------------------------------------------------------
   "wall_contacts": int[nlocal], closed contacts of each atom with this wall, or bridges without
   "wall_bridges": int[nlocal]; "wall_liquid": double[nlocal], the atom's share in these bridges
------------------------------------------------------------------------- */

void *FixWallLevelset::extract(const char *name, int &dim)
{
  dim = 1;
  if (strcmp(name, "wall_bridges") == 0) return wet ? bridges.counts_of_atoms() : nullptr;
  if (strcmp(name, "wall_liquid") == 0) return wet ? bridges.liquid_of_atoms() : nullptr;
  if (strcmp(name, "wall_contacts") != 0) return nullptr;
  count_of_atom.assign(atom->nmax, 0);
  for (int i : contacts.source) count_of_atom[i]++;
  if (wet) bridges.count_where_dry_contact_is_not(count_of_atom);
  return count_of_atom.data();
}

/* ---------------------------------------------------------------------- */

int FixWallLevelset::image(int *&objects, double **&values)
{
  drawn = std::make_unique<WallImage>(surfaces, grid.get(), domain);
  if (motion.pose.moves) drawn->move(motion.pose);
  objects = drawn->objects.data();
  values = drawn->rows.data();
  return static_cast<int>(drawn->objects.size());
}

/* ---------------------------------------------------------------------- */

double FixWallLevelset::memory_usage()
{
  return FixContacts::memory_usage() + contacts.memory_usage() + bridges.memory_usage() +
      touched.capacity() * sizeof(unsigned) + clearances.memory_usage() + rows.memory_usage() +
      (grid ? grid->memory_usage() : 0.0);
}
