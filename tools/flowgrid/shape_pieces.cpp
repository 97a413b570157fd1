// The faces, edges and pieces of a wall of shapes, as the nodes near it tell.

#include "shape_wall.h"

#include "decimals.h"
#include "nearest_point.h"
#include "union_find.h"

#include <stdexcept>

namespace flowgrid {

// What the nodes near the wall tell.
struct ShapeWall::Survey {
  struct Counts {
    int of[4] = {};    // of each meeting
    Point at{};        // where a concave one is
  };
  std::vector<std::map<std::string, int>> zones;    // of each carrier: samples in each solid
  std::vector<Box> bounds;                          // of each carrier's faces
  std::map<std::pair<int, int>, Counts> meetings;
};

ShapeWall::ShapeWall(ShapeTree solids, const Grid &grid, const Periods &periods, double turning) :
    tree(std::move(solids)), planar(grid.n[2] == 1), size(0.0), piece(tree.carriers.size(), -1),
    across(tree.carriers.size(), false), face(tree.size(), false)
{
  for (int c = 0; c < 3; c++) size += grid.n[c] * grid.spacing[c];
  if (planar)
    for (size_t c = 0; c < tree.carriers.size(); c++) {
      const auto &of = tree.carriers[c];
      across[c] = of.kind == Carrier::Kind::plane && std::fabs(of.axis[2]) == 1.0;
    }
  check_planar();

  Survey survey;
  survey.zones.resize(piece.size());
  survey.bounds.resize(piece.size());
  find_faces(grid, survey);
  const double reach =
      2.0 * std::max({grid.spacing[0], grid.spacing[1], planar ? 0.0 : grid.spacing[2]});
  std::vector<int> near;
  for (int k = 0; k < grid.n[2]; k++)
    for (int j = 0; j < grid.n[1]; j++)
      for (int i = 0; i < grid.n[0]; i++) {
        const Point x = grid.node(i, j, k);
        near.clear();
        for (size_t c = 0; c < piece.size(); c++)
          if (!survey.zones[c].empty() && std::fabs(tree.carriers[c].distance(x)) < reach)
            near.push_back(static_cast<int>(c));
        for (size_t a = 0; a < near.size(); a++)
          for (size_t b = a + 1; b < near.size(); b++)
            note_meeting(near[a], near[b], x, grid, turning, survey);
      }
  make_pieces(survey, periods);
}

void ShapeWall::check_planar() const
{
  if (!planar) return;
  for (size_t c = 0; c < piece.size(); c++) {
    const auto &of = tree.carriers[c];
    const bool upright = of.kind == Carrier::Kind::plane
        ? of.axis[2] == 0.0 || across[c]
        : of.kind == Carrier::Kind::cylinder && std::fabs(of.axis[2]) == 1.0;
    if (!upright)
      throw std::runtime_error("in a plane grid shapes are of rectangle, disc, polygon, plane with "
                               "NZ = 0, box and cylinder along z");
  }
}

// Carriers that are faces of the wall somewhere in the grid, and of which solids.
void ShapeWall::find_faces(const Grid &grid, Survey &survey)
{
  Box box;
  box.add(grid.node(0, 0, 0));
  box.add(grid.node(grid.n[0] - 1, grid.n[1] - 1, grid.n[2] - 1));
  const double reach = std::max({grid.spacing[0], grid.spacing[1], planar ? 0.0 : grid.spacing[2]});
  for (int k = 0; k < grid.n[2]; k++)
    for (int j = 0; j < grid.n[1]; j++)
      for (int i = 0; i < grid.n[0]; i++) {
        const Point x = grid.node(i, j, k);
        for (size_t c = 0; c < piece.size(); c++) {
          if (across[c] || std::fabs(tree.carriers[c].distance(x)) > reach) continue;
          const Point y = tree.carriers[c].foot(x);
          if (box.distance(y) > reach) continue;
          Sides side = sides(y, on_surface * size);
          int ties = 0;
          for (const signed char s : side) ties += s == 0;
          if (ties > 1) continue;    // an edge: its faces are found beside it
          side[c] = -1;
          const auto below = at(side);
          side[c] = 1;
          if (below == at(side)) continue;
          survey.bounds[c].add(y);
          for (const signed char s : {-1, 1}) {
            side[c] = s;
            note_face(static_cast<int>(c), side, survey);
          }
        }
      }
}

// The half spaces and the solid that a face belongs to. side: just outside of it, or inside.
void ShapeWall::note_face(int carrier, const Sides &side, Survey &survey)
{
  const auto flipped = [&](int which) {
    return [&, which](int node) {
      const signed char here = side[tree.carrier_of(node)];
      return which == node || (which < 0 && tree.carrier_of(node) == carrier) ? -here : here;
    };
  };
  const auto here = at(side);
  for (int node = 0; node < tree.size(); node++)
    if (tree.carrier_of(node) == carrier && !face[node])
      face[node] = tree.at(flipped(node)) != here;
  const auto plain = [&](int node) {
    return side[tree.carrier_of(node)];
  };
  for (const auto &solid : tree.solids)
    if (tree.at(solid.root, plain) != tree.at(solid.root, flipped(-1))) {
      survey.zones[carrier][solid.name]++;
      return;
    }
}

void ShapeWall::note_meeting(int a, int b, const Point &x, const Grid &grid, double turning,
                             Survey &survey) const
{
  const Carrier *pair[2] = {&tree.carriers[a], &tree.carriers[b]};
  double reach = 0.0;
  for (int c = 0; c < (planar ? 2 : 3); c++) reach = std::max(reach, 4.0 * grid.spacing[c]);
  Point y;
  Meeting found = Meeting::none;
  if (nearest_point(pair, 2, x, y)) {
    if (length(y - x) < reach) found = meeting(a, b, y, turning);
  }
  if (found == Meeting::none) {
    // they may touch, on the line between their middles: smoothly if they do so with equal normals
    const bool curved = pair[1]->kind != Carrier::Kind::plane;
    y = pair[!curved]->foot(pair[curved]->middle(x));
    y = pair[0]->foot(y);
    const Point z = pair[1]->foot(y);
    if (length(y - x) < reach && length(y - z) < 0.01 * reach &&
        std::fabs(dot(pair[0]->normal(y), pair[1]->normal(z))) > 0.99) {
      Sides at_y = sides(y, on_surface * size), at_z = sides(z, on_surface * size);
      const auto outward = [&](Sides &side, int c, int other) {
        side[other] = static_cast<signed char>(tree.carriers[other].distance(x) > 0.0 ? 1 : -1);
        side[c] = 1;
        const auto above = at(side);
        side[c] = -1;
        return above - at(side);
      };
      const int up = outward(at_y, a, b), wards = outward(at_z, b, a);
      if (up && wards && up * wards * dot(pair[0]->normal(y), pair[1]->normal(z)) > 0.0)
        found = Meeting::smooth;
    }
  }
  if (found == Meeting::none) return;
  auto &counts = survey.meetings[{a, b}];
  counts.of[static_cast<int>(found)]++;
  if (found == Meeting::concave) counts.at = y;
}

// How two faces meet at a point of both carriers: from which of the four quarters are solid.
ShapeWall::Meeting ShapeWall::meeting(int a, int b, const Point &y, double turning) const
{
  Sides side = sides(y, on_surface * size);
  side[a] = side[b] = 1;
  for (const signed char s : side)
    if (s == 0) return Meeting::none;    // a corner: its edges are found beside it
  bool solid[4];
  int count = 0;
  for (int quarter = 0; quarter < 4; quarter++) {
    side[a] = quarter & 1 ? 1 : -1;
    side[b] = quarter & 2 ? 1 : -1;
    solid[quarter] = at(side) == ShapeTree::solid;
    count += solid[quarter];
  }
  if (count == 0 || count == 4) return Meeting::none;
  if (count == 2) return solid[0] == solid[3] ? Meeting::concave : Meeting::none;
  if (count == 1) return Meeting::convex;
  const int fluid = solid[0] ? solid[1] ? solid[2] ? 3 : 2 : 1 : 0;
  const double sign = (fluid & 1 ? 1 : -1) * (fluid & 2 ? 1 : -1);
  const Point n = tree.carriers[a].normal(y), m = sign * tree.carriers[b].normal(y);
  return angle(n, m) > turning ? Meeting::concave : Meeting::smooth;
}

// Faces that meet in other than concave edges are one piece, and so are a face and its copies.
void ShapeWall::make_pieces(Survey &survey, const Periods &periods)
{
  UnionFind joined(static_cast<int>(piece.size()));
  for (const auto &[pair, counts] : survey.meetings)
    if (counts.of[static_cast<int>(Meeting::convex)] +
            counts.of[static_cast<int>(Meeting::smooth)] >
        counts.of[static_cast<int>(Meeting::concave)])
      joined.unite(pair.first, pair.second);
  for (const Point &shift : periods.shifts())
    for (size_t c = 0; c < piece.size(); c++) {
      Carrier copy = tree.carriers[c];
      copy.origin = copy.origin + shift;
      for (size_t other = 0; other < c; other++)
        if (copy.same_as(tree.carriers[other], 1e-9 * size))
          joined.unite(static_cast<int>(c), static_cast<int>(other));
    }
  std::map<int, int> number;
  std::map<int, std::map<std::string, int>> zones;
  for (size_t c = 0; c < piece.size(); c++) {
    if (survey.zones[c].empty()) continue;
    const int root = joined.root(static_cast<int>(c));
    const auto [place, is_new] = number.try_emplace(root, static_cast<int>(list.size()));
    if (is_new) list.emplace_back();
    piece[c] = place->second;
    list[piece[c]].bounds.add(survey.bounds[c].low);
    list[piece[c]].bounds.add(survey.bounds[c].high);
    for (const auto &[name, count] : survey.zones[c]) zones[piece[c]][name] += count;
  }
  if (list.empty()) throw std::runtime_error("no face of a --shape lies in the grid");
  for (size_t p = 0; p < list.size(); p++) {
    const auto most = std::max_element(zones[p].begin(), zones[p].end(), [](auto &a, auto &b) {
      return a.second < b.second;
    });
    list[p].zone = most->first;
    for (const auto &[name, count] : zones[p])
      if (name != most->first)
        remarks.push_back("shapes " + most->first + " and " + name +
                          " go over into each other without a concave crease: one array, " +
                          most->first);
  }
  used.assign(list.size(), std::vector<bool>(tree.size(), false));
  for (int node = 0; node < tree.size(); node++) {
    const int c = tree.carrier_of(node);
    if (c >= 0 && piece[c] >= 0 && face[node]) used[piece[c]][node] = true;
  }
  for (auto &marks : used) tree.mark_upward(marks);
  crease.assign(piece.size(), std::vector<bool>(piece.size(), false));
  for (const auto &[pair, counts] : survey.meetings)
    if (counts.of[static_cast<int>(Meeting::concave)])
      crease[pair.first][pair.second] = crease[pair.second][pair.first] = true;
  for (const auto &[pair, counts] : survey.meetings)
    if (counts.of[static_cast<int>(Meeting::concave)] && piece[pair.first] == piece[pair.second]) {
      const Point &at = counts.at;
      remarks.push_back("the concave crease of " + list[piece[pair.first]].zone + " at " +
                        text_of(at[0]) + " " + text_of(at[1]) + " " + text_of(at[2]) +
                        " has the same piece of wall on both sides: particles have one contact "
                        "there");
    }
}

}    // namespace flowgrid
