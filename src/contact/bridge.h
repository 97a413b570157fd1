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
// The report prints V/(4 R^2) in (47); V^(1/3) is Lian, Thornton and Adams's (J. Colloid
// Interface Sci. 161, 138, 1993), to which it must reduce. Pitois, Moucheront and Chateau
// (J. Colloid Interface Sci. 231, 26, 2000, doi:10.1006/jcis.2000.7096) measured that the distance
// grows as the square root of the speed; the factor 1 + sqrt(Ca) and its range
// 0.001 <= Ca <= 0.1 are the report's. Ca counts up to 0.1.
//
// willett: the closed fit to exact profiles by Willett, Adams, Johnson and Seville
// (doi:10.1021/la000657y), for V / (2R)^3 < 0.1 and theta < 50 degrees, instead of (45).
//
// Everything is made of ratios: no number here has a dimension, no threshold is absolute.

#ifndef APF_BRIDGE_H
#define APF_BRIDGE_H

#include "../flow/elementary.h"
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

  // (45) at H = 1                                                                    [force]
  double largest_pull(double R) const { return 4.0 * pi * R * sigma * std::cos(theta); }

  // of a particle's own liquid, l pi d^3 / 6
  double liquid_of(double radius) const
  {
    return volume_ratio * (4.0 / 3.0) * pi * radius * radius * radius;
  }
  // Volume of a bridge; between unequal spheres that of the smaller one, as at a wall.
  double volume(double smaller_radius) const { return liquid_of(smaller_radius); }
  // ... of the first one between particles that own their liquid, and get no more
  double first_volume(double smaller_radius) const
  {
    return (inventory() ? 2.0 * intake : 1.0) * volume(smaller_radius);
  }
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
// Above it the liquid would make the bodies stick better than air does. By the same rule, A of
// unlike bodies = sqrt(A_i A_f), it does not wet them then: with works of adhesion as A, Young's
// equation is cos(theta) = 2 sqrt(A_i / A_f) - 1 < 0 for A_f > 4 A_i.
inline double largest_wetting_hamaker(double Ai, double Aj)
{
  const double sum = std::sqrt(Ai) + std::sqrt(Aj);
  return sum * sum;
}

// Willett's fit for one volume and contact angle:
//   F / (2 pi R_s sigma) = exp(f1 - f2 exp(f3 ln s + f4 ln^2 s)),  s = (h/2) sqrt(R_s / V)
// with R_s = 2 R, Derjaguin's radius, for unequal spheres and for walls.
template <class Real> struct WillettFit {
  Real f1, f2, f3, f4;

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
  APF_INLINE Real force(const Real &s) const
  {
    const Real x = logarithm(s);
    return exponential(f1 - f2 * exponential(x * (f3 + f4 * x)));
  }
};

// What a script says of two bodies that a bridge joins.
struct WetContact {
  const BridgeModel &liquid;
  const ContactModel &dry;
};

// Overlap of two bodies at rest, under their adhesion and the largest pull of a bridge; 0 without
// either.                                                                             [length]
inline double overlap_at_rest(const WetContact &wet, double R)
{
  return wet.dry.normal(R).overlap_under(wet.liquid.largest_pull(R));
}

// Numbers of a bridge that do not depend on its volume, with those of the dry contact beside it.
// All roots are taken here, once. Of doubles for one bridge, of Packs (pack.h) for a block of them.
template <class Real> struct BridgeConstantsOf {
  Real radius_sum, radius_i;    // [length]
  Real arm_share, turning;      // as in ContactBodies                                         [-]
  Real R;                       // effective radius                                        [length]
  Real m, inv_m;                // effective mass, and 1 / m                       [mass], [1/mass]
  Real h_min;                   // least gap                                               [length]
  Real pull;                    // BridgeModel::largest_pull()                              [force]
  Real drag;                    // 6 pi mu R^2                                         [force time]
  Real inv_speed;               // mu / sigma: Ca = inv_speed |dh/dt|                 [time/length]
  Real film;         // resistance to sliding / (8/15 ln(R/h) + 0.9588); 0 = none       [mass/time]
  Real fitted;       // 1: Willett, 0: (45)
  Real fit_force;    // 4 pi R sigma                                                        [force]
  // of the dry contact, see ConstantsOf
  Real K, neck6, kn, root_unit, root_scale, break_overlap, eta, lag;
  Real unused[2];    // the kernel loads four at a time
};

// ... and those that do.
template <class Real> struct BridgeVolumeOf {
  Real b;               // V / (pi R)                                                    [length^2]
  Real rupture;         // gap of rupture at rest                                          [length]
  Real inv_drag_min;    // 1 / resistance at h_min; infinite without viscosity          [time/mass]
  WillettFit<Real> fit;
  Real fit_scale;    // s / h                                                         [1/length]
};

