// A mesh of the fluid: points, cells of four shapes, and which cell lies across each face.

#ifndef FLOWGRID_MESH_H
#define FLOWGRID_MESH_H

#include <algorithm>
#include <array>
#include <vector>

namespace flowgrid {

using Point = std::array<double, 3>;

// Corners in VTK's order. In the plane z is not looked at.
enum class Shape : char { TRIANGLE, QUAD, TETRA, HEXAHEDRON };

struct ShapeInfo {
  int dim, corners, faces;
  int face_corners;    // of each face
  int face[6][4];      // their numbers; face 2 a + s lies where coordinate a is -1 (s = 0) or 1,
};                     // face a of triangle and tetrahedron opposite to corner a

inline const ShapeInfo &info(Shape shape)
{
  static const ShapeInfo table[] = {
      {2, 3, 3, 2, {{1, 2}, {0, 2}, {0, 1}}},
      {2, 4, 4, 2, {{0, 3}, {1, 2}, {0, 1}, {3, 2}}},
      {3, 4, 4, 3, {{1, 2, 3}, {0, 2, 3}, {0, 1, 3}, {0, 1, 2}}},
      {3,
       8,
       6,
       4,
       {{0, 3, 7, 4}, {1, 2, 6, 5}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 1, 2, 3}, {4, 5, 6, 7}}}};
  return table[static_cast<int>(shape)];
}

class Mesh {
 public:
  std::vector<Point> points;
  std::vector<Shape> shapes;                  // of the cells
  std::vector<std::array<int, 8>> corners;    // their points
  std::vector<std::array<int, 6>> across;     // cells behind their faces, -1 at a border; link()

  int size() const { return static_cast<int>(shapes.size()); }
  int dim() const { return shapes.empty() ? 0 : info(shapes[0]).dim; }

  void add(Shape shape, const std::array<int, 8> &of)
  {
    shapes.push_back(shape);
    corners.push_back(of);
  }

  // Finds the cells across faces: those with the same corners.
  void link()
  {
    struct Side {
      std::array<int, 4> corners;
      int cell, face;
      bool operator<(const Side &other) const { return corners < other.corners; }
    };
    std::vector<Side> sides;
    for (int c = 0; c < size(); c++)
      for (int f = 0; f < info(shapes[c]).faces; f++) sides.push_back({face(c, f), c, f});
    std::sort(sides.begin(), sides.end());
    across.assign(size(), {-1, -1, -1, -1, -1, -1});
    for (size_t k = 1; k < sides.size(); k++) {
      const Side &a = sides[k - 1], &b = sides[k];
      if (a.corners != b.corners) continue;
      across[a.cell][a.face] = b.cell;
      across[b.cell][b.face] = a.cell;
    }
  }

  // points of a face, ascending; -1 where it has fewer than four
  std::array<int, 4> face(int cell, int f) const
  {
    const auto &shape = info(shapes[cell]);
    std::array<int, 4> of = {-1, -1, -1, -1};
    for (int k = 0; k < shape.face_corners; k++) of[k] = corners[cell][shape.face[f][k]];
    std::sort(of.begin(), of.end());
    return of;
  }

  // points on faces without a cell behind
  std::vector<bool> on_border() const
  {
    std::vector<bool> border(points.size(), false);
    for (int c = 0; c < size(); c++)
      for (int f = 0; f < info(shapes[c]).faces; f++)
        if (across[c][f] < 0)
          for (int p : face(c, f))
            if (p >= 0) border[p] = true;
    return border;
  }
};

}    // namespace flowgrid

#endif
