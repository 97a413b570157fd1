// Bytes of a fuzzer as choices: 0, and what is beyond the last byte, is always the right one. So
// the empty input builds a right file, and bytes that differ from 0 spoil something.

#ifndef APF_FUZZ_CHOICES_H
#define APF_FUZZ_CHOICES_H

#include <cstddef>
#include <iterator>

namespace fuzz {

class Choices {
 public:
  Choices(const unsigned char *bytes, std::size_t count) : at(bytes), end(bytes + count) {}

  unsigned next() { return at < end ? *at++ : 0; }
  // the first of some alternatives for 0 and for half of all other bytes
  template <class T, std::size_t N> T of(const T (&alternatives)[N])
  {
    const unsigned choice = next();
    return alternatives[choice < 128 ? 0 : choice % N];
  }
  template <class T> T of(const T &right, std::initializer_list<T> wrong)
  {
    const unsigned choice = next();
    if (choice < 128) return right;
    return *(wrong.begin() + choice % wrong.size());
  }
  bool spoil() { return next() > 200; }

 private:
  const unsigned char *at, *end;
};

}    // namespace fuzz

#endif
