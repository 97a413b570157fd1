#include "wall_grid.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "math_extra.h"
#include "restart_state.h"

#include "wall/isosurface.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

using namespace LAMMPS_NS;

static const std::string prefix = "distance_";
static constexpr double crease = 0.02;     // largest deviation of the slope's size from 1
static constexpr double flat = 1.0e-6;     // curvature that is rounding, in the same units
static constexpr double uniform = 0.02;    // spread of a curvature that counts as the same, in
                                           // units of the inverse radius of the largest particle
static constexpr double on_wall = 1e-6;    // farthest of a node on the wall, in spacings

/* ---------------------------------------------------------------------- */

WallGrid::WallGrid(LAMMPS *lmp, const char *command_in, const std::string &path_in,
                   const std::vector<std::string> &arrays, int largest_pieces, int iarg) :
    GridFile(lmp, command_in, path_in, iarg)
{
  choose(arrays, largest_pieces);
  // before the box is compared with a grid that may not be that of the arrays
  look([this] {
    for (const auto &piece : pieces) file->check(piece, 1);
  });
  make_lattice(false, "");
  size = apf::GridDistance::size(lattice);
  allocate(size * pieces.size());
  reaches.assign(pieces.size(), -std::numeric_limits<double>::infinity());
  jumps.assign(pieces.size(), {});
  for (size_t n = 0; n < pieces.size(); n++)
    attempt([&] {
      const auto nodes = nodes_of(read(pieces[n], 1), 1);
      jumps[n] = apf::GridDistance::write_coefficients(lattice, nodes, numbers.data() + n * size);
      reaches[n] = *std::max_element(nodes.begin(), nodes.end());
    });
  MPI_Allreduce(MPI_IN_PLACE, reaches.data(), reaches.size(), MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, jumps.data(), 3 * jumps.size(), MPI_DOUBLE, MPI_MAX, world);
  for (size_t n = 0; n < pieces.size(); n++)
    if (!(reaches[n] > 0.0))
      error->all(FLERR, position, "{} file {}: array {} is > 0 nowhere: it must be so in the fluid",
                 command, path, pieces[n]);
  close();
  position = Error::NOLASTLINE;
}

/* ---------------------------------------------------------------------- */

void WallGrid::choose(const std::vector<std::string> &wanted, int most)
{
  std::string list;    // with a zero behind each name
  look([&] {
    auto names = wanted;
    if (names.empty()) {
      for (const auto &name : file->arrays())
        if (name.compare(0, prefix.size(), prefix) == 0) names.push_back(name);
      std::sort(names.begin(), names.end());
    }
    if (names.empty()) names.push_back("distance");
    for (const auto &name : names) {
      for (const char c : name)
        if (!is_printable(c) || c == ' ')
          throw std::runtime_error("names of arrays must be of ASCII without blanks, got \"" +
                                   name + "\"");
      list += name + '\0';
    }
    digest.add(list.data(), list.size());
  });
  int length = list.size();
  MPI_Bcast(&length, 1, MPI_INT, 0, world);
  list.resize(length);
  MPI_Bcast(list.data(), length, MPI_CHAR, 0, world);
  for (size_t at = 0; at < list.size(); at += pieces.back().size() + 1)
    pieces.emplace_back(list.c_str() + at);
  if (static_cast<int>(pieces.size()) > most)
    error->all(FLERR, position, "{} file {}: it holds {} arrays {}*, at most {} are allowed",
               command, path, pieces.size(), prefix, most);
}

/* ---------------------------------------------------------------------- */

std::vector<std::string> WallGrid::names() const
{
  auto all = pieces;
  for (auto &name : all)
    if (name.compare(0, prefix.size(), prefix) == 0) name.erase(0, prefix.size());
  return all;
}

std::vector<apf::Surface> WallGrid::surfaces() const
{
  std::vector<apf::Surface> all;
  for (size_t n = 0; n < pieces.size(); n++)
    all.push_back(apf::Surface::gridded(
        apf::GridDistance(lattice, numbers.data() + n * size, jumps[n]), reaches[n]));
  return all;
}

