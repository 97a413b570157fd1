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

template <class R> struct SpaceFrame {
  using Real = R;
  using Vector = Vector3<Real>;     // positions, velocities, forces
  using Spin = Vector3<Real>;       // angular velocities, torques
  using Tangent = Vector3<Real>;    // vectors in the contact plane
  static constexpr bool planar = false;

  Vector n;

  APF_INLINE Tangent slip(const Vector &v, const Real &vn) const { return v - vn * n; }
  APF_INLINE Tangent slip_of_spin(const Spin &spin) const { return cross(spin, n); }
  APF_INLINE Vector force(const Tangent &t) const { return t; }
  APF_INLINE Spin torque_of_force(const Tangent &t) const { return cross(n, t); }
};

template <class R> struct PlaneFrame {
  using Real = R;
  using Vector = Vector2<Real>;
  using Spin = Real;       // about z
  using Tangent = Real;    // along (-n_y, n_x)
  static constexpr bool planar = true;

  Vector n;

  APF_INLINE Tangent slip(const Vector &v, const Real &) const { return n.x * v.y - n.y * v.x; }
  APF_INLINE Tangent slip_of_spin(const Spin &spin) const { return spin; }
  APF_INLINE Vector force(const Tangent &t) const { return {-n.y * t, n.x * t}; }
  APF_INLINE Spin torque_of_force(const Tangent &t) const { return t; }
};

template <class Frame> struct ContactInput {
  typename Frame::Vector d;                       // x_j - x_i
  typename Frame::Vector v;                       // v_i - v_j
  typename Frame::Spin spin_i, spin_j;            // angular velocities
  typename Frame::Real crowd_mass, crowd_roll;    // see ContactConstants
};

// Only what the sub-models use is set.
template <class Frame> struct ContactMemory {
  typename Frame::Tangent sliding, rolling;
  typename Frame::Real twisting;
  typename Frame::Vector normal;    // not used in the plane
};

template <class Frame> struct ContactOutput {
  using Real = typename Frame::Real;
  typename Frame::Vector force;    // on i; j gets the opposite
  typename Frame::Spin torque_i{}, torque_j{};
  Real overlap;
  // for ContactParts only; the compiler drops what nobody reads
  Real s, elastic, damping, twisting{};
  typename Frame::Tangent sliding{};
  typename Frame::Spin rolling{};
};

struct ContactTimes {
  double
      advance;    // since the last call: histories grow by it; 0 evaluates only            [time]
  double
      behind;     // by which the velocities are older than the positions                    [time]
  double step;    // between calls, which limits dashpots; 0 = no limit                      [time]
};

// How vectors of the contact plane follow the pair through a step.
template <class Frame> struct Turning {
  using Tangent = typename Frame::Tangent;
  static APF_INLINE Turning of(const Frame &, const Frame &, const ContactInput<Frame> &,
                               const ContactTimes &, const ContactMemory<Frame> &)
  {
    return {};
  }
  // the tangent itself turns
  APF_INLINE Tangent slip(const Tangent &t) const { return t; }
  APF_INLINE Tangent memory(const Tangent &t) const { return t; }
};

