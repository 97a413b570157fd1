// Cases 21 and 22 of the list of hard cases.

#include "criterion.h"
#include "wet_spheres.h"

namespace {

struct Integrator {
  const char *name;
  std::string words;
  int steps_each;    // steps of the bridge in one of `run`
};
std::vector<Integrator> integrators(double step)
{
  return {{"verlet", verlet(step), 1},
          {"respa", verlet(4.0 * step) + "run_style respa 2 4 pair 1\n", 4},
          {"mts", mts(4, step), 4}};
}

// A viscous bridge stops two spheres where the integral of the lubrication force says, at steps of
// 1, 10 and 100 times the explicit limit 2 m h / (6 pi mu R^2 H^2) of the end.
TEST(BridgeCases, viscous_bridge_takes_the_momentum_of_the_law)
{
  Liquid oil;
  oil.l = 1.0;
  oil.sigma = 1.0e-12;
  oil.theta = 0.0;
  oil.mu = 1.0;
  oil.hmin = 1.0e-4;
  const double h0 = 0.005 * oil.R, stop = h0 * std::exp(-2.0);
  const double v0 = oil.viscous_momentum(stop, h0) / oil.m;
  const double limit = 2.0 * oil.m * stop / (oil.k() * std::pow(oil.H(stop), 2));
  for (const double times : {1.0, 10.0, 100.0})
    for (const auto &[name, words, steps_each] : integrators(times * limit)) {
      SCOPED_TRACE(testing::Message() << name << " " << times);
      Simulation sim;
      Scene scene;
      scene.style = granular(elastic + oil.words() + "form film");
      build(sim, {{4.0 - 0.5 * (1.0 + h0), 4.0, 4.0}, {4.0 + 0.5 * (1.0 + h0), 4.0, 4.0}}, scene);
      set_motion(sim, 1, {0.5 * v0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      set_motion(sim, 2, {-0.5 * v0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("neighbor 1.0 bin\n" + words + "run " + std::to_string(2000 / steps_each));
      const double h = sim.value("x[2]-x[1]-1");
      EXPECT_NEAR(sim.value("vx[1]-vx[2]") / v0, 0.0, 1e-3) << "at rest";
      const double law = v0 - oil.viscous_momentum(h, h0) / oil.m;
      expect_criterion(std::string("C21 ") + name +
                           ": speed where the law of logarithms ends, over the first",
                       std::fabs(law / v0), 0.0, 1e-3);
    }
}

// A bridge that opens ruptures at (47), and its force goes on through contact: H(0) = 1.
TEST(BridgeCases, bridge_ruptures_at_its_distance_and_its_force_is_continuous_at_contact)
{
  Liquid water;
  water.hmin = 1.0e-4;
  Simulation sim;
  Scene scene;
  scene.style = granular(elastic + water.words());
  build(sim, {{4.9999, 4.0, 4.0}, {4.0, 4.0, 4.0}}, scene);
  sim.run("timestep 1.0e-13\nrun 0");
  const double d = 1.0e-6;
  auto pull_at = [&](double h) {
    sim.run("set atom 1 x " + digits(5.0 + h) + "\nrun 0 post no");
    return -sim.value("fx[1]");
  };
  const double touching = pull_at(-1.0e-9), apart = pull_at(d);
  const double full = 4.0 * pi * water.R * water.sigma * std::cos(water.angle());
  expect_criterion("C22 styles: force just out of contact over that in contact", apart / touching,
                   0.999, 1.001);
  expect_criterion("C22 styles: force in contact over 4 pi R sigma cos(theta)", touching / full,
                   0.999, 1.001);
  double h = 0.998 * water.rupture();
  while (pull_at(h) > 0.0 && h < 1.1 * water.rupture()) h += 1.0e-4 * water.rupture();
  expect_criterion("C22 styles: gap of rupture over (1 + theta/2) V^(1/3)", h / water.rupture(),
                   0.999, 1.001);
}

}    // namespace
