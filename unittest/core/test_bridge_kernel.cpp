// The kernel of bridges as a machine: every build against the law taken bridge by bridge, lists,
// parts, and the viscous step where it is solved by iteration.

#include "compare.h"
#include "scalar_kernel.h"

#include <gtest/gtest.h>
#include <random>

using namespace apf;
using namespace apf_test;

namespace {

enum { VISCOUS = 1, FITTED = 2, TANGENTIAL = 4, PLANAR = 8, ALL = 16 };

BridgeModel some(int submodels)
{
  BridgeModel liquid;
  liquid.volume_ratio = 0.02;
  liquid.sigma = 0.05;
  liquid.theta = 0.4;
  liquid.mu = submodels & VISCOUS ? 0.2 : 0.0;
  liquid.roughness = 0.01;
  liquid.capillary = submodels & FITTED ? Capillary::willett : Capillary::maugis;
  liquid.tangential = submodels & TANGENTIAL;
  return liquid;
}

// Bridges between many bodies, everything random: in dry contact, near, far, ruptured; fresh; slow
// and so fast that a step goes from far above h_min to far below it, or out again.
struct Crowd {
  static constexpr int n_bodies = 60;
  Bodies bodies;
  BridgeList list;
  BridgeChoice choice;

  Crowd(int size, int submodels, int seed) : bodies(submodels & PLANAR)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    choice.planar = submodels & PLANAR;
    choice.include(some(submodels));
    bodies.resize(n_bodies);
    for (int b = 0; b < n_bodies; b++) {
      const double fast = std::pow(10.0, 2.0 * u(random) - 1.0);
      const double x[3] = {u(random), u(random), choice.planar ? 0.0 : u(random)};
      const double v[3] = {fast * u(random), fast * u(random),
                           choice.planar ? 0.0 : fast * u(random)};
      const double omega[3] = {choice.planar ? 0.0 : u(random), choice.planar ? 0.0 : u(random),
                               u(random)};
      bodies.place(b, x);
      bodies.set_motion(b, v, omega);
    }
    ContactModel dry;
    dry.surface = {10.0, 3.0, 1.0e-3};
    dry.alpha = 0.4;
    for (int k = 0; k < size; k++) {
      const int i = random() % n_bodies, j = (i + 1 + random() % (n_bodies - 1)) % n_bodies;
      // half of the bridges lack a sub-model that others have
      const auto liquid = some(submodels & (k % 2 ? static_cast<int>(random() % 8) : 7));
      double a[3], b[3], d2 = 0.0;
      bodies.position(i, a);
      bodies.position(j, b);
      for (int c = 0; c < 3; c++) d2 += (b[c] - a[c]) * (b[c] - a[c]);
      // gap -0.02 to 0.12 diameters; rupture is at about 0.25
      const double gap = k % 5 == 4 ? 0.3 : 0.05 + 0.07 * u(random);
      const double radius = 0.5 * std::sqrt(d2) / (1.0 + gap), m = 0.1 + 0.05 * u(random);
      const auto pair = ContactBodies::pair(radius, radius, m, 0.3 * m);
      const int kind = list.kinds.find(static_cast<int>(random()), WetContact{liquid, dry}, pair);
      const double volume = liquid.volume(radius) * (0.6 + 0.4 * u(random));
      BridgeMemory memory{0.3 * volume, 0.7 * volume};
      if (k % 3 == 1) memory.formed = 2.0 * radius * (gap + 0.02);
      list.add(i, j, k, kind, memory, k % 3 == 1);
      list.set_touching(k, k % 4 != 3);
      list.set_mass(k, m * (0.5 + 0.4 * u(random)));
    }
  }

