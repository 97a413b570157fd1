#include "zone_area.h"

#include "wall/zone_share.h"

#include "domain.h"
#include "math_const.h"
#include "math_extra.h"

#include <array>
#include <cmath>

using namespace LAMMPS_NS;
using apf::SurfacePoint;
using MathConst::MY_2PI;

namespace {

// pieces that a surface is cut into, along each direction: in space, and on a line
constexpr int fine_in_space = 512, fine_on_line = 65536;

// whether x is in the box, or a little outside: walls may lie on its faces
bool in_box(const Domain *domain, const double *x, int dim)
{
  const double margin = 1.0e-9 * domain->prd[dim];
  return x[dim] >= domain->boxlo[dim] - margin && x[dim] <= domain->boxhi[dim] + margin;
}
bool in_box(const Domain *domain, const double *x)
{
  return in_box(domain, x, 0) && in_box(domain, x, 1) && in_box(domain, x, 2);
}

SurfacePoint in_space(const apf::WallPose &pose, const SurfacePoint &y)
{
  SurfacePoint x = y;
  if (pose.moves) pose.to_space(y.data(), x.data());
  return x;
}

// A plane or cylinder, by two coordinates in [0, 1].
struct Sheet {
  double area;
  std::function<SurfacePoint(double u, double v)> at;
  bool ends_in_box;    // it covers the box, and is nowhere outside of it
};

Sheet plane_in_box(const apf::Surface &surface, double coordinate, Domain *domain)
{
  const int n = surface.dim, d1 = surface.first(), d2 = surface.second();
  const double area = domain->prd[d1] * (domain->dimension == 2 ? 1.0 : domain->prd[d2]);
  const auto at = [=](double u, double v) {
    double lamda[3] = {}, x[3];
    lamda[d1] = u;
    lamda[d2] = v;
    domain->lamda2x(lamda, x);
    lamda[n] = (coordinate - x[n]) / domain->prd[n];
    domain->lamda2x(lamda, x);
    return SurfacePoint{x[0], x[1], x[2]};
  };
  return {area, at, true};
}

// as long as the box
Sheet cylinder_in_box(const apf::Surface &surface, const double *axis, Domain *domain)
{
  const int n = surface.dim, d1 = surface.first(), d2 = surface.second();
  const double c1 = axis[d1], c2 = axis[d2], radius = surface.radius;
  const double area = MY_2PI * radius * (domain->dimension == 2 ? 1.0 : domain->prd[n]);
  const auto at = [=](double u, double v) {
    SurfacePoint x;
    x[n] = domain->boxlo[n] + v * domain->prd[n];
    x[d1] = c1 + radius * std::cos(MY_2PI * u);
    x[d2] = c2 + radius * std::sin(MY_2PI * u);
    return x;
  };
  bool inside = true;
  for (const int c : {d1, d2})
    inside = inside && axis[c] - radius >= domain->boxlo[c] && axis[c] + radius <= domain->boxhi[c];
  return {area, at, inside};
}

// A wall that has turned its axis away from those of the box: a square or a length around the
// middle of the box that is wide enough for any direction.
Sheet turned(const apf::Surface &surface, const apf::WallPose &pose, Domain *domain)
{
  const int n = surface.dim, d1 = surface.first(), d2 = surface.second();
  double middle[3], y[3], size2 = 0.0;
  for (int c = 0; c < 3; c++) {
    middle[c] = 0.5 * (domain->boxlo[c] + domain->boxhi[c]);
    if (c < domain->dimension) size2 += domain->prd[c] * domain->prd[c];
  }
  const double size = std::sqrt(size2);
  pose.to_frame(middle, y);
  const SurfacePoint at_middle{y[0], y[1], y[2]};
  const bool plane = surface.shape == apf::Surface::Shape::plane;
  const auto at = [=](double u, double v) {
    SurfacePoint x = at_middle;
    if (plane) {
      x[n] = surface.origin[0];
      x[d1] += (u - 0.5) * size;
      x[d2] += (v - 0.5) * size;
    } else {
      x[n] += (v - 0.5) * size;
      x[d1] = surface.origin[0] + surface.radius * std::cos(MY_2PI * u);
      x[d2] = surface.origin[1] + surface.radius * std::sin(MY_2PI * u);
    }
    return in_space(pose, x);
  };
  const double along = domain->dimension == 2 ? 1.0 : size;
  return {(plane ? size : MY_2PI * surface.radius) * along, at, false};
}

Sheet sheet_of(const apf::Surface &surface, const apf::WallPose &pose, Domain *domain)
{
  SurfacePoint on{}, beside;    // the plane, or the cylinder's axis; and a step along the axis
  if (surface.shape == apf::Surface::Shape::plane) {
    on[surface.dim] = surface.origin[0];
  } else {
    on[surface.first()] = surface.origin[0];
    on[surface.second()] = surface.origin[1];
  }
  beside = on;
  beside[surface.dim] += 1.0;
  const auto x = in_space(pose, on), y = in_space(pose, beside);
  if (std::fabs(y[surface.dim] - x[surface.dim] - 1.0) > 1.0e-12)
    return turned(surface, pose, domain);
  return surface.shape == apf::Surface::Shape::plane ? plane_in_box(surface, x[surface.dim], domain)
                                                     : cylinder_in_box(surface, x.data(), domain);
}

struct Node {
  SurfacePoint x;
  int zone;
};

}    // namespace

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::add_zone_areas(const apf::Surface &surface, const apf::WallPose &pose,
                               Domain *domain, int whole,
                               const std::function<int(const double *)> &zone_at,
                               std::vector<double> &areas)
{
  const Sheet sheet = sheet_of(surface, pose, domain);
  if (whole >= 0 && sheet.ends_in_box) {
    areas[whole] += sheet.area;
    return;
  }
  auto zone_in_box = [&](const double *x) {
    return sheet.ends_in_box || in_box(domain, x) ? zone_at(x) : -1;
  };
  const bool flat = domain->dimension == 2;
  const int n = flat ? fine_on_line : fine_in_space;
  auto row = [&](double v) {
    std::vector<Node> nodes;
    for (int k = 0; k <= n; k++) {
      const auto x = sheet.at(static_cast<double>(k) / n, v);
      nodes.push_back({x, zone_in_box(x.data())});
    }
    return nodes;
  };
  const double piece = sheet.area / n / (flat ? 1 : 2 * n);
  auto add = [&](int zone, double share) {
    if (zone >= 0) areas[zone] += share * piece;
  };

  if (flat) {
    const auto line = row(0.5);
    for (int k = 0; k < n; k++)
      apf::share_line(line[k].x, line[k + 1].x, {line[k].zone, line[k + 1].zone}, zone_in_box, add);
    return;
  }
  auto triangle = [&](const Node &a, const Node &b, const Node &c) {
    apf::share_triangle({a.x, b.x, c.x}, {a.zone, b.zone, c.zone}, zone_in_box, add);
  };
  auto below = row(0.0);
  for (int m = 1; m <= n; m++) {
    auto above = row(static_cast<double>(m) / n);
    for (int k = 0; k < n; k++) {
      triangle(below[k], below[k + 1], above[k + 1]);
      triangle(below[k], above[k + 1], above[k]);
    }
    below.swap(above);
  }
}

