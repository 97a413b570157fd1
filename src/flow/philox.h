// Random numbers that are a function of seed, particle and step, so that they do not depend on who
// owns the particle: generator Philox 4x32-10 of J. K. Salmon, M. A. Moraes, R. O. Dror,
// D. E. Shaw, SC'11, doi:10.1145/2063384.2063405, and pairs of normal numbers by G. E. P. Box,
// M. E. Muller, Ann. Math. Stat. 29, 610 (1958), doi:10.1214/aoms/1177706645.

#ifndef APF_PHILOX_H
#define APF_PHILOX_H

#include "elementary.h"

#include <cstdint>

namespace apf {

// word[w][lane] of `width` counters at once, and their ciphers in place. Words are 32 bits.
template <int width>
inline void philox(std::uint64_t (&word)[4][width], std::uint32_t key0, std::uint32_t key1)
{
  constexpr std::uint64_t low = 0xffffffff;
  for (int round = 0; round < 10; round++) {
    for (int l = 0; l < width; l++) {
      const std::uint64_t a = 0xD2511F53ul * word[0][l], b = 0xCD9E8D57ul * word[2][l];
      word[0][l] = (b >> 32) ^ word[1][l] ^ key0;
      word[2][l] = (a >> 32) ^ word[3][l] ^ key1;
      word[1][l] = b & low;
      word[3][l] = a & low;
    }
    key0 += 0x9E3779B9u;
    key1 += 0xBB67AE85u;
  }
}

// Two independent normal numbers of mean 0 and variance 1 from two of 32 bits, given as doubles.
template <class Real> APF_INLINE void normal_pair(const Real &a, const Real &b, Real &x, Real &y)
{
  using std::sqrt;
  constexpr double unit = 1.0 / 4294967296.0;
  const Real r = sqrt(-2.0 * logarithm((a + 0.5) * unit));
  on_circle((b + 0.5) * unit - 0.5, x, y);
  x = r * x;
  y = r * y;
}

}    // namespace apf

#endif
