#include "vtk_input.h"

#include "cell_to_point.h"
#include "decimals.h"
#include "mesh_walls.h"
#include "plot3d_text.h"
#include "vtk_guard.h"

#include <vtkAppendFilter.h>
#include <vtkCGNSReader.h>
#include <vtkCellData.h>
#include <vtkCellType.h>
#include <vtkCompositeDataIterator.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkGenericCell.h>
#include <vtkGenericDataObjectReader.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkMultiBlockPLOT3DReader.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkOpenFOAMReader.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStaticPointLocator.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLGenericDataObjectReader.h>

#include <zlib.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <regex>
#include <set>
#include <sstream>
#include <stdexcept>

namespace fs = std::filesystem;

namespace flowgrid {

struct VtkInput::Vtk {
  vtkSmartPointer<vtkAlgorithm> reader;
  vtkSmartPointer<vtkUnstructuredGrid> grid;    // all blocks in one, coincident points merged
  int step = 0;                                 // that it is of
  std::unique_ptr<CellToPoint> to_points;       // where a field is of cells
  bool foam = false;
  std::string case_folder;
  std::vector<std::string> wall_names;

  struct Patch {
    std::string name;
    vtkSmartPointer<vtkPolyData> faces;
    std::vector<int> point;    // of the mesh, of each point
    bool wall = false;
  };
  std::vector<Patch> patches;
  std::map<std::string, std::string> boundaries;    // boundary_of()
};

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

  // text between the braces that follow `word` in an OpenFOAM dictionary, empty if it is not there
  std::string block_of(const std::string &text, const std::string &word)
  {
    const std::regex head("(^|[\\s;}{)(\"])" + word + "\"?\\s*\\{");
    std::smatch found;
    if (!std::regex_search(text, found, head)) return {};
    size_t at = found.position() + found.length();
    int depth = 1;
    const size_t begin = at;
    for (; at < text.size() && depth > 0; at++)
      depth += text[at] == '{' ? 1 : text[at] == '}' ? -1 : 0;
    return text.substr(begin, at - begin - 1);
  }

  // of a file, or of the one that gzip made of it; empty if there is neither
  std::string contents(const std::string &path)
  {
    std::string text;
    gzFile in = gzopen(fs::exists(path) ? path.c_str() : (path + ".gz").c_str(), "rb");
    if (!in) return text;
    char part[4096];
    for (int n; (n = gzread(in, part, sizeof(part))) > 0;) text.append(part, n);
    gzclose(in);
    return text;
  }

  // 3 if there are cells in space
  int dimension_of(vtkDataSet *set)
  {
    int dim = 0;
    for (vtkIdType c = 0; c < set->GetNumberOfCells() && dim < 3; c++)
      dim = std::max(dim, set->GetCell(c)->GetCellDimension());
    return dim;
  }

