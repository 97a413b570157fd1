// Reads a flow from what VTK reads: OpenFOAM cases, .vtm, .vts, .vtu, .vti, .vtk, PLOT3D, CGNS.

#ifndef FLOWGRID_VTK_INPUT_H
#define FLOWGRID_VTK_INPUT_H

#include "field.h"
#include "surface.h"

#include <memory>
#include <string>
#include <vector>

namespace flowgrid {

class VtkInput {
 public:
  // Throws std::runtime_error, as all functions here. wall_names: patches of an OpenFOAM case that
  // are walls besides those of type wall. solution: PLOT3D's solution, which belongs to a grid.
  VtkInput(const std::string &path, const std::vector<std::string> &wall_names,
           const std::string &solution);
  ~VtkInput();

  const Mesh &mesh() const { return cells; }
  const std::vector<double> &times() const { return steps; }    // empty if there is but one
  // points of walls: patches, or where they are not known points on the border that do not move
  std::vector<Point> wall_points(const Field &velocity) const;

  // Their faces, with normals into the fluid; of a plane mesh strips along z. Lengths times scale.
  Surface wall_surface(const Field &velocity, double scale, double half_width) const;

  // Fields at a time. An empty name takes the one vector, or the scalar called p or pressure; a
  // field without components comes back where an optional one is not there.
  Field velocity(int step, const std::string &name);
  Field pressure(int step, const std::string &name);

 private:
  struct Vtk;
  std::unique_ptr<Vtk> vtk;
  std::string file;
  Mesh cells;
  std::vector<double> steps;

  void read(int step);
  void join_blocks();
  Field field(const std::string &name, int components, const char *what);
  std::vector<double> from_cells(const std::vector<double> &values, int components) const;
};

}    // namespace flowgrid

#endif
