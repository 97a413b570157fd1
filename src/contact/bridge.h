// A liquid bridge between two spheres, or a sphere and a wall: IIHR Report 459, eqs (45)-(50).
//
//   h      gap between the surfaces, at least h_min = hmin R (roughness); in contact h = h_min
//   H      = 1 - h / sqrt(h^2 + b),  b = V / (pi R)
//   F_cap  = 4 pi R sigma cos(theta) H                        attracts              (45)
//   F_visc = 6 pi mu R^2 H^2 (dh/dt) / h                      against the motion    (46)
//   h_rupt = (1 + theta/2) (1 + sqrt(Ca)) V^(1/3),  Ca = mu |dh/dt| / sigma         (47)
//
// R is the effective radius r_i r_j / (r_i + r_j), r_i at a wall; for two equal spheres (45) is
// Maugis's 2 pi r sigma cos(theta) H.
// The report prints V/(4 R^2) in (47); V^(1/3) is Lian, Thornton and Adams's (J. Colloid Interface
// Sci. 161, 138, 1993), to which it must reduce, with Pitois, Moucheront and Chateau's factor of
// speed (doi:10.1006/jcis.2000.7096), fitted for 0.001 <= Ca <= 0.1: Ca counts up to 0.1.
//
// willett: the closed fit to exact profiles by Willett, Adams, Johnson and Seville
// (doi:10.1021/la000657y), for V / (2R)^3 < 0.1 and theta < 50 degrees, instead of (45).
//
// Everything is made of ratios: no number here has a dimension, no threshold is absolute.

#ifndef APF_BRIDGE_H
#define APF_BRIDGE_H

#include "contact_model.h"

#include <algorithm>

namespace apf {

enum class Capillary { maugis, willett };
enum class Forming { contact, film };    // at first touch, or when films of liquid touch
enum class Sharing { even, origin };     // of a bridge's liquid when it ruptures

constexpr double largest_Ca = 0.1;         // of the fit (47)
constexpr double largest_willett = 0.1;    // V / (2R)^3
constexpr double largest_willett_angle = 50.0 * pi / 180.0;
constexpr double default_roughness = 1e-3;    // h_min / R

// What a script says of the liquid.
struct BridgeModel {
  double volume_ratio = 0.0;    // l: liquid volume over particle volume; 0 = no bridges     [-]
  double sigma = 0.0;           // surface tension                             [force/length]
  double theta = 0.0;           // contact angle                                          [rad]
  double mu = 0.0;              // viscosity                                    [pressure time]
  double roughness = default_roughness;    // h_min / R                                     [-]
  Capillary capillary = Capillary::maugis;
  Forming forming = Forming::contact;
  bool tangential = false;    // viscous resistance to sliding
  double intake = 0.0;        // share of a body's liquid that a bridge takes; 0 = volume l   [-]
  Sharing sharing = Sharing::even;
  double wet_share = 1.0;    // surface energy in the liquid over the dry one                [-]

  // the liquid between bodies that have two liquids of their own
  static BridgeModel mixed(const BridgeModel &a, const BridgeModel &b)
  {
    BridgeModel c;
    if (!a.present() || !b.present()) return c;
    auto mean = [&](double BridgeModel::*number) {
      c.*number = std::sqrt(a.*number * (b.*number));
    };
    for (auto number : {&BridgeModel::volume_ratio, &BridgeModel::sigma, &BridgeModel::mu,
                        &BridgeModel::roughness, &BridgeModel::intake, &BridgeModel::wet_share})
      mean(number);
    c.theta = std::acos(0.5 * (std::cos(a.theta) + std::cos(b.theta)));
    c.capillary = std::min(a.capillary, b.capillary);
    c.forming = std::min(a.forming, b.forming);
    c.tangential = a.tangential && b.tangential;
    c.sharing = std::min(a.sharing, b.sharing);
    return c;
  }

  bool present() const { return volume_ratio > 0.0; }
  bool inventory() const { return intake > 0.0; }

