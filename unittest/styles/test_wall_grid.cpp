// Fix wall/levelset file: the wall from distances at the nodes of a grid against planes and
// cylinders in closed form, under each integrator, on ranks; edges are in test_wall_grid_edges.cpp.

#include "criterion.h"
#include "grid_scene.h"
#include "integrators.h"

#include <algorithm>

// C16: planes at any angle to the grid. The distance is exact to 2e-15 of the box, as the tests of
// GridDistance show; here the box is 8 long and the overlap 0.015, so that rounding alone is 1e-12
// of the overlap, and more of the force, a difference of elastic repulsion and adhesion.
TEST(WallGrid, oblique_plane_is_exact)
{
  for (int dims : {2, 3})
    for (const auto &n : {Sphere{0.3, 0.9, 0.0}, Sphere{-0.7, 0.6, 0.0}, Sphere{0.2, 0.5, 0.8}}) {
      if (dims == 2 && n.z != 0.0) continue;
      const double size = std::sqrt(n.x * n.x + n.y * n.y + n.z * n.z);
      const double e[3] = {n.x / size, n.y / size, n.z / size};
      const double middle = 4.0 * (e[0] + e[1]) + (dims == 3 ? 4.0 * e[2] : 0.0);
      // 0.485 before the wall
      const Sphere at = {4.0, 4.0, dims == 3 ? 4.0 : 0.0};
      GridScene scene(dims, 0.4, {{"distance", plane(n.x, n.y, n.z, middle - 0.485)}}, {at}, jkr);
      scene.sim.run("run 0");
      const auto f = gather(scene.sim, "f");
      const double expected = material.wall().force(0.015);
      for (int c = 0; c < 3; c++) {
        EXPECT_NEAR(f[c], expected * e[c], 1e-10 * std::fabs(expected));
        expect_criterion("C16 law: force of an oblique plane, error over the force",
                         std::fabs(f[c] / expected - e[c]), 0.0, 1e-12);
        EXPECT_NEAR(scene.sim.value("f_wall[" + std::to_string(c + 1) + "]"), -f[c], 1e-12);
      }
    }
}

// Radius of the contact from the wall's curvature: 1/R = sqrt(1/r (1/r + 1/R_w)) at a cylinder. All
// around it the distance is known to 2e-6, 3e-4 of delta_C.
TEST(WallGrid, circle_has_the_force_of_the_cylinder)
{
  for (double side : {1.0, -1.0}) {
    const auto shape = [side](const double *x) {
      return side * circle(x);
    };
    const double r = 2.0 + side * (0.5 - 0.012);
    GridScene scene(2, 0.1, {{"distance", shape}}, {{4.0 + r, 4.0, 0.0}}, jkr);
    const auto curve = material.curve(0.5 / std::sqrt(1.0 + side * 0.25));
    const double expected = curve.force(0.012), flat = material.wall().force(0.012);
    EXPECT_GT(std::fabs(flat - expected), 5e-3 * std::fabs(expected));
    const double slope = (curve.force(0.012 + 1e-7) - curve.force(0.012 - 1e-7)) / 2e-7;
    for (int n = 0; n < 48; n++) {
      const double angle = 0.02 + 2.0 * pi * n / 48.0, c = std::cos(angle), s = std::sin(angle);
      scene.sim.run(at(4.0 + r * c, 4.0 + r * s) + "run 0 post no");
      const auto f = gather(scene.sim, "f");
      EXPECT_NEAR(f[0], c * side * expected, 1e-3 * std::fabs(expected)) << angle;
      EXPECT_NEAR(f[1], s * side * expected, 1e-3 * std::fabs(expected)) << angle;
      expect_criterion("C16 law: error of the distance all around a circle, of delta_C",
                       std::fabs((side * (c * f[0] + s * f[1]) - expected) / slope) /
                           curve.delta_C(),
                       0.0, 0.05);
    }
  }
}

// ... and a cylinder's own surface gives the same
TEST(WallGrid, rebound_does_not_depend_on_the_point_of_impact)
{
  const double v = 12.0;
  const auto curve = material.curve(0.5 / std::sqrt(1.25));
  const double lost = 2.0 * 0.935503 * curve.F_C() * curve.delta_C() / mass;
  for (const auto &integrator : integrators) {
    GridScene grid(2, 0.1, {{"distance", circle}}, {{6.51, 4.0, 0.0}}, jkr);
    grid.sim.run(integrator.commands(dt / 8));
    std::vector<double> speeds;
    for (int n = 0; n < 12; n++) {
      const double angle = 0.05 + 0.137 * n, c = std::cos(angle), s = std::sin(angle);
      grid.sim.run(at(4.0 + 2.51 * c, 4.0 + 2.51 * s));
      set_motion(grid.sim, 1, {-v * c, -v * s, 0.0}, {0.0, 0.0, 0.0});
      grid.sim.run(integrator.run(4000));
      EXPECT_EQ(grid.sim.value("f_wall[7]"), 0.0) << "it sticks";
      const auto after = gather(grid.sim, "v");
      EXPECT_NEAR(after[0] * s - after[1] * c, 0.0, 0.002 * v) << angle;    // no kick sideways
      speeds.push_back(after[0] * c + after[1] * s);
    }
    const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
    EXPECT_LT((*high - *low) / v, 0.002) << integrator.name;
    expect_criterion(integrator.of("C16 *: scatter of e around a circle"), (*high - *low) / v, 0.0,
                     0.02);
    EXPECT_NEAR(speeds[0] / v, std::sqrt(1.0 - lost / (v * v)), 0.005) << integrator.name;
  }
}