  int evaluate(BridgeKernel kernel, double dt, BridgeParts *parts = nullptr)
  {
    bodies.clear_loads(0, n_bodies);
    return kernel(list, bodies, {dt, 0.5 * dt, dt}, parts);
  }
  std::vector<double> loads() const
  {
    std::vector<double> all(6 * n_bodies);
    for (int b = 0; b < n_bodies; b++) bodies.add_load_to(b, &all[6 * b], &all[6 * b + 3]);
    return all;
  }
  Vec3 normal(int k) const
  {
    double a[3], b[3];
    bodies.position(list.i[k], a);
    bodies.position(list.j[k], b);
    const Vec3 d{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    return (1.0 / std::sqrt(norm2(d))) * d;
  }
};

// By each body the sum of the magnitudes of all parts of the forces that its bridges exert, and of
// their torques. The viscous step finds a change of speed from changes of the gap, and has their
// rounding: 1e-15 of the force that would close the gap within the step, at a tolerance of 1e-12.
std::vector<double> magnitudes(Crowd crowd, double dt)
{
  std::vector<BridgeParts> parts(crowd.list.size());
  crowd.evaluate(bridge_kernel(crowd.choice), dt, parts.data());
  std::vector<double> sum(2 * Crowd::n_bodies);
  for (int k = 0; k < crowd.list.size(); k++) {
    if (crowd.list.ended(k)) continue;
    const auto &p = parts[k];
    const auto c = crowd.list.constants(k);
    const double distance = c.radius_sum + p.gap;
    const double close = std::max(std::fabs(p.gap), c.h_min) *
        crowd.list.blocks[k / BridgeList::width].mass[k % BridgeList::width] / (dt * dt);
    const double rounding = crowd.choice.viscous && dt > 0.0 ? 1.0e-3 * close : 0.0;
    double across = 0.0;
    for (const double component : p.tangential) across += component * component;
    across = std::sqrt(across);
    for (const int body : {crowd.list.i[k], crowd.list.j[k]}) {
      sum[2 * body] += std::fabs(p.capillary) + std::fabs(p.viscous) + rounding + across;
      sum[2 * body + 1] += distance * across;
    }
  }
  return sum;
}

void expect_parts_of_force(const BridgeParts &p, const Vec3 &n)
{
  const double size = std::fabs(p.viscous) + std::fabs(p.capillary), along[3] = {n.x, n.y, n.z};
  double normal = 0.0;
  for (int c = 0; c < 3; c++) {
    normal += p.tangential[c] * along[c];
    EXPECT_NEAR(p.force[c], (p.capillary - p.viscous) * along[c] + p.tangential[c], 1e-12 * size);
  }
  EXPECT_NEAR(normal, 0.0, 1e-12 * size);
}

// what a bridge keeps, and where it is
void expect_same_bridges(const BridgeList &a, const BridgeList &b)
{
  ASSERT_EQ(a.size(), b.size());
  for (int k = 0; k < a.size(); k++) {
    EXPECT_EQ(a.ended(k), b.ended(k)) << k;
    EXPECT_NEAR(a.gap(k) - b.gap(k), 0.0, 1e-14) << k;
    EXPECT_EQ(a.memory(k).volume_i, b.memory(k).volume_i) << k;
    EXPECT_EQ(a.memory(k).volume_j, b.memory(k).volume_j) << k;
    EXPECT_EQ(a.memory(k).formed, b.memory(k).formed) << k;
    const auto &u = a.blocks[k / BridgeList::width], &w = b.blocks[k / BridgeList::width];
    const int l = k % BridgeList::width;
    for (const auto lanes : {&BridgeList::Block::formed, &BridgeList::Block::b,
                             &BridgeList::Block::rupture, &BridgeList::Block::mass})
      EXPECT_EQ((u.*lanes)[l], (w.*lanes)[l]) << k;
  }
}

}    // namespace

TEST(BridgeKernel, every_build_agrees_with_the_law_taken_bridge_by_bridge)
{
  for (const auto &build : bridge_builds())
    for (int submodels = 0; submodels < ALL; submodels++)
      for (const int size : {1, 7, 8, 9, 50, 203})
        for (const double dt : {0.0, 0.001, 0.1}) {
          SCOPED_TRACE(testing::Message() << build.name << " sub-models " << submodels
                                          << " bridges " << size << " step " << dt);
          Crowd blocks(size, submodels, 1000 * submodels + size), scalar = blocks;
          const auto scale = magnitudes(blocks, dt);
          const int ended = blocks.evaluate(build.kernel(blocks.choice), dt);
          EXPECT_EQ(scalar.evaluate(scalar_bridges(scalar.choice), dt), ended);
          expect_same_bridges(blocks.list, scalar.list);
          expect_same(blocks.loads(), scalar.loads(), scale, rounding_of_builds);
          if (size > 100) {
            EXPECT_GT(ended, 0);
            EXPECT_LT(ended, size);
            EXPECT_GT(largest(blocks.loads()), 0.0);
          }
        }
}