  vtkSmartPointer<vtkAlgorithm> plot3d(const std::string &path, const std::string &solution)
  {
    if (solution.empty()) stop(path, "a PLOT3D grid needs its solution: --solution FILE.q");
    if (!fs::exists(solution)) stop(solution, "does not exist");
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

  std::string type_of(const std::string &block)
  {
    std::smatch found;
    const std::regex type("(^|[\\s;{])type\\s+(\\w+)\\s*;");
    return std::regex_search(block, found, type) ? found[2].str() : std::string();
  }

}    // namespace

/* ---------------------------------------------------------------------- */

VtkInput::VtkInput(const std::string &path, const std::vector<std::string> &wall_names,
                   const std::string &solution) :
    vtk(std::make_unique<Vtk>()),
    file(path)
{
  vtkObject::GlobalWarningDisplayOff();
  if (!fs::exists(path)) stop(path, "does not exist");
  vtk->wall_names = wall_names;
  by_vtk(file, [&] {
    open(solution);
    vtk->reader->UpdateInformation();
    auto *about = vtk->reader->GetOutputInformation(0);
    auto *key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    if (about->Has(key)) steps.assign(about->Get(key), about->Get(key) + about->Length(key));
    read(steps.empty() ? 0 : static_cast<int>(steps.size()) - 1);
    make_mesh();
  });
}

VtkInput::~VtkInput() = default;

/* ---------------------------------------------------------------------- */

void VtkInput::open(const std::string &solution)
{
  const std::string &path = file, end = ending(path);
  if (fs::is_directory(path) || end == ".foam" || end == ".openfoam") {
    vtk->foam = true;
    vtk->case_folder = fs::is_directory(path) ? path : fs::path(path).parent_path().string();
    if (vtk->case_folder.empty()) vtk->case_folder = ".";
    if (!fs::exists(vtk->case_folder + "/system/controlDict"))
      stop(path, "is no OpenFOAM case: there is no system/controlDict");
    auto reader = vtkSmartPointer<vtkOpenFOAMReader>::New();
    reader->SetFileName((vtk->case_folder + "/case.foam").c_str());
    reader->CreateCellToPointOff();
    reader->DecomposePolyhedraOn();
    reader->SkipZeroTimeOff();
    reader->UpdateInformation();
    reader->EnableAllPatchArrays();
    reader->EnableAllCellArrays();
    vtk->reader = reader;
  } else if (end == ".cgns") {
    auto reader = vtkSmartPointer<vtkCGNSReader>::New();
    reader->SetFileName(path.c_str());
    reader->UpdateInformation();
    reader->EnableAllBases();
    reader->EnableAllFamilies();
    reader->EnableAllPointArrays();
    reader->EnableAllCellArrays();
    vtk->reader = reader;
  } else if (end == ".xyz" || end == ".x" || end == ".p3d") {
    vtk->reader = plot3d(path, solution);
  } else if (end == ".vtk") {
    auto reader = vtkSmartPointer<vtkGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    reader->ReadAllVectorsOn();
    reader->ReadAllScalarsOn();
    vtk->reader = reader;
  } else if (end.compare(0, 3, ".vt") == 0) {
    auto reader = vtkSmartPointer<vtkXMLGenericDataObjectReader>::New();
    reader->SetFileName(path.c_str());
    vtk->reader = reader;
  } else
    stop(path,
         "must be an OpenFOAM case, .vtm, .vts, .vtu, .vti, .vtr, .vtk, .cgns or PLOT3D (.xyz)");
}

/* ---------------------------------------------------------------------- */

// All data sets of a step, in one grid.
void VtkInput::read(int step)
{
  if (vtk->grid && step == vtk->step) return;
  vtk->step = step;
  by_vtk(file, [&] {
    read_blocks();
  });
}

void VtkInput::read_blocks()
{
  const int step = vtk->step;
  if (steps.empty())
    vtk->reader->Update();
  else
    vtk->reader->UpdateTimeStep(steps[step]);
  auto *data = vtk->reader->GetOutputDataObject(0);
  vtkNew<vtkAppendFilter> append;
  append->MergePointsOn();
  std::vector<vtkDataSet *> sets;
  const auto patches_known = !vtk->patches.empty();
  size_t patch = 0;
  if (auto *blocks = vtkMultiBlockDataSet::SafeDownCast(data)) {
    vtkSmartPointer<vtkDataObjectTreeIterator> it;
    it.TakeReference(blocks->NewTreeIterator());
    it->VisitOnlyLeavesOn();
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
      auto *set = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
      if (!set) continue;
      auto *surface = vtk->foam ? vtkPolyData::SafeDownCast(set) : nullptr;
      check_cells(file, set);
      if (surface) {
        const char *name = it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
        if (!patches_known)
          vtk->patches.push_back({name ? name : "", surface, {}, false});
        else
          vtk->patches[patch++].faces = surface;
        continue;
      }
      sets.push_back(set);
    }
  } else if (auto *set = vtkDataSet::SafeDownCast(data)) {
    check_cells(file, set);
    sets.push_back(set);
  }
  if (sets.empty()) stop(file, "cannot be read, or holds no mesh");

