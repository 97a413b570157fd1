// What it costs to know the fluid of a gridded flow at a particle, by detail, dimension, size of the
// grid and instruction set. Particles are sorted in bins of about eight cells, as LAMMPS's atoms are,
// or not at all. Time is per pass over all particles, per_particle that of one.

#include "flow/grid_flow.h"

#include <algorithm>
#include <benchmark/benchmark.h>
#include <cmath>
#include <random>
#include <string>

using namespace apf;

namespace {

constexpr int n_blocks = 1600;    // of 64 particles

struct Scene {
  Lattice grid{};
  Detail detail;
  std::vector<double> records[2];
  GridView view;
  std::vector<PointBlock> blocks;

  Scene(int dims, int nodes, Detail wanted, bool series, bool sorted) : detail(wanted)
  {
    grid.dims = dims;
    for (int k = 0; k < 3; k++) {
      grid.n[k] = k < dims ? nodes : 1;
      grid.spacing[k] = 1.0;
    }
    std::vector<double> velocity(3 * grid.nodes());
    for (std::size_t v = 0; v < velocity.size(); v++) velocity[v] = std::sin(0.01 * v);
    view = grid_view(grid, detail);
    for (int f = 0; f <= series; f++) {
      const std::size_t line = 8;
      records[f].resize(frame_size(grid, detail) + line);
      double *first = records[f].data();
      while (reinterpret_cast<std::uintptr_t>(first) % 64) first++;
      write_records(grid, detail, velocity, {}, first);
      view.frame[f] = first;
    }
    view.share = 0.3;
    view.per_time = 1.0;
    place(nodes, sorted);
  }

  void place(int nodes, bool sorted)
  {
    struct Particle {
      double x[3];
      long bin;
    };
    std::mt19937 random(1);
    std::uniform_real_distribution<double> in(0.0, nodes - 1.0);
    std::vector<Particle> particles(n_blocks * block_width);
    for (auto &p : particles) {
      p.bin = 0;
      for (int k = 2; k >= 0; k--) {
        p.x[k] = k < grid.dims ? in(random) : 0.0;
        p.bin = p.bin * (nodes / 8 + 1) + static_cast<long>(p.x[k] / 8.0);
      }
    }
    if (sorted)
      std::sort(particles.begin(), particles.end(), [](const Particle &a, const Particle &b) {
        return a.bin < b.bin;
      });
    blocks.resize(n_blocks);
    for (int b = 0; b < n_blocks; b++) {
      blocks[b].n = block_width;
      for (int l = 0; l < block_width; l++) blocks[b].set(l, particles[b * block_width + l].x);
    }
  }
};

void pass(benchmark::State &state, GridSampler sampler, int dims, int nodes, Detail detail,
          bool series, bool sorted)
{
  const Scene scene(dims, nodes, detail, series, sorted);
  FluidBlock out;
  for (auto _ : state)
    for (const auto &points : scene.blocks) {
      benchmark::DoNotOptimize(sampler(scene.view, points, detail, out));
      benchmark::ClobberMemory();
    }
  state.counters["per_particle"] = benchmark::Counter(
      n_blocks * block_width,
      benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}    // namespace

int main(int argc, char **argv)
{
  const struct {
    const char *name;
    Detail detail;
    bool series;
  } details[] = {{"velocity", Detail::VELOCITY, false},
                 {"vorticity", Detail::VORTICITY, false},
                 {"gradient", Detail::GRADIENT, false},
                 {"series", Detail::GRADIENT, true}};
  for (const int dims : {2, 3})
    for (const int nodes : {dims == 2 ? 180 : 32, dims == 2 ? 1448 : 128})
      for (const auto &row : details)
        for (const bool sorted : {true, false})
          for (const auto &build : grid_sampler_builds()) {
            if (!sorted && build.name != grid_sampler_builds().back().name) continue;
            const std::string title = std::to_string(dims) + "D/" + std::to_string(nodes) + "/" +
                row.name + (sorted ? "/" : "/unsorted/") + build.name;
            benchmark::RegisterBenchmark(title.c_str(), pass, build.sampler, dims, nodes,
                                         row.detail, row.series, sorted)
                ->MinTime(0.05)
                ->Repetitions(9)
                ->ReportAggregatesOnly()
                ->Unit(benchmark::kMicrosecond);
          }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
}
