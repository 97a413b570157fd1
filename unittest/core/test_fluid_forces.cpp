// Forces of the fluid on a block of spheres. Facts: values of libm and of the authors of Philox,
// formulae of the sources written out, measured slip, all builds against each other.

#include "compare.h"
#include "flow/accelerated_fluid.h"
#include "flow/brownian.h"
#include "flow/cunningham.h"
#include "flow/fluid_forces.h"
#include "flow/magnus.h"
#include "flow/philox.h"
#include "flow/saffman.h"
#include "flow/stokes.h"

#include "gtest/gtest.h"

#include <cmath>
#include <memory>
#include <random>

using namespace apf;

namespace {

// a block of different spheres in a flow of random velocity and gradient
struct Scene {
  FluidModel model;
  FluidBlock fluid{};
  ForceBlock block{};

  explicit Scene(bool all = false)
  {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> number(-1.0, 1.0);
    model.drag = FluidModel::STOKES;
    model.density = 0.7;
    model.viscosity = 0.3;
    block.n = block_width;
    for (int l = 0; l < block_width; l++) {
      block.diameter[l] = 1.0 + 0.5 * number(random);
      block.mass[l] = 1.5 * sphere::volume(block.diameter[l]);
      block.step[l] = std::pow(10.0, 3.0 * number(random));
      block.concentration[l] = 0.3 + 0.3 * number(random);
      block.tag[l] = l + 1;
      for (int c = 0; c < 3; c++) {
        block.velocity[c][l] = number(random);
        block.spin[c][l] = number(random);
        block.other_force[c][l] = number(random);
        block.other_torque[c][l] = number(random);
        fluid.velocity[c][l] = number(random);
        fluid.rate[c][l] = number(random);
        for (auto &row : fluid.gradient) row[c][l] = number(random);
      }
      const auto &g = fluid.gradient;
      fluid.vorticity[0][l] = g[2][1][l] - g[1][2][l];
      fluid.vorticity[1][l] = g[0][2][l] - g[2][0][l];
      fluid.vorticity[2][l] = g[1][0][l] - g[0][1][l];
    }
    if (!all) return;
    model.torque = model.lift = model.magnus = model.added_mass = model.pressure = true;
    model.weight = model.brownian = true;
    model.gravity = {0.1, 0.2, -0.3};
    model.mean_free_path = 0.1;
    model.kT = 0.4;
    model.seed = 77;
    model.step = 123456;
    model.step_length = 0.01;
  }
  Vec3 force(FluidForce which, int l) const
  {
    const auto &f = block.force[which];
    return {f[0][l], f[1][l], f[2][l]};
  }
  Vec3 slip(int l) const
  {
    return {block.velocity[0][l] - fluid.velocity[0][l],
            block.velocity[1][l] - fluid.velocity[1][l],
            block.velocity[2][l] - fluid.velocity[2][l]};
  }
};

void expect_near(const Vec3 &a, const Vec3 &b, double tolerance)
{
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
  EXPECT_NEAR(a.z, b.z, tolerance);
}

}    // namespace

TEST(Elementary, functions_are_those_of_libm)
{
  for (double x = -700.0; x < 700.0; x += 0.737) {
    EXPECT_NEAR(exponential_less_one(x) / std::expm1(x), 1.0, 1e-14) << x;
    EXPECT_NEAR(logarithm(std::exp(x)) - x, 0.0, 4e-15 * std::max(1.0, std::fabs(x))) << x;
  }
  for (double x : {1e-300, 1e-17, 1e-9, 1e-4, 0.3}) {
    EXPECT_NEAR(exponential_less_one(x) / std::expm1(x), 1.0, 1e-14) << x;
    EXPECT_NEAR(exponential_less_one(-x) / std::expm1(-x), 1.0, 1e-14) << x;
  }
  for (double u = -0.5; u <= 0.5; u += 0.0137) {
    double c, s;
    on_circle(u, c, s);
    EXPECT_NEAR(c, std::cos(2.0 * pi * u), 1e-11);
    EXPECT_NEAR(s, std::sin(2.0 * pi * u), 1e-11);
  }
}

