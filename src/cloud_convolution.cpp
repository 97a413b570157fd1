#include "cloud_convolution.h"

#include "comm.h"
#include "domain.h"
#include "neighbor.h"

#include "flow/gaussian_cloud.h"

#include <algorithm>
#include <cmath>
#include <numeric>

using namespace LAMMPS_NS;

static int wrapped(int cell, int n)
{
  return cell - n * static_cast<int>(std::floor(static_cast<double>(cell) / n));
}

// the next number that has no prime factor above 7, as FFTW likes it
static int quick_size(int n)
{
  for (;; n++) {
    int rest = n;
    for (int factor : {2, 3, 5, 7})
      while (rest % factor == 0) rest /= factor;
    if (rest == 1) return n;
  }
}

/* ---------------------------------------------------------------------- */

CloudConvolution::CloudConvolution(LAMMPS *lmp, const CellGrid &_grid, double radius) :
    Pointers(lmp), grid(_grid), shape(shape_of(lmp, grid, radius)),
    outer(grid.dimension() == 2 ? 1 : 2), middle(3 - outer)
{
  slab = std::make_unique<SlabTransform>(
      world, std::array<int, 3>{shape.n[outer], shape.n[middle], shape.n[0]});
  const int axes[3] = {outer, middle, 0};
  for (int a = 0; a < 3; a++) {
    const int c = axes[a], n = shape.n[c];
    spectrum[a].resize(n);
    for (int k = 0; k < n; k++)
      spectrum[a][k] = apf::cloud_spectrum(shape.order[c], radius * grid.inverse_spacing[c],
                                           2.0 * apf::pi * std::min(k, n - k) / n) /
          n;
  }
  make_brick();
  make_exchange();
}

// Margins are as wide as a cloud reaches from a particle as far outside as it may be.
CloudConvolution::Shape CloudConvolution::shape_of(LAMMPS *lmp, const CellGrid &grid, double radius)
{
  Shape shape{{1, 1, 1}, grid.n};
  for (int c = 0; c < grid.dimension(); c++) {
    const double cells = radius * grid.inverse_spacing[c];
    shape.order[c] = apf::spline_order(cells);
    if (!grid.periodic[c])
      shape.n[c] = quick_size(
          grid.n[c] + apf::cloud_cells(cells, 1.0) + shape.order[c] + 2 +
          static_cast<int>(std::ceil(0.5 * lmp->neighbor->skin * grid.inverse_spacing[c])));
  }
  return shape;
}

// ns for a weight of a spline, and for a cell of the grid at each doubling of their number:
// bench/concentration.py
static constexpr double weight_cost = 0.9, cell_cost = 0.8;

double CloudConvolution::cost(LAMMPS *lmp, const CellGrid &grid, double radius, double particles,
                              bool closed)
{
  const Shape shape = shape_of(lmp, grid, radius);
  double cells = 1.0, weights = closed ? 2.0 : 1.0;
  for (int c = 0; c < 3; c++) {
    cells *= shape.n[c];
    weights *= shape.order[c];
  }
  return particles * weights * weight_cost + cells * std::log2(cells) * cell_cost;
}

/* ----------------------------------------------------------------------
   cells that a particle of this rank writes to before it changes ranks, and those that it owns
------------------------------------------------------------------------- */

void CloudConvolution::make_brick()
{
  const double farthest = 0.5 * neighbor->skin;
  for (int c = 0; c < 3; c++) {
    mine.lo[c] = mine.hi[c] = 0;
    if (c == 2 && grid.dimension() == 2) continue;
    const double begin = domain->sublo[c] - farthest - grid.origin[c];
    const double end = domain->subhi[c] + farthest - grid.origin[c];
    const int reach = shape.order[c] / 2 + 1;
    mine.lo[c] =
        std::min(grid.lo[c], static_cast<int>(std::floor(begin * grid.inverse_spacing[c])) - reach);
    mine.hi[c] =
        std::max(grid.hi[c], static_cast<int>(std::floor(end * grid.inverse_spacing[c])) + reach);
  }
  stride[0] = 1;
  stride[middle] = mine.hi[0] - mine.lo[0] + 1;
  stride[outer] = plane_size(mine);
  brick.assign(stride[outer] * (mine.hi[outer] - mine.lo[outer] + 1), 0.0);
}

void CloudConvolution::make_exchange()
{
  const int nprocs = comm->nprocs;
  bricks.resize(nprocs);
  slabs.resize(nprocs);
  const std::array<int, 2> own = {slab->first, slab->count};
  MPI_Allgather(&mine, 6, MPI_INT, bricks.data(), 6, MPI_INT, world);
  MPI_Allgather(own.data(), 2, MPI_INT, slabs.data(), 2, MPI_INT, world);
  auto count = [&](const Brick &b, int rank) {
    size_t planes = 0;
    for_planes(b, rank, [&](int, int) {
      planes++;
    });
    return static_cast<int>(planes * plane_size(b));
  };
  auto starts = [](const std::vector<int> &counts) {
    std::vector<int> at(counts.size(), 0);
    std::partial_sum(counts.begin(), counts.end() - 1, at.begin() + 1);
    return at;
  };
  for (int rank = 0; rank < nprocs; rank++) {
    brick_counts.push_back(count(mine, rank));
    slab_counts.push_back(count(bricks[rank], comm->me));
  }
  brick_starts = starts(brick_counts);
  slab_starts = starts(slab_counts);
  brick_buffer.resize(brick.size());
  slab_buffer.resize(static_cast<size_t>(slab_starts.back()) + slab_counts.back());
}

