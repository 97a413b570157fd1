// A triangle that bulges: a cubic Bezier triangle through three corners whose edges leave them in
// given directions, as in curved PN triangles, and the nearest point of it. An edge's inner control
// points stand 2 chord / 3 (1 + cos) from its ends, cos of the angle between edge and chord: an arc
// of a circle is met to sixth order.
// A. Vlachos, J. Peters, C. Boyd, J. Mitchell, Proc. I3D 2001, 159, doi:10.1145/364338.364387

#ifndef FLOWGRID_PATCH_H
#define FLOWGRID_PATCH_H

#include "wall.h"

namespace flowgrid {

class Patch {
 public:
  struct Foot {
    Point at{}, normal{};    // normal: not of unit length
    double distance = INFINITY;
    double u = 0.0, v = 0.0;    // weights of corners 1 and 2
  };

  // handles: control points of the edge from corner k to k + 1, the one beside k first
  Patch(const Point *corners, const Point (*handles)[2])
  {
    b[0][0] = corners[0], b[3][0] = corners[1], b[0][3] = corners[2];
    b[1][0] = handles[0][0], b[2][0] = handles[0][1];
    b[2][1] = handles[1][0], b[1][2] = handles[1][1];
    b[0][2] = handles[2][0], b[0][1] = handles[2][1];
    const Point middle = (1.0 / 3.0) * (corners[0] + corners[1] + corners[2]);
    Point edges{};
    for (int k = 0; k < 3; k++)
      for (int n = 0; n < 2; n++) {
        edges = edges + (1.0 / 6.0) * handles[k][n];
        const Point chord = corners[(k + 1) % 3] - corners[k];
        off = std::max(off, length(handles[k][n] - corners[k] - ((1.0 + n) / 3.0) * chord));
      }
    b[1][1] = edges + 0.5 * (edges - middle);
    off = std::max(off, length(b[1][1] - middle));
    flat = off < 1e-12 * (length(corners[1] - corners[0]) + length(corners[2] - corners[0]));
    for (int j = 0; j < 4; j++)
      for (int k = 0; j + k < 4; k++) bounds.add(b[j][k]);
  }

  // The control point of an edge beside its end a, which it leaves in a direction of unit length.
  static Point handle(const Point &a, const Point &b, const Point &direction)
  {
    const double chord = length(b - a), cosine = dot(b - a, direction) / chord;
    return a + (2.0 * chord / (3.0 * (1.0 + cosine))) * direction;
  }

  const Box &box() const { return bounds; }

  // limit: feet farther away are not looked for; the distance is infinite then
  Foot nearest(const Point &x, double limit) const
  {
    Foot best = flat_foot(x);
    if (length(flat_point(best) - x) - off > limit) return {};
    evaluate(x, best);
    if (flat) return best;
    Foot inner = best;
    if (newton(x, inner)) return inner;
    for (int edge = 0; edge < 3; edge++) {
      const Foot on_edge = newton_on_edge(x, edge, best);
      if (on_edge.distance < best.distance) best = on_edge;
    }
    return best;
  }

  // slopes along u and v, and where they hold
  struct Local {
    Point at, du, dv, uu, uv, vv;
  };
  Local local(double u, double v) const
  {
    // de Casteljau's steps from cubic to quadratic and linear
    const double w = 1.0 - u - v;
    Point q[3][3], l[2][2];
    for (int j = 0; j < 3; j++)
      for (int k = 0; j + k < 3; k++) q[j][k] = w * b[j][k] + u * b[j + 1][k] + v * b[j][k + 1];
    for (int j = 0; j < 2; j++)
      for (int k = 0; j + k < 2; k++) l[j][k] = w * q[j][k] + u * q[j + 1][k] + v * q[j][k + 1];
    return {w * l[0][0] + u * l[1][0] + v * l[0][1],
            3.0 * (l[1][0] - l[0][0]),
            3.0 * (l[0][1] - l[0][0]),
            6.0 * (q[2][0] - 2.0 * q[1][0] + q[0][0]),
            6.0 * (q[1][1] - q[1][0] - q[0][1] + q[0][0]),
            6.0 * (q[0][2] - 2.0 * q[0][1] + q[0][0])};
  }

 private:
  Point b[4][4];    // control point j, k: weight u^j v^k (1 - u - v)^(3 - j - k)
  Box bounds;
  double off = 0.0;    // largest distance between control points and the triangle's own; a bound
  bool flat;           // of that between points

