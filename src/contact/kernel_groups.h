// What the kernels of contacts and of bridges share: groups of them whose numbers fill vector
// registers, and how the rows of their bodies come there and back. For files that are compiled once
// per instruction set (cmake/core.cmake); APF_ISA names the namespace of this copy.

#ifndef APF_KERNEL_GROUPS_H
#define APF_KERNEL_GROUPS_H

#include "contact_law.h"
#include "pack_rows.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

using Real = Pack<APF_REGISTER_BYTES>;

// Contacts that are treated together: a whole block of a list, or a part of it.
constexpr int width = Real::width;

template <class Frame> using RowOf = std::conditional_t<Frame::planar, PlaneRow, SpaceRow>;

// The bodies and kinds of a group of contacts. An incomplete group is filled up with its last
// contact between copies of its bodies, so that all groups are treated alike.
template <class Row> struct Members {
  Row *i[width], *j[width];
  const int *kind;
  int filled[width];    // kinds of an incomplete group

  template <class List> APF_INLINE Members(const List &list, Row *rows, int first, Row (&copies)[2])
  {
    const int *of_i = &list.i[first], *of_j = &list.j[first], *of_kind = &list.kind[first];
    const int n = list.size() - first;
    if (n >= width) {
      for (int l = 0; l < width; l++) i[l] = rows + of_i[l];
      for (int l = 0; l < width; l++) j[l] = rows + of_j[l];
      kind = of_kind;
    } else {
      copies[0] = rows[of_i[n - 1]];
      copies[1] = rows[of_j[n - 1]];
      for (int l = 0; l < width; l++) {
        i[l] = l < n ? rows + of_i[l] : copies;
        j[l] = l < n ? rows + of_j[l] : copies + 1;
        filled[l] = of_kind[l < n ? l : n - 1];
      }
      kind = filled;
    }
  }
};

// Constants of a group's contacts, which often are those of the group before.
template <template <class> class Constants, class Kind> class GroupConstants {
 public:
  GroupConstants() { std::fill(loaded, loaded + width, -1); }
  APF_INLINE const Constants<Real> &of(const Kinds<Kind> &kinds, const int *wanted)
  {
    int differences = 0;
    for (int l = 0; l < width; l++) differences |= wanted[l] ^ loaded[l];
    if (differences) load(kinds, wanted);
    return constants;
  }

 private:
  static constexpr int n = sizeof(Constants<double>) / sizeof(double);
  static_assert(n % 4 == 0, "groups of four");
  Constants<Real> constants;
  int loaded[width];

  __attribute__((noinline)) void load(const Kinds<Kind> &kinds, const int *wanted)
  {
    const double *from[width];
    for (int l = 0; l < width; l++)
      from[l] = reinterpret_cast<const double *>(&kinds.constants(wanted[l]));
    Real *to = reinterpret_cast<Real *>(&constants);
    for (int c = 0; c < n; c += 4)
      from_rows(
          [&from, c](int l, int part, auto type) {
            return apf::load<decltype(type)>(from[l] + c + part);
          },
          *reinterpret_cast<Real(*)[4]>(to + c));
    std::copy_n(wanted, width, loaded);
  }
};

// ---- gather and scatter, for the layout of rows in bodies.h

APF_INLINE ContactInput<PlaneFrame<Real>> gather(const Members<PlaneRow> &m)
{
  Real xv[4];
  from_rows(
      [&m](int l, int c, auto type) {
        using Part = decltype(type);
        return load<Part>(m.j[l]->x + c) - load<Part>(m.i[l]->x + c);
      },
      xv);
  ContactInput<PlaneFrame<Real>> in;
  in.d = {xv[0], xv[1]};
  in.v = {-xv[2], -xv[3]};
  for (int l = 0; l < width; l++) {
    in.spin_i.set_lane(l, m.i[l]->omega[0]);
    in.spin_j.set_lane(l, m.j[l]->omega[0]);
  }
  return in;
}

APF_INLINE ContactInput<SpaceFrame<Real>> gather(const Members<SpaceRow> &m)
{
  Real xv[4], vv[2], spin_i[4], spin_j[4];
  from_rows(
      [&m](int l, int c, auto type) {
        using Part = decltype(type);
        return load<Part>(m.j[l]->x + c) - load<Part>(m.i[l]->x + c);
      },
      xv);
  from_rows(
      [&m](int l, int c, auto type) {
        using Part = decltype(type);
        return load<Part>(m.i[l]->v + 1 + c) - load<Part>(m.j[l]->v + 1 + c);
      },
      vv);
  from_rows(
      [&m](int l, int c, auto type) {
        return load<decltype(type)>(m.i[l]->omega + c);
      },
      spin_i);
  from_rows(
      [&m](int l, int c, auto type) {
        return load<decltype(type)>(m.j[l]->omega + c);
      },
      spin_j);
  ContactInput<SpaceFrame<Real>> in;
  in.d = {xv[0], xv[1], xv[2]};
  in.v = {-xv[3], vv[0], vv[1]};
  in.spin_i = {spin_i[0], spin_i[1], spin_i[2]};
  in.spin_j = {spin_j[0], spin_j[1], spin_j[2]};
  return in;
}

template <bool torques, template <class> class Output>
APF_INLINE void scatter(const Members<PlaneRow> &m, const Output<PlaneFrame<Real>> &out)
{
  to_rows(out.force.x, out.force.y, [&m](int l, int, const Pair &part) {
    add_to(m.i[l]->f, part);
    add_to(m.j[l]->f, Pair(-part));
  });
  if constexpr (torques)
    for (int l = 0; l < width; l++) {
      m.i[l]->torque[0] += out.torque_i.lane(l);
      m.j[l]->torque[0] += out.torque_j.lane(l);
    }
}

template <bool torques, template <class> class Output>
APF_INLINE void scatter(const Members<SpaceRow> &m, const Output<SpaceFrame<Real>> &out)
{
  const auto &f = out.force, &ti = out.torque_i, &tj = out.torque_j;
  to_rows(f.x, f.y, [&m](int l, int, const Pair &part) {
    add_to(m.i[l]->f, part);
    add_to(m.j[l]->f, Pair(-part));
  });
  if constexpr (torques) {
    to_rows(f.z, ti.x, ti.y, ti.z, [&m](int l, int c, const auto &part) {
      add_to(m.i[l]->f + 2 + c, part);
    });
    to_rows(-f.z, tj.x, tj.y, tj.z, [&m](int l, int c, const auto &part) {
      add_to(m.j[l]->f + 2 + c, part);
    });
  } else {
    for (int l = 0; l < width; l++) {
      m.i[l]->f[2] += f.z.lane(l);
      m.j[l]->f[2] -= f.z.lane(l);
    }
  }
}

// numbers of one of the group, for those who ask for parts
struct Lane {
  int l;
  APF_INLINE double operator()(const Real &a) const { return a.lane(l); }
  void copy(double *to, const Vector2<Real> &u) const
  {
    to[0] = u.x.lane(l);
    to[1] = u.y.lane(l);
  }
  void copy(double *to, const Vector3<Real> &u) const
  {
    to[0] = u.x.lane(l);
    to[1] = u.y.lane(l);
    to[2] = u.z.lane(l);
  }
};

}    // namespace apf::APF_ISA

#endif
