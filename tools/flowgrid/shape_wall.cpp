#include "shape_wall.h"

#include "nearest_point.h"

namespace flowgrid {

namespace {

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
