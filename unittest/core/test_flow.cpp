// Laws of the fluid without LAMMPS. Facts: closed forms, finite differences, measured drag,
// independent integration with Runge-Kutta's method.

#include "compare.h"
#include "flow/di_felice.h"
#include "flow/flow_field.h"
#include "flow/fluid_forces.h"
#include "flow/relaxation.h"
#include "flow/schiller_naumann.h"
#include "flow/stokes.h"

#include "gtest/gtest.h"

#include <cmath>
#include <functional>
#include <vector>

using namespace apf;

namespace {

double component(const Vec3 &a, int k)
{
  return k == 0 ? a.x : k == 1 ? a.y : a.z;
}

// every kind of flow along every axis
std::vector<FlowField> all_flows()
{
  std::vector<FlowField> flows = {UniformFlow{{1.0, -2.0, 3.0}}};
  for (int f = 0; f < 3; f++) {
    for (int g = 0; g < 3; g++) {
      if (g == f) continue;
      flows.push_back(ShearFlow{f, g, 0.3, -1.7});
      flows.push_back(ChannelFlow{f, g, -1.0, 2.0, 1.3});
    }
    flows.push_back(PipeFlow{f, {f == 0 ? 1 : 0, f == 2 ? 1 : 2}, {0.1, -0.2}, 1.5, 0.9});
  }
  return flows;
}

Vec3 velocity(const FlowField &flow, const double *x)
{
  return std::visit(
      [x](const auto &kind) {
        return kind.velocity(x);
      },
      flow);
}

Vec3 vorticity(const FlowField &flow, const double *x)
{
  return std::visit(
      [x](const auto &kind) {
        return kind.gradient(x).curl();
      },
      flow);
}

// d u_k / d x_l, central difference; exact but for rounding, since no flow is above second degree
double slope(const FlowField &flow, const double *x, int k, int l)
{
  const double h = 1e-3;
  double right[3] = {x[0], x[1], x[2]}, left[3] = {x[0], x[1], x[2]};
  right[l] += h;
  left[l] -= h;
  return (component(velocity(flow, right), k) - component(velocity(flow, left), k)) / (2.0 * h);
}

// Runge-Kutta's fourth-order method for dw/dt = rate(w)
double integrate(double w, double time, const std::function<double(double)> &rate)
{
  const int n = 20000;
  const double h = time / n;
  for (int i = 0; i < n; i++) {
    const double a = rate(w), b = rate(w + 0.5 * h * a), c = rate(w + 0.5 * h * b);
    const double d = rate(w + h * c);
    w += h / 6.0 * (a + 2.0 * b + 2.0 * c + d);
  }
  return w;
}

// slip after n kicks over time t, one sphere of mass and diameter 1 in a fluid at rest of density
// rho and viscosity mu, pulled by the force F; drag of Schiller and Naumann
double slip_after(int n, double t, double w, double F, double rho, double mu)
{
  FluidModel model;
  model.drag = FluidModel::SCHILLER;
  model.density = rho;
  model.viscosity = mu;
  FluidBlock fluid{};
  ForceBlock sphere{};
  std::fill_n(sphere.mass, block_width, 1.0);
  std::fill_n(sphere.diameter, block_width, 1.0);
  sphere.n = 1;
  sphere.step[0] = t / n;
  sphere.other_force[0][0] = F;
  for (int i = 0; i < n; i++) {
    sphere.velocity[0][0] = w;
    fluid_forces()(model, fluid, sphere);
    w += t / n * (F + sphere.given[0][0]);
  }
  return w;
}

}    // namespace

TEST(FlowField, channel_is_a_parabola_between_its_walls)
{
  const ChannelFlow flow{2, 0, 1.0, 3.0, 4.0};
  const double table[][2] = {{1.0, 0.0}, {1.5, 3.0}, {2.0, 4.0}, {2.5, 3.0},
                             {3.0, 0.0}, {0.9, 0.0}, {3.1, 0.0}, {-9.0, 0.0}};
  for (const auto &row : table) {
    const double x[3] = {row[0], 5.0, 6.0};
    EXPECT_DOUBLE_EQ(flow.velocity(x).z, row[1]) << "at " << row[0];
    EXPECT_EQ(flow.velocity(x).x, 0.0);
    EXPECT_EQ(flow.velocity(x).y, 0.0);
  }
}

TEST(FlowField, channel_carries_two_thirds_of_its_maximum)
{
  const ChannelFlow flow{0, 1, -1.0, 1.0, 1.5};
  double sum = 0.0;
  const int n = 2000;
  for (int i = 0; i < n; i++) {
    const double x[3] = {0.0, -1.0 + (i + 0.5) * 2.0 / n, 0.0};
    sum += flow.velocity(x).x / n;
  }
  EXPECT_NEAR(sum, 1.0, 1e-6);
}

