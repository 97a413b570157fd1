// The velocities that contact forces were last computed with. Leapfrog steps compute forces with
// velocities half a step older than the positions. Who looks at contacts later, or goes on from the
// end of a run or from a restart file, needs these again: velocities have moved on by then.

#ifndef APF_USED_VELOCITY_H
#define APF_USED_VELOCITY_H

#include "atom.h"

#include <algorithm>
#include <array>
#include <vector>

namespace LAMMPS_NS {

class UsedVelocity {
 public:
  static constexpr int size = 12;    // doubles per atom that migrate with it

  std::vector<double> v, omega;    // [local and ghost atoms][3], contiguous

  void grow(int nmax)
  {
    if (static_cast<int>(end.size()) >= nmax) return;
    end.resize(nmax);
    v.resize(3 * static_cast<size_t>(nmax));
    omega.resize(3 * static_cast<size_t>(nmax));
  }

  void use(const Atom *atom)
  {
    const int n = 3 * (atom->nlocal + atom->nghost);
    if (n == 0) return;
    std::copy(&atom->v[0][0], &atom->v[0][0] + n, v.begin());
    std::copy(&atom->omega[0][0], &atom->omega[0][0] + n, omega.begin());
  }

  // true if all local atoms have the velocities with which the last run ended
  bool goes_on(const Atom *atom) const
  {
    for (int i = 0; i < atom->nlocal; i++)
      if (now(atom, i) != end[i]) return false;
    return true;
  }

  // at the end of a run and before a restart file
  void remember(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) end[i] = now(atom, i);
  }

  void insert(int i) { end[i].fill(NAN); }    // matches nothing
  void copy(int from, int to)
  {
    end[to] = end[from];
    std::copy(&v[3 * from], &v[3 * from] + 3, &v[3 * to]);
    std::copy(&omega[3 * from], &omega[3 * from] + 3, &omega[3 * to]);
  }

  int pack(int i, double *buf) const
  {
    buf = std::copy(end[i].begin(), end[i].end(), buf);
    buf = std::copy(&v[3 * i], &v[3 * i] + 3, buf);
    std::copy(&omega[3 * i], &omega[3 * i] + 3, buf);
    return size;
  }

  int unpack(int i, const double *buf)
  {
    std::copy(buf, buf + 6, end[i].begin());
    std::copy(buf + 6, buf + 9, &v[3 * i]);
    std::copy(buf + 9, buf + 12, &omega[3 * i]);
    return size;
  }

 private:
  using Six = std::array<double, 6>;    // velocity and angular velocity
  std::vector<Six> end;                 // at the end of the last run

  static Six now(const Atom *atom, int i)
  {
    const double *u = atom->v[i], *w = atom->omega[i];
    return {u[0], u[1], u[2], w[0], w[1], w[2]};
  }
};

}    // namespace LAMMPS_NS

#endif
