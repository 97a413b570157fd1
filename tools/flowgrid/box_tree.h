// Boxes in a binary tree, to find which are near a point.

#ifndef FLOWGRID_BOX_TREE_H
#define FLOWGRID_BOX_TREE_H

#include "wall.h"

#include <numeric>

namespace flowgrid {

class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(const std::vector<Box> &boxes) : order(boxes.size())
  {
    std::iota(order.begin(), order.end(), 0);
    if (!boxes.empty()) build(boxes, 0, static_cast<int>(boxes.size()));
  }

  // Calls visit(item) for boxes nearer than the limit, near ones first; visit returns the limit
  // from then on.
  template <class Visit> void near(const Point &x, double limit, const Visit &visit) const
  {
    if (!nodes.empty() && nodes[0].box.distance(x) <= limit) descend(0, x, limit, visit);
  }

 private:
  static constexpr int most = 4;    // items of a leaf
  struct Node {
    Box box;
    int first, last;    // items; of a leaf
    int right = 0;      // child; the left one follows. 0: a leaf
  };
  std::vector<int> order;
  std::vector<Node> nodes;

  int build(const std::vector<Box> &boxes, int first, int last)
  {
    const int index = static_cast<int>(nodes.size());
    nodes.push_back({{}, first, last, 0});
    Box box, centers;
    for (int k = first; k < last; k++) {
      const Box &one = boxes[order[k]];
      box.add(one.low);
      box.add(one.high);
      centers.add(0.5 * (one.low + one.high));
    }
    nodes[index].box = box;
    if (last - first <= most) return index;
    int axis = 0;
    const Point size = centers.high - centers.low;
    for (int c = 1; c < 3; c++)
      if (size[c] > size[axis]) axis = c;
    const int middle = (first + last) / 2;
    std::nth_element(order.begin() + first, order.begin() + middle, order.begin() + last,
                     [&](int a, int b) {
                       return boxes[a].low[axis] + boxes[a].high[axis] <
                           boxes[b].low[axis] + boxes[b].high[axis];
                     });
    build(boxes, first, middle);
    const int right = build(boxes, middle, last);
    nodes[index].right = right;
    return index;
  }

  template <class Visit>
  void descend(int index, const Point &x, double &limit, const Visit &visit) const
  {
    const Node &node = nodes[index];
    if (!node.right) {
      for (int k = node.first; k < node.last; k++) limit = visit(order[k]);
      return;
    }
    int near = index + 1, far = node.right;
    double to_near = nodes[near].box.distance(x), to_far = nodes[far].box.distance(x);
    if (to_far < to_near) {
      std::swap(near, far);
      std::swap(to_near, to_far);
    }
    if (to_near <= limit) descend(near, x, limit, visit);
    if (to_far <= limit) descend(far, x, limit, visit);
  }
};

}    // namespace flowgrid

#endif
