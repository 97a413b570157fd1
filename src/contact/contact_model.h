// The laws that act between two materials (ContactModel) and their numbers for one pair of bodies
// (ContactConstants). All roots and powers are taken here, once per contact, none per step.

#ifndef APF_CONTACT_MODEL_H
#define APF_CONTACT_MODEL_H

#include "damping.h"
#include "jkr.h"
#include "material.h"

namespace apf {

// The neck ends at -delta_C, where the force is largest, or there is none; the weakest one last.
enum class Break { displacement, force, touch };

struct ContactModel {
  Interface surface{};
  double alpha = 0.0;         // normal damping                                       [-]
  double mu = 0.0;            // sliding friction; 0 = no tangential force            [-]
  bool twisting = false;      // twisting resistance; its limit needs mu
  double theta_crit = 0.0;    // critical rolling angle xi_crit / R; 0 = no rolling   [-]
  double zeta = 0.0;          // damping of rolling, share of critical                [-]
  Break neck_end = Break::displacement;
  double stiffness_scale = 1.0;    // f: E -> f E at the same sticking velocity            [-]

  bool sliding() const { return mu > 0.0; }
  bool rolling() const { return theta_crit > 0.0; }
  bool adhesive() const { return surface.gamma > 0.0; }

  // Where the neck ends, over -delta_C; dF/ds = 0 at s^3 = 3 m^3.
  double neck_share() const
  {
    if (neck_end == Break::touch) return 0.0;
    return neck_end == Break::force ? std::cbrt(1.0 / 9.0) : 1.0;
  }

  // Normal law with the stiffness scaled: gamma' = gamma f^(2/5) keeps the sticking velocity and
  // e(V) (Haervig et al., doi:10.1016/j.powtec.2017.04.006; Chen, Liu and Li, arXiv:1805.03025).
  JKR normal(double R) const
  {
    return JKR::make(R, surface.E * stiffness_scale,
                     surface.gamma * std::pow(stiffness_scale, 0.4));
  }
};

// Geometry and inertia of two bodies. A wall is a body without radius at its foot point: arm_share
// 1, R = radius_i, and the particle's own mass and moment of inertia as effective ones.
struct ContactBodies {
  double radius_i, radius_j;    // [length]
  double arm_share;             // share of the overlap taken from i's lever arm: 1/2, wall 1   [-]
  double R;                     // effective radius                                        [length]
  double m;                     // effective mass                                            [mass]
  double I;                     // effective moment of inertia                      [mass length^2]
  double crowding;              // contacts that share the bodies, weighted by 1/mass; alone: 1 [-]
  double turning;    // how fast the normal turns with v_i - v_j: distance / its radius of
                     // turning; 1 for a pair, 0 at a plane, r/R_wall at a curved wall [-]

