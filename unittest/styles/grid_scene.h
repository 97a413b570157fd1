// Scenes of walls from a file: distances in closed form on a grid, and spheres.

#ifndef APF_TEST_GRID_SCENE_H
#define APF_TEST_GRID_SCENE_H

#include "scenes.h"
#include "temporary_file.h"

#include <functional>
#include <map>

inline const Material material;
inline const double mass = pi / 6.0;    // of a sphere of diameter and density 1
inline const std::string none = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
using Shape = std::function<double(const double *)>;

// Scenes in the plane (box 8 x 8) or in space (8 x 8 x 8), the grid covering the box.
struct GridScene {
  TemporaryFile file{"apf_wall"};
  Simulation sim;

  GridScene(int dims, double spacing, const std::map<std::string, Shape> &arrays,
            const std::vector<Sphere> &spheres, const std::string &law,
            const std::string &boundary = "f f f")
  {
    const int n = static_cast<int>(std::lround(8.0 / spacing)) + 1;
    const double z = dims == 2 ? -spacing / 2 : 0.0;
    file.write({n, n, dims == 2 ? 2 : n}, {0, 0, z}, {spacing, spacing, spacing},
               [&](VtkhdfWriter &w) {
                 for (const auto &[name, shape] : arrays) {
                   const auto &f = shape;
                   w.field(name, 1, [&f](const double *x, double, double *phi) {
                     *phi = f(x);
                   });
                 }
               });
    Scene scene;
    scene.boundary = dims == 2 ? boundary.substr(0, 3) + " p" : boundary;
    if (dims == 2) {
      scene.before = "dimension 2";
      scene.box = "0 8 0 8 -0.5 0.5";
    }
    scene.style = none + "fix wall all wall/levelset file " + file.path + law + "\n";
    build(sim, spheres, scene);
    if (dims == 2) sim.run("fix flat all enforce2d");
  }
};

inline Shape plane(double nx, double ny, double nz, double offset)
{
  const double size = std::sqrt(nx * nx + ny * ny + nz * nz);
  return [=](const double *x) {
    return (nx * x[0] + ny * x[1] + nz * x[2]) / size - offset;
  };
}

inline double circle(const double *x)    // fluid outside a cylinder of radius 2 in the middle
{
  return std::hypot(x[0] - 4.0, x[1] - 4.0) - 2.0;
}

// fluid outside of the quadrant x < 4, y < 4: a convex edge
inline double outside_quadrant(const double *x)
{
  const double dx = x[0] - 4.0, dy = x[1] - 4.0;
  if (dx > 0.0 && dy > 0.0) return std::hypot(dx, dy);
  return std::max(dx, dy);
}

inline std::string at(double x, double y)
{
  return "set atom 1 x " + digits(x) + " y " + digits(y) + "\n";
}

#endif
