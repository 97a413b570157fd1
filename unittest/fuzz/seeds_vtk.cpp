// Writes the first inputs of flowgrid's fuzzers into FOLDER/ENDING: small right files of each kind,
// in text and in bytes.

#include <vtkAppendFilter.h>
#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkGenericDataObjectWriter.h>
#include <vtkImageData.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkOBJWriter.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkRectilinearGrid.h>
#include <vtkSTLWriter.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLImageDataWriter.h>
#include <vtkXMLMultiBlockDataWriter.h>
#include <vtkXMLPolyDataWriter.h>
#include <vtkXMLRectilinearGridWriter.h>
#include <vtkXMLStructuredGridWriter.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <array>
#include <filesystem>
#include <string>

namespace {

std::string folder;

std::string file_of(const std::string &ending, const std::string &name)
{
  std::filesystem::create_directories(folder + "/" + ending);
  return folder + "/" + ending + "/" + name + "." + ending;
}

void set_fields(vtkDataSet *set)
{
  vtkNew<vtkDoubleArray> u, p;
  u->SetName("U");
  u->SetNumberOfComponents(3);
  p->SetName("p");
  for (vtkIdType k = 0; k < set->GetNumberOfPoints(); k++) {
    const double *x = set->GetPoint(k);
    u->InsertNextTuple3(1.0 + x[1], x[2], 0.25);
    p->InsertNextValue(x[0]);
  }
  set->GetPointData()->AddArray(u);
  set->GetPointData()->AddArray(p);
}

template <class Writer> void write_xml(vtkDataObject *data, const std::string &ending)
{
  vtkNew<Writer> writer;
  writer->SetInputData(data);
  for (const std::string mode : {"ascii", "binary", "appended"}) {
    if (mode == "ascii") writer->SetDataModeToAscii();
    if (mode == "binary") writer->SetDataModeToBinary();
    if (mode == "appended") writer->SetDataModeToAppended();
    if (mode == "binary") writer->SetCompressorTypeToNone();
    writer->SetFileName(file_of(ending, mode).c_str());
    writer->Write();
  }
}

void write_legacy(vtkDataObject *data, const std::string &name)
{
  vtkNew<vtkGenericDataObjectWriter> writer;
  writer->SetInputData(data);
  for (const bool text : {true, false}) {
    if (text)
      writer->SetFileTypeToASCII();
    else
      writer->SetFileTypeToBinary();
    writer->SetFileName(file_of("vtk", name + (text ? "-text" : "-bytes")).c_str());
    writer->Write();
  }
}

vtkSmartPointer<vtkStructuredGrid> block()
{
  auto grid = vtkSmartPointer<vtkStructuredGrid>::New();
  vtkNew<vtkPoints> points;
  for (int k = 0; k < 2; k++)
    for (int j = 0; j < 3; j++)
      for (int i = 0; i < 2; i++) points->InsertNextPoint(i + 0.1 * j, j, k);
  grid->SetDimensions(2, 3, 2);
  grid->SetPoints(points);
  set_fields(grid);
  return grid;
}

void write_meshes()
{
  vtkNew<vtkImageData> image;
  image->SetDimensions(3, 2, 2);
  set_fields(image);
  write_xml<vtkXMLImageDataWriter>(image, "vti");
  write_legacy(image, "image");

  vtkNew<vtkRectilinearGrid> bars;
  vtkNew<vtkDoubleArray> x;
  for (const double a : {0.0, 1.0, 3.0}) x->InsertNextValue(a);
  bars->SetDimensions(3, 3, 3);
  bars->SetXCoordinates(x);
  bars->SetYCoordinates(x);
  bars->SetZCoordinates(x);
  set_fields(bars);
  write_xml<vtkXMLRectilinearGridWriter>(bars, "vtr");
  write_legacy(bars, "bars");

  const auto grid = block();
  write_xml<vtkXMLStructuredGridWriter>(grid, "vts");
  write_legacy(grid, "block");
  vtkNew<vtkAppendFilter> cells;
  cells->AddInputData(grid);
  cells->Update();
  write_xml<vtkXMLUnstructuredGridWriter>(cells->GetOutput(), "vtu");
  write_legacy(cells->GetOutput(), "cells");

  vtkNew<vtkMultiBlockDataSet> blocks;
  blocks->SetBlock(0, grid);
  blocks->SetBlock(1, image);
  vtkNew<vtkXMLMultiBlockDataWriter> writer;
  writer->SetInputData(blocks);
  std::filesystem::create_directories(folder + "/blocks");    // seeds.py makes one input of them
  writer->SetFileName((folder + "/blocks/input.vtm").c_str());
  writer->Write();
}

void write_surfaces()
{
  vtkNew<vtkPolyData> surface;    // a tetrahedron
  vtkNew<vtkPoints> corners;
  vtkNew<vtkCellArray> faces;
  for (const auto &x : {std::array<double, 3>{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}})
    corners->InsertNextPoint(x.data());
  for (const auto &face : {std::array<vtkIdType, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    faces->InsertNextCell(3, face.data());
  surface->SetPoints(corners);
  surface->SetPolys(faces);
  write_xml<vtkXMLPolyDataWriter>(surface, "vtp");
  write_legacy(surface, "surface");
  vtkNew<vtkSTLWriter> stl;
  stl->SetInputData(surface);
  stl->SetFileTypeToASCII();
  stl->SetFileName(file_of("stl", "text").c_str());
  stl->Write();
  stl->SetFileTypeToBinary();
  stl->SetFileName(file_of("stl", "bytes").c_str());
  stl->Write();
  vtkNew<vtkOBJWriter> obj;
  obj->SetInputData(surface);
  obj->SetFileName(file_of("obj", "tetrahedron").c_str());
  obj->Write();
}

}    // namespace

int main(int argc, char **argv)
{
  if (argc != 2) return 1;
  folder = argv[1];
  write_meshes();
  write_surfaces();
  return 0;
}
