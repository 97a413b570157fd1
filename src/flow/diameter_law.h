// Diameters of particles that enter, by number: one, uniform, lognormal or a list.
//
// lognormal: ln d is normal about ln median with standard deviation ln GSD, cut at a and b. Moments
//   <d^k> = median^k exp(k^2 s^2 / 2) [Phi(z_b - k s) - Phi(z_a - k s)] / [Phi(z_b) - Phi(z_a)]
// with s = ln GSD, z = ln(d / median) / s (Hatch and Choate, J. Franklin Inst. 207 (1929) 369,
// https://doi.org/10.1016/S0016-0032(29)91451-4; the cut follows from completing the square).

#ifndef APF_DIAMETER_LAW_H
#define APF_DIAMETER_LAW_H

#include <algorithm>
#include <cmath>
#include <variant>
#include <vector>

namespace apf {

// Each law has smallest(), largest(), moment(k) = <d^k>, and draw(uniform), where uniform() returns
// numbers between 0 and 1, ends excluded.

struct OneDiameter {
  double d;    // [length]

  double smallest() const { return d; }
  double largest() const { return d; }
  double moment(int k) const { return std::pow(d, k); }
  template <class Uniform> double draw(Uniform &&) const { return d; }
};

struct UniformDiameters {
  double lo, hi;    // [length], lo < hi

  double smallest() const { return lo; }
  double largest() const { return hi; }
  double moment(int k) const
  {
    return (std::pow(hi, k + 1) - std::pow(lo, k + 1)) / ((k + 1) * (hi - lo));
  }
  template <class Uniform> double draw(Uniform &&uniform) const
  {
    return lo + uniform() * (hi - lo);
  }
};

struct LognormalDiameters {
  double median;    // by number                                  [length]
  double gsd;       // geometric standard deviation, > 1               [-]
  double lo, hi;    // where it is cut, lo < hi                   [length]

  double smallest() const { return lo; }
  double largest() const { return hi; }
  double moment(int k) const
  {
    const double s = std::log(gsd);
    return std::pow(median, k) * std::exp(0.5 * k * k * s * s) * part(k * s) / part(0.0);
  }
  template <class Uniform> double draw(Uniform &&uniform) const
  {
    for (;;) {    // Box and Muller, one of the two
      const double r = std::sqrt(-2.0 * std::log(uniform()));
      const double d = median * std::pow(gsd, r * std::cos(6.283185307179586 * uniform()));
      if (d >= lo && d <= hi) return d;
    }
  }
  // of the uncut law that lies between the cuts
  double kept() const { return part(0.0); }

 private:
  double part(double shift) const
  {
    auto phi = [&](double d) {
      return 0.5 * std::erfc(-(std::log(d / median) / std::log(gsd) - shift) / std::sqrt(2.0));
    };
    return phi(hi) - phi(lo);
  }
};

struct ListedDiameters {
  std::vector<double> d;           // [length]
  std::vector<double> fraction;    // by number, sum 1    [-]

  double smallest() const { return *std::min_element(d.begin(), d.end()); }
  double largest() const { return *std::max_element(d.begin(), d.end()); }
  double moment(int k) const
  {
    double sum = 0.0;
    for (size_t n = 0; n < d.size(); n++) sum += fraction[n] * std::pow(d[n], k);
    return sum;
  }
  template <class Uniform> double draw(Uniform &&uniform) const
  {
    double left = uniform();
    size_t n = 0;
    while (n + 1 < d.size() && left >= fraction[n]) left -= fraction[n++];
    return d[n];
  }
  // fractions may be of any sum; those by volume become those by number
  static ListedDiameters of(std::vector<double> d, std::vector<double> fraction, bool by_volume)
  {
    double sum = 0.0;
    for (size_t n = 0; n < d.size(); n++) {
      if (by_volume) fraction[n] /= d[n] * d[n] * d[n];
      sum += fraction[n];
    }
    for (auto &f : fraction) f /= sum;
    return {std::move(d), std::move(fraction)};
  }
};

using DiameterLaw =
    std::variant<OneDiameter, UniformDiameters, LognormalDiameters, ListedDiameters>;

}    // namespace apf

#endif
