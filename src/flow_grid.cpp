#include "flow_grid.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"

#include "flow/wall_extension.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

static constexpr double box_tolerance = 1.0e-9;       // of the box's length
static constexpr double repeat_tolerance = 1.0e-6;    // of the largest velocity

/* ---------------------------------------------------------------------- */

int FlowGrid::Options::parse(LAMMPS *lmp, int iarg, int narg, char **arg)
{
  const struct {
    const char *keyword, *on, *off;
    bool &value;
  } table[] = {{"loop", "yes", "no", loop},
               {"outside", "clamp", "error", clamp},
               {"wall", "reconstruct", "plain", reconstruct}};
  for (const auto &row : table) {
    if (strcmp(arg[iarg], row.keyword) != 0) continue;
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, std::string("fix flow/field ") + row.keyword, lmp->error);
    row.value = strcmp(arg[iarg + 1], row.on) == 0;
    if (!row.value && strcmp(arg[iarg + 1], row.off) != 0)
      lmp->error->all(FLERR, iarg + 1, "Fix flow/field {} must be {} or {}, got {}", row.keyword,
                      row.on, row.off, arg[iarg + 1]);
    return iarg + 2;
  }
  return iarg;
}

/* ---------------------------------------------------------------------- */

FlowGrid::FlowGrid(LAMMPS *lmp, const std::string &path_in, const Options &options_in, int iarg) :
    Pointers(lmp), path(path_in), options(options_in), frames(world), position(iarg)
{
  if (domain->triclinic)
    error->all(FLERR, iarg, "Fix flow/field file requires an orthogonal box, not a triclinic one");
  attempt([this] {
    file = std::make_unique<apf::VtkhdfFile>(path);
    image = file->grid();
    times = file->times();
    known_distance = file->has("distance");
  });
  int nsteps = times.size(), has = known_distance;
  MPI_Bcast(&image, sizeof(image), MPI_BYTE, 0, world);
  MPI_Bcast(&has, 1, MPI_INT, 0, world);
  MPI_Bcast(&nsteps, 1, MPI_INT, 0, world);
  times.resize(nsteps);
  MPI_Bcast(times.data(), nsteps, MPI_DOUBLE, 0, world);
  known_distance = has;

  make_lattice();
  if (known_distance)
    attempt([this] {
      distance = nodes_of(file->read("distance", 1, 0, layers()), 1);
    });
  if (series()) now = times.front();
  require(detail);
  load(0);
  position = Error::NOLASTLINE;
}

/* ----------------------------------------------------------------------
   let the ranks that read do so; an error of one of them is one of all
------------------------------------------------------------------------- */

void FlowGrid::attempt(const std::function<void()> &work) const
{
  frames.synchronize();
  std::string text;
  if (frames.writer()) {
    try {
      work();
    } catch (const std::bad_alloc &) {
      text = "is too large for the memory of this machine";
    } catch (const std::exception &problem) {
      text = problem.what();
    }
  }
  frames.synchronize();
  int first = text.empty() ? comm->nprocs : comm->me;
  MPI_Allreduce(MPI_IN_PLACE, &first, 1, MPI_INT, MPI_MIN, world);
  if (first == comm->nprocs) return;
  int length = text.size();
  MPI_Bcast(&length, 1, MPI_INT, first, world);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, first, world);
  error->all(FLERR, position, "Fix flow/field file {}: {}", path, text);
}

/* ----------------------------------------------------------------------
   the file's grid, in the box
------------------------------------------------------------------------- */