  // of a particle's own liquid, l pi d^3 / 6
  double liquid_of(double radius) const
  {
    return volume_ratio * (4.0 / 3.0) * pi * radius * radius * radius;
  }
  // Volume of a bridge; between unequal spheres that of the smaller one, as at a wall.
  double volume(double smaller_radius) const { return liquid_of(smaller_radius); }
  // A bridge that takes its liquid from the bodies is no larger than this.
  double largest_volume(double smaller_radius) const
  {
    return (inventory() ? 2.0 : 1.0) * volume(smaller_radius);
  }
  // gap at which a bridge of this volume ruptures at rest
  double rupture_at_rest(double volume) const { return (1.0 + 0.5 * theta) * std::cbrt(volume); }
  double longest(double smaller_radius) const
  {
    return (1.0 + std::sqrt(largest_Ca)) * rupture_at_rest(largest_volume(smaller_radius));
  }
};

// thickness of a liquid of that volume on a sphere
inline double film_thickness(double radius, double liquid)
{
  const double ratio = std::max(liquid, 0.0) / ((4.0 / 3.0) * pi * radius * radius * radius);
  return radius * std::expm1(std::log1p(ratio) / 3.0);
}

// gamma in a liquid over gamma in air, eq (50): x is the distance of closest approach of the
// surfaces, A are Hamaker constants of bodies i, j and of the liquid f. < 0: the bodies repel.
inline double wet_surface_energy(double x_fluid_over_dry, double Ai, double Aj, double Af)
{
  const double a = std::sqrt(Ai), b = std::sqrt(Aj), f = std::sqrt(Af);
  return (a - f) * (b - f) / (a * b) / (x_fluid_over_dry * x_fluid_over_dry);
}

// Willett's fit for one volume and contact angle:
//   F / (2 pi R_s sigma) = exp(f1 - f2 exp(f3 ln s + f4 ln^2 s)),  s = (h/2) sqrt(R_s / V)
// with R_s = 2 R, Derjaguin's radius, for unequal spheres and for walls.
struct WillettFit {
  double f1, f2, f3, f4;

  static WillettFit of(double dimensionless_volume, double theta)
  {
    const double L = std::log(dimensionless_volume), t = theta, tt = t * t;
    auto cubic = [L](double c0, double c1, double c2, double c3) {
      return c0 + L * (c1 + L * (c2 + L * c3));
    };
    return {cubic(-0.44507 + 0.050832 * t - 1.1466 * tt, -0.1119 - 0.000411 * t - 0.1490 * tt,
                  -0.012101 - 0.0036456 * t - 0.01255 * tt,
                  -0.0005 - 0.0003505 * t - 0.00029076 * tt),
            cubic(1.9222 - 0.57473 * t - 1.2918 * tt, -0.0668 - 0.1201 * t - 0.22574 * tt,
                  -0.0013375 - 0.0068988 * t - 0.01137 * tt, 0.0),
            cubic(1.268 - 0.01396 * t - 0.23566 * tt, 0.198 + 0.092 * t - 0.06418 * tt,
                  0.02232 + 0.02238 * t - 0.009853 * tt, 0.0008585 + 0.001318 * t - 0.00053 * tt),
            cubic(-0.010703 + 0.073776 * t - 0.34742 * tt, 0.03345 + 0.04543 * t - 0.09056 * tt,
                  0.0018574 + 0.004456 * t - 0.006257 * tt, 0.0)};
  }
  double force(double s) const
  {
    const double x = std::log(s);
    return std::exp(f1 - f2 * std::exp(x * (f3 + f4 * x)));
  }
};

// Numbers of one bridge. All roots are taken here, once.
struct BridgeConstants {
  double radius_sum, radius_i;    // [length]
  double arm_share, turning;      // as in ContactBodies                                      [-]
  double R;                       // effective radius                                     [length]
  double m;                       // effective mass                                         [mass]
  double h_min;                   // least gap                                            [length]
  double b;                       // V / (pi R)                                         [length^2]
  double pull;                    // 4 pi R sigma cos(theta)                               [force]
  double drag;                    // 6 pi mu R^2                                 [force time]
  double drag_min;                // resistance at h_min                                [mass/time]
  double rupture;                 // gap of rupture at rest                               [length]
  double inv_speed;               // mu / sigma: Ca = inv_speed |dh/dt|              [time/length]
  double film;                    // resistance to sliding / (8/15 ln(R/h) + 0.9588)    [mass/time]
  bool fitted;                    // Willett
  WillettFit fit;
  double fit_force, fit_scale;    // 4 pi R sigma, and s / h                [force], [1/length]

  static BridgeConstants make(const BridgeModel &model, const ContactBodies &bodies, double volume)
  {
    BridgeConstants c{};
    c.radius_sum = bodies.radius_i + bodies.radius_j;
    c.radius_i = bodies.radius_i;
    c.arm_share = bodies.arm_share;
    c.turning = bodies.turning;
    c.R = bodies.R;
    c.m = bodies.m;
    c.h_min = model.roughness * bodies.R;
    c.b = volume / (pi * bodies.R);
    c.pull = 4.0 * pi * bodies.R * model.sigma * std::cos(model.theta);
    c.drag = 6.0 * pi * model.mu * bodies.R * bodies.R;
    c.drag_min = c.resistance(c.h_min);
    c.rupture = model.rupture_at_rest(volume);
    c.inv_speed = model.mu / model.sigma;
    c.film = model.tangential ? 6.0 * pi * model.mu * bodies.R : 0.0;
    c.fitted = model.capillary == Capillary::willett;
    const double Rs = 2.0 * bodies.R;
    if (c.fitted) c.fit = WillettFit::of(volume / (Rs * Rs * Rs), model.theta);
    c.fit_force = 2.0 * pi * Rs * model.sigma;
    c.fit_scale = 0.5 * std::sqrt(Rs / volume);
    return c;
  }

