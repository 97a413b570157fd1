#include "wall_ledger.h"

#include "compute_aggregate_contact.h"
#include "zone_area.h"

#include "flow/particle_slab.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "region.h"
#include "restart_state.h"
#include "update.h"

#include <algorithm>
#include <cstring>
#include <numeric>

using namespace LAMMPS_NS;

static std::string joined(const std::vector<std::string> &words)
{
  std::string all;
  for (const auto &word : words) all += (all.empty() ? "" : " ") + word;
  return all;
}

/* ---------------------------------------------------------------------- */

void WallLedger::parse(const char *command, const std::vector<std::string> &surface_names, int narg,
                       char **arg, int &iarg)
{
  if (narg < iarg + 3) utils::missing_cmd_args(FLERR, "fix wall/levelset zone", error);
  const std::string name = arg[iarg + 1], where = arg[iarg + 2];
  if (name == "rest" || name == "total")
    error->all(FLERR, iarg + 1, "{} zone name {} is taken: it is that of a row of the array",
               command, name);
  if (find(name) >= 0) error->all(FLERR, iarg + 1, "{} zone name {} is given twice", command, name);
  if (n_zones() + 1 == most_zones)
    error->all(FLERR, iarg, "{} takes at most {} zones", command, most_zones - 1);

  const auto surface = std::find(surface_names.begin(), surface_names.end(), where);
  Zone zone{name, -1, "", nullptr};
  if (surface != surface_names.end()) {
    zone.surface = static_cast<int>(surface - surface_names.begin());
  } else {
    zone.region = where;
    zone.inside = domain->get_region_by_id(where);
    const auto &only = surface_names.front();
    const bool left_out = (where == "lo" && only == "hi") || (where == "hi" && only == "lo");
    if (!zone.inside)
      error->all(
          FLERR, iarg + 2,
          "{} zone {}: {} is neither a surface of this wall nor a region; its surfaces are {}{}",
          command, name, where, joined(surface_names),
          left_out ? "; a plane whose place is NULL is none" : "");
  }
  zones.push_back(zone);
  iarg += 3;
}

void WallLedger::complete(const std::vector<std::string> &surface_names, const WallGrid *grid)
{
  from_file = grid;
  of_surfaces = joined(surface_names);
  if (zones.empty())
    for (int s = 0; s < static_cast<int>(surface_names.size()); s++)
      zones.push_back({surface_names[s], s, "", nullptr});
  else
    zones.push_back({"rest", -1, "", nullptr});
  begun.assign(zones.size() + 1, 0.0);
  ended = begun;
  liquid.assign(zones.size(), 0.0);
  account.resize(zones.size() + 1);
  clear_loads();
  find_only_zones();
}

void WallLedger::find_only_zones()
{
  only_zone.assign(surfaces.size(), -1);
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++)
    for (int z = 0; z < n_zones() && zones[z].region.empty(); z++)
      if (zones[z].surface == s || z == n_zones() - 1) {
        only_zone[s] = z;
        break;
      }
}

void WallLedger::init(const std::string &of_fix)
{
  areas.clear();
  find_regions(of_fix);
  move_regions();
}

void WallLedger::find_regions(const std::string &of_fix)
{
  regions_move = false;
  for (auto &zone : zones) {
    if (zone.region.empty()) continue;
    zone.inside = domain->get_region_by_id(zone.region);
    if (!zone.inside)
      error->all(FLERR, Error::NOLASTLINE, "{}: region {} of zone {} does not exist any more",
                 of_fix, zone.region, zone.name);
    if (zone.inside->dynamic_check() || zone.inside->varshape) regions_move = true;
  }
}

void WallLedger::move_regions()
{
  for (const auto &zone : zones)
    if (zone.inside) zone.inside->prematch();
}

/* ---------------------------------------------------------------------- */

int WallLedger::find(const std::string &name) const
{
  for (int z = 0; z < n_zones(); z++)
    if (zones[z].name == name) return z;
  return -1;
}

std::string WallLedger::names() const
{
  std::vector<std::string> words;
  for (const auto &zone : zones) words.push_back(zone.name);
  return joined(words);
}

std::string WallLedger::places() const
{
  std::string text = names() + " (surfaces: " + of_surfaces + ")";
  std::replace_if(
      text.begin(), text.end(),
      [](char c) {
        return !is_printable(c);
      },
      '?');
  return text;
}

int WallLedger::zone_of(int surface, const double *foot) const
{
  if (only_zone[surface] >= 0) return only_zone[surface];
  double x[3] = {foot[0], foot[1], foot[2]};
  domain->remap(x);    // particles may be a little outside until they are exchanged
  for (int z = 0; z < n_zones() - 1; z++) {
    if (zones[z].surface == surface) return z;
    if (zones[z].inside && zones[z].inside->match(x[0], x[1], x[2])) return z;
  }
  return n_zones() - 1;
}

void WallLedger::count(std::vector<double> &counts, int zone, Marks others)
{
  if (!(others >> zone & 1)) counts[zone] += 1.0;
  if (!others) counts.back() += 1.0;
}

std::array<double, 6> WallLedger::total_load() const
{
  std::array<double, 6> sum{};
  for (const auto &of_zone : loads)
    for (int c = 0; c < 6; c++) sum[c] += of_zone[c];
  return sum;
}

/* ---------------------------------------------------------------------- */

