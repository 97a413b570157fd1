// Clouds of particles on a grid by convolution: particles are put on a grid by B-splines, which is
// then smoothed in Fourier space (flow/cloud_spectrum.h). Closed borders get margins that clouds
// run out into. A cloud's share in the fluid is known to the last bits before it is spread: the
// spread of the fluid's cells, taken at the particle with the weights of its spline, is the sum of
// its cloud over them.

#ifndef LMP_CLOUD_CONVOLUTION_H
#define LMP_CLOUD_CONVOLUTION_H

#include "cell_grid.h"
#include "pointers.h"
#include "slab_transform.h"

#include "flow/cloud_spectrum.h"

#include <array>
#include <memory>
#include <vector>

namespace LAMMPS_NS {

class CloudConvolution : protected Pointers {
 public:
  // R of all clouds. Collective.
  CloudConvolution(LAMMPS *, const CellGrid &, double radius);

  // Estimated time for so many particles, of one processor, in ns
  static double cost(LAMMPS *, const CellGrid &, double radius, double particles, bool closed);

  // fluid: 1 in cells that clouds may lie in, else 0; without it that is all space. Collective.
  void set_fluid(const CellGrid &fluid);

  // Between begin() and end() one particle after another: its position, false if that is too far
  // from this rank's part of the box; then how much of its cloud lies in the fluid, or the amount
  // that it adds. After end(), collective, `at` is the sum of clouds in cells of this rank.
  void begin();
  bool locate(const double *x);
  double share() const;
  void add(double amount);
  void end();
  double at(int x, int y, int z) const { return brick[index(x, y, z)]; }

  double memory_usage() const;

 private:
  struct Shape {
    std::array<int, 3> order, n;    // of splines; cells with margins
  };
  struct Brick {
    int lo[3], hi[3];    // cells, not wrapped; both ends included
  };
  static Shape shape_of(LAMMPS *, const CellGrid &, double radius);

  const CellGrid &grid;
  Shape shape;
  int outer, middle;    // axes normal to slabs, and along the lines of a plane
  std::array<std::vector<double>, 3> spectrum;
  std::unique_ptr<SlabTransform> slab;

  std::vector<Brick> bricks;                // cells that particles of each rank write to
  std::vector<std::array<int, 2>> slabs;    // first plane of each rank, and their number
  Brick mine;
  size_t stride[3];
  std::vector<double> brick, fluid_share;    // on `mine`
  std::vector<double> brick_buffer, slab_buffer;
  std::vector<int> brick_counts, brick_starts, slab_counts, slab_starts;

  int base[3];    // of the particle located last
  double weight[3][apf::longest_spline];

  size_t index(int x, int y, int z) const
  {
    return stride[0] * (x - mine.lo[0]) + stride[1] * (y - mine.lo[1]) +
        stride[2] * (z - mine.lo[2]);
  }
  size_t plane_size(const Brick &b) const
  {
    return static_cast<size_t>(b.hi[0] - b.lo[0] + 1) * (b.hi[middle] - b.lo[middle] + 1);
  }
  void make_brick();
  void make_exchange();
  template <class Act> void for_planes(const Brick &, int rank, Act act) const;
  template <class Act> void for_slab(Act act);
};

}    // namespace LAMMPS_NS

#endif
