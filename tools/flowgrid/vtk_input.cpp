#include "vtk_input.h"

#include "cell_to_point.h"
#include "foam_case.h"
#include "mesh_walls.h"
#include "progress.h"
#include "vtk_formats.h"
#include "vtk_guard.h"
#include "vtk_mesh.h"

#include <vtkAppendFilter.h>
#include <vtkCallbackCommand.h>
#include <vtkCellData.h>
#include <vtkCompositeDataSet.h>
#include <vtkDataArray.h>
#include <vtkDataObjectTreeIterator.h>
#include <vtkIdList.h>
#include <vtkInformation.h>
#include <vtkMultiBlockDataSet.h>
#include <vtkNew.h>
#include <vtkObject.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkStreamingDemandDrivenPipeline.h>
#include <vtkStructuredGrid.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <filesystem>
#include <stdexcept>

namespace flowgrid {

struct VtkInput::Vtk {
  vtkSmartPointer<vtkAlgorithm> reader;
  vtkSmartPointer<vtkUnstructuredGrid> grid;    // all blocks in one, coincident points merged
  int step = 0;                                 // that it is of
  std::unique_ptr<CellToPoint> to_points;       // where a field is of cells
  std::unique_ptr<FoamCase> foam;               // where it is one
};

namespace {

  [[noreturn]] void stop(const std::string &file, const std::string &why)
  {
    throw std::runtime_error(file + ": " + why);
  }

  void show_reading(vtkObject *, unsigned long, void *, void *share)
  {
    show_progress("reading", *static_cast<double *>(share));
  }

}    // namespace

/* ---------------------------------------------------------------------- */

VtkInput::VtkInput(const std::string &path, const std::vector<std::string> &wall_names,
                   const std::string &solution) :
    vtk(std::make_unique<Vtk>()),
    file(path)
{
  vtkObject::GlobalWarningDisplayOff();
  if (!std::filesystem::exists(path)) stop(path, "does not exist");
  by_vtk(file, [&] {
    if (FoamCase::is_path_of_one(path)) {
      vtk->foam = std::make_unique<FoamCase>(path, wall_names);
      vtk->reader = foam_reader(vtk->foam->folder());
    } else {
      if (!wall_names.empty()) stop(path, "has no patches, --wall is for OpenFOAM cases");
      vtk->reader = reader_of(path, solution);
    }
    vtkNew<vtkCallbackCommand> shown;
    shown->SetCallback(show_reading);
    vtk->reader->AddObserver(vtkCommand::ProgressEvent, shown);
    vtk->reader->UpdateInformation();
    auto *about = vtk->reader->GetOutputInformation(0);
    auto *key = vtkStreamingDemandDrivenPipeline::TIME_STEPS();
    if (about->Has(key)) steps.assign(about->Get(key), about->Get(key) + about->Length(key));
    read(steps.empty() ? 0 : static_cast<int>(steps.size()) - 1);
    if (vtk->grid->GetNumberOfPoints() > 2000000000 || vtk->grid->GetNumberOfCells() > 400000000)
      stop(file, "has too many points or cells");
    for (vtkIdType p = 0; p < vtk->grid->GetNumberOfPoints(); p++) {
      const double *x = vtk->grid->GetPoint(p);
      for (int c = 0; c < 3; c++)
        if (!(std::fabs(x[c]) < 1e100))
          stop(file, "point " + std::to_string(p) + " is not finite, or beyond 1e100");
    }
    cells = mesh_of(vtk->grid);
    if (vtk->foam) vtk->foam->find_points(vtk->grid);
  });
}

VtkInput::~VtkInput() = default;

/* ---------------------------------------------------------------------- */

// All data sets of a step, in one grid.
void VtkInput::read(int step)
{
  if (vtk->grid && step == vtk->step) return;
  vtk->step = step;
  by_vtk(file, [&] {
    if (steps.empty())
      vtk->reader->Update();
    else
      vtk->reader->UpdateTimeStep(steps[step]);
    join_blocks();
  });
}

void VtkInput::join_blocks()
{
  auto *data = vtk->reader->GetOutputDataObject(0);
  std::vector<vtkDataSet *> sets;
  size_t patch = 0;
  if (auto *blocks = vtkMultiBlockDataSet::SafeDownCast(data)) {
    vtkSmartPointer<vtkDataObjectTreeIterator> it;
    it.TakeReference(blocks->NewTreeIterator());
    it->VisitOnlyLeavesOn();
    for (it->InitTraversal(); !it->IsDoneWithTraversal(); it->GoToNextItem()) {
      auto *set = vtkDataSet::SafeDownCast(it->GetCurrentDataObject());
      if (!set) continue;
      check_cells(file, set);
      if (auto *faces = vtk->foam ? vtkPolyData::SafeDownCast(set) : nullptr) {
        const char *name = it->GetCurrentMetaData()->Get(vtkCompositeDataSet::NAME());
        vtk->foam->set_patch(patch++, name ? name : "", faces);
      } else
        sets.push_back(set);
    }
  } else if (auto *set = vtkDataSet::SafeDownCast(data)) {
    check_cells(file, set);
    sets.push_back(set);
  }
  if (sets.empty()) stop(file, "cannot be read, or holds no mesh");

  // surfaces beside a mesh in space are no part of it, and need not have its fields
  std::vector<int> dimensions;
  dimensions.reserve(sets.size());
  for (auto *set : sets) dimensions.push_back(dimension_of(set));
  const int dim = *std::max_element(dimensions.begin(), dimensions.end());
  vtkNew<vtkAppendFilter> append;
  append->MergePointsOn();
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
    if (vtk->foam) vtk->foam->set_on_patches(steps, result);
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
  if (vtk->foam)
    for (const int p : vtk->foam->wall_points()) result.push_back(cells.points[p]);
  if (!result.empty()) return result;
  const auto border = cells.on_border();
  for (size_t p = 0; p < border.size(); p++)
    if (border[p] && velocity.values[3 * p] == 0.0 && velocity.values[3 * p + 1] == 0.0 &&
        velocity.values[3 * p + 2] == 0.0)
      result.push_back(cells.points[p]);
  return result;
}

Surface VtkInput::wall_surface(const Field &velocity, double scale, double half_width) const
{
  Mesh scaled = cells;
  for (auto &p : scaled.points) p = scale * p;
  if (vtk->foam) return vtk->foam->wall_surface(scaled, half_width);
  const auto rests = [&](const std::vector<int> &corners) {
    for (const int p : corners)
      for (int c = 0; c < 3; c++)
        if (velocity.values[3 * p + c] != 0.0) return -1;
    return 0;
  };
  return mesh_walls(scaled, {"wall"}, rests, half_width);
}

}    // namespace flowgrid
