#include "flow_grid.h"

#include "argument_reader.h"
#include "comm.h"
#include "domain.h"
#include "error.h"

#include "flow/wall_extension.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>

using namespace LAMMPS_NS;

static constexpr double time_tolerance = 1.0e-9;      // of the length of the series
static constexpr double repeat_tolerance = 1.0e-6;    // of the largest velocity

/* ---------------------------------------------------------------------- */

int FlowGrid::Options::parse(LAMMPS *lmp, int iarg, int narg, char **arg)
{
  const struct {
    const char *keyword;
    const char *words[2];
    bool &value;    // set by the first word
  } table[] = {{"loop", {"yes", "no"}, loop},
               {"outside", {"clamp", "error"}, clamp},
               {"wall", {"reconstruct", "plain"}, reconstruct}};
  for (const auto &row : table) {
    if (strcmp(arg[iarg], row.keyword) != 0) continue;
    if (iarg + 2 > narg)
      utils::missing_cmd_args(FLERR, std::string("fix flow/field ") + row.keyword, lmp->error);
    const ArgumentReader reader(lmp, "Fix flow/field", arg);
    row.value = reader.choice(iarg + 1, row.keyword, {row.words[0], row.words[1]}) == 0;
    return iarg + 2;
  }
  return iarg;
}

/* ---------------------------------------------------------------------- */

FlowGrid::FlowGrid(LAMMPS *lmp, const std::string &path_in, const Options &options_in, int iarg) :
    GridFile(lmp, "Fix flow/field", path_in, iarg), options(options_in)
{
  look([this] {
    times = file->times();
    known_distance = file->has("distance");
    digest.add(&known_distance, 1);
    // before the box is compared with a grid that may not be that of the arrays
    file->check("velocity", 3);
    if (known_distance) file->check("distance", 1);
  });
  int nsteps = times.size(), has = known_distance;
  MPI_Bcast(&has, 1, MPI_INT, 0, world);
  MPI_Bcast(&nsteps, 1, MPI_INT, 0, world);
  times.resize(nsteps);
  MPI_Bcast(times.data(), nsteps, MPI_DOUBLE, 0, world);
  known_distance = has;

  make_lattice(options.clamp, "; keyword outside clamp continues it");
  if (known_distance)
    attempt([this] {
      distance = nodes_of(read("distance", 1), 1);
      if (*std::max_element(distance.begin(), distance.end()) <= 0.0)
        throw std::runtime_error("array distance is > 0 nowhere: it must be so in the fluid");
    });
  warn_of_doubts();
  if (series()) now = times.front();
  require(detail);
  load(0);
  position = Error::NOLASTLINE;
}

/* ----------------------------------------------------------------------
   what can be right, but hardly was meant
------------------------------------------------------------------------- */

void FlowGrid::warn_of_doubts() const
{
  constexpr double few_cells = 0.1;
  if (comm->me != 0) return;
  if (options.loop && !series())
    error->warning(FLERR, "Fix flow/field file {}: the flow is steady, keyword loop has no effect",
                   path);
  for (int axis = 0; axis < lattice.dims; axis++) {
    const double length = domain->boxhi[axis] - domain->boxlo[axis];
    if (length >= few_cells * lattice.spacing[axis]) continue;
    error->warning(FLERR,
                   "Fix flow/field file {}: the box is {:.4g} long along {}, a small part of a "
                   "cell, {:.4g}: are the numbers in the file in the units of the input?",
                   path, length, "xyz"[axis], lattice.spacing[axis]);
    break;    // one axis tells
  }
}

/* ----------------------------------------------------------------------
   whether the last layers of periodic directions repeat the first ones
------------------------------------------------------------------------- */

void FlowGrid::check_repeated(const std::vector<double> &u)
{
  if (told_of_repeated) return;
  double largest = 0.0, difference[3] = {0.0, 0.0, 0.0};
  for (const double a : u) largest = std::max(largest, std::fabs(a));
  std::size_t node = 0;
  for (int k = 0; k < layers(); k++)
    for (int j = 0; j < image.n[1]; j++)
      for (int i = 0; i < image.n[0]; i++, node++) {
        const int index[3] = {i, j, k};
        std::size_t stride = 1;
        for (int axis = 0; axis < lattice.dims; stride *= image.n[axis++]) {
          // NOLINTNEXTLINE(clang-analyzer-core.*): there are no more than three axes
          if (index[axis] < lattice.n[axis]) continue;
          const double *first = &u[3 * (node - lattice.n[axis] * stride)];
          for (int c = 0; c < lattice.dims; c++)
            difference[axis] = std::max(difference[axis], std::fabs(u[3 * node + c] - first[c]));
        }
      }
  for (int axis = 0; axis < lattice.dims; axis++)
    // NOLINTNEXTLINE(clang-analyzer-core.*): there are no more than three axes
    if (comm->me == 0 && difference[axis] > repeat_tolerance * largest) {
      told_of_repeated = true;
      error->warning(FLERR,
                     "Fix flow/field file {}: velocities of the first and the last layer along "
                     "periodic {} differ by up to {:.3g}; the first one is taken",
                     path, "xyz"[axis], difference[axis]);
    }
}

/* ----------------------------------------------------------------------
   read a frame and write its records
------------------------------------------------------------------------- */

void FlowGrid::load(int frame)
{
  const int slot = frame % 2;
  attempt([&] {
    const auto values = read("velocity", 3, frame);
    check_repeated(values);
    auto velocity = nodes_of(values, 3);
    if (known_distance && options.reconstruct)
      apf::WallExtension(lattice, distance, velocity).fill();
    apf::write_records(lattice, detail, velocity, distance, numbers.data() + slot * size);
  });
  frame_in[slot] = frame;
}

/* ---------------------------------------------------------------------- */

void FlowGrid::require(apf::Detail wanted)
{
  if (size > 0 && wanted <= detail) return;
  detail = wanted;
  size = apf::frame_size(lattice, detail);
  allocate(series() ? 2 * size : size);
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
  } else if (time < first - time_tolerance * length || time > last + time_tolerance * length)
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
  result.view.frame[0] = numbers.data() + (interval % 2) * size;
  if (series()) {
    result.view.frame[1] = numbers.data() + ((interval + 1) % 2) * size;
    result.view.share = share;
    result.view.per_time = 1.0 / (times[interval + 1] - times[interval]);
  }
  return result;
}

/* ---------------------------------------------------------------------- */

double FlowGrid::memory_usage() const
{
  return numbers.bytes() + distance.size() * sizeof(double);
}
