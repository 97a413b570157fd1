// Chooses the build of the kernel for the processor it runs on: one binary is fast everywhere.
// AVX-512 is left out: measured no faster than AVX2.

#include "contact_kernel.h"

namespace apf {

ContactKernel contact_kernel(const KernelChoice &choice)
{
#ifdef APF_HAS_AVX2
  if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma"))
    return avx2::contact_kernel(choice);
#endif
  return baseline::contact_kernel(choice);
}

}    // namespace apf
