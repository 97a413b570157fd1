#include "grid_file.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "modify.h"
#include "particle_checks.h"
#include "read_guard.h"

#include <climits>
#include <cmath>
#include <stdexcept>

using namespace LAMMPS_NS;

static constexpr double box_tolerance = 1.0e-9;    // of the box's length

/* ---------------------------------------------------------------------- */

GridFile::GridFile(LAMMPS *lmp, const char *command_in, const std::string &path_in, int iarg) :
    Pointers(lmp), command(command_in), path(path_in), position(iarg), numbers(world)
{
  check_orthogonal(lmp, command + " file requires", iarg);
  look([this] {
    file = std::make_unique<apf::VtkhdfFile>(path);
    image = file->grid();
    digest.add(image.n, 3).add(image.origin, 3).add(image.spacing, 3);
    digest.add(file->times().data(), file->times().size());
  });
  MPI_Bcast(&image, sizeof(image), MPI_BYTE, 0, world);
}

/* ---------------------------------------------------------------------- */

void GridFile::attempt(const std::function<void()> &work)
{
  numbers.synchronize();
  std::string text;
  if (numbers.writer()) {
    try {
      work();
    } catch (const std::bad_alloc &) {
      text = "is too large for the memory of this machine";
    } catch (const std::exception &problem) {
      text = problem.what();
    }
  }
  numbers.synchronize();
  // the lowest rank that failed; the least and the largest of what those who read have seen
  const auto seen = static_cast<long long>(digest.value() >> 1);    // >= 0
  long long lowest[3] = {text.empty() ? comm->nprocs : comm->me, LLONG_MAX, LLONG_MAX};
  if (numbers.writer()) {
    lowest[1] = seen;
    lowest[2] = -seen;
  }
  MPI_Allreduce(MPI_IN_PLACE, lowest, 3, MPI_LONG_LONG, MPI_MIN, world);
  const int first = lowest[0];
  if (first == comm->nprocs) {
    if (lowest[1] == -lowest[2]) return;
    error->all(FLERR, position,
               "{} file {}: the nodes of this machine have different files of this name, which one "
               "rank of each node reads",
               command, path);
  }
  int length = text.size();
  MPI_Bcast(&length, 1, MPI_INT, first, world);
  text.resize(length);
  MPI_Bcast(text.data(), length, MPI_CHAR, first, world);
  error->all(FLERR, position, "{} file {}: {}", command, path, text);
}

/* ---------------------------------------------------------------------- */

void GridFile::look(const std::function<void()> &work)
{
  attempt([&] {
    const ReadGuard guard(command + " file " + path);
    work();
  });
}

void GridFile::close()
{
  if (!file) return;
  const ReadGuard guard(command + " file " + path);
  file.reset();
}

std::vector<double> GridFile::read(const std::string &array, int components, int frame)
{
  const ReadGuard guard(command + " file " + path, image.nodes() * components);
  auto values = file->read(array, components, frame, layers());
  if (numbers.ranks() < comm->nprocs) digest.add(values.data(), values.size());
  return values;
}

/* ---------------------------------------------------------------------- */

void GridFile::allocate(std::size_t count)
{
  int enough = numbers.allocate(count);
  MPI_Allreduce(MPI_IN_PLACE, &enough, 1, MPI_INT, MPI_MIN, world);
  if (!enough)
    error->all(FLERR, position,
               "{} file {}: {:.4g} Mbytes of memory, shared by the ranks of a node, cannot be had",
               command, path, count * sizeof(double) / 1048576.0);
}

/* ---------------------------------------------------------------------- */

void GridFile::make_lattice(bool continued, const char *advice_in)
{
  goes_on = continued;
  advice = advice_in;
  lattice.dims = domain->dimension;
  for (int k = 0; k < 3; k++) {
    lattice.n[k] = image.n[k];
    lattice.origin[k] = image.origin[k];
    lattice.spacing[k] = image.spacing[k];
  }
  if (lattice.dims == 2) {
    if (image.n[2] > 2)
      error->all(FLERR, position,
                 "{} file {}: a 2d simulation takes 1 or 2 layers of nodes along z, got {}",
                 command, path, image.n[2]);
    lattice.n[2] = 1;
  }
  for (int k = 0; k < lattice.dims; k++) {
    if (image.n[k] < 2)
      error->all(FLERR, position,
                 "{} file {}: {}d simulations need 2 or more nodes along {}, got {}", command, path,
                 lattice.dims, "xyz"[k], image.n[k]);
    lattice.periodic[k] = periodic(k, position);
    // the last node may repeat the first one
    if (lattice.periodic[k])
      lattice.n[k] = std::lround((domain->boxhi[k] - domain->boxlo[k]) / image.spacing[k]);
  }
}

/* ----------------------------------------------------------------------
   whether the grid is periodic along an axis: so is the box, and their lengths agree
------------------------------------------------------------------------- */

bool GridFile::periodic(int k, int iarg) const
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
  if (!goes_on && !(low && high))
    error->all(
        FLERR, iarg,
        "{} file {}: the grid spans {} to {} along {} and does not cover the box, {} to {}{}",
        command, path, first, last, "xyz"[k], lo, hi, advice);
  return false;
}

/* ---------------------------------------------------------------------- */

void GridFile::check_box(int iarg) const
{
  check_orthogonal(lmp, command + " file requires", iarg);
  for (int k = 0; k < lattice.dims; k++) {
    bool changes = false;
    for (const auto &fix : modify->get_fix_list())
      changes = changes || (fix->box_change & (Fix::BOX_CHANGE_X << k));
    if (periodic(k, iarg) != lattice.periodic[k] || (lattice.periodic[k] && changes))
      error->all(FLERR, iarg,
                 "{} file {}: the box must keep its length and boundaries along {}, where the "
                 "file's grid is as the box when the fix was defined",
                 command, path, "xyz"[k]);
  }
}

/* ---------------------------------------------------------------------- */

std::string GridFile::extent() const
{
  std::string text;
  for (int k = 0; k < lattice.dims; k++)
    text += fmt::format("{}{} = {:.8g} to {:.8g}", k ? ", " : "", "xyz"[k], image.origin[k],
                        image.origin[k] + (image.n[k] - 1) * image.spacing[k]);
  return text;
}

/* ---------------------------------------------------------------------- */

std::vector<double> GridFile::nodes_of(const std::vector<double> &values, int components) const
{
  std::vector<double> kept;
  kept.reserve(lattice.nodes() * components);
  for_each_node(lattice, [&](int i, int j, int k, std::size_t) {
    const double *from = &values[components * (i + image.n[0] * (j + std::size_t(image.n[1]) * k))];
    kept.insert(kept.end(), from, from + components);
  });
  return kept;
}
