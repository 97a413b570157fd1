// The wall of a surface of triangles, taken for the smooth surface that they stand for.

#ifndef FLOWGRID_FACET_WALL_H
#define FLOWGRID_FACET_WALL_H

#include "patch_set.h"
#include "smooth_surface.h"

namespace flowgrid {

class FacetWall : public Wall {
 public:
  // surface: made whole. turning: of the surface beyond which it has an edge [radians].
  // reach: how far a piece goes on beyond a crease                            [length]
  FacetWall(Surface surface, const Grid &grid, double turning, double reach);

  double distance(const Point &x, double limit) const override
  {
    return whole->nearest(x, limit).distance;
  }
  double distance(int piece, const Point &x, double limit) const override;
  double bulge() const { return smooth.bulge; }

 private:
  Surface surface;
  SmoothSurface smooth;
  std::vector<int> piece;    // of each triangle
  std::unique_ptr<PatchSet> whole;
  std::vector<PatchSet> sets;    // of each piece

  struct Rim;
  void find_pieces();
  PatchSet patches(int which, const Grid &grid, double reach) const;
  std::vector<Rim> rims(int which) const;
  Point reach_at(const Point &x, const Point &direction, bool open, const Grid &grid,
                 double reach) const;
};

}    // namespace flowgrid

#endif