TEST(FlowField, pipe_carries_half_of_its_maximum)
{
  const PipeFlow flow{1, {0, 2}, {0.5, -0.5}, 2.0, 3.0};
  double flux = 0.0;
  const int n = 400;
  for (int i = 0; i < n; i++)
    for (int j = 0; j < n; j++) {
      const double x[3] = {0.5 - 3.0 + (i + 0.5) * 6.0 / n, 7.0, -0.5 - 3.0 + (j + 0.5) * 6.0 / n};
      flux += flow.velocity(x).y * 36.0 / (n * n);
    }
  EXPECT_NEAR(flux / (pi * 4.0), 1.5, 1e-4);
  const double axis[3] = {0.5, 1.0, -0.5}, wall[3] = {0.5, 1.0, 1.5}, out[3] = {0.5, 1.0, 1.6};
  EXPECT_DOUBLE_EQ(flow.velocity(axis).y, 3.0);
  EXPECT_EQ(flow.velocity(wall).y, 0.0);
  EXPECT_EQ(flow.velocity(out).y, 0.0);
  EXPECT_EQ(norm2(flow.gradient(out).curl()), 0.0);
}

TEST(FlowField, vorticity_is_the_curl_of_the_velocity)
{
  const double x[3] = {0.2, 0.4, 0.7};
  double largest = 0.0;
  for (const auto &flow : all_flows()) {
    const Vec3 om = vorticity(flow, x);
    EXPECT_NEAR(om.x, slope(flow, x, 2, 1) - slope(flow, x, 1, 2), 1e-11);
    EXPECT_NEAR(om.y, slope(flow, x, 0, 2) - slope(flow, x, 2, 0), 1e-11);
    EXPECT_NEAR(om.z, slope(flow, x, 1, 0) - slope(flow, x, 0, 1), 1e-11);
    largest = apf_test::larger(largest, std::sqrt(norm2(om)));
    EXPECT_NEAR(slope(flow, x, 0, 0) + slope(flow, x, 1, 1) + slope(flow, x, 2, 2), 0.0, 1e-11)
        << "an incompressible fluid";
  }
  EXPECT_NEAR(largest, 1.7, 1e-11);    // the shear
}

TEST(FlowField, gradient_is_that_of_the_velocity)
{
  PointBlock points;
  FluidBlock fluid;
  const double x[3] = {0.2, 0.4, 0.7};
  points.n = 2;
  points.set(1, x);
  for (const auto &flow : all_flows()) {
    sample(flow, points, Detail::GRADIENT, fluid);
    for (int a = 0; a < 3; a++) {
      EXPECT_EQ(fluid.velocity[a][1], component(velocity(flow, x), a));
      EXPECT_EQ(fluid.vorticity[a][1], component(vorticity(flow, x), a));
      for (int b = 0; b < 3; b++) EXPECT_NEAR(fluid.gradient[a][b][1], slope(flow, x, a, b), 1e-11);
    }
  }
}

TEST(FlowField, shear_turns_clockwise_where_u_grows_with_y)
{
  const ShearFlow flow{0, 1, 0.0, 2.0};
  const double x[3] = {0.0, 3.0, 0.0};
  EXPECT_DOUBLE_EQ(flow.velocity(x).x, 6.0);
  EXPECT_DOUBLE_EQ(flow.gradient(x).curl().z, -2.0);
}

TEST(Stokes, ten_micrometre_sphere_in_air)
{
  const double d = 10e-6, mass = 2600.0 * sphere::volume(d), mu = 2e-5;
  EXPECT_NEAR(mass / stokes_resistance(mu, d), 0.72222e-3, 0.00001e-3);
  EXPECT_NEAR((mass - displaced_mass(d, 1.2)) * 9.81 / stokes_resistance(mu, d), 7.0817e-3,
              0.0001e-3);
  EXPECT_NEAR(sphere::moment_of_inertia(mass, d) / stokes_spin_resistance(mu, d), 0.3 * 0.72222e-3,
              0.00001e-3);
}

TEST(Stokes, sphere_as_dense_as_the_fluid_is_weightless)
{
  const double mass = 1000.0 * sphere::volume(0.01);
  EXPECT_NEAR((mass - displaced_mass(0.01, 1000.0)) / mass, 0.0, 1e-15);
  EXPECT_NEAR((mass - displaced_mass(0.01, 2000.0)) / mass, -1.0, 1e-15);
  EXPECT_NEAR((mass - displaced_mass(0.01, 250.0)) / mass, 0.75, 1e-15);
}

TEST(Drag, schiller_naumann_is_the_measured_drag_of_spheres)
{
  // drag coefficient 24 f/Re: C. E. Lapple, C. B. Shepherd, Ind. Eng. Chem. 32, 605 (1940)
  const double table[][2] = {{0.1, 240.0},  {1.0, 26.5},   {10.0, 4.1},   {50.0, 1.5},
                             {100.0, 1.07}, {200.0, 0.77}, {500.0, 0.55}, {700.0, 0.50}};
  for (const auto &row : table)
    EXPECT_NEAR(24.0 / row[0] * SchillerNaumannDrag::factor(row[0], 0.0) / row[1], 1.0, 0.05)
        << "Re = " << row[0];
  EXPECT_EQ(SchillerNaumannDrag::factor(0.0, 0.0), 1.0);
}