  Point flat_point(const Foot &foot) const
  {
    return (1.0 - foot.u - foot.v) * b[0][0] + foot.u * b[3][0] + foot.v * b[0][3];
  }

  void evaluate(const Point &x, Foot &foot) const
  {
    const Local here = local(foot.u, foot.v);
    foot.at = here.at;
    foot.normal = cross(here.du, here.dv);
    foot.distance = length(x - here.at);
  }

  // The nearest point of the triangle between the corners.
  Foot flat_foot(const Point &x) const
  {
    const Point &a = b[0][0], e = b[3][0] - a, f = b[0][3] - a, r = x - a;
    const double ee = dot(e, e), ef = dot(e, f), ff = dot(f, f), re = dot(r, e), rf = dot(r, f);
    const double det = ee * ff - ef * ef;
    Foot foot;
    foot.u = (ff * re - ef * rf) / det;
    foot.v = (ee * rf - ef * re) / det;
    if (foot.u >= 0.0 && foot.v >= 0.0 && foot.u + foot.v <= 1.0) return foot;
    const auto part = [](double along, double size2) {
      return std::min(std::max(along / size2, 0.0), 1.0);
    };
    const double s = part(re, ee), t = part(rf, ff);
    const double side = part(rf - re + ee - ef, ee - 2.0 * ef + ff);    // from corner 1 to 2
    const double ends[3][2] = {{s, 0.0}, {0.0, t}, {1.0 - side, side}};
    double least = INFINITY;
    for (const auto &end : ends) {
      const double d = length(r - end[0] * e - end[1] * f);
      if (d >= least) continue;
      least = d;
      foot.u = end[0];
      foot.v = end[1];
    }
    return foot;
  }

  // Newton's method for the least distance; false if it leaves the triangle.
  bool newton(const Point &x, Foot &foot) const
  {
    constexpr double slack = 1e-12;
    for (int iteration = 0; iteration < 12; iteration++) {
      const Local s = local(foot.u, foot.v);
      const Point r = s.at - x;
      const double fu = dot(r, s.du), fv = dot(r, s.dv);
      double huu = dot(s.du, s.du) + dot(r, s.uu), huv = dot(s.du, s.dv) + dot(r, s.uv),
             hvv = dot(s.dv, s.dv) + dot(r, s.vv);
      if (huu * hvv - huv * huv <= 0.0 || huu <= 0.0)    // beyond a focus
        huu = dot(s.du, s.du), huv = dot(s.du, s.dv), hvv = dot(s.dv, s.dv);
      const double det = huu * hvv - huv * huv;
      const double du = (huv * fv - hvv * fu) / det, dv = (huv * fu - huu * fv) / det;
      foot.u += du;
      foot.v += dv;
      if (!(std::fabs(foot.u) + std::fabs(foot.v) < 4.0)) return false;
      if (std::fabs(du) + std::fabs(dv) > 1e-14) continue;
      break;
    }
    if (foot.u < -slack || foot.v < -slack || foot.u + foot.v > 1.0 + slack) return false;
    evaluate(x, foot);
    return true;
  }

  Foot newton_on_edge(const Point &x, int edge, const Foot &start) const
  {
    static constexpr double begin[3][2] = {{0, 0}, {1, 0}, {0, 1}};
    static constexpr double along[3][2] = {{1, 0}, {-1, 1}, {0, -1}};
    const double au = along[edge][0], av = along[edge][1];
    double t = edge == 0 ? start.u : edge == 1 ? start.v : 1.0 - start.v;
    Foot foot;
    for (int iteration = 0; iteration < 12; iteration++) {
      const Local s = local(begin[edge][0] + t * au, begin[edge][1] + t * av);
      const Point r = s.at - x, d = au * s.du + av * s.dv;
      const Point dd = au * au * s.uu + 2.0 * au * av * s.uv + av * av * s.vv;
      double h = dot(d, d) + dot(r, dd);
      if (h <= 0.0) h = dot(d, d);
      const double last = t;
      t = std::min(std::max(t - dot(r, d) / h, 0.0), 1.0);
      if (std::fabs(t - last) < 1e-14) break;
    }
    foot.u = begin[edge][0] + t * au;
    foot.v = begin[edge][1] + t * av;
    evaluate(x, foot);
    return foot;
  }
};

}    // namespace flowgrid

#endif