void WallLedger::settle(const std::vector<WallTouch> &touches, ComputeAggregateContact *aggregates)
{
  const bool planar = domain->dimension == 2;
  std::vector<Row> mine(account.size(), Row{});
  std::vector<Marks> touching(atom->nlocal, 0), deposited(atom->nlocal, 0);
  for (const auto &touch : touches) {
    deposited[touch.i] |= mark(touch.zone);
    if (!touch.dry) continue;
    mine[touch.zone][CONTACTS] += 1.0;
    mine.back()[CONTACTS] += 1.0;
    touching[touch.i] |= mark(touch.zone);
  }
  if (aggregates) aggregates->spread(deposited);

  for (int row = 0; row <= n_zones(); row++) {
    const auto load = row < n_zones() ? loads[row] : total_load();
    std::copy(load.begin(), load.end(), mine[row].begin() + FORCE);
    mine[row][CAPTURED] = begun[row];
    mine[row][DETACHED] = ended[row];
    mine[row][LIQUID] = row < n_zones() ? liquid[row] : total_liquid();
    for (int i = 0; i < atom->nlocal; i++) {
      mine[row][ATTACHED] += touching[i] >> row & 1;
      if (!(deposited[i] >> row & 1)) continue;
      mine[row][DEPOSITED] += 1.0;
      mine[row][MASS] += atom->rmass[i];
      mine[row][MASS_PER_AREA] += atom->rmass[i] / apf::slab_depth(atom->radius[i], planar);
      mine[row][THICKNESS] += apf::particle_volume(atom->radius[i], planar);
    }
  }
  MPI_Allreduce(mine.data(), account.data(), static_cast<int>(mine.size()) * N_COLUMNS, MPI_DOUBLE,
                MPI_SUM, world);

  for (int row = 0; row <= n_zones(); row++) {
    account[row][AREA] = area(row);
    for (const int column : {MASS_PER_AREA, THICKNESS})
      account[row][column] = per_area(account[row][column], row);
  }
}

double WallLedger::total_liquid() const
{
  return std::accumulate(liquid.begin(), liquid.end(), 0.0);
}

std::vector<double> WallLedger::films()
{
  auto all = liquid;
  MPI_Allreduce(MPI_IN_PLACE, all.data(), n_zones(), MPI_DOUBLE, MPI_SUM, world);
  for (int zone = 0; zone < n_zones(); zone++) all[zone] = std::max(0.0, per_area(all[zone], zone));
  return all;
}

void WallLedger::begin_films(double thickness)
{
  if (has_films) return;
  has_films = true;
  for (int zone = 0; zone < n_zones(); zone++) {
    const double volume = thickness * area(zone);
    if (comm->me == 0) liquid[zone] += volume;
  }
}

double WallLedger::area(int row)
{
  const std::array<double, 9> box = {domain->boxlo[0], domain->boxlo[1], domain->boxlo[2],
                                     domain->boxhi[0], domain->boxhi[1], domain->boxhi[2],
                                     domain->xy,       domain->xz,       domain->yz};
  const bool moved = (regions_move || pose.moves) && measured_step != update->ntimestep;
  if (areas.empty() || moved || box != measured_box) measure_areas();
  measured_box = box;
  measured_step = update->ntimestep;
  return areas[row];
}

void WallLedger::measure_areas()
{
  areas.assign(account.size(), 0.0);
  for (int s = 0; s < static_cast<int>(surfaces.size()); s++) {
    const auto zone_at = [&](const double *x) {
      return zone_of(s, x);
    };
    if (from_file)
      add_zone_areas(*from_file, s, pose, domain, zone_at, areas);
    else
      add_zone_areas(surfaces[s], pose, domain, only_zone[s], zone_at, areas);
  }
  for (int z = 0; z < n_zones(); z++) areas.back() += areas[z];
}

double WallLedger::per_area(double amount, int row)
{
  return area(row) > 0.0 ? amount / area(row) : 0.0;
}

/* ----------------------------------------------------------------------
   names as their number of characters and these, one a number
------------------------------------------------------------------------- */

std::vector<double> WallLedger::state() const
{
  std::vector<double> mine = begun, all;
  mine.insert(mine.end(), ended.begin(), ended.end());
  mine.insert(mine.end(), liquid.begin(), liquid.end());
  all.resize(mine.size());
  MPI_Allreduce(mine.data(), all.data(), static_cast<int>(mine.size()), MPI_DOUBLE, MPI_SUM, world);
  all.push_back(has_films ? 1.0 : 0.0);
  const std::string text = places();
  all.insert(all.begin(), text.begin(), text.end());
  all.insert(all.begin(), static_cast<double>(text.size()));
  return all;
}

void WallLedger::set_state(RestartState &state, const std::string &of_fix)
{
  const std::string saved = state.text();
  if (saved != places())
    error->all(
        FLERR,
        "{}: the zones in the restart file are {}, those of the command are {}; give the same, "
        "or the fix another ID to count anew",
        of_fix, saved, places());
  for (auto *numbers : {&begun, &ended, &liquid})
    for (auto &number : *numbers) {
      const bool counts = numbers != &liquid;
      const double saved_number = counts ? state.whole(0.0, most_counted) : state.next();
      if (comm->me == 0) number = saved_number;    // they are sums over ranks
    }
  has_films = state.yes();
}
