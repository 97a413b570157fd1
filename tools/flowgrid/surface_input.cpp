#include "surface_input.h"

#include "decimals.h"
#include "input_parts.h"
#include "shape_parser.h"
#include "vtk_guard.h"

#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkOBJReader.h>
#include <vtkObject.h>
#include <vtkObjectFactory.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>
#include <vtkTriangleFilter.h>
#include <vtkXMLPolyDataReader.h>

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace flowgrid {

namespace {

  // VTK makes room for as many triangles as a binary file says that it has.
  void check_stl(const std::string &path)
  {
    struct Reader : vtkSTLReader {
      static Reader *New() { VTK_STANDARD_NEW_BODY(Reader); }
      using vtkSTLReader::GetSTLFileType;
    };
    vtkNew<Reader> reader;
    constexpr int binary = 1;    // as vtkSTLReader.cxx has it
    if (reader->GetSTLFileType(path.c_str()) != binary) return;
    constexpr std::uintmax_t head = 84, each = 50;    // bytes
    unsigned char bytes[head] = {};
    std::ifstream(path, std::ios::binary).read(reinterpret_cast<char *>(bytes), head);
    std::uintmax_t count = 0;
    for (int k = 3; k >= 0; k--) count = 256 * count + bytes[80 + k];
    const auto size = std::filesystem::file_size(path);
    if (size < head || count > (size - head) / each)
      throw std::runtime_error(path + ": says that it has " + std::to_string(count) +
                               " triangles, but is too short for them");
  }

  std::string extension(const std::string &path)
  {
    return std::filesystem::path(path).extension().string();
  }

  vtkSmartPointer<vtkPolyData> read(const std::string &path)
  {
    const std::string end = extension(path);
    vtkObject::GlobalWarningDisplayOff();
    vtkNew<vtkTriangleFilter> triangles;
    triangles->PassLinesOff();
    triangles->PassVertsOff();
    const auto from = [&](auto *reader) {
      reader->SetFileName(path.c_str());
      reader->Update();
      check_cells(path, reader->GetOutput());
      triangles->SetInputConnection(reader->GetOutputPort());
      triangles->Update();
    };
    if (end == ".stl") {
      check_stl(path);
      vtkNew<vtkSTLReader> reader;
      reader->MergingOff();    // would drop triangles unseen
      from(reader.Get());
    } else if (end == ".vtp") {
      vtkNew<vtkXMLPolyDataReader> reader;
      from(reader.Get());
    } else {
      vtkNew<vtkOBJReader> reader;
      from(reader.Get());
    }
    return triangles->GetOutput();
  }

}    // namespace

SurfaceWords::SurfaceWords(const std::string &words) : file(words.substr(0, words.rfind(':')))
{
  const size_t colon = words.rfind(':');
  name = colon == std::string::npos ? std::filesystem::path(file).stem().string()
                                    : words.substr(colon + 1);
  check_is_file(file);
  const std::string end = extension(file);
  if (end != ".stl" && end != ".vtp" && end != ".obj")
    throw std::runtime_error(file + ": a surface must be .stl, .vtp or .obj");
  check_zone_name(name);
}

void read_surface(const SurfaceWords &words, double scale, Surface &surface)
{
  const std::string &path = words.file;
  vtkSmartPointer<vtkPolyData> data;
  by_vtk(path, [&] {
    data = read(path);
  });
  if (data->GetNumberOfCells() == 0)
    throw std::runtime_error(path + ": cannot be read, or holds no triangles");
  const bool single = data->GetPoints()->GetDataType() == VTK_FLOAT;
  const int zone = static_cast<int>(surface.zones.size());
  surface.zones.push_back(words.name);
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
