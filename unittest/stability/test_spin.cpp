// C11 of the list of hard cases: a doublet and chains of three and four spheres, with loaded
// springs, that spin about axes along, across and oblique to a contact, under velocity Verlet,
// stock r-RESPA and fix nve/sphere/mts. Springs turn with their pair, or they would change their
// length, make torque out of nothing and take energy. Bodies that are turned by force, with springs
// that are not at rest, are in the core's test_objectivity.cpp: fix move gives velocities of the
// end of a step, which are no slip at half of it, as contacts take them.

#include "integrators.h"
#include "necks.h"

#include <algorithm>
#include <array>

namespace {

using Vector = std::array<double, 3>;

double dot(const Vector &a, const Vector &b)
{
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
Vector cross(const Vector &a, const Vector &b)
{
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector sum(const Vector &a, const Vector &b, double times = 1.0)
{
  return {a[0] + times * b[0], a[1] + times * b[1], a[2] + times * b[2]};
}
Vector scaled(double times, const Vector &a)
{
  return sum({0.0, 0.0, 0.0}, a, times);
}
Vector unit(const Vector &a)
{
  return scaled(1.0 / std::sqrt(dot(a, a)), a);
}
std::vector<double> of(const Vector &a)
{
  return {a.begin(), a.end()};
}

const Material material;
const JkrCurve curve = material.pair();
const double mass = pi / 6.0, inertia = 0.1 * mass;    // of a sphere of diameter and density 1
const std::string undamped = "sliding 0.3 twisting yes rolling 0.5 ";
constexpr double width = 32.0;    // of the box
const Vector middle = {0.5 * width, 0.5 * width, 0.5 * width};

// spheres at the distance of rest, their centre of mass in the middle of the box
struct Chain {
  std::string name;
  std::vector<Vector> x;
  Vector along;    // the first contact

  Chain(const std::string &called, const std::vector<Vector> &directions) :
      name(called), x{{0.0, 0.0, 0.0}}, along(unit(directions[0]))
  {
    for (const auto &one : directions)
      x.push_back(sum(x.back(), unit(one), 1.0 - curve.delta_eq()));
    Vector mean{};
    for (const auto &one : x) mean = sum(mean, one, 1.0 / x.size());
    for (auto &one : x) one = sum(sum(one, mean, -1.0), middle);
  }
  std::vector<Sphere> spheres() const
  {
    std::vector<Sphere> all;
    for (const auto &one : x) all.push_back({one[0], one[1], one[2]});
    return all;
  }
};
const std::vector<Chain> chains = {{"doublet", {{1.0, 2.0, -0.5}}},
                                   {"bent chain", {{1.0, 0.2, 0.0}, {0.1, 1.0, 0.6}}}};

struct Axis {
  std::string name;
  Vector e;
};
std::vector<Axis> axes(const Chain &chain)
{
  const Vector n = chain.along, t = unit(cross(n, {0.3, 0.5, -0.8}));
  return {{"along", n}, {"across", t}, {"oblique", unit(sum(sum(n, t), cross(n, t)))}};
}

void build_chain(Simulation &sim, const Chain &chain, const std::string &law)
{
  Scene scene;
  const std::string side = "0 " + digits(width) + " ";
  scene.box = side + side + side;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + law + "\n";
  build(sim, chain.spheres(), scene);
  // boosted bodies fly 0.5 in a collision step: a wide skin saves lists
  sim.run("neighbor 6.0 bin\ncompute spin all erotate/sphere\n"
          "compute parts all pair granular/adhesive\n"
          "thermo_style custom step pe ke c_spin c_parts[2] c_parts[3] c_parts[4]\n"
          "thermo_modify norm no\nvariable E equal "
          "pe+ke+c_spin-" +    // what is boosted flies along x
          digits(0.5 * mass * static_cast<double>(chain.x.size())) +
          "*vcm(all,x)^2\n" + local_contacts);
}

// all three springs, far below their limits: every other sphere slips and turns, none moves
void preload(Simulation &sim, const Chain &chain)
{
  const Vector n = chain.along, t = cross(n, {0.3, 0.5, -0.8});
  const int all = static_cast<int>(chain.x.size());
  for (int i = 0; i < all; i++) {
    const double sign = i % 2 ? -1.0 : 1.0;
    set_motion(sim, i + 1, of(scaled(0.02 * sign, t)),
               of(scaled(sign, sum(scaled(0.1, n), t, 0.2))));
  }
  sim.run("run 64");
}

// turning as one body that flies at v; W: radians in a unit of time
void turn(Simulation &sim, const Chain &chain, const Vector &W, const Vector &v = {})
{
  for (int i = 0; i < static_cast<int>(chain.x.size()); i++)
    set_motion(sim, i + 1, of(sum(v, cross(W, sum(chain.x[i], middle, -1.0)))), of(W));
}

// sliding force, rolling and twisting torque of each contact, which are as their springs long
std::vector<double> springs(Simulation &sim)
{
  auto contacts = contacts_of(sim);
  std::sort(contacts.begin(), contacts.end(), [](const LocalRow &a, const LocalRow &b) {
    return a.a + a.b < b.a + b.b;
  });
  std::vector<double> all;
  for (const auto &[p, a, b] : contacts)
    for (const double size :
         {std::hypot(p[5], p[6], p[7]), std::hypot(p[8], p[9], p[10]), std::fabs(p[11])})
      all.push_back(size);
  return all;
}
// largest change of one, of it; those that are not loaded do not count
double change(const std::vector<double> &now, const std::vector<double> &before)
{
  if (now.size() != before.size() || before.empty()) return 1.0;
  double most = 0.0;
  for (size_t k = 0; k < now.size(); k++)
    if (before[k] > 1e-3) most = std::max(most, std::fabs(now[k] / before[k] - 1.0));
  return most;
}

Vector mean_velocity(Simulation &sim)
{
  const auto v = gather(sim, "v");
  Vector mean{};
  for (size_t i = 0; i < v.size(); i += 3)
    mean = sum(mean, {v[i], v[i + 1], v[i + 2]}, 3.0 / v.size());
  return mean;
}
// in the frame of the centre of mass, where it is the same about each point; spheres may have gone
// through the box's borders
Vector angular_momentum(Simulation &sim)
{
  const auto x = gather(sim, "x"), v = gather(sim, "v"), w = gather(sim, "omega");
  const Vector u = mean_velocity(sim);
  Vector L{};
  for (size_t i = 0; i < x.size(); i += 3) {
    Vector arm;
    for (size_t c = 0; c < 3; c++) {
      arm[c] = x[i + c] - x[c];
      arm[c] -= width * std::round(arm[c] / width);
    }
    L = sum(L, cross(arm, {v[i] - u[0], v[i + 1] - u[1], v[i + 2] - u[2]}), mass);
    L = sum(L, {w[i], w[i + 1], w[i + 2]}, inertia);
  }
  return L;
}
double energy(Simulation &sim)
{
  return sim.value("v_E");
}
double difference_of(const Vector &a, const Vector &b)
{
  const Vector d = sum(a, b, -1.0);
  return std::sqrt(dot(d, d) / dot(b, b));
}

const double W = 8.0;    // of all that spins

// The limit of 1e-5 for energy is that of the list, 1e-6 in a turn. Loaded springs swing; those of
// bodies that spin about their normal must be turned in the middle of the step, or they gain energy
// at a rate of first order in the step.
struct Trial {
  Chain chain;
  Axis axis;
  double boost;
};
void spin_freely(const std::vector<Trial> &trials)
{
  const int steps = static_cast<int>(2.0 * pi / W / dt);    // in a turn
  for (const auto &[chain, axis, boost] : trials)
    for (const auto &integrator : integrators) {
      Simulation sim;
      build_chain(sim, chain, undamped);
      preload(sim, chain);
      turn(sim, chain, scaled(W, axis.e), {boost, 0.0, 0.0});
      const int outer = steps / integrator.inner;
      const std::string n = std::to_string(outer);
      sim.run(integrator.commands(dt) + "reset_timestep 0\nthermo 1000000\nrun 0");
      for (const double one : springs(sim)) EXPECT_GT(one, 1e-3) << "springs are loaded";
      const Vector L = angular_momentum(sim);
      const double kinetic = energy(sim) - sim.value("pe");
      EXPECT_GT(sim.value("c_parts[2]") / kinetic, 1e-5) << "springs are loaded";
      sim.run("fix mean all ave/time 1 " + n + " " + n + " v_E\nrun " + n);
      const double first = sim.value("f_mean");
      sim.run("run " + std::to_string(9 * outer));
      const double gain = sim.value("f_mean") - first;
      const std::string what =
          ", free " + chain.name + " that spins " + axis.name + (boost > 0.0 ? ", boosted" : "");
      expect_criterion(integrator.of("C11 *: change of L in 10 turns" + what),
                       difference_of(angular_momentum(sim), L), 0.0, 1e-10);
      expect_criterion(
          integrator.of("C11 *: drift of mean energy in 10 turns, of the kinetic" + what),
          gain / kinetic, -1e-5, 1e-5);
    }
}

TEST(Spin, free_bodies_keep_angular_momentum_and_energy)
{
  std::vector<Trial> trials;
  for (const auto &chain : chains)
    for (const auto &axis : axes(chain)) trials.push_back({chain, axis, 0.0});
  spin_freely(trials);
}

// ... and what flies at 1024 times the speed of its rim, or more: a doublet all of whose springs
// turn about the normal, which lies near the way (the rounding of so large velocities tilts L, and
// the more so the farther it is from that), and the bent chain about all axes
TEST(Spin, free_bodies_that_fly_keep_angular_momentum_and_energy)
{
  const Chain nearly_along_x("doublet", {{1.0, 0.2, -0.1}}), &bent = chains[1];
  std::vector<Trial> trials = {{nearly_along_x, axes(nearly_along_x)[0], 1024.0 * 0.5 * W}};
  for (const auto &axis : axes(bent)) trials.push_back({bent, axis, 8192.0});
  spin_freely(trials);
}

// Damped, a chain that spins about its axis of largest inertia comes to turn as one body, in which
// springs bear what bends it: these keep their length. Returns them.
std::vector<double> spin_to_rest(const Integrator &integrator, const Chain &chain, const Axis &axis,
                                 const std::string &damping, bool preloaded, double boost)
{
  const int outer = static_cast<int>(2.0 * pi / W / dt) / integrator.inner;    // steps in a turn
  Simulation sim;
  build_chain(sim, chain, damping + undamped + "0.3 ");
  if (preloaded) preload(sim, chain);
  turn(sim, chain, scaled(W, axis.e), {boost, 0.0, 0.0});
  sim.run(integrator.commands(dt) + "run " + std::to_string(8 * outer));
  auto before = springs(sim);
  const Vector L = angular_momentum(sim);
  const double E = energy(sim), kinetic = E - sim.value("pe");
  double most = 0.0;
  for (int n = 0; n < 10; n++) {
    sim.run("run " + std::to_string(outer));
    most = std::max(most, change(springs(sim), before));
  }
  const std::string what = " in 10 turns, " + chain.name + " loaded by its spin about " +
      axis.name + (boost > 0.0 ? ", boosted" : "");
  expect_criterion(integrator.of("C11 *: change of the length of springs" + what), most, 0.0, 1e-6);
  expect_criterion(integrator.of("C11 *: change of L" + what),
                   difference_of(angular_momentum(sim), L), 0.0, 1e-10);
  expect_criterion(integrator.of("C11 *: drift of energy" + what + ", of the kinetic"),
                   (energy(sim) - E) / kinetic, -1e-5, 1e-5);
  return before;
}
const std::vector<Axis> about = {
    {"z", {0.0, 0.0, 1.0}}, {"x", {1.0, 0.0, 0.0}}, {"an oblique axis", unit({1.0, -0.4, 0.7})}};

// A bent chain, in the plane of turning: springs of sliding and rolling
TEST(Spin, springs_that_bear_the_load_of_the_spin_keep_their_length)
{
  for (const auto &axis : about) {
    const Vector e = unit(cross(axis.e, {0.3, 0.5, -0.8}));
    const Chain chain("bent chain", {e, sum(scaled(0.3, e), cross(axis.e, e), 0.95)});
    for (const auto &integrator : integrators)
      for (const double boost : {0.0, 8192.0}) {
        const auto loads = spin_to_rest(integrator, chain, axis, "damping tsuji 0.5 ", true, boost);
        EXPECT_GT(loads[0], 1.0) << "sliding";
        EXPECT_GT(loads[1], 1.0) << "rolling";
      }
  }
}

// A chain of four whose ends stand out of that plane, both to the same side: it is the same after
// half a turn, and so the axis stays its own. The twisting spring amid it bears the lever of the
// ends; its dashpot is so weak that it takes much damping to bring it to rest.
TEST(Spin, twisting_spring_that_bears_the_load_of_the_spin_keeps_its_length)
{
  const Axis &axis = about[2];
  const Vector e = unit(cross(axis.e, {0.3, 0.5, -0.8})),
               side = sum(scaled(0.3, e), cross(axis.e, e), 0.95);
  const Chain chain("twisted chain", {sum(side, axis.e, 0.06), e, sum(side, axis.e, -0.06)});
  for (const auto &integrator : integrators)
    for (const double boost : {0.0, 8192.0}) {
      const auto loads = spin_to_rest(integrator, chain, axis, "damping alpha 10 ", false, boost);
      EXPECT_GT(loads[5], 1.0) << "twisting, of the second contact";
    }
}

}    // namespace