// One step from everywhere to everywhere, against bisection of m (w' - w) = G(h') - G(h0).
TEST(BridgeKernel, viscous_step_solves_its_equation)
{
  const auto liquid = some(VISCOUS);
  const auto c = BridgeConstants::make({liquid, ContactModel()},
                                       ContactBodies::pair(1.0, 1.0, 1.0, 1.0), liquid.volume(1.0));
  const double drag_min = c.resistance(c.h_min);
  auto G = [&](double h) {
    if (h <= c.h_min) return drag_min * (h - c.h_min);
    return c.drag * std::log(momentum_ratio(h, c.b) / momentum_ratio(c.h_min, c.b));
  };
  int solved = 0;
  for (const double stiffness : {1e-4, 1e-2, 1.0, 100.0, 1e4})    // m / ahead over drag_min
    for (const double from : {-3.0, 0.5, 1.0, 1.0001, 1.5, 30.0, 200.0})
      for (const double free : {-500.0, -3.0, 0.5, 1.0, 1.01, 1.5, 29.9, 30.3, 200.0, 1e4}) {
        if (from == free) continue;
        const double mass = stiffness * drag_min, h0 = from * c.h_min, h1 = free * c.h_min;
        const ViscousStep<double> step{h0, h1, 1.0, mass};
        double low = std::min(h0, h1), high = std::max(h0, h1);
        for (int n = 0; n < 200; n++) {
          const double mid = 0.5 * (low + high);
          (mass * (mid - h1) + G(mid) - G(h0) < 0.0 ? low : high) = mid;
        }
        const double exact = mass * (low - h1);
        const double found = step.momentum(c, c.b, c.resistance(1.01 * h0));
        // where the resistance of the middle is taken: (change)^2 / 12, change at most 2 %, and
        // that of an estimate of the middle
        EXPECT_NEAR(found / exact, 1.0, 2e-4) << stiffness << " " << from << " " << free;
        solved++;
      }
  EXPECT_GT(solved, 300);
}

TEST(BridgeKernel, asking_for_parts_changes_nothing_and_they_add_up)
{
  for (const auto &build : bridge_builds())
    for (const int submodels : {7, 7 + PLANAR}) {
      SCOPED_TRACE(testing::Message() << build.name << submodels);
      Crowd quiet(37, submodels, 3), asked = quiet;
      const auto scale = magnitudes(quiet, 0.01);
      std::vector<BridgeParts> parts(37);
      const auto kernel = build.kernel(quiet.choice);
      EXPECT_EQ(asked.evaluate(kernel, 0.01, parts.data()), quiet.evaluate(kernel, 0.01));
      expect_same(asked.loads(), quiet.loads(), scale, 1e-13);
      expect_same_bridges(asked.list, quiet.list);
      std::vector<double> sum(6 * Crowd::n_bodies);
      for (int k = 0; k < 37; k++) {
        const auto &p = parts[k];
        expect_parts_of_force(p, asked.normal(k));
        EXPECT_EQ(p.energy<0.0, p.capillary> 0.0 && p.gap < asked.list.constants(k).rupture);
        for (int c = 0; c < 3; c++) {
          sum[6 * asked.list.i[k] + c] += p.force[c];
          sum[6 * asked.list.j[k] + c] -= p.force[c];
        }
      }
      auto forces = asked.loads();
      for (size_t c = 0; c < forces.size(); c++)
        if (c % 6 > 2) forces[c] = 0.0;
      expect_same(sum, forces, scale, 1e-12);
    }
}

TEST(BridgeList, removal_keeps_the_others)
{
  Crowd crowd(40, 7, 8);
  const BridgeList all = crowd.list;
  for (const int gone : {39, 0, 4, 4, 17, 31, 1, 20}) crowd.list.remove(gone);
  ASSERT_EQ(crowd.list.size(), 32);
  for (int k = 0; k < crowd.list.size(); k++) {
    const int was = crowd.list.source[k];    // the mark that it was added with
    EXPECT_EQ(crowd.list.i[k], all.i[was]);
    EXPECT_EQ(crowd.list.j[k], all.j[was]);
    EXPECT_EQ(crowd.list.memory(k).volume(), all.memory(was).volume());
    EXPECT_EQ(crowd.list.memory(k).formed, all.memory(was).formed);
    EXPECT_EQ(crowd.list.constants(k).rupture, all.constants(was).rupture);
    const auto &block = crowd.list.blocks[k / 16], &old = all.blocks[was / 16];
    EXPECT_EQ(block.mass[k % 16], old.mass[was % 16]);
    EXPECT_EQ(block.rupture[k % 16], all.constants(was).rupture);
    EXPECT_EQ(block.formed[k % 16], old.formed[was % 16]);
    for (int l = 0; l < k; l++) EXPECT_NE(crowd.list.source[l], was);
  }
  crowd.list.clear();
  EXPECT_EQ(crowd.evaluate(bridge_kernel(crowd.choice), 0.1), 0);
  EXPECT_EQ(largest(crowd.loads()), 0.0);
}
