// flowgrid: maps the flow of a CFD mesh on a Cartesian grid, for fix flow/field file.

#include "mapping.h"
#include "report.h"
#include "vtk_input.h"
#include "vtkhdf_writer.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <unistd.h>

using namespace flowgrid;

namespace {

const char *const help = R"(usage: flowgrid INPUT OUTPUT.vtkhdf --spacing H [options]

Maps the velocity (and pressure) of a flow computed on any mesh to a Cartesian grid.

INPUT   an OpenFOAM case (folder or .foam file), .vtm .vts .vtu .vti .vtr .vtk, CGNS, or the grid of
        PLOT3D (.xyz .x .p3d, with --solution)
OUTPUT  VTKHDF ImageData for fix flow/field file; ParaView opens it

  --spacing H | HX HY HZ     distance of nodes [length of the mesh, after --scale]
  --bounds X0 X1 Y0 Y1 Z0 Z1 part to be mapped (default: all of the mesh; planes ignore Z)
  --planar Z                 one layer of nodes at this z, of a mesh in space
  --velocity NAME            array of the velocity (default U, velocity, Velocity or u)
  --pressure NAME            array of the pressure (default p, pressure or Pressure, if any)
  --times last | all | T0:T1 which times of a series (default last); several become a series
  --scale S                  factor of all lengths of the mesh (default 1), not of velocities
  --wall NAME                patch of an OpenFOAM case that is a wall besides those of type wall;
                             may be repeated
  --solution FILE            PLOT3D's solution file
  --compress                 deflate the arrays
  --help                     this text

Exit status: 0 done, 1 input or output cannot be used, 2 wrong words.
)";

struct Options {
  std::string input, output, velocity, pressure, times = "last", solution;
  std::vector<double> spacing, bounds;
  std::vector<std::string> walls;
  double planar = NAN, scale = 1.0;
  bool compress = false;
};

[[noreturn]] void usage(const std::string &why)
{
  fprintf(stderr, "flowgrid: %s\nflowgrid --help shows all options\n", why.c_str());
  exit(2);
}

double number(const std::string &option, const char *word)
{
  char *end;
  const double value = strtod(word, &end);
  if (end == word || *end || !std::isfinite(value)) usage(option + " takes a number, got " + word);
  return value;
}

Options parse(int argc, char **argv)
{
  Options o;
  int i = 1;
  auto value = [&](const std::string &option) {
    if (i + 1 >= argc) usage(option + " needs a value");
    return argv[++i];
  };
  auto numbers = [&](const std::string &option, int count) {
    std::vector<double> list;
    for (int k = 0; k < count; k++) list.push_back(number(option, value(option)));
    return list;
  };
  auto is_number = [&](int k) {
    char *end;
    return k < argc && (strtod(argv[k], &end), end != argv[k] && !*end);
  };
  for (; i < argc; i++) {
    const std::string word = argv[i];
    if (word == "--help" || word == "-h") {
      fputs(help, stdout);
      exit(0);
    } else if (word == "--spacing") {
      o.spacing = numbers(word, is_number(i + 2) ? 3 : 1);
      for (double h : o.spacing)
        if (!(h > 0.0)) usage("--spacing must be > 0, got " + std::to_string(h));
      if (o.spacing.size() == 1) o.spacing.resize(3, o.spacing[0]);
    } else if (word == "--bounds") {
      o.bounds = numbers(word, 6);
      for (int c = 0; c < 3; c++)
        if (o.bounds[2 * c + 1] < o.bounds[2 * c])
          usage("--bounds: the upper bound along " + std::string(1, "xyz"[c]) +
                " must not be below the lower one");
    } else if (word == "--planar") {
      o.planar = number(word, value(word));
    } else if (word == "--scale") {
      o.scale = number(word, value(word));
      if (!(o.scale > 0.0)) usage("--scale must be > 0, got " + std::string(argv[i]));
    } else if (word == "--velocity") {
      o.velocity = value(word);
    } else if (word == "--pressure") {
      o.pressure = value(word);
    } else if (word == "--times") {
      o.times = value(word);
    } else if (word == "--solution") {
      o.solution = value(word);
    } else if (word == "--wall") {
      o.walls.push_back(value(word));
    } else if (word == "--compress") {
      o.compress = true;
    } else if (word.compare(0, 2, "--") == 0) {
      usage("there is no option " + word);
    } else if (o.input.empty()) {
      o.input = word;
    } else if (o.output.empty()) {
      o.output = word;
    } else
      usage("one INPUT and one OUTPUT, got also " + word);
  }
  if (o.output.empty()) usage("INPUT and OUTPUT are needed");
  if (o.spacing.empty()) usage("--spacing is needed");
  return o;
}

