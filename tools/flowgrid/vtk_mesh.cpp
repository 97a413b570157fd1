#include "vtk_mesh.h"

#include "decimals.h"
#include "progress.h"

#include <vtkCell.h>
#include <vtkCellType.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

namespace flowgrid {

int dimension_of(vtkDataSet *set)
{
  int dim = 0;
  for (vtkIdType c = 0; c < set->GetNumberOfCells() && dim < 3; c++)
    dim = std::max(dim, set->GetCell(c)->GetCellDimension());
  return dim;
}

namespace {

  // numbers of the corners of a cell that is one of ours, in our order; none of another one
  struct Known {
    Shape shape;
    std::vector<int> order;
  };
  const Known *known(int type)
  {
    static const Known hexahedron{Shape::HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7}},
        voxel{Shape::HEXAHEDRON, {0, 1, 3, 2, 4, 5, 7, 6}}, quad{Shape::QUAD, {0, 1, 2, 3}},
        pixel{Shape::QUAD, {0, 1, 3, 2}};
    switch (type) {
      case VTK_HEXAHEDRON:
        return &hexahedron;
      case VTK_VOXEL:
        return &voxel;
      case VTK_QUAD:
        return &quad;
      case VTK_PIXEL:
        return &pixel;
      default:
        return nullptr;
    }
  }

}    // namespace

Mesh mesh_of(vtkUnstructuredGrid *grid)
{
  Mesh mesh;
  const auto npoints = grid->GetNumberOfPoints(), ncells = grid->GetNumberOfCells();
  mesh.points.resize(npoints);
  for (vtkIdType p = 0; p < npoints; p++) grid->GetPoint(p, mesh.points[p].data());
  if (grid->GetPoints()->GetDataType() == VTK_FLOAT)
    for (auto &point : mesh.points)
      for (double &x : point) x = as_written(x);

  const int dim = dimension_of(grid) == 3 ? 3 : 2, corners = dim + 1;
  vtkNew<vtkIdList> pieces;
  vtkNew<vtkPoints> places;
  for (vtkIdType c = 0; c < ncells; c++) {
    if (c % 1024 == 0) show_progress("cells", 1.0 * c / ncells);
    auto *cell = grid->GetCell(c);
    if (cell->GetCellDimension() != dim) continue;
    std::array<int, 8> of{};
    if (const Known *one = known(cell->GetCellType())) {
      int k = 0;
      for (const int corner : one->order) of[k++] = static_cast<int>(cell->GetPointId(corner));
      mesh.add(one->shape, of);
      continue;
    }
    cell->Triangulate(0, pieces, places);
    for (vtkIdType k = 0; k + corners <= pieces->GetNumberOfIds(); k += corners) {
      for (int n = 0; n < corners; n++) of[n] = static_cast<int>(pieces->GetId(k + n));
      mesh.add(dim == 3 ? Shape::TETRA : Shape::TRIANGLE, of);
    }
  }
  mesh.link();
  show_progress("cells", 1.0);
  return mesh;
}

}    // namespace flowgrid