template <class Real> struct Turning<SpaceFrame<Real>> {
  using Vector = Vector3<Real>;
  Vector n, from_mid, from_last;    // normal now; its sum with those of mid-step and of last step
  Real per_mid, per_last;           // 1 / (1 + product of the two normals)
  Real cosine, sine;                // of the mean spin about the normal, since the last step
  Real since_mid;                   // its angle since mid-step

  // angle: of that spin since the last step
  APF_INLINE Turning(const Vector &n, const Vector &mid, const Vector &last, const Real &angle,
                     const Real &since_mid) :
      n(n),
      from_mid(n + mid), from_last(n + last), per_mid(1.0 + dot(n, mid)),
      per_last(1.0 + dot(n, last)), since_mid(since_mid)
  {
    const Real q = 0.25 * angle * angle;    // Cayley form: a rotation for any angle
    Real inv = 1.0 + q;
    invert(per_mid, per_last, inv);
    cosine = (1.0 - q) * inv;
    sine = angle * inv;
  }
  // from the frames of now and of mid-step; the memory gets the present normal
  using Frame = SpaceFrame<Real>;
  static APF_INLINE Turning of(const Frame &now, const Frame &mid, const ContactInput<Frame> &in,
                               const ContactTimes &times, ContactMemory<Frame> &memory)
  {
    // no normal in the contact's first step
    const auto last = select(norm2(memory.normal) < 0.5, now.n, memory.normal);
    memory.normal = now.n;
    const Real spin = 0.5 * dot(in.spin_i + in.spin_j, now.n);
    return {now.n, mid.n, last, times.advance * spin, times.behind * spin};
  }
  // A slip velocity of mid-step: the smallest rotation to the present normal, then that spin since.
  // 1 + i tan is the root of Cayley's form, so that springs that are turned and stretched in turn
  // gain no energy.
  APF_INLINE Vector slip(const Vector &t) const
  {
    const Vector tilted = t - (dot(n, t) * per_mid) * from_mid;
    return tilted + since_mid * cross(n, tilted);
  }
  // a displacement of the last step: the smallest rotation to the present normal, then the mean
  // spin of the two bodies about it. Exact for finite steps.
  APF_INLINE Vector memory(const Vector &xi) const
  {
    const Vector tilted = xi - (dot(n, xi) * per_last) * from_last;
    const Vector tangent = tilted - dot(n, tilted) * n;    // rounding only
    return cosine * tangent + sine * cross(n, tangent);
  }
};

// The constant of the normal dashpot. Velocities that are `behind` the positions differ from those
// of now by the acceleration since, so that a dashpot exerts 1 + 2 q times what it should and the
// spring seems 1 + 2 q times as stiff, q = eta behind / (2 m). A constant that is 1 + q times as
// small leaves the damping ratio as it is, and with it the restitution, to the order of q^2.
// Contacts at rest do not notice.
template <class Constants, class Real>
APF_INLINE Real lagging_dashpot(const Constants &c, const Real &s, double behind)
{
  const Real q = behind * c.lag * s;
  return c.eta * s * (1.0 - q * (1.0 - q));
}

// The largest dashpot constant that leapfrog steps bear beside a spring k: stable while
// eta dt/m < 2 - k dt^2 / (2 m), with m the mass that bodies with many contacts leave to one of
// them. It binds where a particle has several contacts and the step is large.
template <class Real>
APF_INLINE Real stable_dashpot(const Real &eta, const Real &k, const Real &m, double step)
{
  const double of_mass = 0.9 * 2.0 / step, of_spring = 0.9 * 0.5 * step;
  return smaller(eta, larger(of_mass * m - of_spring * k, 0.0));
}

// Normal force of damping, and with the elastic one, at s = sqrt(a/R); > 0 repels. mass: that the
// contact has of its two bodies; velocities are half a step old.
template <class Constants, class Real>
APF_INLINE Real damping_at(const Constants &c, const Real &s, const Real &closing_speed,
                           const Real &mass, double step)
{
  const Real eta = lagging_dashpot(c, s, 0.5 * step);
  return stable_dashpot(eta, c.kn * (s * s), mass, step) * closing_speed;
}
template <class Constants, class Real>
APF_INLINE Real force_at(const Constants &c, const Real &s, const Real &closing_speed,
                         const Real &mass, double step)
{
  const Real s3 = s * s * s;
  return c.K * s3 * (s3 - c.neck6) + damping_at(c, s, closing_speed, mass, step);
}

