// The bodies as contact forces were last computed with: LAMMPS's atoms in the rows that the kernel
// reads. Leapfrog steps compute forces with velocities half a step older than the positions. Who
// looks at contacts later, or goes on from the end of a run or from a restart file, needs these
// velocities again: those of the atoms have moved on by then.

#ifndef APF_USED_VELOCITY_H
#define APF_USED_VELOCITY_H

#include "atom.h"
#include "contact/bodies.h"

#include <algorithm>
#include <array>
#include <vector>

namespace LAMMPS_NS {

class UsedVelocity {
 public:
  static constexpr int size = 15;    // doubles per atom that migrate with it

  apf::Bodies bodies;    // rows: local and ghost atoms

  explicit UsedVelocity(bool planar) : bodies(planar) {}

  void grow(int nmax)
  {
    if (static_cast<int>(end.size()) >= nmax) return;
    end.resize(nmax);
    due.resize(nmax);
    bodies.resize(nmax);
  }

  // positions and velocities as they are now
  void use(const Atom *atom)
  {
    use_positions(atom);
    const int n = atom->nlocal + atom->nghost;
    if (n) bodies.set_motion_all(n, rows_of(atom->v), rows_of(atom->omega));
  }

  void use_positions(const Atom *atom)
  {
    const int n = atom->nlocal + atom->nghost;
    if (n) bodies.place_all(n, rows_of(atom->x));
  }

  // true if all local atoms have the velocities with which the last run ended
  bool goes_on(const Atom *atom) const
  {
    for (int i = 0; i < atom->nlocal; i++)
      if (now(atom, i) != end[i]) return false;
    return true;
  }

  // at the end of a run and before a restart file; loads [atoms][3]: see apf::DueLoad
  void remember(const Atom *atom, const std::vector<double> &loads)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      end[i] = now(atom, i);
      std::copy_n(&loads[3 * i], 3, due[i].begin());
    }
  }
  const std::array<double, 3> &due_load(int i) const { return due[i]; }

  void insert(int i)
  {
    end[i].fill(NAN);    // matches nothing
    due[i].fill(0.0);
  }
  void copy(int from, int to)
  {
    end[to] = end[from];
    due[to] = due[from];
    bodies.copy_row(bodies, from, to);
  }

  int pack(int i, double *buf) const
  {
    buf = std::copy(end[i].begin(), end[i].end(), buf);
    buf = std::copy(due[i].begin(), due[i].end(), buf);
    bodies.motion(i, buf, buf + 3);
    return size;
  }

  int unpack(int i, const double *buf)
  {
    std::copy(buf, buf + 6, end[i].begin());
    std::copy(buf + 6, buf + 9, due[i].begin());
    bodies.set_motion(i, buf + 9, buf + 12);
    return size;
  }

 private:
  using Six = std::array<double, 6>;         // velocity and angular velocity
  std::vector<Six> end;                      // at the end of the last run
  std::vector<std::array<double, 3>> due;    // part of the loads then

  // LAMMPS's arrays are contiguous
  static const double (*rows_of(double **a))[3]
  {
    return reinterpret_cast<const double(*)[3]>(a[0]);
  }

  static Six now(const Atom *atom, int i)
  {
    const double *u = atom->v[i], *w = atom->omega[i];
    return {u[0], u[1], u[2], w[0], w[1], w[2]};
  }
};

}    // namespace LAMMPS_NS

#endif
