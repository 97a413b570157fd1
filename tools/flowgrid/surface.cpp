#include "surface.h"
#include "decimals.h"

#include <map>
#include <set>
#include <stdexcept>
#include <unordered_map>

namespace flowgrid {

namespace {

  std::string written(const Point &x)
  {
    return text_of(x[0]) + " " + text_of(x[1]) + " " + text_of(x[2]);
  }

  Box box_of(const Surface &surface)
  {
    Box box;
    for (const auto &p : surface.points) box.add(p);
    return box;
  }

  // Points closer than the tolerance become one. Cells count from the lower corner of the surface,
  // which keeps their numbers small wherever that is.
  int merge_points(Surface &surface, const Point &low, double tolerance)
  {
    std::unordered_multimap<size_t, int> cells;
    std::vector<Point> kept;
    std::vector<int> becomes;
    const auto key = [](long long i, long long j, long long k) {
      return static_cast<size_t>((i * 73856093LL) ^ (j * 19349663LL) ^ (k * 83492791LL));
    };
    for (const auto &p : surface.points) {
      long long at[3];
      for (int c = 0; c < 3; c++) at[c] = std::llround((p[c] - low[c]) / (2.0 * tolerance));
      int found = -1;
      for (int n = 0; n < 27 && found < 0; n++) {
        const auto [from, to] =
            cells.equal_range(key(at[0] + n % 3 - 1, at[1] + n / 3 % 3 - 1, at[2] + n / 9 - 1));
        for (auto it = from; it != to && found < 0; ++it)
          if (length(kept[it->second] - p) <= tolerance) found = it->second;
      }
      if (found < 0) {
        found = static_cast<int>(kept.size());
        kept.push_back(p);
        cells.insert({key(at[0], at[1], at[2]), found});
      }
      becomes.push_back(found);
    }
    for (auto &t : surface.triangles)
      for (int &corner : t) corner = becomes[corner];
    const int merged = static_cast<int>(surface.points.size() - kept.size());
    surface.points = std::move(kept);
    return merged;
  }

  int remove_duplicates(Surface &surface)
  {
    std::set<std::array<int, 3>> known;
    std::vector<bool> twice;
    for (auto corners : surface.triangles) {
      std::sort(corners.begin(), corners.end());
      twice.push_back(!known.insert(corners).second);
    }
    surface.remove(twice);
    return static_cast<int>(std::count(twice.begin(), twice.end(), true));
  }

  // Triangles with two corners in one go. One whose corners lie in a line is taken away by adding
  // its middle corner to the triangle along its longest side.
  int remove_degenerate(Surface &surface, double tolerance)
  {
    int removed = 0;
    for (size_t round = 0; round < surface.triangles.size() + 1; round++) {
      std::vector<bool> gone(surface.triangles.size(), false);
      int line = -1;
      for (size_t t = 0; t < surface.triangles.size(); t++) {
        const auto &[a, b, c] = surface.triangles[t];
        gone[t] = a == b || b == c || c == a;
        double longest = 0.0;
        for (int k = 0; k < 3; k++)
          longest = std::max(longest,
                             length(surface.points[surface.triangles[t][k]] -
                                    surface.points[surface.triangles[t][(k + 1) % 3]]));
        if (!gone[t] && length(surface.normal(static_cast<int>(t))) <= tolerance * longest)
          line = static_cast<int>(t);
      }
      if (line >= 0) {
        auto of = surface.triangles[line];
        const auto side = [&](int k) {
          return length(surface.points[of[(k + 1) % 3]] - surface.points[of[(k + 2) % 3]]);
        };
        while (side(0) < side(1) || side(0) < side(2))
          std::rotate(of.begin(), of.begin() + 1, of.end());
        gone[line] = true;
        for (size_t t = 0; t < gone.size(); t++)
          for (int k = 0; k < 3 && !gone[t]; k++) {
            const auto old = surface.triangles[t];
            const int p = old[k], q = old[(k + 1) % 3], r = old[(k + 2) % 3];
            if (!((p == of[1] && q == of[2]) || (p == of[2] && q == of[1])) || r == of[0]) continue;
            surface.triangles[t] = {p, of[0], r};
            surface.triangles.push_back({of[0], q, r});
            surface.zone.push_back(surface.zone[t]);
            surface.source.push_back(surface.source[t]);
            gone.push_back(false);
            t = gone.size();
            break;
          }
      }
      surface.remove(gone);
      removed += static_cast<int>(std::count(gone.begin(), gone.end(), true));
      if (line < 0) break;
    }
    return removed;
  }