// The whole law. With times.advance = 0 the memory is to be left as it was.
template <class Frame, bool adhesion, bool sliding, bool twisting, bool rolling>
APF_INLINE ContactOutput<Frame> contact_law(const ConstantsOf<typename Frame::Real> &c,
                                            const ContactInput<Frame> &in, ContactTimes times,
                                            ContactMemory<Frame> &memory)
{
  using std::sqrt;
  using Real = typename Frame::Real;
  using Tangent = typename Frame::Tangent;
  ContactOutput<Frame> out;
  const auto d_mid =
      in.d + (times.behind * c.turning) * in.v;    // when the bodies had the velocity v
  const Real distance = sqrt(dot(in.d, in.d));
  Real inv_distance = distance, inv_mid = sqrt(dot(d_mid, d_mid));
  invert(inv_distance, inv_mid);
  const Frame frame{inv_distance * in.d}, mid{inv_mid * d_mid};
  const Real overlap = c.radius_sum - distance;
  const auto ended = overlap < c.break_overlap;

  // normal
  Real s;    // never 0
  if constexpr (adhesion)
    s = jkr_root(overlap, c.root_scale, c.root_unit);
  else
    s = sqrt(sqrt(larger(overlap * c.inv_R, 1.0e-60)));
  const Real now = select(ended, Real(0.0), s);    // no spring, dashpot or limit at the end
  const Real s2 = now * now, s3 = s2 * now;
  const Real elastic = c.K * s3 * (adhesion ? s3 - c.neck6 : s3);
  const Real eta = lagging_dashpot(c, now, times.behind);
  const Real vn = dot(in.v, mid.n);
  const Real damping = stable_dashpot(eta, c.kn * s2, in.crowd_mass, times.step) * vn;

  out.overlap = overlap;
  out.s = s;
  out.elastic = elastic;
  out.damping = damping;
  out.force = (-(elastic + damping)) * frame.n;
  if constexpr (!sliding && !rolling) return out;

  const auto turning = Turning<Frame>::of(frame, mid, in, times, memory);

  // levers to the middle of the overlap (at a wall: to the wall): they add up to the distance, so
  // the pair's angular momentum is kept and a rigid rotation slides nothing
  const Real arm_i = c.radius_i - c.arm_share * overlap;
  const Real arm_j = distance - arm_i;

  // springs, dashpots and sliders
  const Real kt = c.kt * s2;
  // a force at the surface of a sphere moves that surface as if it had 2/7 of the mass
  const Real eta_t = stable_dashpot(eta, kt, (2.0 / 7.0) * in.crowd_mass, times.step);
  const Real slip_limit = select(ended, Real(0.0), c.mu * magnitude(elastic + c.adhesion));
  const auto slip =
      turning.slip(mid.slip(in.v, vn) + mid.slip_of_spin(arm_i * in.spin_i + arm_j * in.spin_j));
  const Slider<Real, Tangent> slide(kt, eta_t, slip, times.advance, turning.memory(memory.sliding));

  const Real roll_k = c.roll_k * s3;
  const Real roll_eta =
      stable_dashpot(c.roll_eta * now * sqrt(s), roll_k, in.crowd_roll, times.step);
  const auto v_roll = (-c.R) * turning.slip(mid.slip_of_spin(in.spin_i - in.spin_j));
  const Slider<Real, Tangent> roll(roll_k, roll_eta, v_roll, times.advance,
                                   turning.memory(memory.rolling));

  Real inv_s = s, inv_slide = slide.size, inv_roll = roll.size;
  if constexpr (Frame::planar)
    inv_s = 1.0 / s;
  else if constexpr (sliding && rolling)
    invert(inv_s, inv_slide, inv_roll);
  else if constexpr (sliding)
    invert(inv_s, inv_slide);
  else
    invert(inv_s, inv_roll);
  const Real inv_s2 = inv_s * inv_s;

  if constexpr (sliding) {
    const auto force = slide.force(slip_limit, inv_slide, c.inv_kt * inv_s2, memory.sliding);
    out.sliding = force;
    out.force = out.force + frame.force(force);
    const auto torque = frame.torque_of_force(force);
    out.torque_i = arm_i * torque;
    out.torque_j = arm_j * torque;
  }
  if constexpr (twisting && !Frame::planar) {
    const Real a = c.R * s2, share = 0.5 * a * a;    // eq (31)
    const Real twist_rate = dot(in.spin_i - in.spin_j, mid.n);
    const Slider<Real, Real> twist(share * kt, share * eta_t, twist_rate, times.advance,
                                   memory.twisting);
    const Real torque = twist.force(c.twist * s2 * slip_limit, 1.0,
                                    c.inv_twist * inv_s2 * inv_s2 * inv_s2, memory.twisting);
    out.twisting = torque;
    out.torque_i = out.torque_i + torque * frame.n;
    out.torque_j = out.torque_j - torque * frame.n;
  }
  if constexpr (rolling) {
    const Real limit = roll_k * c.roll_limit;
    const auto moment = roll.force(limit, inv_roll, c.inv_roll_k * inv_s2 * inv_s, memory.rolling);
    out.rolling = -frame.torque_of_force(moment);    // moment x n, eq (15)
    out.torque_i = out.torque_i + out.rolling;
    out.torque_j = out.torque_j - out.rolling;
  }
  return out;
}

}    // namespace apf

#endif
