// Liquid bridges over ranks, rebuilds, integrators and restarts.

#include "wet_spheres.h"

#include "neighbor.h"

namespace {

const std::string sticky = "jkr 1.0e6 0.25 20.0 damping alpha 0.3 sliding 0.3 rolling 0.02 "
                           "bridge 0.02 40.0 10 0.3 0.01 tangential yes ";

// a lump of wet spheres, some touching, some bridged, some apart, and a bullet
const std::vector<Sphere> lump = {{0.0, 0.0, 0.0},    {0.995, 0.0, 0.0}, {0.49, 0.86, 0.0},
                                  {0.49, 0.29, 0.81}, {-0.7, -0.7, 0.0}, {2.1, 0.7, 0.3, 0.5}};

struct Trip {
  std::string law = sticky, integrate, commands, newton = "on", processors = "* * *";
  std::string wall, boundary = "p p p";
  std::vector<double> from = {4.0, 4.0, 4.0}, v = {0.0, 0.0, 0.0};
  int steps = 100;
  bool restart = false;
};

State travelled(const Trip &trip)
{
  auto spheres = lump;
  for (auto &sphere : spheres) {
    sphere.x = snap(sphere.x) + trip.from[0];
    sphere.y = snap(sphere.y) + trip.from[1];
    sphere.z = snap(sphere.z) + trip.from[2];
  }
  Scene scene;
  scene.newton = trip.newton;
  scene.processors = trip.processors;
  scene.boundary = trip.boundary;
  scene.style = granular(trip.law);
  const int n = static_cast<int>(lump.size());
  const std::string rest = "neighbor 0.6 bin\n" + trip.wall + trip.commands + trip.integrate;
  const std::string file = scratch_file("lump.restart");
  State state;
  {
    Simulation sim;
    build(sim, spheres, scene);
    for (int a = 0; a < n; a++) {
      const double s = a == n - 1 ? -25.0 : 2.0 * (a % 3) - 1.0;
      set_motion(sim, a + 1, {trip.v[0] + s, trip.v[1] - 0.7 * s, trip.v[2] + 0.3 * s},
                 {2.0 - a, 0.5 * a, 1.0});
    }
    sim.run(rest + "run " + std::to_string(trip.restart ? trip.steps / 2 : trip.steps));
    if (trip.restart) sim.run("write_restart " + file);
    state = state_of(sim);
  }
  if (trip.restart) {
    Simulation sim;
    sim.run("newton " + trip.newton + "\nprocessors " + trip.processors +
            "\natom_modify map array\nread_restart " + file + "\ncomm_modify vel yes\n" + rest +
            "run " + std::to_string(trip.steps - trip.steps / 2));
    std::remove(file.c_str());
    state = state_of(sim);
  }
  for (int a = n - 1; a >= 0; a--)
    for (int c = 0; c < 3; c++) {
      const double d = state.x[3 * a + c] - state.x[c];
      state.x[3 * a + c] = d - 8.0 * std::round(d / 8.0);
      state.v[3 * a + c] -= trip.v[c];
    }
  return state;
}

const State &reference()
{
  Trip trip;
  trip.integrate = verlet(dt);
  trip.steps = 1600;
  static const State state = travelled(trip);
  return state;
}

}    // namespace

TEST(RanksBridge, lump_is_the_same_under_mts_and_on_all_ranks)
{
  for (const std::string newton : {"on", "off"})
    for (const std::vector<double> &from :
         std::vector<std::vector<double>>{{4.0, 4.0, 4.0}, {7.875, 7.75, 0.125}}) {
      Trip trip;
      trip.newton = newton;
      trip.from = from;
      trip.integrate = mts(16);
      SCOPED_TRACE(newton + digits(from[0]));
      expect_same(travelled(trip), reference(), 1e-9);
    }
}

TEST(RanksBridge, lump_travels_with_rebuilds_at_every_step)
{
  const std::string n = std::to_string(number_of_ranks());
  for (const std::string newton : {"on", "off"})
    for (const std::string &processors : {n + " 1 1", "1 1 " + n}) {
      Trip trip;
      trip.newton = newton;
      trip.processors = processors;
      trip.integrate = mts(16);
      trip.v = {48.0, -32.0, 64.0};
      trip.commands = "neigh_modify delay 0 every 1 check no\natom_modify sort 7 1.0\n";
      SCOPED_TRACE(newton + processors);
      expect_same(travelled(trip), reference(), 1e-7);
    }
}

TEST(RanksBridge, lump_under_respa_equals_verlet)
{
  Trip trip;
  trip.integrate = verlet(16.0 * dt) + "run_style respa 2 16 pair 1\n";
  expect_same(travelled(trip), reference(), 1e-9);
}

