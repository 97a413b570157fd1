// Fix wall/levelset file: the wall from distances at the nodes of a grid against planes, circles
// and edges in closed form.

#include "scenes.h"
#include "temporary_file.h"

#include <algorithm>
#include <functional>
#include <map>

namespace {

const Material material;
const double mass = pi / 6.0;    // of a sphere of diameter and density 1
const std::string none = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
using Shape = std::function<double(const double *)>;

// Scenes in the plane (box 8 x 8) or in space (8 x 8 x 8), the grid covering the box.
struct GridScene {
  TemporaryFile file{"apf_wall"};
  Simulation sim;

  GridScene(int dims, double spacing, const std::map<std::string, Shape> &arrays,
            const std::vector<Sphere> &spheres, const std::string &law,
            const std::string &boundary = "f f f")
  {
    const int n = static_cast<int>(std::lround(8.0 / spacing)) + 1;
    const double z = dims == 2 ? -spacing / 2 : 0.0;
    file.write({n, n, dims == 2 ? 2 : n}, {0, 0, z}, {spacing, spacing, spacing},
               [&](VtkhdfWriter &w) {
                 for (const auto &[name, shape] : arrays) {
                   const auto &f = shape;
                   w.field(name, 1, [&f](const double *x, double, double *phi) {
                     *phi = f(x);
                   });
                 }
               });
    Scene scene;
    scene.boundary = dims == 2 ? boundary.substr(0, 3) + " p" : boundary;
    if (dims == 2) {
      scene.before = "dimension 2";
      scene.box = "0 8 0 8 -0.5 0.5";
    }
    scene.style = none + "fix wall all wall/levelset file " + file.path + law + "\n";
    build(sim, spheres, scene);
    if (dims == 2) sim.run("fix flat all enforce2d");
  }
};

Shape plane(double nx, double ny, double nz, double offset)
{
  const double size = std::sqrt(nx * nx + ny * ny + nz * nz);
  return [=](const double *x) {
    return (nx * x[0] + ny * x[1] + nz * x[2]) / size - offset;
  };
}

double circle(const double *x)    // fluid outside a cylinder of radius 2 in the middle
{
  return std::hypot(x[0] - 4.0, x[1] - 4.0) - 2.0;
}

// fluid outside of the quadrant x < 4, y < 4: a convex edge
double outside_quadrant(const double *x)
{
  const double dx = x[0] - 4.0, dy = x[1] - 4.0;
  if (dx > 0.0 && dy > 0.0) return std::hypot(dx, dy);
  return std::max(dx, dy);
}

std::string at(double x, double y)
{
  return "set atom 1 x " + digits(x) + " y " + digits(y) + "\n";
}

}    // namespace

// C16: planes at any angle to the grid
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
        // positions are rounded to 1e-15, which is 1e-13 of the overlap
        EXPECT_NEAR(f[c], expected * e[c], 1e-10 * std::fabs(expected));
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
  EXPECT_LT(std::fabs(work), 1e-3 * curve.F_C() * curve.delta_C());
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
    EXPECT_NEAR(material.wall().force(1.5 - x[0]), 300.0 * mass, 1e-6 * 300.0 * mass);
    EXPECT_NEAR(material.wall().force(1.5 - x[1]), 400.0 * mass, 1e-6 * 400.0 * mass);
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
// what a grid cannot hold is refused, with what would do

TEST(WallGrid, coarse_grids_are_refused_and_the_advice_holds)
{
  std::string text;
  {
    GridScene scene(2, 0.4, {{"distance", circle}}, {{6.6, 4.0, 0.0}}, jkr + "resolution 1e-4");
    text = scene.sim.error_of("run 0");
  }
  const auto found = text.find("use a spacing of ");
  ASSERT_NE(found, std::string::npos) << text;
  const double advice = std::stod(text.substr(found + 17));
  EXPECT_LT(advice, 0.4);
  EXPECT_GT(advice, 0.02);
  // the next spacing that divides the box
  const double spacing = 8.0 / std::ceil(8.0 / advice);
  GridScene scene(2, spacing, {{"distance", circle}}, {{6.6, 4.0, 0.0}}, jkr + "resolution 1e-4");
  EXPECT_EQ(scene.sim.error_of("run 0"), "");
  // and what is accepted is as exact as it says
  const double delta_C = material.wall().delta_C();
  double worst = 0.0;
  for (int n = 0; n < 40; n++) {
    const double angle = 0.1 * n, r = 2.49;
    scene.sim.run(at(4.0 + r * std::cos(angle), 4.0 + r * std::sin(angle)) + "run 0 post no");
    const auto f = gather(scene.sim, "f");
    const auto curve = material.curve(0.5 / std::sqrt(1.25));
    const double slope = (curve.force(0.01 + 1e-6) - curve.force(0.01 - 1e-6)) / 2e-6;
    const double size = f[0] * std::cos(angle) + f[1] * std::sin(angle);
    worst = std::max(worst, std::fabs((size - curve.force(0.01)) / slope));
  }
  // R is a mean over the wall, known less exactly than the distance
  EXPECT_LT(worst, 3e-3 * delta_C);
}

