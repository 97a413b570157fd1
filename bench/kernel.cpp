// What a contact costs in the kernel alone, by composition of sub-models, dimension and instruction
// set; `scalar` is the law taken contact by contact. Time is per pass over all contacts of the scene,
// per_contact that of one contact. Results: kernel.md.

#include "../unittest/core/scalar_kernel.h"
#include "flakes.h"

#include <benchmark/benchmark.h>
#include <string>

using namespace apf;
using namespace apf_bench;

namespace {

void pass(benchmark::State &state, ContactKernel (*kernel_of)(const KernelChoice &), bool planar,
          int composition, double spread)
{
  Flakes flakes(planar, composition, spread);
  const ContactKernel kernel = kernel_of(flakes.choice);
  for (auto _ : state) benchmark::DoNotOptimize(flakes.step(kernel));
  state.counters["per_contact"] = benchmark::Counter(flakes.list.size(),
                                                     benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

}    // namespace

int main(int argc, char **argv)
{
  std::vector<KernelBuild> builds = kernel_builds();
  builds.insert(builds.begin(), {"scalar", apf_test::scalar_kernel});
  for (const bool planar : {true, false})
    for (int composition = 0; composition < n_compositions; composition++) {
      const std::string name = compositions[composition];
      if (planar && name == "twisting") continue;    // there is none in the plane
      for (const auto &build : builds)
        for (const double spread : {0.0, 0.1}) {
          if (spread > 0.0 && composition + 1 < n_compositions) continue;
          const std::string title = std::string(planar ? "2D/" : "3D/") + name +
              (spread > 0.0 ? "/polydisperse/" : "/") + build.name;
          benchmark::RegisterBenchmark(title.c_str(), pass, build.kernel, planar, composition,
                                       spread)
              ->MinTime(0.05)
              ->Repetitions(9)
              ->ReportAggregatesOnly()
              ->Unit(benchmark::kMicrosecond);
        }
    }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
