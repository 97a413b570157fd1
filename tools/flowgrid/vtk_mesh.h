// A mesh of VTK as ours.

#ifndef FLOWGRID_VTK_MESH_H
#define FLOWGRID_VTK_MESH_H

#include "mesh.h"

class vtkDataSet;
class vtkUnstructuredGrid;

namespace flowgrid {

// Hexahedra and quadrilaterals as they are, pixels and voxels in their order; others in simplices.
// Surface cells beside cells in space are left out; the points are VTK's, with their numbers.
Mesh mesh_of(vtkUnstructuredGrid *grid);

// largest dimension of the cells of a data set
int dimension_of(vtkDataSet *set);

}    // namespace flowgrid

#endif
