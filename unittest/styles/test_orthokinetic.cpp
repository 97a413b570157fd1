// Spheres without inertia in simple shear meet at Smoluchowski's rate (2/3) G d^3 n^2 per volume
// (M. v. Smoluchowski, Z. Phys. Chem. 92, 129 (1918), doi:10.1515/zpch-1918-9209), where paths are
// straight lines. Pairs are counted here from positions; particles pass through each other, so that
// the rate stays what it is at the beginning.

#include "scenes.h"

#include <cstdint>
#include <unordered_set>

namespace {

constexpr double length = 100.0;    // of the box, in diameters
constexpr int cells = 99;

// pairs closer than a diameter; x and z are periodic
std::unordered_set<uint64_t> touching(const LAMMPS_NS::Atom *atom)
{
  const int n = atom->nlocal;
  std::vector<int> first(cells * cells * cells, -1), next(n);
  auto cell_of = [&](const double *x, int c) {
    const int k = static_cast<int>(std::floor(x[c] / length * cells));
    return (k % cells + cells) % cells;
  };
  std::unordered_set<uint64_t> pairs;
  for (int i = 0; i < n; i++) {
    const double *a = atom->x[i];
    const int home[3] = {cell_of(a, 0), cell_of(a, 1), cell_of(a, 2)};
    for (int k = 0; k < 27; k++) {
      const int cell = ((home[0] + k / 9 + cells - 1) % cells * cells +
                        (home[1] + k / 3 % 3 + cells - 1) % cells) *
              cells +
          (home[2] + k % 3 + cells - 1) % cells;
      for (int j = first[cell]; j >= 0; j = next[j]) {
        const double *b = atom->x[j];
        double d2 = (a[1] - b[1]) * (a[1] - b[1]);
        for (int c : {0, 2}) {
          const double d = a[c] - b[c] - length * std::round((a[c] - b[c]) / length);
          d2 += d * d;
        }
        if (d2 >= 1.0) continue;
        const uint64_t p = std::min(atom->tag[i], atom->tag[j]);
        pairs.insert(p << 32 | std::max(atom->tag[i], atom->tag[j]));
      }
    }
    const int mine = (home[0] * cells + home[1]) * cells + home[2];
    next[i] = first[mine];
    first[mine] = i;
  }
  return pairs;
}

}    // namespace

TEST(Orthokinetic, pairs_meet_at_the_rate_of_smoluchowski)
{
  const int n = 60000, steps = 300;
  const double strain = 0.02;    // of a step; relaxation takes a thousandth of it
  Simulation sim;
  sim.run("units lj\natom_style sphere\natom_modify map array\nboundary p f p\n"
          "region box block 0 100 0 100 0 100\ncreate_box 1 box\n"
          "create_atoms 1 random " +
          std::to_string(n) +
          " 4711 box\nset group all diameter 1 density 1\n"
          "variable u atom y\nvelocity all set v_u 0 0\n"
          "pair_style zero 1.0\npair_coeff * *\nneighbor 0.5 bin\n"
          "fix air all flow/field shear x y 1.0 0.0 density 1 viscosity " +
          digits(1000.0 / 18.0 / strain) +
          "\nfix drag all flow/force air drag stokes\nfix move all nve/sphere\ntimestep " +
          digits(strain) + "\nrun 0\n");
  const auto *atom = sim.lammps()->atom;
  const auto before = touching(atom);
  std::unordered_set<uint64_t> met;
  for (int k = 0; k < steps; k++) {
    sim.run("run 1 pre no post no");
    for (const auto pair : touching(atom))
      if (!before.count(pair)) met.insert(pair);
  }
  // spheres within a diameter of the faces y = 0 and y = 100 lack partners beyond them
  const double density = n / (length * length * length);
  const double expected =
      density * density * length * length * (2.0 / 3.0 * length - pi / 8.0) * strain * steps;
  EXPECT_GT(expected, 1.0e4);
  EXPECT_NEAR(met.size() / expected, 1.0, 0.05);
}
