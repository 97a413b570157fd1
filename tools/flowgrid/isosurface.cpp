#include "isosurface.h"

#include "output_file.h"

#include <vtkCleanPolyData.h>
#include <vtkContourFilter.h>
#include <vtkDoubleArray.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkReverseSense.h>
#include <vtkSTLWriter.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataWriter.h>

#include <algorithm>

namespace flowgrid {

long write_isosurface(const std::string &path, const Grid &grid,
                      const std::vector<double> &distance)
{
  const int layers = std::max(grid.n[2], 2);
  vtkNew<vtkImageData> image;
  image->SetDimensions(grid.n[0], grid.n[1], layers);
  image->SetOrigin(grid.origin.data());
  image->SetSpacing(grid.spacing.data());
  vtkNew<vtkDoubleArray> values;
  values->SetName("distance");
  values->SetNumberOfValues(image->GetNumberOfPoints());
  for (vtkIdType k = 0; k < values->GetNumberOfValues(); k++)
    values->SetValue(k, distance[k % distance.size()]);
  image->GetPointData()->SetScalars(values);

  vtkNew<vtkContourFilter> contour;
  contour->SetInputData(image);
  // nodes on the wall count as behind it: along the border of the grid there are no others
  const double on_wall = 1.0e-6 * *std::min_element(grid.spacing.begin(), grid.spacing.end());
  contour->SetValue(0, on_wall);
  contour->ComputeNormalsOff();
  vtkNew<vtkCleanPolyData> clean;    // nodes on the wall give triangles without area
  clean->SetInputConnection(contour->GetOutputPort());
  clean->ToleranceIsAbsoluteOn();
  clean->SetAbsoluteTolerance(10.0 * on_wall);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->PassLinesOff();
  triangles->PassVertsOff();
  triangles->SetInputConnection(clean->GetOutputPort());
  vtkNew<vtkReverseSense> into_fluid;    // normals, as those of --wall-surface
  into_fluid->ReverseCellsOn();
  into_fluid->SetInputConnection(triangles->GetOutputPort());
  into_fluid->Update();

  const OutputFile output(path);
  const auto write = [&](auto *writer) {
    writer->SetFileName(output.while_written().c_str());
    writer->SetInputData(into_fluid->GetOutput());
    if (!writer->Write() || writer->GetErrorCode())
      output.fail("cannot be written: is the disk full?");
    output.keep();
  };
  if (path.size() > 4 && path.compare(path.size() - 4, 4, ".stl") == 0) {
    vtkNew<vtkSTLWriter> writer;
    writer->SetFileTypeToBinary();
    write(writer.Get());
  } else {
    vtkNew<vtkXMLPolyDataWriter> writer;
    write(writer.Get());
  }
  return static_cast<long>(into_fluid->GetOutput()->GetNumberOfCells());
}

}    // namespace flowgrid
