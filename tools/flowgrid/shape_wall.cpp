#include "shape_wall.h"

#include "nearest_point.h"
#include "union_find.h"

#include <set>
#include <stdexcept>

namespace flowgrid {

namespace {

  constexpr double on_surface = 1e-10;    // of the grid's size: distances that are 0

  // Whether there is a direction into all the half spaces n . d > 0: the perceptron finds one.
  bool have_common_part(const std::vector<Point> &normals)
  {
    Point d{};
    for (int round = 0; round < 100; round++) {
      bool all = true;
      for (const auto &n : normals)
        if (dot(n, d) <= 0.0) {
          d = d + n;
          all = false;
        }
      if (all) return true;
    }
    return false;
  }

}    // namespace

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

ShapeWall::ShapeWall(ShapeTree solids, const Grid &grid, double turning) :
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
  make_pieces(survey);
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

/* ---------------------------------------------------------------------- */

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
  } else {
    // they may touch: smoothly if they do so with equal normals
    y = pair[0]->foot(x);
  }
  if (found == Meeting::none) {
    y = pair[0]->foot(x);
    const Point z = pair[1]->foot(y);
    if (length(y - z) < 0.01 * reach &&
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

/* ---------------------------------------------------------------------- */

// Faces that meet in other than concave edges are one piece.
void ShapeWall::make_pieces(Survey &survey)
{
  UnionFind joined(static_cast<int>(piece.size()));
  for (const auto &[pair, counts] : survey.meetings)
    if (counts.of[static_cast<int>(Meeting::convex)] +
            counts.of[static_cast<int>(Meeting::smooth)] >
        counts.of[static_cast<int>(Meeting::concave)])
      joined.unite(pair.first, pair.second);
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
                        std::to_string(at[0]) + " " + std::to_string(at[1]) + " " +
                        std::to_string(at[2]) +
                        " has the same piece of wall on both sides: particles have one contact "
                        "there");
    }
}

/* ---------------------------------------------------------------------- */

// On which side of each carrier a point is, 0 for those that it is within `on` of.
ShapeWall::Sides ShapeWall::sides(const Point &x, double on) const
{
  Sides side(tree.carriers.size());
  for (size_t c = 0; c < side.size(); c++) {
    const double d = tree.carriers[c].distance(x);
    side[c] = std::fabs(d) < on && !across[c] ? 0 : d >= 0.0 ? 1 : -1;
  }
  return side;
}

signed char ShapeWall::at(const Sides &side) const
{
  return tree.at([&](int node) {
    return side[tree.carrier_of(node)];
  });
}

// The same for a piece: faces of other pieces are left out, so that it goes on beyond them, and so
// are the parts of the formula without a face of it.
signed char ShapeWall::at(int which, const Sides &side) const
{
  if (which < 0) return at(side);
  return tree.at(
      [&](int node) -> signed char {
        const int carrier = tree.carrier_of(node);
        const bool counts = piece[carrier] < 0 || (piece[carrier] == which && face[node]);
        return counts ? side[carrier] : 0;
      },
      used[which]);
}

ShapeWall::Border ShapeWall::border(int which, const Nearest &candidate, double limit) const
{
  const Sides side = sides(candidate.at, on_surface * size);
  bool all_fluid, ignored;
  const bool wall = changes(-1, candidate, side, all_fluid);
  if (which >= 0 && !all_fluid && changes(which, candidate, side, ignored) &&
      (wall || near_own_crease(candidate, limit)))
    return Border::piece;
  return wall ? Border::wall : Border::none;
}