/* ----------------------------------------------------------------------
   along an axis along which the grid is periodic nothing is outside
------------------------------------------------------------------------- */

void LAMMPS_NS::add_zone_areas(const WallGrid &grid, int piece, const apf::WallPose &pose,
                               Domain *domain, const std::function<int(const double *)> &zone_at,
                               std::vector<double> &areas)
{
  auto zone_in_box = [&](const double *x) {
    for (int c = 0; c < 3; c++)
      if (!grid.is_periodic(c) && !in_box(domain, x, c)) return -1;
    return zone_at(x);
  };
  for (const auto &facet : grid.facets(piece)) {
    std::array<SurfacePoint, 3> x;
    std::array<int, 3> zone;
    for (int corner = 0; corner < 3; corner++) {
      x[corner] = in_space(pose, facet[corner]);
      zone[corner] = zone_in_box(x[corner].data());
    }
    double a[3], b[3], normal[3];
    MathExtra::sub3(x[1].data(), x[0].data(), a);
    MathExtra::sub3(x[2].data(), x[0].data(), b);
    MathExtra::cross3(a, b, normal);
    const bool flat = domain->dimension == 2;
    const double area = flat ? MathExtra::len3(a) : 0.5 * MathExtra::len3(normal);
    const auto add = [&](int of, double share) {
      if (of >= 0) areas[of] += share * area;
    };
    if (flat)
      apf::share_line(x[0], x[1], {zone[0], zone[1]}, zone_in_box, add);
    else
      apf::share_triangle(x, zone, zone_in_box, add);
  }
}
