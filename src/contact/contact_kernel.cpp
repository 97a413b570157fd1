// Compiled once per instruction set (cmake/core.cmake).

#include "contact_kernel.h"
#include "kernel_groups.h"

namespace apf::APF_ISA {

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
    p.elastic_energy = JKR{c.R, c.K, c.root_unit}.energy(s);
    p.sliding_energy = 0.5 * kt * sliding2;
    p.rolling_energy = 0.5 * c.roll_k * s2 * s * rolling2 * c.inv_R;
    p.twisting_energy = 0.25 * kt * p.contact_radius * p.contact_radius * h.twisting * h.twisting;
  }
  return p;
}

static_assert(ContactList::width % width == 0, "a group lies in one block");

template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling, bool reports>
APF_INLINE int all_blocks(ContactList &list, Bodies &bodies, ContactTimes times,
                          ContactReader *reader)
{
  auto *rows = bodies.rows<RowOf<Frame>>();
  const int size = list.size();
  GroupConstants<ConstantsOf, ContactKind> constants;
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

    if (times.advance > 0.0)    // a look must not change the run
      keep<sliding, twisting, rolling>(list, first, memory);
    out.overlap.store(block.overlap + at);
    ended = ended + select(out.overlap < c.break_overlap, Real(1.0), Real(0.0));
    if constexpr (reports)
      for (int l = 0; l < width && first + l < size; l++)
        reader->read(first + l, report<Frame>(list, first + l, in, out));
  }
  double sum = 0.0;
  for (int l = 0; l < width; l++) sum += ended.lane(l);
  // the last contact stood also in the lanes behind it
  const int repeated = (width - size % width) % width;
  return static_cast<int>(sum) - (repeated && list.ended(size - 1) ? repeated : 0);
}

template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactReader *reader)
{
  return reader
      ? all_blocks<Frame, adhesion, sliding, twisting, rolling, true>(list, bodies, times, reader)
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
