// Chooses the build of the kernel for the processor it runs on: one binary is fast everywhere.

#include "contact_kernel.h"

#include <cstdlib>
#include <iostream>
#include <string>

namespace apf {

namespace baseline {
  ContactKernel contact_kernel(const KernelChoice &choice);
}
namespace avx2 {
  ContactKernel contact_kernel(const KernelChoice &choice);
}
namespace avx512 {
  ContactKernel contact_kernel(const KernelChoice &choice);
}

const std::vector<KernelBuild> &kernel_builds()
{
  static const std::vector<KernelBuild> builds = [] {
    std::vector<KernelBuild> list{{"baseline", baseline::contact_kernel}};
#ifdef APF_X86
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) {
      list.push_back({"avx2", avx2::contact_kernel});
      if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
          __builtin_cpu_supports("avx512vl"))
        list.push_back({"avx512", avx512::contact_kernel});
    }
#endif
    return list;
  }();
  return builds;
}

static const KernelBuild &chosen_build()
{
  const auto &builds = kernel_builds();
  const char *wanted = std::getenv("APF_ISA");
  if (!wanted) return builds.back();
  for (const auto &build : builds)
    if (std::string(wanted) == build.name) return build;
  std::cerr << "APF: environment variable APF_ISA=" << wanted
            << " names no instruction set of this processor and build; taking "
            << builds.back().name << " of";
  for (const auto &build : builds) std::cerr << " " << build.name;
  std::cerr << std::endl;
  return builds.back();
}

ContactKernel contact_kernel(const KernelChoice &choice)
{
  static const KernelBuild &build = chosen_build();
  return build.kernel(choice);
}

}    // namespace apf