  // surfaces beside a mesh in space are no part of it, and need not have its fields
  std::vector<int> dimensions;
  for (auto *set : sets) dimensions.push_back(dimension_of(set));
  const int dim = *std::max_element(dimensions.begin(), dimensions.end());
  for (size_t k = 0; k < sets.size(); k++) {
    if (dimensions[k] < dim) continue;
    auto *block = vtkStructuredGrid::SafeDownCast(sets[k]);
    if (block && (block->HasAnyBlankPoints() || block->HasAnyBlankCells()))
      stop(file, "has blanked points: grids that overlap cannot be mapped");
    append->AddInputData(sets[k]);
  }
  append->Update();
  vtk->grid = append->GetOutput();
  if (vtk->grid->GetNumberOfCells() == 0) stop(file, "cannot be read, or holds no cells");
}

/* ---------------------------------------------------------------------- */

// Hexahedra and quadrilaterals as they are, pixels and voxels in their order; others in simplices.
void VtkInput::make_mesh()
{
  auto *grid = vtk->grid.Get();
  const auto npoints = grid->GetNumberOfPoints();
  if (npoints > 2000000000 || grid->GetNumberOfCells() > 400000000)
    stop(file, "has too many points or cells");
  cells.points.resize(npoints);
  for (vtkIdType p = 0; p < npoints; p++) grid->GetPoint(p, cells.points[p].data());
  if (grid->GetPoints()->GetDataType() == VTK_FLOAT)
    for (auto &point : cells.points)
      for (double &x : point) x = as_written(x);

  bool solid = false;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells() && !solid; c++)
    solid = grid->GetCell(c)->GetCellDimension() == 3;
  vtkNew<vtkIdList> pieces;
  vtkNew<vtkPoints> places;
  for (vtkIdType c = 0; c < grid->GetNumberOfCells(); c++) {
    auto *cell = grid->GetCell(c);
    if (cell->GetCellDimension() != (solid ? 3 : 2)) continue;
    std::array<int, 8> of{};
    auto add = [&](Shape shape, std::initializer_list<int> order) {
      int k = 0;
      for (int corner : order) of[k++] = static_cast<int>(cell->GetPointId(corner));
      cells.add(shape, of);
    };
    switch (cell->GetCellType()) {
      case VTK_HEXAHEDRON:
        add(Shape::HEXAHEDRON, {0, 1, 2, 3, 4, 5, 6, 7});
        continue;
      case VTK_VOXEL:
        add(Shape::HEXAHEDRON, {0, 1, 3, 2, 4, 5, 7, 6});
        continue;
      case VTK_QUAD:
        add(Shape::QUAD, {0, 1, 2, 3});
        continue;
      case VTK_PIXEL:
        add(Shape::QUAD, {0, 1, 3, 2});
        continue;
      default:
        break;
    }
    cell->Triangulate(0, pieces, places);
    const int corners = solid ? 4 : 3;
    for (vtkIdType k = 0; k + corners <= pieces->GetNumberOfIds(); k += corners) {
      for (int n = 0; n < corners; n++) of[n] = static_cast<int>(pieces->GetId(k + n));
      cells.add(solid ? Shape::TETRA : Shape::TRIANGLE, of);
    }
  }
  cells.link();
  if (!vtk->foam) return;

  // patches: which are walls, and which points of the mesh are theirs
  vtkNew<vtkStaticPointLocator> locator;
  locator->SetDataSet(grid);
  locator->BuildLocator();
  const std::string boundary = contents(vtk->case_folder + "/constant/polyMesh/boundary");
  std::vector<bool> is_wall(npoints, false);
  for (auto &patch : vtk->patches) {
    patch.wall = type_of(block_of(boundary, patch.name)) == "wall";
    for (const auto &name : vtk->wall_names) patch.wall |= name == patch.name;
    for (vtkIdType p = 0; p < patch.faces->GetNumberOfPoints(); p++) {
      patch.point.push_back(static_cast<int>(locator->FindClosestPoint(patch.faces->GetPoint(p))));
      if (patch.wall) is_wall[patch.point.back()] = true;
    }
  }
  for (const auto &name : vtk->wall_names) {
    bool found = false;
    for (const auto &patch : vtk->patches) found |= patch.name == name;
    if (!found) stop(file, "has no patch " + name + ", which --wall names");
  }
  for (vtkIdType p = 0; p < npoints; p++)
    if (is_wall[p]) walls.push_back(static_cast<int>(p));
}

