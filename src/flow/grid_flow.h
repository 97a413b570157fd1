// The fluid given by numbers at the nodes of a grid, trilinear between them, in time linear between
// two frames of them. A node's numbers stand side by side in a record:
//   3-D   u v w s   om_x om_y om_z u_x   u_y u_z v_x v_y   v_z w_x w_y w_z      u_x = du/dx
//   2-D   u v om s  u_x u_y v_x v_y
// cut off behind the fours that the detail asked for needs; s is the signed distance to the walls,
// 0 if unknown. A periodic direction repeats its first layer at the end, so that the corners of a
// cell are always neighbours in memory. Slopes and curl are those of the nodes (lattice.h).

#ifndef APF_GRID_FLOW_H
#define APF_GRID_FLOW_H

#include "fluid_block.h"
#include "lattice.h"

#include <cstdint>

namespace apf {

// Where the records are; made by grid_view().
struct GridView {
  bool planar = false;
  int fours = 0;                                  // groups of four numbers in a record
  double origin[3] = {}, per_length[3] = {};      // first node, 1/spacing
  double cells[3] = {}, per_cells[3] = {};        // number of cells; 1/cells if periodic, else 0
  std::ptrdiff_t stride[3] = {};                  // numbers from a node to the next one
  const double *frame[2] = {nullptr, nullptr};    // the second one is null if the flow is steady
  double share = 0.0;                             // of the second frame at this time, in [0, 1]
  double per_time = 0.0;                          // 1/(time between the frames)
};

inline int record_fours(bool planar, Detail detail)
{
  if (planar) return detail == Detail::GRADIENT ? 2 : 1;
  return detail == Detail::VELOCITY ? 1 : detail == Detail::VORTICITY ? 2 : 4;
}

inline GridView grid_view(const Lattice &grid, Detail detail)
{
  GridView view;
  view.planar = grid.dims == 2;
  view.fours = record_fours(view.planar, detail);
  std::ptrdiff_t stride = 4 * view.fours;
  for (int axis = 0; axis < grid.dims; axis++) {
    view.origin[axis] = grid.origin[axis];
    view.per_length[axis] = 1.0 / grid.spacing[axis];
    view.cells[axis] = grid.cells(axis);
    view.per_cells[axis] = grid.periodic[axis] ? 1.0 / grid.cells(axis) : 0.0;
    view.stride[axis] = stride;
    stride *= grid.cells(axis) + 1;
  }
  return view;
}

// numbers in all records of a frame
inline std::size_t frame_size(const Lattice &grid, Detail detail)
{
  std::size_t size = 4 * record_fours(grid.dims == 2, detail);
  for (int axis = 0; axis < grid.dims; axis++) size *= grid.cells(axis) + 1;
  return size;
}

// Writes the records. velocity: three numbers per node; distance: one, or empty.
void write_records(const Lattice &grid, Detail detail, const std::vector<double> &velocity,
                   const std::vector<double> &distance, double *records);

// The fluid at a block of points; where a point lies outside the grid, at the nearest point of it.
// detail must not exceed that of the records. Returns whether all points are in the grid, to 1e-6
// of a cell. Compiled for several instruction sets.
using GridSampler = bool (*)(const GridView &, const PointBlock &, Detail, FluidBlock &);
GridSampler grid_sampler();

struct GridSamplerBuild {
  const char *name;
  GridSampler sampler;
};
const std::vector<GridSamplerBuild> &grid_sampler_builds();

class GridFlow {
 public:
  GridView view;
  bool sample(const PointBlock &points, Detail detail, FluidBlock &out) const
  {
    return sampler(view, points, detail, out);
  }

 private:
  GridSampler sampler = grid_sampler();
};

}    // namespace apf

#endif
