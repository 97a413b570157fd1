// Exponential, logarithm and an angle's sine and cosine for doubles and for Packs of them, without
// branches: libm's would be called once for each particle. Relative error below 1e-14 where nothing
// else is said. An argument is brought near 0 by whole powers of 2, the rest is Taylor's series.
// J.-M. Muller, Elementary Functions, 3rd ed., Birkhaeuser 2016, doi:10.1007/978-1-4899-7983-4

#ifndef APF_ELEMENTARY_H
#define APF_ELEMENTARY_H

#include "../contact/pack.h"

#include <cstdint>

namespace apf {

namespace bits {
  // 1.5 * 2^52: a number added to it is rounded to a whole one, which then stands in the last bits
  constexpr double rounder = 6755399441055744.0;
  constexpr std::int64_t one = 0x3ff0000000000000;    // bits of 1.0, of 2^52 and of a fraction
  constexpr std::int64_t two52 = 0x4330000000000000;
  constexpr std::int64_t fraction = 0x000fffffffffffff;

  APF_INLINE std::uint64_t of(double a)
  {
    std::uint64_t b;
    std::memcpy(&b, &a, sizeof(b));
    return b;
  }
  APF_INLINE double number(std::uint64_t b)
  {
    double a;
    std::memcpy(&a, &b, sizeof(a));
    return a;
  }

  // The same for the bits of a double and for those of each number of a register.
  template <class Bits> APF_INLINE Bits power_bits(const Bits &b)
  {
    return (b << 52) + one;
  }
  template <class Bits> APF_INLINE Bits exponent_bits(const Bits &b)
  {
    return (b >> 52) | two52;
  }
  template <class Bits> APF_INLINE Bits mantissa_bits(const Bits &b)
  {
    return (b & fraction) | one;
  }

  // 2^n of a = rounder + n
  APF_INLINE double power_of_two(double a)
  {
    return number(power_bits(of(a)));
  }
  // e and m of a = m 2^e > 0, 1 <= m < 2
  APF_INLINE double exponent(double a)
  {
    return number(exponent_bits(of(a))) - (4503599627370496.0 + 1023.0);
  }
  APF_INLINE double mantissa(double a)
  {
    return number(mantissa_bits(of(a)));
  }

  template <int bytes> APF_INLINE Pack<bytes> power_of_two(const Pack<bytes> &a)
  {
    using P = Pack<bytes>;
    return P::each(
        [](typename P::Register x) {
          return (typename P::Register) power_bits((typename P::Bits) x);
        },
        a);
  }
  template <int bytes> APF_INLINE Pack<bytes> exponent(const Pack<bytes> &a)
  {
    using P = Pack<bytes>;
    return P::each(
        [](typename P::Register x) {
          return (typename P::Register) exponent_bits((typename P::Bits) x) -
              (4503599627370496.0 + 1023.0);
        },
        a);
  }
  template <int bytes> APF_INLINE Pack<bytes> mantissa(const Pack<bytes> &a)
  {
    using P = Pack<bytes>;
    return P::each(
        [](typename P::Register x) {
          return (typename P::Register) mantissa_bits((typename P::Bits) x);
        },
        a);
  }
}    // namespace bits

// coefficients from the highest power down
template <class Real, int n>
APF_INLINE Real polynomial(const double (&coefficients)[n], const Real &x)
{
  Real sum = coefficients[0];
  for (int k = 1; k < n; k++) sum = sum * x + coefficients[k];
  return sum;
}

namespace series {
  constexpr double exponential[] = {1.0 / 479001600, 1.0 / 39916800, 1.0 / 3628800, 1.0 / 362880,
                                    1.0 / 40320,     1.0 / 5040,     1.0 / 720,     1.0 / 120,
                                    1.0 / 24,        1.0 / 6,        1.0 / 2,       1.0};
  constexpr double logarithm[] = {2.0 / 19, 2.0 / 17, 2.0 / 15, 2.0 / 13, 2.0 / 11,
                                  2.0 / 9,  2.0 / 7,  2.0 / 5,  2.0 / 3,  2.0};
  constexpr double sine[] = {1.0 / 355687428096000,
                             -1.0 / 1307674368000,
                             1.0 / 6227020800,
                             -1.0 / 39916800,
                             1.0 / 362880,
                             -1.0 / 5040,
                             1.0 / 120,
                             -1.0 / 6,
                             1.0};
  constexpr double cosine[] = {1.0 / 20922789888000,
                               -1.0 / 87178291200,
                               1.0 / 479001600,
                               -1.0 / 3628800,
                               1.0 / 40320,
                               -1.0 / 720,
                               1.0 / 24,
                               -1.0 / 2,
                               1.0};
}    // namespace series

// exp(x) - 1, also of small x; x below -708 counts as -708, above 709 as 709
template <class Real> APF_INLINE Real exponential_less_one(const Real &x)
{
  const Real within = smaller(larger(x, -708.0), 709.0);
  const Real shifted = within * 1.4426950408889634 + bits::rounder;
  const Real n = shifted - bits::rounder;
  const Real rest = (within - n * 0.693145751953125) - n * 1.42860682030941723212e-6;
  const Real power = bits::power_of_two(shifted);
  return power * (rest * polynomial(series::exponential, rest)) + (power - 1.0);
}
template <class Real> APF_INLINE Real exponential(const Real &x)
{
  return exponential_less_one(x) + 1.0;    // absolute error 1e-16 where the result is below 1
}

// natural logarithm of x >= 1e-300; error 1e-15 of the larger of 1 and the result
template <class Real> APF_INLINE Real logarithm(const Real &x)
{
  const Real m = bits::mantissa(x);
  const auto upper = Real(1.4142135623730951) < m;
  const Real near = select(upper, 0.5 * m, m);
  const Real e = bits::exponent(x) + select(upper, Real(1.0), Real(0.0));
  const Real s = (near - 1.0) / (near + 1.0);
  return e * 0.6931471805599453 + s * polynomial(series::logarithm, s * s);
}

// cos and sin of 2 pi u, |u| <= 1/2, by those of half the angle; error 1e-12
template <class Real> APF_INLINE void on_circle(const Real &u, Real &cosine, Real &sine)
{
  const Real half = pi * u, square = half * half;
  const Real s = half * polynomial(series::sine, square);
  const Real c = polynomial(series::cosine, square);
  cosine = 1.0 - 2.0 * s * s;
  sine = 2.0 * s * c;
}

}    // namespace apf

#endif
