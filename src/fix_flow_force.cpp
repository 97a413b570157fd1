#include "fix_flow_force.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_concentration.h"
#include "fix_flow_field.h"
#include "fix_nve_sphere_mts.h"
#include "force.h"
#include "memory.h"
#include "modify.h"
#include "respa.h"
#include "update.h"

#include <algorithm>
#include <numeric>

using namespace LAMMPS_NS;
using namespace FixConst;

namespace {

apf::Vec3 at(const apf::Lanes (&a)[3], int l)
{
  return {a[0][l], a[1][l], a[2][l]};
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
    FixPerGrid(lmp, narg, arg), block(std::make_unique<Block>()), fluid_forces(apf::fluid_forces()),
    rows(apf::lane_rows()), parts{}, total_all{}
{
  if (narg < 4) utils::missing_cmd_args(FLERR, "fix flow/force", error);
  if (!atom->radius_flag || !atom->rmass_flag || !atom->omega_flag || !atom->torque_flag)
    error->all(FLERR, "Fix flow/force requires atom_style sphere, got {}", atom->get_style());

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
  if (force->ftm2v != 1.0)
    error->all(FLERR, Error::NOLASTLINE,
               "Fix flow/force requires units where force = mass * acceleration "
               "(lj, si, cgs, micro, nano), got {}",
               update->unit_style);
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

double FixFlowForce::step() const
{
  if (utils::strmatch(update->integrate_style, "^respa"))
    return part * dynamic_cast<Respa *>(update->integrate)->step[ilevel_respa];
  return part * update->dt;
}

/* ----------------------------------------------------------------------
   next atoms of the group from local atom first on; return the first atom after them
------------------------------------------------------------------------- */

int FixFlowForce::choose(int first)
{
  int *const atoms = block->atom;
  int n = 0, i = first;
  for (const int nlocal = atom->nlocal; i < nlocal && n < apf::block_width; i++) {
    atoms[n] = i;
    n += (atom->mask[i] & groupbit) != 0;
  }
  block->forces.n = block->points.n = n;
  block->together = n > 0 && atoms[n - 1] - atoms[0] == n - 1;
  return i;
}

/* ---------------------------------------------------------------------- */

int FixFlowForce::gather(int first, double whole, double sub)
{
  const int end = choose(first), n = block->forces.n, *const atoms = block->atom;
  auto &to = block->forces;
  for (int l = 0; l < n; l++) {
    to.diameter[l] = 2.0 * atom->radius[atoms[l]];
    to.mass[l] = atom->rmass[atoms[l]];
  }
  std::fill_n(to.step, n, whole);
  if (sub_stepper)
    for (int l = 0; l < n; l++)
      if (sub_stepper->step_of(atoms[l]) < update->dt) to.step[l] = sub;
  take_rows(atom->x, block->points.x);
  take_rows(atom->v, to.velocity);
  take_rows(atom->f, to.other_force);
  if (model.torque || model.magnus) take_rows(atom->omega, to.spin);
  if (model.torque) take_rows(atom->torque, to.other_torque);
  std::fill(to.diameter + n, to.diameter + apf::block_width, 1.0);
  std::fill(to.mass + n, to.mass + apf::block_width, 1.0);
  if (model.brownian)
    for (int l = 0; l < n; l++) to.tag[l] = static_cast<std::uint64_t>(atom->tag[atoms[l]]);
  if (model.hindered()) {
    if (cloud)
      cloud->sample(block->points, to.concentration);
    else
      std::fill_n(to.concentration, n, concentration);
  }
  if (model.planar)
    for (auto *out_of_plane : {&to.velocity[2], &to.other_force[2], &to.spin[0], &to.spin[1],
                               &to.other_torque[0], &to.other_torque[1]})
      std::fill_n(*out_of_plane, n, 0.0);
  return end;
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::scatter()
{
  const auto &from = block->forces;
  add_rows(from.given, atom->f);
  if (model.torque) add_rows(from.torque, atom->torque);
  if (per_atom) put_rows(array_atom);
}

/* ----------------------------------------------------------------------
   rows of a per-atom array, to arrays of components and back
------------------------------------------------------------------------- */

void FixFlowForce::take_rows(double **from, apf::Lanes (&to)[3]) const
{
  const int n = block->forces.n, *atoms = block->atom;
  if (block->together)
    rows.take(from[atoms[0]], n, to);
  else
    for (int l = 0; l < n; l++)
      for (int c = 0; c < 3; c++) to[c][l] = from[atoms[l]][c];
}

void FixFlowForce::add_rows(const apf::Lanes (&from)[3], double **to) const
{
  const int n = block->forces.n, *atoms = block->atom;
  if (block->together)
    rows.add(from, n, to[atoms[0]]);
  else
    for (int l = 0; l < n; l++)
      for (int c = 0; c < 3; c++) to[atoms[l]][c] += from[c][l];
}

void FixFlowForce::put_rows(double **to) const
{
  const int n = block->forces.n, *atoms = block->atom;
  if (block->together)
    rows.put(outputs.data(), size_peratom_cols, n, to[atoms[0]]);
  else
    for (int l = 0; l < n; l++)
      for (int c = 0; c < size_peratom_cols; c++) to[atoms[l]][c] = (*outputs[c])[l];
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::add_up()
{
  const int n = block->forces.n;
  auto add_to = [this, n](int first, const apf::Lanes(&a)[3]) {
    for (int c = 0; c < 3; c++) rows.add_up(a[c], n, parts[first + c]);
  };
  add_to(0, block->forces.force[apf::DRAG]);
  for (const int k : columns) add_to(3 * k, block->forces.force[k]);
  add_to(3 * apf::n_fluid_forces, block->forces.given);
}

/* ---------------------------------------------------------------------- */

void FixFlowForce::keep_relaxation()
{
  const auto &from = block->forces;
  for (int l = 0; l < from.n; l++) {
    auto &to = relaxations[block->atom[l]];
    if (model.added_mass) to.share = from.share[l];
    to.rate = from.rate[l];
    to.a = to.rate * at(block->fluid.velocity, l) -
        (to.share / from.mass[l]) * at(from.force[apf::DRAG], l);
    if (!model.torque) continue;
    const double inverse_inertia = 10.0 / (from.mass[l] * from.diameter[l] * from.diameter[l]);
    to.spin_rate = from.spin_rate[l];
    to.alpha =
        (0.5 * to.spin_rate) * at(block->fluid.vorticity, l) - inverse_inertia * at(from.torque, l);
  }
}

/* ----------------------------------------------------------------------
   all forces of the fluid but weight less buoyancy act back on it
------------------------------------------------------------------------- */

void FixFlowForce::react()
{
  const auto &from = block->forces;
  for (int l = 0; l < from.n; l++) {
    apf::Vec3 force = at(from.force[apf::DRAG], l);
    for (const int k : columns)
      if (k != apf::WEIGHT) force = force + at(from.force[k], l);
    const double *x = atom->x[block->atom[l]];
    if (!feedback->add(x, force))
      error->one(FLERR, Error::NOLASTLINE,
                 "Fix flow/force {} feedback: a particle at {:.8g} {:.8g} {:.8g} lies outside the "
                 "box",
                 id, x[0], x[1], x[2]);
  }
}

/* ----------------------------------------------------------------------
   virial of an external force, as fix addforce counts it
------------------------------------------------------------------------- */

void FixFlowForce::tally()
{
  for (int l = 0; l < block->forces.n; l++) {
    const int i = block->atom[l];
    const apf::Vec3 force = at(block->forces.given, l);
    double r[3];
    domain->unmap(atom->x[i], atom->image[i], r);
    double virial[6] = {force.x * r[0], force.y * r[1], force.z * r[2],
                        force.x * r[1], force.x * r[2], force.y * r[2]};
    v_tally(i, virial);
  }
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
