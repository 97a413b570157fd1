// Cases 21 and 22 of the list of hard cases.

#include "criterion.h"
#include "wet_spheres.h"

namespace {

struct Integrator {
  std::string name;
  std::string words;
  int steps_each;    // steps of the bridge in one of `run`
};
std::vector<Integrator> integrators(double step)
{
  return {{"verlet", verlet(step), 1},
          {"respa", verlet(4.0 * step) + "run_style respa 2 4 pair 1\n", 4},
          {"mts", mts(4, step), 4}};
}

Liquid oil(double hmin)    // viscosity alone
{
  Liquid liquid;
  liquid.l = 1.0;
  liquid.sigma = 1.0e-12;
  liquid.theta = 0.0;
  liquid.mu = 1.0;
  liquid.hmin = hmin;
  return liquid;
}

// two spheres that meet at a speed v, < 0 if they part
void build_wet(Simulation &sim, const Liquid &liquid, double gap, double v)
{
  Scene scene;
  scene.style = granular(elastic + liquid.words() + "form film");
  build(sim, {{4.0 - 0.5 * (1.0 + gap), 4.0, 4.0}, {4.0 + 0.5 * (1.0 + gap), 4.0, 4.0}}, scene);
  set_motion(sim, 1, {0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {-0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("neighbor 1.0 bin\n");
}

// A viscous bridge stops two spheres where the integral of the lubrication force says, at steps of
// 1, 10 and 100 times the explicit limit 2 m h / (6 pi mu R^2 H^2) of the end.
TEST(BridgeCases, viscous_bridge_takes_the_momentum_of_the_law)
{
  const auto liquid = oil(1.0e-4);
  const double h0 = 0.005 * liquid.R, stop = h0 * std::exp(-2.0);
  const double v0 = liquid.viscous_momentum(stop, h0) / liquid.m;
  const double limit = 2.0 * liquid.m * stop / (liquid.k() * std::pow(liquid.H(stop), 2));
  for (const double times : {1.0, 10.0, 100.0})
    for (const auto &[name, words, steps_each] : integrators(times * limit)) {
      SCOPED_TRACE(testing::Message() << name << " " << times);
      Simulation sim;
      build_wet(sim, liquid, h0, v0);
      sim.run(words + "run " + std::to_string(2000 / steps_each));
      const double h = sim.value("x[2]-x[1]-1");
      EXPECT_NEAR(sim.value("vx[1]-vx[2]") / v0, 0.0, 1e-3) << "at rest";
      const double law = v0 - liquid.viscous_momentum(h, h0) / liquid.m;
      expect_criterion("C21 " + name +
                           ": speed that the law leaves where spheres rest, over the first",
                       std::fabs(law / v0), 0.0, 1e-3);
    }
}

// On the way the speed is v(h) = v0 - (6 pi mu R^2 / m) ln(h0 / h), of spheres that come to rest at
// 2 h_min and of spheres that part from there, at steps of 1, 10 and 100 times the explicit limit
// of h_min: these go up to a thousand times as far as the gap is wide. At any step the speed
// is that of a gap between its ends; v(h) is read where the law changes it by less than 0.16 % in a
// collision step. Up to 1e-3 R, where H = 1.
TEST(BridgeCases, viscous_bridge_has_the_speed_of_the_law_on_the_way)
{
  const auto liquid = oil(1.0e-9);
  const double least = liquid.hmin * liquid.R, near = 2.0 * least, far = 1.0e-3 * liquid.R,
               unit = liquid.k() / liquid.m;
  EXPECT_GT(liquid.H(far), 0.998);
  for (const bool approach : {true, false})
    for (const double times : {1.0, 10.0, 100.0}) {
      const double step = times * 2.0 * least / unit, h0 = approach ? far : near,
                   v0 = (approach ? 1.0 : -1.5) * unit * std::log(far / near);
      const std::string way = approach ? "an approach" : "a separation",
                        what = " of " + way + ", steps up to 100 x explicit";
      auto law = [&](double h) {
        return v0 - unit * std::log(h0 / h);
      };
      for (const auto &[name, words, steps_each] : integrators(step)) {
        SCOPED_TRACE(testing::Message() << name << " " << times << " " << way);
        Simulation sim;
        build_wet(sim, liquid, h0, v0);
        sim.run(words + "run 0");
        auto gap = [&] {
          return sim.value("x[2]-x[1]-1");
        };
        auto closing = [&] {
          return sim.value("vx[1]-vx[2]");
        };
        const double each = steps_each * step;
        int gaps = 0;
        for (double h = h0; h <= far && std::fabs(closing() / v0) > 1e-3; h = gap()) {
          if (h != h0 && unit * step < 1.6e-3 * h) {
            expect_criterion("C21 " + name + ": v(h)" + what + ", over the logarithm's",
                             closing() / law(h), 0.999, 1.001);
            gaps++;
          }
          sim.run("run 1 post no");
          const double end = gap(), mean = (h - end) / each;
          const auto [low, high] = std::minmax({law(h), law(end)});
          expect_criterion("C21 " + name + ": speed in a step" + what +
                               ", beyond the logarithm's at its ends, of the first",
                           std::max({low - mean, mean - high, 0.0}) / std::fabs(v0), 0.0, 1e-3);
          const int more = static_cast<int>(0.3 * end / std::fabs(closing() * each));
          if (more > 0) sim.run("run " + std::to_string(more) + " post no");
        }
        EXPECT_GE(gaps, 5);
      }
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
