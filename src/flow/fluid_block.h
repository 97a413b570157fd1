// The fluid at a block of particles: an array per component, so that the laws of flow/ run over a
// block as vector code, and its arrays stay in the nearest cache between one law and the next.

#ifndef APF_FLUID_BLOCK_H
#define APF_FLUID_BLOCK_H

#include "../contact/vector.h"

#include <algorithm>

namespace apf {

// What of the fluid the forces of a scene need; each level includes those before it.
enum class Detail { VELOCITY, VORTICITY, GRADIENT };

constexpr int block_width = 64;    // particles of a block

using Lanes = double[block_width];

struct PointBlock {
  int n = 0;    // points in use, <= block_width
  // their coordinates; lanes that are not in use hold any numbers             [length]
  alignas(64) Lanes x[3] = {};

  void set(int lane, const double *point)
  {
    for (int c = 0; c < 3; c++) x[c][lane] = point[c];
  }
};

// Undisturbed fluid at the points: what stands beyond the detail asked for is left as it was.
struct FluidBlock {
  alignas(64) Lanes velocity[3];    // u                                      [length/time]
  Lanes vorticity[3];               // om = curl u                                 [1/time]
  Lanes gradient[3][3];             // [a][b] = du_a/dx_b                          [1/time]
  Lanes rate[3];                    // du/dt at a fixed point               [length/time^2]
  Lanes distance;                   // to the walls, > 0 in the fluid; of grids that know it
};

// du_a/dx_b of one point
struct Gradient {
  double d[3][3] = {};

  Vec3 curl() const { return {d[2][1] - d[1][2], d[0][2] - d[2][0], d[1][0] - d[0][1]}; }
};

// Velocity alone, into arrays of one's own.
template <class Kind>
void sample_velocity(const Kind &kind, const PointBlock &points, Lanes (&out)[3])
{
  for (int l = 0; l < points.n; l++) {
    const double x[3] = {points.x[0][l], points.x[1][l], points.x[2][l]};
    const Vec3 u = kind.velocity(x);
    out[0][l] = u.x;
    out[1][l] = u.y;
    out[2][l] = u.z;
  }
}

// Fills a block from a kind of flow that has velocity(x) and gradient(x), x the three coordinates.
template <class Kind>
void sample_pointwise(const Kind &kind, const PointBlock &points, Detail detail, FluidBlock &out)
{
  sample_velocity(kind, points, out.velocity);
  if (detail == Detail::VELOCITY) return;
  for (int l = 0; l < points.n; l++) {
    const double x[3] = {points.x[0][l], points.x[1][l], points.x[2][l]};
    const Gradient gradient = kind.gradient(x);
    const Vec3 om = gradient.curl();
    out.vorticity[0][l] = om.x;
    out.vorticity[1][l] = om.y;
    out.vorticity[2][l] = om.z;
    if (detail == Detail::VORTICITY) continue;
    for (int a = 0; a < 3; a++)
      for (int b = 0; b < 3; b++) out.gradient[a][b][l] = gradient.d[a][b];
    for (auto &component : out.rate) component[l] = 0.0;
  }
}

}    // namespace apf

#endif