TEST(Philox, gives_the_numbers_of_its_authors)
{
  // known answers that come with the authors' library: counters and keys of 0, of ones, of pi
  constexpr std::uint64_t ones = 0xffffffff;
  std::uint64_t word[4][3] = {
      {0, ones, 0x243f6a88}, {0, ones, 0x85a308d3}, {0, ones, 0x13198a2e}, {0, ones, 0x03707344}};
  const std::uint64_t answer[3][4] = {{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8},
                                      {0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd},
                                      {0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}};
  const std::uint32_t keys[3][2] = {{0, 0}, {0xffffffff, 0xffffffff}, {0xa4093822, 0x299f31d0}};
  for (int lane = 0; lane < 3; lane++) {
    std::uint64_t copy[4][3];
    std::copy(&word[0][0], &word[0][0] + 12, &copy[0][0]);
    philox(copy, keys[lane][0], keys[lane][1]);
    for (int w = 0; w < 4; w++) EXPECT_EQ(copy[w][lane], answer[lane][w]) << lane << " " << w;
  }
}

TEST(Philox, normal_numbers_are_normal_and_independent)
{
  constexpr int n = 200000;
  double sum[4] = {}, xy = 0.0, xy2 = 0.0;
  for (int k = 0; k < n; k++) {
    std::uint64_t word[4][1] = {{static_cast<std::uint64_t>(k)}, {0}, {9}, {0}};
    philox(word, 3, 4);
    double x, y;
    normal_pair(static_cast<double>(word[0][0]), static_cast<double>(word[1][0]), x, y);
    for (int p = 1; p <= 4; p++) sum[p - 1] += (std::pow(x, p) + std::pow(y, p)) / (2.0 * n);
    xy += x * y / n;
    xy2 += x * x * y * y / n;
  }
  // standard deviations of these means are sqrt((<x^2p> - <x^p>^2) / 2n)
  EXPECT_NEAR(sum[0], 0.0, 4.0 * std::sqrt(0.5 / n));
  EXPECT_NEAR(sum[1], 1.0, 4.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(sum[2], 0.0, 4.0 * std::sqrt(7.5 / n));
  EXPECT_NEAR(sum[3], 3.0, 4.0 * std::sqrt(48.0 / n));
  EXPECT_NEAR(xy, 0.0, 4.0 * std::sqrt(1.0 / n));
  EXPECT_NEAR(xy2, 1.0, 4.0 * std::sqrt(8.0 / n));
}

TEST(Lift, saffman_is_the_form_of_the_report)
{
  // report eq (9) with its mass: -2.18 chi m (v - u) x om / (Re^1/2 alpha^1/2)
  const double d = 1e-5, rho = 1.2, mu = 2e-5;
  const Vec3 slip{0.01, -0.02, 0.005}, om{300.0, -100.0, 50.0};
  const double s = std::sqrt(norm2(slip)), w = std::sqrt(norm2(om));
  const double Re = s * d * rho / mu, alpha = w * d / (2.0 * s);
  const Vec3 lift = saffman_lift(rho, mu, d, slip, om);
  const Vec3 report = (-2.18 * rho * sphere::volume(d) / std::sqrt(Re * alpha)) * cross(slip, om);
  const double scale = std::sqrt(norm2(report));
  expect_near((1.0 / scale) * lift, (1.0 / scale) * report, 1e-3);
}

TEST(Lift, leading_particle_goes_where_the_fluid_is_slower)
{
  // u = G y e_x, om = -G e_z; a particle that leads moves down
  const Vec3 lift = saffman_lift(1.0, 1.0, 0.1, Vec3{1.0, 0.0, 0.0}, Vec3{0.0, 0.0, -2.0});
  EXPECT_LT(lift.y, 0.0);
  EXPECT_NEAR(lift.y, -1.615 * 0.01 * std::sqrt(2.0), 1e-12);
  EXPECT_EQ(lift.x, 0.0);
}

TEST(Lift, magnus_is_that_of_rubinow_and_keller)
{
  // pi rho r^3 (Om - om/2) x (v - u)
  const double d = 0.2, rho = 3.0;
  const Vec3 spin{1.0, 2.0, -1.0}, slip{0.5, -0.2, 0.7};
  const Vec3 lift = magnus_lift(displaced_mass(d, rho), spin, slip);
  expect_near(lift, (pi * rho * 1e-3) * cross(spin, slip), 1e-15);
  // a ball with topspin (towards +x at its top, about -z there) that flies along +x dips
  EXPECT_LT(magnus_lift(1.0, Vec3{0.0, 0.0, -1.0}, Vec3{1.0, 0.0, 0.0}).y, 0.0);
}

TEST(Slip, cunningham_as_measured_in_air)
{
  // W. C. Hinds, Aerosol Technology, 2nd ed., Wiley 1999, table A11: air, mean free path 66 nm
  const double table[][2] = {{1e-8, 22.98}, {1e-7, 2.911}, {1e-6, 1.155}, {1e-5, 1.0155}};
  for (const auto &row : table)
    EXPECT_NEAR(slip_correction(66e-9, row[0]) / row[1], 1.0, 0.03) << row[0];
  EXPECT_NEAR(slip_correction(1e-9, 1.0), 1.0, 1e-8);
  EXPECT_NEAR(spin_slip_correction(0.01, 1.0), 1.0 + 3.0 * 1.257 * 0.02, 1e-12);
}

TEST(Acceleration, stagnation_flow_and_solid_rotation)
{
  // u = (x, -y, 0): Du/Dt = (x, y, 0); rotation: Du/Dt = -Om^2 (x, y, 0), towards the axis
  const double x = 0.7, y = -0.4, om = 3.0;
  const Vec3 stagnation[3] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 0}};
  const Vec3 rotation[3] = {{0, -om, 0}, {om, 0, 0}, {0, 0, 0}};
  const Vec3 still{0, 0, 0};
  expect_near(acceleration_along(Vec3{x, -y, 0}, still, stagnation), {x, y, 0}, 1e-15);
  expect_near(acceleration_along(Vec3{-om * y, om * x, 0}, still, rotation),
              {-om * om * x, -om * om * y, 0}, 1e-14);
}

