// Velocities at the time of the positions, for friction and damping.
//
// When velocity Verlet computes forces, positions stand at t + dt and velocities at t + dt/2.
// Contact laws that use both corrupt static friction between unequal particles (arXiv:2410.14798),
// so the velocities are carried on by the acceleration of the last step:
//   v(t + dt) = v(t + dt/2) + [v(t + dt/2) - v(t - dt/2)] / 2
//
// It also remembers, at the end of a run, which velocities its last forces were computed with: a
// run that goes on from there, or from a restart file, gets the same forces again, to the last bit.

#ifndef APF_SYNCHRONOUS_VELOCITY_H
#define APF_SYNCHRONOUS_VELOCITY_H

#include "atom.h"

#include <algorithm>
#include <array>
#include <vector>

namespace LAMMPS_NS {

class SynchronousVelocity {
 public:
  static constexpr int size = 24;    // doubles per atom that migrate with it

  std::vector<double> v, omega;    // [atoms][3] contiguous; ghosts are the owner's business

  void grow(int nmax)
  {
    if (static_cast<int>(last.size()) >= nmax) return;
    last.resize(nmax);
    kick.resize(nmax);
    used.resize(nmax);
    end.resize(nmax);
    v.resize(3 * static_cast<size_t>(nmax));
    omega.resize(3 * static_cast<size_t>(nmax));
  }

  // Before the first force computation of a run: velocities stand at the time of the positions.
  void start(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      last[i] = read(atom, i);
      kick[i] = {};
      set(i, last[i] == end[i] ? used[i] : last[i]);
    }
    first_step = true;
  }

  // Before every other force computation. Where an outer level of r-RESPA has just kicked, the
  // change since the last inner step is no acceleration: the one before is kept.
  void predict(const Atom *atom, bool outer_kick)
  {
    const double share = first_step ? 1.0 : 0.5;
    for (int i = 0; i < atom->nlocal; i++) {
      const Six now = read(atom, i);
      Six at_x;
      for (int c = 0; c < 6; c++) {
        const double change = share * (now[c] - last[i][c]);
        kick[i][c] = outer_kick ? kick[i][c] : change;
        at_x[c] = now[c] + kick[i][c];
      }
      last[i] = now;
      set(i, at_x);
    }
    first_step = false;
  }

  // At the end of a run and before a restart file.
  void remember(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      end[i] = read(atom, i);
      std::copy(&v[3 * i], &v[3 * i] + 3, used[i].begin());
      std::copy(&omega[3 * i], &omega[3 * i] + 3, used[i].begin() + 3);
    }
  }

  void insert(const Atom *atom, int i)
  {
    last[i] = read(atom, i);
    kick[i] = used[i] = end[i] = {};
  }

  void copy(int from, int to)
  {
    for (auto *array : {&last, &kick, &used, &end}) (*array)[to] = (*array)[from];
    std::copy(&v[3 * from], &v[3 * from] + 3, &v[3 * to]);
    std::copy(&omega[3 * from], &omega[3 * from] + 3, &omega[3 * to]);
  }

  int pack(int i, double *buf) const
  {
    for (const auto *array : {&last, &kick, &used, &end})
      buf = std::copy((*array)[i].begin(), (*array)[i].end(), buf);
    return size;
  }

  int unpack(int i, const double *buf)
  {
    for (auto *array : {&last, &kick, &used, &end}) {
      std::copy(buf, buf + 6, (*array)[i].begin());
      buf += 6;
    }
    return size;
  }

 private:
  using Six = std::array<double, 6>;    // velocity and angular velocity
  std::vector<Six> last;                // half a step before the last positions
  std::vector<Six> kick;                // what half a step adds to them
  std::vector<Six> used;                // those of the last force computation of a run
  std::vector<Six> end;                 // those at the end of that run
  bool first_step = true;

  static Six read(const Atom *atom, int i)
  {
    const double *u = atom->v[i], *w = atom->omega[i];
    return {u[0], u[1], u[2], w[0], w[1], w[2]};
  }
  void set(int i, const Six &six)
  {
    std::copy(six.begin(), six.begin() + 3, &v[3 * i]);
    std::copy(six.begin() + 3, six.end(), &omega[3 * i]);
  }
};

}    // namespace LAMMPS_NS

#endif
