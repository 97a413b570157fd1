#include "cell_grid.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix.h"
#include "grid2d.h"
#include "grid3d.h"
#include "lammps.h"
#include "neighbor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

using namespace LAMMPS_NS;

CellGrid::CellGrid(LAMMPS *_lmp, Fix *_owner, const std::array<int, 3> &count, int _columns,
                   int _which) :
    n(count),
    columns(_columns), lmp(_lmp), owner(_owner), which(_which), flat(_lmp->domain->dimension == 2)
{
}

CellGrid::~CellGrid() = default;

// LAMMPS counts a rank's cells in an int; its grids cannot be destroyed after its error of too
// many.
void CellGrid::check_size(int reach) const
{
  double numbers = columns;
  for (int c = 0; c < dimension(); c++)
    numbers *= static_cast<double>(n[c]) / lmp->comm->procgrid[c] + 2.0 * reach + 4.0;
  if (numbers > std::numeric_limits<int>::max())
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "Fix {} {}: a grid of {} x {} x {} cells, with what particles reach beyond a "
                    "rank's, has {:.3g} numbers on a rank, more than 2^31: use fewer cells, a "
                    "smaller cloud or more ranks",
                    owner->id, owner->style, n[0], n[1], n[2], numbers);
}

void CellGrid::set_up(int reach)
{
  check_size(reach);
  try {
    allocate(reach);
  } catch (std::bad_alloc &) {
    lmp->error->one(FLERR, Error::NOLASTLINE,
                    "Fix {} {}: no memory for a grid of {} x {} x {} cells", owner->id,
                    owner->style, n[0], n[1], n[2]);
  }
}

// Throws if there is no memory for what is to come: the cells, those that are sent and received,
// and LAMMPS's lists of these, a number for each, whose own error names no command. The lists are
// of slabs along each axis, on both of its sides, that are as wide as the cells before along it.
void CellGrid::try_memory() const
{
  double bytes = sizeof(double) * columns, lists = 0.0;
  for (int c = 0; c < 3; c++) {
    double cells = 2.0 * (lo[c] - first[c] + last[c] - hi[c]);
    for (int d = 0; d < 3; d++)
      if (d != c) cells *= (d < c ? last[d] - first[d] : hi[d] - lo[d]) + 1.0;
    lists += sizeof(int) * cells;
    bytes *= last[c] - first[c] + 1.0;
  }
  // so that no compiler leaves it out
  void *volatile trial = ::operator new(static_cast<std::size_t>(std::max(bytes + lists, 1.0)));
  ::operator delete(trial);
}

// to other ranks: what a cell has
void CellGrid::share_anew(int reach)
{
  const auto old2d = std::move(grid2d);
  const auto old3d = std::move(grid3d);
  before = std::move(values);
  set_up(reach);
  int largest, all;
  auto remap = [&](auto &grid, const auto &old) {
    grid->setup_remap(old.get(), largest, all);
    std::vector<double> buf(static_cast<size_t>(columns) * largest),
        received(static_cast<size_t>(columns) * all);
    grid->remap(grid->FIX, owner, which, columns, sizeof(double), buf.data(), received.data(),
                MPI_DOUBLE);
  };
  if (flat)
    remap(grid2d, old2d);
  else
    remap(grid3d, old3d);
  before = std::vector<double>();
}

void CellGrid::allocate(int reach)
{
  const Domain *domain = lmp->domain;
  const double farthest = 0.5 * lmp->neighbor->skin;
  int most_out, most_in;
  if (flat) {
    grid2d = std::make_unique<Grid2d>(lmp, lmp->world, n[0], n[1]);
    grid2d->set_distance(farthest);
    grid2d->set_stencil_atom(reach, reach);
    grid2d->setup_grid(lo[0], hi[0], lo[1], hi[1], first[0], last[0], first[1], last[1]);
    lo[2] = hi[2] = first[2] = last[2] = 0;
    try_memory();
    grid2d->setup_comm(most_out, most_in);
  } else {
    grid3d = std::make_unique<Grid3d>(lmp, lmp->world, n[0], n[1], n[2]);
    grid3d->set_distance(farthest);
    grid3d->set_stencil_atom(reach, reach);
    grid3d->setup_grid(lo[0], hi[0], lo[1], hi[1], lo[2], hi[2], first[0], last[0], first[1],
                       last[1], first[2], last[2]);
    try_memory();
    grid3d->setup_comm(most_out, most_in);
  }
  cell_volume = 1.0;
  size_t all = columns;
  for (int c = 0; c < 3; c++) {
    periodic[c] = domain->periodicity[c] && !(flat && c == 2);
    origin[c] = domain->boxlo[c];
    spacing[c] = domain->prd[c] / n[c];
    inverse_spacing[c] = 1.0 / spacing[c];
    if (!(flat && c == 2)) cell_volume *= spacing[c];
    size[c] = last[c] - first[c] + 1;
    all *= size[c];
  }
  values.assign(all, 0.0);
  out.resize(static_cast<size_t>(columns) * most_out);
  in.resize(static_cast<size_t>(columns) * most_in);
  point_to_values();
}

