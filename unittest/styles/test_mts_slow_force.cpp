// fix nve/sphere/mts beside a force that varies in space and is computed once in a particle step: a
// doublet, which is sub-stepped, on a spring. A free particle on it has velocity Verlet's energy.

#include "scenes.h"

namespace {

const Material material;
constexpr double stiffness = 2000.0;    // omega = 44 of two spheres, 62 of one

struct Swing {
  State state;
  double energy_early, energy_late;    // means over 500 particle steps, of the energy at the start
};

Swing swing(bool bound, const std::string &integrate, int steps)
{
  Simulation sim;
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "damping tsuji 0.5\n";
  const double other = bound ? 1.0 - material.pair().delta_eq() : 3.0;
  build(sim, {{3.0, 4.0, 4.0}, {3.0 + other, 4.0, 4.0}}, scene);
  sim.run("fix hang all spring/self " + digits(stiffness) +
          " z\nfix_modify hang energy yes\nvelocity all set 0 0 1\nneighbor 0.5 bin\n"
          "compute ke all ke\nvariable E equal c_ke+f_hang\n" +
          integrate);
  const std::string window = std::to_string(steps / 10);
  sim.run("fix mean all ave/time 1 " + window + " " + window + " v_E\nrun " + window);
  const double start = 0.5 * 2.0 * pi / 6.0, early = sim.value("f_mean") / start;
  sim.run("run " + std::to_string(steps - steps / 10));
  return {state_of(sim), early, sim.value("f_mean") / start};
}

// some 70 periods, omega x particle step = 0.06: a kick of the force at the begin of the step alone
// would raise the energy by (omega dt)^2/2 a step
TEST(MtsSlowForce, spring_brings_no_energy)
{
  for (const bool bound : {false, true}) {
    const auto is = swing(bound, mts(16), 8000);
    EXPECT_NEAR(is.energy_early, 1.0, 0.01) << bound;
    EXPECT_NEAR(is.energy_late, 1.0, 0.01) << bound;
  }
}

TEST(MtsSlowForce, error_is_of_second_order_in_the_particle_step)
{
  const auto exact = swing(true, "fix nve all nve/sphere\n", 1600);
  auto error = [&](int n) {
    return difference(swing(true, mts(n), 1600 / n).state.v, exact.state.v);
  };
  EXPECT_LT(error(16), 0.02);
  EXPECT_NEAR(error(16) / error(4), 255.0 / 15.0, 6.0);
}

}    // namespace
