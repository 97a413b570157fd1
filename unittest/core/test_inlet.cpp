// What enters: diameters, points of a plane in proportion to the flux, places that are free.
// Facts: moments of the laws by numerical integration and by sampling, fluxes in closed form,
// a search over all pairs.

#include "flow/diameter_law.h"
#include "flow/flow_field.h"
#include "flow/inlet_flux.h"
#include "flow/sphere_grid.h"

#include "gtest/gtest.h"

#include <cmath>
#include <random>

namespace {

using namespace apf;

struct Uniform {
  std::mt19937_64 engine{4711};
  double operator()() { return std::uniform_real_distribution<double>(1e-15, 1.0)(engine); }
};

// sampled <d^k> against the law's, within five standard errors of the sample
template <class Law> void expect_moments(const Law &law)
{
  Uniform uniform;
  const int n = 200000;
  double sum[7] = {};
  for (int i = 0; i < n; i++) {
    const double d = law.draw(uniform);
    EXPECT_GE(d, law.smallest());
    EXPECT_LE(d, law.largest());
    for (int k = 1; k <= 6; k++) sum[k] += std::pow(d, k) / n;
  }
  for (int k = 1; k <= 3; k++) {
    const double error = std::sqrt((law.moment(2 * k) - std::pow(law.moment(k), 2)) / n);
    EXPECT_GT(error, 0.0);
    EXPECT_NEAR(sum[k], law.moment(k), 5.0 * error) << "moment " << k;
  }
}

template <class Flow> InletFlux measured(const InletPlane &plane, const Flow &flow)
{
  InletFlux flux;
  flux.measure(plane, [&](const PointBlock &points, FluidBlock &out) {
    sample_pointwise(flow, points, Detail::VELOCITY, out);
  });
  return flux;
}

TEST(Diameters, sampled_moments)
{
  expect_moments(UniformDiameters{0.5, 2.0});
  expect_moments(LognormalDiameters{1.0, 1.5, 0.4, 2.5});
  expect_moments(ListedDiameters::of({1.0, 2.0, 0.5}, {0.2, 0.3, 0.5}, false));
}

TEST(Diameters, moments_of_a_cut_lognormal_by_quadrature)
{
  const LognormalDiameters law{2.0, 1.8, 0.7, 5.0};
  const double s = std::log(1.8);
  double sum[4] = {};
  const int n = 100000;
  for (int i = 0; i < n; i++) {
    const double z = (std::log(0.35) + (i + 0.5) / n * (std::log(2.5) - std::log(0.35))) / s;
    for (int k = 0; k < 4; k++)
      sum[k] += std::exp(-0.5 * z * z) * std::pow(2.0 * std::exp(s * z), k);
  }
  for (int k = 1; k < 4; k++) EXPECT_NEAR(law.moment(k) / (sum[k] / sum[0]), 1.0, 1e-8);
}

TEST(Diameters, uncut_lognormal_obeys_hatch_and_choate)
{
  const LognormalDiameters law{1.0, 1.6, 1e-9, 1e9};
  const double s2 = std::pow(std::log(1.6), 2);
  EXPECT_NEAR(law.moment(3), std::exp(4.5 * s2), 1e-9);
}

TEST(Diameters, fractions_by_volume)
{
  const auto law = ListedDiameters::of({1.0, 2.0}, {0.25, 0.75}, true);
  EXPECT_NEAR(law.fraction[0], 0.25 / (0.25 + 0.75 / 8.0), 1e-15);
  const double volume[2] = {law.fraction[0], 8.0 * law.fraction[1]};
  EXPECT_NEAR(volume[0] / (volume[0] + volume[1]), 0.25, 1e-15);
}

TEST(InletFlux, of_channel_pipe_and_backflow)
{
  ChannelFlow channel{};
  channel.flow = 0, channel.wall = 1, channel.lo = 0.0, channel.hi = 2.0, channel.umax = 3.0;
  // 2/3 umax H W
  EXPECT_NEAR(measured({0, 1.0, 0.0, {1, 2}, {0.0, 0.0}, {2.0, 5.0}}, channel).flux(), 20.0, 1e-12);
  EXPECT_NEAR(measured({0, 1.0, 0.0, {1, 2}, {0.0, 0.0}, {2.0, 0.0}}, channel).flux(), 4.0, 1e-12);
  EXPECT_EQ(measured({0, -1.0, 0.0, {1, 2}, {0.0, 0.0}, {2.0, 5.0}}, channel).flux(), 0.0);

  PipeFlow pipe{};
  pipe.flow = 2, pipe.across[0] = 0, pipe.across[1] = 1, pipe.radius = 1.0, pipe.umax = 2.0;
  pipe.centre[0] = 0.1;
  const double q = measured({2, 1.0, 0.0, {0, 1}, {-1.2, -1.2}, {1.2, 1.2}}, pipe).flux();
  EXPECT_NEAR(q / pi, 1.0, 3e-4);    // umax/2 pi R^2; its edge cuts cells

  ShearFlow shear{};
  shear.flow = 1, shear.across = 0, shear.rate = 2.0, shear.origin = 1.0;
  // only where x > 1: integral of 2 (x - 1) from 1 to 3 over unit depth
  EXPECT_NEAR(measured({1, 1.0, 0.0, {0, 2}, {-1.0, 0.0}, {3.0, 1.0}}, shear).flux(), 4.0, 1e-12);
}

TEST(InletFlux, draws_in_proportion)
{
  PipeFlow pipe{};
  pipe.flow = 2, pipe.across[0] = 0, pipe.across[1] = 1, pipe.radius = 1.0, pipe.umax = 2.0;
  const auto flux = measured({2, 1.0, 0.5, {0, 1}, {-1.5, -1.5}, {1.5, 1.5}}, pipe);
  Uniform uniform;
  const int n = 40000, bins = 20;
  std::vector<double> count(bins, 0.0);
  for (int i = 0; i < n; i++) {
    double x[3];
    Vec3 u;
    ASSERT_TRUE(flux.draw(
        uniform,
        [&](const double *at) {
          return pipe.velocity(at);
        },
        x, u));
    EXPECT_EQ(x[2], 0.5);
    const double r2 = x[0] * x[0] + x[1] * x[1];
    ASSERT_LT(r2, 1.0);
    count[static_cast<int>(bins * r2 * (2.0 - r2))]++;    // share of the flux within r
  }
  double chi2 = 0.0;
  for (double c : count) chi2 += std::pow(c - n / bins, 2) / (n / bins);
  EXPECT_GT(chi2, 4.9);     // 0.05 % and
  EXPECT_LT(chi2, 45.3);    // 99.95 % of chi-square with 19 degrees of freedom
}

TEST(SphereGrid, agrees_with_all_pairs)
{
  Uniform uniform;
  const double periods[2][3] = {{0.0, 4.0, 0.0}, {0.0, 0.9, 3.0}};
  for (const auto &period : periods) {
    SphereGrid grid(period, 0.5);
    std::vector<std::array<double, 4>> all;
    int free = 0, taken = 0;
    for (int n = 0; n < 3000; n++) {
      const double p[3] = {uniform() * 3.0 - 1.0, uniform() * 5.0 - 0.5, uniform() * 3.5 - 0.3};
      const double r = 0.05 + 0.19 * uniform();
      bool expected = true;
      for (const auto &other : all) {
        double sum = 0.0;
        for (int c = 0; c < 3; c++) {
          double d = p[c] - other[c];
          if (period[c] > 0.0) d = std::remainder(d, period[c]);
          sum += d * d;
        }
        expected = expected && std::sqrt(sum) >= r + other[3] + 0.02;
      }
      ASSERT_EQ(grid.is_free(p, r, 0.02), expected) << n;
      (expected ? free : taken)++;
      if (!expected) continue;
      grid.add(p, r);
      all.push_back({p[0], p[1], p[2], r});
    }
    EXPECT_GT(free, 50);
    EXPECT_GT(taken, 500);
  }
}

}    // namespace
