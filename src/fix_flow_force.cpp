#include "fix_flow_force.h"

#include "atom.h"
#include "contact_checks.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_field.h"
#include "fix_nve_sphere_mts.h"
#include "memory.h"
#include "modify.h"
#include "particle_checks.h"
#include "respa.h"
#include "update.h"

#include "flow/cunningham.h"
#include "flow/relaxation.h"
#include "flow/stokes.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

void add(double *a, const apf::Vec3 &b)
{
  a[0] += b.x;
  a[1] += b.y;
  a[2] += b.z;
}

}    // namespace

/* ---------------------------------------------------------------------- */

FixFlowForce::FixFlowForce(LAMMPS *lmp, int narg, char **arg) :
    FixPerGrid(lmp, narg, arg), guard(lmp), block(std::make_unique<Block>()),
    fluid_forces(apf::fluid_forces()), rows(apf::lane_rows()), parts{}, total_all{}
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix flow/force", error);
  check_spheres(lmp, command, 2);

  field_id = arg[3];
  field = find_field(3);
  parse(narg, arg);
  model.planar = domain->dimension == 2;

  const bool acts[apf::n_fluid_forces] = {false,         model.weight,     model.lift,
                                          model.magnus,  model.added_mass, model.pressure,
                                          model.brownian};
  for (int k = 0; k < apf::n_fluid_forces; k++)
    if (acts[k]) columns.push_back(k);
  choose_outputs();

  dynamic_group_allow = 1;
  vector_flag = 1;
  size_vector = n_sums;
  global_freq = 1;
  extvector = 1;
  peratom_flag = per_atom;
  size_peratom_cols = static_cast<int>(outputs.size());
  peratom_freq = 1;
  virial_global_flag = virial_peratom_flag = 1;
  pergrid_flag = feedback ? 1 : 0;
  pergrid_freq = 1;
  respa_level_support = 1;

  if (per_atom) grow_output();
}

/* ----------------------------------------------------------------------
   what the columns of the per-atom array are
------------------------------------------------------------------------- */

void FixFlowForce::choose_outputs()
{
  if (!per_atom) return;
  const auto &of = block->forces;
  for (const auto &drag : of.force[apf::DRAG]) outputs.push_back(&drag);
  for (const auto &torque : of.torque) outputs.push_back(&torque);
  for (const int k : columns)
    for (const auto &force : of.force[k]) outputs.push_back(&force);
}

/* ---------------------------------------------------------------------- */

FixFlowForce::~FixFlowForce()
{
  memory->destroy(array_atom);
}

/* ---------------------------------------------------------------------- */

