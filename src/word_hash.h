// The hash FNV-1a, of words instead of bytes, whose high bits are mixed into the low ones: doubles
// that differ in their exponents only would leave nearly all bits alike.

#ifndef APF_WORD_HASH_H
#define APF_WORD_HASH_H

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace LAMMPS_NS {

class WordHash {
 public:
  explicit WordHash(std::uint64_t first = 0) : now(first * prime) {}
  template <class T> WordHash &add(const T *values, std::size_t n)
  {
    for (std::size_t i = 0; i < n; i++) {
      std::uint64_t word = 0;
      std::memcpy(&word, &values[i], sizeof(T));
      now = (now ^ word) * prime;
      now ^= now >> 32;
    }
    return *this;
  }
  std::uint64_t value() const { return now; }
  bool operator==(const WordHash &other) const { return now == other.now; }

 private:
  static constexpr std::uint64_t prime = 0x100000001b3;
  std::uint64_t now;
};

}    // namespace LAMMPS_NS

#endif
