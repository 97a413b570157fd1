// The walls of a mesh as a surface: faces of its border.

#ifndef FLOWGRID_MESH_WALLS_H
#define FLOWGRID_MESH_WALLS_H

#include "surface.h"

namespace flowgrid {

// zone_of: of the corners of a face of the border, as numbers of points, -1 if it is no wall.
// half_width: of the strips along z that walls of a plane mesh become                [length]
template <class ZoneOf>
Surface mesh_walls(const Mesh &mesh, const std::vector<std::string> &zones, ZoneOf zone_of,
                   double half_width)
{
  Surface surface;
  surface.zones = zones;
  surface.may_end = true;
  surface.is_strip = mesh.dim() == 2;
  for (int cell = 0; cell < mesh.size(); cell++) {
    const auto &shape = info(mesh.shapes[cell]);
    Point center{};
    for (int k = 0; k < shape.corners; k++)
      center = center + (1.0 / shape.corners) * mesh.points[mesh.corners[cell][k]];
    for (int f = 0; f < shape.faces; f++) {
      if (mesh.across[cell][f] >= 0) continue;
      std::vector<int> corners;
      corners.reserve(shape.face_corners);
      for (int k = 0; k < shape.face_corners; k++)
        corners.push_back(mesh.corners[cell][shape.face[f][k]]);
      const int zone = zone_of(corners);
      if (zone < 0) continue;
      std::vector<Point> x;
      x.reserve(corners.size());
      for (const int p : corners) x.push_back(mesh.points[p]);
      if (shape.dim == 2) {
        const Point wide{0.0, 0.0, half_width};
        x = {x[0] - wide, x[1] - wide, x[1] + wide, x[0] + wide};
      }
      if (dot(cross(x[1] - x[0], x[2] - x[0]), center - x[0]) < 0.0)
        std::reverse(x.begin(), x.end());
      for (size_t k = 2; k < x.size(); k++) surface.add(x[0], x[k - 1], x[k], zone);
    }
  }
  return surface;
}

}    // namespace flowgrid

#endif
