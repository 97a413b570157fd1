// Forces of one liquid bridge on the two bodies that it joins, put together from the laws of
// bridge.h. Written once for space and for the plane, for one bridge and for a block of them.
//
// n points from i to j. Velocities are i minus j.

#ifndef APF_BRIDGE_LAW_H
#define APF_BRIDGE_LAW_H

#include "bridge.h"
#include "jump.h"

namespace apf {

// One step of the viscous force along the normal. Closing speeds w are > 0 when the gap shrinks.
//
// Explicit steps would have to be shorter than 2 m h / (6 pi mu R^2). But the law says m dw = dG
// with G(h) = integral of the resistance: viscosity takes a momentum that depends on gaps only, not
// on time. So
//
//   m (w' - w) = G(h') - G(h0),   h' = gap + offset - ahead w' = free + ahead (w - w')
//
// is solved for the new speed w': h0 is where the last step left off, h' where this one will, with
// ahead between half a step (second order) and a whole one where the step is too coarse for that
// (then w' never changes its sign). Over many steps the right-hand sides add up to the exact law,
// whatever the step. Other forces stand in w, so that slow draining comes out right, too.
template <class Real> struct ViscousStep {
  Real from;     // h0                                                                     [length]
  Real free;     // h' if there were no viscosity                                          [length]
  Real ahead;    // [time]
  Real mass;     // that the bridge has of the two bodies                                    [mass]

  // share of a step that is looked ahead; resistance at h_min
  static APF_INLINE Real share(const Real &mass, const Real &inv_resistance, double step)
  {
    return larger(1.0 - mass * inv_resistance * (1.0 / step), 0.5);
  }

  // m (w - w'); near: the resistance at a gap near h0
  APF_INLINE Real momentum(const BridgeConstantsOf<Real> &c, const Real &b, const Real &near) const
  {
    // Where the gap changes little the resistance of its middle does: error (change)^2 / 12. Below
    // h_min the resistance is that at h_min.
    const Real about = free + ahead * near * (from - free) * inverse(mass + near * ahead);
    const Real middle = select(from < c.h_min, c.h_min, larger(0.5 * (from + about), c.h_min));
    const Real k = bridge_resistance(c.drag, middle, b);
    const Real per_mass = k * (from - free) * inverse(mass + k * ahead);
    const Real taken = mass * per_mass, to = free + ahead * per_mass;
    const Real change = larger(magnitude(to - from), 100.0 * magnitude(to - about));
    const Real above = larger(change - 0.02 * middle, c.h_min - smaller(from, to));
    const Real below = larger(from, to) - c.h_min;
    const auto far = Real(0.0) < smaller(above, below);
    if (any(far)) return select(far, solved(c, b, to), taken);    // few: bodies in fast motion
    return taken;
  }

 private:
  // The same from S (h' - free) + G(h') - G(h0) = 0, S = m / ahead, which grows with h' and is
  // concave: the first Newton step leads to the left of the root, the others straight to it.
  Real solved(const BridgeConstantsOf<Real> &c, const Real &b, const Real &guess) const
  {
    const Real stiffness = mass * inverse(ahead);
    const Real inv_start = inverse(momentum_ratio(larger(from, c.h_min), b));
    const Real drag_min = bridge_resistance(c.drag, c.h_min, b);
    const Real start = drag_min * smaller(from - c.h_min, 0.0);    // G(h0) below h_min
    auto excess = [&](const Real &h) {
      return stiffness * (h - free) + c.drag * logarithm(momentum_ratio(h, b) * inv_start) - start;
    };
    const Real least = excess(c.h_min);
    Real h = larger(guess, c.h_min);
    for (int n = 0; n < 50; n++) {
      const Real slope = stiffness + bridge_resistance(c.drag, h, b);
      const Real next = larger(h - excess(h) * inverse(slope), c.h_min);
      const auto moves = 1.0e-9 * h < magnitude(next - h);    // the next change is the square
      h = next;
      if (!any(moves)) break;
    }
    const Real linear = c.h_min - least * inverse(stiffness + drag_min);    // below h_min
    return stiffness * (select(least < 0.0, h, linear) - free);
  }
};

// Beside what bodies do: what a bridge keeps.
template <class Real> struct BridgeState {
  Real formed;      // gap at which it formed in this step; -infinite if before           [length]
  Real touching;    // 1: there is a dry contact beside it, 0: there is none
};

template <class Frame> struct BridgeOutput {
  using Real = typename Frame::Real;
  typename Frame::Vector force;    // on i; j gets the opposite
  typename Frame::Spin torque_i{}, torque_j{};
  Real gap, ended;    // ended: 1 beyond its rupture, where it exerts nothing; else 0
  Real capillary, viscous{0.0};
  typename Frame::Tangent tangential{};
};

// Elastic and damping force of the dry contact beside the bridge, > 0 repels.
template <class Real>
APF_INLINE Real force_beside(const BridgeConstantsOf<Real> &c, const Real &overlap,
                             const Real &closing, const Real &mass, double step)
{
  const Real s = jkr_root(overlap, c.root_scale, c.root_unit);
  return select(overlap < c.break_overlap, Real(0.0), force_at(c, s, closing, mass, step));
}

template <class Frame, bool viscous, bool fitted, bool tangential>
APF_INLINE BridgeOutput<Frame>
bridge_law(const BridgeConstantsOf<typename Frame::Real> &c,
           const BridgeVolumeOf<typename Frame::Real> &liquid, const ContactInput<Frame> &in,
           const BridgeState<typename Frame::Real> &state, ContactTimes times)
{
  using Real = typename Frame::Real;
  const double kick = times.behind + 0.5 * times.step;
  const Real distance2 = dot(in.d, in.d), inv_distance = inverse_root(distance2);
  const Real distance = distance2 * inv_distance;
  const Frame frame{inv_distance * in.d};
  const Real closing = dot(in.v, frame.n), gap = distance - c.radius_sum;

  BridgeOutput<Frame> out;
  out.gap = gap;
  out.ended =
      select(ruptured(gap, liquid.rupture, c.inv_speed * magnitude(closing)), Real(1.0), Real(0.0));
  const Real alive = 1.0 - out.ended;
  const Real h = larger(gap, c.h_min), H = filling(h, liquid.b);
  out.capillary = c.pull * H;
  if constexpr (fitted)
    out.capillary =
        select(0.5 < c.fitted, c.fit_force * liquid.fit.force(liquid.fit_scale * h), out.capillary);
  out.capillary = alive * out.capillary;

  if constexpr (viscous) {
    const Real resistance = c.drag * H * H * inverse(h);
    if (kick == 0.0) {
      out.viscous = alive * resistance * closing;
    } else {
      const Real share = ViscousStep<Real>::share(in.crowd_mass, liquid.inv_drag_min, times.step);
      const Real ahead = times.step * share, back = (2.0 * times.behind) * (1.0 - share);
      // the distance of two bodies that pass each other grows by the square of time
      const Real across2 = larger(dot(in.v, in.v) - closing * closing, 0.0);
      const Real turn = 0.5 * c.turning * across2 * inv_distance;
      const Real last = gap + back * closing + turn * back * back;
      // what the other forces between the two bodies make of their speed
      const Real dry = select(0.5 < state.touching,
                              force_beside(c, -gap, closing, in.crowd_mass, times.step), Real(0.0));
      const Real speed = closing + kick * c.inv_m * (out.capillary - dry);
      const ViscousStep<Real> step{larger(state.formed, last),
                                   gap + turn * ahead * ahead - ahead * speed, ahead,
                                   in.crowd_mass};
      out.viscous = alive * (1.0 / kick) * step.momentum(c, liquid.b, resistance);
    }
  }
  out.force = (out.capillary - out.viscous) * frame.n;

  if constexpr (tangential) {
    // Resistance to the sliding of the two surfaces, which moves them as if they had 2/7 of the
    // mass; backward Euler, stable for any step.
    const Real arm_i = c.radius_i + c.arm_share * gap, arm_j = distance - arm_i;
    const Real resistance = tangential_resistance(c.film, c.R * inverse(h));
    const Real mass = (2.0 / 7.0) * in.crowd_mass;
    const Real scale = alive * resistance * mass * inverse(mass + kick * resistance);
    out.tangential = (-scale) *
        (frame.slip(in.v, closing) + frame.slip_of_spin(arm_i * in.spin_i + arm_j * in.spin_j));
    out.force = out.force + frame.force(out.tangential);
    const auto torque = frame.torque_of_force(out.tangential);
    out.torque_i = arm_i * torque;
    out.torque_j = arm_j * torque;
  }
  return out;
}

}    // namespace apf

#endif
