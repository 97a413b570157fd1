// Fix wall/levelset file: the wall from distances at the nodes of a grid against planes, circles
// and edges in closed form.

#include "criterion.h"
#include "grid_scene.h"

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

// Radius of the contact from the wall's curvature: 1/R = sqrt(1/r (1/r + 1/R_w)) at a cylinder
TEST(WallGrid, circle_has_the_force_of_the_cylinder)
{
  for (double side : {1.0, -1.0}) {
    const auto shape = [side](const double *x) {
      return side * circle(x);
    };
    const double r = 2.0 + side * (0.5 - 0.012);
    GridScene scene(2, 0.1, {{"distance", shape}}, {{4.0 + r * 0.8, 4.0 + r * 0.6, 0.0}}, jkr);
    scene.sim.run("run 0");
    const auto f = gather(scene.sim, "f");
    const double expected = material.curve(0.5 / std::sqrt(1.0 + side * 0.25)).force(0.012);
    const double flat = material.wall().force(0.012);
    // distance to 2e-6: 3e-4 of delta_C
    EXPECT_NEAR(f[0], 0.8 * side * expected, 1e-3 * std::fabs(expected));
    EXPECT_NEAR(f[1], 0.6 * side * expected, 1e-3 * std::fabs(expected));
    EXPECT_GT(std::fabs(flat - expected), 5e-3 * std::fabs(expected));
    const auto curve = material.curve(0.5 / std::sqrt(1.0 + side * 0.25));
    const double slope = (curve.force(0.012 + 1e-7) - curve.force(0.012 - 1e-7)) / 2e-7;
    expect_criterion("C16 law: error of the distance to a circle, of delta_C",
                     std::fabs((side * (0.8 * f[0] + 0.6 * f[1]) - expected) / slope) /
                         curve.delta_C(),
                     0.0, 0.05);
  }
}

// ... and a cylinder's own surface gives the same
TEST(WallGrid, rebound_does_not_depend_on_the_point_of_impact)
{
  const double v = 12.0;
  std::vector<double> speeds;
  const auto impact = [&](Simulation &sim, double angle) {
    const double c = std::cos(angle), s = std::sin(angle);
    sim.run(at(4.0 + 2.51 * c, 4.0 + 2.51 * s));
    set_motion(sim, 1, {-v * c, -v * s, 0.0}, {0.0, 0.0, 0.0});
    sim.run("timestep " + digits(dt / 8) + "\nrun 4000");
    EXPECT_EQ(sim.value("f_wall[7]"), 0.0) << "it sticks";
    const auto after = gather(sim, "v");
    EXPECT_NEAR(after[0] * s - after[1] * c, 0.0, 0.002 * v) << angle;    // no kick sideways
    return after[0] * c + after[1] * s;
  };
  GridScene grid(2, 0.1, {{"distance", circle}}, {{6.51, 4.0, 0.0}}, jkr);
  grid.sim.run("fix nve all nve/sphere disc");
  grid.sim.run("unfix nve\nfix nve all nve/sphere");
  for (int n = 0; n < 12; n++) speeds.push_back(impact(grid.sim, 0.05 + 0.137 * n));
  const auto [low, high] = std::minmax_element(speeds.begin(), speeds.end());
  EXPECT_LT((*high - *low) / v, 0.002);
  expect_criterion("C16 verlet: scatter of e around a circle", (*high - *low) / v, 0.0, 0.02);
  const auto curve = material.curve(0.5 / std::sqrt(1.25));
  const double lost = 2.0 * 0.935503 * curve.F_C() * curve.delta_C() / mass;
  EXPECT_NEAR(speeds[0] / v, std::sqrt(1.0 - lost / (v * v)), 0.005);
}

// C17: tangential force on a particle that is held half of delta_C above rest, along an arc of many
// cells, against the pull-off force; drag is a hundredth of it at the least
TEST(WallGrid, no_ripples_along_a_curved_wall)
{
  GridScene scene(2, 0.1, {{"distance", circle}}, {{6.51, 4.0, 0.0}}, jkr);
  const auto curve = material.curve(0.5 / std::sqrt(1.25));
  const double r = 2.5 - curve.delta_eq() + 0.5 * curve.delta_C();
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
  EXPECT_LT(worst, 1e-5 * curve.F_C());
  expect_criterion("C17 law: force along a circle, of a drag of F_C/100",
                   worst / (0.01 * curve.F_C()), 0.0, 0.01);
  EXPECT_GT(worst, 0.0);
  EXPECT_LT((most - least) / std::fabs(least), 1e-3);
  EXPECT_NEAR(most, curve.force(curve.delta_eq() - 0.5 * curve.delta_C()), 1e-2 * curve.F_C());
}

