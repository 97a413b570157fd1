// The builds of the kernels of contacts and bridges, of the grid's sampler, of the forces of the
// fluid and of copies between rows and lanes.

#include "../flow/fluid_forces.h"
#include "../flow/grid_flow.h"
#include "../flow/lane_rows.h"
#include "bridge_kernel.h"
#include "contact_kernel.h"
#include "instruction_set.h"

namespace apf {

#define APF_DECLARE(isa)                                                          \
  namespace isa {                                                                 \
    ContactKernel contact_kernel(const KernelChoice &choice);                     \
    BridgeKernel bridge_kernel(const BridgeChoice &choice);                       \
    bool sample_grid(const GridView &, const PointBlock &, Detail, FluidBlock &); \
    void fluid_forces(const FluidModel &, const FluidBlock &, ForceBlock &);      \
    extern const LaneRows lane_row_functions;                                     \
  }
APF_DECLARE(baseline)
// clang-format off
#ifdef APF_X86
APF_DECLARE(avx2)
APF_DECLARE(avx512)
#define APF_BUILDS(what) \
  {"baseline", baseline::what}, {"avx2", avx2::what}, {"avx512", avx512::what}
#else
#define APF_BUILDS(what) {"baseline", baseline::what}
#endif
// clang-format on

const std::vector<KernelBuild> &kernel_builds()
{
  static const auto builds = runnable<KernelBuild>({APF_BUILDS(contact_kernel)});
  return builds;
}

ContactKernel contact_kernel(const KernelChoice &choice)
{
  static const KernelBuild &build = chosen(kernel_builds());
  return build.kernel(choice);
}

const std::vector<BridgeBuild> &bridge_builds()
{
  static const auto builds = runnable<BridgeBuild>({APF_BUILDS(bridge_kernel)});
  return builds;
}

BridgeKernel bridge_kernel(const BridgeChoice &choice)
{
  static const BridgeBuild &build = chosen(bridge_builds());
  return build.kernel(choice);
}

const std::vector<GridSamplerBuild> &grid_sampler_builds()
{
  static const auto builds = runnable<GridSamplerBuild>({APF_BUILDS(sample_grid)});
  return builds;
}

GridSampler grid_sampler()
{
  static const GridSamplerBuild &build = chosen(grid_sampler_builds());
  return build.sampler;
}

const std::vector<FluidForcesBuild> &fluid_forces_builds()
{
  static const auto builds = runnable<FluidForcesBuild>({APF_BUILDS(fluid_forces)});
  return builds;
}

FluidForces fluid_forces()
{
  static const FluidForcesBuild &build = chosen(fluid_forces_builds());
  return build.forces;
}

const std::vector<LaneRowsBuild> &lane_rows_builds()
{
  static const auto builds = runnable<LaneRowsBuild>({APF_BUILDS(lane_row_functions)});
  return builds;
}

LaneRows lane_rows()
{
  static const LaneRowsBuild &build = chosen(lane_rows_builds());
  return build.functions;
}

}    // namespace apf
