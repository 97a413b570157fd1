// Materials, their pairs, and the numbers of one contact.

#include "contact/contact_list.h"
#include "contact/stiffness.h"

#include <gtest/gtest.h>

using namespace apf;

TEST(Material, shear_modulus_of_steel)
{
  EXPECT_NEAR((Material{210e9, 0.3, 0.0}.shear_modulus()), 80.769e9, 1e6);
  EXPECT_NEAR((Material{3.0, 0.5, 0.0}.shear_modulus()), 1.0, 1e-15);    // incompressible: E/3
}

TEST(Material, equal_glass_spheres)
{
  // E = 48 GPa, nu = 0.2: E* = 48/(2 0.96) GPa; G_1 = 20 GPa, G* = 20/(2 1.8) GPa
  const Material glass{48e9, 0.2, 0.05};
  const Interface pair = interface(glass, glass);
  EXPECT_NEAR(pair.E / 25e9, 1.0, 1e-14);
  EXPECT_NEAR(pair.G / (50e9 / 9.0), 1.0, 1e-14);
  EXPECT_NEAR(pair.gamma, 0.05, 1e-15);
}

TEST(Material, polystyrene_on_quartz)
{
  // 1/E = (1-0.33^2)/3.2 + (1-0.17^2)/72 = 0.278469 + 0.013488 per GPa
  // G_1 = 3.2/2.66 = 1.203008, G_2 = 72/2.34 = 30.769231; 1/G = 1.67/1.203008 + 1.83/30.769231
  const Interface pair = interface({3.2e9, 0.33, 0.04}, {72e9, 0.17, 0.09});
  EXPECT_NEAR(pair.E, 1.0e9 / (0.278469 + 0.013488), 1e5);
  EXPECT_NEAR(pair.G, 1.0e9 / (1.388187 + 0.059475), 1e4);
  EXPECT_NEAR(pair.gamma, 0.06, 1e-15);    // sqrt(0.04 0.09)
}

TEST(Material, order_does_not_matter_and_rigid_leaves_the_other_alone)
{
  const Material a{3.2e9, 0.33, 0.04}, b{72e9, 0.17, 0.09}, rigid{INFINITY, 0.4, 0.0};
  EXPECT_DOUBLE_EQ(interface(a, b).E, interface(b, a).E);
  EXPECT_DOUBLE_EQ(interface(a, b).G, interface(b, a).G);
  EXPECT_DOUBLE_EQ(interface(a, b).gamma, interface(b, a).gamma);
  EXPECT_DOUBLE_EQ(interface(a, rigid).E, 3.2e9 / (1.0 - 0.33 * 0.33));
  EXPECT_DOUBLE_EQ(interface(a, rigid).G, 3.2e9 / 2.66 / 1.67);
}

TEST(Damping, coefficient_of_given_restitution)
{
  // alpha = -sqrt(5) ln e/sqrt(pi^2 + ln^2 e)
  const double table[][2] = {
      {0.9, 0.0749}, {0.7, 0.2522}, {0.5, 0.4818}, {0.3, 0.8002}, {0.2, 1.0195}};
  for (const auto &[e, alpha] : table) EXPECT_NEAR(damping_from_restitution(e), alpha, 6e-5);
  EXPECT_EQ(damping_from_restitution(1.0), 0.0);
  EXPECT_NEAR(damping_from_restitution(1e-300), std::sqrt(5.0), 3e-5);    // e -> 0
}

TEST(Damping, is_root_two_times_the_published_polynomial)
{
  // which presumes the mass of one of two equal spheres; 0.72 at e = 0.2 in IIHR Report 459
  auto polynomial = [](double e) {
    return 1.2728 +
        e * (-4.2783 + e * (11.087 + e * (-22.348 + e * (27.467 + e * (-18.022 + e * 4.8218)))));
  };
  EXPECT_NEAR(polynomial(0.2), 0.7203, 1e-3);
  for (double e = 0.1; e < 0.95; e += 0.05)
    EXPECT_NEAR(damping_from_restitution(e) / (std::sqrt(2.0) * polynomial(e)), 1.0, 0.01) << e;
}

TEST(ContactModel, silica_pair_in_numbers)
{
  // R = 1 um, E = 30 GPa, G = 8 GPa, gamma = 0.025: F_C = 235.619 nN, a0 = 28.6684 nm,
  // delta_C = 0.226148 nm, by hand
  ContactModel model;
  model.surface = {30e9, 8e9, 0.025};
  model.alpha = 0.5;
  model.mu = 0.3;
  model.theta_crit = 0.01;
  const auto bodies = ContactBodies::pair(1.5e-6, 3.0e-6, 2.0e-14, 1.0e-26);
  const auto c = ContactConstants::make(model, bodies);
  EXPECT_NEAR(c.R, 1.0e-6, 1e-20);
  EXPECT_NEAR(c.radius_sum, 4.5e-6, 1e-20);
  EXPECT_NEAR(c.adhesion, 2.0 * 235.619e-9, 1e-12);
  EXPECT_NEAR(c.roll_limit, 1.0e-8, 1e-21);
  EXPECT_NEAR(c.break_overlap, -0.226148e-9, 1e-15);
  const double s = std::sqrt(28.6684e-3);    // at a0
  EXPECT_NEAR(c.kt * s * s, 8.0 * 8e9 * 28.6684e-9, 0.05);
  EXPECT_NEAR(c.roll_k * s * s * s / (4.0 * 235.619e-9), 1.0, 1e-5);
  EXPECT_NEAR(c.eta * s / (0.5 * std::sqrt(2.0e-14 * 4.0 / 3.0 * 30e9 * 28.6684e-9)), 1.0, 1e-5);
}

