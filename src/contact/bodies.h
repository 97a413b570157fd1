// The bodies that contacts join: one row of numbers per body, position, velocity, spin and the load
// that contacts put on it side by side. A contact touches one cache line of each of its two bodies
// in the plane and two in space; rows are whole numbers of vector registers.

#ifndef APF_BODIES_H
#define APF_BODIES_H

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace apf {

// What contacts read stands before what they add to, so that writing a load never holds up reading
// the next contact's velocities; both in pieces of two and four for vector loads of the kernel.

// in the xy plane: spins and torques about z
struct alignas(64) PlaneRow {
  static constexpr int dim = 2, spin_dim = 1;
  double x[2];         // position                                             [length]
  double v[2];         // velocity                                             [length/time]
  double omega[1];     // angular velocity                                     [1/time]
  double torque[1];    // torque of the contacts                               [force length]
  double f[2];         // force of the contacts                                [force]
};

struct alignas(128) SpaceRow {
  static constexpr int dim = 3, spin_dim = 3;
  double x[3];
  double v[3];
  double omega[3];
  double unused;
  double f[3];
  double torque[3];
};

// Relative velocity of the surfaces of two spheres where they touch, squared: nothing in a rigid
// rotation of the pair.
inline double contact_speed2(const PlaneRow &i, const PlaneRow &j, double ri, double rj)
{
  const double d[2] = {j.x[0] - i.x[0], j.x[1] - i.x[1]};
  const double inv = 1.0 / std::sqrt(d[0] * d[0] + d[1] * d[1]);
  const double spin = (ri * i.omega[0] + rj * j.omega[0]) * inv;
  const double u = i.v[0] - j.v[0] - spin * d[1], v = i.v[1] - j.v[1] + spin * d[0];
  return u * u + v * v;
}
inline double contact_speed2(const SpaceRow &i, const SpaceRow &j, double ri, double rj)
{
  double d[3], w[3], d2 = 0.0, sum = 0.0;
  for (int c = 0; c < 3; c++) {
    d[c] = j.x[c] - i.x[c];
    w[c] = ri * i.omega[c] + rj * j.omega[c];
    d2 += d[c] * d[c];
  }
  const double inv = 1.0 / std::sqrt(d2);
  for (int c = 0; c < 3; c++) {
    const int a = (c + 1) % 3, b = (c + 2) % 3;
    const double u = i.v[c] - j.v[c] + inv * (w[a] * d[b] - w[b] * d[a]);
    sum += u * u;
  }
  return sum;
}

class Bodies {
 public:
  explicit Bodies(bool planar = false) : flat(planar) {}

  bool planar() const { return flat; }
  int size() const { return static_cast<int>(flat ? plane.size() : space.size()); }

  // calls action(rows) with the rows as the planar or the spatial code sees them
  template <class Action> void with_rows(Action action)
  {
    if (flat)
      action(plane.data());
    else
      action(space.data());
  }

  template <class Action> void with_rows(Action action) const
  {
    if (flat)
      action(plane.data());
    else
      action(space.data());
  }

  // new rows are zero
  void resize(int n)
  {
    if (flat)
      plane.resize(n);
    else
      space.resize(n);
    touched.resize(n, 1);
  }

  // Contacts may put loads on row i, through with_rows() or rows(). Most bodies of a dilute cloud
  // have none: set_all() and those who read loads then leave that half of their rows alone.
  void touch(int i) { touched[i] = 1; }
  bool may_have_load(int i) const { return touched[i]; }
  // Contacts have ended: set_all() makes a new start, after which those that are left have to touch
  // their bodies again.
  void forget_touched() { starts_anew = true; }
  bool forgets_touched() const { return starts_anew; }

  // rows as the planar or the spatial code sees them
  template <class Row> Row *rows();
  template <class Row> const Row *rows() const { return const_cast<Bodies *>(this)->rows<Row>(); }

  // x, v, omega are [3], also in the plane
  void place(int i, const double *x)
  {
    with_row(i, [x](auto &row) {
      copy(x, row.x);
    });
  }
  void set_motion(int i, const double *v, const double *omega)
  {
    with_row(i, [v, omega](auto &row) {
      copy(v, row.v);
      copy(omega + 3 - row.spin_dim, row.omega);
    });
  }
  void position(int i, double *x) const
  {
    with_row(i, [x](const auto &row) {
      x[2] = 0.0;
      copy(row.x, x);
    });
  }
  void motion(int i, double *v, double *omega) const
  {
    with_row(i, [v, omega](const auto &row) {
      v[2] = omega[0] = omega[1] = 0.0;
      copy(row.v, v);
      copy(row.omega, omega + 3 - row.spin_dim);
    });
  }

  // the first n rows at once; x, v, omega, f, torque are [n][3]; set_all() leaves no loads
  void place_all(int n, const double (*x)[3])
  {
    with_rows([=](auto *row) {
      for (int i = 0; i < n; i++) copy(&x[i][0], row[i].x);
    });
  }
  void set_all(int n, const double (*x)[3], const double (*v)[3], const double (*omega)[3])
  {
    with_rows([=](auto *row) {
      for (int i = 0; i < n; i++) {
        copy(&x[i][0], row[i].x);
        copy(&v[i][0], row[i].v);
        copy(&omega[i][3 - row->spin_dim], row[i].omega);
        if (touched[i]) clear(row[i]);
      }
    });
    if (starts_anew) std::fill_n(touched.begin(), n, 0);
    starts_anew = false;
  }
  void add_loads_to_all(int n, double (*f)[3], double (*torque)[3]) const
  {
    with_rows([=](const auto *row) {
      for (int i = 0; i < n; i++) {
        if (!touched[i]) continue;
        add(row[i].f, &f[i][0]);
        add(row[i].torque, &torque[i][3 - row->spin_dim]);
      }
    });
  }

  void clear_loads(int first, int last)
  {
    with_rows([=](auto *row) {
      for (int i = first; i < last; i++) clear(row[i]);
    });
  }
  // adds to f[3] and torque[3] the load of a row, or to the row a load f[3], torque[3]
  void add_load_to(int i, double *f, double *torque) const
  {
    if (!touched[i]) return;
    with_row(i, [f, torque](const auto &row) {
      add(row.f, f);
      add(row.torque, torque + 3 - row.spin_dim);
    });
  }
  void add_load(int i, const double *f, const double *torque)
  {
    touch(i);
    with_row(i, [f, torque](auto &row) {
      add(f, row.f);
      add(torque + 3 - row.spin_dim, row.torque);
    });
  }

  // row `to` becomes what row i of `from` is; both planar, or none
  void copy_row(const Bodies &from, int i, int to)
  {
    if (flat)
      plane[to] = from.plane[i];
    else
      space[to] = from.space[i];
    touch(to);
  }

  double memory_usage() const    // [bytes]
  {
    return plane.capacity() * sizeof(PlaneRow) + space.capacity() * sizeof(SpaceRow) +
        touched.capacity();
  }

 private:
  template <class Row> static void clear(Row &row)
  {
    for (double &c : row.f) c = 0.0;
    for (double &c : row.torque) c = 0.0;
  }

  bool flat;
  std::vector<PlaneRow> plane;    // one of the two is used
  std::vector<SpaceRow> space;
  std::vector<char> touched;    // rows that may have loads
  bool starts_anew = true;

  template <class Action> void with_row(int i, Action action)
  {
    if (flat)
      action(plane[i]);
    else
      action(space[i]);
  }
  template <class Action> void with_row(int i, Action action) const
  {
    if (flat)
      action(plane[i]);
    else
      action(space[i]);
  }

  template <size_t n> static void copy(const double *from, double (&to)[n])
  {
    for (size_t c = 0; c < n; c++) to[c] = from[c];
  }
  template <size_t n> static void copy(const double (&from)[n], double *to)
  {
    for (size_t c = 0; c < n; c++) to[c] = from[c];
  }
  template <size_t n> static void add(const double *from, double (&to)[n])
  {
    for (size_t c = 0; c < n; c++) to[c] += from[c];
  }
  template <size_t n> static void add(const double (&from)[n], double *to)
  {
    for (size_t c = 0; c < n; c++) to[c] += from[c];
  }
};

template <> inline PlaneRow *Bodies::rows<PlaneRow>()
{
  return plane.data();
}
template <> inline SpaceRow *Bodies::rows<SpaceRow>()
{
  return space.data();
}

}    // namespace apf

#endif
