// What a contact costs in the kernel alone, by composition of sub-models, dimension and instruction
// set; `scalar` is the law taken contact by contact. Time is per pass over all contacts of the scene,
// per_contact that of one contact. `bridges` is the pass over liquid bridges alone, one for each of
// the contacts and in dry contact itself, to be added to the kernel's time. `clock` is a chain of
// additions, each of which waits for the one before: its per_contact is a cycle of the core.
// Results: kernel.md.

#include "../unittest/core/scalar_kernel.h"
#include "contact/bridge_kernel.h"
#include "flakes.h"

#include <benchmark/benchmark.h>
#include <string>

using namespace apf;
using namespace apf_bench;

namespace {

void pass(benchmark::State &state, ContactKernel (*kernel_of)(const KernelChoice &), bool planar,
          const Composition &composition, double spread)
{
  Flakes flakes(planar, composition, spread);
  const ContactKernel kernel = kernel_of(flakes.choice);
  for (auto _ : state) benchmark::DoNotOptimize(flakes.step(kernel));
  state.counters["per_contact"] = benchmark::Counter(flakes.list.size(),
                                                     benchmark::Counter::kIsIterationInvariantRate |
                                                         benchmark::Counter::kInvert);
}

// bridges: which sub-model they have beside capillary and viscous force along the normal
void pass_bridges(benchmark::State &state, BridgeKernel (*kernel_of)(const BridgeChoice &),
                  bool planar, const std::string &what)
{
  Flakes flakes(planar, all_sub_models);
  BridgeModel liquid;
  liquid.volume_ratio = 0.01;
  liquid.sigma = 0.072;
  liquid.mu = 1.0e-3;
  liquid.capillary = what == "willett" ? Capillary::willett : Capillary::maugis;
  liquid.tangential = what == "tangential";
  const ContactModel dry = model_with(all_sub_models);
  const double r = 5.0e-6, m = 4.0 / 3.0 * pi * r * r * r * 2600.0;
  const auto bodies = ContactBodies::pair(r, r, 0.5 * m, 0.2 * m * r * r);
  BridgeList bridges;
  for (int k = 0; k < flakes.list.size(); k++) {
    const int kind = bridges.kinds.find(0, WetContact{liquid, dry}, bodies);
    bridges.add(flakes.list.i[k], flakes.list.j[k], k, kind, {liquid.volume(r), 0.0}, false);
    bridges.set_touching(k, true);
  }
  BridgeChoice choice;
  choice.planar = planar;
  choice.include(liquid);
  const BridgeKernel kernel = kernel_of(choice);
  for (auto _ : state)
    benchmark::DoNotOptimize(kernel(bridges, flakes.bodies, flakes.times, nullptr));
  state.counters["per_contact"] = benchmark::Counter(
      bridges.size(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void chain_of_additions(benchmark::State &state)
{
  unsigned long sum = 0;
  for (auto _ : state) asm volatile(".rept 1000\n add $1, %0\n .endr" : "+r"(sum));
  state.counters["per_contact"] = benchmark::Counter(
      1000, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}    // namespace

int main(int argc, char **argv)
{
  std::vector<KernelBuild> builds = kernel_builds();
  builds.insert(builds.begin(), {"scalar", apf_test::scalar_kernel});
  for (const bool planar : {true, false})
    for (const auto &composition : compositions) {
      const std::string name = composition.name;
      if (planar && name == "twisting") continue;    // there is none in the plane
      for (const auto &build : builds)
        for (const double spread : {0.0, 0.1}) {
          if (spread > 0.0 && !composition.rolling) continue;
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
  std::vector<BridgeBuild> bridges = bridge_builds();
  bridges.insert(bridges.begin(), {"scalar", apf_test::scalar_bridges});
  for (const bool planar : {true, false})
    for (const std::string what : {"maugis", "willett", "tangential"})
      for (const auto &build : bridges) {
        const std::string title =
            std::string(planar ? "2D" : "3D") + "/bridges/" + what + "/" + build.name;
        benchmark::RegisterBenchmark(title.c_str(), pass_bridges, build.kernel, planar, what)
            ->MinTime(0.05)
            ->Repetitions(9)
            ->ReportAggregatesOnly()
            ->Unit(benchmark::kMicrosecond);
      }
  benchmark::RegisterBenchmark("clock", chain_of_additions)
      ->MinTime(0.05)
      ->Repetitions(9)
      ->ReportAggregatesOnly()
      ->Unit(benchmark::kMicrosecond);
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
