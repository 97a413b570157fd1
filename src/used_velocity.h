// The bodies as contact forces were last computed with: LAMMPS's atoms in the rows that the kernel
// reads. Leapfrog steps compute forces with velocities half a step older than the positions. Who
// looks at contacts later, or goes on from the end of a run or from a restart file, needs these
// velocities again: those of the atoms have moved on by then.

#ifndef APF_USED_VELOCITY_H
#define APF_USED_VELOCITY_H

#include "atom.h"
#include "atom_rows.h"
#include "contact/bodies.h"
#include "restart_state.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <unordered_map>
#include <vector>

namespace LAMMPS_NS {

class UsedVelocity {
 public:
  static constexpr int size = 10;    // doubles per atom that migrate with it

  // rows: local and ghost atoms; there are none before the first use
  apf::Bodies bodies;

  explicit UsedVelocity(bool planar) : bodies(planar) {}

  void grow(int nmax)
  {
    if (static_cast<int>(end.size()) >= nmax) return;
    end.resize(nmax, unknown);
    if (bodies.size()) bodies.resize(nmax);
  }

  // positions and velocities as they are now, no loads
  void use(const Atom *atom)
  {
    make_rows();
    const int n = atom->nlocal + atom->nghost;
    if (n) bodies.set_all(n, rows_of(atom->x), rows_of(atom->v), rows_of(atom->omega));
  }

  void use_positions(const Atom *atom)
  {
    make_rows();
    const int n = atom->nlocal + atom->nghost;
    if (n) bodies.place_all(n, rows_of(atom->x));
    bodies.clear_loads(0, n);
  }

  // true if all local atoms have the velocities with which the last run ended
  bool goes_on(const Atom *atom) const
  {
    for (int i = 0; i < atom->nlocal; i++)
      if (end[i] != now(atom, i)) return false;
    return true;
  }

  // at the end of a run and before a restart file; loads [atoms][3]: see apf::DueLoad
  void remember(const Atom *atom, const std::vector<double> &loads)
  {
    due.clear();
    for (int i = 0; i < atom->nlocal; i++) {
      if (bodies.size()) end[i] = now(atom, i);
      set_due(i, &loads[3 * i]);
    }
  }
  std::array<double, 3> due_load(int i) const
  {
    const auto found = due.find(i);
    return found == due.end() ? std::array<double, 3>{} : found->second;
  }

  void insert(int i)
  {
    end[i] = unknown;
    due.erase(i);
  }
  void copy(int from, int to)
  {
    end[to] = end[from];
    if (!due.empty()) set_due(to, due_load(from).data());
    if (bodies.size()) bodies.copy_row(bodies, from, to);
  }

  int pack(int i, double *buf) const
  {
    memcpy(buf, &end[i], sizeof(double));
    const auto load = due_load(i);
    std::copy(load.begin(), load.end(), buf + 1);
    std::fill(buf + 4, buf + size, 0.0);
    if (bodies.size()) bodies.motion(i, buf + 4, buf + 7);
    return size;
  }

  int unpack(int i, const double *buf)
  {
    memcpy(&end[i], buf, sizeof(double));
    set_due(i, buf + 1);
    if (end[i] != unknown) make_rows();
    if (bodies.size()) bodies.set_motion(i, buf + 4, buf + 7);
    return size;
  }

  // an error where numbers of a restart file cannot be those that pack writes
  static void check(RestartNumbers &packed)
  {
    packed.bits(1);    // compared only
    packed.next(size - 1);
  }

  double memory_usage() const    // [bytes]
  {
    return bodies.memory_usage() + end.capacity() * sizeof(uint64_t);
  }

 private:
  // Velocities at the end of the last run are compared, not used: 64 bits of them are enough.
  static constexpr uint64_t unknown = 0;
  std::vector<uint64_t> end;
  std::unordered_map<int, std::array<double, 3>> due;    // part of the loads then, if there is any

  void make_rows()
  {
    if (bodies.size() == 0) bodies.resize(static_cast<int>(end.size()));
  }
  void set_due(int i, const double *load)
  {
    if (load[0] != 0.0 || load[1] != 0.0 || load[2] != 0.0)
      due[i] = {load[0], load[1], load[2]};
    else
      due.erase(i);
  }

  static uint64_t now(const Atom *atom, int i)
  {
    uint64_t hash = 1, bits[6];
    memcpy(bits, atom->v[i], 3 * sizeof(double));
    memcpy(bits + 3, atom->omega[i], 3 * sizeof(double));
    for (const uint64_t value : bits) {
      hash = (hash ^ value) * 0x9E3779B97F4A7C15ull;
      hash ^= hash >> 29;
    }
    return hash == unknown ? unknown + 1 : hash;
  }
};

}    // namespace LAMMPS_NS

#endif
