#include "smooth_surface.h"

#include <stdexcept>

namespace flowgrid {

// Where the course of an edge from below z to above meets it
static Point crossing(const Point &low, const Point *handles, const Point &high, double z)
{
  double from = 0.0, to = 1.0;
  Point x{};
  for (int step = 0; step < 60; step++) {
    const double t = 0.5 * (from + to), s = 1.0 - t;
    x = s * s * s * low + 3.0 * s * s * t * handles[0] + 3.0 * s * t * t * handles[1] +
        t * t * t * high;
    (x[2] < z ? from : to) = t;
  }
  x[2] = z;
  return x;
}

Surface cut_at(const Surface &surface, const SmoothSurface &smooth, double z, double half_width)
{
  Surface cut;
  cut.zones = surface.zones;
  cut.may_end = surface.may_end;
  cut.is_strip = true;
  const Point wide{0.0, 0.0, half_width};
  for (size_t t = 0; t < surface.triangles.size(); t++) {
    std::vector<Point> ends;
    for (int k = 0; k < 3; k++) {
      const Point &a = surface.points[surface.triangles[t][k]];
      const Point &b = surface.points[surface.triangles[t][(k + 1) % 3]];
      if ((a[2] < z) == (b[2] < z)) continue;    // a corner in the plane counts as above it
      const auto &handle = smooth.facets[t].handle[k];
      const Point back[2] = {handle[1], handle[0]};
      ends.push_back(a[2] < z ? crossing(a, handle, b, z) : crossing(b, back, a, z));
    }
    if (ends.size() != 2) continue;
    if (dot(cross(ends[1] - ends[0], wide), surface.normal(static_cast<int>(t))) < 0.0)
      std::swap(ends[0], ends[1]);    // so that the strip's normal is this one's
    cut.add(ends[0] - wide, ends[1] - wide, ends[1] + wide, surface.zone[t]);
    cut.add(ends[0] - wide, ends[1] + wide, ends[0] + wide, surface.zone[t]);
  }
  if (cut.triangles.empty()) throw std::runtime_error("the surface does not meet the plane");
  return cut;
}

}    // namespace flowgrid