// A piece where centres of particles come that are up to a distance from it.
apf::GridSurvey WallGrid::looked_at(const std::vector<apf::Surface> &all, int n, double smallest,
                                    double farthest) const
{
  apf::GridSurvey survey;
  const double finest = *std::min_element(lattice.spacing, lattice.spacing + lattice.dims);
  const double nearest = 0.9 * smallest;
  // a piece goes on behind others, where no particle comes
  const auto reached = [&](const double *x) {
    for (const auto &other : all)
      if (&other != &all[n] && other.grid.distance(x) < nearest - finest) return false;
    return true;
  };
  // the same, for fields that need not be distances: by the way along their slope, in the box
  const auto comes = [&](const double *x) {
    for (int k = 0; k < lattice.dims; k++)
      if (domain->boundary[k][0] == 1 && !(x[k] >= domain->boxlo[k] && x[k] <= domain->boxhi[k]))
        return false;
    for (const auto &one : all) {
      double slope[3];
      const double phi = one.grid.distance(x, slope);
      if (phi < (nearest - finest) * MathExtra::len3(slope)) return false;
    }
    return true;
  };
  if (comm->me == 0) {
    survey = apf::GridSurvey::of(lattice, all[n].grid, nearest, farthest, reached);
    survey.crosses = survey.nodes == 0 &&
        apf::GridSurvey::crossing(lattice, all[n].grid, smallest, comes, survey.crosses_at);
  }
  MPI_Bcast(&survey, sizeof(survey), MPI_BYTE, 0, world);
  return survey;
}

/* ----------------------------------------------------------------------
   centres of particles that touch are about a radius away
------------------------------------------------------------------------- */

void WallGrid::check(std::vector<apf::Surface> &all, double smallest, double largest,
                     double error_allowed) const
{
  const double widest = *std::max_element(lattice.spacing, lattice.spacing + lattice.dims);
  for (size_t n = 0; n < pieces.size(); n++) {
    const auto survey = looked_at(all, n, smallest, 1.05 * largest + widest);
    const std::string where = fmt::format("{} file {}: array {}", command, path, pieces[n]);
    const auto at = [](const double *x) {
      return fmt::format("({:.6g}, {:.6g}, {:.6g})", x[0], x[1], x[2]);
    };
    if (survey.nodes == 0) {
      const std::string none =
          fmt::format("{} has no node within {} to {} of the wall, where particles of these radii "
                      "would touch it",
                      where, smallest, largest);
      if (survey.crosses)
        error->all(FLERR, Error::NOLASTLINE,
                   "{}, although its sign changes at {}: it must be a distance, in the unit of the "
                   "diameters",
                   none, at(survey.crosses_at));
      if (comm->me == 0)
        error->warning(FLERR, "{}: do their diameters and the grid have the same unit?", none);
      continue;
    }
    // an edge's rim, seen from the distance of a radius, has a jump of curvature of 1/radius
    const double of_edges = std::max(error_allowed / (survey.edge_spacing * survey.edge_spacing),
                                     2.0 * apf::GridDistance::error_constant / smallest);
    const bool kinked = !(survey.edge_bend <= of_edges);
    if (!(survey.slope_error <= crease) || kinked)
      error->all(FLERR, Error::NOLASTLINE,
                 "{} is not a smooth distance at {}, where particles may touch: the size of its "
                 "slope differs from 1 by {:.2g}; concave corners need an array for each side, "
                 "edges a spacing below a third of a radius, {:.4g}, and gaps must be wider than "
                 "particles",
                 where, at(kinked ? survey.edge_at : survey.slope_at), survey.slope_error,
                 smallest / 3.0);
    if (!(survey.error <= error_allowed))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} is known to {:.3g} only at {}, where particles may touch, and {:.3g} is asked "
                 "for: use a spacing of {:.3g} instead of {:.3g}, or keyword resolution",
                 where, survey.error, at(survey.error_at), error_allowed,
                 0.95 * survey.error_spacing * std::pow(error_allowed / survey.error, 0.25),
                 survey.error_spacing);
    auto &surface = all[n];
    surface.uniform = std::max(survey.spread[0], survey.spread[1]) * largest < uniform;
    for (int c = 0; c < 2; c++) {
      const bool bends = std::fabs(survey.curvature[c]) * largest > flat;
      surface.curvature[c] = surface.uniform && bends ? survey.curvature[c] : 0.0;
    }
  }
}

