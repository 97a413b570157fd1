#include "grid_flow.h"

namespace apf {

namespace {

  // slopes[a][b] = du_a/dx_b at a node
  void slopes_at(const Lattice &grid, const int *index, const double *u, double (&slopes)[3][3])
  {
    for (int b = 0; b < grid.dims; b++)
      for (int a = 0; a < 3; a++)
        slopes[a][b] = node_slope(grid, b, index[b], u + a, 3 * grid.stride(b));
  }

}    // namespace

void write_records(const Lattice &grid, Detail detail, const std::vector<double> &velocity,
                   const std::vector<double> &distance, double *records)
{
  const bool planar = grid.dims == 2;
  const int fours = record_fours(planar, detail);
  const int layers = planar ? 1 : grid.cells(2) + 1;
  for (int k = 0; k < layers; k++)
    for (int j = 0; j <= grid.cells(1); j++)
      for (int i = 0; i <= grid.cells(0); i++) {
        const int index[3] = {i % grid.n[0], j % grid.n[1], k % grid.n[2]};
        const std::size_t node = grid.node(index[0], index[1], index[2]);
        const double *u = &velocity[3 * node];
        double d[3][3] = {};
        if (planar || detail != Detail::VELOCITY) slopes_at(grid, index, u, d);
        const double s = distance.empty() ? 0.0 : distance[node];
        const double space[16] = {u[0],
                                  u[1],
                                  u[2],
                                  s,
                                  d[2][1] - d[1][2],
                                  d[0][2] - d[2][0],
                                  d[1][0] - d[0][1],
                                  d[0][0],
                                  d[0][1],
                                  d[0][2],
                                  d[1][0],
                                  d[1][1],
                                  d[1][2],
                                  d[2][0],
                                  d[2][1],
                                  d[2][2]};
        const double plane[8] = {u[0],    u[1],    d[1][0] - d[0][1], s,
                                 d[0][0], d[0][1], d[1][0],           d[1][1]};
        records = std::copy_n(planar ? plane : space, 4 * fours, records);
      }
}

}    // namespace apf
