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
