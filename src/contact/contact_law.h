// Force and torque of one contact: normal, sliding, twisting and rolling parts put together as in
// IIHR Report 459, eqs (15)-(44), with the corrections listed in doc/ (theory). Written once for
// space and for the plane: Frame says what a vector, a spin and a tangent are.
//
// n points from i to j. Velocities are i minus j. Compression and repulsion are positive.
//
// Velocities of a leapfrog step stand half a step before the positions. Split by the present normal
// they would turn closing into sliding and corrupt static friction (arXiv:2410.14798); split by the
// normal of their own time they give exactly the displacements of the step, and springs that are
// stretched by them lose no energy to the time step.

#ifndef APF_CONTACT_LAW_H
#define APF_CONTACT_LAW_H

#include "contact_list.h"
#include "slider.h"

namespace apf {

// Sub-models that a scene uses. What is false is not compiled into the kernel.
struct Parts {
  bool adhesion, sliding, twisting, rolling;
};

struct SpaceFrame {
  using Vector = Vec3;     // positions, velocities, forces
  using Spin = Vec3;       // angular velocities, torques
  using Tangent = Vec3;    // vectors in the contact plane
  static constexpr bool planar = false;

  Vec3 n;

  APF_INLINE Tangent slip(const Vec3 &v, double vn) const { return v - vn * n; }
  APF_INLINE Tangent slip_of_spin(const Spin &spin) const { return cross(spin, n); }
  // t of another contact plane, with normal m, by the smallest rotation from m to n
  APF_INLINE Tangent turned(const Vec3 &t, const Vec3 &m) const
  {
    return t - (dot(t, n) / (1.0 + dot(n, m))) * (n + m);
  }
  APF_INLINE Vec3 force(const Tangent &t) const { return t; }
  APF_INLINE Spin torque_of_force(const Tangent &t) const { return cross(n, t); }
};

struct PlaneFrame {
  using Vector = Vec2;
  using Spin = double;       // about z
  using Tangent = double;    // along (-n_y, n_x)
  static constexpr bool planar = true;

  Vec2 n;

