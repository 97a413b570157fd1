// Patches side by side, and the signed distance to them. On edges and corners the sign is that of
// the mean of the normals around, weighted by angles.
// J. A. Baerentzen, H. Aanaes, IEEE Trans. Vis. Comput. Graph. 11, 243 (2005),
// doi:10.1109/TVCG.2005.49

#ifndef FLOWGRID_PATCH_SET_H
#define FLOWGRID_PATCH_SET_H

#include "box_tree.h"
#include "patch.h"
#include "surface.h"

namespace flowgrid {

class PatchSet {
 public:
  struct Nearest {
    double distance = unknown;    // signed                                            [length]
    int patch = -1;
  };

  // triangles: corners of the patches, as numbers of points
  PatchSet(std::vector<Patch> of, std::vector<std::array<int, 3>> triangles,
           const std::vector<Point> &points) :
      patches(std::move(of)),
      corners(std::move(triangles)), at_corner(points.size(), Point{})
  {
    std::vector<Box> boxes;
    for (const auto &patch : patches) boxes.push_back(patch.box());
    tree = BoxTree(boxes);
    std::vector<Point> normal;
    for (const auto &t : corners) {
      normal.push_back(unit(cross(points[t[1]] - points[t[0]], points[t[2]] - points[t[0]])));
      for (int k = 0; k < 3; k++) {
        const Point &a = points[t[k]];
        const double weight = angle(points[t[(k + 1) % 3]] - a, points[t[(k + 2) % 3]] - a);
        at_corner[t[k]] = at_corner[t[k]] + weight * normal.back();
      }
    }
    const auto neighbors = neighbors_of(corners, points);
    for (size_t t = 0; t < corners.size(); t++) {
      at_edge.emplace_back();
      for (int k = 0; k < 3; k++)
        at_edge[t][k] = neighbors[t][k] < 0 ? normal[t] : normal[t] + normal[neighbors[t][k]];
    }
  }

  Nearest nearest(const Point &x, double limit) const
  {
    Nearest found;
    Patch::Foot best;
    tree.near(x, limit, [&](int k) {
      const double nearest = std::min(limit, best.distance);
      if (patches[k].box().distance(x) > nearest) return nearest;
      const auto foot = patches[k].nearest(x, nearest);
      if (foot.distance < best.distance) {
        best = foot;
        found.patch = k;
      }
      return std::min(limit, best.distance);
    });
    if (!(best.distance <= limit)) return {};
    const Point up = pseudonormal(found.patch, best);
    found.distance = dot(x - best.at, up) < 0.0 ? -best.distance : best.distance;
    return found;
  }

 private:
  std::vector<Patch> patches;
  std::vector<std::array<int, 3>> corners;
  std::vector<Point> at_corner;                 // of each point
  std::vector<std::array<Point, 3>> at_edge;    // of each patch
  BoxTree tree;

  Point pseudonormal(int patch, const Patch::Foot &foot) const
  {
    constexpr double tiny = 1e-9;
    const double weight[3] = {1.0 - foot.u - foot.v, foot.u, foot.v};
    for (int k = 0; k < 3; k++)
      if (weight[k] > 1.0 - tiny) return at_corner[corners[patch][k]];
    for (int k = 0; k < 3; k++)
      if (weight[(k + 2) % 3] < tiny) return at_edge[patch][k];
    return foot.normal;
  }
};

}    // namespace flowgrid

#endif
