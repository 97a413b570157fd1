#include "fix_inlet_flow.h"

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix_contacts.h"
#include "lost_state.h"
#include "math_const.h"
#include "modify.h"
#include "particle_checks.h"
#include "random_mars.h"
#include "respa.h"
#include "restart_state.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

using namespace LAMMPS_NS;
using namespace FixConst;
using MathConst::MY_PI;

/* ---------------------------------------------------------------------- */

FixInletFlow::FixInletFlow(LAMMPS *lmp, int narg, char **arg) : Fix(lmp, narg, arg), guard(lmp)
{
  check_spheres(lmp, command, 2);
  if (!atom->tag_enable) error->all(FLERR, 2, "{} needs atoms with IDs", command);
  check_orthogonal(lmp, std::string(command) + " needs", 2);
  restart_global = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  vector_flag = 1;
  size_vector = 10;
  global_freq = 1;
  extvector = 0;
  time_depend = 1;

  parse(narg, arg);
  state.next = draw_diameter();
}

FixInletFlow::~FixInletFlow() = default;

/* ---------------------------------------------------------------------- */

int FixInletFlow::setmask()
{
  return POST_INTEGRATE | POST_INTEGRATE_RESPA | PRE_EXCHANGE | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::init()
{
  auto *fix = modify->get_fix_by_id(field_id);
  field = dynamic_cast<FixFlowField *>(fix);
  if (!fix)
    error->all(FLERR, Error::NOLASTLINE, "{} field fix {} does not exist", command, field_id);
  if (!field)
    error->all(FLERR, Error::NOLASTLINE, "{} field fix {} must be of style flow/field, got {}",
               command, field_id, fix->style);
  field->require(apf::Detail::VORTICITY, false);
  check_orthogonal(lmp, std::string(command) + " needs", Error::NOLASTLINE);
  check_plane();
  check_direction(lmp, fmt::format("{} {}", command, id));
  warn_of_equal_seeds();
  LostState::warn(lmp, this, "it counts from 0, and its particles are those of a run that begins");
  check_inserted(lmp, fmt::format("{} {}", command, id), this);

  walls.find(modify);
  walls.add(field);
  keepers.clear();
  for (const auto &other : modify->get_fix_list())
    if (dynamic_cast<FixContacts *>(other)) keepers.push_back(other);
}

/* ----------------------------------------------------------------------
   part of the plane in which particles enter, in the box as it is
------------------------------------------------------------------------- */

apf::InletPlane FixInletFlow::rectangle() const
{
  apf::InletPlane plane{dim, sign, position, {dim == 0 ? 1 : 0, dim == 2 ? 1 : 2}, {}, {}};
  for (int k = 0; k < 2; k++) {
    const int axis = plane.across[k];
    plane.lo[k] = std::isnan(window[k][0]) ? domain->boxlo[axis] : window[k][0];
    plane.hi[k] = std::isnan(window[k][1]) ? domain->boxhi[axis] : window[k][1];
  }
  if (domain->dimension == 2) plane.lo[1] = plane.hi[1] = 0.0;
  return plane;
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::setup(int /*vflag*/)
{
  guard.prepared();
  measure();
  if (inflow.flux() > 0.0) return;
  if (!field->unsteady())
    error->all(FLERR, Error::NOLASTLINE,
               "{} the fluid of fix {} does not enter anywhere: its velocity along the direction "
               "of entry must be > 0 in a part of the plane",
               command, field_id);
  if (comm->me == 0)
    error->warning(FLERR, "{} {}: the fluid of fix {} does not enter anywhere at step {}", command,
                   id, field_id, update->ntimestep);
}

void FixInletFlow::measure()
{
  inflow.measure(rectangle(), [this](const apf::PointBlock &points, apf::FluidBlock &fluid) {
    field->sample(points, apf::Detail::VELOCITY, fluid);
  });
}

/* ----------------------------------------------------------------------
   The fluid is that of the last force computation, so that what enters within a step follows the
   flow at its beginning.
------------------------------------------------------------------------- */

void FixInletFlow::post_integrate()
{
  guard.require(this);
  const bool changed = field->unsteady() || !(rectangle() == inflow.rectangle());
  if (changed) measure();
  const bool inserts = update->ntimestep % every == 0;
  state.elapsed += update->dt;
  if (concentration > 0.0) {
    const double volume = concentration * inflow.flux() * update->dt;
    state.asked += volume;
    state.owed += volume;
  } else if (inserts && inflow.flux() > 0.0) {
    state.asked += number * mean_size();
    state.owed += number;
  }
  if (inserts && inflow.flux() > 0.0 && state.owed >= share(state.next))
    next_reneighbor = update->ntimestep;
}

void FixInletFlow::post_integrate_respa(int ilevel, int /*iloop*/)
{
  if (ilevel == dynamic_cast<Respa *>(update->integrate)->nlevels - 1) post_integrate();
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::pre_exchange()
{
  const bool inserts = next_reneighbor == update->ntimestep;
  if (!inserts && outlets.empty()) return;
  for (auto *keeper : keepers) keeper->pre_exchange();    // contacts are stored with their atoms
  if (!outlets.empty()) remove_left();
  if (inserts) insert();
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::post_run()
{
  if (refuses && comm->me == 0)
    error->warning(FLERR,
                   "{} {}: {:.6g} particles could not enter yet for want of free places; they are "
                   "{:.3g} % of those asked for",
                   command, id, compute_vector(4),
                   100.0 * compute_vector(4) / (compute_vector(4) + state.inserted));
}

/* ---------------------------------------------------------------------- */

double FixInletFlow::uniform()
{
  return random->uniform();
}

double FixInletFlow::draw_diameter()
{
  auto numbers = [this] {
    return uniform();
  };
  return std::visit(
      [&](const auto &law) {
        return law.draw(numbers);
      },
      diameters);
}

double FixInletFlow::smallest() const
{
  return std::visit(
      [](const auto &law) {
        return law.smallest();
      },
      diameters);
}

double FixInletFlow::largest() const
{
  return std::visit(
      [](const auto &law) {
        return law.largest();
      },
      diameters);
}

// what a particle takes of the space of the flow: its volume, in 2-D its area
double FixInletFlow::size(double d) const
{
  return domain->dimension == 2 ? 0.25 * MY_PI * d * d : MY_PI / 6.0 * d * d * d;
}

double FixInletFlow::mean_size() const
{
  const int power = domain->dimension;
  return size(1.0) *
      std::visit(
             [power](const auto &law) {
               return law.moment(power);
             },
             diameters);
}

// what it takes of what is owed
double FixInletFlow::share(double d) const
{
  return concentration > 0.0 ? size(d) : 1.0;
}

// how far from the plane particles may be that have just entered
double FixInletFlow::travel() const
{
  return inflow.speed() * every * update->dt;
}

/* ----------------------------------------------------------------------
   particles beyond an outlet are deleted and counted
------------------------------------------------------------------------- */

void FixInletFlow::remove_left()
{
  double gone[2] = {0.0, 0.0};    // number and mass
  int i = 0;
  while (i < atom->nlocal) {
    bool leaves = false;
    if (atom->mask[i] & groupbit)
      for (const auto &outlet : outlets)
        leaves |= outlet.sign * (atom->x[i][outlet.dim] - outlet.position) > 0.0;
    if (!leaves) {
      i++;
      continue;
    }
    gone[0] += 1.0;
    gone[1] += atom->rmass[i];
    atom->avec->copy(atom->nlocal - 1, i, 1);
    atom->nlocal--;
  }
  MPI_Allreduce(MPI_IN_PLACE, gone, 2, MPI_DOUBLE, MPI_SUM, world);
  if (gone[0] == 0.0) return;
  state.left += gone[0];
  state.left_mass += gone[1];
  atom->natoms -= static_cast<bigint>(gone[0]);
  forget_ghosts();
  renew_map();
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::insert()
{
  forget_ghosts();
  auto grid = near_plane();
  const auto first = static_cast<tagint>(state.newest) + 1;

  std::vector<Particle> entered;
  refuses = false;
  while (state.owed >= share(state.next) && !refuses) {
    Particle particle{};
    particle.radius = 0.5 * state.next;
    refuses = !place(particle, grid);
    if (refuses) break;
    grid.add(particle.x, particle.radius);
    entered.push_back(particle);
    state.owed -= share(state.next);
    state.volume += size(state.next);
    state.mass += density * MY_PI / 6.0 * state.next * state.next * state.next;
    state.next = draw_diameter();
  }
  state.inserted += static_cast<double>(entered.size());
  if (static_cast<double>(entered.size()) + state.newest >= MAXTAGINT)
    error->all(FLERR, Error::NOLASTLINE, "{} new atom IDs exceed the maximum allowed ID {}",
               command, MAXTAGINT);
  state.newest += static_cast<double>(entered.size());
  for (size_t n = 0; n < entered.size(); n++) create(entered[n], first + n);
  atom->natoms += static_cast<bigint>(entered.size());
  renew_map();
}

// Ghosts would be overwritten by new atoms; they are made again after this.
void FixInletFlow::forget_ghosts()
{
  if (atom->map_style != Atom::MAP_NONE) atom->map_clear();
  atom->nghost = 0;
  atom->avec->clear_bonus();
}

void FixInletFlow::renew_map()
{
  if (atom->map_style == Atom::MAP_NONE) return;
  atom->map_init();
  atom->map_set();
}

/* ----------------------------------------------------------------------
   1 = entered, 2 = places refused, 3 = mass, 4 = volume entered, 5 = number owed, 6 = flux asked
   now, 7 = its mean over time, 8 = mean flux entered, 9 = left, 10 = mass that left
------------------------------------------------------------------------- */

double FixInletFlow::compute_vector(int n)
{
  const double time = state.elapsed > 0.0 ? state.elapsed : 1.0;
  const double owed = state.owed / (concentration > 0.0 ? mean_size() : 1.0);
  const double per_insertion = inflow.flux() > 0.0 ? number * mean_size() : 0.0;
  const double now = concentration > 0.0 ? concentration * inflow.flux()
                                         : per_insertion / (every * update->dt);
  const double values[10] = {
      state.inserted,     state.refused,       state.mass, state.volume,   owed, now,
      state.asked / time, state.volume / time, state.left, state.left_mass};
  return values[n];
}

/* ----------------------------------------------------------------------
   sizes of what may enter, for cut-offs and time steps of contacts; dim holds the type
------------------------------------------------------------------------- */

void *FixInletFlow::extract(const char *name, int &dim)
{
  if (dim != type) return nullptr;
  const double r = 0.5 * smallest();
  if (strcmp(name, "radius") == 0)
    extracted = 0.5 * largest();
  else if (strcmp(name, "smallest_radius") == 0)
    extracted = r;
  else if (strcmp(name, "smallest_mass") == 0)
    extracted = 4.0 / 3.0 * MY_PI * r * r * r * density;
  else
    return nullptr;
  dim = 0;
  return &extracted;
}

/* ---------------------------------------------------------------------- */

void FixInletFlow::write_restart(FILE *fp)
{
  random->get_state(state.random);
  if (comm->me != 0) return;
  const auto *numbers = reinterpret_cast<const double *>(&state);
  RestartState::write(lmp, this, {numbers, numbers + sizeof(State) / sizeof(double)}, fp);
}

void FixInletFlow::restart(char *buf)
{
  RestartState saved(lmp, this, buf);
  state.owed = saved.next(Range::from(0.0));
  state.next = saved.next(Range::above(0.0));
  if (state.next < smallest() || state.next > largest())
    saved.refuse("the next particle has none of the diameters of this command",
                 "give the same, or the fix another ID to begin anew");
  for (auto *count : {&state.inserted, &state.refused}) *count = saved.whole(0.0, most_counted);
  for (auto *sum : {&state.mass, &state.volume, &state.asked, &state.elapsed})
    *sum = saved.next(Range::from(0.0));
  state.left = saved.whole(0.0, most_counted);
  state.left_mass = saved.next(Range::from(0.0));
  state.newest = saved.whole(0.0, std::min<double>(MAXTAGINT, most_counted));
  // as RanMars has them: what numbers are made of, two places among these, three more
  constexpr int n_places = 97;
  const auto share = Range::from(0.0, std::nextafter(1.0, 0.0));
  for (int k = 0; k < 103; k++) {
    const bool is_place = k == n_places + 1 || k == n_places + 2;
    state.random[k] = is_place ? saved.whole(1.0, n_places) : saved.next(share);
  }
  saved.end();
  random->set_state(state.random);
}
