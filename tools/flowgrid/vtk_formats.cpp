#include "vtk_formats.h"

#include "cgns_links.h"
#include "foam_includes.h"
#include "input_parts.h"
#include "plot3d_text.h"

#include <vtkCGNSReader.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkMultiBlockPLOT3DReader.h>
#include <vtkOpenFOAMReader.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <cctype>
#include <filesystem>
#include <stdexcept>

namespace fs = std::filesystem;

namespace flowgrid {

namespace {

  [[noreturn]] void stop(const std::string &file, const std::string &why)
  {
    throw std::runtime_error(file + ": " + why);
  }

  std::string ending(const std::string &path)
  {
    std::string end = fs::path(path).extension().string();
    for (char &c : end) c = static_cast<char>(std::tolower(c));
    return end;
  }

  vtkSmartPointer<vtkAlgorithm> plot3d(const std::string &path, const std::string &solution)
  {
    if (solution.empty()) stop(path, "a PLOT3D grid needs its solution: --solution FILE.q");
    check_is_file(solution);
    auto reader = vtkSmartPointer<vtkMultiBlockPLOT3DReader>::New();
    reader->SetXYZFileName(path.c_str());
    reader->SetQFileName(solution.c_str());
    const Plot3dText kind(path);
    reader->SetAutoDetectFormat(!kind.text);
    if (kind.text) {
      if (!kind.known)
        stop(path, "is text, but holds more or fewer numbers than a PLOT3D grid of its size");
      reader->BinaryFileOff();
      reader->DoublePrecisionOn();
      reader->SetMultiGrid(kind.multiple);
      reader->SetTwoDimensionalGeometry(kind.planar);
      reader->SetIBlanking(kind.blanked);
    }
    reader->SetVectorFunctionNumber(200);    // velocity
    reader->AddFunction(110);                // pressure
    return reader;
  }

  vtkSmartPointer<vtkAlgorithm> cgns(const std::string &path)
  {
    check_cgns_links(path);
    auto reader = vtkSmartPointer<vtkCGNSReader>::New();
    reader->SetFileName(path.c_str());
    reader->UpdateInformation();
    reader->EnableAllBases();
    reader->EnableAllFamilies();
    reader->EnableAllPointArrays();
    reader->EnableAllCellArrays();
    return reader;
  }

  vtkSmartPointer<vtkAlgorithm> legacy(const std::string &path)
  {
    auto reader = vtkSmartPointer<vtkGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    reader->ReadAllVectorsOn();
    reader->ReadAllScalarsOn();
    return reader;
  }

  vtkSmartPointer<vtkAlgorithm> xml(const std::string &path)
  {
    auto reader = vtkSmartPointer<vtkXMLGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    return reader;
  }

}    // namespace

vtkSmartPointer<vtkAlgorithm> reader_of(const std::string &path, const std::string &solution)
{
  const std::string end = ending(path);
  if (end == ".cgns") return cgns(path);
  if (end == ".xyz" || end == ".x" || end == ".p3d") return plot3d(path, solution);
  if (end == ".vtk") return legacy(path);
  if (end.compare(0, 3, ".vt") == 0) return xml(path);
  stop(path,
       "must be an OpenFOAM case, .vtm, .vts, .vtu, .vti, .vtr, .vtk, .cgns or PLOT3D (.xyz)");
}

vtkSmartPointer<vtkAlgorithm> foam_reader(const std::string &folder)
{
  check_includes(folder);
  auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
  reader->SetFileName((folder + "/case.foam").c_str());
  reader->CreateCellToPointOff();
  reader->DecomposePolyhedraOn();
  reader->SkipZeroTimeOff();
  reader->UpdateInformation();
  reader->EnableAllPatchArrays();
  reader->EnableAllCellArrays();
  return reader;
}

}    // namespace flowgrid
