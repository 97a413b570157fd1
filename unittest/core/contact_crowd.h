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

// Many contacts at once between many bodies, some of them beyond their neck and some without a
// history: with everything random, or of few kinds.
struct Crowd {
  static constexpr int bodies = 40;
  ContactList list;
  KernelChoice choice;
  std::vector<double> x, v, omega, f, torque;

  // every contact is of a kind of its own
  Crowd(int size, int submodels, int seed) : Crowd(submodels, seed)
  {
    for (int k = 0; k < size; k++) {
      const int i = static_cast<int>(random() % bodies),
                j = static_cast<int>((i + 1 + random() % 39) % bodies);
      // half of the contacts lack a sub-model that others have
      const ContactModel model = some(submodels & (k % 2 ? static_cast<int>(random() % 16) : 15));
      choice.include(model);
      double closer = 0.02 + 0.03 * uniform();    // half the overlap, of the distance
      if (std::fabs(closer) < least_overlap) closer += 2.0 * least_overlap;
      const double r = distance(i, j) * (0.5 + closer);
      add(i, j, k,
          list.kinds.find(0, model, ContactBodies::pair(r, r, 1.0 + 0.5 * uniform(), 0.3)));
    }
  }

  // spheres about the sites of a lattice; after every `run` contacts comes the next of 1 or 2 kinds
  static Crowd of_kinds(int kinds, int run, int size, int submodels, int seed)
  {
    Crowd crowd(submodels, seed);
    crowd.form_lattice();
    // the second kind lacks sub-models
    const ContactModel models[] = {some(submodels), some(submodels & (crowd.random() % 16))};
    const ContactBodies pairs[] = {ContactBodies::pair(0.51, 0.51, 1.2, 0.3),
                                   ContactBodies::pair(0.65, 0.38, 0.8, 0.2)};
    for (int k = 0; k < size;) {
      const int i = static_cast<int>(crowd.random() % bodies),
                j = static_cast<int>(crowd.random() % bodies), kind = k / run % kinds;
      const double sum = pairs[kind].radius_i + pairs[kind].radius_j;
      const double overlap = sum - crowd.distance(i, j);
      if (overlap < -0.1 || overlap > 0.2 || std::fabs(overlap) < 2.0 * least_overlap) continue;
      crowd.add(i, j, k++, crowd.list.kinds.find(kind, models[kind], pairs[kind]));
    }
    return crowd;
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

  // what a dashpot along the normal can exert at the relative speed of the bodies of contact k
  double damping_bound(int k) const
  {
    const auto c = list.constants_of(k);
    const Vec3 closing = TwoBodies::vec(v.data(), list.i[k]) - TwoBodies::vec(v.data(), list.j[k]);
    return list.ended(k) ? 0.0 : c.eta * std::sqrt(norm2(closing));
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

 private:
  // an overlap near 0 is the small difference of two lengths, and has their rounding
  static constexpr double least_overlap = 1.0e-3;    // half of it, of the distance
  std::mt19937 random;

  Crowd(int submodels, int seed) : f(3 * bodies), torque(3 * bodies), random(seed)
  {
    choice.planar = submodels & 16;
    choice.include(some(submodels));
    for (auto *array : {&x, &v, &omega})
      for (int c = 0; c < 3 * bodies; c++) array->push_back(uniform());
    if (!choice.planar) return;
    for (int b = 0; b < bodies; b++) {
      x[3 * b + 2] = v[3 * b + 2] = 0.0;
      omega[3 * b] = omega[3 * b + 1] = 0.0;
    }
  }

  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(random); }

  // sites 1 apart, and bodies up to 0.05 from there along each axis
  void form_lattice()
  {
    const int nx = choice.planar ? 8 : 5, ny = choice.planar ? 5 : 4;
    for (int b = 0; b < bodies; b++) {
      const int site[3] = {b % nx, b / nx % ny, b / nx / ny};
      for (int c = 0; c < 3; c++) x[3 * b + c] = site[c] + 0.05 * x[3 * b + c];
    }
  }

  Vec3 separation(int i, int j) const
  {
    return TwoBodies::vec(x.data(), j) - TwoBodies::vec(x.data(), i);
  }
  double distance(int i, int j) const { return std::sqrt(norm2(separation(i, j))); }

  void add(int i, int j, int k, int kind)
  {
    ContactHistory h;
    if (k % 3) {
      const Vec3 n = (1.0 / distance(i, j)) * separation(i, j), t = cross(n, {0.0, 0.0, 1.0});
      TwoBodies::set(h.normal, 0, n);
      TwoBodies::set(h.sliding, 0, 0.01 * uniform() * t);
      TwoBodies::set(h.rolling, 0, 0.01 * uniform() * t);
      h.twisting = choice.planar ? 0.0 : 0.1 * uniform();
    }
    list.add(i, j, k, kind, h);
  }
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
    ASSERT_LE(std::sqrt(apart2), rounding_of_builds * std::sqrt(length2)) << "history " << first;
  }
  ASSERT_NEAR(a.overlap(k), b.overlap(l), 1e-14);
  ASSERT_EQ(a.ended(k), b.ended(l));
}

// each part by its own size, or by what it is the sum of: contact k of a crowd now
inline void expect_same_parts(const Crowd &crowd, int k, const ContactParts &a,
                              const ContactParts &b, double tolerance)
{
  const auto c = crowd.list.constants_of(k);
  const double adheres = Magnitudes::pulloff_force(c), resists = crowd.damping_bound(k);
  const double slides = std::sqrt(norm2(TwoBodies::vec(b.sliding, 0)));
  auto same_vector = [k](const char *what, const double *u, const double *w, double limit) {
    const double apart = std::sqrt(norm2(TwoBodies::vec(u, 0) - TwoBodies::vec(w, 0)));
    ASSERT_LE(apart, limit) << what << " of contact " << k;
  };
  auto same = [k](const char *what, double u, double w, double limit) {
    ASSERT_LE(std::fabs(u - w), limit) << what << " of contact " << k;
  };
  auto of = [tolerance](double size) {
    return tolerance * std::fabs(size);
  };
  same("overlap", a.overlap, b.overlap, of(c.radius_sum));
  same("contact radius", a.contact_radius, b.contact_radius, of(b.contact_radius));
  same("elastic", a.elastic, b.elastic, of(std::fabs(b.elastic) + adheres));
  same("damping", a.damping, b.damping, of(resists));
  same_vector("sliding", a.sliding, b.sliding, of(slides));
  same_vector("rolling", a.rolling, b.rolling, of(std::sqrt(norm2(TwoBodies::vec(b.rolling, 0)))));
  same("twisting", a.twisting, b.twisting, of(b.twisting));
  same_vector("force", a.force, b.force, of(std::fabs(b.elastic) + adheres + resists + slides));
  same("elastic energy", a.elastic_energy, b.elastic_energy,
       of(std::fabs(b.elastic_energy) - adheres * c.break_overlap));
  // squares of lengths that agree to the tolerance
  same("sliding energy", a.sliding_energy, b.sliding_energy, of(2.0 * b.sliding_energy));
  same("rolling energy", a.rolling_energy, b.rolling_energy, of(2.0 * b.rolling_energy));
  same("twisting energy", a.twisting_energy, b.twisting_energy, of(2.0 * b.twisting_energy));
}

}    // namespace apf_test

#endif
