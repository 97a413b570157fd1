// Rows of numbers in memory, one row per contact, to Packs and back, by transposing registers.

#ifndef APF_PACK_ROWS_H
#define APF_PACK_ROWS_H

#include "pack.h"

namespace apf {

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
