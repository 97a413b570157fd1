// Compiled once per instruction set (CMakeLists.txt); APF_ISA names the namespace of this copy.
// Cells and weights of a block's points come first, a lane for each point. Then a record's numbers
// are the lanes: eight records (in the plane four) are read as they lie in memory, times the
// point's weights, and four points' sums are transposed into the arrays of the block. Gathers
// instead, a lane for each point there as well, took 1.3 to 1.9 times as long with AVX-512 while
// the grid fitted into a cache.

#include "grid_flow.h"
#include "transpose.h"

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

namespace {

#if defined(__AVX512F__)
  using Real = Octet;
#elif defined(__AVX2__)
  using Real = Quad;
#else
  using Real = Pair;
#endif
  using Whole = decltype(Real{} < Real{});    // whole numbers of 64 bits
  constexpr int width = sizeof(Real) / sizeof(double);

  constexpr int ahead = 8;    // points between a fetch and its use

  constexpr double tolerance = 1e-6;    // of a cell, for points that rounding put outside

  // for numbers whose last bit is worth less than 1/2, any rounding to whole numbers below 2^52
  constexpr double big = 6755399441055744.0;    // 1.5 2^52
  APF_INLINE Real floor(const Real &a)
  {
    const Real near = a + big - big;
    return near > a ? near - 1.0 : near;
  }
  template <class Part> APF_INLINE void store(void *to, const Part &part)
  {
    std::memcpy(to, &part, sizeof(part));
  }

  template <int dims> struct Cells {
    static constexpr int corners = 1 << dims;
    alignas(64) Lanes weight[corners];
    std::int64_t offset[block_width];    // of the record of the cell's first corner
    std::ptrdiff_t corner[corners];      // of the other corners from that

    // Returns whether all points are in the grid. A position that is no number lies outside, and
    // its cell is the first one.
    APF_INLINE bool find(const GridView &grid, const PointBlock &points, int lanes)
    {
      for (int c = 0; c < corners; c++) {
        corner[c] = 0;
        for (int axis = 0; axis < dims; axis++)
          if (c >> axis & 1) corner[c] += grid.stride[axis];
      }
      alignas(64) std::int64_t inside[block_width];    // all bits
      for (int l = 0; l < lanes; l += width) {
        Real first{}, fraction[dims];
        Whole within = first == first;
        for (int axis = 0; axis < dims; axis++) {
          const Real zero{}, cells = zero + grid.cells[axis];
          Real s = (load<Real>(points.x[axis] + l) - grid.origin[axis]) * grid.per_length[axis];
          s -= cells * floor(s * grid.per_cells[axis]);
          const Real above = s > zero ? s : zero, in = above < cells ? above : cells;
          within &= (s - in <= tolerance) & (in - s <= tolerance);
          const Real low = floor(in), cell = low < cells - 1.0 ? low : cells - 1.0;
          fraction[axis] = in - cell;
          first += cell * static_cast<double>(grid.stride[axis]);
        }
        store(inside + l, within);
        // whole numbers are the low bits of their sum with big
        store(offset + l, (Whole) (first + big) - (Whole) (Real{} + big));
        for (int c = 0; c < corners; c++) {
          Real product = c & 1 ? fraction[0] : 1.0 - fraction[0];
          for (int axis = 1; axis < dims; axis++)
            product *= c >> axis & 1 ? fraction[axis] : 1.0 - fraction[axis];
          store(weight[c] + l, product);
        }
      }
      std::int64_t all = -1;
      for (int l = 0; l < points.n; l++) all &= inside[l];
      return all == -1;
    }

    // the records that a point needs, into the nearest cache before they are needed
    template <int fours> APF_INLINE void fetch(const double *records, int lane) const
    {
      for (int c = 0; c < corners; c++)
        for (int n = 0; n < 4 * fours; n += 8)
          __builtin_prefetch(records + offset[lane] + corner[c] + n);
    }

    // four numbers of a record, interpolated to one point
    APF_INLINE Quad at(const double *records, int lane) const
    {
      const double *record = records + offset[lane];
      Quad sum = weight[0][lane] * load<Quad>(record);
      for (int c = 1; c < corners; c++) sum += weight[c][lane] * load<Quad>(record + corner[c]);
      return sum;
    }
  };

