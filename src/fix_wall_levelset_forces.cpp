// The forces of the contacts of a wall: from particles to the rows of the kernel, and back.

#include "fix_wall_levelset.h"

#include "atom.h"
#include "contact/jump.h"
#include "error.h"
#include "fix_contact_history.h"

using namespace LAMMPS_NS;

/* ----------------------------------------------------------------------
   rows of the kernel: particle and foot point
------------------------------------------------------------------------- */

// The particles' rows: position and velocity of the last forces, and the loads of all contacts.
apf::Bodies &FixWallLevelset::particles()
{
  return lender ? lender->bodies() : velocities.bodies;
}

// follow: where the curvature of a wall is not the same everywhere, normals turn from now on as it
// says where the particle is, to 1/16
void FixWallLevelset::gather(bool follow)
{
  const int n = contacts.size();
  rows.resize(2 * n);
  double x[3], kappa[2] = {};
  for (int k = 0; k < n; k++) {
    const int i = contacts.source[k], s = surface_of[k];
    const bool turns = follow && !surfaces[s].uniform;
    particles().position(i, x);
    copy_rows(rows, k, i, foot_of(s, x, turns ? kappa : nullptr));
    if (turns) turn_on(k, surfaces[s].turning(kappa[0], atom->radius[i]));
  }
  rows.clear_loads(0, 2 * n);
}

void FixWallLevelset::turn_on(int k, double turning)
{
  if (turning == turning_of[k]) return;
  turning_of[k] = turning;
  auto bodies = bodies_of(contacts.source[k], surface_of[k]);
  bodies.turning = turning;
  contacts.change_kind(k, contacts.kinds.find(surface_of[k], coefficient.model, bodies));
}

// rows 2k and 2k+1: a particle and its foot point on a surface
void FixWallLevelset::copy_rows(apf::Bodies &to, int k, int i, int surface)
{
  double x[3];
  particles().position(i, x);
  copy_rows(to, k, i, foot_of(surface, x));
}

void FixWallLevelset::copy_rows(apf::Bodies &to, int k, int i, const apf::Foot &foot)
{
  if (foot.distance <= 0.0 || !foot.exists)
    error->one(
        FLERR, Error::NOLASTLINE,
        "{} {}: the centre of atom {} passed the wall{}; use a smaller timestep or a larger E",
        command, id, atom->tag[i], of_file());
  to.copy_row(particles(), i, 2 * k);
  to.place(2 * k + 1, foot.at);
  if (!motion.pose.moves) return;
  const auto v = motion.pose.velocity_at(foot.at), &w = motion.pose.spin;
  const double v_wall[3] = {v.x, v.y, v.z}, spin[3] = {w.x, w.y, w.z};
  to.set_motion(2 * k + 1, v_wall, spin);
}

/* ---------------------------------------------------------------------- */

// Forces of all contacts, those from number `made` on being new; returns how many have ended.
int FixWallLevelset::add_forces(const apf::ContactTimes &times, int made)
{
  const int ended = kernel(contacts, rows, times, nullptr);
  std::vector<apf::DueLoad> of_rows;
  if (times.advance > 0.0 && (ended || made < contacts.size()))
    rows.with_rows([&](auto *r) {
      for (int k = made; k < contacts.size(); k++)
        apf::correct_touch(contacts, k, r, times.advance, of_rows);
      for (int k = 0; k < contacts.size(); k++)
        if (contacts.ended(k)) apf::correct_end(contacts, k, r, times.advance, of_rows);
    });
  for (const auto &load : of_rows)
    if (load.row % 2 == 0)
      due.push_back({contacts.source[load.row / 2], {load.f[0], load.f[1], load.f[2]}});
  return_loads(rows, contacts.source);
  return ended;
}

// What is due from the last run acts along the line through a particle's centre and its foot point.
void FixWallLevelset::add_due()
{
  const double no_torque[3] = {};
  for (const auto &[i, f] : due) {
    particles().add_load(i, f, no_torque);
    const double *x = atom->x[i];
    // of the nearest surface: the contact itself may be gone
    auto &loads = ledger.load(zone_of(i, nearest(x, ~Marks(0)).surface));
    for (int c = 0; c < 3; c++) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      atom->f[i][c] += f[c];
      loads[c] -= f[c];
      loads[3 + c] -= x[a] * f[b] - x[b] * f[a];
    }
  }
}

// what the wall exerts on particles goes to their rows
void FixWallLevelset::return_loads(const apf::Bodies &from, const std::vector<int> &atoms)
{
  auto &to = particles();
  for (int k = 0; k < static_cast<int>(atoms.size()); k++) {
    double f[3] = {}, torque[3] = {};
    from.add_load_to(2 * k, f, torque);
    to.add_load(atoms[k], f, torque);
  }
}

// ... and to LAMMPS: forces on particles and on the wall, virial
void FixWallLevelset::tally(const apf::Bodies &from, const std::vector<int> &atoms,
                            const std::vector<int> &surfaces_of)
{
  for (int k = 0; k < static_cast<int>(atoms.size()); k++) {
    const int i = atoms[k];
    double f[3] = {}, torque[3] = {}, on_wall[3] = {}, moment[3] = {}, foot[3];
    from.add_load_to(2 * k, f, torque);
    from.add_load_to(2 * k + 1, on_wall, moment);
    from.position(2 * k + 1, foot);
    auto &loads = ledger.load(ledger.zone_of(surfaces_of[k], foot));
    for (int c = 0; c < 3; c++) {
      atom->f[i][c] += f[c];
      atom->torque[i][c] += torque[c];
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      loads[c] += on_wall[c];
      loads[3 + c] += foot[a] * on_wall[b] - foot[b] * on_wall[a] + moment[c];
    }
    if (evflag) {
      const double *x = atom->x[i];
      const double d[3] = {x[0] - foot[0], x[1] - foot[1], x[2] - foot[2]};
      double virial_of_contact[6] = {d[0] * f[0], d[1] * f[1], d[2] * f[2],
                                     d[0] * f[1], d[0] * f[2], d[1] * f[2]};
      int one = i;
      v_tally(1, &one, 1.0, virial_of_contact);
    }
  }
}
