// What smooth surface facets stand for: normals at corners, the mean of those of the facets around
// that meet without an edge, and the courses of edges. Where facets lie in a plane it is the plane.
// Weights of normals that are exact for spheres: N. Max, J. Graphics Tools 4(2), 1 (1999),
// doi:10.1080/10867651.1999.10487501

#ifndef FLOWGRID_SMOOTH_SURFACE_H
#define FLOWGRID_SMOOTH_SURFACE_H

#include "surface.h"

namespace flowgrid {

enum class Edge : char { open, smooth, convex, concave };

struct SmoothSurface {
  // turning: facets that meet at a larger angle do so in an edge                     [radians]
  SmoothSurface(const Surface &surface, double turning);

  // of each triangle; edge k runs from corner k to k + 1
  struct Facet {
    std::array<int, 3> neighbor;
    Edge edge[3];
    Point normal[3];       // at corners, of unit length
    Point handle[3][2];    // control points of edges, the one beside corner k first
  };
  std::vector<Facet> facets;
  double bulge =
      0.0;    // largest distance between a facet's edge and the smooth surface    [length]
  double error =
      0.0;    // estimate of that between the smooth and the true surface          [length]

 private:
  void find_edges(const Surface &surface, double turning);
  void find_normals(const Surface &surface);
  void find_handles(const Surface &surface);
};

// The lines in which a plane of equal z cuts a surface, through points of its smooth edges, drawn
// out along z to both sides. Throws std::runtime_error if there are none.
Surface cut_at(const Surface &surface, const SmoothSurface &smooth, double z, double half_width);

// direction of a vector in the plane across a normal
inline Point along_surface(const Point &vector, const Point &normal)
{
  return unit(vector - dot(vector, normal) * normal);
}

}    // namespace flowgrid

#endif