void FlowGrid::make_lattice()
{
  lattice.dims = domain->dimension;
  for (int k = 0; k < 3; k++) {
    lattice.n[k] = image.n[k];
    lattice.origin[k] = image.origin[k];
    lattice.spacing[k] = image.spacing[k];
  }
  if (lattice.dims == 2) {
    if (image.n[2] > 2)
      error->all(FLERR, position,
                 "Fix flow/field file {}: a 2d simulation takes 1 or 2 layers of nodes along z, "
                 "got {}",
                 path, image.n[2]);
    lattice.n[2] = 1;
  }
  for (int k = 0; k < lattice.dims; k++) {
    if (image.n[k] < 2)
      error->all(FLERR, position,
                 "Fix flow/field file {}: {}d simulations need 2 or more nodes along {}, got {}",
                 path, lattice.dims, "xyz"[k], image.n[k]);
    lattice.periodic[k] = periodic(k, position);
    // the last node may repeat the first one
    if (lattice.periodic[k])
      lattice.n[k] = std::lround((domain->boxhi[k] - domain->boxlo[k]) / image.spacing[k]);
  }
}

/* ----------------------------------------------------------------------
   whether the grid is periodic along an axis: so is the box, and their lengths agree
------------------------------------------------------------------------- */

bool FlowGrid::periodic(int k, int iarg) const
{
  const double lo = domain->boxlo[k], hi = domain->boxhi[k], tolerance = box_tolerance * (hi - lo);
  const double first = image.origin[k], last = first + (image.n[k] - 1) * image.spacing[k];
  if (domain->periodicity[k]) {
    if (std::fabs(last - first - (hi - lo)) <= tolerance) return true;
    if (std::fabs(last - first + image.spacing[k] - (hi - lo)) <= tolerance) return true;
  }
  // shrink-wrapped boundaries follow the particles
  const bool low = domain->boundary[k][0] > 1 || first <= lo + tolerance;
  const bool high = domain->boundary[k][1] > 1 || last >= hi - tolerance;
  if (!options.clamp && !(low && high))
    error->all(FLERR, iarg,
               "Fix flow/field file {}: the grid spans {} to {} along {} and does not cover the "
               "box, {} to {}; keyword outside clamp continues it",
               path, first, last, "xyz"[k], lo, hi);
  return false;
}

/* ---------------------------------------------------------------------- */

void FlowGrid::check_box(int iarg) const
{
  for (int k = 0; k < lattice.dims; k++) {
    bool changes = false;
    for (const auto &fix : modify->get_fix_list())
      changes = changes || (fix->box_change & (Fix::BOX_CHANGE_X << k));
    if (periodic(k, iarg) != lattice.periodic[k] || (lattice.periodic[k] && changes))
      error->all(FLERR, iarg,
                 "Fix flow/field file {}: the box must keep its length and boundaries along {}, "
                 "where the flow's grid is as the box when the fix was defined",
                 path, "xyz"[k]);
  }
}

/* ---------------------------------------------------------------------- */

std::string FlowGrid::extent() const
{
  std::string text;
  for (int k = 0; k < lattice.dims; k++)
    text += fmt::format("{}{} = {:.8g} to {:.8g}", k ? ", " : "", "xyz"[k], image.origin[k],
                        image.origin[k] + (image.n[k] - 1) * image.spacing[k]);
  return text;
}

/* ----------------------------------------------------------------------
   an array of the file at the different nodes of the lattice
------------------------------------------------------------------------- */

std::vector<double> FlowGrid::nodes_of(const std::vector<double> &values, int components) const
{
  std::vector<double> kept;
  kept.reserve(lattice.nodes() * components);
  for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
    const double *from = &values[components * (i + image.n[0] * (j + std::size_t(image.n[1]) * k))];
    kept.insert(kept.end(), from, from + components);
  });
  return kept;
}

/* ----------------------------------------------------------------------
   whether the last layers of periodic directions repeat the first ones
------------------------------------------------------------------------- */

