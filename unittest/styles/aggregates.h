// Packings of particles and the aggregates that they make, for the tests of compute
// aggregate/contact.

#ifndef APF_TEST_AGGREGATES_H
#define APF_TEST_AGGREGATES_H

#include "scenes.h"

#include <random>

struct Particle {
  double x, y, z;
  int type;    // diameters 1, 0.8, 1.4
};

struct Packing : Scene {
  Packing()
  {
    box = "0 12 0 12 0 12";
    style = "pair_style granular/adhesive\n"
            "pair_coeff * * jkr 1.0e6 0.3 1.0 damping tsuji 0.5\n";
    types = 3;
  }
};

inline const std::vector<std::string> both = {"on", "off"};

// particles get the IDs 1, 2, ... or those given
inline void build(Simulation &sim, Packing packing, const std::vector<Particle> &particles,
                  const std::vector<int> &ids = {})
{
  std::vector<Sphere> spheres;
  for (const auto &p : particles) {
    spheres.push_back({p.x, p.y, p.z, p.type == 1 ? 1.0 : p.type == 2 ? 0.8 : 1.4});
    packing.type.push_back(p.type);
  }
  packing.ids = ids;
  build(sim, spheres, packing);
  sim.run("timestep 1.0e-5");
}

struct Row {
  double id, size, wall, contacts;
  bool operator==(const Row &o) const
  {
    return id == o.id && size == o.size && wall == o.wall && contacts == o.contacts;
  }
};

inline void PrintTo(const Row &row, std::ostream *out)
{
  *out << "{" << row.id << ", " << row.size << ", " << row.wall << ", " << row.contacts << "}";
}

inline std::vector<Row> rows(Simulation &sim, const char *compute = "c_agg")
{
  constexpr int columns = 6;    // the last two are those of liquid bridges
  const auto values = gather(sim, compute, columns);
  std::vector<Row> result;
  for (size_t m = 0; m < values.size(); m += columns)
    result.push_back({values[m], values[m + 1], values[m + 2], values[m + 3]});
  return result;
}

inline std::vector<double> totals(Simulation &sim)
{
  std::vector<double> result;
  for (int n = 1; n <= 6; n++) result.push_back(sim.value("c_agg[" + std::to_string(n) + "]"));
  return result;
}

// Flood fill over all pairs at their nearest images; plane: walls at y = -plane and y = plane
inline std::vector<Row> flood_fill(Simulation &sim, double plane = INFINITY)
{
  const auto x = gather(sim, "x", 3), radius = gather(sim, "radius", 1);
  const int n = static_cast<int>(radius.size());
  double lo[3], hi[3], xy, yz, xz;
  int periodic[3], change;
  lammps_extract_box(sim.lammps(), lo, hi, &xy, &yz, &xz, periodic, &change);

  auto touch = [&](int i, int j) {
    double square = 0.0;
    for (int c = 0; c < 3; c++) {
      double d = x[3 * j + c] - x[3 * i + c];
      if (periodic[c]) d -= (hi[c] - lo[c]) * std::round(d / (hi[c] - lo[c]));
      square += d * d;
    }
    return i != j && std::sqrt(square) < radius[i] + radius[j];
  };
  auto walls = [&](int i) {
    return (x[3 * i + 1] + plane < radius[i]) + (plane - x[3 * i + 1] < radius[i]);
  };

  std::vector<Row> result(n, Row{0, 0, 0, 0});
  for (int seed = 0; seed < n; seed++) {    // the first that is met has the smallest ID
    if (result[seed].id > 0) continue;
    std::vector<int> members = {seed};
    result[seed].id = seed + 1;
    int wall = 0;
    for (size_t m = 0; m < members.size(); m++) {
      const int i = members[m];
      result[i].contacts = walls(i);
      if (walls(i)) wall = 1;
      for (int j = 0; j < n; j++) {
        if (!touch(i, j)) continue;
        result[i].contacts++;
        if (result[j].id == 0) members.push_back(j);
        result[j].id = seed + 1;
      }
    }
    for (int i : members) {
      result[i].size = static_cast<double>(members.size());
      result[i].wall = wall;
    }
  }
  return result;
}

// the global vector that belongs to these rows
inline std::vector<double> totals_of(const std::vector<Row> &all)
{
  double particles[2] = {0, 0}, aggregates[2] = {0, 0};
  for (size_t i = 0; i < all.size(); i++) {
    if (all[i].size < 2) continue;
    for (int wall = 0; wall <= static_cast<int>(all[i].wall); wall++) {
      particles[wall]++;
      if (all[i].id == i + 1) aggregates[wall]++;
    }
  }
  auto mean = [&](int w) {
    return aggregates[w] > 0 ? particles[w] / aggregates[w] : 0.0;
  };
  return {particles[0], aggregates[0], mean(0), particles[1], aggregates[1], mean(1)};
}

inline void expect_flood_fill(Simulation &sim, double plane = INFINITY)
{
  const auto expected = flood_fill(sim, plane);
  EXPECT_EQ(rows(sim), expected);
  EXPECT_EQ(totals(sim), totals_of(expected));
}

// n particles of type 1 in a row along x, each in contact with the next
inline std::vector<Particle> chain_of(int n)
{
  std::vector<Particle> result;
  for (int i = 0; i < n; i++) result.push_back({3.0 + 0.95 * i, 6.0, 6.0, 1});
  return result;
}

inline std::vector<Particle> random_packing(int n, double size, int seed)
{
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(0.0, size);
  std::vector<Particle> result;
  for (int i = 0; i < n; i++) {
    const double x = place(random), y = place(random), z = place(random);
    result.push_back({x, y, z, 1 + i % 3});
  }
  return result;
}

inline const char *const measure = "compute agg all aggregate/contact\nrun 0\n";

#endif
