// Clouds of particles on cells. Facts: moments of Gaussians and B-splines, discrete Fourier
// transform written out, closed form of a cell's mean.

#include "compare.h"
#include "flow/cloud_spectrum.h"
#include "flow/gaussian_cloud.h"

#include <gtest/gtest.h>

#include <complex>

using namespace apf;

TEST(GaussianCloud, has_the_moments_of_a_gaussian)
{
  for (double at : {10.0, 10.3, 10.5, 10.99}) {
    CloudWeights cloud;
    cloud.set(at, 1.7, -100, 100);
    double sum = 0.0, mean = 0.0, square = 0.0;
    for (size_t k = 0; k < cloud.w.size(); k++) {
      const double x = cloud.first + static_cast<double>(k) + 0.5 - at;
      sum += cloud.w[k];
      mean += cloud.w[k] * x;
      square += cloud.w[k] * x * x;
    }
    EXPECT_NEAR(sum, 1.0, 1e-15);
    EXPECT_NEAR(mean, 0.0, 1e-6);
    EXPECT_NEAR(square, 0.5 * 1.7 * 1.7 + 1.0 / 12.0, 1e-5);
  }
}

TEST(GaussianCloud, a_closed_border_returns_what_is_beyond)
{
  // half of the cloud of a particle at the border is there: cells inside get twice their part; the
  // cut at 4 R takes 1.5e-8
  CloudWeights open, closed;
  open.set(5.0, 1.0, -100, 100);
  closed.set(5.0, 1.0, 5, 100);
  ASSERT_EQ(closed.first, 5);
  for (size_t k = 0; k < closed.w.size(); k++)
    EXPECT_NEAR(closed.w[k], 2.0 * open.w[5 - open.first + k], 1.6e-8);
}

TEST(CloudSpline, has_the_moments_of_a_sum_of_uniform_variables)
{
  for (int order = 3; order <= longest_spline; order++)
    for (double at : {7.0, 7.25, 7.5, 7.93}) {
      double w[longest_spline], sum = 0.0, mean = 0.0, square = 0.0;
      const int first = spline_weights(order, at, w);
      for (int k = 0; k < order; k++) {
        const double x = first + k + 0.5 - at;
        EXPECT_LE(std::fabs(x), 0.5 * order);
        EXPECT_GE(w[k], 0.0);
        sum += w[k];
        mean += w[k] * x;
        square += w[k] * x * x;
      }
      EXPECT_NEAR(sum, 1.0, 1e-14);
      EXPECT_NEAR(mean, 0.0, 1e-14);
      EXPECT_NEAR(square, order / 12.0, 1e-13);
    }
}

// one cloud by convolution on n periodic cells along a line, less its mean over each cell; over the
// peak
static double convolution_error_of(int order, double radius, double at)
{
  constexpr int n = 64;
  double w[longest_spline], worst = 0.0;
  const int first = spline_weights(order, at, w);
  std::complex<double> wave[n];
  for (int k = 0; k < n; k++)
    for (int j = 0; j < order; j++)
      wave[k] += w[j] * std::polar(1.0, -2.0 * pi * k * (first + j) / n);
  for (int cell = 0; cell < n; cell++) {
    double smooth = 0.0, exact = 0.0;
    for (int k = 0; k < n; k++)
      smooth += (wave[k] * std::polar(1.0, 2.0 * pi * k * cell / n)).real() *
          cloud_spectrum(order, radius, 2.0 * pi * std::min(k, n - k) / n) / n;
    for (int image = -1; image <= 1; image++)
      exact += 0.5 *
          (std::erf((cell + 1 + image * n - at) / radius) -
           std::erf((cell + image * n - at) / radius));
    worst = apf_test::larger(worst, std::fabs(smooth - exact));
  }
  return worst * std::sqrt(pi) * radius;
}

TEST(CloudSpline, convolution_gives_the_mean_of_the_cloud)
{
  for (double radius : {2.6, 3.0, 4.0, 6.0, 7.9})
    for (int order : {3, 4, 7, 12}) {
      double worst = 0.0;
      for (double at : {31.5, 31.6, 31.75, 32.0})
        worst = apf_test::larger(worst, convolution_error_of(order, radius, at));
      const double bound = alias_error(order, radius) + 1e-14;
      EXPECT_LT(worst, 1.1 * bound) << order << " " << radius;
      if (bound > 1e-12) { EXPECT_GT(worst, 0.1 * bound) << order << " " << radius; }
    }
}

TEST(CloudSpline, the_order_is_the_least_that_is_good_enough)
{
  EXPECT_LE(3.0 * alias_error(longest_spline, least_convolved), convolution_error);
  int last = longest_spline;
  for (double radius = least_convolved; radius < 40.0; radius *= 1.1) {
    const int order = spline_order(radius);
    EXPECT_LE(order, last);
    EXPECT_LE(3.0 * alias_error(order, radius), convolution_error);
    if (order > 3) { EXPECT_GT(3.0 * alias_error(order - 1, radius), convolution_error); }
    last = order;
  }
  EXPECT_LE(last, 4);
}
