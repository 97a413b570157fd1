// flowgrid: maps the flow of a CFD mesh on a Cartesian grid, for fix flow/field file, and the
// distance to walls, for fix wall/levelset file.

#include "decimals.h"
#include "mapping.h"
#include "options.h"
#include "progress.h"
#include "report.h"
#include "shape_parser.h"
#include "surface_input.h"
#include "vtk_guard.h"
#include "vtk_input.h"
#include "vtkhdf_writer.h"
#include "wall_output.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <stdexcept>

using namespace flowgrid;

namespace {

// steps of the input that --times chooses
std::vector<int> choose_times(const Options &o, const std::vector<double> &steps)
{
  if (steps.empty()) {
    if (o.times.find(':') != std::string::npos)
      throw std::runtime_error(o.input + ": has no times, --times " + o.times + " is for a series");
    return {0};
  }
  if (o.times == "last") return {static_cast<int>(steps.size()) - 1};
  double from = -INFINITY, to = INFINITY;
  if (o.times != "all") {
    const size_t colon = o.times.find(':');
    if (colon == std::string::npos) usage("--times must be last, all or T0:T1, got " + o.times);
    if (colon > 0) from = number("--times", o.times.substr(0, colon).c_str());
    if (colon + 1 < o.times.size()) to = number("--times", o.times.substr(colon + 1).c_str());
  }
  std::vector<int> chosen;
  for (size_t k = 0; k < steps.size(); k++)
    if (steps[k] >= from && steps[k] <= to) chosen.push_back(static_cast<int>(k));
  if (chosen.empty())
    throw std::runtime_error(o.input + ": no time within --times " + o.times + "; there are " +
                             text_of(steps.front()) + " to " + text_of(steps.back()));
  return chosen;
}

// nodes from the lower bound on, the last one not beyond the upper; low, high: of the mesh
Grid make_grid(const Options &o, const Point &low, const Point &high, bool flat_mesh)
{
  Grid grid;
  const bool flat = flat_mesh || !std::isnan(o.planar);
  double nodes = 1.0;
  for (int c = 0; c < 3; c++) {
    double a = o.bounds.empty() ? low[c] : o.bounds[2 * c];
    double b = o.bounds.empty() ? high[c] : o.bounds[2 * c + 1];
    grid.spacing[c] = o.spacing[c];
    if (flat && c == 2) {
      if (o.periodic[2])
        throw std::runtime_error(o.output + ": --periodic z needs a grid in space");
      grid.origin[c] = flat_mesh ? low[2] : o.planar;
      if (!flat_mesh && !o.input.empty() && (o.planar < low[2] || o.planar > high[2]))
        throw std::runtime_error(o.input + ": --planar must lie within the mesh, " +
                                 text_of(low[2]) + " to " + text_of(high[2]) + ", got " +
                                 text_of(o.planar));
      continue;
    }
    if (b < low[c] || a > high[c])
      throw std::runtime_error(o.input + ": --bounds " + text_of(a) + " to " + text_of(b) +
                               " along " + std::string(1, "xyz"[c]) + " miss the mesh, which is " +
                               text_of(low[c]) + " to " + text_of(high[c]));
    const double count = std::floor((b - a) / o.spacing[c] + 1e-6) + 1.0;
    nodes *= count;
    if (!(nodes < 2e9))
      throw std::runtime_error(o.output + ": --spacing is too fine: more than 2e9 nodes");
    if (count < 2.0)
      throw std::runtime_error(o.output + ": --spacing " + text_of(o.spacing[c]) + " along " +
                               std::string(1, "xyz"[c]) + " is wider than the bounds, " +
                               text_of(b - a));
    if (o.periodic[c] && std::fabs(b - a - (count - 1.0) * o.spacing[c]) > 1e-6 * o.spacing[c])
      throw std::runtime_error(o.output + ": --periodic " + std::string(1, "xyz"[c]) +
                               " needs a --spacing that divides the length of the grid, " +
                               text_of(b - a));
    grid.n[c] = static_cast<int>(count);
    grid.origin[c] = a;
  }
  return grid;
}

Grid make_grid(const Options &o, const Mesh &mesh)
{
  Point low, high;
  low.fill(1e300);
  high.fill(-1e300);
  for (const auto &p : mesh.points)
    for (int c = 0; c < 3; c++) {
      low[c] = std::min(low[c], p[c]);
      high[c] = std::max(high[c], p[c]);
    }
  return make_grid(o, low, high, mesh.dim() == 2);
}

// Where no wall is known, or none lies within the grid, the slip is unknown and not 0.
void tell_slip(size_t wall_points, const Quality &q)
{
  if (wall_points == 0)
    printf("walls    no walls known: no patch is one, and no point of the border rests\n");
  else if (q.walls_seen == 0)
    printf("walls    %zu points, none of them within the grid\n", wall_points);
  else
    printf("walls    %s%zu points; largest velocity there / largest: %.2e\n",
           q.walls_seen == wall_points ? "" : (std::to_string(q.walls_seen) + " of ").c_str(),
           wall_points, q.slip);
}

// Told before a mesh is read and mapped, which may take long: what is wrong with the words that
// name walls, and surfaces that would be written over.
void check_walls(const Options &o)
{
  for (const auto &words : o.surfaces) {
    const SurfaceWords surface(words);
    std::error_code none;
    if (std::filesystem::equivalent(surface.file, o.isosurface, none))
      throw std::runtime_error(o.isosurface + ": --isosurface would write over the file of " +
                               "--wall-surface " + words);
  }
  ShapeTree solids;
  const Periods periods(o.periodic, Grid());    // any grid: it decides only where copies are
  for (const auto &shape : o.shapes) parse_shape(shape, periods, solids);
}

void map(const Options &o)
{
  using Clock = std::chrono::steady_clock;
  auto seconds = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  auto begin = Clock::now();
  show_progress("reading", 0.0);
  VtkInput input(o.input, o.walls, o.solution);
  Mesh mesh = input.mesh();
  for (auto &p : mesh.points)
    for (double &x : p) x *= o.scale;
  const auto steps = choose_times(o, input.times());
  const Grid grid = make_grid(o, mesh);
  end_progress();
  printf("mesh     %d cells, %zu points, in %s; read in %.2f s\n", mesh.size(), mesh.points.size(),
         mesh.dim() == 2 ? "the plane" : "space", seconds(begin));

  begin = Clock::now();
  const Mapping mapping(mesh, grid);
  const size_t inside = mapping.count_inside();
  end_progress();
  printf(
      "grid     %d x %d x %d nodes, %zu inside (%.1f %%); %.2f cells walked per node, %lld nodes "
      "searched in bins; mapped in %.2f s\n",
      grid.n[0], grid.n[1], grid.n[2], inside, 100.0 * inside / grid.nodes(),
      static_cast<double>(mapping.walked) / grid.nodes(), static_cast<long long>(mapping.searched),
      seconds(begin));
  if (!inside) throw std::runtime_error(o.input + ": no node of the grid lies within the mesh");

  begin = Clock::now();
  std::vector<double> times;
  if (steps.size() > 1)
    for (const int k : steps) times.push_back(input.times()[k]);
  VtkhdfWriter writer(o.output, grid, times, o.compress);
  std::vector<double> mark(grid.nodes());
  for (size_t node = 0; node < grid.nodes(); node++) mark[node] = mapping.inside(node);
  for (size_t frame = 0; frame < steps.size(); frame++) {
    show_progress("writing", 1.0 * frame / steps.size());
    const Field u = input.velocity(steps[frame], o.velocity);
    const auto mapped = mapping.apply(u.values, 3);
    writer.write("velocity", 3, static_cast<int>(frame), mapped);
    writer.write("inside", 1, static_cast<int>(frame), mark);
    const Field p = input.pressure(steps[frame], o.pressure);
    if (p.components)
      writer.write("pressure", 1, static_cast<int>(frame), mapping.apply(p.values, 1));
    if (frame + 1 < steps.size()) continue;
    auto walls = input.wall_points(u);
    for (auto &x : walls)
      for (double &c : x) c *= o.scale;
    if (grid.n[2] == 1)
      for (auto &x : walls) x[2] = grid.origin[2];
    const auto q = quality(mapping, mapped, walls);
    end_progress();
    printf("velocity %s, largest %.6g; divergence x spacing / largest: max %.2e, rms %.2e\n",
           u.name.c_str(), q.fastest, q.divergence_max, q.divergence_rms);
    tell_slip(walls.size(), q);
  }
  show_progress("writing", 1.0);
  end_progress();
  printf("written in %.2f s\n", seconds(begin));
  if (o.mesh_walls) {
    const Surface walls = input.wall_surface(input.velocity(steps.back(), o.velocity), o.scale,
                                             strip_half_width(o, grid));
    if (walls.triangles.empty())
      throw std::runtime_error(o.input +
                               ": has no walls for --distance within the grid: no patch "
                               "is one, and the flow rests nowhere on the border");
    write_walls(o, grid, &walls, writer);
  } else if (o.has_walls())
    write_walls(o, grid, nullptr, writer);
  writer.close();
  printf("output   %s, %zu time(s)\n", o.output.c_str(), steps.size());
}

// walls without a flow
void map_walls(const Options &o)
{
  const Point low{o.bounds[0], o.bounds[2], o.bounds[4]},
      high{o.bounds[1], o.bounds[3], o.bounds[5]};
  const Grid grid = make_grid(o, low, high, false);
  printf("grid     %d x %d x %d nodes\n", grid.n[0], grid.n[1], grid.n[2]);
  VtkhdfWriter writer(o.output, grid, {}, o.compress);
  write_walls(o, grid, nullptr, writer);
  writer.close();
  printf("output   %s\n", o.output.c_str());
}

}    // namespace

int main(int argc, char **argv)
{
  const Options options = parse(argc, argv);
  guard_against_files();
  try {
    check_walls(options);
    if (options.input.empty())
      map_walls(options);
    else
      map(options);
  } catch (const std::bad_alloc &) {
    end_progress();
    fprintf(stderr, "flowgrid: %s: there is not enough memory for a grid of this --spacing\n",
            options.output.c_str());
    return 1;
  } catch (const std::exception &error) {
    end_progress();
    fprintf(stderr, "flowgrid: %s\n", error.what());
    return 1;
  }
  return 0;
}
