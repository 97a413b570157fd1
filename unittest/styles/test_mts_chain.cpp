// Impacts that follow from other impacts within one particle step: chains, springs that let go, and
// contacts that nobody foresaw. Momentum and energy tell whether they were seen in time.

#include "scenes.h"

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
