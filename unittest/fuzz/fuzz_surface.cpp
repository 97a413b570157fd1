// libFuzzer: bytes as a surface file of flowgrid (FUZZ_ENDING: .stl, .vtp or .obj). It is refused
// by a message with its name, or gives triangles of finite points, which are then made whole. Built
// and run by unittest/fuzz/run.

#include "input_folder.h"
#include "require.h"

#include "surface_input.h"

#include <cmath>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  static const fuzz::InputFolder folder;
  const std::string path = folder.write("input" FUZZ_ENDING, data, size);
  flowgrid::Surface surface;
  bool right = false;
  try {
    flowgrid::read_surface(flowgrid::SurfaceWords(path + ":wall"), 1.0, surface);
    right = true;
  } catch (const std::bad_alloc &) {    // the program names the file
  } catch (const std::runtime_error &error) {
    fuzz::require_reason(error.what(), {path.c_str()});
  }
  fuzz::tally.count(right);
  if (!right) return 0;
  for (const auto &point : surface.points)
    for (const double x : point) fuzz::require(std::isfinite(x), "points are finite");
  if (surface.triangles.size() > 1000) return 0;
  flowgrid::Grid grid;
  grid.n = {9, 9, 9};
  try {
    flowgrid::make_whole(surface, grid);
  } catch (const std::runtime_error &error) {
    fuzz::require(error.what()[0] != '\0', "a message");
  }
  return 0;
}
