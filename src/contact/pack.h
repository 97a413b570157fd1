// Several numbers, one of each contact of a group, in two vector registers: sixteen of AVX-512,
// eight of AVX2, four of SSE2 or NEON. One register would leave the processor waiting for roots and
// divisions, and there are not enough for more. A Pack answers to the operations of a double that
// laws use, so a law is written once. Made of the vector extensions of GCC and Clang, without
// intrinsics but for two estimates of AVX-512.

#ifndef APF_PACK_H
#define APF_PACK_H

#include "vector.h"

#include <cstring>

// of the widest vector registers that this file is compiled for
#if defined(__AVX512F__)
#define APF_REGISTER_BYTES 64
#elif defined(__AVX2__)
#define APF_REGISTER_BYTES 32
#else
#define APF_REGISTER_BYTES 16
#endif

namespace apf {

using Pair = double __attribute__((vector_size(16)));
using Quad = double __attribute__((vector_size(32)));
using Octet = double __attribute__((vector_size(64)));

template <int bytes> struct RegisterOf {
  using Type = Pair;
};
template <> struct RegisterOf<32> {
  using Type = Quad;
};
template <> struct RegisterOf<64> {
  using Type = Octet;
};

// bytes: of a register
template <int bytes> struct Pack {
  using Register = typename RegisterOf<bytes>::Type;
  using Bits = decltype(Register{} < Register{});
  static constexpr int lanes = bytes / sizeof(double), n = 2, width = n * lanes;
  struct Mask {
    Bits part[n];
  };

  Register part[n];

  Pack() = default;
  APF_INLINE Pack(double a)
  {
    for (auto &p : part) p = a - Register{};
  }
  static APF_INLINE Pack load(const double *from)
  {
    Pack a;
    for (int p = 0; p < n; p++) std::memcpy(&a.part[p], from + p * lanes, bytes);
    return a;
  }
  APF_INLINE void store(double *to) const
  {
    for (int p = 0; p < n; p++) std::memcpy(to + p * lanes, &part[p], bytes);
  }
  APF_INLINE double lane(int l) const { return part[l / lanes][l % lanes]; }
  APF_INLINE void set_lane(int l, double a) { part[l / lanes][l % lanes] = a; }

  // each register of the result from those of the operands
  template <class Result = Pack, class Operation, class... Operands>
  static APF_INLINE Result each(Operation operation, const Operands &...a)
  {
    Result r;
    for (int p = 0; p < n; p++) r.part[p] = operation(a.part[p]...);
    return r;
  }

  friend APF_INLINE Pack operator+(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x + y;
        },
        a, b);
  }
  friend APF_INLINE Pack operator-(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x - y;
        },
        a, b);
  }
  friend APF_INLINE Pack operator*(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x * y;
        },
        a, b);
  }
  friend APF_INLINE Pack operator/(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x / y;
        },
        a, b);
  }
  friend APF_INLINE Pack operator-(const Pack &a)
  {
    return each(
        [](Register x) {
          return -x;
        },
        a);
  }
  friend APF_INLINE Mask operator<(const Pack &a, const Pack &b)
  {
    return each<Mask>(
        [](Register x, Register y) {
          return x < y;
        },
        a, b);
  }
  // whether the mask is set anywhere
  friend APF_INLINE bool any(const Mask &mask)
  {
    Bits all = mask.part[0];
    for (int p = 1; p < n; p++) all |= mask.part[p];
    decltype(all[0] | all[0]) sum = 0;
    for (int l = 0; l < lanes; l++) sum |= all[l];
    return sum != 0;
  }
  friend APF_INLINE Pack smaller(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x < y ? x : y;
        },
        a, b);
  }
  friend APF_INLINE Pack larger(const Pack &a, const Pack &b)
  {
    return each(
        [](Register x, Register y) {
          return x > y ? x : y;
        },
        a, b);
  }
  friend APF_INLINE Pack magnitude(const Pack &a)
  {
    return each(
        [](Register x) {
          return Register(Bits(x) & 0x7fffffffffffffff);
        },
        a);
  }
  friend APF_INLINE Pack norm2(const Pack &a) { return a * a; }
  friend APF_INLINE Pack select(const Mask &mask, const Pack &a, const Pack &b)
  {
    return each(
        [](Bits m, Register x, Register y) {
          return m ? x : y;
        },
        mask, a, b);
  }
};

