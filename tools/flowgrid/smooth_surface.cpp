#include "smooth_surface.h"

#include "patch.h"
#include "union_find.h"

#include <set>

namespace flowgrid {

SmoothSurface::SmoothSurface(const Surface &surface, double turning) :
    facets(surface.triangles.size())
{
  find_edges(surface, turning);
  find_normals(surface);
  find_handles(surface);
}

void SmoothSurface::find_edges(const Surface &surface, double turning)
{
  const auto neighbors = neighbors_of(surface.triangles, surface.points);
  for (size_t t = 0; t < facets.size(); t++) {
    facets[t].neighbor = neighbors[t];
    for (int k = 0; k < 3; k++) {
      const int other = neighbors[t][k];
      if (other < 0) {
        facets[t].edge[k] = Edge::open;
        continue;
      }
      const Point n = surface.normal(static_cast<int>(t));
      const auto &corners = surface.triangles[other];
      const Point &a = surface.points[surface.triangles[t][k]];
      double above = 0.0;    // by how much the neighbor rises over the plane of this one
      for (const int corner : corners) {
        const double rise = dot(n, surface.points[corner] - a);
        if (std::fabs(rise) > std::fabs(above)) above = rise;
      }
      facets[t].edge[k] = angle(n, surface.normal(other)) < turning ? Edge::smooth
          : above > 0.0                                             ? Edge::concave
                                                                    : Edge::convex;
    }
  }
}

void SmoothSurface::find_normals(const Surface &surface)
{
  // corners of facets that hang together around a point have one normal
  UnionFind joined(static_cast<int>(3 * facets.size()));
  const auto corner_of = [&](int t, int point) {
    for (int k = 0; k < 3; k++)
      if (surface.triangles[t][k] == point) return 3 * t + k;
    return -1;
  };
  for (int t = 0; t < static_cast<int>(facets.size()); t++)
    for (int k = 0; k < 3; k++) {
      if (facets[t].edge[k] != Edge::smooth) continue;
      for (const int end : {k, (k + 1) % 3})
        joined.unite(3 * t + end, corner_of(facets[t].neighbor[k], surface.triangles[t][end]));
    }
  std::vector<Point> sum(3 * facets.size(), Point{}), plain = sum;
  for (int t = 0; t < static_cast<int>(facets.size()); t++)
    for (int k = 0; k < 3; k++) {
      const Point &a = surface.points[surface.triangles[t][k]];
      const Point e = surface.points[surface.triangles[t][(k + 1) % 3]] - a;
      const Point f = surface.points[surface.triangles[t][(k + 2) % 3]] - a;
      const int root = joined.root(3 * t + k);
      sum[root] = sum[root] + (1.0 / (dot(e, e) * dot(f, f))) * cross(e, f);
      plain[root] = plain[root] + angle(e, f) * unit(cross(e, f));
    }
  for (int t = 0; t < static_cast<int>(facets.size()); t++)
    for (int k = 0; k < 3; k++) {
      const int root = joined.root(3 * t + k);
      facets[t].normal[k] = unit(sum[root]);
      // another mean tells how well the normal is known; half of its tilt over a quarter of an edge
      const double longest = length(surface.points[surface.triangles[t][(k + 1) % 3]] -
                                    surface.points[surface.triangles[t][k]]);
      error = std::max(error, longest * angle(sum[root], plain[root]) / 8.0);
    }
}

// Smooth edges leave their ends across the normals; others along the circle through their ends and
// the next one's, unless they turn a corner.
void SmoothSurface::find_handles(const Surface &surface)
{
  constexpr double straight_on = 0.85;    // cosine of the turn that is none
  const auto &points = surface.points;
  std::vector<std::set<int>> next(points.size());    // ends of edges that are not smooth
  for (size_t t = 0; t < facets.size(); t++)
    for (int k = 0; k < 3; k++) {
      const int a = surface.triangles[t][k], b = surface.triangles[t][(k + 1) % 3];
      if (facets[t].edge[k] == Edge::smooth) continue;
      next[a].insert(b);
      next[b].insert(a);
    }
  const auto course = [&](int a, int b) {
    const Point chord = points[b] - points[a], forward = unit(chord);
    if (next[a].size() != 2) return forward;
    const int other = *next[a].begin() == b ? *next[a].rbegin() : *next[a].begin();
    const Point back = points[a] - points[other];
    if (dot(unit(back), forward) < straight_on) return forward;
    return unit(length(back) * forward + (length(chord) / length(back)) * back);
  };
  for (size_t t = 0; t < facets.size(); t++)
    for (int k = 0; k < 3; k++) {
      const int ends[2] = {k, (k + 1) % 3};
      const Point middle =
          0.5 * (points[surface.triangles[t][ends[0]]] + points[surface.triangles[t][ends[1]]]);
      Point arc = 0.25 * middle;
      for (int n = 0; n < 2; n++) {
        const int a = surface.triangles[t][ends[n]], b = surface.triangles[t][ends[1 - n]];
        const Point direction = facets[t].edge[k] == Edge::smooth
            ? along_surface(points[b] - points[a], facets[t].normal[ends[n]])
            : course(a, b);
        facets[t].handle[k][n] = Patch::handle(points[a], points[b], direction);
        arc = arc + 0.375 * facets[t].handle[k][n];
      }
      bulge = std::max(bulge, length(arc - middle));
    }
}

}    // namespace flowgrid