// Whether the carriers of a point part solid from fluid there. side: 0 for those that it is on.
bool ShapeWall::changes(int which, const Nearest &candidate, Sides side, bool &all_fluid) const
{
  constexpr size_t most = 10;
  std::vector<int> tied(candidate.carriers, candidate.carriers + 3);
  tied.erase(std::remove(tied.begin(), tied.end(), -1), tied.end());
  std::vector<int> crossing;
  const size_t given = tied.size();
  for (int c = 0; c < static_cast<int>(side.size()); c++) {
    if (side[c] != 0 || std::find(tied.begin(), tied.end(), c) != tied.end()) continue;
    const Point n = tree.carriers[c].normal(candidate.at);
    bool touches = false;    // one of the point's carriers, so that they change sides together
    for (size_t k = 0; k < given; k++)
      touches |= length(cross(n, tree.carriers[tied[k]].normal(candidate.at))) < 1e-6;
    (touches ? tied : crossing).push_back(c);
  }
  const size_t own = std::min(tied.size(), most);
  tied.insert(tied.end(), crossing.begin(), crossing.end());
  tied.resize(std::min(tied.size(), most));
  all_fluid = true;
  for (int others = 0; others < 1 << (tied.size() - own); others++) {
    bool solid = false, fluid = false;
    for (int own_bits = 0; own_bits < 1 << own; own_bits++) {
      std::vector<Point> normals;
      const int bits = others << own | own_bits;
      for (size_t k = 0; k < tied.size(); k++) {
        side[tied[k]] = bits >> k & 1 ? 1 : -1;
        normals.push_back(double(side[tied[k]]) * tree.carriers[tied[k]].normal(candidate.at));
      }
      if (tied.size() > 2 && !have_common_part(normals)) continue;
      (at(which, side) == ShapeTree::solid ? solid : fluid) = true;
    }
    all_fluid = all_fluid && !solid;
    if (solid && fluid) return true;
  }
  return false;
}

// A continuation ends where another side of the solid is nearer than that of the crease which it
// came through.
bool ShapeWall::near_own_crease(const Nearest &candidate, double limit) const
{
  const Nearest wall = nearest(-1, candidate.at, limit);
  if (std::isnan(wall.distance)) return true;
  for (const int own : candidate.carriers)
    for (const int other : wall.carriers)
      if (own >= 0 && other >= 0 && crease[own][other]) return true;
  return false;
}

ShapeWall::Nearest ShapeWall::nearest(int which, const Point &x, double limit) const
{
  std::vector<std::pair<double, int>> near;
  for (int c = 0; c < static_cast<int>(piece.size()); c++) {
    if (!counts(which, c)) continue;
    const double d = std::fabs(tree.carriers[c].distance(x));
    if (d <= limit) near.push_back({d, c});
  }
  std::sort(near.begin(), near.end());
  Nearest best;
  const auto may_be_better = [&](double d) {
    return d <= limit && !(d >= best.distance);
  };
  const auto consider = [&](Nearest candidate) {
    candidate.distance = length(candidate.at - x);
    if (!may_be_better(candidate.distance)) return;
    candidate.border = border(which, candidate, limit);
    if (candidate.border != Border::none) best = candidate;
  };
  for (const auto &[d, c] : near)
    if (may_be_better(d)) consider({d, tree.carriers[c].foot(x), Border::none, {c, -1, -1}});
  const Carrier *of[3];
  Point y;
  for (size_t a = 0; a < near.size() && may_be_better(near[a].first); a++)
    for (size_t b = 0; b < a; b++) {
      of[0] = &tree.carriers[near[a].second];
      of[1] = &tree.carriers[near[b].second];
      if (nearest_point(of, 2, x, y))
        consider({0.0, y, Border::none, {near[a].second, near[b].second, -1}});
      for (size_t c = 0; c < b && !planar; c++) {
        of[2] = &tree.carriers[near[c].second];
        if (nearest_point(of, 3, x, y))
          consider({0.0, y, Border::none, {near[a].second, near[b].second, near[c].second}});
      }
    }
  return best;
}

double ShapeWall::distance(const Point &x, double limit) const
{
  const double d = nearest(-1, x, limit).distance;
  return at(sides(x, 0.0)) == ShapeTree::solid ? -d : d;
}

// The side of x is that of the surface around the nearest point.
double ShapeWall::distance(int which, const Point &x, double limit) const
{
  const Nearest found = nearest(which, x, limit);
  if (std::isnan(found.distance)) return unknown;
  const Sides of_x = sides(x, 0.0);
  Sides side = sides(found.at, on_surface * size);
  for (size_t c = 0; c < side.size(); c++)
    if (side[c] == 0) side[c] = of_x[c];
  for (const int c : found.carriers)
    if (c >= 0) side[c] = of_x[c];
  const bool behind = at(found.border == Border::piece ? which : -1, side) == ShapeTree::solid;
  if (behind && at(of_x) == ShapeTree::fluid) return std::numeric_limits<double>::infinity();
  return behind ? -found.distance : found.distance;
}

}    // namespace flowgrid
