#include "fix_flow_concentration.h"

#include "argument_reader.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "given_once.h"
#include "known_walls.h"
#include "modify.h"
#include "particle_checks.h"
#include "respa.h"
#include "update.h"

#include "flow/di_felice.h"
#include "flow/particle_slab.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

static constexpr const char *command = "Fix flow/concentration";
static constexpr double widest_cloud = 10.0;    // over the box; its margins are memory

/* ---------------------------------------------------------------------- */

FixFlowConcentration::FixFlowConcentration(LAMMPS *lmp, int narg, char **arg) :
    FixPerGrid(lmp, narg, arg), guard(lmp), grid(lmp, this, parse_cells(narg, arg), 1),
    open(lmp, this, grid.n, 1)
{
  check_spheres(lmp, command, 2);
  check_orthogonal(lmp, std::string(command) + " needs", 2);
  pergrid_flag = 1;
  pergrid_freq = 1;
  vector_flag = 1;
  size_vector = 3;
  global_freq = 1;
  extvector = 0;
  parse(narg, arg);
  set_up();
}

/* ---------------------------------------------------------------------- */

std::array<int, 3> FixFlowConcentration::parse_cells(int narg, char **arg)
{
  if (narg < 8) utils::missing_cmd_args(FLERR, "fix flow/concentration", error);
  const ArgumentReader reader(lmp, command, arg);
  std::array<int, 3> n;
  for (int c = 0; c < 3; c++) n[c] = reader.integer(3 + c, "number of cells", Range::from(1));
  if (domain->dimension == 2 && n[2] != 1)
    error->all(FLERR, 5, "{} number of cells along z must be 1 in a 2d simulation, got {}", command,
               arg[5]);
  return n;
}

void FixFlowConcentration::parse(int narg, char **arg)
{
  const ArgumentReader reader(lmp, command, arg);
  GivenOnce given(lmp, command);
  for (int iarg = 6; iarg < narg; iarg += 2) {
    const std::string word = arg[iarg];
    given.add(word, iarg);
    if (word != "cloud" && word != "every" && word != "method")
      error->all(FLERR, iarg, "{} keyword must be cloud, every or method, got {}", command, word);
    if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix flow/concentration " + word, error);
    if (word == "every") {
      every = reader.integer(iarg + 1, word, Range::from(1));
    } else if (word == "method") {
      constexpr Method methods[] = {Method::AUTO, Method::DIRECT, Method::FFT};
      method = methods[reader.choice(iarg + 1, word, {"auto", "direct", "fft"})];
      if (method == Method::FFT && !SlabTransform::available())
        error->all(FLERR, iarg + 1, "{} method fft needs APF built with FFTW for MPI", command);
    } else {
      radius = reader.number(iarg + 1, "cloud radius", Range::above(0.0));
    }
  }
  if (radius == 0.0) error->all(FLERR, "{} requires keyword cloud", command);
}

/* ---------------------------------------------------------------------- */

int FixFlowConcentration::setmask()
{
  return PRE_FORCE | PRE_FORCE_RESPA;
}

/* ---------------------------------------------------------------------- */

void FixFlowConcentration::init()
{
  check_orthogonal(lmp, std::string(command) + " needs", Error::NOLASTLINE);
  set_up();    // the neighbor skin may have changed
  if (comm->me == 0 && !warned && radius < 0.25 * widest_cell())
    error->warning(FLERR,
                   "{} {}: cloud {} is small for cells that are {:.4g} wide: below a quarter of "
                   "that a particle counts in the cell where it is, and hardly in any other",
                   command, id, radius, widest_cell());
  warned = true;
  if (every) return;
  every = 1;
  for (const auto &fix : modify->get_fix_list()) {
    int dim;
    const auto *steps = static_cast<int *>(fix->extract("fluid_every", dim));
    if (steps) every = *steps;
  }
}

/* ---------------------------------------------------------------------- */

// keep: what cells have goes to the ranks that they belong to now
void FixFlowConcentration::set_up(bool keep)
{
  const double width = widest_cell();
  if (method == Method::FFT && !can_convolve())
    error->all(FLERR, Error::NOLASTLINE,
               "{} {}: method fft needs a cloud of at least {} widths of a cell along each axis, "
               "{:.4g} for cells of {:.4g} ({} {} {} of them), got {}",
               command, id, apf::least_convolved, apf::least_convolved * width, width, grid.n[0],
               grid.n[1], grid.n[2], radius);
  wide = false;
  for (int c = 0; c < domain->dimension; c++)
    if (domain->periodicity[c] && 2.0 * apf::cloud_reach * radius > domain->prd[c]) check_wide(c);
  for (int c = 0; c < domain->dimension; c++)
    if (radius > widest_cloud * domain->prd[c])
      error->all(FLERR, Error::NOLASTLINE,
                 "{} {}: cloud must be <= {} times the box, which is {} wide along {}, got {}",
                 command, id, widest_cloud, domain->prd[c], "xyz"[c], radius);
  if (keep)
    grid.share_anew(1);
  else
    grid.set_up(1);
  open.set_up(wide ? 1 : CloudSum::reach(grid, radius));
  mark_fluid();
  closed = walled;
  for (int c = 0; c < domain->dimension; c++) closed |= !grid.periodic[c];
  direct.reset();
  convolution.reset();
}

