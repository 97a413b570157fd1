// The kernel as a machine: blocks, parts, lists, energy, walls.

#include "contact_crowd.h"
#include "scalar_kernel.h"

using namespace apf;
using namespace apf_test;

namespace {

constexpr int all_submodels = 15;

// Every build and the law taken contact by contact. Several steps, so that springs slip and normals
// turn; the contacts end, slip and remember alike, and tell the same of themselves.
void expect_builds_agree(const Crowd &crowd)
{
  const int size = crowd.list.size();
  std::vector<ContactParts> told(size), expected(size);
  for (const auto &build : kernel_builds()) {
    SCOPED_TRACE(build.name);
    const auto kernel = build.kernel(crowd.choice);
    Crowd blocks = crowd, scalar = crowd;
    for (const double dt : {0.0, 0.01, 0.02}) {
      const Magnitudes scale(scalar, dt);
      Crowd asked = blocks;    // by code of its own
      asked.evaluate(kernel, dt, told.data());
      const int ended = blocks.evaluate(kernel, dt);
      EXPECT_EQ(scalar.evaluate(scalar_kernel(scalar.choice), dt, expected.data()), ended);
      int counted = 0;
      for (int k = 0; k < size; k++) counted += scalar.list.ended(k);
      EXPECT_EQ(ended, counted);
      expect_same_loads(blocks, scalar, scale, rounding_of_builds);
      for (int k = 0; k < size; k++) {
        expect_same_contact(blocks.list, k, scalar.list, k);
        expect_same_parts(scalar, k, told[k], expected[k], rounding_of_builds);
      }
    }
  }
}

void expect_some_to_end(Crowd crowd)
{
  const int ended = crowd.evaluate(scalar_kernel(crowd.choice), 0.0);
  EXPECT_GT(ended, 0);
  EXPECT_LT(ended, crowd.list.size());
}

}    // namespace

TEST(Kernel, block_of_contacts_equals_one_contact_at_a_time)
{
  for (int submodels = 0; submodels < 32; submodels++)
    for (int size = 1; size <= 20; size++) {
      Crowd together(size, submodels, 100 * submodels + size), alone = together;
      const Magnitudes scale(together, 0.01);
      together.evaluate(0.01);
      alone.evaluate_one_by_one(0.01);
      SCOPED_TRACE(testing::Message() << "sub-models " << submodels << " contacts " << size);
      expect_same_loads(together, alone, scale, 1e-13);
      for (int k = 0; k < size; k++) expect_same_contact(together.list, k, alone.results[k], 0);
      if (size > 5) {    // fewer may all be beyond their necks
        EXPECT_GT(largest(together.f), 0.0);
      }
    }
}

TEST(Kernel, every_build_agrees_with_the_law_taken_contact_by_contact)
{
  for (int submodels = 0; submodels < 32; submodels++)
    for (const int size : {1, 7, 8, 9, 50, 203}) {
      SCOPED_TRACE(testing::Message() << "sub-models " << submodels << " contacts " << size);
      const Crowd crowd(size, submodels, 1000 * submodels + size);
      expect_builds_agree(crowd);
      if (size > 100) expect_some_to_end(crowd);
    }
}

// As in most scenes: constants stay in registers from one group of contacts to the next, where they
// are of the same kinds, in whole groups and incomplete ones.
TEST(Kernel, every_build_agrees_where_contacts_are_of_few_kinds)
{
  for (int submodels = 0; submodels < 32; submodels++)
    for (const int size : {16, 50, 203})
      for (const auto &[kinds, run] : {std::pair(1, 1), {2, 1}, {2, 3}, {2, 16}, {2, 37}}) {
        SCOPED_TRACE(testing::Message() << "sub-models " << submodels << " contacts " << size
                                        << " kinds " << kinds << " in runs of " << run);
        const auto crowd = Crowd::of_kinds(kinds, run, size, submodels, 1000 * submodels + size);
        expect_builds_agree(crowd);
        if (size > 100) expect_some_to_end(crowd);
      }
}