TEST(FluidForces, pressure_carries_a_sphere_of_the_fluids_density)
{
  Scene s;
  s.model.pressure = true;
  for (int l = 0; l < block_width; l++)
    s.block.mass[l] = s.model.density * sphere::volume(s.block.diameter[l]);
  fluid_forces()(s.model, s.fluid, s.block);
  for (int l = 0; l < block_width; l++)
    for (int a = 0; a < 3; a++) {
      double acceleration = s.fluid.rate[a][l];
      for (int b = 0; b < 3; b++)
        acceleration += s.fluid.gradient[a][b][l] * s.fluid.velocity[b][l];
      EXPECT_NEAR(s.block.force[PRESSURE][a][l] / s.block.mass[l], acceleration, 1e-13);
    }
}

TEST(FluidForces, all_that_is_given_is_the_sum_of_the_forces)
{
  Scene s(true);
  fluid_forces()(s.model, s.fluid, s.block);
  double largest = 0.0;
  for (int l = 0; l < block_width; l++) {
    Vec3 sum{0, 0, 0};
    for (int k = 0; k < n_fluid_forces; k++) {
      const Vec3 force = s.force(static_cast<FluidForce>(k), l);
      EXPECT_GT(norm2(force), 0.0) << k;
      sum = sum + force;
      largest = apf_test::larger(largest, std::sqrt(norm2(force)));
    }
    for (int c = 0; c < 3; c++)
      EXPECT_NEAR(s.block.given[c][l], c == 0 ? sum.x : c == 1 ? sum.y : sum.z, 1e-12 * largest);
  }
}

TEST(FluidForces, added_mass_is_paid_for_by_the_acceleration)
{
  // all forces and c_M rho V (du/dt - dv/dt) together are m dv/dt
  Scene s;
  s.model.added_mass = true;
  fluid_forces()(s.model, s.fluid, s.block);
  for (int l = 0; l < block_width; l++) {
    const double m = s.block.mass[l], half = 0.5 * displaced_mass(s.block.diameter[l], 0.7);
    EXPECT_NEAR(s.block.share[l], m / (m + half), 1e-15);
    for (int c = 0; c < 3; c++) {
      const double dvdt = (s.block.given[c][l] + s.block.other_force[c][l]) / m;
      const double without = s.block.force[DRAG][c][l] + s.block.other_force[c][l] +
          s.block.force[ADDED_MASS][c][l] + half * dvdt;
      EXPECT_NEAR((m + half) * dvdt, without, 1e-11);
    }
  }
}

