// What a contact costs in the kernel alone, by composition of sub-models, dimension and instruction
// set; `scalar` is the law taken contact by contact. Time is per pass over all contacts of the scene,
// per_contact that of one contact. `bridges` is the pass over liquid bridges alone, one for each of the
// contacts and in dry contact itself, to be added to the kernel's time. Results: kernel.md.

#include "../unittest/core/scalar_kernel.h"
#include "contact/bridge_list.h"
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

void pass_bridges(benchmark::State &state, bool planar, Capillary capillary)
{
  Flakes flakes(planar, n_compositions - 1);
  BridgeModel liquid;
  liquid.volume_ratio = 0.01;
  liquid.sigma = 0.072;
  liquid.mu = 1.0e-3;
  liquid.capillary = capillary;
  const double r = 5.0e-6, m = 4.0 / 3.0 * pi * r * r * r * 2600.0;
  const auto bodies = ContactBodies::pair(r, r, 0.5 * m, 0.2 * m * r * r);
  const auto constants = BridgeConstants::make(liquid, bodies, liquid.volume(r));
  const auto contact = ContactConstants::make(model_with(n_compositions - 1), bodies);
  BridgeList bridges;
  for (int k = 0; k < flakes.list.size(); k++)
    bridges.add(flakes.list.i[k], flakes.list.j[k], k, constants, BridgeMemory(), false);
  std::vector<DueLoad> due;
  auto dry = [&](int, double overlap, double closing_speed) {
    return force_at(contact, jkr_root(overlap, contact.inv_R, contact.neck), closing_speed,
                    flakes.times.step);
  };
  for (auto _ : state)
    flakes.bodies.with_rows([&](auto *rows) {
      benchmark::DoNotOptimize(bridges.add_forces(rows, flakes.times, dry, due));
    });
  state.counters["per_contact"] = benchmark::Counter(
      bridges.size(), benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
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
  for (const bool planar : {true, false})
    for (const auto capillary : {Capillary::maugis, Capillary::willett}) {
      const std::string title = std::string(planar ? "2D" : "3D") + "/bridges/" +
          (capillary == Capillary::maugis ? "maugis" : "willett");
      benchmark::RegisterBenchmark(title.c_str(), pass_bridges, planar, capillary)
          ->MinTime(0.05)
          ->Repetitions(9)
          ->ReportAggregatesOnly()
          ->Unit(benchmark::kMicrosecond);
    }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