TEST(Kernel, build_is_chosen_from_those_of_this_processor)
{
  const KernelChoice choice;
  int matches = 0;
  for (const auto &build : kernel_builds())
    matches += build.kernel(choice) == contact_kernel(choice);
  EXPECT_STREQ(kernel_builds().front().name, "baseline");
  EXPECT_EQ(matches, 1);
}

// the tests here compare the builds that this processor can run: it says which others there are
TEST(Kernel, every_build_runs_here)
{
  std::string missing;
  for (const std::string name : {"baseline", "avx2", "avx512"}) {
    bool there = false;
    for (const auto &build : kernel_builds()) there |= name == build.name;
    if (!there) missing += " " + name;
  }
  EXPECT_EQ(missing.find("baseline"), std::string::npos);
  if (!missing.empty()) GTEST_SKIP() << "not compared, for want of the instructions:" << missing;
}

TEST(Kernel, asking_for_parts_changes_nothing)
{
  for (const auto &build : kernel_builds())
    for (const int submodels : {all_submodels, all_submodels + 16}) {
      SCOPED_TRACE(testing::Message() << build.name << submodels);
      Crowd quiet(19, submodels, 3), asked = quiet;
      const Magnitudes scale(quiet, 0.01);
      const auto kernel = build.kernel(quiet.choice);
      std::vector<ContactParts> parts(19);
      EXPECT_EQ(asked.evaluate(kernel, 0.01, parts.data()), quiet.evaluate(kernel, 0.01));
      expect_same_loads(asked, quiet, scale, 1e-13);
      for (int k = 0; k < 19; k++) expect_same_contact(asked.list, k, quiet.list, k);
    }
}

// Many of these contacts slip, and those without a history have no normal yet.
TEST(Kernel, a_look_leaves_histories_as_they_are)
{
  for (const auto &build : kernel_builds())
    for (const int submodels : {all_submodels, all_submodels + 16}) {
      Crowd crowd(19, submodels, 5);
      const ContactList before = crowd.list;
      auto changed = [&] {
        int n = 0;
        for (int k = 0; k < before.size(); k++)
          n += numbers(crowd.list.history_of(k)) != numbers(before.history_of(k));
        return n;
      };
      crowd.evaluate(build.kernel(crowd.choice), 0.0);
      EXPECT_EQ(changed(), 0) << build.name << submodels;
      crowd.evaluate(build.kernel(crowd.choice), 0.01);
      EXPECT_GT(changed(), 10) << build.name << submodels;
    }
}

TEST(Kernel, parts_add_up_to_the_force)
{
  for (const auto &build : kernel_builds())
    for (const int submodels : {all_submodels, all_submodels + 16}) {
      SCOPED_TRACE(testing::Message() << build.name << submodels);
      Crowd crowd(20, submodels, 4);
      const Magnitudes scale(crowd, 0.01);
      std::vector<ContactParts> parts(20);
      crowd.evaluate(build.kernel(crowd.choice), 0.01, parts.data());
      std::vector<double> f(crowd.f.size());
      for (int k = 0; k < 20; k++) {
        const int i = crowd.list.i[k], j = crowd.list.j[k];
        const Vec3 d = TwoBodies::vec(crowd.x.data(), j) - TwoBodies::vec(crowd.x.data(), i);
        const Vec3 n = (1.0 / std::sqrt(norm2(d))) * d;
        const ContactParts &p = parts[k];
        const Vec3 sum = TwoBodies::vec(p.sliding, 0) - (p.elastic + p.damping) * n;
        const double size = std::fabs(p.elastic) + std::fabs(p.damping);
        EXPECT_LE(std::sqrt(norm2(sum - TwoBodies::vec(p.force, 0))), 1e-13 * size);
        EXPECT_NEAR(dot(TwoBodies::vec(p.sliding, 0), n), 0.0, 1e-13 * (size + 1.0));
        EXPECT_NEAR(dot(TwoBodies::vec(p.rolling, 0), n), 0.0, 1e-13 * (size + 1.0));
        EXPECT_EQ(p.overlap, crowd.list.overlap(k));
        for (int c = 0; c < 3; c++) {
          f[3 * i + c] += p.force[c];
          f[3 * j + c] -= p.force[c];
        }
      }
      expect_same(f, crowd.f, scale.force, 1e-13);
    }
}

