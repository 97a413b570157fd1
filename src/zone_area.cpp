#include "zone_area.h"

#include "wall/zone_share.h"

#include "domain.h"
#include "math_const.h"
#include "math_extra.h"

#include <cmath>

using namespace LAMMPS_NS;
using apf::SurfacePoint;
using MathConst::MY_2PI;

namespace {

// pieces that a surface is cut into, along each direction: in space, and on a line
constexpr int fine_in_space = 512, fine_on_line = 65536;

// A plane over the box, or a cylinder as long as the box: points by two coordinates in [0, 1].
class Sheet {
 public:
  Sheet(const apf::Surface &surface, Domain *domain) : surface(surface), domain(domain)
  {
    const bool flat = domain->dimension == 2;
    const bool plane = surface.shape == apf::Surface::Shape::plane;
    area = plane ? domain->prd[surface.first()] : MY_2PI * surface.radius;
    if (!flat) area *= domain->prd[plane ? surface.second() : surface.dim];
  }
  double area;    // of the whole sheet

  SurfacePoint at(double u, double v) const
  {
    return surface.shape == apf::Surface::Shape::plane ? on_plane(u, v) : on_cylinder(u, v);
  }

  // the box, a little more: a cylinder may touch its faces
  bool in_box(const double *x) const
  {
    if (surface.shape == apf::Surface::Shape::plane) return true;
    for (const int c : {surface.first(), surface.second()}) {
      const double margin = 1.0e-9 * domain->prd[c];
      if (x[c] < domain->boxlo[c] - margin || x[c] > domain->boxhi[c] + margin) return false;
    }
    return true;
  }

 private:
  const apf::Surface &surface;
  Domain *domain;

  SurfacePoint on_plane(double u, double v) const
  {
    double lamda[3] = {}, x[3];
    lamda[surface.first()] = u;
    lamda[surface.second()] = v;
    domain->lamda2x(lamda, x);
    lamda[surface.dim] = (surface.origin[0] - x[surface.dim]) / domain->prd[surface.dim];
    domain->lamda2x(lamda, x);
    return {x[0], x[1], x[2]};
  }
  SurfacePoint on_cylinder(double u, double v) const
  {
    SurfacePoint x;
    x[surface.dim] = domain->boxlo[surface.dim] + v * domain->prd[surface.dim];
    x[surface.first()] = surface.origin[0] + surface.radius * std::cos(MY_2PI * u);
    x[surface.second()] = surface.origin[1] + surface.radius * std::sin(MY_2PI * u);
    return x;
  }
};

struct Node {
  SurfacePoint x;
  int zone;
};

}    // namespace

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::add_zone_areas(const apf::Surface &surface, Domain *domain, int whole,
                               const std::function<int(const double *)> &zone_at,
                               std::vector<double> &areas)
{
  const Sheet sheet(surface, domain);
  if (whole >= 0 && surface.shape == apf::Surface::Shape::plane) {
    areas[whole] += sheet.area;
    return;
  }
  auto zone_in_box = [&](const double *x) {
    return sheet.in_box(x) ? zone_at(x) : -1;
  };
  const bool flat = domain->dimension == 2;
  const int n = flat ? fine_on_line : fine_in_space;
  auto node = [&](int k, double v) {
    const auto x = sheet.at(static_cast<double>(k) / n, v);
    return Node{x, zone_in_box(x.data())};
  };
  auto row = [&](double v) {
    std::vector<Node> nodes;
    for (int k = 0; k <= n; k++) nodes.push_back(node(k, v));
    return nodes;
  };
  auto add = [&](int zone, double area) {
    if (zone >= 0) areas[zone] += area;
  };

  if (flat) {
    const auto line = row(0.5);
    for (int k = 0; k < n; k++)
      apf::share_line(line[k].x, line[k + 1].x, {line[k].zone, line[k + 1].zone}, zone_in_box,
                      [&](int zone, double share) {
                        add(zone, share * sheet.area / n);
                      });
    return;
  }
  const double half_cell = 0.5 * sheet.area / n / n;
  auto triangle = [&](const Node &a, const Node &b, const Node &c) {
    apf::share_triangle({a.x, b.x, c.x}, {a.zone, b.zone, c.zone}, zone_in_box,
                        [&](int zone, double share) {
                          add(zone, share * half_cell);
                        });
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

/* ---------------------------------------------------------------------- */

void LAMMPS_NS::add_zone_areas(const std::vector<WallGrid::Facet> &facets, Domain *domain,
                               const std::function<int(const double *)> &zone_at,
                               std::vector<double> &areas)
{
  for (const auto &facet : facets) {
    double middle[3], a[3], b[3], normal[3];
    bool in_box = true;
    for (int c = 0; c < 3; c++) {
      middle[c] = (facet[0][c] + facet[1][c] + facet[2][c]) / 3.0;
      in_box = in_box && middle[c] >= domain->boxlo[c] && middle[c] <= domain->boxhi[c];
      a[c] = facet[1][c] - facet[0][c];
      b[c] = facet[2][c] - facet[0][c];
    }
    const int zone = in_box ? zone_at(middle) : -1;
    if (zone < 0) continue;
    MathExtra::cross3(a, b, normal);
    areas[zone] += domain->dimension == 2 ? MathExtra::len3(a) : 0.5 * MathExtra::len3(normal);
  }
}
