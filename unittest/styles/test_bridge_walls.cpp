// Liquid bridges at walls of other shapes than planes, and at walls from files.

#include "grid_scene.h"
#include "wet_spheres.h"

namespace {

const Liquid water;

std::string place(const double (&x)[3])
{
  return "set atom 1 x " + digits(x[0]) + " y " + digits(x[1]) + " z " + digits(x[2]) + "\n";
}

Liquid at_radius(double R)
{
  Liquid liquid = water;
  liquid.R = R;
  return liquid;
}

// outward force on atom 1 over the law, as it is moved from contact along n from the wall at `foot`
void expect_law(Simulation &sim, const Liquid &liquid, const double (&foot)[3],
                const double (&n)[3], double tolerance)
{
  sim.run("run 0 post no");
  for (const double h : {0.01, 0.05, 0.1, 0.99 * liquid.rupture(), 1.01 * liquid.rupture()}) {
    double x[3];
    for (int c = 0; c < 3; c++) x[c] = foot[c] + (0.5 + h) * n[c];
    sim.run(place(x) + "run 0 post no");
    const auto f = gather(sim, "f");
    const double law = h < liquid.rupture() ? liquid.pull(h) : 0.0;
    for (int c = 0; c < 3; c++)
      EXPECT_NEAR(f[c], -law * n[c], tolerance * liquid.pull(0.0)) << h << " " << c;
  }
}

TEST(BridgeWalls, plane_from_a_file_has_the_law_of_planes)
{
  const double n[3] = {2.0 / 3.0, 2.0 / 3.0, 1.0 / 3.0}, foot[3] = {4.0, 4.0, 4.0};
  GridScene scene(3, 0.4, {{"distance", plane(n[0], n[1], n[2], 4.0 * 5.0 / 3.0)}},
                  {{4.0 + 0.4999 * n[0], 4.0 + 0.4999 * n[1], 4.0 + 0.4999 * n[2]}},
                  " " + elastic + water.words());
  expect_law(scene.sim, at_radius(0.5), foot, n, 1e-10);
}

// R = r / sqrt(1 + r kappa), kappa = 1/2 outside of the cylinder and -1/2 inside
TEST(BridgeWalls, cylinder_has_the_law_of_its_effective_radius)
{
  const double n[3] = {0.6, 0.8, 0.0};
  for (const double side : {1.0, -1.0}) {
    const Liquid liquid = at_radius(0.5 / std::sqrt(1.0 + side * 0.25));
    EXPECT_GT(std::fabs(liquid.pull(0.01) / at_radius(0.5).pull(0.01) - 1.0), 0.05);
    const double foot[3] = {4.0 + 2.0 * n[0], 4.0 + 2.0 * n[1], 0.0};
    const double into[3] = {side * n[0], side * n[1], 0.0};
    const Sphere sphere = {foot[0] + 0.4999 * into[0], foot[1] + 0.4999 * into[1], 0.0};
    {
      Simulation sim;
      Scene scene;
      scene.before = "dimension 2";
      scene.box = "0 8 0 8 -0.5 0.5";
      scene.style = none + "fix w all wall/levelset cylinder z 4 4 2 " +
          (side > 0.0 ? "outside " : "inside ") + elastic + water.words() + "\n";
      build(sim, {sphere}, scene);
      expect_law(sim, liquid, foot, into, 1e-10);
    }
    GridScene scene(2, 0.1,
                    {{"distance",
                      [side](const double *x) {
                        return side * circle(x);
                      }}},
                    {sphere}, " " + elastic + water.words());
    expect_law(scene.sim, liquid, foot, into, 2e-3);
  }
}

// Bridges hold particles 0.5 + 1.316 rupture from the wall: 0.768 and two spacings must be known.
TEST(BridgeWalls, file_must_reach_as_far_as_bridges_do)
{
  EXPECT_NEAR(0.5 + 1.3162277660 * water.rupture(), 0.768, 0.001);
  const std::string wet = " " + elastic + water.words();
  const auto error = [](double band, const std::string &law) {
    const auto clipped = [band](const double *x) {
      return std::min(x[1] - 1.0, band);
    };
    GridScene scene(2, 0.1, {{"distance", clipped}}, {{4.0, 1.4999, 0.0}}, law);
    return scene.sim.error_of("run 0");
  };
  EXPECT_EQ(error(0.9, " " + elastic), "");
  EXPECT_EQ(error(1.0, wet), "");
  const std::string text = error(0.9, wet);
  EXPECT_NE(text.find("distances up to 0.9 from the wall"), std::string::npos) << text;
  EXPECT_NE(text.find("up to 0.7684 from it"), std::string::npos) << text;
  EXPECT_NE(text.find("up to 0.9684 or more"), std::string::npos) << text;
}

// A gap that a particle fits through, but not with its bridge: nearest points jump there.
TEST(BridgeWalls, gaps_must_be_wider_than_particles_with_bridges)
{
  const auto gap = [](const double *x) {    // 1.4 wide below the cylinder
    return std::min(circle(x), x[1] - 0.6);
  };
  const auto error = [&](const std::string &law) {
    GridScene scene(2, 0.05, {{"distance", gap}}, {{1.5, 4.0, 0.0}}, law);
    return scene.sim.error_of("run 0");
  };
  EXPECT_EQ(error(" " + elastic + " resolution 10"), "");
  const std::string text = error(" " + elastic + water.words() + " resolution 10");
  EXPECT_NE(text.find("where liquid bridges may hold particles"), std::string::npos) << text;
}

// What a run says of a sphere that touches a wall of E = 50 whose liquid pulls it in to an overlap
// at rest of `rest`, put there with one of `depth`, both in radii: 4 pi R sigma cos(theta) is the
// force of Hertz or JKR at that overlap.
std::string words_of_a_soft_wall(double gamma, double rest, double depth)
{
  Liquid liquid = at_radius(0.5);
  liquid.sigma =
      JkrCurve{0.5, 50.0, gamma}.force(0.5 * rest) / (4.0 * pi * 0.5 * std::cos(liquid.angle()));
  Simulation sim;
  Scene scene;
  scene.boundary = "f p p";
  scene.style = none + "fix w all wall/levelset plane x 1 NULL jkr 100 0 " + digits(gamma) + " " +
      liquid.words() + "\n";
  build(sim, {{1.0 + 0.5 * (1.0 - depth), 4.0, 4.0}}, scene);
  return rest > 0.5 ? sim.error_of("run 0") : log_of(sim, "run 0\n");
}
bool says(const std::string &text, const std::string &words)
{
  return text.find(words) != std::string::npos;
}

// warning from 5 %, error from 50 %
TEST(BridgeWalls, pull_of_the_liquid_counts_in_the_overlap_at_rest)
{
  const std::string warning = "WARNING: Fix wall/levelset w: particles at rest overlap by ";
  for (const double gamma : {0.0, 0.02}) {
    SCOPED_TRACE(gamma);
    EXPECT_FALSE(says(words_of_a_soft_wall(gamma, 0.0498, 0.01), "at rest overlap"));
    const auto some = words_of_a_soft_wall(gamma, 0.0502, 0.01);
    EXPECT_TRUE(says(some, warning + "0.0502 of the smaller radius")) << some;
    const auto much = words_of_a_soft_wall(gamma, 0.498, 0.01);
    EXPECT_TRUE(says(much, warning + "0.498 of the smaller radius")) << much;
    const auto error = words_of_a_soft_wall(gamma, 0.502, 0.01);
    EXPECT_TRUE(says(error, "at rest overlap by 0.502 of the smaller radius")) << error;
    EXPECT_TRUE(says(error, "above 0.5 the contact law has no meaning")) << error;
  }
}

// Twice the overlap at rest is borne in silence, whatever brings that about.
TEST(BridgeWalls, particles_may_begin_as_deep_as_the_liquid_pulls_them)
{
  for (const double gamma : {0.0, 0.02}) {
    SCOPED_TRACE(gamma);
    EXPECT_FALSE(says(words_of_a_soft_wall(gamma, 0.15, 0.298), "begin inside the wall"));
    const auto text = words_of_a_soft_wall(gamma, 0.15, 0.302);
    EXPECT_TRUE(says(text,
                     "begin inside the wall and will be shot out of it: 1 (IDs 1), up to "
                     "0.302 of their radius"))
        << text;
  }
}

// Fix freeze says that forces do not move a particle: the viscous force of its bridge to a wall is
// that of the speed at which one of the two is made to move, at steps in which it would be stopped.
TEST(BridgeWalls, frozen_particle_feels_the_speed_that_it_or_the_wall_is_given)
{
  Liquid oil = at_radius(0.5);
  oil.mu = 0.7;
  const double speed = 0.01 * oil.sigma / oil.mu, step = 1.0e-3;    // Ca = 0.01
  const double m = pi / 6.0;
  EXPECT_GT(oil.pull(0.01) * step / m, 0.2 * speed);
  for (const bool wall_moves : {false, true})
    for (const std::string style : {"verlet", "respa 2 4 pair 1", "mts"}) {
      const bool sub_steps = style == "mts";
      if (sub_steps && !wall_moves) continue;    // it moves no particles that forces do not
      SCOPED_TRACE(testing::Message() << wall_moves << style);
      Simulation sim;
      Scene scene;
      scene.boundary = "f p p";
      scene.style = none + "fix w all wall/levelset plane x 1 NULL " + elastic + oil.words() +
          (wall_moves ? "move linear " + digits(-speed) + " 0 0\n" : "\n");
      build(sim, {{1.4999, 4.0, 4.0}}, scene);
      sim.run(
          (sub_steps ? mts(4, 0.25 * step) : "run_style " + style + "\ntimestep " + digits(step)) +
          "\nfix still all freeze\n" +
          (wall_moves ? "" : "fix pull all move linear " + digits(speed) + " 0 0\n"));
      double gap = 0.0, last = 0.0;
      int seen = 0;
      for (int n = 1; n <= 60; n++) {
        sim.run("run 10 post no");
        gap = -0.0001 + 10 * n * step * speed;
        if (sim.value("f_w[10]") == 0.0) break;
        last = gap;
        if (gap < 0.01) continue;
        seen++;
        const double viscous = oil.k() * std::pow(oil.H(gap), 2) / gap * speed;
        EXPECT_NEAR(sim.value("f_w[13]") / oil.pull(gap), 1.0, 1e-9) << gap;
        EXPECT_NEAR(sim.value("f_w[16]") / viscous, 1.0, 1e-3) << gap;
      }
      EXPECT_GT(seen, 20);
      EXPECT_LE(last, oil.rupture(0.01));
      EXPECT_GT(gap, oil.rupture(0.01));
      EXPECT_LT(gap - last, 11.0 * step * speed);
    }
}

}    // namespace
