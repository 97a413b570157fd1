// Compiled without vectorisation and without contraction (CMakeLists.txt).

#include "scalar_kernel.h"

namespace apf_test {

using namespace apf;

namespace {

  Vec2 in_frame(const double (&u)[3], const Vec2 &)
  {
    return {u[0], u[1]};
  }
  Vec3 in_frame(const double (&u)[3], const Vec3 &)
  {
    return {u[0], u[1], u[2]};
  }
  double spin_in_frame(const double (&u)[3], double)
  {
    return u[2];
  }
  Vec3 spin_in_frame(const double (&u)[3], const Vec3 &)
  {
    return {u[0], u[1], u[2]};
  }
  void copy(const Vec2 &u, double (&to)[3])
  {
    to[0] = u.x;
    to[1] = u.y;
  }
  void copy(const Vec3 &u, double (&to)[3])
  {
    to[0] = u.x;
    to[1] = u.y;
    to[2] = u.z;
  }
  void copy_tangent(double u, double (&to)[3])
  {
    to[0] = u;
  }
  void copy_tangent(const Vec3 &u, double (&to)[3])
  {
    copy(u, to);
  }
  void copy_spin(double u, double (&to)[3])
  {
    to[2] = u;
  }
  void copy_spin(const Vec3 &u, double (&to)[3])
  {
    copy(u, to);
  }
  double tangent_in_frame(const double (&u)[3], double)
  {
    return u[0];
  }
  Vec3 tangent_in_frame(const double (&u)[3], const Vec3 &)
  {
    return {u[0], u[1], u[2]};
  }

  template <class Frame>
  ContactInput<Frame> gather(const Bodies &bodies, int i, int j, double mass, double roll)
  {
    using Vector = typename Frame::Vector;
    using Spin = typename Frame::Spin;
    double xi[3], xj[3], vi[3], vj[3], wi[3], wj[3], d[3], v[3];
    bodies.position(i, xi);
    bodies.position(j, xj);
    bodies.motion(i, vi, wi);
    bodies.motion(j, vj, wj);
    for (int c = 0; c < 3; c++) {
      d[c] = xj[c] - xi[c];
      v[c] = vi[c] - vj[c];
    }
    return {in_frame(d, Vector()),
            in_frame(v, Vector()),
            spin_in_frame(wi, Spin()),
            spin_in_frame(wj, Spin()),
            mass,
            roll};
  }

  template <class Output> void scatter(Bodies &bodies, int i, int j, const Output &out)
  {
    double f[3]{}, torque_i[3]{}, torque_j[3]{};
    copy(out.force, f);
    copy_spin(out.torque_i, torque_i);
    copy_spin(out.torque_j, torque_j);
    bodies.add_load(i, f, torque_i);
    for (double &component : f) component = -component;
    bodies.add_load(j, f, torque_j);
  }

  template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
  int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactReader *)
  {
    using Vector = typename Frame::Vector;
    using Tangent = typename Frame::Tangent;
    int ended = 0;
    for (int k = 0; k < list.size(); k++) {
      const int i = list.i[k], j = list.j[k];
      const ContactConstants constants = list.constants_of(k);
      const auto in = gather<Frame>(bodies, i, j, constants.crowd_mass, constants.crowd_roll);
      ContactHistory h = list.history_of(k);
      ContactMemory<Frame> memory{tangent_in_frame(h.sliding, Tangent()),
                                  tangent_in_frame(h.rolling, Tangent()), h.twisting,
                                  in_frame(h.normal, Vector())};
      const auto out =
          contact_law<Frame, adhesion, sliding, twisting, rolling>(constants, in, times, memory);

      scatter(bodies, i, j, out);
      if (sliding) copy_tangent(memory.sliding, h.sliding);
      if (rolling) copy_tangent(memory.rolling, h.rolling);
      if (twisting && !Frame::planar) h.twisting = memory.twisting;
      if ((sliding || rolling) && !Frame::planar) copy(memory.normal, h.normal);
      list.update(k, out.overlap, times.advance > 0.0 ? h : list.history_of(k));
      ended += list.ended(k);
    }
    return ended;
  }

  template <class Frame, bool... chosen> ContactKernel choose(const KernelChoice &c)
  {
    constexpr int n = sizeof...(chosen);
    if constexpr (n == 4) {
      return kernel<Frame, chosen...>;
    } else {
      const bool wanted[4] = {c.adhesion, c.sliding, c.twisting && c.sliding && !Frame::planar,
                              c.rolling};
      return wanted[n] ? choose<Frame, chosen..., true>(c) : choose<Frame, chosen..., false>(c);
    }
  }

  template <class Frame, bool viscous, bool fitted, bool tangential>
  int bridges(BridgeList &list, Bodies &bodies, ContactTimes times, BridgeParts *)
  {
    int ended = 0;
    for (int k = 0; k < list.size(); k++) {
      auto &block = list.blocks[k / BridgeList::width];
      const int l = k % BridgeList::width, i = list.i[k], j = list.j[k];
      const BridgeConstants c = list.constants(k);
      const auto in = gather<Frame>(bodies, i, j, block.mass[l], 0.0);
      const BridgeState<double> state{block.formed[l], block.touching[l]};
      const auto out = bridge_law<Frame, viscous, fitted, tangential>(c, c, in, state, times);
      scatter(bodies, i, j, out);
      block.gap[l] = out.gap;
      block.ended[l] = out.ended;
      ended += list.ended(k);
    }
    return ended;
  }

  template <class Frame, bool... chosen> BridgeKernel choose_bridges(const BridgeChoice &c)
  {
    constexpr int n = sizeof...(chosen);
    if constexpr (n == 3) {
      return bridges<Frame, chosen...>;
    } else {
      const bool wanted[3] = {c.viscous, c.fitted, c.tangential};
      return wanted[n] ? choose_bridges<Frame, chosen..., true>(c)
                       : choose_bridges<Frame, chosen..., false>(c);
    }
  }

}    // namespace

BridgeKernel scalar_bridges(const BridgeChoice &choice)
{
  return choice.planar ? choose_bridges<PlaneFrame<double>>(choice)
                       : choose_bridges<SpaceFrame<double>>(choice);
}

ContactKernel scalar_kernel(const KernelChoice &choice)
{
  return choice.planar ? choose<PlaneFrame<double>>(choice) : choose<SpaceFrame<double>>(choice);
}

}    // namespace apf_test
