// The wall of solids given by formulas. Its nearest point is the foot on a carrier, or lies where
// two or three of them meet; of all such points those count which are on the border of the solid.

#ifndef FLOWGRID_SHAPE_WALL_H
#define FLOWGRID_SHAPE_WALL_H

#include "periods.h"
#include "shape_tree.h"
#include "wall.h"

#include <map>

namespace flowgrid {

class ShapeWall : public Wall {
 public:
  // periods: with copies of the solids; grid: wide enough for them
  // turning: of the surface toward the fluid beyond which it is cut at an edge   [radians]
  // Throws std::runtime_error if no part of the wall lies in the grid.
  ShapeWall(ShapeTree solids, const Grid &grid, const Periods &periods, double turning);

  double distance(const Point &x, double limit) const override;
  double distance(int piece, const Point &x, double limit) const override;

 private:
  using Sides = std::vector<signed char>;
  static constexpr double on_surface = 1e-10;    // of the grid's size: distances that are 0

  ShapeTree tree;
  bool planar;
  double size;                 // of the grid: what is 0 beside it                       [length]
  std::vector<int> piece;      // of each carrier; -1: nowhere a face of the wall
  std::vector<bool> across;    // planes across which a plane grid lies: they are no walls there
  std::vector<bool> face;      // of each half space: whether it makes a face of the wall somewhere

  std::vector<std::vector<bool>> used;      // by each piece: nodes of the tree
  std::vector<std::vector<bool>> crease;    // whether two carriers meet in a concave edge

  enum class Meeting { none, smooth, convex, concave };
  // What a point is: one of a piece or its continuation, else one of the wall, or neither
  enum class Border { none, piece, wall };
  struct Nearest {
    double distance = unknown;
    Point at{};
    Border border = Border::none;
    int carriers[3] = {-1, -1, -1};    // that it is of
  };
  struct Survey;
  void check_planar() const;
  void find_faces(const Grid &grid, Survey &);
  void note_face(int carrier, const Sides &side, Survey &);
  void note_meeting(int a, int b, const Point &x, const Grid &grid, double turning, Survey &) const;
  Meeting meeting(int a, int b, const Point &y, double turning) const;
  void make_pieces(Survey &, const Periods &);

  Sides sides(const Point &x, double on) const;
  signed char at(const Sides &side) const;
  signed char at(int which, const Sides &side) const;
  Border border(int which, const Nearest &candidate, double limit) const;
  bool changes(int which, const Nearest &candidate, Sides side, bool &all_fluid) const;
  bool near_own_crease(const Nearest &candidate, double limit) const;
  Nearest nearest(int which, const Point &x, double limit) const;
  bool counts(int which, int carrier) const
  {
    return !across[carrier] && piece[carrier] >= 0 && (which < 0 || piece[carrier] == which);
  }
};

}    // namespace flowgrid

#endif