// planes of a brick that lie in the slab of a rank: their number in the brick, and in the grid
template <class Act> void CloudConvolution::for_planes(const Brick &b, int rank, Act act) const
{
  for (int o = b.lo[outer]; o <= b.hi[outer]; o++) {
    const int plane = wrapped(o, shape.n[outer]);
    if (plane >= slabs[rank][0] && plane < slabs[rank][0] + slabs[rank][1]) act(o, plane);
  }
}

// cells of this rank's slab and what goes to or comes from the bricks of all ranks, in order
template <class Act> void CloudConvolution::for_slab(Act act)
{
  double *there = slab_buffer.data();
  for (int rank = 0; rank < comm->nprocs; rank++) {
    const Brick &b = bricks[rank];
    for_planes(b, comm->me, [&](int, int plane) {
      for (int l = b.lo[middle]; l <= b.hi[middle]; l++) {
        double *line = slab->line(plane, wrapped(l, shape.n[middle]));
        int x = wrapped(b.lo[0], shape.n[0]);
        for (int k = b.lo[0]; k <= b.hi[0]; k++) {
          act(line[x], *there++);
          if (++x == shape.n[0]) x = 0;
        }
      }
    });
  }
}

/* ----------------------------------------------------------------------
   the brick's cells are added up on the grid, which is smoothed and read back
------------------------------------------------------------------------- */

void CloudConvolution::end()
{
  auto for_brick = [&](auto act) {
    double *there = brick_buffer.data();
    for (int rank = 0; rank < comm->nprocs; rank++)
      for_planes(mine, rank, [&](int o, int) {
        act(&brick[stride[outer] * (o - mine.lo[outer])], there);
        there += stride[outer];
      });
  };
  for_brick([&](double *here, double *there) {
    std::copy_n(here, stride[outer], there);
  });
  MPI_Alltoallv(brick_buffer.data(), brick_counts.data(), brick_starts.data(), MPI_DOUBLE,
                slab_buffer.data(), slab_counts.data(), slab_starts.data(), MPI_DOUBLE, world);
  slab->clear();
  for_slab([](double &cell, double &there) {
    cell += there;
  });
  slab->filter(spectrum);
  for_slab([](double &cell, double &there) {
    there = cell;
  });
  MPI_Alltoallv(slab_buffer.data(), slab_counts.data(), slab_starts.data(), MPI_DOUBLE,
                brick_buffer.data(), brick_counts.data(), brick_starts.data(), MPI_DOUBLE, world);
  for_brick([&](double *here, double *there) {
    std::copy_n(there, stride[outer], here);
  });
}

void CloudConvolution::begin()
{
  std::fill(brick.begin(), brick.end(), 0.0);
}

void CloudConvolution::set_fluid(const CellGrid &fluid)
{
  begin();
  grid.for_own_cells([&](int x, int y, int z) {
    brick[index(x, y, z)] = *fluid.at(x, y, z);
  });
  end();
  fluid_share = brick;
}

/* ---------------------------------------------------------------------- */

bool CloudConvolution::locate(const double *x)
{
  for (int c = 0; c < 3; c++) {
    base[c] = apf::spline_weights(shape.order[c], (x[c] - grid.origin[c]) * grid.inverse_spacing[c],
                                  weight[c]);
    if (c == 2 && grid.dimension() == 2) base[c] = 0;
    if (base[c] < mine.lo[c] || base[c] + shape.order[c] - 1 > mine.hi[c]) return false;
  }
  return true;
}

double CloudConvolution::share() const
{
  double sum = 0.0;
  for (int z = 0; z < shape.order[2]; z++)
    for (int y = 0; y < shape.order[1]; y++) {
      const double *line = &fluid_share[index(base[0], base[1] + y, base[2] + z)];
      double along = 0.0;
      for (int x = 0; x < shape.order[0]; x++) along += weight[0][x] * line[x];
      sum += weight[2][z] * weight[1][y] * along;
    }
  return sum;
}

void CloudConvolution::add(double amount)
{
  for (int z = 0; z < shape.order[2]; z++)
    for (int y = 0; y < shape.order[1]; y++) {
      double *line = &brick[index(base[0], base[1] + y, base[2] + z)];
      const double yz = amount * weight[2][z] * weight[1][y];
      for (int x = 0; x < shape.order[0]; x++) line[x] += yz * weight[0][x];
    }
}

double CloudConvolution::memory_usage() const
{
  return sizeof(double) *
      (brick.capacity() + fluid_share.capacity() + brick_buffer.capacity() +
       slab_buffer.capacity() + slab->memory());
}