  // Turns triangles round until neighbors run along their common edge in opposite senses; most of
  // those that hang together keep their sense.
  int orient(Surface &surface, const std::vector<std::array<int, 3>> &neighbors)
  {
    auto &triangles = surface.triangles;
    std::vector<char> known(triangles.size(), 0), turned(triangles.size(), 0);
    const auto runs = [&](int t, int a, int b) {
      for (int k = 0; k < 3; k++)
        if (triangles[t][k] == a && triangles[t][(k + 1) % 3] == b) return true;
      return false;
    };
    int count = 0;
    for (size_t seed = 0; seed < triangles.size(); seed++) {
      if (known[seed]) continue;
      std::vector<int> part{static_cast<int>(seed)};
      known[seed] = 1;
      for (size_t n = 0; n < part.size(); n++)
        for (int k = 0; k < 3; k++) {
          const int t = part[n], next = neighbors[t][k];
          if (next < 0) continue;
          const bool same = runs(next, triangles[t][k], triangles[t][(k + 1) % 3]);
          const char wanted = same ? !turned[t] : turned[t];
          if (known[next] && turned[next] != wanted)
            throw std::runtime_error("the surface has one side only, near " +
                                     written(surface.points[triangles[t][k]]));
          if (known[next]) continue;
          known[next] = 1;
          turned[next] = wanted;
          part.push_back(next);
        }
      int many = 0;
      for (const int t : part) many += turned[t];
      const bool invert = 2 * many > static_cast<int>(part.size());
      for (const int t : part) {
        if (turned[t] == invert) continue;
        std::swap(triangles[t][1], triangles[t][2]);
        count++;
      }
    }
    return count;
  }

  void check_ends(const Surface &surface, const Grid &grid,
                  const std::vector<std::array<int, 3>> &neighbors)
  {
    const auto outside = [&](const Point &x) {
      for (int c = 0; c < (grid.n[2] == 1 ? 2 : 3); c++) {
        const double h = grid.spacing[c], end = grid.origin[c] + (grid.n[c] - 1) * h;
        if (x[c] < grid.origin[c] + 1e-3 * h || x[c] > end - 1e-3 * h) return true;
      }
      return false;
    };
    int open = 0;
    Point at{};
    for (size_t t = 0; t < neighbors.size(); t++)
      for (int k = 0; k < 3; k++) {
        if (neighbors[t][k] >= 0) continue;
        const Point &a = surface.points[surface.triangles[t][k]];
        const Point &b = surface.points[surface.triangles[t][(k + 1) % 3]];
        if (outside(a) && outside(b)) continue;
        // in a plane the ends along z are no ends
        if (grid.n[2] == 1 && a[2] == b[2]) continue;
        open++;
        at = 0.5 * (a + b);
      }
    if (open)
      throw std::runtime_error("the surface is not closed: " + std::to_string(open) +
                               " edges within the grid have one triangle only, as at " +
                               written(at));
  }

}    // namespace

void Surface::remove(const std::vector<bool> &which)
{
  size_t kept = 0;
  for (size_t t = 0; t < triangles.size(); t++) {
    if (which[t]) continue;
    triangles[kept] = triangles[t];
    source[kept] = source[t];
    zone[kept++] = zone[t];
  }
  triangles.resize(kept);
  zone.resize(kept);
  source.resize(kept);
}

std::vector<std::array<int, 3>> neighbors_of(const std::vector<std::array<int, 3>> &triangles,
                                             const std::vector<Point> &points)
{
  std::vector<std::array<int, 3>> result(triangles.size(), {-1, -1, -1});
  std::map<std::pair<int, int>, std::pair<int, int>> first;    // triangle and edge
  for (size_t t = 0; t < triangles.size(); t++)
    for (int k = 0; k < 3; k++) {
      const int a = triangles[t][k], b = triangles[t][(k + 1) % 3];
      const auto [place, is_new] = first.try_emplace({std::min(a, b), std::max(a, b)},
                                                     std::pair<int, int>{static_cast<int>(t), k});
      if (is_new) continue;
      auto &[other, edge] = place->second;
      if (other < 0)
        throw std::runtime_error("more than two triangles of the surface meet in an edge at " +
                                 written(points[a]));
      result[t][k] = other;
      result[other][edge] = static_cast<int>(t);
      other = -1;
    }
  return result;
}

Repairs make_whole(Surface &surface, const Grid &grid)
{
  const Box box = box_of(surface);
  const double size = length(box.high - box.low), tolerance = 1e-9 * size;
  if (surface.triangles.empty() || !(tolerance > 0.0))
    throw std::runtime_error("the surface has no triangles, or all its points are one");
  if (!std::isfinite(size))
    throw std::runtime_error("the surface is too large: its size is no number");
  Repairs done;
  done.merged = merge_points(surface, box.low, tolerance);
  done.degenerate = remove_degenerate(surface, tolerance);
  done.duplicate = remove_duplicates(surface);
  if (surface.triangles.empty()) throw std::runtime_error("the surface has no triangles");
  const auto neighbors = neighbors_of(surface.triangles, surface.points);
  done.turned = orient(surface, neighbors);
  if (!surface.may_end) check_ends(surface, grid, neighbors);
  return done;
}

}    // namespace flowgrid
