#include "wall_output.h"

#include "facet_wall.h"
#include "isosurface.h"
#include "level_set.h"
#include "progress.h"
#include "shape_parser.h"
#include "shape_wall.h"
#include "surface_input.h"
#include "wall_report.h"

#include <chrono>
#include <cstdio>
#include <stdexcept>

namespace flowgrid {

namespace {

  constexpr double degree = 3.14159265358979323846 / 180.0;

  // Widths that follow from the options                                              [length]
  struct Widths {
    double widest, exact, band;    // spacing, exact distances, band

    Widths(const Options &o, const Grid &grid)
    {
      widest = *std::max_element(grid.spacing.begin(), grid.spacing.begin() + dims_of(grid));
      exact = o.exact > 0.0 ? o.exact : std::max(o.particle, 4.0 * widest);
      band = std::max(o.band * widest, exact);
    }
    static int dims_of(const Grid &grid) { return grid.n[2] == 1 ? 2 : 3; }
  };

  std::unique_ptr<Wall> facet_wall(const Options &o, const Grid &grid, Surface surface,
                                   const std::string &what)
  {
    const Widths width(o, grid);
    const Periods periods(o.periodic, grid);
    try {
      auto done = make_whole(surface, grid);
      if (grid.n[2] == 1 && !surface.is_strip) {
        surface = cut_at(surface, SmoothSurface(surface, o.crease * degree), grid.origin[2],
                         strip_half_width(o, grid));
        make_whole(surface, grid);
      }
      const int count = static_cast<int>(surface.triangles.size());
      surface.add_copies(periods.shifts());
      make_whole(surface, grid);
      auto wall = std::make_unique<FacetWall>(surface, grid, o.crease * degree, width.band);
      if (!o.fluid_at.empty() && !surface.may_end) {
        const Point x{o.fluid_at[0], o.fluid_at[1],
                      grid.n[2] == 1 ? grid.origin[2] : o.fluid_at[2]};
        if (wall->distance(x, 1e300) < 0.0) {
          for (auto &t : surface.triangles) std::swap(t[1], t[2]);
          wall = std::make_unique<FacetWall>(surface, grid, o.crease * degree, width.band);
        }
      }
      end_progress();
      printf("%s: %d triangles; %d duplicate and %d degenerate ones removed, %d turned round; "
             "facets bulge by up to %.2e\n",
             what.c_str(), count, done.duplicate, done.degenerate, done.turned, wall->bulge());
      return wall;
    } catch (const std::runtime_error &error) {
      throw std::runtime_error(what + ": " + error.what());
    }
  }

  std::unique_ptr<Wall> make_wall(const Options &o, const Grid &grid, const Surface *mesh)
  {
    auto wall = std::make_unique<JointWall>();
    if (mesh) wall->add(facet_wall(o, grid, *mesh, "walls of the mesh"));
    if (!o.surfaces.empty()) {
      Surface surface;
      std::string names;
      for (const auto &words : o.surfaces) {
        read_surface(SurfaceWords(words), o.scale, surface);
        names += (names.empty() ? "" : ", ") + words;
      }
      wall->add(facet_wall(o, grid, std::move(surface), names));
    }
    if (!o.shapes.empty()) {
      const Periods periods(o.periodic, grid);
      ShapeTree solids;
      for (const auto &text : o.shapes) parse_shape(text, periods, solids);
      wall->add(std::make_unique<ShapeWall>(std::move(solids),
                                            periods.widened(grid, Widths(o, grid).exact), periods,
                                            o.crease * degree));
    }
    return wall;
  }

  // where a piece is, so that one can tell which is which
  void tell_place(const std::string &array, const Wall::Piece &piece, const Grid &grid)
  {
    printf("%s: %s at", array.c_str(), piece.zone.c_str());
    for (int c = 0; c < Widths::dims_of(grid); c++) {
      const double first = grid.origin[c], last = first + (grid.n[c] - 1) * grid.spacing[c];
      const double low = std::max(piece.bounds.low[c], first);
      const double high = std::min(piece.bounds.high[c], last);
      printf(" %c = %.6g", "xyz"[c], low);
      if (high - low > 1e-6 * grid.spacing[c]) printf(" to %.6g", high);
    }
    printf("\n");
  }

  void report(const Options &o, const Grid &grid, const Wall &wall, const LevelSet &levels,
              double exact, double widest, double band)
  {
    const double contact = o.particle > 0.0 ? 0.5 * o.particle : std::min(exact, 2.0 * widest);
    const double high = std::min(contact + 0.5 * widest, exact);
    for (const auto &array : levels.arrays()) {
      for (const int piece : array.pieces) tell_place(array.name, wall.pieces()[piece], grid);
      const auto q = wall_quality(wall, grid, levels, array, std::max(contact - 0.5 * widest, 0.0),
                                  high, band);
      end_progress();
      printf("%s: size of slope less 1: max %.2e, rms %.2e; largest error %.2e of distances near "
             "%.3g at %.6g %.6g %.6g (%d points); surface known to %.2e\n",
             array.name.c_str(), q.slope_max, q.slope_rms, q.error, contact, q.error_at[0],
             q.error_at[1], q.error_at[2], q.points, array.surface_error);
    }
    if (o.particle == 0.0) return;
    const auto narrow = find_narrows(grid, levels.whole(), o.particle);
    const auto warn = [&](const char *what, double width, const Point &at) {
      if (std::isfinite(width))
        printf("warning  %s narrower than a particle: %.3g wide at %.6g %.6g %.6g\n", what, width,
               at[0], at[1], at[2]);
    };
    warn("a gap is", narrow.gap, narrow.gap_at);
    warn("a solid is", narrow.solid, narrow.solid_at);
  }

}    // namespace

double strip_half_width(const Options &o, const Grid &grid)
{
  return 4.0 * Widths(o, grid).band;
}

void write_walls(const Options &o, const Grid &grid, const Surface *mesh, VtkhdfWriter &writer)
{
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const auto seconds = [&] {
    return std::chrono::duration<double>(Clock::now() - begin).count();
  };
  const auto [widest, exact, band] = Widths(o, grid);
  show_progress("walls", 0.0);
  const auto wall = make_wall(o, grid, mesh);
  const LevelSet levels(*wall, grid, Periods(o.periodic, grid), exact, band);
  end_progress();
  printf("wall     %zu piece(s) in %zu array(s); %zu nodes of exact distance, up to %.6g; band "
         "%.6g; in %.2f s\n",
         wall->pieces().size(), levels.arrays().size(), levels.exact_nodes(), exact, band,
         seconds());
  for (const auto &warning : wall->warnings()) printf("warning  %s\n", warning.c_str());

  double surface_error = 0.0;
  for (const auto &array : levels.arrays()) {
    writer.write_distance(array.name, array.values, array.surface_error);
    surface_error = std::max(surface_error, array.surface_error);
  }
  writer.write_distance("distance", levels.whole(), surface_error);
  report(o, grid, *wall, levels, exact, widest, band);
  if (o.isosurface.empty()) return;
  const long triangles = write_isosurface(o.isosurface, grid, levels.whole());
  printf("surface  %s, %ld triangles\n", o.isosurface.c_str(), triangles);
}

}    // namespace flowgrid