// C17: tangential force on a particle that is held half of delta_C above rest, along an arc of many
// cells, in units of F_C = 3 pi gamma r. Dust of the report's channel on its wall, in air of 0.02
// U, feels the drag 3 pi mu d u = 2 mu u F_C / gamma, gamma = phi rho U^2 r. Only planes hold that
// dust, and have no ripples. What resists on any wall is the rolling limit 4 F_C theta.
TEST(WallGrid, no_ripples_along_a_curved_wall)
{
  const auto curve = material.curve(0.5 / std::sqrt(1.25));
  const double r = 2.5 - curve.delta_eq() + 0.5 * curve.delta_C();
  const auto drag = [](double phi) {
    const double mu = 2e-5, U = 0.5, rho = 2600.0, radius = 5e-6;
    return 2.0 * mu * 0.02 * U / (phi * rho * U * U * radius);
  };
  std::vector<double> ripples;
  for (const double spacing : {0.1, 0.05}) {
    GridScene scene(2, spacing, {{"distance", circle}}, {{6.51, 4.0, 0.0}}, jkr);
    double worst = 0.0, least = 1e300, most = -1e300;
    for (int n = 0; n < 200; n++) {
      const double angle = 0.004 * n, c = std::cos(angle), s = std::sin(angle);
      scene.sim.run(at(4.0 + r * c, 4.0 + r * s) + "run 0 post no");
      const auto f = gather(scene.sim, "f");
      worst = std::max(worst, std::fabs(f[0] * s - f[1] * c));
      const double normal = f[0] * c + f[1] * s;
      least = std::min(least, normal);
      most = std::max(most, normal);
    }
    EXPECT_GT(worst, 0.0);
    EXPECT_LT((most - least) / std::fabs(least), 1e-3);
    EXPECT_NEAR(most, curve.force(curve.delta_eq() - 0.5 * curve.delta_C()), 1e-2 * curve.F_C());
    ripples.push_back(worst / curve.F_C());
  }
  const std::string what = "C17 law: force along a circle, ";
  expect_criterion(what + "of the rolling limit 4 F_C theta, theta = 0.01", ripples[0] / 0.04, 0.0,
                   1e-4);
  expect_unmet(what + "of the drag in the channel at phi = 1.5, cells of d/10",
               ripples[0] / drag(1.5), 0.0, 0.01, 0.03,
               "half the cell meets it; the walls of that dust are planes");
  expect_criterion(what + "of the drag in the channel at phi = 1.5, cells of d/20",
                   ripples[1] / drag(1.5), 0.0, 0.01);
  expect_unmet(what + "of the drag in the channel at phi = 150, cells of d/10",
               ripples[0] / drag(150.0), 0.0, 0.01, 3.0,
               "drag is 2e-5 of what rolling resists; the walls of that dust are planes");
}

// A particle that rolls down a circle under gravity, with all friction
TEST(WallGrid, integrators_agree)
{
  std::vector<State> states;
  for (const std::string &integrator :
       {"timestep " + digits(dt) + "\nfix nve all nve/sphere\nrun 6400",
        "timestep " + digits(8 * dt) +
            "\nrun_style respa 2 8 pair 1\nfix nve all nve/sphere\nrun 800",
        mts(8) + "run 800"}) {
    GridScene scene(2, 0.1, {{"distance", circle}}, {{4.0 + 2.487 * 0.6, 4.0 + 2.487 * 0.8, 0.0}},
                    jkr + all_friction);
    scene.sim.run("fix g all gravity 200 vector 0 -1 0\n" + integrator);
    EXPECT_EQ(scene.sim.value("f_wall[7]"), 1.0);
    states.push_back(state_of(scene.sim));
  }
  EXPECT_GT(std::hypot(states[0].v[0], states[0].v[1]), 0.1);
  const std::string names[] = {"verlet", "respa", "mts"};
  for (int n : {1, 2}) {
    expect_criterion("C16 " + names[n] + ": place along a circle less that of verlet, of it",
                     difference(states[n].x, states[0].x), 0.0, 1e-4);
    EXPECT_LT(difference(states[n].v, states[0].v), 2e-2) << n;
  }
}

