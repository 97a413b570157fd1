// Solids made of half spaces: the inner sides of carriers, combined by union, intersection and
// inversion. Carriers that coincide are one, so that faces which lie in each other are known to.

#ifndef FLOWGRID_SHAPE_TREE_H
#define FLOWGRID_SHAPE_TREE_H

#include "carrier.h"

#include <string>

namespace flowgrid {

class ShapeTree {
 public:
  static constexpr signed char solid = -1, neither = 0, fluid = 1;

  struct Solid {
    std::string name;
    int root;
  };
  std::vector<Solid> solids;    // their union is the wall
  std::vector<Carrier> carriers;

  // Half spaces from now on are moved by this.
  void put(const Point &shift) { moved = shift; }

  // Each returns a node. The solid side of a carrier is its negative one.
  int half_space(Carrier carrier)
  {
    carrier.origin = carrier.origin + moved;
    int index = 0, sign = 0;
    for (; index < static_cast<int>(carriers.size()); index++)
      if ((sign = carriers[index].same_as(carrier, coincident * (1.0 + length(carrier.origin)))))
        break;
    if (!sign) {
      carriers.push_back(carrier);
      sign = 1;
    }
    return add({Operation::half_space, {}, index, static_cast<signed char>(sign)});
  }
  int both(std::vector<int> of) { return add({Operation::both, std::move(of), -1, 1}); }
  int either(std::vector<int> of) { return add({Operation::either, std::move(of), -1, 1}); }
  int inverse(int of) { return add({Operation::inverse, {of}, -1, 1}); }

  int size() const { return static_cast<int>(nodes.size()); }
  // the carrier of a node that is a half space, -1 for others
  int carrier_of(int node) const { return nodes[node].carrier; }

  // What is at a place. side_of(node): the side of the carrier of a half space on which it lies,
  // < 0 or > 0, or 0 if the half space is to be left out as if it were not there. used: nodes that
  // are looked at, all if it is empty; of half spaces inside a node that is used all are.
  template <class SideOf>
  signed char at(int node, const SideOf &side_of, const std::vector<bool> &used = {}) const
  {
    const Node &n = nodes[node];
    if (n.operation == Operation::half_space) return side_of(node) * n.sign;
    if (!used.empty() && !used[node]) return neither;
    if (n.operation == Operation::inverse) return -at(n.of[0], side_of, used);
    const signed char wins = n.operation == Operation::both ? fluid : solid;
    signed char result = neither;
    for (const int child : n.of) {
      const signed char one = at(child, side_of, used);
      if (one == wins) return wins;
      if (one) result = one;
    }
    return result;
  }
  template <class SideOf>
  signed char at(const SideOf &side_of, const std::vector<bool> &used = {}) const
  {
    signed char result = neither;
    for (const auto &one : solids) {
      if (!used.empty() && !used[one.root]) continue;
      const signed char here = at(one.root, side_of, used);
      if (here == solid) return solid;
      if (here) result = here;
    }
    return result;
  }

  // Marks the nodes with a half space below them that is marked.
  void mark_upward(std::vector<bool> &marks) const
  {
    // children come before their parents
    for (size_t node = 0; node < nodes.size(); node++)
      for (const int child : nodes[node].of)
        if (marks[child]) marks[node] = true;
  }

 private:
  static constexpr double coincident = 1e-10;
  enum class Operation { half_space, both, either, inverse };
  struct Node {
    Operation operation;
    std::vector<int> of;
    int carrier;
    signed char sign;
  };
  std::vector<Node> nodes;
  Point moved{};

  int add(Node node)
  {
    nodes.push_back(std::move(node));
    return static_cast<int>(nodes.size()) - 1;
  }
};

}    // namespace flowgrid

#endif
