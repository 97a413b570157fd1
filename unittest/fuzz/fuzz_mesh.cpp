// libFuzzer: bytes as a flow that flowgrid reads by VTK (FUZZ_ENDING: .vts, .cgns and so on). It is
// refused by a message with its name, or its fields are finite, mapped on a grid. Built and run by
// unittest/fuzz/run.
//
// Several files are one input, each behind a line "//// NAME": the files of an OpenFOAM case, grid
// and solution of PLOT3D, and a .vtm with its blocks.

#include "input_folder.h"
#include "require.h"

#include "mapping.h"
#include "vtk_input.h"

#include <cmath>
#include <stdexcept>

namespace {

const std::string ending = FUZZ_ENDING;
std::string path;    // of the input

std::string place(const fuzz::InputFolder &folder, const unsigned char *data, std::size_t size)
{
  const std::string all(reinterpret_cast<const char *>(data), size);
  if (ending != ".foam" && ending != ".xyz" && ending != ".vtm")
    return folder.write("input" + ending, data, size);
  folder.clear();
  for (const char *name :
       {"input.foam", "input.xyz", "input.q", "input.vtm", "input/input_0.vts", "input/input_1.vti",
        "system/controlDict", "constant/polyMesh/boundary", "constant/polyMesh/points",
        "constant/polyMesh/faces", "constant/polyMesh/owner", "constant/polyMesh/neighbour", "4/U",
        "4/p"}) {
    const std::string head = std::string("//// ") + name + "\n";
    const std::size_t at = all.find(head);
    if (at == std::string::npos) continue;
    const std::size_t begin = at + head.size(),
                      end = std::min(all.find("\n//// ", begin), all.size());
    folder.write(name, data + begin, end - begin);
  }
  return folder / ("input" + ending);
}

void map(flowgrid::VtkInput &input)
{
  const auto u = input.velocity(0, ""), p = input.pressure(0, "");
  for (const double value : u.values) fuzz::require(std::isfinite(value), "a finite velocity");
  for (const double value : p.values) fuzz::require(std::isfinite(value), "a finite pressure");
  const auto &mesh = input.mesh();
  fuzz::require(u.values.size() == 3 * mesh.points.size(), "a velocity at each point");
  flowgrid::Grid grid;
  grid.n = {4, 4, mesh.dim() == 2 ? 1 : 4};
  grid.spacing = {0.3, 0.3, 0.3};
  const flowgrid::Mapping mapping(mesh, grid);
  for (const double value : mapping.apply(u.values, 3))
    fuzz::require(std::isfinite(value), "a finite velocity on the grid");
  input.wall_points(u);
  try {
    input.wall_surface(u, 1.0, 0.1);
  } catch (const std::runtime_error &error) {
    fuzz::require(error.what()[0] != '\0', "a message");
  }
}

}    // namespace

#ifdef FUZZ_CGNS
// CGNS's library, which is within VTK's, ends the program where it does not know a file, with the
// empty one to begin with; the program itself answers that at its exit.
extern "C" void vtkcgns_cgio_error_exit(const char *what)
{
  throw std::runtime_error(path + ": " + (what ? what : ""));
}
extern "C" int vtkcgns_cgio_cleanup() __attribute__((weak));    // closes what is left open
#endif

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  static const fuzz::InputFolder folder;
  path = place(folder, data, size);
  bool right = false;
  try {
    flowgrid::VtkInput input(path, {}, ending == ".xyz" ? folder / "input.q" : "");
    map(input);
    right = true;
  } catch (const std::bad_alloc &) {    // the program names the file
  } catch (const std::runtime_error &error) {
    fuzz::require_reason(error.what(), {(folder / "input").c_str()});
  }
  fuzz::tally.count(right);
#ifdef FUZZ_CGNS
  if (vtkcgns_cgio_cleanup) vtkcgns_cgio_cleanup();
#endif
  return 0;
}