// C17: along many cells of a gridded cylinder a sphere goes as along the cylinder itself
TEST(WallGrid, slides_and_rolls_as_on_a_cylinder)
{
  struct Case {
    const char *name;
    int dims;
    double spacing, side;
    std::string law;
    double vx, vz, gravity;
    int steps;
  };
  const std::string slippery = " sliding 0.001 ";
  const Case cases[] = {
      {"slides around", 2, 0.1, 1.0, slippery, 5.0, 0.0, 0.0, 800},
      {"rolls down", 2, 0.1, 1.0, " sliding 0.3 damping tsuji 0.1 ", 1.0, 0.0, 100.0, 1200},
      {"slides inside", 2, 0.1, -1.0, slippery, 5.0, 0.0, 0.0, 800},
      {"rolls through a pipe", 3, 0.2, -1.0, " sliding 0.3 twisting yes damping tsuji 0.1 ", 4.0,
       3.0, 20.0, 1600},
  };
  for (const auto &c : cases) {
    const double R = c.dims == 2 ? 2.0 : 3.5;
    const auto shape = [&](const double *x) {
      return c.side * (std::hypot(x[0] - 4.0, x[1] - 4.0) - R);
    };
    const double at_wall = R + c.side * (0.5 - material.wall().delta_eq());
    std::vector<State> states;
    double way = 0.0;
    for (const bool gridded : {true, false}) {
      GridScene scene(c.dims, c.spacing, {{"distance", shape}},
                      {{4.0, 4.0 + c.side * at_wall, c.dims == 2 ? 0.0 : 2.0}}, jkr + c.law);
      if (!gridded)
        scene.sim.run("unfix wall\nfix wall all wall/levelset cylinder z 4 4 " + digits(R) +
                      (c.side > 0.0 ? " outside" : " inside") + jkr + c.law);
      scene.sim.run("fix g all gravity " + digits(c.gravity) + " vector 0 -1 0\n" + mts(8));
      set_motion(scene.sim, 1, {c.vx, 0.0, c.vz}, {0.0, 0.0, 0.0});
      scene.sim.run("run " + std::to_string(c.steps));
      EXPECT_EQ(scene.sim.value("f_wall[8]"), 1.0) << c.name;
      EXPECT_EQ(scene.sim.value("f_wall[9]"), 0.0) << c.name;
      states.push_back(state_of(scene.sim));
      const auto &x = states.back().x;
      way = at_wall * std::acos(std::clamp(c.side * (x[1] - 4.0) / at_wall, -1.0, 1.0));
    }
    const auto &v = states[1].v, &spin = states[1].omega;
    const auto &x = states[1].x;
    const double lever = c.side * (std::hypot(x[0] - 4.0, x[1] - 4.0) - R);
    const double slip = std::hypot(v[0], v[1]) - lever * std::fabs(spin[2]);
    if (c.law == slippery)
      EXPECT_GT(slip, 0.2) << c.name;
    else
      EXPECT_NEAR(slip, 0.0, 0.01) << c.name;
    EXPECT_GT(way, 6.0 * c.spacing) << c.name;
    EXPECT_LT(difference(states[0].x, states[1].x), 1e-4) << c.name;
    expect_criterion("C17 mts: speed along many cells less that on a cylinder, of it",
                     difference(states[0].v, states[1].v), 0.0, 1e-3);
    EXPECT_LT(difference(states[0].omega, states[1].omega), 1e-3) << c.name;
  }
}

TEST(RanksWallGrid, sphere_in_a_sphere_with_restart)
{
  const auto bowl = [](const double *x) {
    const double d[3] = {x[0] - 4.0, x[1] - 4.0, x[2] - 4.0};
    return 3.5 - std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
  };
  const std::string restart = scratch_file("restart");
  State whole, parts;
  const std::string go = "fix g all gravity 100 vector 0 0 -1\nfix nve all nve/sphere\n";
  {
    GridScene scene(3, 0.2, {{"distance", bowl}}, {{4.0, 3.6, 1.03}, {2.5, 4.1, 1.39}},
                    jkr + all_friction);
    scene.sim.run(go + "neighbor 0.2 bin\nneigh_modify delay 0 every 1\nrun 1000\nwrite_restart " +
                  restart + "\nrun 1000");
    whole = state_of(scene.sim);
    EXPECT_EQ(scene.sim.value("f_wall[7]"), 2.0);
    scene.sim.run("clear\nread_restart " + restart + "\n" + none +
                  "fix wall all wall/levelset file " + scene.file.path + jkr + all_friction + "\n" +
                  go + "neighbor 0.2 bin\nneigh_modify delay 0 every 1\nrun 1000");
    parts = state_of(scene.sim);
  }
  EXPECT_GT(largest(whole.v), 0.1);
  expect_same(parts, whole, 1e-12);
}

// Walls along all borders of the grid and the box, to rounding: the cube of 8 has six faces of 64.
TEST(WallGrid, walls_on_the_border_have_their_area)
{
  std::map<std::string, Shape> faces;
  for (int axis = 0; axis < 3; axis++)
    faces["distance_" + std::to_string(axis)] = [axis](const double *x) {
      const double rounding = 1.0e-12;
      return (x[axis] < 4.0 ? x[axis] : 8.0 - x[axis]) + rounding;
    };
  GridScene scene(3, 0.25, faces, {{0.49, 4.0, 4.0}}, jkr);
  scene.sim.run("run 0");
  for (int row : {1, 2, 3})
    EXPECT_NEAR(scene.sim.value("f_wall[" + std::to_string(row) + "][13]") / 128.0, 1.0, 1e-5);
}
