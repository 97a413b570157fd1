#include "options.h"
#include "decimals.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <set>

namespace flowgrid {

static const char *const help = R"(usage: flowgrid INPUT OUTPUT.vtkhdf --spacing H [options]
       flowgrid OUTPUT.vtkhdf --spacing H --bounds ... --shape ... [options]

Maps the velocity (and pressure) of a flow computed on any mesh to a Cartesian grid, and writes the
signed distance to walls.

INPUT   an OpenFOAM case (folder or .foam file), .vtm .vts .vtu .vti .vtr .vtk, CGNS, or the grid of
        PLOT3D (.xyz .x .p3d, with --solution)
OUTPUT  VTKHDF ImageData for fix flow/field file and fix wall/levelset file; ParaView opens it

  --spacing H | HX HY HZ     distance of nodes [length of the mesh, after --scale]
  --bounds X0 X1 Y0 Y1 Z0 Z1 part to be mapped (default: all of the mesh; planes ignore Z)
  --planar Z                 one layer of nodes at this z, of a mesh in space
  --velocity NAME            array of the velocity (default U, velocity, Velocity or u)
  --pressure NAME            array of the pressure (default p, pressure or Pressure, if any)
  --times last | all | T0:T1 which times of a series (default last); several become a series
  --scale S                  factor of all lengths of the mesh and of surfaces (default 1)
  --wall NAME                patch of an OpenFOAM case that is a wall besides those of type wall;
                             may be repeated
  --solution FILE            PLOT3D's solution file
  --compress                 deflate the arrays
  --help                     this text

Walls, of which signed distances are written, > 0 in the fluid:
  --distance                 those of the mesh
  --wall-surface FILE[:NAME] triangles of an .stl, .vtp or .obj file; may be repeated
  --shape "NAME: SHAPE"      a solid; may be repeated. SHAPE is
                               box(X1,Y1,Z1, X2,Y2,Z2), sphere(X,Y,Z, R),
                               cylinder(X1,Y1,Z1, X2,Y2,Z2, R), plane(X,Y,Z, NX,NY,NZ) solid behind,
                               rectangle(X1,Y1, X2,Y2), disc(X,Y, R), polygon(X1,Y1, X2,Y2, ...)
                               without ends along z, extrude(Z1,Z2, SHAPE), inside(SHAPE) for fluid
                               inside, union, intersection, difference(SHAPE, SHAPE, ...)
  --fluid-at X Y Z           a point in the fluid, which tells which side of surfaces is
  --particle D               largest diameter of particles; features narrower than it are named
  --exact W                  distances up to W are exact (default: D, or 4 cells)
  --band N                   width of the band, cells (default 20)
  --crease DEGREES           walls that turn by more toward the fluid are cut there (default 30)
  --periodic x | y | z | xy  walls repeat themselves along these axes with the length of the grid
  --isosurface FILE          .vtp or .stl: the wall as triangles

Exit status: 0 done, 1 input or output cannot be used, 2 wrong words.
)";

void usage(const std::string &why)
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

static bool ends_in(const std::string &name, const std::string &end)
{
  return name.size() >= end.size() && name.compare(name.size() - end.size(), end.size(), end) == 0;
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
    list.reserve(count);
    for (int k = 0; k < count; k++) list.push_back(number(option, value(option)));
    return list;
  };
  auto positive = [&](const std::string &option) {
    const double x = number(option, value(option));
    if (!(x > 0.0)) usage(option + " must be > 0, got " + std::string(argv[i]));
    return x;
  };
  auto is_number = [&](int k) {
    char *end;
    return k < argc && (strtod(argv[k], &end), end != argv[k] && !*end);
  };
  const std::set<std::string> repeatable{"--wall", "--shape", "--wall-surface", "--periodic"};
  std::set<std::string> given;
  for (; i < argc; i++) {
    const std::string word = argv[i];
    if (word.compare(0, 2, "--") == 0 && !repeatable.count(word) && !given.insert(word).second)
      usage(word + " is given twice");
    if (word == "--help" || word == "-h") {
      fputs(help, stdout);
      exit(0);
    } else if (word == "--spacing") {
      o.spacing = numbers(word, is_number(i + 2) ? 3 : 1);
      for (double h : o.spacing)
        if (!(h > 0.0)) usage("--spacing must be > 0, got " + text_of(h));
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
      o.scale = positive(word);
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
    } else if (word == "--shape") {
      o.shapes.push_back(value(word));
    } else if (word == "--wall-surface") {
      o.surfaces.push_back(value(word));
    } else if (word == "--isosurface") {
      o.isosurface = value(word);
    } else if (word == "--fluid-at") {
      o.fluid_at = numbers(word, 3);
    } else if (word == "--particle") {
      o.particle = positive(word);
    } else if (word == "--exact") {
      o.exact = positive(word);
    } else if (word == "--band") {
      o.band = positive(word);
      if (o.band < 4.0) usage("--band must be 4 cells or more, got " + std::string(argv[i]));
    } else if (word == "--crease") {
      o.crease = positive(word);
      if (o.crease >= 180.0) usage("--crease must be < 180, got " + std::string(argv[i]));
    } else if (word == "--periodic") {
      for (const char axis : std::string(value(word))) {
        if (axis < 'x' || axis > 'z')
          usage("--periodic takes x, y, z, got " + std::string(argv[i]));
        o.periodic[axis - 'x'] = true;
      }
    } else if (word == "--distance") {
      o.mesh_walls = true;
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
  if (o.output.empty() && o.has_walls() && !o.mesh_walls) std::swap(o.input, o.output);
  if (o.output.empty()) usage("INPUT and OUTPUT are needed");
  // whoever mixes up the names would lose a mesh
  if (!ends_in(o.output, ".vtkhdf")) usage("OUTPUT must end in .vtkhdf, got " + o.output);
  if (o.input.empty() && o.bounds.empty()) usage("a geometry without a flow needs --bounds");
  if (!o.isosurface.empty() && !o.has_walls())
    usage("--isosurface needs walls: --distance, --shape or --wall-surface");
  if (!o.isosurface.empty() && !ends_in(o.isosurface, ".vtp") && !ends_in(o.isosurface, ".stl"))
    usage("--isosurface must end in .vtp or .stl, got " + o.isosurface);
  if (o.spacing.empty()) usage("--spacing is needed");
  return o;
}

}    // namespace flowgrid
