// Many contacts between many bodies for tests of the kernel, and how two results are compared:
// loads by what acts on each body, springs by their own length.

#ifndef APF_TEST_CONTACT_CROWD_H
#define APF_TEST_CONTACT_CROWD_H

#include "compare.h"
#include "two_bodies.h"

#include <array>
#include <random>

namespace apf_test {

using namespace apf;

// Many contacts at once between many bodies, with everything random, some of them beyond their
// neck and some without a history.
struct Crowd {
  static constexpr int bodies = 40;
  ContactList list;
  KernelChoice choice;
  std::vector<double> x, v, omega, f, torque;

  Crowd(int size, int submodels, int seed) : f(3 * bodies), torque(3 * bodies)
  {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> u(-1.0, 1.0);
    choice.planar = submodels & 16;
    for (auto *array : {&x, &v, &omega})
      for (int c = 0; c < 3 * bodies; c++) array->push_back(u(random));
    if (choice.planar) flatten();
    for (int k = 0; k < size; k++) {
      const int i = static_cast<int>(random() % bodies),
                j = static_cast<int>((i + 1 + random() % 39) % bodies);
      // half of the contacts lack a sub-model that others have
      const ContactModel model = some(submodels & (k % 2 ? static_cast<int>(random() % 16) : 15));
      choice.include(model);
      add(i, j, k, model, u, random);
    }
    choice.include(some(submodels));
  }

  void flatten()
  {
    for (int b = 0; b < bodies; b++) {
      x[3 * b + 2] = v[3 * b + 2] = 0.0;
      omega[3 * b] = omega[3 * b + 1] = 0.0;
    }
  }

  static ContactModel some(int submodels)
  {
    ContactModel model;
    model.surface = {1.0e3, 300.0, (submodels & 1) ? 2.0 : 0.0};
    model.mu = (submodels & 2) ? 0.3 : 0.0;
    model.twisting = submodels & 4;
    model.theta_crit = (submodels & 8) ? 0.02 : 0.0;
    model.alpha = 0.4;
    model.zeta = 0.2;
    return model;
  }

  template <class Uniform, class Random>
  void add(int i, int j, int k, const ContactModel &model, Uniform &u, Random &random)
  {
    const Vec3 d = TwoBodies::vec(x.data(), j) - TwoBodies::vec(x.data(), i);
    const double distance = std::sqrt(norm2(d));
    double closer = 0.02 + 0.03 * u(random);    // half the overlap, of the distance
    // an overlap near 0 is the small difference of two lengths, and has their rounding
    if (std::fabs(closer) < 1.0e-3) closer += 2.0e-3;
    const double r = distance * (0.5 + closer);
    ContactHistory h;
    if (k % 3) {
      const Vec3 n = (1.0 / distance) * d, t = cross(n, {0.0, 0.0, 1.0});
      TwoBodies::set(h.normal, 0, n);
      TwoBodies::set(h.sliding, 0, 0.01 * u(random) * t);
      TwoBodies::set(h.rolling, 0, 0.01 * u(random) * t);
      h.twisting = choice.planar ? 0.0 : 0.1 * u(random);
    }
    const auto pair = ContactBodies::pair(r, r, 1.0 + 0.5 * u(random), 0.3);
    list.add(i, j, k, list.kinds.find(0, model, pair), h);
  }

  // how many contacts have ended
  int evaluate(ContactKernel kernel, double dt, ContactParts *parts = nullptr)
  {
    std::fill(f.begin(), f.end(), 0.0);
    std::fill(torque.begin(), torque.end(), 0.0);
    return run_kernel(kernel, choice.planar, list, bodies, x.data(), v.data(), omega.data(),
                      f.data(), torque.data(), {dt, 0.0, 0.0}, parts);
  }
  void evaluate(double dt, ContactParts *parts = nullptr)
  {
    evaluate(contact_kernel(choice), dt, parts);
  }

  // the same, each contact in a list of its own
  void evaluate_one_by_one(double dt)
  {
    std::vector<double> sum_f(f.size()), sum_torque(f.size());
    const ContactList all = list;
    for (int k = 0; k < all.size(); k++) {
      list.clear();
      list.add(all.i[k], all.j[k], all.source[k], list.kinds.add({all.constants_of(k), {}}),
               all.history_of(k));
      evaluate(dt);
      for (size_t c = 0; c < f.size(); c++) {
        sum_f[c] += f[c];
        sum_torque[c] += torque[c];
      }
      results.push_back(list);
    }
    f = sum_f;
    torque = sum_torque;
    list = all;
  }
  std::vector<ContactList> results;
};

// By each body the sum of the magnitudes of all parts that its contacts exert, by which the
// rounding of its loads is measured. The elastic force is repulsion less adhesion, of F_C or more.
struct Magnitudes {
  std::vector<double> force, torque;

  Magnitudes(Crowd crowd, double dt) : force(Crowd::bodies), torque(Crowd::bodies)
  {
    std::vector<ContactParts> parts(crowd.list.size());
    crowd.evaluate(dt, parts.data());
    for (int k = 0; k < crowd.list.size(); k++) {
      if (crowd.list.ended(k)) continue;
      const auto &p = parts[k];
      const auto c = crowd.list.constants_of(k);
      const double slides = std::sqrt(norm2(TwoBodies::vec(p.sliding, 0))),
                   rolls = std::sqrt(norm2(TwoBodies::vec(p.rolling, 0)));
      for (const int body : {crowd.list.i[k], crowd.list.j[k]}) {
        force[body] += std::fabs(p.elastic) + pulloff_force(c) + std::fabs(p.damping) + slides;
        torque[body] += c.radius_sum * slides + rolls + std::fabs(p.twisting);
      }
    }
  }
  // from E and gamma of Crowd::some(), eq (41)
  static double pulloff_force(const ContactConstants &c)
  {
    return c.break_overlap < 0.0 ? 3.0 * pi * 2.0 * c.R : 0.0;
  }
};

inline void expect_same_loads(const Crowd &a, const Crowd &b, const Magnitudes &scale,
                              double tolerance)
{
  expect_same(a.f, b.f, scale.force, tolerance);
  expect_same(a.torque, b.torque, scale.torque, tolerance);
}

inline std::array<double, ContactHistory::size> numbers(const ContactHistory &h)
{
  std::array<double, ContactHistory::size> n{};
  std::copy(h.sliding, h.sliding + 3, n.begin());
  std::copy(h.rolling, h.rolling + 3, n.begin() + 3);
  n[6] = h.twisting;
  std::copy(h.normal, h.normal + 3, n.begin() + 7);
  return n;
}

// each spring by its own length
inline void expect_same_contact(const ContactList &a, int k, const ContactList &b, int l)
{
  const auto u = numbers(a.history_of(k)), w = numbers(b.history_of(l));
  const std::vector<std::pair<int, int>> parts = {{0, 3}, {3, 6}, {6, 7}, {7, 10}};
  for (const auto &[first, end] : parts) {
    double length2 = 0.0, apart2 = 0.0;
    for (int c = first; c < end; c++) {
      length2 += w[c] * w[c];
      apart2 += (u[c] - w[c]) * (u[c] - w[c]);
    }
    ASSERT_LE(std::sqrt(apart2), 1e-12 * std::sqrt(length2)) << "history " << first;
  }
  ASSERT_NEAR(a.overlap(k), b.overlap(l), 1e-14);
  ASSERT_EQ(a.ended(k), b.ended(l));
}

}    // namespace apf_test

#endif
