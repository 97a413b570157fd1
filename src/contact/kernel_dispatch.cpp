// The builds of the contact kernel, of the grid's sampler and of the forces of the fluid.

#include "../flow/fluid_forces.h"
#include "../flow/grid_flow.h"
#include "contact_kernel.h"
#include "instruction_set.h"

namespace apf {

#define APF_DECLARE(isa)                                                          \
  namespace isa {                                                                 \
    ContactKernel contact_kernel(const KernelChoice &choice);                     \
    bool sample_grid(const GridView &, const PointBlock &, Detail, FluidBlock &); \
    void fluid_forces(const FluidModel &, const FluidBlock &, ForceBlock &);      \
  }
APF_DECLARE(baseline)
#ifdef APF_X86
APF_DECLARE(avx2)
APF_DECLARE(avx512)
#endif

const std::vector<KernelBuild> &kernel_builds()
{
  static const auto builds = runnable<KernelBuild>({
      {"baseline", baseline::contact_kernel},
#ifdef APF_X86
      {"avx2", avx2::contact_kernel},
      {"avx512", avx512::contact_kernel},
#endif
  });
  return builds;
}

ContactKernel contact_kernel(const KernelChoice &choice)
{
  static const KernelBuild &build = chosen(kernel_builds());
  return build.kernel(choice);
}

const std::vector<GridSamplerBuild> &grid_sampler_builds()
{
  static const auto builds = runnable<GridSamplerBuild>({
      {"baseline", baseline::sample_grid},
#ifdef APF_X86
      {"avx2", avx2::sample_grid},
      {"avx512", avx512::sample_grid},
#endif
  });
  return builds;
}

GridSampler grid_sampler()
{
  static const GridSamplerBuild &build = chosen(grid_sampler_builds());
  return build.sampler;
}

const std::vector<FluidForcesBuild> &fluid_forces_builds()
{
  static const auto builds = runnable<FluidForcesBuild>({
      {"baseline", baseline::fluid_forces},
#ifdef APF_X86
      {"avx2", avx2::fluid_forces},
      {"avx512", avx512::fluid_forces},
#endif
  });
  return builds;
}

FluidForces fluid_forces()
{
  static const FluidForcesBuild &build = chosen(fluid_forces_builds());
  return build.forces;
}

}    // namespace apf
