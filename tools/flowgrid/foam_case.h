// What an OpenFOAM case says besides its fields: which patches its border has, which of them are
// walls, and what holds on them.

#ifndef FLOWGRID_FOAM_CASE_H
#define FLOWGRID_FOAM_CASE_H

#include "field.h"
#include "surface.h"

#include <vtkPolyData.h>
#include <vtkSmartPointer.h>

#include <map>
#include <string>
#include <vector>

class vtkDataSet;

namespace flowgrid {

class FoamCase {
 public:
  // path: of its folder, or of a .foam file in it. wall_names: patches that are walls besides those
  // of type wall. Throws std::runtime_error, as all functions here.
  FoamCase(const std::string &path, const std::vector<std::string> &wall_names);
  static bool is_path_of_one(const std::string &path);

  const std::string &folder() const { return home; }

  // The patches as VTK has read them, with the fields of a time; in the same order at all times.
  void set_patch(size_t number, const std::string &name, vtkPolyData *faces);
  // Once: which points of the mesh are theirs.
  void find_points(vtkDataSet *mesh);

  std::vector<int> wall_points() const;    // ascending
  // Points of patches get the mean of the faces around them; walls come last, and rest where the
  // case says noSlip or leaves the velocity of a fixed one at 0. times: those that the case has.
  void set_on_patches(const std::vector<double> &times, Field &field) const;
  // Faces of walls: one zone for each patch.
  Surface wall_surface(const Mesh &mesh, double half_width) const;

 private:
  struct Patch {
    std::string name;
    vtkSmartPointer<vtkPolyData> faces;
    std::vector<int> point;    // of the mesh, of each point
    bool wall = false;
  };

  std::string given, home;    // path, folder
  std::vector<std::string> wall_names;
  std::vector<Patch> patches;
  mutable std::map<std::string, std::string> boundaries;    // boundary_of()

  const std::string &boundary_of(const std::vector<double> &times, const std::string &name) const;
};

}    // namespace flowgrid

#endif