// C16: a closed way around a convex edge, deeper on one face than on the other
TEST(WallGrid, no_work_on_a_closed_way_around_an_edge)
{
  GridScene scene(2, 0.1, {{"distance", outside_quadrant}}, {{3.0, 4.49, 0.0}}, jkr);
  const auto curve = material.wall();
  const double deep = 0.5 - 1.2 * curve.delta_eq(), high = 0.5 - 0.3 * curve.delta_eq();
  // along the upper face, around the edge, down the other face, back farther from the wall
  std::vector<std::array<double, 2>> way;
  const auto leg = [&](double distance, bool back) {
    std::vector<std::array<double, 2>> points;
    for (int n = 0; n <= 60; n++) points.push_back({3.4 + 0.01 * n, 4.0 + distance});
    for (int n = 1; n < 300; n++) {
      const double angle = 0.5 * pi * (1.0 - n / 300.0);
      points.push_back({4.0 + distance * std::cos(angle), 4.0 + distance * std::sin(angle)});
    }
    for (int n = 60; n >= 0; n--) points.push_back({4.0 + distance, 3.4 + 0.01 * n});
    if (back) std::reverse(points.begin(), points.end());
    way.insert(way.end(), points.begin(), points.end());
  };
  // straight out and in
  const auto cross = [&](double x, double y, double dx, double dy) {
    for (int n = 1; n < 40; n++) way.push_back({x + n / 40.0 * dx, y + n / 40.0 * dy});
  };
  leg(deep, false);
  cross(4.0 + deep, 3.4, high - deep, 0.0);
  leg(high, true);
  cross(3.4, 4.0 + high, 0.0, deep - high);
  way.push_back(way.front());
  double work = 0.0, largest_part = 0.0;
  std::vector<double> last;
  for (size_t n = 0; n < way.size(); n++) {
    scene.sim.run(at(way[n][0], way[n][1]) + "run 0 post no");
    const auto f = gather(scene.sim, "f");
    if (n > 0) {
      const double part = 0.5 *
          ((f[0] + last[0]) * (way[n][0] - way[n - 1][0]) +
           (f[1] + last[1]) * (way[n][1] - way[n - 1][1]));
      work += part;
      largest_part = std::max(largest_part, std::fabs(part));
    }
    last = f;
  }
  EXPECT_GT(largest_part, 0.01 * curve.F_C() * curve.delta_C());    // up and down between the legs
  expect_criterion("C16 law: work of a closed way around an edge, of F_C delta_C",
                   std::fabs(work) / (curve.F_C() * curve.delta_C()), 0.0, 1e-3);
}

// a plate of thickness 0.02, thinner than the spacing, that ends at x = 4
static double knife(const double *x)
{
  return (x[0] > 4.0 ? std::hypot(x[0] - 4.0, x[1] - 4.0) : std::fabs(x[1] - 4.0)) - 0.01;
}

// All around the edge of a knife the force is that of JKR. Its rim, where curvature jumps, is seen
// to second order in the spacing, the direction of the normal there to first order.
TEST(WallGrid, knife_edge_holds_as_its_faces_do)
{
  const auto curve = material.wall();
  std::vector<double> size_errors, tilts;
  for (const double spacing : {0.1, 0.05}) {
    GridScene scene(2, spacing, {{"distance", knife}}, {{3.0, 4.49, 0.0}}, jkr);
    double size_error = 0.0, tilt = 0.0;
    for (const double overlap : {0.3 * curve.delta_eq(), 1.3 * curve.delta_eq()}) {
      const double r = 0.5 + 0.01 - overlap;
      for (int n = 0; n <= 60; n++) {
        const double angle = 0.5 * pi * (1.0 - n / 30.0), c = std::cos(angle), s = std::sin(angle);
        scene.sim.run(at(4.0 + r * c, 4.0 + r * s) + "run 0 post no");
        const auto f = gather(scene.sim, "f");
        size_error = std::max(size_error, std::fabs(f[0] * c + f[1] * s - curve.force(overlap)));
        tilt = std::max(tilt, std::fabs(f[1] * c - f[0] * s));
      }
    }
    size_errors.push_back(size_error / curve.F_C());
    tilts.push_back(tilt / curve.F_C());
  }
  EXPECT_LT(size_errors[1], 0.035);
  EXPECT_GT(size_errors[0] / size_errors[1], 3.0);
  EXPECT_LT(size_errors[0] / size_errors[1], 5.5);
  EXPECT_LT(tilts[1], 0.02);
  EXPECT_GT(tilts[0] / tilts[1], 1.5);
  EXPECT_LT(tilts[0] / tilts[1], 3.0);
}

