// Flakes for measurements of the kernel: bodies at rest in triangular lattices in the plane (19
// bodies, 42 contacts) and cuboctahedra in space (13 bodies, 36 contacts), at random places and turns,
// with small random velocities. As peers.py has them.

#ifndef APF_BENCH_FLAKES_H
#define APF_BENCH_FLAKES_H

#include "contact/contact_kernel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <utility>

namespace apf_bench {

constexpr int particles = 7980;

// Sub-models of all contacts of a scene; with adhesion by the name of the one that was added last.
// Without it there is no rolling: hertz-all has all others.
struct Composition {
  const char *name;
  bool adhesion, damping, sliding, twisting, rolling;
};
constexpr Composition all_sub_models = {"rolling", true, true, true, true, true};
constexpr Composition compositions[] = {{"normal", true, false, false, false, false},
                                        {"damping", true, true, false, false, false},
                                        {"sliding", true, true, true, false, false},
                                        {"twisting", true, true, true, true, false},
                                        all_sub_models,
                                        {"hertz", false, false, false, false, false},
                                        {"hertz-all", false, true, true, true, false}};

// The channel of examples/channel at phi = 50, in SI.
inline apf::ContactModel model_with(const Composition &composition)
{
  const double d = 1.0e-5, rho = 2600.0, U = 0.5, phi = 50.0, E = 1.0e4 * rho * U * U;
  apf::ContactModel model;
  model.surface = {E, 0.5 * E * (1.0 - 0.3) / (2.0 - 0.3),
                   composition.adhesion ? phi * rho * U * U * d / 2.0 : 0.0};
  model.alpha = composition.damping ? 1.018 : 0.0;
  model.mu = composition.sliding ? 0.3 : 0.0;
  model.twisting = composition.twisting;
  model.theta_crit = composition.rolling ? 0.01 : 0.0;
  return model;
}

struct Flakes {
  apf::Bodies bodies;
  apf::ContactList list;
  apf::KernelChoice choice;
  apf::ContactTimes times{5.0e-8, 2.5e-8, 5.0e-8};

  // radii spread by `spread` (0: all the same, one kind of contact); bodies are where adhesion holds
  // them, also where there is none: the kernel does not move them
  Flakes(bool planar, const Composition &composition, double spread = 0.0) : bodies(planar)
  {
    const apf::ContactModel model = model_with(composition);
    choice.planar = planar;
    choice.include(model);
    const double radius = 5.0e-6, R = 0.5 * radius, rho = 2600.0;
    const double at_rest = model_with(all_sub_models).normal(R).equilibrium_radius();
    const double delta = std::pow(at_rest, 2) / (3.0 * R);
    const double spacing = 2.0 * radius - delta;

    std::mt19937 random(1);
    std::normal_distribution<double> normal;
    std::vector<std::array<double, 3>> sites = planar ? hexagon() : cuboctahedron();
    const int size = static_cast<int>(sites.size()), flakes = particles / size;
    const int side = planar ? 21 : 9;
    bodies.resize(flakes * size);
    for (int n = 0; n < flakes; n++) {
      std::shuffle(sites.begin(), sites.end(), random);
      double turn[3][3];
      rotation(planar, random, turn);
      for (int a = 0; a < size; a++) {
        const int cell[3] = {n % side, n / side % side, n / side / side};
        double x[3], v[3], omega[3];
        for (int c = 0; c < 3; c++) {
          x[c] = cell[c] * 6.0 * spacing;
          for (int e = 0; e < 3; e++) x[c] += turn[c][e] * sites[a][e] * spacing;
          v[c] = 0.002 * normal(random);
          omega[c] = 0.002 / radius * normal(random);
        }
        if (planar) v[2] = omega[0] = omega[1] = 0.0;
        bodies.place(n * size + a, x);
        bodies.set_motion(n * size + a, v, omega);
      }
      for (int a = 0; a < size; a++)
        for (int b = a + 1; b < size; b++) {
          double d2 = 0.0;
          for (int c = 0; c < 3; c++) d2 += std::pow(sites[b][c] - sites[a][c], 2);
          if (d2 > 1.1) continue;
          const double grown = spread * normal(random), r = radius * (1.0 + grown);
          const double m = 4.0 / 3.0 * apf::pi * r * r * r * rho, I = 0.4 * m * r * r;
          const auto pair = apf::ContactBodies::pair(radius - r * grown, r, 0.5 * m, 0.5 * I);
          list.add(n * size + a, n * size + b, 0, list.kinds.find(0, model, pair), {});
        }
    }
  }

  int step(apf::ContactKernel kernel) { return kernel(list, bodies, times, nullptr); }

 private:
  static std::vector<std::array<double, 3>> hexagon()
  {
    std::vector<std::array<double, 3>> sites;
    for (int i = -2; i <= 2; i++)
      for (int j = -2; j <= 2; j++)
        if (std::abs(i + j) <= 2) sites.push_back({i + 0.5 * j, std::sqrt(0.75) * j, 0.0});
    return sites;
  }
  static std::vector<std::array<double, 3>> cuboctahedron()
  {
    std::vector<std::array<double, 3>> sites{{0.0, 0.0, 0.0}};
    const double h = std::sqrt(0.5);
    for (const double p : {-h, h})
      for (const double q : {-h, h}) {
        sites.push_back({p, q, 0.0});
        sites.push_back({p, 0.0, q});
        sites.push_back({0.0, p, q});
      }
    return sites;
  }
  // random, from a random unit quaternion; about z in the plane
  template <class Random> static void rotation(bool planar, Random &random, double (&turn)[3][3])
  {
    std::normal_distribution<double> normal;
    double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
    if (planar) x = y = 0.0;
    const double s = 2.0 / (w * w + x * x + y * y + z * z);
    const double rows[3][3] = {
        {1.0 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y)},
        {s * (x * y + w * z), 1.0 - s * (x * x + z * z), s * (y * z - w * x)},
        {s * (x * z - w * y), s * (y * z + w * x), 1.0 - s * (x * x + y * y)}};
    for (int c = 0; c < 3; c++)
      for (int e = 0; e < 3; e++) turn[c][e] = rows[c][e];
  }
};

}    // namespace apf_bench

#endif
