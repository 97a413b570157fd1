// A polygon as a formula of the half planes of its edges, each of which is used once.
//
// Between two neighbors on the convex hull the border is an edge or a pocket. The polygon is what
// lies within all of these; a pocket is what lies within any of the parts between its own hull's
// corners; and so on inward.
// D. Dobkin, L. Guibas, J. Hershberger, J. Snoeyink, Algorithmica 10, 1 (1993),
// doi:10.1007/BF01908629

#ifndef FLOWGRID_POLYGON_H
#define FLOWGRID_POLYGON_H

#include "shape_tree.h"

#include <stdexcept>

namespace flowgrid {

class Polygon {
 public:
  // Corners in either sense of rotation. Throws std::runtime_error for one that crosses itself.
  explicit Polygon(std::vector<Point> of) : corners(std::move(of))
  {
    remove_straight_corners();
    if (corners.size() < 3) throw std::runtime_error("a polygon needs three corners or more");
    check();
    double area = 0.0;
    for (size_t k = 0; k < corners.size(); k++) {
      const Point &a = corners[k], &b = corners[(k + 1) % corners.size()];
      area += a[0] * b[1] - a[1] * b[0];
    }
    if (area < 0.0) std::reverse(corners.begin(), corners.end());
    // the lowest corner is one of the hull; the border is a chain from it to itself
    std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()), corners.end());
    corners.push_back(corners.front());
  }

  int add_to(ShapeTree &tree) const
  {
    return chain(tree, 0, static_cast<int>(corners.size()) - 1, true);
  }

 private:
  std::vector<Point> corners;

  static double turn(const Point &a, const Point &b, const Point &c)
  {
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
  }

  void remove_straight_corners()
  {
    for (size_t k = 0; k < corners.size() && corners.size() > 2;) {
      const size_t n = corners.size();
      const Point &a = corners[(k + n - 1) % n], &b = corners[k], &c = corners[(k + 1) % n];
      if (std::fabs(turn(a, b, c)) <= 1e-12 * length(b - a) * length(c - b)) {
        corners.erase(corners.begin() + k);
        k = 0;
      } else
        k++;
    }
  }

  void check() const
  {
    const size_t n = corners.size();
    for (size_t i = 0; i < n; i++)
      for (size_t j = i + 2; j < n; j++) {
        if (i == 0 && j == n - 1) continue;
        const Point &a = corners[i], &b = corners[i + 1], &c = corners[j],
                    &d = corners[(j + 1) % n];
        bool apart = false;
        for (int axis = 0; axis < 2; axis++)
          apart |= std::max(a[axis], b[axis]) < std::min(c[axis], d[axis]) ||
              std::max(c[axis], d[axis]) < std::min(a[axis], b[axis]);
        if (!apart && turn(a, b, c) * turn(a, b, d) <= 0.0 && turn(c, d, a) * turn(c, d, b) <= 0.0)
          throw std::runtime_error("the polygon crosses or touches itself");
      }
  }

  // corners of the hull of a part of the border, in the order along it
  std::vector<int> hull(int first, int last) const
  {
    std::vector<int> order, result;
    for (int k = first; k < last + (corners[first] != corners[last]); k++) order.push_back(k);
    std::sort(order.begin(), order.end(), [&](int a, int b) {
      return corners[a] < corners[b];
    });
    for (const bool upper : {false, true}) {
      std::vector<int> half;
      for (const int k : order) {
        while (half.size() > 1 &&
               turn(corners[half[half.size() - 2]], corners[half.back()], corners[k]) <= 0.0)
          half.pop_back();
        half.push_back(k);
      }
      half.pop_back();
      for (const int k : half) result.push_back(k);
      if (!upper) std::reverse(order.begin(), order.end());
    }
    std::sort(result.begin(), result.end());
    if (result.back() != last) result.push_back(last);
    return result;
  }

  int chain(ShapeTree &tree, int first, int last, bool convex) const
  {
    if (last == first + 1) {
      const Point along = corners[last] - corners[first];
      return tree.half_space(
          {Carrier::Kind::plane, corners[first], unit({along[1], -along[0], 0.0}), 0.0});
    }
    const auto ends = hull(first, last);
    std::vector<int> parts;
    for (size_t k = 1; k < ends.size(); k++)
      parts.push_back(chain(tree, ends[k - 1], ends[k], !convex));
    return convex ? tree.both(parts) : tree.either(parts);
  }
};

}    // namespace flowgrid

#endif
