// Normal contact of two elastic spheres that adhere: Johnson, Kendall and Roberts (JKR),
// doi:10.1098/rspa.1971.0141; in the dimensionless form of IIHR Report 459, eqs (38)-(41).
//
// With a the contact radius and s = sqrt(a/R), the law is a polynomial with one parameter,
// the neck parameter m:
//
//   overlap / R = s^4 - 4 m^3 s                       (report eq 40)
//   force       = (4/3) E R^2 s^3 (s^3 - 6 m^3)       (report eq 39; > 0 repels)
//   m^3         = (a0/R)^(3/2) / 6,  a0 = (9 pi gamma R^2 / E)^(1/3)
//
// The stable branch is s >= m. At s = m the neck ends: overlap = -3 R m^4 = -delta_C. Without
// adhesion m = 0 and the same two lines are Hertz's law, s^4 = overlap/R: there is one solver.

#ifndef APF_JKR_H
#define APF_JKR_H

#include "vector.h"

#include <algorithm>

namespace apf {

struct JKR {
  double R;       // effective radius, r_i r_j / (r_i + r_j); r_i at a wall       [length]
  double K;       // force scale (4/3) E R^2                                       [force]
  double neck;    // m = sqrt(a/R) where the neck ends; 0 without adhesion         [-]

  // E effective modulus, eq (16) [pressure]; gamma surface energy per surface [energy/length^2]
  static JKR make(double R, double E, double gamma)
  {
    const double a0 = std::cbrt(9.0 * pi * gamma * R * R / E);
    return {R, (4.0 / 3.0) * E * R * R, std::cbrt(std::pow(a0 / R, 1.5) / 6.0)};
  }

  APF_INLINE double neck3() const { return neck * neck * neck; }
  double pulloff_force() const { return 9.0 * K * neck3() * neck3(); }              // F_C, eq (41)
  double pulloff_overlap() const { return 3.0 * R * neck * neck * neck * neck; }    // delta_C > 0
  double equilibrium_radius() const { return R * std::cbrt(36.0 * neck3() * neck3()); }    // a0
  double equilibrium_overlap() const
  {
    return equilibrium_radius() * equilibrium_radius() / (3.0 * R);
  }
  // Overlap at which the force balances a load: > 0 presses the bodies together, < 0 pulls them
  // apart, down to -F_C. force = load of eq (39) is quadratic in s^3,
  //   s^3 = 3 m^3 + sqrt(9 m^6 + load/K),
  // with the sign of the branch that a load-controlled contact can be on.
  double overlap_under(double load) const
  {
    const double half = 3.0 * neck3();
    return overlap(std::cbrt(half + std::sqrt(std::max(half * half + load / K, 0.0))));
  }

  // Of the solver below: neck, or a length that is nothing beside any s; and 1 / (R unit^4).
  double root_unit() const { return std::max(neck, 1.0e-20); }
  double root_scale() const { return 1.0 / (R * std::pow(root_unit(), 4)); }
  double root(double overlap) const;    // s = sqrt(a/R) on the stable branch

  double overlap(double s) const { return R * s * (s * s * s - 4.0 * neck3()); }
  double force(double s) const { return K * s * s * s * (s * s * s - 6.0 * neck3()); }

  // d(force)/d(overlap); has a pole at the end of the neck, s = m
  double stiffness(double s) const
  {
    const double s3 = s * s * s, m3 = neck3();
    return 1.5 * K / R * s * s * (s3 - 3.0 * m3) / (s3 - m3);
  }

  // integral of force over overlap from the (virtual) state a = 0; only differences have a meaning
  APF_INLINE double energy(double s) const
  {
    const double s3 = s * s * s, s4 = s3 * s, m3 = neck3();
    return 4.0 * K * R * s4 * (0.1 * s3 * s3 - m3 * s3 + 1.5 * m3 * m3);
  }
};

// s = sqrt(a/R) on the stable branch for a given overlap. Branch-free; overlap < -delta_C gives
// the end of the neck. With s = m (1 + u) the law reads u^2 (u^2 + 4 u + 6) = y, y = 3 + overlap /
// (R m^4); f, f1, f2 are what is left of it and its derivatives, over 4, 4 and 12. The start is the
// root of a quadratic that follows u(y) within 2.5 % over all y, and two Halley steps bring that to
// rounding error: each leaves about the cube of the error before, so that four digits do in the
// first division, and twelve in the last. The pole of dF/d(overlap) at the end of the neck does no
// harm in u.
template <class Real>
APF_INLINE Real jkr_root(const Real &overlap, const Real &scale, const Real &unit)
{
  const Real y = larger(0.25 * scale * overlap + 0.75, 1.0e-60);    // keeps 0/0 away at the end
  const Real root = rough_root(y);
  // 0.6 = 1.2/2 and two steps: least error, scanned over 22 decades of y
  Real u = root * rough_inverse(0.6 + rough_root(0.36 + 0.5 * root));
  for (int step = 0; step < 2; step++) {
    const Real w = u + 1.0, f2 = w * w, f1 = u * (f2 + w + 1.0);
    const Real f = u * u * (u * (0.25 * u + 1.0) + 1.5) - y;
    const Real divisor = f1 * f1 - 1.5 * f * f2;
    u = u - f * f1 * (step == 0 ? rough_inverse(divisor) : close_inverse(divisor));
  }
  return unit * u + unit;
}

inline double JKR::root(double overlap) const
{
  return jkr_root(overlap, root_scale(), root_unit());
}

}    // namespace apf

#endif