// The lowest sphere comes to a wall, 0.01 below it, and others follow. Contacts share the mass of a
// particle, and bridges its liquid, anew once in a particle step: fix nve/sphere/mts differs by
// that.
TEST(RanksBridge, lump_on_a_wall_is_the_same_under_verlet_respa_mts_and_after_a_restart)
{
  for (const std::string liquid : {"", "inventory 0.3 form film "}) {
    Trip trip;
    trip.law = sticky + liquid;
    trip.wall = "fix w all wall/levelset plane y 2.79 NULL " + trip.law + "\n";
    trip.boundary = "p f p";
    trip.integrate = verlet(dt);
    trip.steps = 1600;
    const State at_wall = travelled(trip);
    EXPECT_GT(std::fabs(at_wall.v[13] - reference().v[13]), 0.1) << "the wall acts";
    const std::string respa = verlet(16.0 * dt) + "run_style respa 2 16 pair 1\n";
    struct {
      std::string integrate;
      int steps;
      double tolerance;
    } cases[] = {{verlet(dt), 1600, 1e-9},
                 {respa, 100, 1e-9},
                 {mts(1), 1600, 1e-9},
                 {mts(16), 100, liquid.empty() ? 1e-3 : 1e-2}};
    for (const auto &[integrate, steps, tolerance] : cases)
      for (const bool restart : {false, true}) {
        SCOPED_TRACE(liquid + integrate + (restart ? "restart" : ""));
        trip.integrate = integrate;
        trip.steps = steps;
        trip.restart = restart;
        expect_same(travelled(trip), at_wall, tolerance);
      }
  }
}

TEST(RanksBridge, restart_goes_on)
{
  for (const bool sub_steps : {false, true}) {
    Trip trip;
    trip.integrate = sub_steps ? mts(16) : verlet(dt);
    trip.steps = sub_steps ? 100 : 1600;
    trip.restart = true;
    expect_same(travelled(trip), reference(), 1e-9);
  }
}

// Two spheres are pulled apart while they travel from rank to rank, with a skin of a twentieth of
// the rupture length. Fix freeze says that forces do not move them: the viscous force is that of
// their speed.
TEST(RanksBridge, none_is_lost_with_a_skin_thinner_than_its_length)
{
  Liquid water;
  water.mu = 0.7;
  const double pulled = 0.01 * water.sigma / water.mu;    // Ca = 0.01
  const double step = 1.0e-3;
  // it would be stopped long before
  EXPECT_GT(water.pull(0.01) * step / water.m, 0.5 * pulled);
  for (const std::string newton : {"on", "off"}) {
    SCOPED_TRACE(newton);
    Simulation sim;
    Scene scene;
    scene.newton = newton;
    scene.processors = std::to_string(number_of_ranks()) + " 1 1";
    scene.style = granular(elastic + water.words());
    build(sim, {{3.3, 4.0, 4.0}, {4.2999, 4.0, 4.0}}, scene);
    sim.run("neighbor 0.01 bin\nneigh_modify delay 0 every 1 check yes\ncompute b all "
            "aggregate/contact\ncompute l all pair/local p12 p13\ncompute n all reduce sum c_l[1] "
            "c_l[2] inputs local\ncompute s all reduce sum c_b[5]\n"
            "thermo_style custom step c_n[1] c_n[2] c_s\nrun 0 post no\n"
            "group left id 1\ngroup right id 2\nfix still all freeze\ntimestep " +
            digits(step) + "\nfix l left move linear " + digits(4.0 * pulled) +
            " 0 0\nfix r right move linear " + digits(5.0 * pulled) + " 0 0");
    double last = 0.0, gap = 0.0;
    int builds = 0, seen = 0;
    for (int n = 0; n < 60; n++) {
      sim.run("run 10 post no");
      builds += sim.lammps()->neighbor->ncalls;
      gap = sim.value("x[2]-x[1]") - 1.0;
      if (sim.value("c_s") == 0.0) break;
      last = gap;
      if (gap < 0.01) continue;
      seen++;
      EXPECT_NEAR(sim.value("c_n[1]") / water.pull(gap), 1.0, 1e-10) << gap;
      const double viscous = water.k() * std::pow(water.H(gap), 2) / gap * pulled;
      EXPECT_NEAR(sim.value("c_n[2]") / -viscous, 1.0, 1e-3) << gap;
    }
    EXPECT_GT(seen, 20);
    EXPECT_GT(builds, 50);
    EXPECT_LE(last, water.rupture(0.01));
    EXPECT_GT(gap, water.rupture(0.01));
    EXPECT_LT(gap - last, 11.0 * step * pulled);
    EXPECT_EQ(sim.value("c_n[1]"), 0.0);
  }
}
