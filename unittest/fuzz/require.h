// What a fuzzer demands; a failure stops it, and libFuzzer keeps the input.

#ifndef APF_FUZZ_REQUIRE_H
#define APF_FUZZ_REQUIRE_H

#include <cstdio>
#include <cstdlib>
#include <string>

namespace fuzz {

inline void require(bool fact, const char *what)
{
  if (fact) return;
  std::fprintf(stderr, "ERROR: not so: %s\n", what);
  std::abort();
}

// How many inputs there were and how many of them were right, said at the end: a fuzzer whose
// inputs are all refused at the door tests nothing, and unittest/fuzz/run does not let it pass.
class Tally {
 public:
  ~Tally()
  {
    if (inputs) std::fprintf(stderr, "inputs accepted: %lu of %lu\n", accepted, inputs);
  }
  void count(bool is_right)
  {
    inputs++;
    accepted += is_right;
  }

 private:
  unsigned long inputs = 0, accepted = 0;
};
inline Tally tally;

// A refusal says what is wrong: it names one of the things that may be wrong, in plain characters.
inline void require_reason(const std::string &text,
                           const std::initializer_list<const char *> &names)
{
  bool named = false;
  for (const char *name : names) named = named || text.find(name) != std::string::npos;
  if (!named) std::fprintf(stderr, "message: %s\n", text.c_str());
  require(named, "the message names what is wrong");
}

}    // namespace fuzz

#endif
