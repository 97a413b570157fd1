// VTK's readers by the format of a file.

#ifndef FLOWGRID_VTK_FORMATS_H
#define FLOWGRID_VTK_FORMATS_H

#include <vtkAlgorithm.h>
#include <vtkSmartPointer.h>

#include <string>

namespace flowgrid {

// For a file, by the ending of its name; all arrays are chosen. solution: PLOT3D's, which belongs
// to a grid. Throws std::runtime_error.
vtkSmartPointer<vtkAlgorithm> reader_of(const std::string &path, const std::string &solution);

// For the OpenFOAM case in a folder.
vtkSmartPointer<vtkAlgorithm> foam_reader(const std::string &folder);

}    // namespace flowgrid

#endif