void FlowGrid::check_repeated(const std::vector<double> &u) const
{
  double largest = 0.0, difference[3] = {0.0, 0.0, 0.0};
  for (const double a : u) largest = std::max(largest, std::fabs(a));
  std::size_t node = 0;
  for (int k = 0; k < layers(); k++)
    for (int j = 0; j < image.n[1]; j++)
      for (int i = 0; i < image.n[0]; i++, node++) {
        const int index[3] = {i, j, k};
        std::size_t stride = 1;
        for (int axis = 0; axis < lattice.dims; stride *= image.n[axis++]) {
          if (index[axis] < lattice.n[axis]) continue;
          const double *first = &u[3 * (node - lattice.n[axis] * stride)];
          for (int c = 0; c < lattice.dims; c++)
            difference[axis] = std::max(difference[axis], std::fabs(u[3 * node + c] - first[c]));
        }
      }
  for (int axis = 0; axis < lattice.dims; axis++)
    if (comm->me == 0 && difference[axis] > repeat_tolerance * largest)
      error->warning(FLERR,
                     "Fix flow/field file {}: velocities of the first and the last layer along "
                     "periodic {} differ by up to {:.3g}; the first one is taken",
                     path, "xyz"[axis], difference[axis]);
}

/* ----------------------------------------------------------------------
   read a frame and write its records
------------------------------------------------------------------------- */

void FlowGrid::load(int frame)
{
  const int slot = frame % 2;
  attempt([&] {
    const auto values = file->read("velocity", 3, frame, layers());
    check_repeated(values);
    auto velocity = nodes_of(values, 3);
    if (known_distance && options.reconstruct)
      apf::WallExtension(lattice, distance, velocity).fill();
    apf::write_records(lattice, detail, velocity, distance, frames.data() + slot * size);
  });
  frame_in[slot] = frame;
}

/* ---------------------------------------------------------------------- */

void FlowGrid::require(apf::Detail wanted)
{
  if (size > 0 && wanted <= detail) return;
  detail = wanted;
  size = apf::frame_size(lattice, detail);
  const std::size_t all = series() ? 2 * size : size;
  int enough = frames.allocate(all);
  MPI_Allreduce(MPI_IN_PLACE, &enough, 1, MPI_INT, MPI_MIN, world);
  if (!enough)
    error->all(FLERR, position,
               "Fix flow/field file {}: {:.4g} Mbytes of memory, shared by the ranks of a node, "
               "cannot be had",
               path, all * sizeof(double) / 1048576.0);
  frame_in[0] = frame_in[1] = -1;
}

/* ---------------------------------------------------------------------- */

void FlowGrid::set_time(double time)
{
  if (!series()) {
    if (frame_in[0] < 0) load(0);
    return;
  }
  const double first = times.front(), last = times.back(), length = last - first;
  now = time;
  if (options.loop) {
    now = first + std::fmod(time - first, length);
    if (now < first) now += length;
  } else if (time < first - box_tolerance * length || time > last + box_tolerance * length)
    error->all(FLERR, position,
               "Fix flow/field file {}: its series lasts from {:.8g} to {:.8g}, the simulation is "
               "at time {:.8g}; keyword loop yes repeats it",
               path, first, last, time);
  now = std::clamp(now, first, last);

  const auto next = std::upper_bound(times.begin() + 1, times.end() - 1, now);
  interval = next - times.begin() - 1;
  for (const int frame : {interval, interval + 1})
    if (frame_in[frame % 2] != frame) load(frame);
  share = (now - times[interval]) / (times[interval + 1] - times[interval]);
}

/* ---------------------------------------------------------------------- */

apf::GridFlow FlowGrid::flow() const
{
  apf::GridFlow result;
  result.view = apf::grid_view(lattice, detail);
  result.view.frame[0] = frames.data() + (interval % 2) * size;
  if (series()) {
    result.view.frame[1] = frames.data() + ((interval + 1) % 2) * size;
    result.view.share = share;
    result.view.per_time = 1.0 / (times[interval + 1] - times[interval]);
  }
  return result;
}

/* ---------------------------------------------------------------------- */

double FlowGrid::memory_usage() const
{
  return frames.bytes() + distance.size() * sizeof(double);
}