// An undamped particle that sticks rolls over an edge: nothing is lost or gained
TEST(WallGrid, edge_is_rolled_over_without_loss)
{
  for (const std::string &integrator :
       {"fix nve all nve/sphere\ntimestep " + digits(dt / 8), mts(20, dt / 8)}) {
    GridScene scene(2, 0.1, {{"distance", outside_quadrant}},
                    {{3.5, 4.5 - material.wall().delta_eq(), 0.0}}, jkr);
    scene.sim.run("fix_modify wall energy yes\nthermo_modify norm no\ncompute k all ke\n" +
                  integrator);
    set_motion(scene.sim, 1, {2.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    scene.sim.run("run 0");
    const double kinetic = scene.sim.value("c_k"), bound = scene.sim.value("pe");
    scene.sim.run("run " + std::to_string(static_cast<int>(0.9 / scene.sim.lammps()->update->dt)));
    const auto x = gather(scene.sim, "x");
    EXPECT_GT(x[0], 4.4) << integrator;    // beside the other face
    EXPECT_LT(x[1], 3.9);
    EXPECT_EQ(scene.sim.value("f_wall[7]"), 1.0);
    EXPECT_EQ(scene.sim.value("f_wall[8]"), 1.0);
    EXPECT_NEAR((scene.sim.value("c_k") + scene.sim.value("pe") - bound) / kinetic, 1.0, 0.01)
        << integrator;
  }
}

// ... in space over an edge askew, and over the corner of a box where three edges meet; sliding
// without friction, and rolling without slip
TEST(WallGrid, edges_and_corner_of_a_box_are_rolled_over_without_loss)
{
  const auto box = [](const double *x) {    // fluid outside of x, y, z < 4
    const double d[3] = {x[0] - 4.0, x[1] - 4.0, x[2] - 4.0};
    const double inside = std::min(std::max({d[0], d[1], d[2]}), 0.0);
    return inside + std::hypot(std::max(d[0], 0.0), std::max(d[1], 0.0), std::max(d[2], 0.0));
  };
  const double h = 4.5 - material.wall().delta_eq();
  const std::array<double, 2> ways[] = {{0.96, 0.28}, {0.8, 0.6}, {0.7071, 0.7071}};
  for (const std::string &law : {jkr, jkr + " sliding 1.0 "}) {
    GridScene scene(3, 0.08, {{"distance", box}}, {{3.5, 3.5, h}}, law);
    scene.sim.run("fix_modify wall energy yes\nthermo_modify norm no\ncompute k all ke\n"
                  "compute w all erotate/sphere\n" +
                  mts(20, dt / 8));
    for (const auto &way : ways) {
      // the last one meets the corner, the others an edge beside it
      const double v = 2.0;
      scene.sim.run("set atom 1 x " + digits(4.0 - 0.5 * way[0]) + " y " +
                    digits(way[0] > 0.71 ? 3.5 : 4.0 - 0.5 * way[1]) + " z " + digits(h));
      const bool rolls = law != jkr;
      set_motion(scene.sim, 1, {v * way[0], v * way[1], 0.0},
                 rolls ? std::vector<double>{-2.0 * v * way[1], 2.0 * v * way[0], 0.0}
                       : std::vector<double>{0.0, 0.0, 0.0});
      scene.sim.run("run 0");
      const auto energy = [&] {
        return scene.sim.value("c_k") + scene.sim.value("c_w");
      };
      const double kinetic = energy(), bound = scene.sim.value("pe");
      const double begun = scene.sim.value("f_wall[8]");
      scene.sim.run("run " +
                    std::to_string(static_cast<int>(0.7 / scene.sim.lammps()->update->dt)));
      const auto x = gather(scene.sim, "x");
      EXPECT_LT(x[2], 4.2) << way[0];    // beside the box
      EXPECT_EQ(scene.sim.value("f_wall[7]"), 1.0);
      EXPECT_EQ(scene.sim.value("f_wall[8]"), begun);
      EXPECT_NEAR((energy() + scene.sim.value("pe") - bound) / kinetic, 1.0, 1e-5) << way[0];
    }
  }
}

// A concave corner, one array for each side: two contacts, at rest where two planes hold it
TEST(WallGrid, corner_holds_two_contacts)
{
  for (int dims : {2, 3}) {
    GridScene scene(
        dims, 0.25,
        {{"distance_floor", plane(0, 1, 0, 1.0)}, {"distance_side", plane(1, 0, 0, 1.0)}},
        {{1.49, 1.49, dims == 3 ? 4.0 : 0.0}}, jkr + "damping tsuji 0.1");
    scene.sim.run("fix nve all nve/sphere\nfix g all gravity 500 vector -3 -4 0\nrun 5000");
    EXPECT_EQ(scene.sim.value("f_wall[7]"), 2.0);
    EXPECT_NEAR(scene.sim.value("f_wall[1]") / (-300.0 * mass), 1.0, 1e-6);
    EXPECT_NEAR(scene.sim.value("f_wall[2]") / (-400.0 * mass), 1.0, 1e-6);
    const auto x = gather(scene.sim, "x");
    for (const int c : {0, 1}) {
      const double load = (300.0 + 100.0 * c) * mass;
      EXPECT_NEAR(material.wall().force(1.5 - x[c]), load, 1e-6 * load);
      double low = 0.0, high = 0.1;    // where a plane carries it
      for (int n = 0; n < 60; n++)
        (material.wall().force(0.5 * (low + high)) < load ? low : high) = 0.5 * (low + high);
      expect_criterion("C16 verlet: place at rest in a concave corner, error over d",
                       std::fabs(x[c] - (1.5 - low)), 0.0, 0.01);
    }
  }
}

// ... and in space a corner of three sides, which the grid sees at an angle
TEST(WallGrid, corner_of_three_sides_holds_three_contacts)
{
  // an orthonormal frame, and the weight in it
  const double e[3][3] = {
      {2 / 3., 2 / 3., 1 / 3.}, {-2 / 3., 1 / 3., 2 / 3.}, {1 / 3., -2 / 3., 2 / 3.}};
  const double weight[3] = {300.0, 400.0, 500.0};
  const double corner[3] = {3.0, 3.0, 3.0};
  std::map<std::string, Shape> sides;
  double x[3], g[3];
  for (int c = 0; c < 3; c++) {
    x[c] = corner[c] + 0.49 * (e[0][c] + e[1][c] + e[2][c]);
    g[c] = -(weight[0] * e[0][c] + weight[1] * e[1][c] + weight[2] * e[2][c]);
  }
  const auto offset = [&](int n) {
    return e[n][0] * corner[0] + e[n][1] * corner[1] + e[n][2] * corner[2];
  };
  for (int n = 0; n < 3; n++)
    sides["distance_" + std::to_string(n)] = plane(e[n][0], e[n][1], e[n][2], offset(n));
  GridScene scene(3, 0.25, sides, {{x[0], x[1], x[2]}}, jkr + "damping tsuji 0.1");
  const double size = std::sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2]);
  scene.sim.run("fix nve all nve/sphere\nfix g all gravity " + digits(size) + " vector " +
                digits(g[0]) + " " + digits(g[1]) + " " + digits(g[2]) + "\nrun 5000");
  EXPECT_EQ(scene.sim.value("f_wall[7]"), 3.0);
  const auto at_rest = gather(scene.sim, "x");
  for (int n = 0; n < 3; n++) {
    const double distance =
        e[n][0] * at_rest[0] + e[n][1] * at_rest[1] + e[n][2] * at_rest[2] - offset(n);
    EXPECT_NEAR(material.wall().force(0.5 - distance) / (weight[n] * mass), 1.0, 1e-6) << n;
  }
}

