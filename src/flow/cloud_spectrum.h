// Clouds by convolution. A particle's volume is first shared out among the cells around it by a
// B-spline M_p of order p, as wide as p cells: with Fourier transform sinc^p(k h/2) for cells of
// width h. Multiplied in Fourier space by
//   exp(-k^2 R^2/4) / sinc^(p-1)(k h/2),   sinc(q) = sin(q)/q,
// it becomes the cloud's mean over each cell, exp(-k^2 R^2/4) sinc(k h/2): what the spline smeared
// out is taken back. What remains is that the grid takes waves beyond its shortest one for longer
// ones; `alias_error` bounds that. B-splines as in smooth particle mesh Ewald: Essmann et al.,
// J. Chem. Phys. 103, 8577 (1995), doi:10.1063/1.470117.
// Lengths are in cells: radius = R/h, wave = k h.

#ifndef APF_CLOUD_SPECTRUM_H
#define APF_CLOUD_SPECTRUM_H

#include "../contact/vector.h"

#include <cmath>

namespace apf {

constexpr int longest_spline = 12;
constexpr double convolution_error = 1e-6;    // of the peak of a cloud in space, at most
constexpr double least_convolved = 2.6;       // radius that a cloud must have for it

// Weights of an order's spline about a point, for cells from the one returned; their sum is 1.
inline int spline_weights(int order, double at, double *w)
{
  const double start = at - 0.5 - 0.5 * order, lowest = std::floor(start);
  const double f = start - lowest;
  w[0] = 1.0;
  for (int n = 2; n <= order; n++) {
    const double share = 1.0 / (n - 1);
    w[n - 1] = share * f * w[n - 2];
    for (int l = n - 2; l > 0; l--)
      w[l] = share * ((f + n - 1 - l) * w[l - 1] + (l + 1 - f) * w[l]);
    w[0] *= share * (1.0 - f);
  }
  return static_cast<int>(lowest) + 1;
}

inline double sinc(double q)
{
  return std::fabs(q) < 1e-8 ? 1.0 : std::sin(q) / q;
}

inline double cloud_spectrum(int order, double radius, double wave)
{
  return std::exp(-0.25 * wave * wave * radius * radius) / std::pow(sinc(0.5 * wave), order - 1);
}

// Largest error along one axis, over the peak of the cloud: waves that the grid mistakes, of the
// spline and of the cloud itself.
inline double alias_error(int order, double radius)
{
  constexpr int samples = 200;
  double wrong = 0.0, peak = 0.0;
  for (int s = 0; s < 3 * samples; s++) {
    const double k = pi * (s + 0.5) / samples;
    const double cloud = std::exp(-0.25 * k * k * radius * radius) * std::fabs(sinc(0.5 * k));
    if (k > pi) {
      wrong += cloud;
      continue;
    }
    peak += cloud;
    for (int m = 1; m <= 3; m++)
      wrong += cloud *
          (std::pow(k / (2.0 * pi * m - k), order) + std::pow(k / (2.0 * pi * m + k), order));
  }
  return wrong / peak;
}

// the shortest spline that is good enough, for a radius >= least_convolved
inline int spline_order(double radius)
{
  int order = 3;
  while (order < longest_spline && 3.0 * alias_error(order, radius) > convolution_error) order++;
  return order;
}

}    // namespace apf

#endif
