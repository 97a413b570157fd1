// Contacts of pair granular/adhesive while particles change place, index, rank and run: a contact
// knows nothing of that, so forces equal those of a twin to which nothing of it happens.

#include "integrators.h"

namespace {

const Material material;
constexpr double tight = 1.0e-12;
const std::vector<std::string> both = {"on", "off"};

// A tilted doublet at an overlap; its first sphere, the one of lower index, lies above, so that the
// neighbour list has it as i within a bin and as j across bins.
std::vector<Sphere> doublet(double overlap, double x = 3.0, double y = 3.0, double z = 3.0)
{
  const double distance = 1.0 - overlap;
  return {{snap(x + 0.48 * distance), snap(y + 0.64 * distance), snap(z + 0.6 * distance)},
          {x, y, z}};
}

// sliding, rolling and twisting springs, none at its limit
void preload(Simulation &sim)
{
  const std::vector<double> n = {0.48, 0.64, 0.6}, t = {0.8, -0.6, 0.0};
  std::vector<double> v(3), spin(3), opposite(3);
  for (int c = 0; c < 3; c++) {
    v[c] = 0.05 * t[c];
    spin[c] = 0.1 * n[c] + 0.4 * t[c];
    opposite[c] = -spin[c];
  }
  load_springs(sim, 64, v, spin, opposite);
}

const double squeezed = 1.5 * material.pair().delta_eq();

// ---------------------------------------------------------------------------------------------
// springs have the length that the slip gives them

TEST(RanksContactHistory, springs_have_the_length_of_the_slip)
{
  for (const auto &newton : both) {
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    // along x: slip along y, twist about x, rolling about z
    const double overlap = squeezed;
    build(sim, {{3.0, 3.0, 3.0}, {4.0 - overlap, 3.0, 3.0}}, scene);
    load_springs(sim, 64, {0.0, 0.05, 0.0}, {0.1, 0.0, 0.4}, {-0.1, 0.0, -0.4});
    sim.run("run 0");
    const double t = 64 * dt, a = material.pair().a(overlap), kt = 8.0 * material.G_eff() * a;
    const auto f = gather(sim, "f"), torque = gather(sim, "torque");
    EXPECT_NEAR(f[0] / -material.pair().force(overlap), 1.0, 1e-9) << newton;
    EXPECT_NEAR(f[1] / (-kt * 0.05 * t), 1.0, 1e-9);
    EXPECT_NEAR(f[3] / -f[0], 1.0, tight);
    EXPECT_NEAR(f[4] / -f[1], 1.0, tight);
    EXPECT_NEAR(torque[0] / (-0.5 * kt * a * a * 0.2 * t), 1.0, 1e-9) << "twisting";
    EXPECT_NEAR(torque[3] / -torque[0], 1.0, tight);
    // rolling: v_L = -R (Om_i - Om_j) x n, its moment opposes the relative spin
    const double rolling = -material.pair().rolling(overlap) * 0.25 * 0.8 * t;
    const double arm = 0.5 * (1.0 - overlap);
    EXPECT_NEAR((torque[2] - arm * f[1]) / rolling, 1.0, 1e-9);
    EXPECT_NEAR((torque[5] - arm * f[1]) / -rolling, 1.0, 1e-9);
  }
}

// ---------------------------------------------------------------------------------------------
// i and j change places: the lower one in a bin is i within a bin, the one in the lower bin across

struct Tumble {
  std::string newton = "on", neighbors = "neigh_modify delay 0 every 1 check no binsize 1.7",
              before, motion = "fix move all move rotate 4 4 4 5 0 -4 0.125 units box\nrun 2500";
};

State tumbled(const Tumble &tumble)
{
  Simulation sim;
  Scene scene;
  scene.newton = tumble.newton;
  scene.before = tumble.before;
  build(sim, doublet(squeezed, 3.75, 3.6875, 3.71875), scene);
  sim.run(tumble.neighbors);
  preload(sim);
  sim.run(tumble.motion);
  return state_of(sim);
}

std::vector<double> exchanged(const std::vector<double> &a)
{
  return {a[3], a[4], a[5], a[0], a[1], a[2]};
}

void expect_rebuilds_change_nothing(Tumble tumble, double tolerance)
{
  const std::string often = tumble.neighbors;
  tumble.neighbors = "neighbor 2.0 bin\nneigh_modify delay 1000000 every 1000000 check no";
  const State reference = tumbled(tumble);
  ASSERT_GT(largest(reference.torque), 0.5);    // springs are loaded
  tumble.neighbors = often;
  for (const auto &newton : both)
    for (const std::string &sort : {std::string(), std::string("atom_modify sort 1 1.0")}) {
      tumble.newton = newton;
      tumble.before = sort;
      SCOPED_TRACE(newton + " " + sort);
      const State state = tumbled(tumble);
      expect_same_loads(state, reference, tolerance);
      EXPECT_LT(difference(state.x, reference.x), tolerance);
    }
}

TEST(RanksContactHistory, tumbling_doublet_is_the_same_without_rebuild)
{
  expect_rebuilds_change_nothing(Tumble(), tight);
}

// springs turn the spheres as well, so that rounding of 1e-16 in positions grows
TEST(RanksContactHistory, tumbling_free_doublet_is_the_same_without_rebuild)
{
  Tumble freely;
  freely.motion = "set atom 1 vx 5 vy -4 omega 0 0 10\nset atom 2 vx -5 vy 4 omega 0 0 10\n"
                  "fix nve all nve/sphere\nrun 2000";
  expect_rebuilds_change_nothing(freely, 1e-7);
}

TEST(RanksContactHistory, renumbered_atoms_feel_the_same)
{
  // the springs must be loaded with the same slip: sphere 1 of this twin is sphere 2 of the other
  auto loads = [](const std::vector<int> &ids) {
    Simulation sim;
    Scene scene;
    scene.ids = ids;
    build(sim, doublet(squeezed), scene);
    const bool flipped = ids[0] == 2;
    const std::vector<double> v = {0.04, -0.03, 0.0}, spin = {0.37, -0.18, 0.06};
    std::vector<double> opposite;
    for (double s : spin) opposite.push_back(-s);
    const std::vector<double> rest(3, 0.0);
    set_motion(sim, flipped ? 2 : 1, v, spin);
    set_motion(sim, flipped ? 1 : 2, rest, opposite);
    sim.run("run 64");
    set_motion(sim, 1, rest, rest);
    set_motion(sim, 2, rest, rest);
    sim.run("run 1");
    return state_of(sim);
  };
  const State straight = loads({1, 2});
  State flipped = loads({2, 1});
  ASSERT_GT(largest(straight.torque), 0.1);
  flipped.f = exchanged(flipped.f);
  flipped.torque = exchanged(flipped.torque);
  expect_same_loads(flipped, straight, tight);
}

// ---------------------------------------------------------------------------------------------
// C9: a neck at -0.9 delta_C is never lost, whatever the skin, boundary or size ratio

void expect_neck_kept(const std::vector<Sphere> &spheres, const Scene &scene, int steps)
{
  Simulation sim;
  build(sim, spheres, scene);
  const double d1 = spheres[0].d, d2 = spheres[1].d;
  const auto curve = material.pair(d1, d2);
  // the contact is made at an overlap, then stretched along x to -0.9 delta_C
  const double stretch =
      snap(spheres[1].x + (spheres[0].x + 0.5 * (d1 + d2) + 0.9 * curve.delta_C() - spheres[1].x)) -
      spheres[1].x;
  char line[256];
  sim.run("neighbor 1e-6 bin\nneigh_modify delay 0 every 1 check no\nrun 0");
  snprintf(line, sizeof(line),
           "group second id 2\ngroup first id 1\nfix a second move linear %.17g 0 0 units box\n"
           "fix b first move linear 0 0 0 units box\nrun 64\nunfix a\n"
           "velocity all set 0 0 0\nfix a second move linear 0 0 0 units box\nrun 1",
           stretch / (64 * dt));
  sim.run(line);
  const auto first = gather(sim, "f");
  EXPECT_NEAR(std::fabs(first[0]) / curve.F_C(), 0.830926, 1e-4);    // table A5
  sim.run("run " + std::to_string(steps));
  const auto last = gather(sim, "f");
  expect_criterion(
      "C9 styles: change of force of a neck at -0.9 delta_C through lists, borders and "
      "ranks, of it",
      difference(last, first), 0.0, tight);
  EXPECT_GT(first[0], 0.0);    // pulled towards the second
  EXPECT_LT(last[3], 0.0);
}

TEST(RanksContactHistory, neck_is_kept_through_rebuilds)
{
  for (const auto &newton : both) {
    Scene scene;
    scene.newton = newton;
    expect_neck_kept({{3.0, 3.0, 3.0}, {snap(3.99), 3.0, 3.0}}, scene,
                     number_of_ranks() == 1 ? 10000 : 1000);
    expect_neck_kept({{3.0, 3.0, 3.0, 2.0}, {snap(4.095), 3.0, 3.0, 0.2}}, scene, 500);
    // across the periodic boundary (positions beyond the box are wrapped) and the ranks' one
    expect_neck_kept({{snap(7.6), 3.0, 3.0}, {snap(8.59), 3.0, 3.0}}, scene, 500);
    expect_neck_kept({{snap(3.6), 3.99, 4.0}, {snap(4.59), 3.99, 4.0}}, scene, 500);
  }
}

// ---------------------------------------------------------------------------------------------
// C10: loaded springs on a journey through cells, ranks and the periodic boundary

State interior_twin(double overlap)
{
  Simulation sim;
  build(sim, doublet(overlap));
  preload(sim);
  sim.run("run 1");
  return state_of(sim);
}

void expect_unchanged(const std::string &way, const State &now, const State &twin,
                      const std::string &case_of = "C10 styles")
{
  expect_same_loads(now, twin, tight);
  expect_criterion(case_of + ": change of force and torque " + way + ", of them",
                   std::max(difference(now.f, twin.f), difference(now.torque, twin.torque)), 0.0,
                   tight);
}

State travelled(double overlap, const Scene &scene, const std::string &commands,
                const std::string &velocity)
{
  Simulation sim;
  build(sim, doublet(overlap), scene);
  preload(sim);
  sim.run(commands);
  sim.run("fix mv all move linear " + velocity + " units box\nrun 2200");
  return state_of(sim);
}

TEST(RanksContactHistory, springs_travel_through_periodic_cells_and_ranks)
{
  const State twin = interior_twin(squeezed);
  ASSERT_GT(largest(twin.torque), 0.1);
  const std::string often =
      "neighbor 0.125 bin\nneigh_modify delay 0 every 1 check yes binsize 2\n";
  for (const auto &newton : both)
    for (const char *velocity : {"64 32 16", "-32 -64 128"}) {
      Scene scene;
      scene.newton = newton;
      SCOPED_TRACE(newton + " " + velocity);
      expect_unchanged("through cells and ranks", travelled(squeezed, scene, often, velocity),
                       twin);
      scene.before = "atom_modify sort 7 1.0";
      expect_unchanged("through cells and ranks", travelled(squeezed, scene, often, velocity),
                       twin);
    }
}

TEST(RanksContactHistory, springs_travel_with_respa_too)
{
  const State twin = interior_twin(squeezed);
  expect_unchanged("through cells and ranks",
                   travelled(squeezed, Scene(),
                             "neighbor 0.125 bin\nneigh_modify delay 0 every 1 check no binsize 2\n"
                             "run_style respa 2 4 pair 1\n",
                             "64 32 16"),
                   twin, "C10 respa");
}

// Free, so that the springs turn the spheres: beside a pair that moves as fast within a wide box,
// and beside one that stands, whose positions round otherwise.
TEST(RanksContactHistory, springs_travel_with_mts_too)
{
  const auto moved = [](double u, const std::string &box = Scene().box) {
    Simulation sim;
    Scene scene;
    scene.box = box;
    build(sim, doublet(squeezed), scene);
    preload(sim);
    for (int id : {1, 2}) set_motion(sim, id, {u, 0.5 * u, 0.25 * u}, {0.0, 0.0, 0.0});
    sim.run("neighbor 0.5 bin\nfix nve all nve/sphere/mts collision 4\nrun 550");
    return state_of(sim);
  };
  const State twin = moved(0.0);
  ASSERT_GT(largest(twin.torque), 0.1);
  const std::string what =
      "C10 mts: change of force and torque through cells and ranks, free, beside a pair ";
  const auto change = [](const State &now, const State &other) {
    return std::max(difference(now.f, other.f), difference(now.torque, other.torque));
  };
  for (double u : {64.0, -64.0}) {
    const State wide = moved(u, u > 0.0 ? "0 32 0 32 0 32" : "-32 8 -32 8 -32 8");
    expect_criterion(what + "as fast in a wide box, of them", change(moved(u), wide), 0.0, 1e-12);
  }
  const double most = std::max(change(moved(64.0), twin), change(moved(-128.0), twin));
  expect_unmet(what + "that stands, of them", most, 0.0, 1e-12, 1e-10,
               "positions round otherwise; beside one as fast no bit differs");
}

TEST(RanksContactHistory, springs_travel_along_each_decomposition)
{
  const State twin = interior_twin(squeezed);
  const std::string n = std::to_string(number_of_ranks());
  const std::string every_step =
      "neighbor 0.125 bin\nneigh_modify delay 0 every 1 check no binsize 2\n";
  for (const std::string &processors : {n + " 1 1", "1 " + n + " 1", "1 1 " + n}) {
    Scene scene;
    scene.processors = processors;
    SCOPED_TRACE(processors);
    expect_unchanged("along each division into ranks",
                     travelled(squeezed, scene, every_step, "64 64 64"), twin);
  }
}

TEST(RanksContactHistory, springs_travel_through_a_tiled_decomposition)
{
  const State twin = interior_twin(squeezed);
  for (const auto &newton : both) {
    Scene scene;
    scene.newton = newton;
    const std::string tiled = "comm_style tiled\ncomm_modify vel yes\nneighbor 0.125 "
                              "bin\nneigh_modify delay 0 every 1 check no binsize 2\n"
                              "fix rcb all balance 50 1.0 rcb\n";
    SCOPED_TRACE(newton);
    expect_unchanged("through tiles", travelled(squeezed, scene, tiled, "64 32 16"), twin);
  }
}

// C9
TEST(RanksContactHistory, stretched_necks_travel_too)
{
  // loaded at an overlap, so the contact is there; the twin is stretched in the same way
  auto loads = [](const std::string &velocity) {
    Simulation sim;
    build(sim, doublet(0.25 * material.pair().delta_eq()));
    preload(sim);
    sim.run("neighbor 0.03125 bin\nneigh_modify delay 0 every 1 check no binsize 2\n"
            "group second id 1");
    // away from the first along x and y by powers of two: overlap about -0.5 delta_C
    sim.run("displace_atoms second move 0.00390625 0.001953125 0 units box\nrun 0");
    sim.run("fix mv all move linear " + velocity + " units box\nrun 1500");
    return state_of(sim);
  };
  const State twin = loads("0 0 0");
  ASSERT_GT(largest(twin.torque), 0.1);
  EXPECT_LT(twin.f[0] + twin.f[1] + twin.f[2], 0.0);    // pulled back
  expect_unchanged("of a stretched neck through cells and ranks", loads("64 -32 16"), twin,
                   "C9 styles");
}

// ---------------------------------------------------------------------------------------------
// runs that stop and go on

const std::string lossy =
    " jkr 1.0e6 0.25 100.0 damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const std::string bottom = "fix wall all wall/levelset plane z 0 NULL" + lossy + "\n";
const std::string dynamics = "fix pull all gravity 50 vector 1 0.5 -1\n" + bottom;
const std::string verlet = integrators[0].commands(dt);

// three spheres, in contact with each other and, the lower two, with the wall, that slip and roll;
// overlaps differ from those at rest
void build_pile(Simulation &sim, const std::string &newton = "on")
{
  Scene scene;
  scene.newton = newton;
  scene.boundary = "p p f";
  scene.style = "pair_style granular/adhesive\npair_coeff 1 1" + lossy + "\n";
  build(sim, {{3.5, 4.0, 0.49}, {4.48, 4.0, 0.485}, {4.0, 4.2, 1.315}}, scene);
  set_motion(sim, 1, {1.0, 0.5, 0.0}, {3.0, 1.0, 2.0});
  set_motion(sim, 2, {0.5, 1.0, 0.0}, {-2.0, 4.0, 1.0});
  set_motion(sim, 3, {2.0, 0.0, -1.0}, {0.0, -3.0, -2.0});
}

State after(const std::string &commands, const std::string &newton, double *begun = nullptr)
{
  Simulation sim;
  build_pile(sim, newton);
  sim.run(dynamics + commands);
  if (begun) *begun = sim.value("f_wall[8]");
  return state_of(sim);
}

TEST(RanksContactHistory, two_runs_are_one)
{
  for (const auto &newton : both) {
    const State reference = after(verlet + "run 400", newton);
    ASSERT_GT(largest(reference.torque), 0.5);
    expect_same(after(verlet + "run 150\nrun 250", newton), reference, 1e-11);
    expect_same(after(verlet + "run 400 every 100 NULL", newton), reference, 1e-11);
  }
}

// no pair_style, no pair_coeff: what the file says must act
TEST(RanksContactHistory, restart_goes_on)
{
  const std::string file = scratch_file("restart");
  for (const auto &newton : both)
    for (const auto &integrator : integrators) {
      double begun = 0.0;
      const std::string integrate = integrator.commands(dt);
      const State reference = after(integrate + integrator.run(400), newton, &begun);
      const std::string cut = std::to_string(150 / integrator.inner);
      for (const std::string &way : {integrator.run(150) + "write_restart " + file,
                                     "restart " + cut + " " + file + "\n" + integrator.run(400)}) {
        after(integrate + way, newton);
        const bool within = way[1] == 'e';
        Simulation sim;
        sim.run("read_restart " + (within ? file + "." + cut : file) + "\n" + dynamics + integrate +
                integrator.run(250));
        SCOPED_TRACE(newton + " " + integrator.name + " " + way);
        const auto now = state_of(sim);
        double change = 0.0;
        for (const auto part : {&State::x, &State::v, &State::omega, &State::f, &State::torque})
          change = std::max(change, difference(now.*part, reference.*part));
        expect_criterion(integrator.of("C10 *: change by a restart in contact, 250 steps later"),
                         change, 0.0, 1e-14);
        EXPECT_EQ(sim.value("f_wall[8]"), begun) << "wall contacts begun since the first run";
        const std::string twice = "." + std::to_string(300 / integrator.inner);
        for (const auto &number : {std::string(), "." + cut, twice})
          std::remove((file + number).c_str());
      }
    }
}

}    // namespace