TEST(Drag, di_felice_hinders_as_tabulated)
{
  EXPECT_NEAR(DiFeliceDrag<false>::factor(0.0, 0.1), 1.477, 0.0005);
  EXPECT_NEAR(DiFeliceDrag<false>::factor(1.0, 0.1), 1.444, 0.0005);
  EXPECT_NEAR(DiFeliceDrag<false>::factor(31.6, 0.1), 1.379, 0.0005);
  EXPECT_EQ(DiFeliceDrag<false>::factor(1.0, 0.0), 1.0);
}

TEST(Drag, di_felice_is_finite_in_overlapping_clouds)
{
  EXPECT_EQ(DiFeliceDrag<false>::factor(0.0, 3.0),
            DiFeliceDrag<false>::factor(0.0, max_concentration));
  EXPECT_NEAR(DiFeliceDrag<false>::factor(0.0, 1.0), std::pow(0.36, -3.7), 1e-9);
  EXPECT_EQ(DiFeliceDrag<false>::factor(5.0, -1e-3), 1.0);
}

TEST(Relaxation, kick_of_any_length_is_the_exact_solution)
{
  const double k = 2.0, m = 3.0, F = 0.7, w0 = -1.9;
  for (double z : {1e-9, 1e-6, 1e-3, 0.1, 1.0, 10.0, 1e3}) {
    const double h = z * m / k;
    const Vec3 drag = mean_resistance(k, mean_decay(z), {w0, 0, 0}, {F, 0, 0});
    const double w = w0 + h / m * (drag.x + F);
    EXPECT_NEAR(w, F / k + (w0 - F / k) * std::exp(-z), 1e-15 * (1.0 + z)) << "z = " << z;
  }
}

TEST(Relaxation, decay_over_a_step_follows_from_its_first_half)
{
  for (double z : {0.0, 1e-12, 0.01, 1.0, 30.0, 1000.0}) {
    const double exact = z > 0.0 ? -std::expm1(-z) / z : 1.0;
    EXPECT_NEAR(mean_decay_of_both_halves(z, mean_decay(0.5 * z)) / exact, 1.0, 4e-15) << z;
  }
}

TEST(Relaxation, vanishing_step_is_the_plain_law)
{
  EXPECT_EQ(mean_decay(0.0), 1.0);
  EXPECT_NEAR(mean_decay(1e-12), 1.0, 1e-12);
  const Vec3 drag = mean_resistance(2.0, mean_decay(0.0), {1, -2, 3}, {5, 5, 5});
  EXPECT_EQ(drag.x, -2.0);
  EXPECT_EQ(drag.y, 4.0);
  EXPECT_EQ(drag.z, -6.0);
}

TEST(Relaxation, held_body_feels_the_full_drag_whatever_the_step)
{
  const double k = 2.0, wind = -3.0;    // slip of a body at rest in a wind of 3
  for (double z : {1e-3, 1.0, 10.0, 1e4}) {
    const Vec3 drag = mean_resistance(k, mean_decay(z), {wind, 0, 0}, {k * wind, 0, 0});
    EXPECT_NEAR(drag.x, 6.0, 1e-14) << "z = " << z;
  }
}

TEST(FluidForces, nonlinear_drag_is_of_second_order)
{
  const double F = 3.0, rho = 5.0, mu = 0.1, t = 0.4, w0 = 8.0;    // Re from 400 down
  const double exact = integrate(w0, t, [=](double w) {
    return F - 3.0 * pi * mu * w * (1.0 + 0.15 * std::pow(rho * w / mu, 0.687));
  });
  auto error = [=](int n) {
    return std::fabs(slip_after(n, t, w0, F, rho, mu) - exact);
  };
  for (int n : {16, 32, 64}) EXPECT_NEAR(std::log2(error(n) / error(2 * n)), 2.0, 0.15);
  EXPECT_LT(error(128), 1e-4);
  EXPECT_GT(error(16), 1e-5) << "too exact to measure an order";
}

TEST(FluidForces, nonlinear_drag_has_the_exact_terminal_velocity)
{
  const double rho = 5.0, mu = 0.1, w = 2.0;
  const double F = 3.0 * pi * mu * w * (1.0 + 0.15 * std::pow(rho * w / mu, 0.687));
  const double tau = 1.0 / (3.0 * pi * mu);
  for (double z : {0.1, 10.0, 1000.0}) {
    for (double start : {0.0, 50.0}) {
      const double end = slip_after(200, 200 * z * tau, start, F, rho, mu);
      EXPECT_NEAR(end / w, 1.0, 1e-12) << "dt/tau = " << z << " from " << start;
    }
  }
}