/* ---------------------------------------------------------------------- */

// The field of that name, from points, or from cells where points do not have it.
Field VtkInput::field(const std::string &name, int components, const char *what)
{
  Field result;
  vtkDataArray *array = nullptr;
  bool of_cells = false;
  std::string present;
  for (const bool cell_data : {false, true}) {
    vtkDataSetAttributes *data = cell_data
        ? static_cast<vtkDataSetAttributes *>(vtk->grid->GetCellData())
        : vtk->grid->GetPointData();
    for (int k = 0; k < data->GetNumberOfArrays(); k++) {
      auto *one = data->GetArray(k);
      if (!one || !one->GetName()) continue;
      present += present.empty() ? one->GetName() : std::string(", ") + one->GetName();
      if (array || one->GetNumberOfComponents() != components) continue;
      const std::string is = one->GetName();
      const bool fits = !name.empty() ? is == name
          : components == 3 ? is == "U" || is == "velocity" || is == "Velocity" || is == "u"
                            : is == "p" || is == "pressure" || is == "Pressure";
      if (!fits) continue;
      array = one;
      of_cells = cell_data;
    }
  }
  if (!array && (components == 3 || !name.empty()))
    stop(file,
         std::string("has no array ") + (name.empty() ? "U or velocity" : name) + " of " +
             std::to_string(components) + " component(s) for the " + what +
             "; there are: " + (present.empty() ? "none" : present));
  if (!array) return result;

  result.name = array->GetName();
  result.components = components;
  result.values.resize(static_cast<size_t>(array->GetNumberOfTuples()) * components);
  for (vtkIdType t = 0; t < array->GetNumberOfTuples(); t++)
    for (int c = 0; c < components; c++) {
      const double value = array->GetComponent(t, c);
      if (!std::isfinite(value))
        stop(file,
             std::string("array ") + result.name + " is not finite at " +
                 (of_cells ? "cell " : "point ") + std::to_string(t));
      result.values[static_cast<size_t>(t) * components + c] = value;
    }
  if (of_cells) {
    result.values = from_cells(result.values, components);
    set_on_patches(result);
  }
  return result;
}

// Values at the points of VTK's cells; the fit is made once, for all fields and times.
std::vector<double> VtkInput::from_cells(const std::vector<double> &values, int components) const
{
  if (!vtk->to_points) {
    auto *grid = vtk->grid.Get();
    Lists corners;
    std::vector<Point> centres;
    vtkNew<vtkIdList> of;
    for (vtkIdType c = 0; c < grid->GetNumberOfCells(); c++) {
      grid->GetCellPoints(c, of);
      Point centre{};
      for (vtkIdType k = 0; k < of->GetNumberOfIds(); k++) {
        corners.items.push_back(static_cast<int>(of->GetId(k)));
        for (int n = 0; n < 3; n++)
          centre[n] += cells.points[of->GetId(k)][n] / of->GetNumberOfIds();
      }
      corners.close();
      centres.push_back(centre);
    }
    vtk->to_points = std::make_unique<CellToPoint>(cells.points, corners, centres);
  }
  return vtk->to_points->apply(values, components);
}

// The case's words on the borders of a field, from its last time: they do not change in time.
const std::string &VtkInput::boundary_of(const std::string &name) const
{
  const auto [place, is_new] = vtk->boundaries.try_emplace(name);
  for (size_t k = steps.size(); is_new && k > 0 && place->second.empty(); k--) {
    std::ostringstream time;
    time << steps[k - 1];
    const std::string text = contents(vtk->case_folder + "/" + time.str() + "/" + name);
    const size_t at = text.rfind("boundaryField");
    if (at != std::string::npos) place->second = text.substr(at);
  }
  return place->second;
}

