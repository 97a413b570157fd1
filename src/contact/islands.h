// Bodies that meet no others within a particle step, nor anything that meets others: an island takes
// its collision steps by itself. Islands side by side make a tile, small enough for the cache, and
// all collision steps of a tile are taken before the next one is looked at: memory is read once per
// particle step instead of once per collision step.

#ifndef APF_ISLANDS_H
#define APF_ISLANDS_H

#include <algorithm>
#include <numeric>
#include <vector>

namespace apf {

class Islands {
 public:
  // each body an island; what they have in common with others, whom this rank does not see, is one
  // more island
  void begin(int bodies)
  {
    root.resize(bodies + 1);
    std::iota(root.begin(), root.end(), 0);
    pairs.assign(bodies + 1, 0);
  }

  // bodies that touch, or may within the particle step
  void join(int a, int b)
  {
    a = find(a);
    b = find(b);
    if (a > b) std::swap(a, b);
    pairs[a] += 1;
    if (a == b) return;
    root[b] = a;
    pairs[a] += pairs[b];
  }

  // a body that has to do with others than bodies of this rank
  void pin(int a) { join(a, common()); }

  // Gives islands to tiles, in the order of these bodies; a tile has few more than that many pairs.
  // Tile 0 is for what is pinned.
  void form_tiles(const std::vector<int> &bodies, int pairs_of_tile)
  {
    tile.assign(root.size(), -1);
    tile[find(common())] = 0;
    tiles = 1;
    int pairs_now = pairs_of_tile;    // of the last tile; the first has no room
    for (const int body : bodies) {
      const int island = find(body);
      if (tile[island] < 0) {
        if (pairs_now >= pairs_of_tile) {
          tiles++;
          pairs_now = 0;
        }
        tile[island] = tiles - 1;
        pairs_now += std::max(1, pairs[island]);
      }
    }
  }

  int size() const { return tiles; }
  // of a body that is pinned, or whose island has one of those from which tiles were formed
  int tile_of(int body) const
  {
    while (root[body] != body) body = root[body];
    return tile[body];
  }

  double memory_usage() const    // [bytes]
  {
    return (root.capacity() + pairs.capacity() + tile.capacity()) * sizeof(int);
  }

 private:
  std::vector<int>
      root;    // of each body, a body of its island nearer to that with the least number
  std::vector<int> pairs;    // of each island, at the body with the least number
  std::vector<int> tile;     // of each island, at the same place
  int tiles = 0;

  int common() const { return static_cast<int>(root.size()) - 1; }
  int find(int a)
  {
    while (root[a] != a) a = root[a] = root[root[a]];
    return a;
  }
};

// Numbers 0, 1, ... n-1 in the order of their tiles.
class ByTile {
 public:
  template <class TileOf> void sort(int n, int tiles, TileOf tile_of)
  {
    first.assign(tiles + 1, 0);
    for (int k = 0; k < n; k++) first[tile_of(k) + 1]++;
    std::partial_sum(first.begin(), first.end(), first.begin());
    numbers.resize(n);
    auto next = first;
    for (int k = 0; k < n; k++) numbers[next[tile_of(k)]++] = k;
  }

  const int *begin(int tile) const { return numbers.data() + first[tile]; }
  const int *end(int tile) const { return numbers.data() + first[tile + 1]; }
  int size(int tile) const { return first[tile + 1] - first[tile]; }

  double memory_usage() const    // [bytes]
  {
    return (first.capacity() + numbers.capacity()) * sizeof(int);
  }

 private:
  std::vector<int> first, numbers;
};

}    // namespace apf

#endif