TEST(FluidForces, lift_relaxes_to_its_fixed_point_at_any_step)
{
  // held by a force that balances drag and lift at this slip, a sphere stays as it is
  Scene s;
  s.model.lift = true;
  for (int l = 0; l < block_width; l++) {
    const double k = stokes_resistance(s.model.viscosity, s.block.diameter[l]);
    const Vec3 om{s.fluid.vorticity[0][l], s.fluid.vorticity[1][l], s.fluid.vorticity[2][l]};
    const Vec3 hold = k * s.slip(l) - saffman_lift(0.7, 0.3, s.block.diameter[l], s.slip(l), om);
    s.block.other_force[0][l] = hold.x;
    s.block.other_force[1][l] = hold.y;
    s.block.other_force[2][l] = hold.z;
  }
  fluid_forces()(s.model, s.fluid, s.block);
  for (int l = 0; l < block_width; l++)
    for (int c = 0; c < 3; c++) EXPECT_NEAR(s.block.given[c][l], -s.block.other_force[c][l], 1e-12);
}

TEST(FluidForces, spheres_at_rest_in_fluid_at_rest_feel_nothing)
{
  for (const auto drag : {FluidModel::STOKES, FluidModel::SCHILLER, FluidModel::DI_FELICE}) {
    Scene s(true);
    s.model.drag = drag;
    s.model.weight = s.model.brownian = false;
    s.fluid = FluidBlock{};
    for (auto *lanes : {s.block.velocity, s.block.spin, s.block.other_force, s.block.other_torque})
      for (int c = 0; c < 3; c++) std::fill_n(lanes[c], block_width, 0.0);
    s.block.concentration[3] = 7.0;    // clouds overlap
    fluid_forces()(s.model, s.fluid, s.block);
    for (int l = 0; l < block_width; l++) {
      for (int c = 0; c < 3; c++) {
        EXPECT_EQ(s.block.given[c][l], 0.0);
        EXPECT_EQ(s.block.torque[c][l], 0.0);
      }
      EXPECT_TRUE(std::isfinite(s.block.rate[l]));
    }
  }
}

TEST(FluidForces, in_no_time_there_is_no_thermal_motion)
{
  for (const auto &build : fluid_forces_builds())
    for (const double time : {0.0, 1e-310}) {    // 2 kT/time is beyond all numbers, too
      Scene cold(true), warm(true);
      for (auto *s : {&cold, &warm}) {
        s->model.step_length = time;
        std::fill_n(s->block.step, block_width, time);
        s->model.brownian = s == &warm;
        build.forces(s->model, s->fluid, s->block);
      }
      for (int l = 0; l < block_width; l++)
        for (int c = 0; c < 3; c++) {
          EXPECT_EQ(warm.block.force[BROWNIAN][c][l], 0.0);
          EXPECT_EQ(warm.block.given[c][l], cold.block.given[c][l]);
          EXPECT_EQ(warm.block.torque[c][l], cold.block.torque[c][l]);
          EXPECT_TRUE(std::isfinite(warm.block.given[c][l]));
        }
    }
}

TEST(FluidForces, all_builds_agree)
{
  ASSERT_GE(fluid_forces_builds().size(), 1u);
  for (const auto drag : {FluidModel::STOKES, FluidModel::SCHILLER, FluidModel::DI_FELICE,
                          FluidModel::DI_FELICE_SUPERFICIAL})
    for (bool planar : {false, true}) {
      Scene first(true);
      first.model.drag = drag;
      first.model.planar = planar;
      fluid_forces_builds().front().forces(first.model, first.fluid, first.block);
      for (const auto &build : fluid_forces_builds()) {
        Scene s(true);
        s.model.drag = drag;
        s.model.planar = planar;
        build.forces(s.model, s.fluid, s.block);
        for (int l = 0; l < block_width; l++)
          for (int c = 0; c < 3; c++) {
            const double a = s.block.given[c][l], b = first.block.given[c][l];
            EXPECT_NEAR(a, b, 1e-12 * (1.0 + std::fabs(b))) << build.name;
            EXPECT_NEAR(s.block.torque[c][l], first.block.torque[c][l],
                        1e-12 * (1.0 + std::fabs(first.block.torque[c][l])))
                << build.name;
          }
      }
    }
}
