// Nodes of a Cartesian grid in a mesh: the cell and the weights of its corners are found once, so
// that each field, and each time step, only multiplies.

#ifndef FLOWGRID_MAPPING_H
#define FLOWGRID_MAPPING_H

#include "finder.h"
#include "progress.h"

namespace flowgrid {

struct Grid {
  std::array<int, 3> n{1, 1, 1};    // nodes
  Point origin{}, spacing{1.0, 1.0, 1.0};

  size_t nodes() const { return static_cast<size_t>(n[0]) * n[1] * n[2]; }
  Point node(int i, int j, int k) const
  {
    return {origin[0] + i * spacing[0], origin[1] + j * spacing[1], origin[2] + k * spacing[2]};
  }
};

class Mapping {
 public:
  Mapping(const Mesh &mesh, const Grid &on) :
      grid(on), source(mesh), cell(on.nodes(), -1), weights(on.nodes())
  {
    Finder finder(mesh);
    size_t node = 0;
    int row_start = -1;
    for (int k = 0; k < grid.n[2]; k++)
      for (int j = 0; j < grid.n[1]; j++) {
        int start = row_start;
        bool first = true;
        for (int i = 0; i < grid.n[0]; i++, node++) {
          Local local;
          const Point x = grid.node(i, j, k);
          const int found = finder.find(x.data(), start, local);
          cell[node] = found;
          if (found < 0) continue;
          std::copy_n(local.weight, 8, weights[node].begin());
          start = found;
          if (first) row_start = found;
          first = false;
        }
        show_progress("mapping", 1.0 * node / grid.nodes());
      }
    walked = finder.walked;
    searched = finder.searched;
  }

  bool inside(size_t node) const { return cell[node] >= 0; }
  size_t count_inside() const
  {
    return std::count_if(cell.begin(), cell.end(), [](int c) {
      return c >= 0;
    });
  }

  // a field of the points of the mesh, `components` numbers each, on the nodes; 0 outside
  std::vector<double> apply(const std::vector<double> &field, int components) const
  {
    std::vector<double> out(cell.size() * components, 0.0);
    for (size_t node = 0; node < cell.size(); node++) {
      if (cell[node] < 0) continue;
      const auto &corner = source.corners[cell[node]];
      for (int k = 0; k < info(source.shapes[cell[node]]).corners; k++)
        for (int c = 0; c < components; c++)
          out[node * components + c] +=
              weights[node][k] * field[static_cast<size_t>(corner[k]) * components + c];
    }
    return out;
  }

  const Grid grid;
  std::int64_t walked, searched;    // Finder

 private:
  const Mesh &source;
  std::vector<int> cell;    // of each node, -1 outside
  std::vector<std::array<double, 8>> weights;
};

}    // namespace flowgrid

#endif