  APF_INLINE Tangent slip(const Vec2 &v, double) const { return n.x * v.y - n.y * v.x; }
  APF_INLINE Tangent slip_of_spin(Spin spin) const { return spin; }
  APF_INLINE Tangent turned(Tangent t, const Vec2 &) const { return t; }
  APF_INLINE Vec2 force(Tangent t) const { return {-n.y * t, n.x * t}; }
  APF_INLINE Spin torque_of_force(Tangent t) const { return t; }
};

template <class Frame> struct ContactInput {
  typename Frame::Vector d;               // x_j - x_i
  typename Frame::Vector v;               // v_i - v_j
  typename Frame::Spin spin_i, spin_j;    // angular velocities
};

template <class Frame> struct ContactMemory {
  typename Frame::Tangent sliding{}, rolling{};
  double twisting = 0.0;
  typename Frame::Vector normal{};    // not used in the plane
};

template <class Frame> struct ContactOutput {
  typename Frame::Vector force{};    // on i; j gets the opposite
  typename Frame::Spin torque_i{}, torque_j{};
  double overlap = 0.0;
  // for ContactParts only; the compiler drops what nobody reads
  double s = 0.0, elastic = 0.0, damping = 0.0, twisting = 0.0;
  typename Frame::Tangent sliding{};
  typename Frame::Spin rolling{};
};

// Carries a vector of the contact plane along with the pair: the smallest rotation that takes the
// last normal to the present one, then the mean spin of the two bodies about it. Exact for finite
// steps. n, last: normals; scale = 1 / (1 + n . last); cosine, sine of the spin angle.
APF_INLINE Vec3 carried(const Vec3 &xi, const Vec3 &n, const Vec3 &last, double scale,
                        double cosine, double sine)
{
  const Vec3 tilted = xi - (dot(n, xi) * scale) * (n + last);
  const Vec3 tangent = tilted - dot(n, tilted) * n;    // rounding only
  return cosine * tangent + sine * cross(n, tangent);
}

struct ContactTimes {
  double
      advance;    // since the last call: histories grow by it; 0 evaluates only            [time]
  double
      behind;     // by which the velocities are older than the positions                    [time]
  double step;    // between calls, which limits dashpots; 0 = no limit                      [time]
};

// The largest dashpot constant that leapfrog steps bear beside a spring k: stable while
// eta dt/m < 2 - k dt^2 / (2 m), with m the mass that bodies with many contacts leave to one of
// them. It binds where a particle has several contacts and the step is large.
APF_INLINE double stable_dashpot(double k, double m, double step)
{
  const double most = 0.9 * (2.0 * m / step - 0.5 * k * step);
  return most > 0.0 ? most : 0.0;
}

APF_INLINE double smaller(double a, double b)
{
  return a < b ? a : b;
}

// The whole law.
template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
APF_INLINE ContactOutput<Frame> contact_law(const ContactConstants &c,
                                            const ContactInput<Frame> &in, ContactTimes times,
                                            ContactMemory<Frame> &memory)
{
  ContactOutput<Frame> out;
  const double distance = std::sqrt(dot(in.d, in.d));
  const double inv_distance = 1.0 / distance;
  const Frame frame{inv_distance * in.d};
  const double overlap = c.radius_sum - distance;
  const double closed = (overlap < c.break_overlap) ? 0.0 : 1.0;

  // normal
  double s;
  if constexpr (adhesion) {
    s = jkr_root(overlap, c.inv_R, c.neck);
  } else {
    const double x = overlap * c.inv_R;
    s = std::sqrt(std::sqrt(x > 0.0 ? x : 0.0));
  }
  const double s2 = s * s, s3 = s2 * s;
  const double neck3 = adhesion ? c.neck * c.neck * c.neck : 0.0;
  const double elastic = closed * c.K * s3 * (s3 - 6.0 * neck3);
  const double eta = closed * c.eta * s;
  // the normal when the bodies had the velocity v
  const auto d_mid = in.d + (times.behind * c.turning) * in.v;
  const Frame mid{(1.0 / std::sqrt(dot(d_mid, d_mid))) * d_mid};
  const double vn = dot(in.v, mid.n);
  const double kn = c.K * c.inv_R * s2;
  const double damping = smaller(eta, stable_dashpot(kn, c.crowd_mass, times.step)) * vn;

  out.overlap = overlap;
  out.s = s;
  out.elastic = elastic;
  out.damping = damping;
  out.force = (-(elastic + damping)) * frame.n;

  if constexpr (!Frame::planar && (sliding || rolling)) {
    const Vec3 n = frame.n, old = memory.normal;
    const double known = norm2(old) > 0.5 ? 1.0 : 0.0;    // 0 in the contact's first step
    const Vec3 last = known * old + (1.0 - known) * n;
    const double scale = 1.0 / (1.0 + dot(n, last));
    const double angle = 0.5 * times.advance * dot(in.spin_i + in.spin_j, n);
    const double q = 0.25 * angle * angle;    // Cayley form: a rotation for any angle
    const double inv = 1.0 / (1.0 + q);
    const double cosine = (1.0 - q) * inv, sine = angle * inv;
    if constexpr (sliding) memory.sliding = carried(memory.sliding, n, last, scale, cosine, sine);
    if constexpr (rolling) memory.rolling = carried(memory.rolling, n, last, scale, cosine, sine);
    memory.normal = frame.n;
  }

  // levers to the middle of the overlap (at a wall: to the wall): they add up to the distance, so
  // the pair's angular momentum is kept and a rigid rotation slides nothing
  const double arm_i = c.radius_i - c.arm_share * overlap;
  const double arm_j = distance - arm_i;

  if constexpr (sliding || twisting) {
    const double kt = c.kt * s2 + 1.0e-300;
    // a force at the surface of a sphere moves that surface as if it had 2/7 of the mass
    const double eta_t = smaller(eta, stable_dashpot(kt, (2.0 / 7.0) * c.crowd_mass, times.step));
    const double limit = closed * c.mu * std::fabs(elastic + c.adhesion);
    if constexpr (sliding) {
      const auto slip = frame.turned(
          mid.slip(in.v, vn) + mid.slip_of_spin(arm_i * in.spin_i + arm_j * in.spin_j), mid.n);
      const auto force = slider_force(kt, eta_t, limit, slip, times.advance, memory.sliding);
      out.sliding = force;
      out.force = out.force + frame.force(force);
      const auto torque = frame.torque_of_force(force);
      out.torque_i = arm_i * torque;
      out.torque_j = arm_j * torque;
    }
    if constexpr (twisting && !Frame::planar) {
      const double a = c.R * s2;
      const double share = 0.5 * a * a;    // eq (31)
      const double twist_rate = dot(in.spin_i - in.spin_j, mid.n);
      const double torque =
          slider_force(share * kt + 1.0e-300, share * eta_t, c.twist * (2.0 / 3.0) * a * limit,
                       twist_rate, times.advance, memory.twisting);
      out.twisting = torque;
      out.torque_i = out.torque_i + torque * frame.n;
      out.torque_j = out.torque_j - torque * frame.n;
    }
  }

  if constexpr (rolling) {
    const double k = c.roll_k * s3 + 1.0e-300;
    const double limit = closed * c.roll_k * s3 * c.roll_limit;
    const auto v_roll = (-c.R) * frame.turned(mid.slip_of_spin(in.spin_i - in.spin_j), mid.n);
    const double eta_r = smaller(closed * c.roll_eta * s * std::sqrt(s),
                                 stable_dashpot(k, c.crowd_roll, times.step));
    const auto moment = slider_force(k, eta_r, limit, v_roll, times.advance, memory.rolling);
    out.rolling = -frame.torque_of_force(moment);    // moment x n, eq (15)
    out.torque_i = out.torque_i + out.rolling;
    out.torque_j = out.torque_j - out.rolling;
  }
  return out;
}

}    // namespace apf

#endif
