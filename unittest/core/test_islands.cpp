// Which bodies take their collision steps together, and contacts that are taken out of a list tile
// by tile and put back, against a flood fill and a plain map.

#include "contact/contact_tiles.h"

#include "gtest/gtest.h"

#include <map>
#include <queue>
#include <random>
#include <set>

using namespace apf;

namespace {

struct Graph {
  int bodies;
  std::vector<std::pair<int, int>> pairs;
  std::set<int> pinned;

  // number of each body's component; 0 for those that hang together with a pinned one
  std::vector<int> components() const
  {
    std::vector<int> number(bodies, -1);
    auto flood = [&](int start, int n) {
      std::queue<int> todo({start});
      number[start] = n;
      while (!todo.empty()) {
        const int body = todo.front();
        todo.pop();
        for (const auto &[a, b] : pairs)
          for (const auto &[from, to] : {std::pair{a, b}, std::pair{b, a}})
            if (from == body && number[to] < 0) {
              number[to] = n;
              todo.push(to);
            }
      }
    };
    for (const int body : pinned)
      if (number[body] < 0) flood(body, 0);
    int n = 0;
    for (int body = 0; body < bodies; body++)
      if (number[body] < 0) flood(body, ++n);
    return number;
  }
};

Graph random_graph(std::mt19937 &random, int bodies, int pairs, int pins)
{
  Graph graph{bodies, {}, {}};
  std::uniform_int_distribution<int> any(0, bodies - 1);
  for (int n = 0; n < pairs; n++) {
    const int a = any(random), b = any(random);
    if (a != b) graph.pairs.push_back({a, b});
  }
  for (int n = 0; n < pins; n++) graph.pinned.insert(any(random));
  return graph;
}

Islands islands_of(const Graph &graph, int pairs_of_tile)
{
  Islands islands;
  islands.begin(graph.bodies);
  for (const auto &[a, b] : graph.pairs) islands.join(a, b);
  for (const int body : graph.pinned) islands.pin(body);
  std::vector<int> all(graph.bodies);
  std::iota(all.begin(), all.end(), 0);
  islands.form_tiles(all, pairs_of_tile);
  return islands;
}

TEST(Islands, tiles_never_part_what_hangs_together)
{
  std::mt19937 random(7);
  for (int round = 0; round < 60; round++) {
    const auto graph = random_graph(random, 80, round, round % 4);
    const auto islands = islands_of(graph, 5);
    const auto component = graph.components();
    std::map<int, int> tile_of_component;
    for (int body = 0; body < graph.bodies; body++) {
      const int tile = islands.tile_of(body);
      ASSERT_GE(tile, 0);
      ASSERT_LT(tile, islands.size());
      EXPECT_EQ(tile == 0, component[body] == 0) << body;
      const auto [known, is_new] = tile_of_component.insert({component[body], tile});
      EXPECT_EQ(known->second, tile) << body;
    }
  }
}

TEST(Islands, tiles_are_about_as_large_as_asked_for)
{
  Graph graph{400, {}, {}};
  for (int i = 0; i < 400; i += 4)    // rows of four
    for (int j = i; j < i + 3; j++) graph.pairs.push_back({j, j + 1});
  const auto islands = islands_of(graph, 30);
  EXPECT_EQ(islands.size(), 1 + 10);    // the first for what is pinned; ten rows of three in others
  std::vector<int> pairs(islands.size(), 0);
  for (const auto &pair : graph.pairs) pairs[islands.tile_of(pair.first)]++;
  EXPECT_EQ(pairs[0], 0);
  for (int t = 1; t < islands.size(); t++) EXPECT_EQ(pairs[t], 30);
}

// ---- contacts

// what is to stay of a contact whatever list it is in; by its mark
struct Known {
  int i, j;
  double overlap, sliding, rolling, twisting, normal, crowding;
  bool operator==(const Known &o) const
  {
    return i == o.i && j == o.j && overlap == o.overlap && sliding == o.sliding &&
        rolling == o.rolling && twisting == o.twisting && normal == o.normal &&
        crowding == o.crowding;
  }
};
using Model = std::map<int, Known>;

Model contents(const ContactList &list)
{
  Model model;
  for (int k = 0; k < list.size(); k++) {
    const auto h = list.history_of(k);
    model[list.source[k]] = {
        list.i[k],    list.j[k],  list.overlap(k), h.sliding[1],
        h.rolling[0], h.twisting, h.normal[2],     list.constants_of(k).crowd_mass};
  }
  EXPECT_EQ(static_cast<int>(model.size()), list.size());
  return model;
}

int kind_for(ContactList &list, double radius)
{
  ContactModel model;
  model.surface = {1e6, 4e5, 1.0};
  return list.kinds.find(1, model, ContactBodies::pair(radius, radius, 1.0, 1.0));
}

void fill(ContactList &list, int body_i, int body_j, int mark, std::mt19937 &random)
{
  std::uniform_real_distribution<double> any(0.1, 1.0);
  ContactHistory h;
  for (double *c : {h.sliding, h.rolling, h.normal})
    for (int n = 0; n < 3; n++) c[n] = any(random);
  h.twisting = any(random);
  const int k = list.add(body_i, body_j, mark, kind_for(list, 1.0 + mark % 3), h);
  list.update(k, any(random), h);
}

TEST(ContactTiles, contacts_change_in_their_tiles_as_in_one_list)
{
  std::mt19937 random(11);
  std::uniform_real_distribution<double> chance(0.0, 1.0);
  for (int round = 0; round < 20; round++) {
    const auto graph = random_graph(random, 150, 90, 3);
    const auto islands = islands_of(graph, 12);
    ContactList list;
    std::vector<int> near;
    const int n = static_cast<int>(graph.pairs.size());
    for (int mark = 0; mark < n; mark++)    // a third only near
      if (mark % 3)
        fill(list, graph.pairs[mark].first, graph.pairs[mark].second, mark, random);
      else
        near.push_back(mark);
    Model model = contents(list);
    const auto near_before = near;

    ContactTiles tiles;
    tiles.part(
        list, near, islands.size(),
        [&](int k) {
          return islands.tile_of(list.i[k]);
        },
        [&](int p) {
          return islands.tile_of(graph.pairs[near[p]].first);
        });
    size_t seen = 0;
    for (int t = 0; t < islands.size(); t++) {
      tiles.enter(t, list, near);
      for (int k = 0; k < list.size(); k++) {
        EXPECT_EQ(islands.tile_of(list.i[k]), t);
        EXPECT_EQ(list.mode(k).mass,
                  list.kinds[kind_for(list, 1.0 + list.source[k] % 3)].mode.mass);
      }
      seen += list.size();
      const auto made = near;
      for (const int mark : made) {    // near ones touch, others let go, and all change
        EXPECT_EQ(islands.tile_of(graph.pairs[mark].first), t);
        if (chance(random) < 0.5)
          fill(list, graph.pairs[mark].first, graph.pairs[mark].second, mark, random);
      }
      for (int k = list.size() - 1; k >= 0; k--) {
        if (chance(random) > 0.3) continue;
        const int mark = list.source[k];
        const int i = list.i[k], j = list.j[k];
        list.remove(k);
        model.erase(mark);
        if (chance(random) < 0.3) fill(list, i, j, mark, random);    // and touches once more
      }
      for (int k = 0; k < list.size(); k++) {
        auto h = list.history_of(k);
        h.twisting += 1.0;
        list.update(k, list.overlap(k) + 0.5, h);
      }
      for (const auto &[mark, known] : contents(list)) model[mark] = known;
      tiles.leave(list, near);
      EXPECT_EQ(near, near_before);
    }
    EXPECT_EQ(seen, static_cast<size_t>(n) - near_before.size());
    tiles.join(list);
    EXPECT_EQ(contents(list), model);

    // kinds know how many contacts they have: when all are gone, all can be found again or are free
    const double memory = list.kinds.memory_usage();
    while (list.size()) list.remove(list.size() - 1);
    for (int n_kinds = 0; n_kinds < 3; n_kinds++) kind_for(list, 1.0 + n_kinds);
    EXPECT_EQ(list.kinds.memory_usage(), memory);
  }
}

}    // namespace