// A cloud that overlaps its own images can be convolved, not summed.
void FixFlowConcentration::check_wide(int axis)
{
  wide = true;
  if (method != Method::DIRECT && SlabTransform::available() && can_convolve()) return;
  error->all(FLERR, Error::NOLASTLINE,
             "{} {}: clouds reach to {} times their radius; added up directly they must not be "
             "longer than the periodic box: cloud must be <= {:.6g} along {}, got {}",
             command, id, apf::cloud_reach, 0.5 * domain->prd[axis] / apf::cloud_reach, "xyz"[axis],
             radius);
}

bool FixFlowConcentration::can_convolve() const
{
  return radius >= apf::least_convolved * widest_cell();
}

double FixFlowConcentration::widest_cell() const
{
  double width = 0.0;
  for (int c = 0; c < domain->dimension; c++) width = std::max(width, domain->prd[c] / grid.n[c]);
  return width;
}

void FixFlowConcentration::reset_grid()
{
  set_up(true);
  grid.fill_ghosts();
}

/* ----------------------------------------------------------------------
   cells whose centres lie in the fluid
------------------------------------------------------------------------- */

void FixFlowConcentration::mark_fluid()
{
  KnownWalls walls;
  walls.find(modify);
  for (const auto &fix : modify->get_fix_list())
    if (const auto *field = dynamic_cast<FixFlowField *>(fix)) walls.add(field);
  int masked = 0;
  for (int z = open.first[2]; z <= open.last[2]; z++)
    for (int y = open.first[1]; y <= open.last[1]; y++)
      for (int x = open.first[0]; x <= open.last[0]; x++) {
        const int cell[3] = {x, y, z};
        double centre[3];
        for (int c = 0; c < 3; c++) centre[c] = open.origin[c] + (cell[c] + 0.5) * open.spacing[c];
        domain->remap(centre);
        const bool fluid = walls.distance(centre) > 0.0;
        *open.at(x, y, z) = fluid;
        masked |= !fluid;
      }
  MPI_Allreduce(MPI_IN_PLACE, &masked, 1, MPI_INT, MPI_MAX, world);
  walled = masked;
}

/* ---------------------------------------------------------------------- */

void FixFlowConcentration::setup_pre_force(int /*vflag*/)
{
  if (box_changes()) set_up();
  renew();
}

void FixFlowConcentration::setup_pre_force_respa(int vflag, int ilevel)
{
  if (ilevel == dynamic_cast<Respa *>(update->integrate)->nlevels - 1) setup_pre_force(vflag);
}

void FixFlowConcentration::pre_force(int /*vflag*/)
{
  guard.require(this);
  if (box_changes()) set_up();
  if (box_changes() || update->ntimestep % every == 0) renew();
}

// not: its division among ranks
bool FixFlowConcentration::box_changes() const
{
  return domain->box_change_size || domain->box_change_shape;
}

void FixFlowConcentration::pre_force_respa(int vflag, int ilevel, int /*iloop*/)
{
  if (ilevel == dynamic_cast<Respa *>(update->integrate)->nlevels - 1) pre_force(vflag);
}

void FixFlowConcentration::renew()
{
  members.clear();
  for (int i = 0; i < atom->nlocal; i++)
    if (atom->mask[i] & groupbit) members.push_back(i);
  grid.clear();
  if (by_convolution()) convolve();
  int left = !members.empty();
  MPI_Allreduce(MPI_IN_PLACE, &left, 1, MPI_INT, MPI_MAX, world);
  if (left) add_up();
  grid.fill_ghosts();
}

double FixFlowConcentration::volume(int i) const
{
  return apf::particle_volume(atom->radius[i], domain->dimension == 2);
}

/* ----------------------------------------------------------------------
   The cheaper method, from the work of all ranks: a choice that does not depend on their number.
------------------------------------------------------------------------- */