// steps of the input that --times chooses
std::vector<int> choose_times(const Options &o, const std::vector<double> &steps)
{
  if (steps.empty()) return {0};
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
                             std::to_string(steps.front()) + " to " + std::to_string(steps.back()));
  return chosen;
}

// nodes from the lower bound on, the last one not beyond the upper
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
  Grid grid;
  const bool flat = mesh.dim() == 2 || !std::isnan(o.planar);
  double nodes = 1.0;
  for (int c = 0; c < 3; c++) {
    double a = o.bounds.empty() ? low[c] : o.bounds[2 * c];
    double b = o.bounds.empty() ? high[c] : o.bounds[2 * c + 1];
    grid.spacing[c] = o.spacing[c];
    if (flat && c == 2) {
      grid.origin[c] = mesh.dim() == 2 ? low[2] : o.planar;
      if (mesh.dim() == 3 && (o.planar < low[2] || o.planar > high[2]))
        throw std::runtime_error(o.input + ": --planar must lie within the mesh, " +
                                 std::to_string(low[2]) + " to " + std::to_string(high[2]) +
                                 ", got " + std::to_string(o.planar));
      continue;
    }
    if (b < low[c] || a > high[c])
      throw std::runtime_error(o.input + ": --bounds " + std::to_string(a) + " to " +
                               std::to_string(b) + " along " + std::string(1, "xyz"[c]) +
                               " miss the mesh, which is " + std::to_string(low[c]) + " to " +
                               std::to_string(high[c]));
    const double count = std::floor((b - a) / o.spacing[c] + 1e-6) + 1.0;
    nodes *= count;
    if (!(nodes < 2e9))
      throw std::runtime_error(o.input + ": --spacing is too fine: more than 2e9 nodes");
    if (count < 2.0)
      throw std::runtime_error(o.input + ": --spacing " + std::to_string(o.spacing[c]) + " along " +
                               std::string(1, "xyz"[c]) + " is wider than the bounds, " +
                               std::to_string(b - a));
    grid.n[c] = static_cast<int>(count);
    grid.origin[c] = a;
  }
  return grid;
}

void show_progress(double done)
{
  static int shown = -1;
  const int percent = static_cast<int>(100.0 * done);
  if (!isatty(2) || percent == shown) return;
  shown = percent;
  fprintf(stderr, "\rmapping %3d %% [%-40.*s]%s", percent, percent * 40 / 100,
          "########################################", percent == 100 ? "\n" : "");
}

void map(const Options &o)
{
  using Clock = std::chrono::steady_clock;
  auto seconds = [](Clock::time_point since) {
    return std::chrono::duration<double>(Clock::now() - since).count();
  };
  auto begin = Clock::now();
  VtkInput input(o.input, o.walls, o.solution);
  Mesh mesh = input.mesh();
  for (auto &p : mesh.points)
    for (double &x : p) x *= o.scale;
  const auto steps = choose_times(o, input.times());
  const Grid grid = make_grid(o, mesh);
  printf("mesh     %d cells, %zu points, in %s; read in %.2f s\n", mesh.size(), mesh.points.size(),
         mesh.dim() == 2 ? "the plane" : "space", seconds(begin));

  begin = Clock::now();
  const Mapping mapping(mesh, grid, show_progress);
  const size_t inside = mapping.count_inside();
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
    printf("velocity %s, largest %.6g; divergence x spacing / largest: max %.2e, rms %.2e\n"
           "walls    %zu points; largest velocity there / largest: %.2e\n",
           u.name.c_str(), q.fastest, q.divergence_max, q.divergence_rms, walls.size(), q.slip);
  }
  writer.close();
  printf("output   %s, %zu time(s); written in %.2f s\n", o.output.c_str(), steps.size(),
         seconds(begin));
}

}    // namespace

int main(int argc, char **argv)
{
  const Options options = parse(argc, argv);
  try {
    map(options);
  } catch (const std::exception &error) {
    fprintf(stderr, "flowgrid: %s\n", error.what());
    return 1;
  }
  return 0;
}
