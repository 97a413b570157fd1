#include "surface_input.h"

#include "decimals.h"
#include "shape_parser.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObject.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <filesystem>
#include <stdexcept>

namespace flowgrid {

namespace {

  vtkSmartPointer<vtkPolyData> read(const std::string &path)
  {
    const std::string end = std::filesystem::path(path).extension().string();
    if (!std::filesystem::exists(path)) throw std::runtime_error(path + ": does not exist");
    vtkObject::GlobalWarningDisplayOff();
    vtkNew<vtkTriangleFilter> triangles;
    triangles->PassLinesOff();
    triangles->PassVertsOff();
    const auto from = [&](auto *reader) {
      reader->SetFileName(path.c_str());
      triangles->SetInputConnection(reader->GetOutputPort());
      triangles->Update();
    };
    if (end == ".stl") {
      vtkNew<vtkSTLReader> reader;
      reader->MergingOff();    // would drop triangles unseen
      from(reader.Get());
    } else if (end == ".vtp") {
      vtkNew<vtkXMLPolyDataReader> reader;
      from(reader.Get());
    } else if (end == ".obj") {
      vtkNew<vtkOBJReader> reader;
      from(reader.Get());
    } else
      throw std::runtime_error(path + ": a surface must be .stl, .vtp or .obj");
    return triangles->GetOutput();
  }

}    // namespace

void read_surface(const std::string &words, double scale, Surface &surface)
{
  const size_t colon = words.rfind(':');
  const std::string path = words.substr(0, colon);
  const std::string name = colon == std::string::npos ? std::filesystem::path(path).stem().string()
                                                      : words.substr(colon + 1);
  check_zone_name(name);
  const auto data = read(path);
  if (data->GetNumberOfCells() == 0)
    throw std::runtime_error(path + ": cannot be read, or holds no triangles");
  const bool single = data->GetPoints()->GetDataType() == VTK_FLOAT;
  const int zone = static_cast<int>(surface.zones.size());
  surface.zones.push_back(name);
  vtkNew<vtkIdList> corners;
  for (vtkIdType cell = 0; cell < data->GetNumberOfCells(); cell++) {
    data->GetCellPoints(cell, corners);
    if (corners->GetNumberOfIds() != 3) continue;
    Point x[3];
    for (int k = 0; k < 3; k++) {
      data->GetPoint(corners->GetId(k), x[k].data());
      for (double &c : x[k]) {
        if (!std::isfinite(c)) throw std::runtime_error(path + ": has points that are not finite");
        c = scale * (single ? as_written(c) : c);
      }
    }
    surface.add(x[0], x[1], x[2], zone);
  }
}

}    // namespace flowgrid