// LAMMPS reads per-grid data through pointers to pointers, offset by the first ghost cell
void CellGrid::point_to_values()
{
  const size_t nlines = static_cast<size_t>(size[1]) * size[2];
  const size_t step = static_cast<size_t>(columns) * size[0];
  lines.resize(nlines);
  planes.resize(size[2]);
  for (size_t l = 0; l < nlines; l++) lines[l] = values.data() + l * step - first[0];
  for (int z = 0; z < size[2]; z++) planes[z] = &lines[z * static_cast<size_t>(size[1])] - first[1];
  if (columns == 1) return;
  cells.resize(nlines * size[0]);
  cell_lines.resize(nlines);
  cell_planes.resize(size[2]);
  for (size_t k = 0; k < cells.size(); k++) cells[k] = values.data() + k * columns;
  for (size_t l = 0; l < nlines; l++) cell_lines[l] = &cells[l * size[0]] - first[0];
  for (int z = 0; z < size[2]; z++)
    cell_planes[z] = &cell_lines[z * static_cast<size_t>(size[1])] - first[1];
}

/* ---------------------------------------------------------------------- */

void CellGrid::clear()
{
  std::fill(values.begin(), values.end(), 0.0);
}

void CellGrid::sum_ghosts()
{
  if (flat)
    grid2d->reverse_comm(Grid2d::FIX, owner, which, columns, sizeof(double), out.data(), in.data(),
                         MPI_DOUBLE);
  else
    grid3d->reverse_comm(Grid3d::FIX, owner, which, columns, sizeof(double), out.data(), in.data(),
                         MPI_DOUBLE);
}

void CellGrid::fill_ghosts()
{
  if (flat)
    grid2d->forward_comm(Grid2d::FIX, owner, which, columns, sizeof(double), out.data(), in.data(),
                         MPI_DOUBLE);
  else
    grid3d->forward_comm(Grid3d::FIX, owner, which, columns, sizeof(double), out.data(), in.data(),
                         MPI_DOUBLE);
}

/* ---------------------------------------------------------------------- */

bool CellGrid::trilinear(const double *x, int *base, double *weight) const
{
  double share[3];
  for (int c = 0; c < 3; c++) {
    double s = (x[c] - origin[c]) * inverse_spacing[c] - 0.5;
    if (!periodic[c]) s = std::min(std::max(s, 0.0), n[c] - 1.0);
    base[c] = static_cast<int>(std::floor(s));
    if (!periodic[c]) base[c] = std::max(0, std::min(base[c], n[c] - 2));
    share[c] = s - base[c];
    if (!(base[c] >= first[c] && next(c, base[c]) <= last[c])) return false;
  }
  for (int k = 0; k < 8; k++)
    weight[k] = (k & 1 ? share[0] : 1.0 - share[0]) * (k & 2 ? share[1] : 1.0 - share[1]) *
        (k & 4 ? share[2] : 1.0 - share[2]);
  return true;
}

/* ---------------------------------------------------------------------- */

void *CellGrid::lammps_grid() const
{
  return flat ? static_cast<void *>(grid2d.get()) : static_cast<void *>(grid3d.get());
}

void *CellGrid::lammps_data()
{
  if (columns == 1)
    return flat ? static_cast<void *>(planes[0]) : static_cast<void *>(planes.data() - first[2]);
  return flat ? static_cast<void *>(cell_planes[0])
              : static_cast<void *>(cell_planes.data() - first[2]);
}

void CellGrid::pack(double *buf, int count, const int *list) const
{
  for (int k = 0; k < count; k++)
    buf = std::copy_n(&values[static_cast<size_t>(columns) * list[k]], columns, buf);
}

void CellGrid::pack_before(double *buf, int count, const int *list) const
{
  for (int k = 0; k < count; k++)
    buf = std::copy_n(&before[static_cast<size_t>(columns) * list[k]], columns, buf);
}

void CellGrid::unpack_set(const double *buf, int count, const int *list)
{
  for (int k = 0; k < count; k++, buf += columns)
    std::copy_n(buf, columns, &values[static_cast<size_t>(columns) * list[k]]);
}

void CellGrid::unpack_add(const double *buf, int count, const int *list)
{
  for (int k = 0; k < count; k++)
    for (int c = 0; c < columns; c++) values[static_cast<size_t>(columns) * list[k] + c] += *buf++;
}

double CellGrid::memory_usage() const
{
  return (values.capacity() + out.capacity() + in.capacity()) * sizeof(double) +
      (lines.capacity() + cells.capacity()) * sizeof(double *);
}
