// Static friction: rolling without slip along a curved wall. A small particle jammed between large
// ones is a hard case, in stability/test_size_ratio.cpp.

#include "simulation.h"

#include "gtest/gtest.h"

#include <cmath>
#include <string>

namespace {

std::string number(double x)
{
  char text[32];
  snprintf(text, sizeof(text), "%.16g", x);
  return text;
}

const std::string header =
    "units si\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
    "boundary f f f\n";

// A sphere that rolls in the bottom of a cylinder is a pendulum of length (R - r) with 7/5 of its
// mass: T = 2 pi sqrt(7 (R - r) / (5 g)). After a period it is back, within the small amplitude's
// effect on T (A^2 / 16) and the overlap's on the lever.
TEST(StaticFriction, rolling_in_a_cylinder_is_a_pendulum)
{
  for (const int dimension : {2, 3}) {
    const double R = 1e-2, r = 1e-3, amplitude = 0.1;
    const double period = 2.0 * M_PI * std::sqrt(1.4 * (R - r) / 9.81), dt = 4e-6;
    Simulation sim;
    sim.run("dimension " + std::to_string(dimension) + "\n" + header +
            (dimension == 2 ? "boundary f f p\n" : "") +
            "neighbor 1e-4 bin\nregion b block -0.02 0.02 -0.02 0.02 -0.02 0.02\ncreate_box 1 b\n"
            "create_atoms 1 single " +
            number((R - r) * std::sin(amplitude)) + " " +
            number(-(R - r) * std::cos(amplitude) - 2e-8) +
            " 0\n"
            "set group all diameter 2e-3 density 2600\npair_style granular/adhesive\n"
            "pair_coeff * * jkr 1e8 0.3 0\nfix w all wall/levelset cylinder z 0 0 1e-2 inside "
            "jkr 1e8 0.3 0 damping tsuji 0.3 sliding 1.0\nfix g all gravity 9.81 vector 0 -1 0\n"
            "fix n all nve/sphere\ntimestep " +
            number(dt) + "\nrun " + std::to_string(std::lround(0.5 * period / dt)));
    const double half = std::atan(-sim.value("x[1]") / sim.value("y[1]"));
    EXPECT_NEAR(half / amplitude, -1.0, 2e-3) << dimension;
    sim.run("run " + std::to_string(std::lround(0.5 * period / dt)));
    const double whole = std::atan(-sim.value("x[1]") / sim.value("y[1]"));
    EXPECT_NEAR(whole / amplitude, 1.0, 2e-3) << dimension;
    EXPECT_NEAR(sim.value("f_w[9]"), 0.0, 0.1);    // never left the wall
  }
}

}    // namespace
