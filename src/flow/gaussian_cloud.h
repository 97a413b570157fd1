// A particle's volume smeared out to a cloud, IIHR Report 459, eqs (13), (14):
//   c(x) = sum over particles of V f(x - x_n),  f(r) = exp(-|r|^2/R^2) / (pi^(3/2) R^3)
// f is a product of one factor for each axis. A cell from a to b gets the mean of f, along one axis
//   w = [erf((b - x_n)/R) - erf((a - x_n)/R)] / 2.
// Beyond `cloud_reach` R the cloud is cut off: erfc(4) = 1.5e-8 of it lies there, on each axis.
// Weights are divided by their sum, so that they add up to 1 to the last bits, and what would lie
// beyond a closed border comes back inside.

#ifndef APF_GAUSSIAN_CLOUD_H
#define APF_GAUSSIAN_CLOUD_H

#include <algorithm>
#include <cmath>
#include <vector>

namespace apf {

constexpr double cloud_reach = 4.0;

// cells beyond that of the particle that its cloud reaches
inline int cloud_cells(double radius, double spacing)
{
  return static_cast<int>(std::min(std::ceil(cloud_reach * radius / spacing), 1.0e8));
}

// Weights along one axis: of cells first, first + 1, ...
struct CloudWeights {
  int first = 0;
  std::vector<double> w;

  // at: position of the particle, in cells; radius: R over the spacing; cells from lowest to
  // highest are there to take the cloud
  void set(double at, double radius, int lowest, int highest)
  {
    const int cell = static_cast<int>(std::floor(at)), reach = cloud_cells(radius, 1.0);
    first = std::max(cell - reach, lowest);
    const int count = std::min(cell + reach, highest) - first + 1;
    w.resize(std::max(count, 0));
    double below = std::erf((first - at) / radius), sum = 0.0;
    for (size_t k = 0; k < w.size(); k++) {
      const double above = std::erf((first + static_cast<double>(k) + 1.0 - at) / radius);
      w[k] = 0.5 * (above - below);
      sum += w[k];
      below = above;
    }
    for (double &weight : w) weight /= sum;
  }
};

}    // namespace apf

#endif
