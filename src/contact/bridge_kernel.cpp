// Compiled once per instruction set (cmake/core.cmake).

#include "bridge_kernel.h"

#include "kernel_groups.h"

namespace apf::APF_ISA {

static_assert(BridgeList::width % width == 0, "a group lies in one block");

template <bool fitted> APF_INLINE BridgeVolumeOf<Real> volume_of(const BridgeList &list, int first)
{
  const auto &block = list.blocks[first / BridgeList::width];
  const int at = first % BridgeList::width;
  BridgeVolumeOf<Real> v;
  v.b = Real::load(block.b + at);
  v.rupture = Real::load(block.rupture + at);
  v.inv_drag_min = Real::load(block.inv_drag_min + at);
  if constexpr (fitted) {
    const auto &fit = list.fit_blocks[first / BridgeList::width];
    v.fit = {Real::load(fit.f1 + at), Real::load(fit.f2 + at), Real::load(fit.f3 + at),
             Real::load(fit.f4 + at)};
    v.fit_scale = Real::load(fit.fit_scale + at);
  }
  return v;
}

template <class Frame>
BridgeParts report(const BridgeList &list, int k, const ContactInput<Frame> &in,
                   const BridgeOutput<Frame> &out)
{
  BridgeParts p{};
  if (list.ended(k)) return p;
  const Lane lane{k % width};
  p.gap = lane(out.gap);
  p.capillary = lane(out.capillary);
  p.viscous = lane(out.viscous);
  lane.copy(p.force, out.force);
  if constexpr (Frame::planar) {
    const Frame frame{inverse_root(dot(in.d, in.d)) * in.d};
    lane.copy(p.tangential, frame.force(out.tangential));
  } else {
    lane.copy(p.tangential, out.tangential);
  }
  p.energy = -list.constants(k).work(p.gap);
  return p;
}

template <class Frame, bool viscous, bool fitted, bool tangential, bool reports>
APF_INLINE int all_blocks(BridgeList &list, Bodies &bodies, ContactTimes times, BridgeParts *parts)
{
  auto *rows = bodies.rows<RowOf<Frame>>();
  const int size = list.size();
  GroupConstants<BridgeConstantsOf, BridgeKind> constants;
  Real ended = 0.0;
  RowOf<Frame> copies[2];
  for (int first = 0; first < size; first += width) {
    const int at = first % BridgeList::width;
    const Members members(list, rows, first, copies);
    auto &block = list.blocks[first / BridgeList::width];
    ContactInput<Frame> in = gather(members);
    in.crowd_mass = Real::load(block.mass + at);
    const BridgeState<Real> state{Real::load(block.formed + at), Real::load(block.touching + at)};
    const auto out = bridge_law<Frame, viscous, fitted, tangential>(
        constants.of(list.kinds, members.kind), volume_of<fitted>(list, first), in, state, times);
    scatter<tangential>(members, out);
    out.gap.store(block.gap + at);
    out.ended.store(block.ended + at);
    ended = ended + out.ended;
    if constexpr (reports)
      for (int l = 0; l < width && first + l < size; l++)
        parts[first + l] = report<Frame>(list, first + l, in, out);
  }
  double sum = 0.0;
  for (int l = 0; l < width; l++) sum += ended.lane(l);
  // lanes without a bridge do not count
  for (int k = size; k % width != 0; k++) sum -= list.ended(k);
  return static_cast<int>(sum);
}

template <class Frame, bool viscous, bool fitted, bool tangential>
int kernel(BridgeList &list, Bodies &bodies, ContactTimes times, BridgeParts *parts)
{
  return parts ? all_blocks<Frame, viscous, fitted, tangential, true>(list, bodies, times, parts)
               : all_blocks<Frame, viscous, fitted, tangential, false>(list, bodies, times, parts);
}

template <class Frame, bool... chosen> BridgeKernel choose(const BridgeChoice &c)
{
  constexpr int n = sizeof...(chosen);
  if constexpr (n == 3) {
    return kernel<Frame, chosen...>;
  } else {
    const bool wanted[] = {c.viscous, c.fitted, c.tangential};
    return wanted[n] ? choose<Frame, chosen..., true>(c) : choose<Frame, chosen..., false>(c);
  }
}

BridgeKernel bridge_kernel(const BridgeChoice &choice)
{
  return choice.planar ? choose<PlaneFrame<Real>>(choice) : choose<SpaceFrame<Real>>(choice);
}

}    // namespace apf::APF_ISA