TEST(WallGrid, kinks_where_particles_touch_are_refused)
{
  const auto corner = [](const double *x) {
    return std::min(x[0] - 1.0, x[1] - 1.0);
  };
  {
    GridScene scene(2, 0.1, {{"distance", corner}}, {{3.0, 3.0, 0.0}}, jkr);
    const std::string text = scene.sim.error_of("run 0");
    EXPECT_NE(text.find("is not a smooth distance at"), std::string::npos) << text;
    EXPECT_NE(text.find("an array for each side"), std::string::npos) << text;
  }
  {    // a gap narrower than the particle
    const auto slit = [](const double *x) {
      return 0.45 - std::fabs(x[0] - 4.0);
    };
    GridScene scene(2, 0.1, {{"distance", slit}}, {{4.0, 3.0, 0.0}}, jkr);
    EXPECT_NE(scene.sim.error_of("run 0").find("wall"), std::string::npos);
  }
  {    // not a distance at all
    const auto twice = [](const double *x) {
      return 2.0 * x[1];
    };
    GridScene scene(2, 0.1, {{"distance", twice}}, {{4.0, 3.0, 0.0}}, jkr);
    EXPECT_NE(scene.sim.error_of("run 0").find("is not a smooth distance"), std::string::npos);
  }
}

TEST(WallGrid, files_that_do_not_fit_are_refused)
{
  const auto refused = [](const std::string &law, const std::string &array, const char *expected) {
    try {
      GridScene scene(2, 0.4, {{array, plane(0, 1, 0, 1.0)}}, {{3.0, 3.0, 0.0}}, law);
      ADD_FAILURE() << "accepted: " << law;
    } catch (const std::runtime_error &error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  refused(jkr, "depth", "distance");
  refused(" array floor" + jkr, "distance", "floor");
  refused(jkr + "resolution 0", "distance", "resolution must be > 0, got 0");
  Simulation sim;
  Scene scene;
  scene.boundary = "f f f";
  scene.style = none;
  build(sim, {{3.0, 3.0, 3.0}}, scene);
  EXPECT_NE(
      sim.error_of("fix wall all wall/levelset file missing.vtkhdf" + jkr).find("missing.vtkhdf"),
      std::string::npos);
  EXPECT_NE(sim.error_of("fix wall all wall/levelset plane z 0 NULL" + jkr + "resolution 0.1")
                .find("for walls from a file"),
            std::string::npos);
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
  for (int n : {1, 2}) {
    EXPECT_LT(difference(states[n].x, states[0].x), 1e-4) << n;
    EXPECT_LT(difference(states[n].v, states[0].v), 2e-2) << n;
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

// Each array is a zone, named after it, with the area of its surface.
TEST(WallGrid, pieces_are_zones)
{
  const auto half_circle = [](double side) {
    return [side](const double *x) {    // two circles of radius 1
      return std::hypot(x[0] - (4.0 + 2.0 * side), x[1] - 4.0) - 1.0;
    };
  };
  GridScene scene(2, 0.1,
                  {{"distance_left", half_circle(-1.0)}, {"distance_right", half_circle(1.0)}},
                  {{0.51, 4.0, 0.0}, {2.0, 5.49, 0.0}, {6.0, 5.49, 0.0}}, jkr);
  scene.sim.run("run 0");
  EXPECT_EQ(scene.sim.value("f_wall[1][8]"), 2.0);    // attached
  EXPECT_EQ(scene.sim.value("f_wall[2][8]"), 1.0);
  EXPECT_EQ(scene.sim.value("f_wall[3][8]"), 3.0);
  for (int row : {1, 2})    // chords of a tenth: 1 - h^2/24 or better
    EXPECT_NEAR(scene.sim.value("f_wall[" + std::to_string(row) + "][13]") / (2.0 * pi), 1.0, 1e-3);
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
    EXPECT_NEAR(scene.sim.value("f_wall[" + std::to_string(row) + "][13]") / 128.0, 1.0, 1e-6);
}
