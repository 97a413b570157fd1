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

  // of the normal law, 0 at a = 0. JKR: Chokshi, Tielens, Hollenbach, doi:10.1086/172562
  double elastic_energy(const ContactConstants &c, double overlap, double a)
  {
    if (c.neck6 == 0.0) return 0.4 * c.K * c.R * std::pow(std::max(overlap, 0.0) / c.R, 2.5);
    const double a0 = c.R * std::cbrt(c.neck6 * c.neck6), h = a / a0;
    const double pulloff_force = 0.25 * c.K * c.neck6 * c.neck6;
    const double pulloff_overlap = a0 * a0 / (2.0 * std::cbrt(6.0) * c.R);
    return 4.0 * std::cbrt(6.0) * pulloff_force * pulloff_overlap *
        (0.8 * std::pow(h, 5.0) - 4.0 / 3.0 * std::pow(h, 3.5) + h * h / 3.0);
  }

  template <class Frame>
  ContactParts parts_of(const ContactConstants &c, const ContactHistory &h,
                        const ContactInput<Frame> &in, const ContactOutput<Frame> &out)
  {
    const Frame frame{(1.0 / std::sqrt(dot(in.d, in.d))) * in.d};
    ContactParts p{};
    p.overlap = out.overlap;
    p.contact_radius = c.R * out.s * out.s;
    p.elastic = out.elastic;
    p.damping = out.damping;
    copy(frame.force(out.sliding), p.sliding);
    copy_spin(out.rolling, p.rolling);
    p.twisting = out.twisting;
    copy(out.force, p.force);
    if (out.overlap < c.break_overlap) return p;
    const double a = p.contact_radius;
    const double k_sliding = c.kt * a / c.R;                       // 8 G a, eq (25)
    const double k_twisting = 0.5 * k_sliding * a * a;             // eq (31)
    const double k_rolling = c.roll_k * std::pow(a / c.R, 1.5);    // 4 F_C (a/a0)^(3/2), eq (44)
    const auto slid = tangent_in_frame(h.sliding, typename Frame::Tangent()),
               rolled = tangent_in_frame(h.rolling, typename Frame::Tangent());
    p.elastic_energy = elastic_energy(c, out.overlap, a);
    p.sliding_energy = 0.5 * k_sliding * norm2(slid);
    p.twisting_energy = 0.5 * k_twisting * h.twisting * h.twisting;
    p.rolling_energy = 0.5 * k_rolling * norm2(rolled) / c.R;    // displacement over R: angle
    return p;
  }

  template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
  int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactReader *reader)
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
      if (reader) reader->read(k, parts_of(constants, list.history_of(k), in, out));
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
