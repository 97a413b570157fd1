// The surface where a gridded field is zero, in triangles, or in the plane in lines: for pictures
// and areas. Cells are cut into tetrahedra (triangles in the plane), in each of which the field is
// taken for linear, so that the surface has no gaps.
// A. Doi, A. Koide, IEICE Trans. E74, 214 (1991)

#ifndef APF_ISOSURFACE_H
#define APF_ISOSURFACE_H

#include "../flow/lattice.h"

#include <array>
#include <vector>

namespace apf {

class Isosurface {
 public:
  using Point = std::array<double, 3>;

  // values: at the nodes of the lattice
  Isosurface(const Lattice &lattice, const std::vector<double> &values) : grid(lattice), f(values)
  {
  }

  // calls piece(corners) for each triangle, with [3] corners; in the plane [2] ends of a line
  template <class Piece> void for_each(Piece piece) const
  {
    const int layers = grid.dims == 3 ? grid.cells(2) : 1;
    for (int k = 0; k < layers; k++)
      for (int j = 0; j < grid.cells(1); j++)
        for (int i = 0; i < grid.cells(0); i++) {
          const int cell[3] = {i, j, k};
          if (grid.dims == 3)
            cut_cell<3>(cell, piece);
          else
            cut_cell<2>(cell, piece);
        }
  }

 private:
  const Lattice &grid;
  const std::vector<double> &f;

  template <int dims, class Piece> void cut_cell(const int *cell, Piece &piece) const
  {
    constexpr int corners = 1 << dims;
    double value[corners];
    Point at[corners];
    bool any = false, all = true;
    for (int c = 0; c < corners; c++) {
      int index[3] = {}, node[3] = {};
      for (int axis = 0; axis < dims; axis++) {
        index[axis] = cell[axis] + (c >> axis & 1);
        node[axis] = grid.wrap(axis, index[axis]);
      }
      grid.position(index[0], index[1], index[2], at[c].data());
      value[c] = f[grid.node(node[0], node[1], node[2])];
      any = any || value[c] < 0.0;
      all = all && value[c] < 0.0;
    }
    if (!any || all) return;
    // the paths along edges from corner 0 to the opposite one: one simplex for each order of axes
    static constexpr int order3[6][3] = {{0, 1, 2}, {0, 2, 1}, {1, 0, 2},
                                         {1, 2, 0}, {2, 0, 1}, {2, 1, 0}};
    static constexpr int order2[2][2] = {{0, 1}, {1, 0}};
    for (int n = 0; n < (dims == 3 ? 6 : 2); n++) {
      std::array<int, dims + 1> simplex;
      simplex[0] = 0;
      for (int axis = 0; axis < dims; axis++)
        simplex[axis + 1] = simplex[axis] | 1 << (dims == 3 ? order3[n][axis] : order2[n][axis]);
      cut<dims>(simplex, value, at, piece);
    }
  }

  static Point between(double a, double b, const Point &x, const Point &y)
  {
    const double t = a / (a - b);
    return {x[0] + t * (y[0] - x[0]), x[1] + t * (y[1] - x[1]), x[2] + t * (y[2] - x[2])};
  }

  template <int dims, class Piece>
  static void cut(const std::array<int, dims + 1> &simplex, const double *value, const Point *at,
                  Piece &piece)
  {
    int in[dims + 1], out[dims + 1], inside = 0, outside = 0;
    for (const int c : simplex) {
      if (value[c] < 0.0)
        in[inside++] = c;
      else
        out[outside++] = c;
    }
    if (inside == 0 || outside == 0) return;
    Point cuts[4];
    int n = 0;
    for (int a = 0; a < inside; a++)
      for (int b = 0; b < outside; b++)
        cuts[n++] = between(value[in[a]], value[out[b]], at[in[a]], at[out[b]]);
    piece(cuts);
    // two corners on each side: a quadrilateral, whose second half is left
    if (n == 4) piece(cuts + 1);
  }
};

}    // namespace apf

#endif