TEST(Kernel, forces_are_added_to_what_is_there)
{
  Crowd crowd(12, all_submodels, 5), again = crowd;
  crowd.evaluate(0.0);
  Bodies bodies;
  bodies.resize(Crowd::bodies);
  for (int b = 0; b < Crowd::bodies; b++) {
    bodies.place(b, &again.x[3 * b]);
    bodies.set_motion(b, &again.v[3 * b], &again.omega[3 * b]);
    const double f[3] = {3.0, 3.0, 3.0}, torque[3] = {-2.0, -2.0, -2.0};
    bodies.add_load(b, f, torque);
  }
  contact_kernel(again.choice)(again.list, bodies, {0.0, 0.0, 0.0}, nullptr);
  for (int b = 0; b < Crowd::bodies; b++)
    bodies.add_load_to(b, &again.f[3 * b], &again.torque[3 * b]);
  for (size_t c = 0; c < crowd.f.size(); c++) {
    EXPECT_NEAR(again.f[c] - 3.0, crowd.f[c], 1e-13 * largest(crowd.f));
    EXPECT_NEAR(again.torque[c] + 2.0, crowd.torque[c], 1e-13 * largest(crowd.f));
  }
}

TEST(Kernel, contact_beyond_its_neck_exerts_nothing_and_has_ended)
{
  for (const double gamma : {0.12, 0.0}) {
    ContactModel model = sticky_model();
    model.surface.gamma = gamma;
    model.mu = 0.3;
    model.twisting = true;
    model.theta_crit = 0.01;
    model.alpha = model.zeta = 0.3;
    auto two = TwoBodies::spheres(model, 4.0e-6, 4.0e-6);
    for (const double beyond : {1e-9, 1e-3, 10.0}) {
      const double scale = gamma > 0.0 ? two.pulloff_overlap() : 1.0e-9;
      two.place(-two.pulloff_overlap() - beyond * scale);
      for (double *u : {two.v, two.omega}) std::fill(u, u + 3, 1.0);
      two.contact_forces(1.0e-9);
      for (int c = 0; c < 6; c++) {
        EXPECT_EQ(two.f[c], 0.0);
        EXPECT_EQ(two.torque[c], 0.0);
      }
      EXPECT_TRUE(two.list.ended(0));
      EXPECT_EQ(two.parts.elastic_energy, 0.0);
    }
    two.place(-two.pulloff_overlap() * (1.0 - 1e-12) + (gamma > 0.0 ? 0.0 : 1e-12));
    two.contact_forces(0.0);
    EXPECT_FALSE(two.list.ended(0));
  }
}

TEST(ContactList, removal_keeps_the_others)
{
  Crowd crowd(11, all_submodels, 8);
  const ContactList all = crowd.list;
  for (const int gone : {10, 0, 4, 4, 1}) crowd.list.remove(gone);
  ASSERT_EQ(crowd.list.size(), 6);
  for (int k = 0; k < crowd.list.size(); k++) {
    const int was = crowd.list.source[k];    // the mark that it was added with
    EXPECT_EQ(crowd.list.i[k], all.i[was]);
    EXPECT_EQ(crowd.list.j[k], all.j[was]);
    EXPECT_EQ(crowd.list.constants_of(k).eta, all.constants_of(was).eta);
    EXPECT_EQ(crowd.list.constants_of(k).break_overlap, all.constants_of(was).break_overlap);
    expect_same_contact(crowd.list, k, all, was);
    for (int l = 0; l < k; l++) EXPECT_NE(crowd.list.source[l], was);
  }
  crowd.list.clear();
  EXPECT_EQ(crowd.list.size(), 0);
  crowd.evaluate(0.01);
  EXPECT_EQ(largest(crowd.f), 0.0);
}