// H, and F_visc / (dh/dt); h >= h_min
template <class Real> APF_INLINE Real filling(const Real &h, const Real &b)
{
  using std::sqrt;
  const Real s = sqrt(h * h + b);
  return (s - h) * inverse(s);
}
template <class Real>
APF_INLINE Real bridge_resistance(const Real &drag, const Real &h, const Real &b)
{
  using std::sqrt;
  const Real s2 = h * h + b, s = sqrt(s2);
  return drag * norm2(s - h) * inverse(h * s2);
}
// Momentum that viscosity takes between two gaps is drag times the logarithm of the ratio of these:
// integral of F_visc dt = integral of resistance dh.
template <class Real> APF_INLINE Real momentum_ratio(const Real &h, const Real &b)
{
  using std::sqrt;
  const Real s = sqrt(h * h + b);
  return h * s * inverse(norm2(h + s));
}
// whether a bridge is beyond its rupture: gap > h_rupt
template <class Real> APF_INLINE auto ruptured(const Real &gap, const Real &rupture, const Real &Ca)
{
  return rupture * rupture * smaller(Ca, largest_Ca) < norm2(larger(gap - rupture, 0.0));
}
template <class Real> APF_INLINE Real tangential_resistance(const Real &film, const Real &R_over_h)
{
  return film * larger((8.0 / 15.0) * logarithm(R_over_h) + 0.9588, 0.0);
}

// One bridge.
struct BridgeConstants : BridgeConstantsOf<double>, BridgeVolumeOf<double> {
  static BridgeConstantsOf<double> between(const WetContact &wet, const ContactBodies &bodies)
  {
    const BridgeModel &liquid = wet.liquid;
    const double R = bodies.R;
    const auto dry = ContactConstants::make(wet.dry, bodies);
    BridgeConstantsOf<double> c{};
    c.radius_sum = dry.radius_sum;
    c.radius_i = dry.radius_i;
    c.arm_share = dry.arm_share;
    c.turning = dry.turning;
    c.R = R;
    c.m = bodies.m;
    c.inv_m = 1.0 / bodies.m;
    c.h_min = liquid.roughness * R;
    c.pull = liquid.largest_pull(R);
    c.drag = 6.0 * pi * liquid.mu * R * R;
    c.inv_speed = liquid.mu / liquid.sigma;
    c.film = liquid.tangential ? 6.0 * pi * liquid.mu * R : 0.0;
    c.fitted = liquid.capillary == Capillary::willett ? 1.0 : 0.0;
    c.fit_force = 4.0 * pi * R * liquid.sigma;
    c.K = dry.K;
    c.neck6 = dry.neck6;
    c.kn = dry.kn;
    c.root_unit = dry.root_unit;
    c.root_scale = dry.root_scale;
    c.break_overlap = dry.break_overlap;
    c.eta = dry.eta;
    c.lag = dry.lag;
    return c;
  }
  static BridgeVolumeOf<double> filled(const BridgeModel &liquid,
                                       const BridgeConstantsOf<double> &c, double volume)
  {
    const double Rs = 2.0 * c.R;
    BridgeVolumeOf<double> v{};
    v.b = volume / (pi * c.R);
    v.rupture = liquid.rupture_at_rest(volume);
    v.inv_drag_min = 1.0 / bridge_resistance(c.drag, c.h_min, v.b);
    if (c.fitted) v.fit = WillettFit<double>::of(volume / (Rs * Rs * Rs), liquid.theta);
    v.fit_scale = 0.5 * std::sqrt(Rs / volume);
    return v;
  }
  static BridgeConstants make(const WetContact &wet, const ContactBodies &bodies, double volume)
  {
    const auto c = between(wet, bodies);
    return {c, filled(wet.liquid, c, volume)};
  }

  double gap(double h) const { return std::max(h, h_min); }    // as the laws see it

  // at a gap, also < h_min
  double attraction(double h) const
  {
    h = gap(h);
    return fitted ? fit_force * fit.force(fit_scale * h) : pull * filling(h, b);
  }
  // work that the attraction does from a gap to rupture at rest
  APF_INLINE double work(double h) const
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
  double resistance(double h) const { return bridge_resistance(drag, gap(h), b); }
  double rupture_at(double speed) const    // h_rupt
  {
    return rupture * (1.0 + std::sqrt(std::min(inv_speed * std::fabs(speed), largest_Ca)));
  }
};

}    // namespace apf

#endif
