// Compiled once per instruction set (CMakeLists.txt); APF_ISA names the namespace of this copy.

#include "contact_kernel.h"
#include "pack.h"

#include <algorithm>
#include <cstddef>
#include <type_traits>

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

using Real = Pack<APF_REGISTER_BYTES>;

// Contacts that are treated together: a whole block, or a part of it.
constexpr int width = Real::width;
static_assert(ContactList::width % width == 0, "a group lies in one block");

template <class Frame> using RowOf = std::conditional_t<Frame::planar, PlaneRow, SpaceRow>;

// The bodies and kinds of a group of contacts. An incomplete group is filled up with its last
// contact between copies of its bodies, so that all groups are treated alike.
template <class Row> struct Members {
  Row *i[width], *j[width];
  int kind[width];

  APF_INLINE Members(const ContactList &list, Row *rows, int first, Row (&copies)[2])
  {
    const int *of_i = &list.i[first], *of_j = &list.j[first], *of_kind = &list.kind[first];
    const int n = list.size() - first;
    if (n >= width) {
      for (int l = 0; l < width; l++) i[l] = rows + of_i[l];
      for (int l = 0; l < width; l++) j[l] = rows + of_j[l];
      std::memcpy(kind, of_kind, sizeof(kind));
    } else {
      copies[0] = rows[of_i[n - 1]];
      copies[1] = rows[of_j[n - 1]];
      for (int l = 0; l < width; l++) {
        i[l] = l < n ? rows + of_i[l] : copies;
        j[l] = l < n ? rows + of_j[l] : copies + 1;
        kind[l] = of_kind[l < n ? l : n - 1];
      }
    }
  }
};

// Constants of a group's contacts, which often are those of the group before.
class GroupConstants {
 public:
  GroupConstants() { std::fill(loaded, loaded + width, -1); }
  APF_INLINE const ConstantsOf<Real> &of(const ContactKinds &kinds, const int (&wanted)[width])
  {
    if (std::memcmp(wanted, loaded, sizeof(loaded)) != 0) load(kinds, wanted);
    return constants;
  }

 private:
  static constexpr int n = sizeof(ConstantsOf<double>) / sizeof(double);
  static_assert(n % 4 == 0, "groups of four");
  ConstantsOf<Real> constants;
  int loaded[width];

