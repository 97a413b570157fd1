// A hash of words of up to 64 bits, to see whether numbers are the same as before.

#ifndef APF_WORD_HASH_H
#define APF_WORD_HASH_H

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace apf {

class WordHash {
 public:
  explicit WordHash(std::uint64_t first = 0) { mix(first); }
  template <class T> WordHash &add(const T *values, std::size_t n)
  {
    for (std::size_t i = 0; i < n; i++) {
      std::uint64_t word = 0;
      std::memcpy(&word, &values[i], sizeof(T));
      mix(word);
    }
    return *this;
  }
  std::uint64_t value() const { return now; }
  bool operator==(const WordHash &other) const { return now == other.now; }

 private:
  std::uint64_t now = 1;

  // Products carry differences upwards only, and doubles may differ in their exponents alone, which
  // stand on top: the shift takes them down again.
  void mix(std::uint64_t word)
  {
    now = (now ^ word) * 0x9E3779B97F4A7C15ull;
    now ^= now >> 32;
  }
};

}    // namespace apf

#endif
