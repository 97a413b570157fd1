// Finds the cell of a point by the walk of IIHR Report 459: from the cell where the last point was,
// to the neighbour across the face beyond which the point lies farthest. Where the walk meets a
// border (a concave boundary, a hole, another block), bins of cells answer instead.

#ifndef FLOWGRID_FINDER_H
#define FLOWGRID_FINDER_H

#include "inverse_map.h"

#include <cstdint>

namespace flowgrid {

class Finder {
 public:
  explicit Finder(const Mesh &of) : mesh(of) { sort_into_bins(); }

  // cell of a point, -1 if it lies in none; start: where to begin, or -1
  int find(const double *x, int start, Local &local)
  {
    int cell = start < 0 ? -1 : walk(x, start, local);
    if (cell < 0) cell = search(x, local);
    return cell;
  }

  std::int64_t walked = 0;      // cells looked at on walks
  std::int64_t searched = 0;    // points for which bins were asked

 private:
  const Mesh &mesh;
  Point low{}, bin_size{};
  int bins[3] = {1, 1, 1};
  std::vector<int> first,
      content;    // cells of bin b: content[first[b]] .. content[first[b + 1] - 1]

  int walk(const double *x, int cell, Local &local)
  {
    const int longest = 200 + mesh.size() / 4;
    int before = -1;
    for (int step = 0; step < longest; step++) {
      walked++;
      local = locate(mesh, cell, x);
      const int faces = info(mesh.shapes[cell]).faces;
      if (local.inside(faces)) return cell;
      int next = -1;
      double farthest = inside_tolerance;
      for (int f = 0; f < faces; f++) {
        const int neighbour = mesh.across[cell][f];
        if (neighbour < 0 || neighbour == before || !(local.beyond[f] > farthest)) continue;
        farthest = local.beyond[f];
        next = neighbour;
      }
      if (next < 0) return -1;
      before = cell;
      cell = next;
    }
    return -1;
  }

  int search(const double *x, Local &local)
  {
    searched++;
    std::int64_t bin = 0;
    for (int c = mesh.dim() - 1; c >= 0; c--) {
      const double at = (x[c] - low[c]) / bin_size[c];
      if (!(at >= -1e-6 && at <= bins[c] + 1e-6)) return -1;
      bin = bin * bins[c] + std::min(std::max(static_cast<int>(at), 0), bins[c] - 1);
    }
    for (int k = first[bin]; k < first[bin + 1]; k++) {
      local = locate(mesh, content[k], x);
      if (local.inside(info(mesh.shapes[content[k]]).faces)) return content[k];
    }
    return -1;
  }

  // range of bins that a cell's box, a little enlarged, meets
  void range(int cell, int *from, int *to) const
  {
    for (int c = 0; c < 3; c++) from[c] = to[c] = 0;
    for (int c = 0; c < mesh.dim(); c++) {
      double a = 1e300, b = -1e300;
      for (int k = 0; k < info(mesh.shapes[cell]).corners; k++) {
        a = std::min(a, mesh.points[mesh.corners[cell][k]][c]);
        b = std::max(b, mesh.points[mesh.corners[cell][k]][c]);
      }
      const double more = 0.01 * (b - a);
      auto bin = [&](double at) {
        return std::min(std::max(static_cast<int>((at - low[c]) / bin_size[c]), 0), bins[c] - 1);
      };
      from[c] = bin(a - more);
      to[c] = bin(b + more);
    }
  }

  void sort_into_bins()
  {
    Point high{};
    for (int c = 0; c < 3; c++) {
      low[c] = 1e300;
      high[c] = -1e300;
    }
    for (const auto &p : mesh.points)
      for (int c = 0; c < 3; c++) {
        low[c] = std::min(low[c], p[c]);
        high[c] = std::max(high[c], p[c]);
      }
    const int dim = mesh.dim();
    double largest = 1e-200, share = 1.0;    // of the volume in the cube of the largest extent
    for (int c = 0; c < dim; c++) largest = std::max(largest, high[c] - low[c]);
    Point extent{};    // however flat the mesh is
    for (int c = 0; c < dim; c++) {
      extent[c] = std::max(high[c] - low[c], 1e-12 * largest);
      share *= extent[c] / largest;
    }
    const double edge =
        largest * std::pow(share / std::max(mesh.size(), 1), 1.0 / std::max(dim, 1));
    std::int64_t all = 1;
    for (int c = 0; c < dim; c++) {
      bins[c] = static_cast<int>(std::min(std::max(extent[c] / edge, 1.0), 1000.0));
      bin_size[c] = extent[c] / bins[c];
      all *= bins[c];
    }
    first.assign(all + 1, 0);
    for (const bool count : {true, false}) {
      for (int cell = 0; cell < mesh.size(); cell++) {
        int from[3], to[3];
        range(cell, from, to);
        for (int z = from[2]; z <= to[2]; z++)
          for (int y = from[1]; y <= to[1]; y++)
            for (int i = from[0]; i <= to[0]; i++) {
              const std::int64_t bin = (static_cast<std::int64_t>(z) * bins[1] + y) * bins[0] + i;
              if (count)
                first[bin]++;
              else
                content[--first[bin]] = cell;
            }
      }
      if (!count) break;
      for (std::int64_t b = 1; b <= all; b++) first[b] += first[b - 1];
      content.resize(first[all]);
    }
  }
};

}    // namespace flowgrid

#endif
