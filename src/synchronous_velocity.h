// Velocities at the time of the positions, for friction and damping.
//
// When velocity Verlet computes forces, positions stand at t + dt and velocities at t + dt/2. Contact
// laws that use both corrupt static friction between unequal particles (arXiv:2410.14798), so the
// velocities are carried on by the acceleration of the last step:
//   v(t + dt) = v(t + dt/2) + [v(t + dt/2) - v(t - dt/2)] / 2
//
// It also remembers, at the end of a run, which velocities its last forces were computed with: a run
// that goes on from there, or from a restart file, gets the same forces again, to the last bit.

#ifndef APF_SYNCHRONOUS_VELOCITY_H
#define APF_SYNCHRONOUS_VELOCITY_H

#include "atom.h"

#include <algorithm>
#include <vector>

namespace LAMMPS_NS {

class SynchronousVelocity {
 public:
  static constexpr int size = 24;    // doubles per atom that migrate with it

  std::vector<double> v, omega;    // [atoms][3] contiguous; ghosts are the owner's business

  void grow(int nmax)
  {
    if (static_cast<int>(state.size()) >= nmax) return;
    state.resize(nmax);
    v.resize(3 * static_cast<size_t>(nmax));
    omega.resize(3 * static_cast<size_t>(nmax));
  }

  // Before the first force computation of a run: velocities stand at the time of the positions.
  void start(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      State &s = state[i];
      double now[6];
      read(atom, i, now);
      const bool goes_on = std::equal(now, now + 6, s.end);
      std::fill(s.kick, s.kick + 6, 0.0);
      std::copy(now, now + 6, s.last);
      set(i, goes_on ? s.used : now);
    }
    first_step = true;
  }

  // After the first half of a step: velocities at t + dt/2. Where an outer level of r-RESPA has
  // just kicked, the change since the last inner step is no acceleration: the former one is kept.
  void advance(const Atom *atom, bool outer_kick)
  {
    const double share = first_step ? 1.0 : 0.5;
    for (int i = 0; i < atom->nlocal; i++) {
      State &s = state[i];
      double now[6];
      read(atom, i, now);
      for (int c = 0; c < 6; c++) {
        if (!outer_kick) s.kick[c] = share * (now[c] - s.last[c]);
        s.last[c] = now[c];
      }
    }
    first_step = false;
  }

  // Before the forces: v and omega of local atoms.
  void predict(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      double now[6];
      read(atom, i, now);
      for (int c = 0; c < 6; c++) now[c] += state[i].kick[c];
      set(i, now);
    }
  }

  // At the end of a run and before a restart file.
  void remember(const Atom *atom)
  {
    for (int i = 0; i < atom->nlocal; i++) {
      State &s = state[i];
      read(atom, i, s.end);
      std::copy(&v[3 * i], &v[3 * i] + 3, s.used);
      std::copy(&omega[3 * i], &omega[3 * i] + 3, s.used + 3);
    }
  }

  void insert(const Atom *atom, int i)
  {
    state[i] = State{};
    read(atom, i, state[i].last);
  }
  void copy(int from, int to)
  {
    state[to] = state[from];
    std::copy(&v[3 * from], &v[3 * from] + 3, &v[3 * to]);
    std::copy(&omega[3 * from], &omega[3 * from] + 3, &omega[3 * to]);
  }
  int pack(int i, double *buf) const
  {
    const auto *from = reinterpret_cast<const double *>(&state[i]);
    std::copy(from, from + size, buf);
    return size;
  }
  int unpack(int i, const double *buf)
  {
    std::copy(buf, buf + size, reinterpret_cast<double *>(&state[i]));
    return size;
  }

 private:
  struct State {
    double last[6] = {};    // velocity and angular velocity half a step before
    double kick[6] = {};    // what half a step adds to them
    double used[6] = {};    // those of the last force computation of a run
    double end[6] = {};     // those at the end of that run
  };
  std::vector<State> state;
  bool first_step = true;

  static void read(const Atom *atom, int i, double *to)
  {
    std::copy(atom->v[i], atom->v[i] + 3, to);
    std::copy(atom->omega[i], atom->omega[i] + 3, to + 3);
  }
  void set(int i, const double *from)
  {
    std::copy(from, from + 3, &v[3 * i]);
    std::copy(from + 3, from + 6, &omega[3 * i]);
  }
};

}    // namespace LAMMPS_NS

#endif