int FixFlowForce::setmask()
{
  return POST_FORCE | POST_FORCE_RESPA | POST_RUN;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::init()
{
  field = find_field(Error::NOLASTLINE);
  field->require(model.detail());
  check_particles();
  check_units(lmp, command);
  check_direction(lmp, fmt::format("{} {}", command, id));
  check_group(lmp, fmt::format("{} {} moves", command, id), this);
  if (!concentration_id.empty()) cloud = find_concentration(Error::NOLASTLINE);
  if (feedback) feedback->set_up();
  check_other_fixes();
  model.density = field->density;
  model.viscosity = field->viscosity;
  warned = false;

  sub_stepper = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (const auto *stepper = dynamic_cast<FixNVESphereMTS *>(fix)) sub_stepper = stepper;

  if (utils::strmatch(update->integrate_style, "^respa")) {
    ilevel_respa = dynamic_cast<Respa *>(update->integrate)->nlevels - 1;
    if (respa_level >= 0) ilevel_respa = std::min(respa_level, ilevel_respa);
  }
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::setup(int vflag)
{
  guard.prepared();
  part = 0.5;    // the first force of a run acts until the middle of its first step
  if (utils::strmatch(update->integrate_style, "^verlet")) {
    post_force(vflag);
  } else {
    auto *respa = dynamic_cast<Respa *>(update->integrate);
    respa->copy_flevel_f(ilevel_respa);
    post_force_respa(vflag, ilevel_respa, 0);
    respa->copy_f_flevel(ilevel_respa);
  }
  part = 1.0;
  warn_of_ranges();
  warn_of_later_forces();
}

/* ----------------------------------------------------------------------
   the particles of the group, a block at a time
------------------------------------------------------------------------- */

void FixFlowForce::for_blocks(const std::function<void()> &act)
{
  const double whole = step(), sub = sub_stepper ? part * sub_stepper->collision_step() : whole;
  for (int next = 0; next < atom->nlocal;) {
    next = gather(next, whole, sub);
    field->sample(block->points, model.detail(), block->fluid);
    act();
  }
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::post_force(int vflag)
{
  guard.require(this);
  if (finite_is_due(lmp)) check_finite(lmp, fmt::format("{} {}", command, id));
  v_init(vflag);
  if (per_atom && atom->nmax > nmax) grow_output();
  if (sub_stepper) relaxations.resize(atom->nlocal);
  model.step = update->ntimestep;
  model.step_length = update->dt;
  std::fill_n(parts[0], n_sums * apf::sum_parts, 0.0);
  summed = false;
  for (int i = 0; i < atom->nlocal; i++) {
    if (atom->mask[i] & groupbit) continue;
    if (per_atom) std::fill_n(array_atom[i], size_peratom_cols, 0.0);
    if (sub_stepper) relaxations[i] = Relaxation();
  }

  if (feedback) {
    if (domain->box_change) feedback->set_up();
    feedback->begin();
  }
  for_blocks([this] {
    fluid_forces(model, block->fluid, block->forces);
    scatter();
    add_up();
    if (sub_stepper) keep_relaxation();
    if (evflag) tally();
    if (feedback) react();
  });
  if (!feedback) return;
  feedback->end();
  const apf::Vec3 got = feedback->sum();
  parts[n_sums - 3][0] = got.x;
  parts[n_sums - 2][0] = got.y;
  parts[n_sums - 1][0] = got.z;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::post_force_respa(int vflag, int ilevel, int /*iloop*/)
{
  if (ilevel == ilevel_respa) post_force(vflag);
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::post_run()
{
  check_finite(lmp, fmt::format("{} {}", command, id));
  warn_of_ranges();
}

/* ----------------------------------------------------------------------
   the per-atom array for all atoms; what no force writes stays 0
------------------------------------------------------------------------- */

void FixFlowForce::grow_output()
{
  memory->grow(array_atom, atom->nmax, size_peratom_cols, "flow/force:array_atom");
  for (; nmax < atom->nmax; nmax++) std::fill_n(array_atom[nmax], size_peratom_cols, 0.0);
}

/* ----------------------------------------------------------------------
   time for which the forces act on the velocities
------------------------------------------------------------------------- */

double FixFlowForce::mobility(int i, double in_steps_of) const
{
  if (!(atom->mask[i] & groupbit) || in_steps_of != step()) return 1.0;
  return apf::mobility_in_steps(step() * stokes_rate(2.0 * atom->radius[i], atom->rmass[i]));
}

/* ---------------------------------------------------------------------- */

double FixFlowForce::stokes_rate(double d, double mass) const
{
  const double slip = model.mean_free_path > 0.0 ? apf::slip_correction(model.mean_free_path, d)
                                                 : 1.0;
  return apf::stokes_resistance(model.viscosity, d) / (slip * mass);
}

/* ---------------------------------------------------------------------- */

double FixFlowForce::step() const
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    return part * dynamic_cast<Respa *>(update->integrate)->step[ilevel_respa];
  return part * update->dt;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::relax(int i, apf::Slow &slow) const
{
  const auto &r = relaxations[i];
  add(slow.a, r.a);
  add(slow.alpha, r.alpha);
  slow.rate += r.rate;
  slow.spin_rate += r.spin_rate;
}

double FixFlowForce::share(int i) const
{
  return relaxations[i].share;
}

/* ----------------------------------------------------------------------
   sums over the group: 1-3 = drag, 4-6 = gravity less buoyancy, 7-21 = the other forces,
   22-24 = all that was added to the forces on the particles, 25-27 = force on the grid
------------------------------------------------------------------------- */

double FixFlowForce::compute_vector(int n)
{
  if (!summed) {
    double mine[n_sums];
    for (int k = 0; k < n_sums; k++)
      mine[k] = std::accumulate(parts[k], parts[k] + apf::sum_parts, 0.0);
    MPI_Allreduce(mine, total_all, n_sums, MPI_DOUBLE, MPI_SUM, world);
    summed = true;
  }
  return total_all[n];
}

/* ---------------------------------------------------------------------- */

double FixFlowForce::memory_usage()
{
  return (double) nmax * size_peratom_cols * sizeof(double) + sizeof(Block) +
      relaxations.capacity() * sizeof(Relaxation);
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::reset_grid()
{
  if (feedback) feedback->set_up();
}
