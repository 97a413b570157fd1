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

  template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
  int kernel(ContactList &list, Bodies &bodies, ContactTimes times, ContactParts *)
  {
    using Vector = typename Frame::Vector;
    using Spin = typename Frame::Spin;
    using Tangent = typename Frame::Tangent;
    int ended = 0;
    for (int k = 0; k < list.size(); k++) {
      const int i = list.i[k], j = list.j[k];
      double xi[3], xj[3], vi[3], vj[3], wi[3], wj[3], d[3], v[3];
      bodies.position(i, xi);
      bodies.position(j, xj);
      bodies.motion(i, vi, wi);
      bodies.motion(j, vj, wj);
      for (int c = 0; c < 3; c++) {
        d[c] = xj[c] - xi[c];
        v[c] = vi[c] - vj[c];
      }
      const ContactConstants constants = list.constants_of(k);
      const ContactInput<Frame> in{in_frame(d, Vector()),     in_frame(v, Vector()),
                                   spin_in_frame(wi, Spin()), spin_in_frame(wj, Spin()),
                                   constants.crowd_mass,      constants.crowd_roll};
      ContactHistory h = list.history_of(k);
      ContactMemory<Frame> memory{tangent_in_frame(h.sliding, Tangent()),
                                  tangent_in_frame(h.rolling, Tangent()), h.twisting,
                                  in_frame(h.normal, Vector())};
      const auto out =
          contact_law<Frame, adhesion, sliding, twisting, rolling>(constants, in, times, memory);

      double f[3]{}, torque_i[3]{}, torque_j[3]{};
      copy(out.force, f);
      copy_spin(out.torque_i, torque_i);
      copy_spin(out.torque_j, torque_j);
      bodies.add_load(i, f, torque_i);
      for (double &component : f) component = -component;
      bodies.add_load(j, f, torque_j);

      if (sliding) copy_tangent(memory.sliding, h.sliding);
      if (rolling) copy_tangent(memory.rolling, h.rolling);
      if (twisting && !Frame::planar) h.twisting = memory.twisting;
      if ((sliding || rolling) && !Frame::planar) copy(memory.normal, h.normal);
      list.update(k, out.overlap, h);
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

}    // namespace

ContactKernel scalar_kernel(const KernelChoice &choice)
{
  return choice.planar ? choose<PlaneFrame<double>>(choice) : choose<SpaceFrame<double>>(choice);
}

}    // namespace apf_test
