// Meshes for tests: blocks of distorted bricks, whose points are shared where blocks meet.

#ifndef FLOWGRID_TEST_MESHES_H
#define FLOWGRID_TEST_MESHES_H

#include "mesh.h"

#include <cmath>
#include <functional>
#include <map>

namespace flowgrid {

// n[0] x n[1] x n[2] bricks of which x(s) gives the corners, s in the unit cube; in the plane
// n[2] = 0. Points that lie where others do already are these.
inline void add_block(Mesh &mesh, std::array<int, 3> n, const std::function<Point(Point)> &x)
{
  static constexpr double same = 1e-9;
  std::map<std::array<long long, 3>, int> known;
  auto key = [](const Point &p) {
    return std::array<long long, 3>{std::llround(p[0] / same), std::llround(p[1] / same),
                                    std::llround(p[2] / same)};
  };
  for (size_t p = 0; p < mesh.points.size(); p++) known[key(mesh.points[p])] = static_cast<int>(p);
  const bool flat = n[2] == 0;
  auto point = [&](int i, int j, int k) {
    const Point at = x({double(i) / n[0], double(j) / n[1], flat ? 0.0 : double(k) / n[2]});
    const auto [place, is_new] = known.try_emplace(key(at), static_cast<int>(mesh.points.size()));
    if (is_new) mesh.points.push_back(at);
    return place->second;
  };
  for (int k = 0; k < std::max(n[2], 1); k++)
    for (int j = 0; j < n[1]; j++)
      for (int i = 0; i < n[0]; i++) {
        std::array<int, 8> c{point(i, j, k), point(i + 1, j, k), point(i + 1, j + 1, k),
                             point(i, j + 1, k)};
        if (flat) {
          mesh.add(Shape::QUAD, c);
          continue;
        }
        for (int l = 0; l < 4; l++) c[4 + l] = point(i + (l == 1 || l == 2), j + (l > 1), k + 1);
        mesh.add(Shape::HEXAHEDRON, c);
      }
}

// bends the unit cube a little, and leaves its faces x = 0 and x = 1 plane
inline Point bend(const Point &s)
{
  const double pi = 3.14159265358979323846, a = 0.06;
  const double b = a * std::sin(pi * s[0]);
  return {s[0] + 0.3 * a * std::sin(2 * pi * s[1]) * std::sin(pi * s[0]),
          s[1] + b * std::sin(pi * s[1]) * std::cos(pi * s[2]),
          s[2] + b * std::sin(pi * s[2]) * std::cos(pi * s[1])};
}

// two blocks side by side, each one long, with unlike bricks but shared points where they meet
inline Mesh two_blocks(int n, bool flat)
{
  Mesh mesh;
  add_block(mesh, {n, n, flat ? 0 : n}, bend);
  add_block(mesh, {2 * n, n, flat ? 0 : n}, [](const Point &s) {
    Point p = bend({s[0] * s[0] * 0.5 + s[0] * 0.5, s[1], s[2]});
    p[0] += 1.0;
    return p;
  });
  mesh.link();
  return mesh;
}

// a ring of quadrilaterals around a hole of radius 1, to radius 3: straight walks meet the hole
inline Mesh ring(int n)
{
  Mesh mesh;
  add_block(mesh, {n, n / 2, 0}, [](const Point &s) {
    const double angle = 2.0 * 3.14159265358979323846 * s[0], r = 1.0 + 2.0 * s[1];
    return Point{r * std::cos(angle), r * std::sin(angle), 0.0};
  });
  mesh.link();
  return mesh;
}

}    // namespace flowgrid

#endif
