#include "facet_wall.h"
#include "decimals.h"

#include "union_find.h"

#include <map>

namespace flowgrid {

// An edge at which a piece ends, with its direction on from there at both ends
struct FacetWall::Rim {
  int triangle, edge;
  Point onward[2];    // of unit length at first, then as long as the piece goes on
};

FacetWall::FacetWall(Surface of, const Grid &grid, double turning, double reach) :
    surface(std::move(of)), smooth(surface, turning), piece(surface.triangles.size())
{
  find_pieces();
  whole = std::make_unique<PatchSet>(patches(-1, grid, reach));
  for (size_t p = 0; p < list.size(); p++)
    sets.push_back(patches(static_cast<int>(p), grid, reach));
}

// It is infinite where the fluid lies behind the continuation of the piece.
double FacetWall::distance(int which, const Point &x, double limit) const
{
  const double d = sets[which].nearest(x, limit).distance;
  if (d < 0.0 && whole->nearest(x, limit).distance > 0.0)
    return std::numeric_limits<double>::infinity();
  return d;
}

void FacetWall::find_pieces()
{
  const int count = static_cast<int>(piece.size());
  UnionFind joined(count);
  for (int t = 0; t < count; t++)
    for (int k = 0; k < 3; k++)
      if (smooth.facets[t].edge[k] == Edge::smooth || smooth.facets[t].edge[k] == Edge::convex)
        joined.unite(t, smooth.facets[t].neighbor[k]);
  std::map<int, int> copies;    // of each source, one
  for (int t = 0; t < count; t++)
    joined.unite(t, copies.try_emplace(surface.source[t], t).first->second);
  std::map<int, int> number;
  std::vector<std::map<int, double>> areas;    // of each piece: of its zones
  for (int t = 0; t < count; t++) {
    const auto [place, is_new] = number.try_emplace(joined.root(t), static_cast<int>(list.size()));
    if (is_new) {
      list.emplace_back();
      areas.emplace_back();
      list.back().surface_error = smooth.error;
    }
    piece[t] = place->second;
    areas[piece[t]][surface.zone[t]] += length(surface.normal(t));
    for (const int corner : surface.triangles[t]) list[piece[t]].bounds.add(surface.points[corner]);
  }
  for (size_t p = 0; p < list.size(); p++) {
    const auto most = std::max_element(areas[p].begin(), areas[p].end(), [](auto &a, auto &b) {
      return a.second < b.second;
    });
    list[p].zone = surface.zones[most->first];
    for (const auto &[zone, area] : areas[p])
      if (zone != most->first)
        remarks.push_back(surface.zones[zone] + " goes over into " + list[p].zone +
                          " without a concave crease: one array, " + list[p].zone);
  }
  std::vector<bool> told(list.size(), false);
  for (int t = 0; t < count; t++)
    for (int k = 0; k < 3; k++) {
      const int p = piece[t];
      if (smooth.facets[t].edge[k] != Edge::concave || told[p] ||
          piece[smooth.facets[t].neighbor[k]] != p)
        continue;
      told[p] = true;
      const Point &at = surface.points[surface.triangles[t][k]];
      remarks.push_back("a concave crease of " + list[p].zone + " at " + text_of(at[0]) + " " +
                        text_of(at[1]) + " " + text_of(at[2]) +
                        " has the same piece of wall on both sides: particles have one contact "
                        "there");
    }
}

// Edges where a piece ends; the whole wall (-1) ends where it is open. Where one goes over into the
// next the direction on is the mean.
std::vector<FacetWall::Rim> FacetWall::rims(int which) const
{
  std::vector<Rim> result;
  std::map<int, std::vector<std::pair<int, int>>> at_point;    // rim, end
  for (int t = 0; t < static_cast<int>(piece.size()); t++) {
    if (which >= 0 && piece[t] != which) continue;
    const auto &facet = smooth.facets[t];
    for (int k = 0; k < 3; k++) {
      const bool crease =
          which >= 0 && facet.edge[k] == Edge::concave && piece[facet.neighbor[k]] != which;
      if (facet.edge[k] != Edge::open && !crease) continue;
      const int ends[2] = {surface.triangles[t][k], surface.triangles[t][(k + 1) % 3]};
      Rim rim{t, k, {}};
      rim.onward[0] = unit(cross(facet.handle[k][0] - surface.points[ends[0]], facet.normal[k]));
      rim.onward[1] =
          unit(cross(surface.points[ends[1]] - facet.handle[k][1], facet.normal[(k + 1) % 3]));
      for (int n = 0; n < 2; n++) at_point[ends[n]].push_back({static_cast<int>(result.size()), n});
      result.push_back(rim);
    }
  }
  for (const auto &[point, ends] : at_point) {
    if (ends.size() != 2) continue;
    Point &a = result[ends[0].first].onward[ends[0].second];
    Point &b = result[ends[1].first].onward[ends[1].second];
    const Point mean = unit(a + b);
    const double cosine = dot(mean, a);
    if (cosine > 0.3) a = b = (1.0 / cosine) * mean;
  }
  return result;
}

// How far a piece goes on from a point of its rim: where it is open, if it leaves the grid there;
// at a crease into the solid, to half its thickness at most.
Point FacetWall::reach_at(const Point &x, const Point &direction, bool open, const Grid &grid,
                          double reach) const
{
  const int dims = grid.n[2] == 1 ? 2 : 3;
  const double step = 0.5 * *std::min_element(grid.spacing.begin(), grid.spacing.begin() + dims);
  if (open) {
    const Point y = x + step * direction;
    bool outside = false;
    for (int c = 0; c < dims; c++) {
      const double end = grid.origin[c] + (grid.n[c] - 1) * grid.spacing[c];
      outside = outside || y[c] < grid.origin[c] || y[c] > end;
    }
    return (outside ? reach : 0.0) * direction;
  }
  for (int k = 1; k * step < reach; k++) {
    const double s = k * step;
    if (whole->nearest(x + s * direction, reach).distance > 1e-6 * step) return 0.5 * s * direction;
  }
  return reach * direction;
}

PatchSet FacetWall::patches(int which, const Grid &grid, double reach) const
{
  std::vector<Patch> result;
  std::vector<Point> points = surface.points;
  std::vector<std::array<int, 3>> triangles;
  const auto add = [&](const std::array<int, 3> &t, const Point(*handles)[2]) {
    const Point corners[3] = {points[t[0]], points[t[1]], points[t[2]]};
    result.emplace_back(corners, handles);
    triangles.push_back(t);
  };
  for (size_t t = 0; t < piece.size(); t++)
    if (which < 0 || piece[t] == which) add(surface.triangles[t], smooth.facets[t].handle);

  // strips along the rims
  std::map<std::array<double, 3>, int> known;    // ends of strips
  const auto end_point = [&](const Point &x) {
    const auto [place, is_new] = known.try_emplace(x, static_cast<int>(points.size()));
    if (is_new) points.push_back(x);
    return place->second;
  };
  for (auto &rim : rims(which)) {
    const auto &facet = smooth.facets[rim.triangle];
    const int k = rim.edge, l = (k + 1) % 3;
    const int a = surface.triangles[rim.triangle][k], b = surface.triangles[rim.triangle][l];
    const bool open = facet.edge[k] == Edge::open;
    const Point ends[2] = {surface.points[a], surface.points[b]};
    for (int n = 0; n < 2; n++) rim.onward[n] = reach_at(ends[n], rim.onward[n], open, grid, reach);
    if (length(rim.onward[0]) == 0.0 || length(rim.onward[1]) == 0.0) continue;
    const int c = end_point(ends[0] + rim.onward[0]), d = end_point(ends[1] + rim.onward[1]);
    const auto third = [&](int from, int to) {
      return points[from] + (1.0 / 3.0) * (points[to] - points[from]);
    };
    const auto &handle = facet.handle[k];
    const Point diagonal[2] = {
        Patch::handle(points[c], points[b], along_surface(points[b] - points[c], facet.normal[k])),
        Patch::handle(points[b], points[c], along_surface(points[c] - points[b], facet.normal[l]))};
    const Point inner[3][2] = {
        {handle[1], handle[0]}, {third(a, c), third(c, a)}, {diagonal[0], diagonal[1]}};
    const Point outer[3][2] = {{diagonal[1], diagonal[0]},
                               {handle[0] + rim.onward[0], handle[1] + rim.onward[1]},
                               {third(d, b), third(b, d)}};
    add({b, a, c}, inner);
    add({b, c, d}, outer);
  }
  return PatchSet(std::move(result), std::move(triangles), points);
}

}    // namespace flowgrid
