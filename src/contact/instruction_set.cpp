#include "instruction_set.h"

#include <cstdlib>
#include <iostream>

namespace apf {

bool can_run(const std::string &name)
{
#ifdef APF_X86
  const bool avx2 = __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
  if (name == "avx2") return avx2;
  if (name == "avx512")
    return avx2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
        __builtin_cpu_supports("avx512vl");
#endif
  return name == "baseline";
}

static std::string choose()
{
  std::string all, best;
  for (const char *name : {"baseline", "avx2", "avx512"}) {
    if (!can_run(name)) continue;
    best = name;
    all += " " + best;
  }
  const char *wanted = std::getenv("APF_ISA");
  if (!wanted) return best;
  if (can_run(wanted)) return wanted;
  std::cerr << "APF: environment variable APF_ISA=" << wanted
            << " names no instruction set of this processor and build; taking " << best << " of"
            << all << std::endl;
  return best;
}

const std::string &chosen_instruction_set()
{
  static const std::string name = choose();
  return name;
}

}    // namespace apf