  static ContactBodies pair(double ri, double rj, double m_eff, double I_eff)
  {
    return {ri, rj, 0.5, ri * rj / (ri + rj), m_eff, I_eff, 1.0, 1.0};
  }
  static ContactBodies wall(double r, double m, double I, double turning = 0.0)
  {
    return {r, 0.0, 1.0, r, m, I, 1.0, turning};
  }
};

// Every coefficient multiplies a power of s = sqrt(a/R), see jkr.h. Of doubles for one contact, of
// Packs (pack.h) for a block of them.
template <class Real> struct ConstantsOf {
  Real radius_sum;       // r_i + r_j                                                    [length]
  Real radius_i;         // r_i                                                          [length]
  Real arm_share;        // share of the overlap taken from i's arm                           [-]
  Real R;                // effective radius                                             [length]
  Real inv_R;            // 1 / R                                                      [1/length]
  Real K;                // elastic force: K s^3 (s^3 - neck6)                            [force]
  Real neck6;            // 6 neck^3, 0 without adhesion                                      [-]
  Real kn;               // stiffness of Hertz's law, of which dashpots are: kn s^2  [force/length]
  Real root_unit;        // s where the neck ends, see JKR::root_unit()                       [-]
  Real root_scale;       // see JKR::root_scale()                                      [1/length]
  Real break_overlap;    // contact ends below this overlap (<= 0)                       [length]
  Real eta;              // damping: eta s = alpha sqrt(m k_N)                        [mass/time]
  Real kt;               // tangential stiffness: kt s^2 = 8 G a                   [force/length]
  Real inv_kt;           // 1 / kt; 0 where kt is
  Real mu;               // sliding friction                                                  [-]
  Real adhesion;         // 2 F_C in the friction limit mu |F_e + 2 F_C|                  [force]
  Real twist;            // limit of twisting: twist s^2 times that of sliding            [length]
  Real inv_twist;        // times s^-6: 1 / stiffness of twisting            [1/(force length)]
  Real roll_k;           // rolling stiffness: roll_k s^3 = 4 F_C (a/a0)^(3/2)            [force]
  Real inv_roll_k;       // 1 / roll_k; 0 where roll_k is
  Real roll_limit;       // xi_crit = theta_crit R                                       [length]
  Real roll_eta;         // rolling damping: roll_eta s^(3/2)                 [force time/length]
  Real turning;          // see ContactBodies                                                 [-]
  Real lag;              // lag s = eta s / (2 m), see lagging_dashpot()              [1/time]
};

struct ContactConstants : ConstantsOf<double> {
  // what other contacts of the two bodies change
  double crowd_mass;    // m / crowding                                                   [mass]
  double crowd_roll;    // I / (R crowding)                                        [mass length]

  static ContactConstants make(const ContactModel &model, const ContactBodies &bodies)
  {
    const double f = model.stiffness_scale;
    const JKR normal = model.normal(bodies.R);
    // What a softer contact must not change: the adhesive part of the friction limit and the
    // rolling moment, both proportional to F_C of the real material (physics: F_C' = f^(2/5) F_C).
    const double restore = std::pow(f, -0.4);

    ContactConstants c{};
    c.radius_sum = bodies.radius_i + bodies.radius_j;
    c.radius_i = bodies.radius_i;
    c.arm_share = bodies.arm_share;
    c.R = bodies.R;
    c.inv_R = 1.0 / bodies.R;
    c.K = normal.K;
    c.neck6 = 6.0 * normal.neck3();
    c.kn = normal.K / bodies.R;
    c.root_unit = normal.root_unit();
    c.root_scale = normal.root_scale();
    c.break_overlap = -model.neck_share() * normal.pulloff_overlap();
    c.eta = model.alpha * std::sqrt(bodies.m * normal.K / bodies.R);
    c.lag = 0.5 * c.eta / bodies.m;
    c.kt = 8.0 * model.surface.G * f * bodies.R;
    c.inv_kt = c.kt > 0.0 ? 1.0 / c.kt : 0.0;
    c.mu = model.mu;
    c.adhesion = 2.0 * normal.pulloff_force() * restore;
    // (43) has a, which grows as f^(-1/5)
    c.twist = model.twisting ? 2.0 / 3.0 * bodies.R * std::pow(f, 0.2) : 0.0;
    c.inv_twist = 2.0 * c.inv_R * c.inv_R * c.inv_kt;
    c.roll_k = 6.0 * normal.K * normal.neck3() * restore;
    c.inv_roll_k = c.roll_k > 0.0 ? 1.0 / c.roll_k : 0.0;
    c.roll_limit = model.theta_crit * bodies.R;
    c.roll_eta = 2.0 * model.zeta * std::sqrt(c.roll_k * bodies.I / bodies.R);
    c.crowd_mass = bodies.m / bodies.crowding;
    c.crowd_roll = bodies.I / (bodies.R * bodies.crowding);
    c.turning = bodies.turning;
    return c;
  }
};

}    // namespace apf

#endif
