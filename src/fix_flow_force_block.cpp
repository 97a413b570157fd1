// Between the atoms and a block of fix flow/force: gathers what the forces need, scatters them, and
// adds up what goes into sums, virial, the grid of feedback and the integrator.

#include "fix_flow_force.h"

#include "atom.h"
#include "domain.h"
#include "error.h"
#include "fix_flow_concentration.h"
#include "fix_nve_sphere_mts.h"
#include "update.h"

#include <algorithm>

using namespace LAMMPS_NS;

namespace {

apf::Vec3 at(const apf::Lanes (&a)[3], int l)
{
  return {a[0][l], a[1][l], a[2][l]};
}

}    // namespace

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