  // four numbers of each of four points, to the arrays of these numbers
  APF_INLINE void scatter(Quad (&a)[4], int lane, double *const *to)
  {
    transpose(a);
    for (int c = 0; c < 4; c++) store(to[c] + lane, a[c]);
  }

  // The first `fours` groups of four numbers of the records, to arrays of points; in a series,
  // where rate is not null, also how fast the first four change.
  template <int dims, int fours, bool series>
  APF_INLINE void interpolate(const GridView &grid, const Cells<dims> &cells, int lanes,
                              double *const *to, double *const *rate)
  {
    for (int l = 0; l < lanes; l += 4) {
      for (int p = ahead; p < ahead + 4 && l + p < lanes; p++)
        cells.template fetch<fours>(grid.frame[0], l + p);
      for (int f = 0; f < fours; f++) {
        Quad now[4];
        for (int p = 0; p < 4; p++) now[p] = cells.at(grid.frame[0] + 4 * f, l + p);
        if constexpr (series) {
          Quad change[4];
          for (int p = 0; p < 4; p++) {
            change[p] = cells.at(grid.frame[1] + 4 * f, l + p) - now[p];
            now[p] += grid.share * change[p];
            change[p] *= grid.per_time;
          }
          if (f == 0 && rate) scatter(change, l, rate);
        }
        scatter(now, l, to + 4 * f);
      }
    }
  }

  template <int dims, int fours>
  APF_INLINE bool sample(const GridView &grid, const PointBlock &points, double *const *to,
                         double *const *rate)
  {
    const int lanes = (points.n + 7) / 8 * 8;
    Cells<dims> cells;
    const bool inside = cells.find(grid, points, lanes);
    if (grid.frame[1])
      interpolate<dims, fours, true>(grid, cells, lanes, to, rate);
    else
      interpolate<dims, fours, false>(grid, cells, lanes, to, rate);
    return inside;
  }

  void clear(Lanes &lanes)
  {
    std::memset(lanes, 0, sizeof(lanes));
  }

  bool sample_space(const GridView &grid, const PointBlock &points, Detail detail, FluidBlock &out)
  {
    alignas(64) Lanes unused;
    auto &u = out.velocity, &om = out.vorticity;
    auto &g = out.gradient;
    double *const to[16] = {u[0],    u[1],    u[2],    out.distance, om[0],   om[1],
                            om[2],   unused,  g[0][1], g[0][2],      g[1][0], g[1][1],
                            g[1][2], g[2][0], g[2][1], g[2][2]};
    if (detail == Detail::VELOCITY) return sample<3, 1>(grid, points, to, nullptr);
    if (detail == Detail::VORTICITY) return sample<3, 2>(grid, points, to, nullptr);
    double *const rate[4] = {out.rate[0], out.rate[1], out.rate[2], unused};
    double *all[16];
    std::memcpy(all, to, sizeof(all));
    all[7] = g[0][0];
    if (!grid.frame[1])
      for (auto &component : out.rate) clear(component);
    return sample<3, 4>(grid, points, all, rate);
  }

  bool sample_plane(const GridView &grid, const PointBlock &points, Detail detail, FluidBlock &out)
  {
    alignas(64) Lanes unused;
    auto &g = out.gradient;
    double *const to[8] = {out.velocity[0], out.velocity[1], out.vorticity[2], out.distance,
                           g[0][0],         g[0][1],         g[1][0],          g[1][1]};
    clear(out.velocity[2]);
    if (detail == Detail::VELOCITY) return sample<2, 1>(grid, points, to, nullptr);
    clear(out.vorticity[0]);
    clear(out.vorticity[1]);
    if (detail == Detail::VORTICITY) return sample<2, 1>(grid, points, to, nullptr);
    for (int a = 0; a < 3; a++) {
      clear(g[2][a]);
      if (a < 2) clear(g[a][2]);
      if (a == 2 || !grid.frame[1]) clear(out.rate[a]);
    }
    double *const rate[4] = {out.rate[0], out.rate[1], unused, unused};
    return sample<2, 2>(grid, points, to, rate);
  }

}    // namespace

bool sample_grid(const GridView &grid, const PointBlock &points, Detail detail, FluidBlock &out)
{
  return grid.planar ? sample_plane(grid, points, detail, out)
                     : sample_space(grid, points, detail, out);
}

}    // namespace apf::APF_ISA
