// The flux of a fluid through a rectangle of a plane, and points of it drawn in proportion.
//
//   flux = integral of max(u_n, 0) dA,    density of points = max(u_n, 0) / flux
//
// u_n is the velocity along the direction of entry. The rectangle is divided in cells; Simpson's
// rule over their corners, edges and centres gives the flux of each, exact for a velocity that is
// cubic in a cell. A point is drawn from a cell in proportion to its flux, then within it by
// rejection, with the velocity at the point itself.

#ifndef APF_INLET_FLUX_H
#define APF_INLET_FLUX_H

#include "fluid_block.h"

#include <algorithm>
#include <vector>

namespace apf {

struct InletPlane {
  int dim;                // axis of its normal
  double sign;            // +1 if particles enter along the axis, -1 against it
  double position;        // along the axis                                          [length]
  int across[2];          // the other two axes
  double lo[2], hi[2];    // bounds along these; equal for z in the plane (x, y)     [length]

  bool operator==(const InletPlane &other) const
  {
    return std::equal(lo, lo + 2, other.lo) && std::equal(hi, hi + 2, other.hi) &&
        dim == other.dim && sign == other.sign && position == other.position;
  }
  bool flat(int k) const { return lo[k] == hi[k]; }
  double width(int k) const { return flat(k) ? 1.0 : hi[k] - lo[k]; }
  void point(double a, double b, double *x) const
  {
    x[dim] = position;
    x[across[0]] = a;
    x[across[1]] = b;
  }
};

class InletFlux {
 public:
  // sample(points, fluid) fills in the fluid's velocity
  template <class Sample> void measure(const InletPlane &on, Sample &&sample)
  {
    plane = on;
    for (int k = 0; k < 2; k++) cells[k] = plane.flat(k) ? 1 : (plane.flat(1 - k) ? 256 : 48);
    const int rows = 2 * cells[0] + 1, columns = 2 * cells[1] + 1;
    std::vector<double> inflow(rows * columns);
    fastest = 0.0;
    PointBlock points;
    FluidBlock fluid;
    for (int first = 0; first < rows * columns; first += block_width) {
      points.n = std::min(block_width, rows * columns - first);
      for (int l = 0; l < points.n; l++) {
        const int row = (first + l) / columns, column = (first + l) % columns;
        double x[3];
        plane.point(node(0, row), node(1, column), x);
        points.set(l, x);
      }
      sample(points, fluid);
      for (int l = 0; l < points.n; l++) {
        const Vec3 u{fluid.velocity[0][l], fluid.velocity[1][l], fluid.velocity[2][l]};
        inflow[first + l] = std::max(plane.sign * fluid.velocity[plane.dim][l], 0.0);
        if (inflow[first + l] > 0.0) fastest = std::max(fastest, std::sqrt(dot(u, u)));
      }
    }
    add_up(inflow, columns);
  }

  // [length^3/time], in 2-D [length^2/time]; 0 before it was measured
  double flux() const { return upto.empty() ? 0.0 : upto.back(); }
  // of the fluid that enters, with an allowance for maxima between nodes
  double speed() const { return margin * fastest; }    // [length/time]
  const InletPlane &rectangle() const { return plane; }

  // Draws a point x; velocity(x) gives the fluid's there, which is returned in u. False if none was
  // found, where the velocity differs from what was measured.
  template <class Uniform, class Velocity>
  bool draw(Uniform &&uniform, Velocity &&velocity, double *x, Vec3 &u) const
  {
    const auto found = std::upper_bound(upto.begin(), upto.end(), uniform() * flux());
    const int cell = static_cast<int>(std::min(found, upto.end() - 1) - upto.begin());
    const int i = cell / cells[1], j = cell % cells[1];
    for (int n = 0; n < 10000; n++) {
      const double a = node(0, 2 * (i + uniform()));
      const double b = plane.flat(1) ? plane.lo[1] : node(1, 2 * (j + uniform()));
      plane.point(a, b, x);
      u = velocity(x);
      const double inflow = plane.sign * (plane.dim == 0 ? u.x : plane.dim == 1 ? u.y : u.z);
      if (margin * highest[cell] * uniform() < inflow) return true;
    }
    return false;
  }

 private:
  static constexpr double margin = 1.1;
  InletPlane plane{};
  int cells[2] = {0, 0};
  std::vector<double> upto, highest;    // per cell: sum of fluxes, highest inflow
  double fastest = 0.0;

  // coordinate along across[k] of a position counted in half cells
  double node(int k, double n) const
  {
    return plane.lo[k] + (plane.hi[k] - plane.lo[k]) * n / (2 * cells[k]);
  }

  void add_up(const std::vector<double> &inflow, int columns)
  {
    static constexpr double weight[3] = {1.0 / 6.0, 4.0 / 6.0, 1.0 / 6.0};
    const double area = plane.width(0) / cells[0] * plane.width(1) / cells[1];
    upto.assign(cells[0] * cells[1], 0.0);
    highest = upto;
    double sum = 0.0;
    for (int cell = 0; cell < cells[0] * cells[1]; cell++) {
      const int corner = 2 * (cell / cells[1]) * columns + 2 * (cell % cells[1]);
      for (int a = 0; a < 3; a++)
        for (int b = 0; b < 3; b++) {
          const double u = inflow[corner + a * columns + b];
          sum += weight[a] * weight[b] * area * u;
          highest[cell] = std::max(highest[cell], u);
        }
      upto[cell] = sum;
    }
  }
};

}    // namespace apf

#endif
