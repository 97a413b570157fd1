// Distances to walls from a file: one array for each smooth piece of the wall.

#ifndef LMP_WALL_GRID_H
#define LMP_WALL_GRID_H

#include "grid_file.h"

#include "wall/grid_survey.h"
#include "wall/surface.h"

#include <array>

namespace LAMMPS_NS {

class WallGrid : public GridFile {
 public:
  // arrays: their names, or none for those that the file offers: all distance_*, else distance.
  // largest_pieces: most arrays that are allowed.
  WallGrid(LAMMPS *, const char *command, const std::string &path,
           const std::vector<std::string> &arrays, int largest_pieces, int iarg);

  std::vector<std::string> names() const;        // of the arrays, without distance_
  std::vector<apf::Surface> surfaces() const;    // one for each

  // What particles touch, whose radii lie between two values: that it is a distance, and exact to
  // `error`. Errors if not. Sets the surfaces' curvatures. Called by all ranks.
  void check(std::vector<apf::Surface> &, double smallest, double largest, double error) const;

  // The same for bridges, which hold particles whose centres are up to a distance from the wall:
  // there it must be known and have one nearest point.
  void check_bridges(const std::vector<apf::Surface> &, double smallest, double farthest) const;

  // A piece in triangles, in the plane in lines whose last two points are the same; for pictures
  // and areas. Cut when they are first asked for; where the wall moves they stay in its frame.
  using Facet = std::array<std::array<double, 3>, 3>;
  const std::vector<Facet> &facets(int piece) const;

  bool is_periodic(int axis) const { return lattice.periodic[axis]; }
  double memory_usage() const;

 private:
  std::vector<std::string> pieces;
  std::size_t size = 0;                             // numbers of a piece
  std::vector<double> reaches;                      // largest number of each
  std::vector<apf::GridDistance::PerAxis> jumps;    // of each, see GridDistance

  mutable std::vector<std::vector<Facet>> cut;    // facets of each piece, once they were asked for

  std::vector<Facet> cut_facets(int piece) const;
  apf::GridSurvey looked_at(const std::vector<apf::Surface> &, int piece, double smallest,
                            double farthest) const;
  void choose(const std::vector<std::string> &wanted, int most);
};

}    // namespace LAMMPS_NS

#endif
