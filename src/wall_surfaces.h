// The surfaces of a wall as a script names them, and how dump image draws them.

#ifndef APF_WALL_SURFACES_H
#define APF_WALL_SURFACES_H

#include "wall/surface.h"

#include <array>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class LAMMPS;

// plane DIM LO HI | cylinder DIM C1 C2 R inside|outside; iarg is left behind the last word
std::vector<apf::Surface> parse_surfaces(LAMMPS *lmp, const char *command, int narg, char **arg,
                                         int &iarg);

// Lines in the plane, triangles in space, kept for Fix::image().
class WallImage {
 public:
  WallImage(const std::vector<apf::Surface> &surfaces, const Domain *domain);

  std::vector<int> objects;
  std::vector<double *> rows;

 private:
  using Point = std::array<double, 3>;
  std::vector<std::array<double, 10>> values;
  bool flat;

  void draw_plane(const apf::Surface &surface, const Domain *domain);
  void draw_cylinder(const apf::Surface &surface, const Domain *domain);
  void add(int object, const Point &a, const Point &b, const Point &c);
  void patch(const Point &a, const Point &b, const Point &c, const Point &d);
};

}    // namespace LAMMPS_NS

#endif