template <int bytes> APF_INLINE Pack<bytes> sqrt(const Pack<bytes> &a)
{
  return Pack<bytes>::each(
      [](typename Pack<bytes>::Register x) {
        for (int l = 0; l < Pack<bytes>::lanes; l++) x[l] = std::sqrt(x[l]);
        return x;
      },
      a);
}
template <int bytes> APF_INLINE Pack<bytes> rough_root(const Pack<bytes> &a)
{
  return sqrt(a);
}
template <int bytes> APF_INLINE Pack<bytes> inverse(const Pack<bytes> &a)
{
  return 1.0 / a;
}
template <int bytes> APF_INLINE Pack<bytes> rough_inverse(const Pack<bytes> &a)
{
  return 1.0 / a;
}
template <int bytes> APF_INLINE Pack<bytes> close_inverse(const Pack<bytes> &a)
{
  return 1.0 / a;
}
template <int bytes> APF_INLINE Pack<bytes> inverse_root(const Pack<bytes> &a)
{
  return 1.0 / sqrt(a);
}

#ifdef __AVX512F__
// AVX-512 estimates 1/a and 1/sqrt(a) to 14 bits, and each Newton step doubles them: several times
// quicker than its divisions and roots. For normal numbers a > 0 (an inverse: a != 0).
APF_INLINE Octet estimate_inverse(const Octet &a)
{
  return __builtin_ia32_rcp14pd512_mask(a, Octet{}, 255);
}
APF_INLINE Octet estimate_inverse_root(const Octet &a)
{
  return __builtin_ia32_rsqrt14pd512_mask(a, Octet{}, 255);
}

APF_INLINE Pack<64> rough_inverse(const Pack<64> &a)
{
  return Pack<64>::each(estimate_inverse, a);
}
APF_INLINE Pack<64> rough_root(const Pack<64> &a)
{
  return Pack<64>::each(
      [](Octet x) {
        return x * estimate_inverse_root(x);
      },
      a);
}
APF_INLINE Pack<64> close_inverse(const Pack<64> &a)
{
  return Pack<64>::each(
      [](Octet x) {
        const Octet y = estimate_inverse(x), error = 1.0 - x * y;
        return y + y * (error + error * error);    // leaves the cube of the error
      },
      a);
}
APF_INLINE Pack<64> inverse(const Pack<64> &a)
{
  return Pack<64>::each(
      [](Octet x) {
        Octet y = estimate_inverse(x);
        for (int step = 0; step < 2; step++) y = y + y * (1.0 - x * y);
        return y;
      },
      a);
}
APF_INLINE Pack<64> sqrt(const Pack<64> &a)
{
  return Pack<64>::each(
      [](Octet x) {
        const Octet y = estimate_inverse_root(x);
        Octet root = x * y, half = 0.5 * y;    // root half -> 1/2
        const Octet error = 0.5 - root * half;
        root = root + root * error;
        half = half + half * error;
        return root + half * (x - root * root);
      },
      a);
}

APF_INLINE Pack<64> inverse_root(const Pack<64> &a)
{
  return Pack<64>::each(
      [](Octet x) {
        Octet y = estimate_inverse_root(x);
        for (int step = 0; step < 2; step++) y = y + y * (0.5 - 0.5 * x * y * y);
        return y;
      },
      a);
}

#endif

// a register from numbers in memory, and onto these
template <class Part> APF_INLINE Part load(const double *from)
{
  Part part;
  std::memcpy(&part, from, sizeof(part));
  return part;
}
template <class Part> APF_INLINE void add_to(double *to, const Part &part)
{
  const Part sum = load<Part>(to) + part;
  std::memcpy(to, &sum, sizeof(sum));
}

}    // namespace apf

#endif