// A wedge of 60 degrees, its faces oblique to the grid
TEST(WallGrid, wedge_rests_where_its_faces_carry_the_weight)
{
  const double s = std::sin(pi / 6.0), c = std::cos(pi / 6.0);    // faces through (4, 0)
  GridScene scene(2, 0.2,
                  {{"distance_left",
                    [=](const double *x) {
                      return c * (x[0] - 4.0) + s * x[1];
                    }},
                   {"distance_right",
                    [=](const double *x) {
                      return c * (4.0 - x[0]) + s * x[1];
                    }}},
                  {{4.0, 0.49 / s, 0.0}}, jkr + "damping tsuji 0.1");
  scene.sim.run("fix nve all nve/sphere\nfix g all gravity 400 vector 0 -1 0\nrun 5000");
  EXPECT_EQ(scene.sim.value("f_wall[7]"), 2.0);
  const auto x = gather(scene.sim, "x");
  EXPECT_NEAR(x[0], 4.0, 1e-9);
  // each face carries weight / (2 sin 30)
  const double each = 400.0 * mass / (2.0 * s);
  EXPECT_NEAR(material.wall().force(0.5 - x[1] * s) / each, 1.0, 1e-6);
}

// ---------------------------------------------------------------------------------------------
// integrators and ranks

// a particle that rolls down a circle under gravity, with all friction
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