  __attribute__((noinline)) void load(const ContactKinds &kinds, const int (&wanted)[width])
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
    std::memcpy(loaded, wanted, sizeof(loaded));
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

template <bool torques>
APF_INLINE void scatter(const Members<PlaneRow> &m, const ContactOutput<PlaneFrame<Real>> &out)
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

template <bool torques>
APF_INLINE void scatter(const Members<SpaceRow> &m, const ContactOutput<SpaceFrame<Real>> &out)
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

// ---- histories

using PlaneMemory = ContactMemory<PlaneFrame<Real>>;
using SpaceMemory = ContactMemory<SpaceFrame<Real>>;

template <bool sliding, bool twisting, bool rolling>
APF_INLINE void recall(ContactList &list, int first, PlaneMemory &memory)
{
  const auto &block = list.blocks[first / ContactList::width];
  const int at = first % ContactList::width;
  if constexpr (sliding) memory.sliding = Real::load(block.sliding + at);
  if constexpr (rolling) memory.rolling = Real::load(block.rolling + at);
}

template <bool sliding, bool twisting, bool rolling>
APF_INLINE void keep(ContactList &list, int first, const PlaneMemory &memory)
{
  auto &block = list.blocks[first / ContactList::width];
  const int at = first % ContactList::width;
  if constexpr (sliding) memory.sliding.store(block.sliding + at);
  if constexpr (rolling) memory.rolling.store(block.rolling + at);
}

template <bool sliding, bool twisting, bool rolling>
APF_INLINE void recall(ContactList &list, int first, SpaceMemory &memory)
{
  const auto &block = list.blocks[first / ContactList::width];
  const auto &space = list.space_blocks[first / ContactList::width];
  const int at = first % ContactList::width;
  const auto vector = [at](const auto &x, const auto &y, const auto &z) {
    return Vector3<Real>{Real::load(x + at), Real::load(y + at), Real::load(z + at)};
  };
  if constexpr (sliding) memory.sliding = vector(block.sliding, space.sliding[0], space.sliding[1]);
  if constexpr (rolling) memory.rolling = vector(block.rolling, space.rolling[0], space.rolling[1]);
  if constexpr (twisting) memory.twisting = Real::load(space.twisting + at);
  if constexpr (sliding || rolling)
    memory.normal = vector(space.normal[0], space.normal[1], space.normal[2]);
}

template <bool sliding, bool twisting, bool rolling>
APF_INLINE void keep(ContactList &list, int first, const SpaceMemory &memory)
{
  auto &block = list.blocks[first / ContactList::width];
  auto &space = list.space_blocks[first / ContactList::width];
  const int at = first % ContactList::width;
  const auto store = [at](const Vector3<Real> &u, auto &x, auto &y, auto &z) {
    u.x.store(x + at);
    u.y.store(y + at);
    u.z.store(z + at);
  };
  if constexpr (sliding) store(memory.sliding, block.sliding, space.sliding[0], space.sliding[1]);
  if constexpr (rolling) store(memory.rolling, block.rolling, space.rolling[0], space.rolling[1]);
  if constexpr (twisting) memory.twisting.store(space.twisting + at);
  if constexpr (sliding || rolling)
    store(memory.normal, space.normal[0], space.normal[1], space.normal[2]);
}

// ---- parts

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

template <class Frame>
ContactParts report(const ContactList &list, int k, const ContactInput<Frame> &in,
                    const ContactOutput<Frame> &out)
{
  const Lane lane{k % width};
  const ContactConstants c = list.constants_of(k);
  const ContactHistory h = list.history_of(k);
  const double s = lane(out.s), s2 = s * s, kt = c.kt * s2;
  ContactParts p{};
  p.overlap = lane(out.overlap);
  p.contact_radius = c.R * s2;
  p.elastic = lane(out.elastic);
  p.damping = lane(out.damping);
  p.twisting = lane(out.twisting);
  lane.copy(p.force, out.force);
  double sliding2, rolling2;
  if constexpr (Frame::planar) {
    const Frame frame{(1.0 / sqrt(dot(in.d, in.d))) * in.d};
    lane.copy(p.sliding, frame.force(out.sliding));
    p.rolling[2] = lane(out.rolling);
    sliding2 = h.sliding[0] * h.sliding[0];
    rolling2 = h.rolling[0] * h.rolling[0];
  } else {
    lane.copy(p.sliding, out.sliding);
    lane.copy(p.rolling, out.rolling);
    sliding2 = norm2(Vec3{h.sliding[0], h.sliding[1], h.sliding[2]});
    rolling2 = norm2(Vec3{h.rolling[0], h.rolling[1], h.rolling[2]});
  }
  if (!list.ended(k)) {
    p.elastic_energy = JKR{c.R, c.K, c.neck}.energy(s);
    p.sliding_energy = 0.5 * kt * sliding2;
    p.rolling_energy = 0.5 * c.roll_k * s2 * s * rolling2 * c.inv_R;
    p.twisting_energy = 0.25 * kt * p.contact_radius * p.contact_radius * h.twisting * h.twisting;
  }
  return p;
}

template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling, bool reports>
APF_INLINE int all_blocks(ContactList &list, Bodies &bodies, ContactTimes times,
                          ContactParts *parts)
{
  auto *rows = bodies.rows<RowOf<Frame>>();
  const int size = list.size();
  GroupConstants constants;
  Real ended = 0.0;
  RowOf<Frame> copies[2];
  for (int first = 0; first < size; first += width) {
    const int at = first % ContactList::width;
    const Members members(list, rows, first, copies);
    auto &block = list.blocks[first / ContactList::width];
    const ConstantsOf<Real> &c = constants.of(list.kinds, members.kind);
    ContactMemory<Frame> memory;
    recall<sliding, twisting, rolling>(list, first, memory);

    ContactInput<Frame> in = gather(members);
    in.crowd_mass = Real::load(block.crowd_mass + at);
    if constexpr (rolling) in.crowd_roll = Real::load(block.crowd_roll + at);
    const auto out = contact_law<Frame, adhesion, sliding, twisting, rolling>(c, in, times, memory);
    scatter<sliding || rolling>(members, out);

    if (!reports || times.advance > 0.0)    // a look at the parts must not change the run
      keep<sliding, twisting, rolling>(list, first, memory);
    out.overlap.store(block.overlap + at);
    ended = ended + select(out.overlap < c.break_overlap, Real(1.0), Real(0.0));
    if constexpr (reports)
      for (int l = 0; l < width && first + l < size; l++)
        parts[first + l] = report<Frame>(list, first + l, in, out);
  }
  double sum = 0.0;
  for (int l = 0; l < width; l++) sum += ended.lane(l);
  // the last contact stood also in the lanes behind it
  const int repeated = (width - size % width) % width;
  return static_cast<int>(sum) - (repeated && list.ended(size - 1) ? repeated : 0);
}

template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactParts *parts)
{
  return parts
      ? all_blocks<Frame, adhesion, sliding, twisting, rolling, true>(list, bodies, times, parts)
      : all_blocks<Frame, adhesion, sliding, twisting, rolling, false>(list, bodies, times,
                                                                       nullptr);
}

template <class Frame, bool adhesion, bool sliding, bool twisting>
ContactKernel with_rolling(const KernelChoice &c)
{
  return c.rolling ? kernel<Frame, adhesion, sliding, twisting, true>
                   : kernel<Frame, adhesion, sliding, twisting, false>;
}

template <class Frame, bool adhesion, bool sliding>
ContactKernel with_twisting(const KernelChoice &c)
{
  if constexpr (sliding &&
                !Frame::planar)    // its limit is the friction limit: none without sliding
    if (c.twisting) return with_rolling<Frame, adhesion, sliding, true>(c);
  return with_rolling<Frame, adhesion, sliding, false>(c);
}

template <class Frame, bool adhesion> ContactKernel with_sliding(const KernelChoice &c)
{
  return c.sliding ? with_twisting<Frame, adhesion, true>(c)
                   : with_twisting<Frame, adhesion, false>(c);
}

template <class Frame> ContactKernel with_adhesion(const KernelChoice &c)
{
  return c.adhesion ? with_sliding<Frame, true>(c) : with_sliding<Frame, false>(c);
}

ContactKernel contact_kernel(const KernelChoice &choice)
{
  return choice.planar ? with_adhesion<PlaneFrame<Real>>(choice)
                       : with_adhesion<SpaceFrame<Real>>(choice);
}

}    // namespace apf::APF_ISA
