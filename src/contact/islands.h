// Bodies that meet no others within a particle step, nor anything that does: an island takes its
// collision steps by itself. Islands side by side make a tile, small enough for the cache, and all
// collision steps of a tile are taken before the next one is looked at: memory is read once per
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
  void join(int a, int b) { pairs[unite(a, b)]++; }

  // a body that has to do with others than bodies of this rank
  void pin(int a) { unite(a, common()); }

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
  int pinned() { return pairs[find(common())]; }    // pairs in tile 0
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
  std::vector<int> root;    // of each body: one of its island, nearer to that with the least number
  std::vector<int> pairs;    // of each island, at its body with the least number
  std::vector<int> tile;     // of each island, there as well
  int tiles = 0;

  int common() const { return static_cast<int>(root.size()) - 1; }
  int find(int a)
  {
    while (root[a] != a) a = root[a] = root[root[a]];
    return a;
  }
  int unite(int a, int b)
  {
    a = find(a);
    b = find(b);
    if (a == b) return a;
    if (a > b) std::swap(a, b);
    root[b] = a;
    pairs[a] += pairs[b];
    return a;
  }
};

// Numbers 0, 1, ... n-1 in the order of their tiles.
class ByTile {
 public:
  template <class TileOf> void sort(int n, int tiles, TileOf tile_of)
  {
    starts.assign(tiles + 1, 0);
    for (int k = 0; k < n; k++) starts[tile_of(k) + 1]++;
    std::partial_sum(starts.begin(), starts.end(), starts.begin());
    numbers.resize(n);
    auto next = starts;
    for (int k = 0; k < n; k++) numbers[next[tile_of(k)]++] = k;
  }

  int size() const { return static_cast<int>(starts.size()) - 1; }    // tiles
  int first(int tile) const { return starts[tile]; }                  // place of its first number
  int size(int tile) const { return starts[tile + 1] - starts[tile]; }
  const int *begin(int tile) const { return numbers.data() + starts[tile]; }
  const int *end(int tile) const { return numbers.data() + starts[tile + 1]; }

  double memory_usage() const    // [bytes]
  {
    return (starts.capacity() + numbers.capacity()) * sizeof(int);
  }

 private:
  std::vector<int> starts, numbers;
};

}    // namespace apf

#endif
