// libFuzzer: bytes as the words of flowgrid --shape. They are refused with a mark under the word,
// or make solids with a distance. Built and run by unittest/fuzz/run.

#include "require.h"

#include "shape_parser.h"
#include "shape_wall.h"

#include <cmath>
#include <stdexcept>

namespace {

flowgrid::Grid small_grid()
{
  flowgrid::Grid grid;
  for (int k = 0; k < 3; k++) {
    grid.n[k] = 5;
    grid.origin[k] = -2.0;
    grid.spacing[k] = 1.0;
  }
  return grid;
}

void build_wall(const flowgrid::ShapeTree &tree, const flowgrid::Grid &grid,
                const flowgrid::Periods &periods)
{
  try {
    const flowgrid::ShapeWall wall(tree, grid, periods, 0.5);
    for (const double x : {-2.0, 0.0, 0.3, 2.0}) {
      const double distance = wall.distance({x, 0.1, 0.2}, 3.0);    // unknown if farther
      fuzz::require(std::isnan(distance) || std::fabs(distance) <= 3.0, "a distance in its limit");
    }
  } catch (const std::runtime_error &error) {
    fuzz::require(error.what()[0] != '\0', "a message");
  }
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  const std::string text(reinterpret_cast<const char *>(data), size);
  if (text.find('\0') != std::string::npos) return -1;    // a word of the shell holds none
  const auto grid = small_grid();
  const flowgrid::Periods periods({size % 2 == 1, false, size % 3 == 1}, grid);
  flowgrid::ShapeTree tree;
  try {
    flowgrid::parse_shape(text, periods, tree);
  } catch (const std::runtime_error &error) {
    fuzz::require_reason(error.what(), {"--shape: ", "names of walls take"});
    fuzz::tally.count(false);
    return 0;
  }
  fuzz::tally.count(true);
  if (tree.carriers.size() <= 8) build_wall(tree, grid, periods);
  return 0;
}
