// Sets that grow together.

#ifndef FLOWGRID_UNION_FIND_H
#define FLOWGRID_UNION_FIND_H

#include <numeric>
#include <vector>

namespace flowgrid {

class UnionFind {
 public:
  explicit UnionFind(int count) : parent(count) { std::iota(parent.begin(), parent.end(), 0); }

  int root(int a)
  {
    while (parent[a] != a) a = parent[a] = parent[parent[a]];
    return a;
  }
  void unite(int a, int b) { parent[root(a)] = root(b); }

 private:
  std::vector<int> parent;
};

}    // namespace flowgrid

#endif
