// A surface of triangles whose normals point into the fluid: made whole, checked, and oriented.

#ifndef FLOWGRID_SURFACE_H
#define FLOWGRID_SURFACE_H

#include "wall.h"

namespace flowgrid {

struct Surface {
  std::vector<Point> points;
  std::vector<std::array<int, 3>> triangles;
  std::vector<int> zone;             // of each triangle
  std::vector<int> source;           // of each triangle: which one it is a copy or a part of
  std::vector<std::string> zones;    // their names
  bool is_strip = false;             // of walls in a plane, drawn out along z
  bool may_end = false;              // within the grid, as walls of a mesh do at an inlet

  void add(const Point &a, const Point &b, const Point &c, int of_zone)
  {
    const int first = static_cast<int>(points.size());
    points.insert(points.end(), {a, b, c});
    triangles.push_back({first, first + 1, first + 2});
    zone.push_back(of_zone);
    source.push_back(static_cast<int>(source.size()));
  }
  // adds copies, moved by all but the first of these
  void add_copies(const std::vector<Point> &shifts)
  {
    const size_t count = triangles.size();
    for (size_t k = 1; k < shifts.size(); k++)
      for (size_t t = 0; t < count; t++) {
        const auto corners = triangles[t];
        add(points[corners[0]] + shifts[k], points[corners[1]] + shifts[k],
            points[corners[2]] + shifts[k], zone[t]);
        source.back() = source[t];
      }
  }
  Point normal(int t) const    // twice the area long
  {
    const auto &[a, b, c] = triangles[t];
    return cross(points[b] - points[a], points[c] - points[a]);
  }
  void remove(const std::vector<bool> &which);
};

// The triangle behind each edge: edge k runs from corner k to corner k + 1 (mod 3); -1: none.
std::vector<std::array<int, 3>> neighbors_of(const std::vector<std::array<int, 3>> &triangles,
                                             const std::vector<Point> &points);

// What was found and put right
struct Repairs {
  int merged = 0, duplicate = 0, degenerate = 0, turned = 0;
};

// Merges points, removes triangles that are there twice or have no area, turns those round that are
// not oriented as most of their neighbors. Throws std::runtime_error for edges with more than two
// triangles, surfaces with one side, and ones that end within the grid unless they may.
Repairs make_whole(Surface &surface, const Grid &grid);

}    // namespace flowgrid

#endif
