// Impacts that follow from other impacts within one particle step: chains, springs that let go, and
// contacts that nobody foresaw. Momentum and energy tell whether they were seen in time.

#include "scenes.h"

#include <algorithm>
#include <random>

namespace {

const double mass = pi / 6.0;    // d = 1, density 1
const std::string hertz = "pair_style granular/adhesive\npair_coeff * * jkr 2e4 0.25 0\n";

Scene row_of_spheres(const std::string &style)
{
  Scene scene;
  scene.style = style + "neighbor 1.0 bin\n";
  scene.boundary = "f p p";
  scene.box = "-10 30 0 8 0 8";
  return scene;
}

double momentum(Simulation &sim)
{
  double sum = 0.0;
  const auto v = gather(sim, "v");
  for (size_t n = 0; n < v.size(); n += 3) sum += v[n];
  return sum;
}
double energy(Simulation &sim)
{
  double sum = 0.0;
  for (const double v : gather(sim, "v")) sum += 0.5 * mass * v * v;
  return sum;
}

}    // namespace

// Five spheres in a row, 0.001 apart, the first with speed 1, a particle step of 0.1 d/v: the whole
// chain goes off within one step. At the end the last one leaves, as fast as the first came.
TEST(MtsChain, momentum_and_energy_go_through_a_row)
{
  for (const double gap : {0.0001, 0.001, 0.01}) {
    Simulation sim;
    std::vector<Sphere> spheres;
    for (int n = 0; n < 5; n++) spheres.push_back({n * (1.0 + gap), 4.0, 4.0});
    build(sim, spheres, row_of_spheres(hertz));
    set_motion(sim, 1, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("fix nve all nve/sphere/mts collision auto safety 0.1\ntimestep 0.1\nrun 12");
    EXPECT_NEAR(momentum(sim), 1.0, 1e-12);
    EXPECT_NEAR(energy(sim) / (0.5 * mass), 1.0, 0.01);
    EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
    EXPECT_GT(sim.value("vx[5]"), 0.9);
    EXPECT_LT(sim.value("vx[5]"), 1.01);
  }
}

// A sphere at its turning point on a wall has no speed, but comes off with all it had.
TEST(MtsChain, spring_that_lets_go_is_looked_at)
{
  Simulation sim;
  const std::string law = " jkr 2e6 0.25 0 ";
  auto scene = row_of_spheres("pair_style granular/adhesive\npair_coeff * *" + law + "\n");
  scene.box = "-1 30 0 8 0 8";
  build(sim, {{0.497, 4.0, 4.0}, {1.547, 4.0, 4.0}}, scene);
  sim.run("fix wall all wall/levelset plane x 0 NULL" + law);
  const double E = 2e6 / (1.0 - 0.0625) / 2.0;
  const double stored = 8.0 / 15.0 * E * std::sqrt(0.5) * std::pow(0.003, 2.5);    // Hertz
  sim.run("fix nve all nve/sphere/mts collision auto safety 0.1\ntimestep 0.1\nrun 6");
  EXPECT_NEAR(energy(sim) / stored, 1.0, 0.02);
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
}

// What a wall or a held sphere gives back meets the next: a row of two, at speeds of 1 and 2
// towards a wall at rest, the first about to touch it. Impacts of equal spheres swap their speeds.
TEST(MtsChain, what_comes_back_meets_the_next)
{
  for (const std::string at : {"wall", "frozen", "held"})
    for (const double gap : {0.05, 0.15, 0.2, 0.22, 0.25, 0.28, 0.31, 0.35}) {
      SCOPED_TRACE(at + " " + digits(gap));
      const std::string law = " jkr 2e6 0.25 0 ";
      auto scene = row_of_spheres("pair_style granular/adhesive\npair_coeff * *" + law + "\n");
      scene.box = "-1 30 0 8 0 8";
      std::vector<Sphere> spheres = {{1.505, 4.0, 4.0}, {2.505 + gap, 4.0, 4.0}};
      if (at != "wall") spheres.push_back({0.5, 4.0, 4.0});
      Simulation sim;
      build(sim, spheres, scene);
      set_motion(sim, 1, {-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      set_motion(sim, 2, {-2.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("group free id 1 2\n");
      if (at == "wall") sim.run("fix wall all wall/levelset plane x 1.0 NULL" + law);
      if (at != "wall") set_motion(sim, 3, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      if (at == "frozen") sim.run("group rest id 3\nfix hold rest freeze");
      sim.run("fix nve " + std::string(at == "held" ? "free" : "all") +
              " nve/sphere/mts collision auto safety 0.05\ntimestep 0.1\nrun 5");
      const auto v = gather(sim, "v");
      EXPECT_NEAR(v[0], 1.0, 0.01);
      EXPECT_NEAR(v[3], 2.0, 0.01);
      EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
    }
}

// Random rains of three spheres on a plane: whatever meets whatever, energy stays.
TEST(MtsChain, rain_on_a_plane_keeps_its_energy)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform;
  const std::string law = " jkr 2e6 0.25 0 ";
  auto scene = row_of_spheres("pair_style granular/adhesive\npair_coeff * *" + law + "\n");
  scene.box = "-1 40 0 1.5 0 1.5";
  double late = 0.0, impacts = 0.0;
  for (int n = 0; n < 300; n++) {
    std::vector<Sphere> spheres;
    while (spheres.size() < 3) {
      const Sphere s{0.6 + 2.8 * uniform(random), 1.5 * uniform(random), 1.5 * uniform(random)};
      const bool apart = std::all_of(spheres.begin(), spheres.end(), [&](const Sphere &other) {
        const double y = std::remainder(s.y - other.y, 1.5), z = std::remainder(s.z - other.z, 1.5);
        return std::pow(s.x - other.x, 2) + y * y + z * z > 1.04;
      });
      if (apart) spheres.push_back(s);
    }
    Simulation sim;
    build(sim, spheres, scene);
    for (const int id : {1, 2, 3})
      set_motion(sim, id, {-0.25 - 0.75 * uniform(random), 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("neighbor 1.5 bin\nfix wall all wall/levelset plane x 0 NULL" + law);
    const double before = energy(sim);
    sim.run("fix nve all nve/sphere/mts collision auto safety 0.2\ntimestep 0.1\nrun 60");
    EXPECT_LT(energy(sim) / before, 1.01) << n;
    const bool apart = sim.value("f_nve[3]") == 0.0;
    EXPECT_GT(energy(sim) / before, apart ? 0.99 : 0.0) << n;
    late += sim.value("f_nve[5]");
    impacts += sim.value("f_wall[8]");
  }
  EXPECT_EQ(late, 0.0);
  EXPECT_GT(impacts, 600.0);
}

// Masses of 100, 10 and 1, the heaviest with speed 1: elastic impacts of v = 2 M / (M + m) each,
// and the last goes on to a fourth sphere of mass 1, to which it hands its speed.
TEST(MtsChain, speed_grows_along_falling_masses)
{
  for (const double gap : {0.05, 0.1, 0.15, 0.2, 0.25, 0.3}) {
    SCOPED_TRACE(gap);
    Simulation sim;
    const std::string law = "pair_style granular/adhesive\npair_coeff * * jkr 2e8 0.25 0\n";
    build(sim, {{0.0, 4.0, 4.0}, {1.02, 4.0, 4.0}, {2.04, 4.0, 4.0}, {3.04 + gap, 4.0, 4.0}},
          row_of_spheres(law));
    sim.run("set atom 1 density 100\nset atom 2 density 10\n");
    set_motion(sim, 1, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    for (const int id : {2, 3, 4}) set_motion(sim, id, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("fix nve all nve/sphere/mts collision auto safety 0.05\ntimestep 0.1\nrun 2");
    const double last = std::pow(200.0 / 110.0, 2);
    EXPECT_NEAR(gather(sim, "v")[9] / last, 1.0, 0.01);
    EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  }
}

// Friction makes speed of spin: a sphere is thrown aside by one that turns with 20, faster than any
// moves, into a third. As with a single rate.
TEST(MtsChain, what_spin_throws_is_seen)
{
  auto speeds = [](const std::string &integrate) {
    Simulation sim;
    build(
        sim, {{0.0, 4.0, 4.0}, {1.003, 4.0, 4.0}, {1.003, 5.06, 4.0}},
        row_of_spheres("pair_style granular/adhesive\npair_coeff * * jkr 2e6 0.25 20 damping none "
                       "sliding 1.0\n"));
    set_motion(sim, 1, {0.2, 0.0, 0.0}, {0.0, 0.0, 20.0});
    for (const int id : {2, 3}) set_motion(sim, id, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run(integrate);
    auto v = gather(sim, "v");
    v.push_back(integrate.find("mts") < integrate.size() ? sim.value("f_nve[5]") : 0.0);
    return v;
  };
  const auto reference = speeds("fix nve all nve/sphere\ntimestep 2e-5\nrun 10000");
  const auto found =
      speeds("fix nve all nve/sphere/mts collision auto safety 0.05\ntimestep 0.1\nrun 2");
  EXPECT_GT(reference[7], 0.2);    // the third goes aside
  for (int k = 0; k < 9; k++) EXPECT_NEAR(found[k], reference[k], 0.03) << k;
  EXPECT_EQ(found[9], 0.0);
}

// Without look-ahead an impact is seen too late, and too violent, but it keeps the momentum.
TEST(MtsChain, late_contact_keeps_the_momentum)
{
  Simulation sim;
  build(sim, {{0.0, 4.0, 4.0}, {1.05, 4.0, 4.0}, {2.049, 4.0, 4.0}}, row_of_spheres(hertz));
  set_motion(sim, 1, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("fix nve all nve/sphere/mts collision auto lookahead no\ntimestep 0.1\nrun 1");
  EXPECT_GT(sim.value("f_nve[5]"), 0.0);
  EXPECT_NEAR(momentum(sim), 1.0, 1e-11);
}
