// How much of a small piece of surface belongs to which zone, when zones can only be asked about
// points: `zone_at(x)` is the number of the zone of a point, < 0 where there is none. Where the
// corners differ, the border is found by bisection on the edges and is taken for straight in
// between. So borders that are straight come out exactly, others to second order in the size of the
// piece; what lies between the corners without reaching one is not seen.

#ifndef APF_ZONE_SHARE_H
#define APF_ZONE_SHARE_H

#include <array>

namespace apf {

using SurfacePoint = std::array<double, 3>;

// part of the way from a, of the given zone, to b that is still in this zone [-]
template <class ZoneAt>
double zone_reach(const SurfacePoint &a, const SurfacePoint &b, int zone, const ZoneAt &zone_at)
{
  double low = 0.0, high = 1.0;
  for (int n = 0; n < 50; n++) {
    const double t = 0.5 * (low + high);
    const double x[3] = {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]),
                         a[2] + t * (b[2] - a[2])};
    (zone_at(x) == zone ? low : high) = t;
  }
  return 0.5 * (low + high);
}

// A line from a to b; calls add(zone, share) with shares whose sum is 1.
template <class ZoneAt, class Add>
void share_line(const SurfacePoint &a, const SurfacePoint &b, const std::array<int, 2> &zone,
                const ZoneAt &zone_at, const Add &add)
{
  const double of_a = zone[0] == zone[1] ? 1.0 : zone_reach(a, b, zone[0], zone_at);
  add(zone[0], of_a);
  add(zone[1], 1.0 - of_a);
}

// A triangle with corners p, likewise.
template <class ZoneAt, class Add>
void share_triangle(const std::array<SurfacePoint, 3> &p, const std::array<int, 3> &zone,
                    const ZoneAt &zone_at, const Add &add)
{
  if (zone[0] == zone[1] && zone[1] == zone[2]) return add(zone[0], 1.0);
  auto cut_off = [&](int k) {    // the corner up to the border
    return zone_reach(p[k], p[(k + 1) % 3], zone[k], zone_at) *
        zone_reach(p[k], p[(k + 2) % 3], zone[k], zone_at);
  };
  for (int k = 0; k < 3; k++) {
    if (zone[(k + 1) % 3] != zone[(k + 2) % 3]) continue;
    const double alone = cut_off(k);
    add(zone[k], alone);
    add(zone[(k + 1) % 3], 1.0 - alone);
    return;
  }
  // three zones: the middle, which no edge shows, goes to them in proportion
  const double of[3] = {cut_off(0), cut_off(1), cut_off(2)};
  for (int k = 0; k < 3; k++) add(zone[k], of[k] / (of[0] + of[1] + of[2]));
}

}    // namespace apf

#endif
