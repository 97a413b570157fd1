// The surfaces of a wall as a script names them, and how dump image draws them.

#ifndef APF_WALL_SURFACES_H
#define APF_WALL_SURFACES_H

#include "wall_grid.h"

#include "wall/surface.h"
#include "wall/wall_pose.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {
class Domain;
class LAMMPS;

constexpr int largest_number_of_surfaces = 32;    // bits of a word

// plane DIM LO HI | cylinder DIM C1 C2 R inside|outside | file F.vtkhdf [array NAME ...]; iarg is
// left behind the last word. grid: what the file holds, else nothing.
std::vector<apf::Surface> parse_surfaces(LAMMPS *lmp, const char *command, int narg, char **arg,
                                         int &iarg, std::unique_ptr<WallGrid> &grid);

// what they are called: lo, hi, cylinder; of a file by its array, without distance_
std::vector<std::string> surface_names(const std::vector<apf::Surface> &surfaces,
                                       const WallGrid *grid);

// Lines in the plane, triangles in space, kept for Fix::image().
class WallImage {
 public:
  // grid: where the surfaces come from, if they do from a file
  WallImage(const std::vector<apf::Surface> &surfaces, const WallGrid *grid, const Domain *domain);
  void move(const apf::WallPose &pose);    // all points, from the wall's frame to space

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
