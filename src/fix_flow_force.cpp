#include "fix_flow_force.h"

#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_field.h"
#include "fix_nve_sphere_mts.h"
#include "force.h"
#include "math_const.h"
#include "memory.h"
#include "modify.h"
#include "respa.h"
#include "update.h"

#include "flow/fluid_step.h"
#include "flow/schiller_naumann.h"

#include <algorithm>
#include <cstring>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

// keywords of the flow force that come with a later version
const char *const later[] = {"lift",     "magnus",     "added_mass",    "pressure",
                             "brownian", "cunningham", "concentration", "feedback"};

apf::Vec3 vector(const double *a)
{
  return {a[0], a[1], a[2]};
}

void add(double *a, const apf::Vec3 &b)
{
  a[0] += b.x;
  a[1] += b.y;
  a[2] += b.z;
}

}    // namespace

/* ---------------------------------------------------------------------- */

FixFlowForce::FixFlowForce(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), field(nullptr), drag(Drag::NONE), torque(false), gravity{0.0, 0.0, 0.0},
    ilevel_respa(0), share(1.0), nmax(0), total{}, total_all{}, summed(false)
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix flow/force", error);
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix flow/force requires atom_style sphere, got {}", atom->get_style());

  dynamic_group_allow = 1;
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 1;
  peratom_flag = 1;
  size_peratom_cols = 6;
  peratom_freq = 1;
  virial_global_flag = virial_peratom_flag = 1;
  respa_level_support = 1;

  field_id = arg[3];
  field = find_field(3);

  int iarg = 4;
  while (iarg < narg) {
    if (strcmp(arg[iarg], "drag") == 0)
      iarg = parse_drag(iarg, narg, arg);
    else if (strcmp(arg[iarg], "torque") == 0)
      iarg = parse_torque(iarg, narg, arg);
    else if (strcmp(arg[iarg], "gravity") == 0)
      iarg = parse_gravity(iarg, narg, arg);
    else if (std::any_of(std::begin(later), std::end(later), [&](const char *word) {
               return strcmp(arg[iarg], word) == 0;
             }))
      error->all(FLERR, iarg, "Fix flow/force keyword {} is not available in this version of APF",
                 arg[iarg]);
    else
      error->all(FLERR, iarg, "Fix flow/force keyword must be drag, torque or gravity, got {}",
                 arg[iarg]);
  }
  if (drag == Drag::NONE) error->all(FLERR, "Fix flow/force requires keyword drag");

  nmax = atom->nmax;
  memory->create(array_atom, nmax, size_peratom_cols, "flow/force:array_atom");
  if (nmax) std::fill_n(&array_atom[0][0], nmax * size_peratom_cols, 0.0);
}

/* ---------------------------------------------------------------------- */

FixFlowForce::~FixFlowForce()
{
  memory->destroy(array_atom);
}

/* ----------------------------------------------------------------------
   parse a keyword at iarg; return index of the next one
------------------------------------------------------------------------- */

int FixFlowForce::parse_drag(int iarg, int narg, char **arg)
{
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix flow/force drag", error);
  const char *law = arg[iarg + 1];
  if (strcmp(law, "stokes") == 0)
    drag = Drag::STOKES;
  else if (strcmp(law, "schiller") == 0)
    drag = Drag::SCHILLER;
  else if (strcmp(law, "difelice") == 0)
    error->all(FLERR, iarg + 1,
               "Fix flow/force drag difelice is not available in this version of APF");
  else
    error->all(FLERR, iarg + 1, "Fix flow/force drag must be stokes or schiller, got {}", law);
  return iarg + 2;
}

int FixFlowForce::parse_torque(int iarg, int narg, char **arg)
{
  if (iarg + 2 > narg) utils::missing_cmd_args(FLERR, "fix flow/force torque", error);
  if (strcmp(arg[iarg + 1], "yes") != 0 && strcmp(arg[iarg + 1], "no") != 0)
    error->all(FLERR, iarg + 1, "Fix flow/force torque must be yes or no, got {}", arg[iarg + 1]);
  torque = strcmp(arg[iarg + 1], "yes") == 0;
  return iarg + 2;
}

int FixFlowForce::parse_gravity(int iarg, int narg, char **arg)
{
  if (iarg + 4 > narg) utils::missing_cmd_args(FLERR, "fix flow/force gravity", error);
  gravity.x = utils::numeric(FLERR, arg[iarg + 1], false, lmp);
  gravity.y = utils::numeric(FLERR, arg[iarg + 2], false, lmp);
  gravity.z = utils::numeric(FLERR, arg[iarg + 3], false, lmp);
  if (domain->dimension == 2 && gravity.z != 0.0)
    error->all(FLERR, iarg + 3,
               "Fix flow/force gravity along z must be 0 in a 2d simulation, got {}",
               arg[iarg + 3]);
  return iarg + 4;
}