// Points of patches get the mean of the faces around them; walls come last, and rest where the case
// says noSlip or leaves the velocity of a fixed one at 0.
void VtkInput::set_on_patches(Field &field) const
{
  const int n = field.components;
  const std::string &boundary = boundary_of(field.name);
  for (const bool of_walls : {false, true}) {
    std::vector<double> sum(field.values.size(), 0.0);
    std::vector<int> faces(cells.points.size(), 0);
    for (const auto &patch : vtk->patches) {
      if (patch.wall != of_walls || (patch.wall && n != 3)) continue;
      const std::string type = type_of(block_of(boundary, patch.name));
      if (type == "empty" || type == "cyclic" || type == "symmetryPlane" || type == "symmetry")
        continue;
      const bool rests = n == 3 && type == "noSlip";
      auto *array = patch.faces->GetCellData()->GetArray(field.name.c_str());
      if (!array && !rests) continue;
      for (vtkIdType f = 0; f < patch.faces->GetNumberOfCells(); f++) {
        auto *face = patch.faces->GetCell(f);
        for (vtkIdType k = 0; k < face->GetNumberOfPoints(); k++) {
          const int p = patch.point[face->GetPointId(static_cast<int>(k))];
          faces[p]++;
          for (int c = 0; c < n && !rests; c++)
            sum[static_cast<size_t>(p) * n + c] += array->GetComponent(f, c);
        }
      }
    }
    for (size_t p = 0; p < faces.size(); p++)
      for (int c = 0; c < n && faces[p]; c++) field.values[p * n + c] = sum[p * n + c] / faces[p];
  }
}

/* ---------------------------------------------------------------------- */

Field VtkInput::velocity(int step, const std::string &name)
{
  read(step);
  return field(name, 3, "velocity");
}

Field VtkInput::pressure(int step, const std::string &name)
{
  read(step);
  return field(name, 1, "pressure");
}

std::vector<Point> VtkInput::wall_points(const Field &velocity) const
{
  std::vector<Point> result;
  if (!walls.empty()) {
    for (int p : walls) result.push_back(cells.points[p]);
    return result;
  }
  const auto border = cells.on_border();
  for (size_t p = 0; p < border.size(); p++)
    if (border[p] && velocity.values[3 * p] == 0.0 && velocity.values[3 * p + 1] == 0.0 &&
        velocity.values[3 * p + 2] == 0.0)
      result.push_back(cells.points[p]);
  return result;
}

// A face is of the patch that all its corners are points of, and which has the fewest points.
Surface VtkInput::wall_surface(const Field &velocity, double scale, double half_width) const
{
  Mesh scaled = cells;
  for (auto &p : scaled.points) p = scale * p;
  if (!vtk->foam) {
    const auto rests = [&](const std::vector<int> &corners) {
      for (const int p : corners)
        for (int c = 0; c < 3; c++)
          if (velocity.values[3 * p + c] != 0.0) return -1;
      return 0;
    };
    return mesh_walls(scaled, {"wall"}, rests, half_width);
  }
  std::vector<std::string> names;
  std::vector<std::set<int>> points;
  std::vector<bool> is_wall;
  for (const auto &patch : vtk->patches) {
    std::string name = patch.name;
    for (char &c : name)
      if (!std::isalnum(static_cast<unsigned char>(c))) c = '_';
    names.push_back(name);
    points.emplace_back(patch.point.begin(), patch.point.end());
    is_wall.push_back(patch.wall);
  }
  const auto patch_of = [&](const std::vector<int> &corners) {
    int found = -1;
    for (int k = 0; k < static_cast<int>(points.size()); k++) {
      const bool all = std::all_of(corners.begin(), corners.end(), [&](int p) {
        return points[k].count(p) > 0;
      });
      if (all && (found < 0 || points[k].size() < points[found].size())) found = k;
    }
    return found >= 0 && is_wall[found] ? found : -1;
  };
  return mesh_walls(scaled, names, patch_of, half_width);
}

}    // namespace flowgrid