bool FixFlowConcentration::by_convolution() const
{
  if (method != Method::AUTO || wide) return method != Method::DIRECT;
  if (!SlabTransform::available() || !can_convolve()) return false;
  auto particles = static_cast<double>(members.size());
  MPI_Allreduce(MPI_IN_PLACE, &particles, 1, MPI_DOUBLE, MPI_SUM, world);
  return CloudConvolution::cost(lmp, grid, radius, particles, closed) <
      CloudSum::cost(grid, radius, particles, walled);
}

/* ----------------------------------------------------------------------
   A cloud of which little lies in the fluid would be multiplied, with its error: such members
   remain. The error makes cells that no cloud reaches negative by a little: they become 0, and the
   others smaller in proportion, so that the volume remains.
------------------------------------------------------------------------- */

void FixFlowConcentration::convolve()
{
  static constexpr double least_share = 0.1;
  if (!convolution) {
    convolution = std::make_unique<CloudConvolution>(lmp, grid, radius);
    if (closed) convolution->set_fluid(open);
  }
  size_t left = 0;
  convolution->begin();
  for (int i : members) {
    if (!convolution->locate(atom->x[i])) complain_far(atom->x[i]);
    const double share = closed ? convolution->share() : 1.0;
    if (share < least_share) {
      if (wide) complain_walled(atom->x[i], least_share);
      members[left++] = i;
    } else
      convolution->add(volume(i) / (share * grid.cell_volume));
  }
  members.resize(left);
  convolution->end();
  double sums[2] = {0.0, 0.0};    // of all cells, and of those that are not negative
  grid.for_own_cells([&](int x, int y, int z) {
    const double c = *open.at(x, y, z) * convolution->at(x, y, z);
    sums[0] += c;
    sums[1] += *grid.at(x, y, z) = MAX(c, 0.0);
  });
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, world);
  if (sums[0] == sums[1]) return;
  grid.for_own([scale = sums[0] / sums[1]](double *c) {
    *c *= scale;
  });
}

void FixFlowConcentration::add_up()
{
  if (!direct) direct = std::make_unique<CloudSum>(lmp, this, open, radius, walled, 1);
  direct->begin();
  for (int i : members)
    if (!direct->add(atom->x[i], volume(i) / grid.cell_volume)) complain_far(atom->x[i]);
  direct->end();
  grid.for_own_cells([&](int x, int y, int z) {
    *grid.at(x, y, z) += *direct->grid.at(x, y, z);
  });
}

void FixFlowConcentration::complain_walled(const double *x, double least) const
{
  error->one(FLERR, Error::NOLASTLINE,
             "{} {}: less than {} of the cloud of a particle at {:.8g} {:.8g} {:.8g} lies in the "
             "fluid; such a cloud is added up directly, and then must be at most an eighth of the "
             "periodic box, got {}",
             command, id, least, x[0], x[1], x[2], radius);
}

void FixFlowConcentration::complain_far(const double *x) const
{
  error->one(FLERR, Error::NOLASTLINE,
             "{} {}: a particle at {:.8g} {:.8g} {:.8g} lies outside the box, or has moved more "
             "than half the neighbor skin since neighbor lists were built",
             command, id, x[0], x[1], x[2]);
}

/* ---------------------------------------------------------------------- */

void FixFlowConcentration::sample(const apf::PointBlock &points, apf::Lanes &concentration) const
{
  for (int l = 0; l < points.n; l++) {
    const double x[3] = {points.x[0][l], points.x[1][l], points.x[2][l]};
    double sum = 0.0;
    if (!grid.interpolate(x, [&](const double *c, double weight) {
          sum += weight * *c;
        }))
      error->one(FLERR, Error::NOLASTLINE,
                 "{} {}: a particle at {:.8g} {:.8g} {:.8g} lies outside the box", command, id,
                 x[0], x[1], x[2]);
    concentration[l] = sum;
  }
}

/* ----------------------------------------------------------------------
   1 = volume of all particles on the grid, 2 = largest concentration, 3 = cells above the densest
   random packing
------------------------------------------------------------------------- */

double FixFlowConcentration::compute_vector(int n)
{
  double mine = 0.0, all;
  grid.for_own([&](const double *c) {
    if (n == 0)
      mine += *c * grid.cell_volume;
    else if (n == 1)
      mine = MAX(mine, *c);
    else
      mine += *c > apf::max_concentration;
  });
  MPI_Allreduce(&mine, &all, 1, MPI_DOUBLE, n == 1 ? MPI_MAX : MPI_SUM, world);
  return all;
}

double FixFlowConcentration::memory_usage()
{
  return grid.memory_usage() + open.memory_usage() + (direct ? direct->grid.memory_usage() : 0.0) +
      (convolution ? convolution->memory_usage() : 0.0);
}