void WallGrid::check_bridges(const std::vector<apf::Surface> &all, double smallest,
                             double farthest) const
{
  constexpr double of_clipping = 2.0;    // spacings that splines reach
  const double widest = *std::max_element(lattice.spacing, lattice.spacing + lattice.dims);
  for (size_t n = 0; n < pieces.size(); n++) {
    const std::string where = fmt::format("{} file {}: array {}", command, path, pieces[n]);
    const double needed = farthest + of_clipping * widest;
    if (!(all[n].reach >= needed))
      error->all(FLERR, Error::NOLASTLINE,
                 "{} knows distances up to {:.4g} from the wall, and liquid bridges hold particles "
                 "whose centres are up to {:.4g} from it: write the file with distances up to "
                 "{:.4g} or more",
                 where, all[n].reach, farthest, needed);
    const auto survey = looked_at(all, n, smallest, farthest);
    if (!(survey.slope_error <= crease))
      error->all(
          FLERR, Error::NOLASTLINE,
          "{} is not a smooth distance at ({:.6g}, {:.6g}, {:.6g}), where liquid bridges may "
          "hold particles: the size of its slope differs from 1 by {:.2g}; gaps must be "
          "wider than particles with bridges to both sides",
          where, survey.slope_at[0], survey.slope_at[1], survey.slope_at[2], survey.slope_error);
  }
}

/* ---------------------------------------------------------------------- */

static bool has_no_area(const std::array<double, 3> *corners, double least)
{
  double a[3], b[3], normal[3];
  MathExtra::sub3(corners[1].data(), corners[0].data(), a);
  MathExtra::sub3(corners[2].data(), corners[0].data(), b);
  MathExtra::cross3(a, b, normal);
  return 0.5 * MathExtra::len3(normal) <= least;
}

const std::vector<WallGrid::Facet> &WallGrid::facets(int piece) const
{
  cut.resize(pieces.size());
  if (cut[piece].empty()) cut[piece] = cut_facets(piece);
  return cut[piece];
}

double WallGrid::memory_usage() const
{
  double bytes = numbers.bytes();
  for (const auto &of_piece : cut) bytes += of_piece.capacity() * sizeof(Facet);
  return bytes;
}

/* ----------------------------------------------------------------------
   A piece's field goes on beyond the rim of the piece, behind the other pieces: what is there is
   not part of the wall.
------------------------------------------------------------------------- */

std::vector<WallGrid::Facet> WallGrid::cut_facets(int piece) const
{
  std::vector<Facet> all;
  const auto fields = surfaces();
  const auto &field = fields[piece];
  std::vector<double> values(lattice.nodes());
  const double spacing = *std::min_element(lattice.spacing, lattice.spacing + lattice.dims);
  for_each_node(lattice, [&](int i, int j, int k, std::size_t node) {
    double x[3];
    lattice.position(i, j, k, x);
    const double distance = field.grid.distance(x);
    // a wall along the border of the grid has no nodes behind it: those on it stand for them
    const double least = on_wall * spacing;
    values[node] = std::fabs(distance) < least ? -least : distance;
  });
  apf::Isosurface(lattice, values).for_each([&](const std::array<double, 3> *corners) {
    // where the wall goes through nodes; such triangles would be drawn black
    if (lattice.dims == 3 && has_no_area(corners, 10.0 * on_wall * spacing * spacing)) return;
    const auto &last = corners[lattice.dims - 1];
    double middle[3];
    for (int c = 0; c < 3; c++) middle[c] = (corners[0][c] + corners[1][c] + last[c]) / 3.0;
    for (const auto &other : fields)
      if (&other != &field && other.grid.distance(middle) < -0.25 * spacing) return;
    all.push_back({corners[0], corners[1], last});
  });
  return all;
}