TEST(ContactModel, neck_end_is_where_it_was_asked_for)
{
  ContactModel model;
  model.surface = {30e9, 8e9, 0.025};
  const auto bodies = ContactBodies::wall(1.0e-6, 1.0, 1.0);
  EXPECT_NEAR(ContactConstants::make(model, bodies).break_overlap, -0.226148e-9, 1e-15);
  model.neck_end = Break::force;
  EXPECT_NEAR(ContactConstants::make(model, bodies).break_overlap, -0.480750 * 0.226148e-9, 1e-15);
  model.neck_end = Break::touch;
  EXPECT_EQ(ContactConstants::make(model, bodies).break_overlap, 0.0);
  model.surface.gamma = 0.0;
  EXPECT_EQ(ContactConstants::make(model, bodies).break_overlap, 0.0);
}

TEST(ContactModel, softening_scales_the_neck_and_keeps_the_sticking_energy)
{
  ContactModel model;
  model.surface = {30e9, 8e9, 0.025};
  const JKR real = model.normal(1.0e-6);
  model.stiffness_scale = 1e-3;
  const JKR soft = model.normal(1.0e-6);
  EXPECT_NEAR(soft.pulloff_force() / real.pulloff_force(), std::pow(1e-3, 0.4), 1e-12);
  EXPECT_NEAR(soft.pulloff_force() * soft.pulloff_overlap() /
                  (real.pulloff_force() * real.pulloff_overlap()),
              1.0, 1e-12);
}

TEST(ContactBodies, radii_add_in_parallel)
{
  EXPECT_DOUBLE_EQ(ContactBodies::pair(2.0, 2.0, 1.0, 1.0).R, 1.0);
  EXPECT_DOUBLE_EQ(ContactBodies::pair(3.0, 6.0, 1.0, 1.0).R, 2.0);
  EXPECT_DOUBLE_EQ(ContactBodies::wall(3.0, 1.0, 1.0).R, 3.0);
  EXPECT_NEAR(ContactBodies::pair(3.0, 3.0e9, 1.0, 1.0).R, 3.0, 1e-8);
}

TEST(Stiffness, of_the_report_channel)
{
  // IIHR Report 459, channel: lambda = 1e4 (effective E = 6.5 MPa), phi = 1.5, d = 10 um, step
  // 0.1 d (rho^2/(E^2 U))^(1/5) = 50.24 ns; omega dt = 0.2097 phi^(1/6) lambda^(-1/15) = 0.12142,
  // and 2.19 times that along the tangent for nu = 0.3
  ContactModel model;
  const double E = 2.0 * 6.5e6 * (1.0 - 0.09), dt = 50.24e-9;
  model.surface = interface({E, 0.3, 4.875e-3}, {E, 0.3, 4.875e-3});
  const double m = 0.5 * 1.361e-12, r = 5.0e-6;
  const auto bodies = ContactBodies::pair(r, r, m, 0.4 * m * r * r);
  const double normal = stiffest_mode(model, bodies).frequency;
  EXPECT_NEAR(normal * dt, 0.12142, 0.0001);
  model.mu = 0.3;
  EXPECT_NEAR(stiffest_mode(model, bodies).frequency / normal, 2.19, 0.01);
  EXPECT_STREQ(stiffest_mode(model, bodies).name(), "tangential");
}

// k_T a0^2 / 2 over the moment of inertia, at the largest overlap at rest with which a run begins,
// r/2: it need not be asked for
TEST(Stiffness, twisting_is_slower_than_sliding)
{
  const double E = 1e6, nu = 0.3, r = 1.0, m = 1.0, I = 0.4 * m * r * r;
  for (const auto &bodies :
       {ContactBodies::wall(r, m, I), ContactBodies::pair(r, r, 0.5 * m, 0.5 * I),
        ContactBodies::pair(r, 1000.0 * r, m, I)}) {
    const double a0 = std::sqrt(3.0 * bodies.R * 0.5 * r), E_eff = 0.5 * E / (1.0 - nu * nu);
    const double gamma = a0 * a0 * a0 * E_eff / (9.0 * M_PI * bodies.R * bodies.R);
    ContactModel model;
    model.surface = interface({E, nu, gamma}, {E, nu, gamma});
    model.mu = 0.3;
    model.twisting = true;
    const double k_T = 8.0 * a0 * 0.25 * E / ((1.0 + nu) * (2.0 - nu));
    const double twisting = std::sqrt(0.5 * k_T * a0 * a0 / bodies.I);
    EXPECT_NEAR(twisting / stiffest_mode(model, bodies).frequency, a0 / r / std::sqrt(2.8), 1e-9);
    EXPECT_LT(twisting, stiffest_mode(model, bodies).frequency);
  }
}
