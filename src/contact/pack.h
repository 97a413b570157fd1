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

// ---- rows of numbers in memory, one row per contact, to Packs and back, by transposing registers

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

#define APF_SHUFFLE __builtin_shufflevector

// to[c] of lane l becomes row(l)[c]. row(l, c, Part()) gives as many numbers of the row as the Part
// has, from the c-th on.
template <int bytes, class Row> APF_INLINE void from_rows(Row row, Pack<bytes> (&to)[2])
{
  if constexpr (bytes == 16) {
    for (int p = 0; p < 2; p++) {
      const Pair a = row(2 * p, 0, Pair()), b = row(2 * p + 1, 0, Pair());
      to[0].part[p] = APF_SHUFFLE(a, b, 0, 2);
      to[1].part[p] = APF_SHUFFLE(a, b, 1, 3);
    }
  } else {
    constexpr int quads = bytes / 16;
    Quad even[quads], odd[quads];
    for (int q = 0; q < quads; q++) {
      const Pair a = row(4 * q, 0, Pair()), b = row(4 * q + 1, 0, Pair());
      const Pair c = row(4 * q + 2, 0, Pair()), d = row(4 * q + 3, 0, Pair());
      even[q] = APF_SHUFFLE(a, c, 0, 1, 2, 3);
      odd[q] = APF_SHUFFLE(b, d, 0, 1, 2, 3);
    }
    for (int p = 0; p < 2; p++) {
      if constexpr (bytes == 32) {
        to[0].part[p] = APF_SHUFFLE(even[p], odd[p], 0, 4, 2, 6);
        to[1].part[p] = APF_SHUFFLE(even[p], odd[p], 1, 5, 3, 7);
      } else {
        const auto e = APF_SHUFFLE(even[2 * p], even[2 * p + 1], 0, 1, 2, 3, 4, 5, 6, 7);
        const auto o = APF_SHUFFLE(odd[2 * p], odd[2 * p + 1], 0, 1, 2, 3, 4, 5, 6, 7);
        to[0].part[p] = APF_SHUFFLE(e, o, 0, 8, 2, 10, 4, 12, 6, 14);
        to[1].part[p] = APF_SHUFFLE(e, o, 1, 9, 3, 11, 5, 13, 7, 15);
      }
    }
  }
}