  double gap(double h) const { return std::max(h, h_min); }                    // as the laws see it
  double filling(double h) const { return 1.0 - h / std::sqrt(h * h + b); }    // H, h >= h_min

  // attraction at a gap, also < h_min
  double attraction(double h) const
  {
    h = gap(h);
    return fitted ? fit_force * fit.force(fit_scale * h) : pull * filling(h);
  }
  // work that the attraction does from a gap to rupture at rest
  double work(double h) const
  {
    const double to = std::max(rupture, h_min), from = std::min(gap(h), to);
    double sum = attraction(h_min) * (from - std::min(h, from));
    if (!fitted) {
      auto integral = [this](double g) {
        return g - std::sqrt(g * g + b);
      };
      return sum + pull * (integral(to) - integral(from));
    }
    constexpr int n = 64;    // Simpson, in sqrt(h - from): the fit is steepest at contact
    const double step = std::sqrt(to - from) / n;
    for (int k = 0; k <= n; k++) {
      const double q = k * step, weight = (k == 0 || k == n) ? 1.0 : (k % 2 ? 4.0 : 2.0);
      sum += weight * step / 3.0 * 2.0 * q * attraction(from + q * q);
    }
    return sum;
  }
  double resistance(double h) const    // F_visc / (dh/dt), h >= h_min
  {
    const double H = filling(h);
    return drag * H * H / h;
  }
  double tangential_resistance(double h) const
  {
    return film * std::max(0.0, (8.0 / 15.0) * std::log(R / h) + 0.9588);
  }
  bool ruptures(double h, double speed) const
  {
    const double Ca = std::min(inv_speed * std::fabs(speed), largest_Ca);
    return h > rupture * (1.0 + std::sqrt(Ca));
  }

  // Momentum that viscosity takes between gaps 0 and h, from h_min on: integral of F_visc dt =
  // integral of resistance dh, in closed form; linear below h_min.
  double momentum(double h) const
  {
    if (h <= h_min) return drag_min * (h - h_min);
    return drag * std::log(momentum_ratio(h) / momentum_ratio(h_min));
  }

 private:
  // exp(integral of H^2/h dh) but for a factor
  double momentum_ratio(double h) const
  {
    const double s = std::sqrt(h * h + b);
    return h * s / ((h + s) * (h + s));
  }
};

// One step of the viscous force along the normal. Closing speeds w are > 0 when the gap shrinks.
//
// Explicit steps would have to be shorter than 2 m h / (6 pi mu R^2). But the law says m dw = dG
// with G(h) = momentum(h): viscosity takes a momentum that depends on gaps only, not on time. So
//
//   m (w' - w) = G(h') - G(h0),   h' = gap + offset - ahead w'
//
// is solved for the new speed w': h0 is where the last step left off, h' where this one will, with
// ahead between half a step (second order) and a whole one where the step is too coarse for that
// (then w' never changes its sign). Over many steps the right-hand sides add up to the exact law,
// whatever the step. Other forces stand in w, so that slow draining comes out right, too.
struct ViscousStep {
  double from;     // h0                                                               [length]
  double to;       // gap + offset                                                     [length]
  double ahead;    // [time]
  double mass;     // that the bridge has of the two bodies                              [mass]
  double speed;    // w, what the bodies would have without viscosity                [velocity]

  // share of a step that is looked ahead
  static double share(double mass, double resistance, double step)
  {
    return std::max(0.5, 1.0 - mass / (resistance * step));
  }

  double new_speed(const BridgeConstants &c) const
  {
    // where the gap changes little the resistance of its middle does: error (change)^2 / 12
    const double free = to - ahead * speed;
    const double middle = c.gap(0.5 * (from + free));
    const double k = c.resistance(middle);
    const double w = (mass * speed + k * (to - from)) / (mass + k * ahead);
    const double change = std::fabs(to - ahead * w - from);
    const double widest = std::max(std::fabs(free - from), change);
    if (widest <= 0.02 * middle && std::min({from, free, to - ahead * w}) >= c.h_min) return w;
    return (to - solve(c, free)) / ahead;
  }

 private:
  // h' of mass (h' - free) / ahead + G(h') - G(h0) = 0, which grows with h' and is concave: Newton
  // from the left goes straight to the root.
  double solve(const BridgeConstants &c, double free) const
  {
    const double stiffness = mass / ahead, start = c.momentum(from);
    if (stiffness * (c.h_min - free) - start >= 0.0)    // below h_min, where it is linear
      return (stiffness * free + c.drag_min * c.h_min + start) / (stiffness + c.drag_min);
    double h = std::max(c.h_min, std::min(free, from));
    for (int n = 0; n < 50; n++) {
      const double excess = stiffness * (h - free) + c.momentum(h) - start;
      const double next = h - excess / (stiffness + c.resistance(h));
      if (!(next - h > 1.0e-13 * h)) return std::max(next, h);
      h = next;
    }
    return h;
  }
};

}    // namespace apf

#endif