TEST(ContactList, history_seen_twice_from_the_other_side_is_itself)
{
  Crowd crowd(1, all_submodels, 2);
  ContactHistory h = crowd.list.history_of(0);
  h.sliding[1] = 0.3;
  h.rolling[2] = -0.2;
  h.twisting = 0.7;
  h.normal[0] = 1.0;
  for (const bool planar : {false, true})
    EXPECT_EQ(numbers(h.swapped(planar).swapped(planar)), numbers(h));
}

TEST(Energy, of_an_undamped_doublet_does_not_drift)
{
  auto two = TwoBodies::spheres(sticky_model(), 4.0e-6, 4.0e-6);
  two.place(two.equilibrium_overlap() + 0.2 * two.pulloff_overlap());
  two.contact_forces(0.0);
  auto energy = [&two] {
    return two.kinetic_energy() + two.parts.elastic_energy;
  };
  // the well is 1.542585 F_C delta_C deep; the oscillation has about 0.02 of it
  const double scale = two.pulloff_force() * two.pulloff_overlap();
  const double dt = 0.1 * std::sqrt(two.bodies.m * two.pulloff_overlap() / two.pulloff_force());
  const int n = 100000, window = 5000;
  double first = 0.0, last = 0.0;
  for (int k = 0; k < n; k++) {
    two.step(dt);
    ASSERT_FALSE(two.ended());
    if (k < window) first += energy() / window;
    if (k >= n - window) last += energy() / window;
  }
  EXPECT_NEAR((last - first) / (0.02 * scale), 0.0, 1e-4);
}

// With h = a/a0 JKR's energy is 4 6^(1/3) F_C delta_C (4/5 h^5 - 4/3 h^(7/2) + 1/3 h^2), 0 where
// nothing touches (Chokshi, Tielens, Hollenbach, doi:10.1086/172562): at rest h = 1, at the end of
// the neck h = 6^(-2/3).
TEST(Energy, of_a_neck_at_rest_and_at_its_end)
{
  for (const auto &build : kernel_builds())
    for (const bool planar : {false, true}) {
      SCOPED_TRACE(testing::Message() << build.name << " planar " << planar);
      auto two = TwoBodies::spheres(sticky_model(), 4.0e-6, 6.0e-6);
      two.live_in_plane(planar);
      KernelChoice choice;
      choice.planar = planar;
      choice.include(two.model);
      two.kernel = build.kernel(choice);
      const double unit = two.pulloff_force() * two.pulloff_overlap();
      two.place(two.equilibrium_overlap());
      two.contact_forces(0.0);
      EXPECT_NEAR(two.parts.contact_radius / two.a0(), 1.0, 1e-12);
      EXPECT_NEAR(two.parts.elastic_energy / unit, -0.8 * std::cbrt(6.0), 1e-12);
      two.place(-two.pulloff_overlap() * (1.0 - 1e-13));
      two.contact_forces(0.0);
      EXPECT_NEAR(two.parts.contact_radius / two.a0(), std::pow(6.0, -2.0 / 3.0), 1e-6);
      EXPECT_NEAR(two.parts.elastic_energy / unit, 4.0 / 45.0, 1e-12);
    }
}

