// Where the particles of fix inlet/flow may enter, and their making.

#include "atom.h"
#include "atom_vec.h"
#include "comm.h"
#include "domain.h"
#include "fix_inlet_flow.h"
#include "math_const.h"
#include "modify.h"
#include "respa.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;
using MathConst::MY_PI;

/* ----------------------------------------------------------------------
   all particles that one may touch that enters now, of all ranks; also finds the highest ID
------------------------------------------------------------------------- */

apf::SphereGrid FixInletFlow::near_plane()
{
  const auto &plane = inflow.rectangle();
  double biggest = 0.0;
  std::vector<double> mine;
  tagint newest = 0;
  const int nlocal = atom->nlocal;
  for (int i = 0; i < nlocal; i++) {
    newest = MAX(newest, atom->tag[i]);
    const double reach = 0.5 * largest() + atom->radius[i] + gap + travel();
    auto away = [&](int axis, double from) {
      const double d = atom->x[i][axis] - from;
      return std::fabs(domain->periodicity[axis] ? std::remainder(d, domain->prd[axis]) : d);
    };
    bool near = away(dim, position) < reach;
    for (int k = 0; k < 2; k++)
      near = near &&
          away(plane.across[k], 0.5 * (plane.lo[k] + plane.hi[k])) <=
              0.5 * (plane.hi[k] - plane.lo[k]) + reach;
    if (near)
      mine.insert(mine.end(), {atom->x[i][0], atom->x[i][1], atom->x[i][2], atom->radius[i]});
  }

  int n = static_cast<int>(mine.size());
  std::vector<bigint> told(2 * comm->nprocs);    // numbers and highest ID of each rank
  const bigint tell[2] = {n, newest};
  MPI_Allgather(tell, 2, MPI_LMP_BIGINT, told.data(), 2, MPI_LMP_BIGINT, world);
  std::vector<int> counts(comm->nprocs), starts(comm->nprocs, 0);
  for (int p = 0; p < comm->nprocs; p++) {
    counts[p] = static_cast<int>(told[2 * p]);
    if (p > 0) starts[p] = starts[p - 1] + counts[p - 1];
    state.newest = std::max(state.newest, static_cast<double>(told[2 * p + 1]));
  }
  std::vector<double> all(starts.back() + counts.back());
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                 world);

  for (size_t k = 3; k < all.size(); k += 4) biggest = std::max(biggest, all[k]);
  const double period[3] = {domain->periodicity[0] * domain->prd[0],
                            domain->periodicity[1] * domain->prd[1],
                            domain->periodicity[2] * domain->prd[2]};
  apf::SphereGrid grid(period, 0.5 * largest() + std::max(biggest, 0.5 * largest()) + gap);
  for (size_t k = 0; k < all.size(); k += 4) grid.add(&all[k], all[k + 3]);
  return grid;
}

/* ----------------------------------------------------------------------
   A particle has entered at some moment since the last insertion, and has moved on with the fluid.
------------------------------------------------------------------------- */

bool FixInletFlow::place(Particle &particle, const apf::SphereGrid &grid)
{
  for (int n = 0; n < attempts; n++) {
    double entry[3];
    apf::Vec3 u{};
    const bool found = inflow.draw(
        [this] {
          return uniform();
        },
        [this](const double *x) {
          return fluid_at(x, nullptr);
        },
        entry, u);
    const double age = uniform() * every * update->dt;
    const double way = age * std::sqrt(dot(u, u));
    const double part = way > travel() ? age * travel() / way : age;
    particle.x[0] = entry[0] + part * u.x;
    particle.x[1] = entry[1] + part * u.y;
    particle.x[2] = entry[2] + part * u.z;
    if (found && fits(entry, particle) && grid.is_free(particle.x, particle.radius, gap)) {
      particle.v = fluid_at(particle.x, &particle.omega);
      return true;
    }
    state.refused += 1.0;
  }
  return false;
}

/* ----------------------------------------------------------------------
   within the window where it entered, and within box and walls where it is
------------------------------------------------------------------------- */

bool FixInletFlow::fits(const double *entry, const Particle &particle) const
{
  const auto &plane = inflow.rectangle();
  for (int k = 0; k < 2; k++) {
    const int axis = plane.across[k];
    if (domain->dimension == 2 && axis == 2) continue;
    if (domain->periodicity[axis] && plane.hi[k] - plane.lo[k] == domain->prd[axis]) continue;
    if (entry[axis] - particle.radius < plane.lo[k]) return false;
    if (entry[axis] + particle.radius > plane.hi[k]) return false;
  }
  for (int c = 0; c < domain->dimension; c++) {
    if (domain->boundary[c][0] == 1 && particle.x[c] < domain->boxlo[c]) return false;
    if (domain->boundary[c][1] == 1 && particle.x[c] >= domain->boxhi[c]) return false;
  }
  return walls.distance(particle.x) >= particle.radius + gap;
}

/* ----------------------------------------------------------------------
   velocity of the fluid, and its spin if asked for
------------------------------------------------------------------------- */

apf::Vec3 FixInletFlow::fluid_at(const double *x, apf::Vec3 *spin) const
{
  apf::PointBlock point;
  apf::FluidBlock fluid;
  point.n = 1;
  point.set(0, x);
  field->sample(point, spin ? apf::Detail::VORTICITY : apf::Detail::VELOCITY, fluid);
  auto first = [](const apf::Lanes(&a)[3]) {
    return apf::Vec3{a[0][0], a[1][0], a[2][0]};
  };
  if (spin) *spin = 0.5 * first(fluid.vorticity);
  return first(fluid.velocity);
}

/* ----------------------------------------------------------------------
   Ranks at the faces of a shrink-wrapped box take what lies beyond: the box will follow.
------------------------------------------------------------------------- */

bool FixInletFlow::is_mine(const double *x) const
{
  for (int c = 0; c < 3; c++) {
    const double at = MIN(MAX(x[c], domain->boxlo[c]), domain->boxhi[c]);
    const bool last = at == domain->boxhi[c] && domain->subhi[c] == domain->boxhi[c];
    if (at < domain->sublo[c] || (at >= domain->subhi[c] && !last)) return false;
  }
  return true;
}

void FixInletFlow::create(const Particle &particle, tagint id)
{
  double x[3] = {particle.x[0], particle.x[1], particle.x[2]};
  imageint image = ((imageint) IMGMAX << IMG2BITS) | ((imageint) IMGMAX << IMGBITS) | IMGMAX;
  domain->remap(x, image);
  if (!is_mine(x)) return;
  atom->avec->create_atom(type, x);
  const int i = atom->nlocal - 1;
  const double r = particle.radius;
  atom->tag[i] = id;
  atom->mask[i] = 1 | groupbit;
  atom->image[i] = image;
  atom->radius[i] = r;
  atom->rmass[i] = 4.0 / 3.0 * MY_PI * r * r * r * density;
  const apf::Vec3 &v = particle.v, &w = particle.omega;
  const double motion[2][3] = {{v.x, v.y, v.z}, {w.x, w.y, w.z}};
  std::copy_n(motion[0], 3, atom->v[i]);
  std::copy_n(motion[1], 3, atom->omega[i]);
  modify->create_attribute(i);

  // r-RESPA keeps the forces of each level, and begins with these before it computes them
  if (auto *levels = modify->get_fix_by_id("RESPA")) {
    std::vector<double> none(6 * dynamic_cast<Respa *>(update->integrate)->nlevels, 0.0);
    levels->unpack_exchange(i, none.data());
  }
}
