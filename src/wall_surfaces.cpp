#include "wall_surfaces.h"

#include "argument_reader.h"
#include "domain.h"
#include "error.h"
#include "given_once.h"
#include "lammps_version.h"
#include "math_const.h"

#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

std::vector<apf::Surface> LAMMPS_NS::parse_surfaces(LAMMPS *lmp, const char *command, int narg,
                                                    char **arg, int &iarg,
                                                    std::unique_ptr<WallGrid> &grid)
{
  std::vector<apf::Surface> surfaces;
  auto dimension = [&](const char *shape) {
    const std::string word = arg[iarg];
    if (word != "x" && word != "y" && word != "z")
      lmp->error->all(FLERR, iarg, "{} {} dimension must be x, y or z, got {}", command, shape,
                      word);
    iarg++;
    return word[0] - 'x';
  };
  const ArgumentReader reader(lmp, command, arg);

  if (narg < 4) utils::missing_cmd_args(FLERR, "fix wall/levelset", lmp->error);
  const std::string shape = arg[iarg++];
  if (shape == "plane") {
    if (narg < iarg + 3) utils::missing_cmd_args(FLERR, "fix wall/levelset plane", lmp->error);
    const int dim = dimension("plane");
    if (lmp->domain->dimension == 2 && dim == 2)
      lmp->error->all(FLERR, iarg - 1, "{} plane dimension must be x or y in 2 dimensions, got {}",
                      command, arg[iarg - 1]);
    if (lmp->domain->periodicity[dim])
      lmp->error->all(FLERR, iarg - 1, "{} plane needs a box that is not periodic in {}", command,
                      arg[iarg - 1]);
    const int first = iarg;
    for (const double side : {1.0, -1.0}) {
      if (strcmp(arg[iarg], "NULL") == 0)
        iarg++;
      else
        surfaces.push_back(apf::Surface::plane(dim, reader.number(iarg++, "plane"), side));
    }
    if (surfaces.empty())
      lmp->error->all(FLERR, first, "{} plane needs LO or HI, both are NULL", command);
    if (surfaces.size() == 2 && surfaces[0].origin[0] >= surfaces[1].origin[0])
      lmp->error->all(FLERR, first, "{} plane LO must be < HI, got {} and {}", command, arg[first],
                      arg[first + 1]);
  } else if (shape == "cylinder") {
    if (narg < iarg + 5) utils::missing_cmd_args(FLERR, "fix wall/levelset cylinder", lmp->error);
    const int dim = dimension("cylinder");
    if (lmp->domain->dimension == 2 && dim != 2)
      lmp->error->all(FLERR, iarg - 1, "{} cylinder axis must be z in 2 dimensions, got {}",
                      command, arg[iarg - 1]);
    const double c1 = reader.number(iarg, "cylinder axis");
    const double c2 = reader.number(iarg + 1, "cylinder axis");
    const double radius = reader.number(iarg + 2, "cylinder radius", Range::above(0.0));
    const int outside =
        reader.choice(iarg + 3, "cylinder side of the fluid", {"inside", "outside"});
    iarg += 4;
    surfaces.push_back(apf::Surface::cylinder(dim, c1, c2, radius, outside ? 1.0 : -1.0));
  } else if (shape == "file") {
    if (narg < iarg + 1) utils::missing_cmd_args(FLERR, "fix wall/levelset file", lmp->error);
    const int word = iarg++;
    std::vector<std::string> arrays;
    GivenOnce given(lmp, command);
    while (iarg < narg && strcmp(arg[iarg], "array") == 0) {
      if (narg < iarg + 2) utils::missing_cmd_args(FLERR, "fix wall/levelset array", lmp->error);
      arrays.push_back(arg[iarg + 1]);
      given.add("array " + arrays.back(), iarg);
      iarg += 2;
    }
    grid = std::make_unique<WallGrid>(lmp, command, arg[word], arrays, largest_number_of_surfaces,
                                      word);
    surfaces = grid->surfaces();
  } else {
    lmp->error->all(FLERR, iarg - 1, "{} shape must be plane, cylinder or file, got {}", command,
                    shape);
  }
  return surfaces;
}

std::vector<std::string> LAMMPS_NS::surface_names(const std::vector<apf::Surface> &surfaces,
                                                  const WallGrid *grid)
{
  if (grid) return grid->names();
  std::vector<std::string> names;
  for (const auto &surface : surfaces)
    if (surface.shape == apf::Surface::Shape::cylinder)
      names.push_back("cylinder");
    else
      names.push_back(surface.side > 0.0 ? "lo" : "hi");
  return names;
}

/* ---------------------------------------------------------------------- */

WallImage::WallImage(const std::vector<apf::Surface> &surfaces, const WallGrid *grid,
                     const Domain *domain) :
    flat(domain->dimension == 2)
{
  for (const auto &surface : surfaces)
    if (surface.shape == apf::Surface::Shape::plane)
      draw_plane(surface, domain);
    else if (surface.shape == apf::Surface::Shape::cylinder)
      draw_cylinder(surface, domain);
  for (int s = 0; grid && s < static_cast<int>(surfaces.size()); s++)
    for (const auto &facet : grid->facets(s))
      add(flat ? Graphics::LINE : Graphics::TRI, facet[0], facet[1], facet[2]);
  for (auto &row : values) rows.push_back(row.data());
}

void WallImage::move(const apf::WallPose &pose)
{
  for (auto &row : values)
    for (int corner = 0; corner < 3; corner++) {
      const double y[3] = {row[1 + 3 * corner], row[2 + 3 * corner], row[3 + 3 * corner]};
      pose.to_space(y, &row[1 + 3 * corner]);
    }
}

void WallImage::draw_plane(const apf::Surface &surface, const Domain *domain)
{
  const int n = surface.dim, d1 = surface.first(), d2 = surface.second();
  auto corner = [&](bool far1, bool far2) {
    Point p;
    p[n] = surface.origin[0];
    p[d1] = far1 ? domain->boxhi[d1] : domain->boxlo[d1];
    p[d2] = flat ? 0.0 : (far2 ? domain->boxhi[d2] : domain->boxlo[d2]);
    return p;
  };
  patch(corner(false, false), corner(true, false), corner(true, true), corner(false, true));
}

void WallImage::draw_cylinder(const apf::Surface &surface, const Domain *domain)
{
  constexpr int facets = 48;
  auto rim = [&](int k, bool far) {
    const double angle = MathConst::MY_2PI * k / facets;
    Point p;
    p[surface.dim] = flat ? 0.0 : (far ? domain->boxhi[surface.dim] : domain->boxlo[surface.dim]);
    p[surface.first()] = surface.origin[0] + surface.radius * cos(angle);
    p[surface.second()] = surface.origin[1] + surface.radius * sin(angle);
    return p;
  };
  for (int k = 0; k < facets; k++)
    patch(rim(k, false), rim(k + 1, false), rim(k + 1, true), rim(k, true));
}

void WallImage::add(int object, const Point &a, const Point &b, const Point &c)
{
  objects.push_back(object);
  values.push_back({1.0, a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]});
}

// a quadrilateral; in the plane its edge from a to b
void WallImage::patch(const Point &a, const Point &b, const Point &c, const Point &d)
{
  if (flat) {
    add(Graphics::LINE, a, b, b);
  } else {
    add(Graphics::TRI, a, b, c);
    add(Graphics::TRI, a, c, d);
  }
}