TEST(Energy, of_springs_is_the_work_that_loads_them)
{
  ContactModel model = sticky_model();
  model.mu = 0.3;
  model.twisting = true;
  model.theta_crit = 0.02;
  auto two = TwoBodies::spheres(model, 4.0e-6, 4.0e-6);
  two.place(two.equilibrium_overlap());
  const double slip = 1.0e-10, twist = 1.0e-4, roll = 1.0e-3;
  two.v[1] = slip;
  two.omega[0] = twist;
  two.omega[2] = 0.5 * roll;
  two.omega[5] = -0.5 * roll;
  two.contact_forces(1.0);
  for (double *u : {two.v, two.omega}) std::fill(u, u + 6, 0.0);
  two.contact_forces(1.0);
  EXPECT_NEAR(two.parts.sliding_energy / (-0.5 * two.f[1] * slip), 1.0, 1e-6);
  EXPECT_NEAR(two.parts.twisting_energy / (-0.5 * two.torque[0] * twist), 1.0, 1e-9);
  EXPECT_NEAR(two.parts.rolling_energy / (-0.5 * two.parts.rolling[2] * roll), 1.0, 1e-9);
}

TEST(Wall, is_a_sphere_of_a_million_radii)
{
  ContactModel model;
  model.surface = {5.0e10, 1.2e10, 0.02};
  model.mu = 0.3;
  model.twisting = true;
  model.theta_crit = 0.01;
  model.alpha = 0.2;
  const double r = 5.0e-6;
  auto wall = TwoBodies::at_wall(model, r), sphere = TwoBodies::spheres(model, r, 1.0e6 * r);
  sphere.mass[1] = sphere.inertia[1] = 0.0;
  const double V = 5.0 * wall.sticking_speed();
  for (TwoBodies *two : {&wall, &sphere}) {
    two->place(0.0);
    TwoBodies::set(two->v, 0, {V, 0.7 * V, -0.2 * V});
    TwoBodies::set(two->omega, 0, {0.1 * V / r, 0.2 * V / r, -0.3 * V / r});
  }
  const double dt = wall.contact_time(V) / 1000;
  const Rebound a = collide(wall, dt), b = collide(sphere, dt);
  EXPECT_GT(a.restitution, 0.1);
  EXPECT_NEAR(b.restitution / a.restitution, 1.0, 1e-3);
  EXPECT_NEAR(b.max_force / a.max_force, 1.0, 1e-3);
  EXPECT_NEAR(b.max_overlap / a.max_overlap, 1.0, 1e-3);
  for (int c = 0; c < 3; c++) {
    EXPECT_NEAR((wall.v[c] - sphere.v[c]) / V, 0.0, 1e-3) << c;
    EXPECT_NEAR((wall.omega[c] - sphere.omega[c]) * r / V, 0.0, 2e-3) << c;
  }
}

TEST(Wall, of_lower_radius_is_a_large_sphere)
{
  ContactModel model = sticky_model();
  model.alpha = 0.2;
  const double r = 5.0e-6;
  for (const double ratio : {100.0, 1000.0}) {
    auto wall = TwoBodies::at_wall(model, r), sphere = TwoBodies::spheres(model, r, ratio * r);
    wall.bodies.R = r / (1.0 + 1.0 / ratio);
    wall.constants = ContactConstants::make(model, wall.bodies);
    sphere.bodies.m = wall.bodies.m;    // held
    sphere.constants = ContactConstants::make(model, sphere.bodies);
    sphere.mass[1] = 0.0;
    EXPECT_NEAR(sphere.normal().equilibrium_radius() / wall.a0(), 1.0, 1e-9) << ratio;
    const double V = 4.0 * wall.sticking_speed(), dt = wall.contact_time(V) / 1000;
    for (TwoBodies *two : {&wall, &sphere}) {
      two->place(0.0);
      two->v[0] = V;
    }
    const Rebound a = collide(wall, dt), b = collide(sphere, dt);
    EXPECT_GT(a.restitution, 0.1);
    EXPECT_NEAR(b.restitution / a.restitution, 1.0, 1e-3) << ratio;
    EXPECT_NEAR(b.max_force / a.max_force, 1.0, 1e-3) << ratio;
  }
}