template <int bytes, class Row> APF_INLINE void from_rows(Row row, Pack<bytes> (&to)[4])
{
  if constexpr (bytes == 16) {
    for (int p = 0; p < 2; p++)
      for (int c = 0; c < 4; c += 2) {
        const Pair a = row(2 * p, c, Pair()), b = row(2 * p + 1, c, Pair());
        to[c].part[p] = APF_SHUFFLE(a, b, 0, 2);
        to[c + 1].part[p] = APF_SHUFFLE(a, b, 1, 3);
      }
  } else if constexpr (bytes == 32) {
    for (int p = 0; p < 2; p++) {
      const Quad a = row(4 * p, 0, Quad()), b = row(4 * p + 1, 0, Quad());
      const Quad c = row(4 * p + 2, 0, Quad()), d = row(4 * p + 3, 0, Quad());
      const Quad ab02 = APF_SHUFFLE(a, b, 0, 4, 2, 6), ab13 = APF_SHUFFLE(a, b, 1, 5, 3, 7);
      const Quad cd02 = APF_SHUFFLE(c, d, 0, 4, 2, 6), cd13 = APF_SHUFFLE(c, d, 1, 5, 3, 7);
      to[0].part[p] = APF_SHUFFLE(ab02, cd02, 0, 1, 4, 5);
      to[1].part[p] = APF_SHUFFLE(ab13, cd13, 0, 1, 4, 5);
      to[2].part[p] = APF_SHUFFLE(ab02, cd02, 2, 3, 6, 7);
      to[3].part[p] = APF_SHUFFLE(ab13, cd13, 2, 3, 6, 7);
    }
  } else {
    const auto two = [&row](int l) {
      const Quad low = row(l, 0, Quad()), high = row(l + 4, 0, Quad());
      return APF_SHUFFLE(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
    };
    for (int p = 0; p < 2; p++) {
      const auto a = two(8 * p), b = two(8 * p + 1), c = two(8 * p + 2), d = two(8 * p + 3);
      const auto ab02 = APF_SHUFFLE(a, b, 0, 8, 2, 10, 4, 12, 6, 14);
      const auto ab13 = APF_SHUFFLE(a, b, 1, 9, 3, 11, 5, 13, 7, 15);
      const auto cd02 = APF_SHUFFLE(c, d, 0, 8, 2, 10, 4, 12, 6, 14);
      const auto cd13 = APF_SHUFFLE(c, d, 1, 9, 3, 11, 5, 13, 7, 15);
      to[0].part[p] = APF_SHUFFLE(ab02, cd02, 0, 1, 8, 9, 4, 5, 12, 13);
      to[1].part[p] = APF_SHUFFLE(ab13, cd13, 0, 1, 8, 9, 4, 5, 12, 13);
      to[2].part[p] = APF_SHUFFLE(ab02, cd02, 2, 3, 10, 11, 6, 7, 14, 15);
      to[3].part[p] = APF_SHUFFLE(ab13, cd13, 2, 3, 10, 11, 6, 7, 14, 15);
    }
  }
}

// The other way: takes(l, c, part) is given numbers c, c + 1, .. of row l.
template <int bytes, class Takes>
APF_INLINE void to_rows(const Pack<bytes> &x, const Pack<bytes> &y, Takes takes)
{
  if constexpr (bytes == 16) {
    for (int p = 0; p < 2; p++) {
      takes(2 * p, 0, Pair(APF_SHUFFLE(x.part[p], y.part[p], 0, 2)));
      takes(2 * p + 1, 0, Pair(APF_SHUFFLE(x.part[p], y.part[p], 1, 3)));
    }
  } else if constexpr (bytes == 32) {
    for (int p = 0; p < 2; p++) {
      const Quad even = APF_SHUFFLE(x.part[p], y.part[p], 0, 4, 2, 6);
      const Quad odd = APF_SHUFFLE(x.part[p], y.part[p], 1, 5, 3, 7);
      takes(4 * p, 0, Pair(APF_SHUFFLE(even, even, 0, 1)));
      takes(4 * p + 1, 0, Pair(APF_SHUFFLE(odd, odd, 0, 1)));
      takes(4 * p + 2, 0, Pair(APF_SHUFFLE(even, even, 2, 3)));
      takes(4 * p + 3, 0, Pair(APF_SHUFFLE(odd, odd, 2, 3)));
    }
  } else {
    for (int p = 0; p < 2; p++) {
      const auto even = APF_SHUFFLE(x.part[p], y.part[p], 0, 8, 2, 10, 4, 12, 6, 14);
      const auto odd = APF_SHUFFLE(x.part[p], y.part[p], 1, 9, 3, 11, 5, 13, 7, 15);
      takes(8 * p, 0, Pair(APF_SHUFFLE(even, even, 0, 1)));
      takes(8 * p + 1, 0, Pair(APF_SHUFFLE(odd, odd, 0, 1)));
      takes(8 * p + 2, 0, Pair(APF_SHUFFLE(even, even, 2, 3)));
      takes(8 * p + 3, 0, Pair(APF_SHUFFLE(odd, odd, 2, 3)));
      takes(8 * p + 4, 0, Pair(APF_SHUFFLE(even, even, 4, 5)));
      takes(8 * p + 5, 0, Pair(APF_SHUFFLE(odd, odd, 4, 5)));
      takes(8 * p + 6, 0, Pair(APF_SHUFFLE(even, even, 6, 7)));
      takes(8 * p + 7, 0, Pair(APF_SHUFFLE(odd, odd, 6, 7)));
    }
  }
}

template <int bytes, class Takes>
APF_INLINE void to_rows(const Pack<bytes> &x, const Pack<bytes> &y, const Pack<bytes> &z,
                        const Pack<bytes> &w, Takes takes)
{
  if constexpr (bytes == 16) {
    to_rows(x, y, takes);
    to_rows(z, w, [&takes](int l, int, const Pair &part) {
      takes(l, 2, part);
    });
  } else if constexpr (bytes == 32) {
    for (int p = 0; p < 2; p++) {
      const Quad xy02 = APF_SHUFFLE(x.part[p], y.part[p], 0, 4, 2, 6);
      const Quad xy13 = APF_SHUFFLE(x.part[p], y.part[p], 1, 5, 3, 7);
      const Quad zw02 = APF_SHUFFLE(z.part[p], w.part[p], 0, 4, 2, 6);
      const Quad zw13 = APF_SHUFFLE(z.part[p], w.part[p], 1, 5, 3, 7);
      takes(4 * p, 0, Quad(APF_SHUFFLE(xy02, zw02, 0, 1, 4, 5)));
      takes(4 * p + 1, 0, Quad(APF_SHUFFLE(xy13, zw13, 0, 1, 4, 5)));
      takes(4 * p + 2, 0, Quad(APF_SHUFFLE(xy02, zw02, 2, 3, 6, 7)));
      takes(4 * p + 3, 0, Quad(APF_SHUFFLE(xy13, zw13, 2, 3, 6, 7)));
    }
  } else {
    const auto two = [&takes](int l, const auto &both) {
      takes(l, 0, Quad(APF_SHUFFLE(both, both, 0, 1, 2, 3)));
      takes(l + 4, 0, Quad(APF_SHUFFLE(both, both, 4, 5, 6, 7)));
    };
    for (int p = 0; p < 2; p++) {
      const auto xy02 = APF_SHUFFLE(x.part[p], y.part[p], 0, 8, 2, 10, 4, 12, 6, 14);
      const auto xy13 = APF_SHUFFLE(x.part[p], y.part[p], 1, 9, 3, 11, 5, 13, 7, 15);
      const auto zw02 = APF_SHUFFLE(z.part[p], w.part[p], 0, 8, 2, 10, 4, 12, 6, 14);
      const auto zw13 = APF_SHUFFLE(z.part[p], w.part[p], 1, 9, 3, 11, 5, 13, 7, 15);
      two(8 * p, APF_SHUFFLE(xy02, zw02, 0, 1, 8, 9, 4, 5, 12, 13));
      two(8 * p + 1, APF_SHUFFLE(xy13, zw13, 0, 1, 8, 9, 4, 5, 12, 13));
      two(8 * p + 2, APF_SHUFFLE(xy02, zw02, 2, 3, 10, 11, 6, 7, 14, 15));
      two(8 * p + 3, APF_SHUFFLE(xy13, zw13, 2, 3, 10, 11, 6, 7, 14, 15));
    }
  }
}

#undef APF_SHUFFLE

}    // namespace apf

#endif