/* ---------------------------------------------------------------------- */

FixFlowField *FixFlowForce::find_field(int iarg)
{
  auto *fix = modify->get_fix_by_id(field_id);
  if (!fix) error->all(FLERR, iarg, "Fix flow/force field fix {} does not exist", field_id);
  auto *result = dynamic_cast<FixFlowField *>(fix);
  if (!result)
    error->all(FLERR, iarg, "Fix flow/force field fix {} must be of style flow/field, got {}",
               field_id, fix->style);
  return result;
}

/* ---------------------------------------------------------------------- */

int FixFlowForce::setmask()
{
  return POST_FORCE | POST_FORCE_RESPA;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::init()
{
  field = find_field(Error::NOLASTLINE);
  field->require(torque ? apf::Detail::VORTICITY : apf::Detail::VELOCITY);
  check_particles();
  if (force->ftm2v != 1.0)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix flow/force requires units where force = mass * acceleration "
               "(lj, si, cgs, micro, nano), got {}",
               update->unit_style);

  sub_stepper = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (const auto *stepper = dynamic_cast<FixNVESphereMTS *>(fix)) sub_stepper = stepper;

  if (utils::strmatch(update->integrate_style, "^respa")) {
    ilevel_respa = dynamic_cast<Respa *>(update->integrate)->nlevels - 1;
    if (respa_level >= 0) ilevel_respa = std::min(respa_level, ilevel_respa);
  }
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::check_particles()
{
  const double *radius = atom->radius;
  const int *mask = atom->mask;
  int points = 0;
  double densest = 0.0;
  for (int i = 0; i < atom->nlocal; i++) {
    if (!(mask[i] & groupbit)) continue;
    const double r = radius[i];
    if (!(r > 0.0)) points++;
    if (r > 0.0)
      densest = MAX(densest, atom->rmass[i] / (4.0 / 3.0 * MathConst::MY_PI * r * r * r));
  }
  int points_all;
  MPI_Allreduce(&points, &points_all, 1, MPI_INT, MPI_SUM, world);
  if (points_all)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix flow/force requires particles of radius > 0, got {} of radius 0", points_all);

  // the mass of a sphere whose diameter was set after its density is that of the old diameter
  double densest_all;
  MPI_Allreduce(&densest, &densest_all, 1, MPI_DOUBLE, MPI_MAX, world);
  if (densest_all > 1.0e5 * field->density && comm->me == 0)
    error->warning(
        FLERR,
        "Fix flow/force {}: particles have a density of up to {:.3g}, {:.3g} times that of "
        "the fluid; set diameter before density, as in: set group all diameter D density "
        "RHO",
        id, densest_all, densest_all / field->density);
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::setup(int vflag)
{
  share = 0.5;    // the first force of a run acts until the middle of its first step
  if (utils::strmatch(update->integrate_style, "^verlet")) {
    post_force(vflag);
  } else {
    auto *respa = dynamic_cast<Respa *>(update->integrate);
    respa->copy_flevel_f(ilevel_respa);
    post_force_respa(vflag, ilevel_respa, 0);
    respa->copy_f_flevel(ilevel_respa);
  }
  share = 1.0;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::post_force(int vflag)
{
  v_init(vflag);
  gather();
  if (drag == Drag::STOKES) {
    if (torque)
      add_forces<apf::StokesDrag, true>();
    else
      add_forces<apf::StokesDrag, false>();
  } else {
    if (torque)
      add_forces<apf::SchillerNaumannDrag, true>();
    else
      add_forces<apf::SchillerNaumannDrag, false>();
  }
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::post_force_respa(int vflag, int ilevel, int /*iloop*/)
{
  if (ilevel == ilevel_respa) post_force(vflag);
}

/* ----------------------------------------------------------------------
   time for which the forces act on the velocities
------------------------------------------------------------------------- */

double FixFlowForce::step() const
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    return share * dynamic_cast<Respa *>(update->integrate)->step[ilevel_respa];
  return share * update->dt;
}

/* ----------------------------------------------------------------------
   the fluid's velocity and vorticity at the particles
------------------------------------------------------------------------- */

void FixFlowForce::gather()
{
  if (atom->nmax > nmax) {
    nmax = atom->nmax;
    memory->grow(array_atom, nmax, size_peratom_cols, "flow/force:array_atom");
  }
  const size_t nlocal = atom->nlocal;
  if (velocity.size() < nlocal) velocity.resize(nmax);
  if (torque && vorticity.size() < nlocal) vorticity.resize(nmax);
  if (sub_stepper && relaxations.size() < nlocal) relaxations.resize(nmax);
  const auto detail = torque ? apf::Detail::VORTICITY : apf::Detail::VELOCITY;
  auto at = [](const apf::Lanes(&a)[3], int l) {
    return apf::Vec3{a[0][l], a[1][l], a[2][l]};
  };
  apf::PointBlock points;
  apf::FluidBlock fluid;
  for (int first = 0; first < atom->nlocal; first += apf::block_width) {
    points.n = std::min(apf::block_width, atom->nlocal - first);
    for (int l = 0; l < points.n; l++) points.set(l, atom->x[first + l]);
    field->sample(points, detail, fluid);
    for (int l = 0; l < points.n; l++) {
      velocity[first + l] = at(fluid.velocity, l);
      if (torque) vorticity[first + l] = at(fluid.vorticity, l);
    }
  }
}

/* ---------------------------------------------------------------------- */

template <class Law, bool SPIN> void FixFlowForce::add_forces()
{
  double **v = atom->v, **omega = atom->omega;
  double **f = atom->f, **t = atom->torque;
  const double *radius = atom->radius, *rmass = atom->rmass;
  const int *mask = atom->mask;
  const int nlocal = atom->nlocal;
  const bool planar = domain->dimension == 2;

  apf::FluidStep<Law> whole(field->density, field->viscosity, step());
  apf::FluidStep<Law> sub(field->density, field->viscosity,
                          sub_stepper ? share * sub_stepper->collision_step() : step());
  apf::Vec3 drag_sum{}, weight_sum{};

  for (int i = 0; i < nlocal; i++) {
    double *out = array_atom[i];
    std::fill_n(out, 6, 0.0);
    if (!(mask[i] & groupbit)) continue;
    auto &fluid = sub_stepper && sub_stepper->step_of(i) < update->dt ? sub : whole;
    fluid.set_sphere(2.0 * radius[i], rmass[i]);

    const apf::Vec3 weight = fluid.gravity(gravity);
    const apf::Vec3 slip = vector(v[i]) - velocity[i];
    apf::Vec3 drag = fluid.drag(slip, vector(f[i]) + weight);
    if (planar) drag.z = 0.0;
    add(f[i], drag + weight);
    add(out, drag);
    drag_sum = drag_sum + drag;
    weight_sum = weight_sum + weight;
    if (evflag) tally(i, drag + weight);
    Relaxation relaxation;
    if (sub_stepper) {
      relaxation.rate = fluid.rate(slip);
      relaxation.a = relaxation.rate * velocity[i] - (1.0 / rmass[i]) * drag;
    }

    if (SPIN) {
      apf::Vec3 moment = fluid.torque(vector(omega[i]) - 0.5 * vorticity[i], vector(t[i]));
      if (planar) moment.x = moment.y = 0.0;
      add(t[i], moment);
      add(out + 3, moment);
      if (sub_stepper) {
        relaxation.spin_rate = fluid.spin_rate();
        const double inv_I = 2.5 / (rmass[i] * radius[i] * radius[i]);
        relaxation.alpha = (0.5 * relaxation.spin_rate) * vorticity[i] - inv_I * moment;
      }
    }
    if (sub_stepper) relaxations[i] = relaxation;
  }

  std::fill_n(total, 6, 0.0);
  add(total, drag_sum);
  add(total + 3, weight_sum);
  summed = false;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::relax(int i, apf::Slow &slow) const
{
  if (!(atom->mask[i] & groupbit)) return;
  const auto &r = relaxations[i];
  add(slow.a, r.a);
  add(slow.alpha, r.alpha);
  slow.rate += r.rate;
  slow.spin_rate += r.spin_rate;
}

/* ----------------------------------------------------------------------
   virial of an external force, as fix addforce counts it
------------------------------------------------------------------------- */

void FixFlowForce::tally(int i, const apf::Vec3 &force)
{
  double r[3];
  domain->unmap(atom->x[i], atom->image[i], r);
  double virial[6] = {force.x * r[0], force.y * r[1], force.z * r[2],
                      force.x * r[1], force.x * r[2], force.y * r[2]};
  v_tally(i, virial);
}

/* ----------------------------------------------------------------------
   1-3 = drag, 4-6 = gravity less buoyancy, sums over the group
------------------------------------------------------------------------- */

double FixFlowForce::compute_vector(int n)
{
  if (!summed) {
    MPI_Allreduce(total, total_all, 6, MPI_DOUBLE, MPI_SUM, world);
    summed = true;
  }
  return total_all[n];
}

/* ---------------------------------------------------------------------- */

double FixFlowForce::memory_usage()
{
  return (double) nmax * size_peratom_cols * sizeof(double) +
      (velocity.size() + vorticity.size()) * sizeof(apf::Vec3);
}
