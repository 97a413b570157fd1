// Fix wall/levelset: one or two spheres at planes and cylinders against closed forms.

#include "scenes.h"

namespace {

const Material material;
const double mass = pi / 6.0;    // of a sphere of diameter and density 1
const std::string quiet = jkr + "damping tsuji 0.1 ";
const std::string none = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";

Scene at_wall(const std::string &wall, const std::string &boundary = "p p f")
{
  Scene scene;
  scene.boundary = boundary;
  scene.style = none + wall + "\n";
  return scene;
}

// overlap at which the wall carries a load, for an effective radius R
double overlap_under(double load, double R = 0.5)
{
  double low = 0.0, high = 0.2;
  for (int n = 0; n < 200; n++) {
    const double mid = 0.5 * (low + high);
    (material.curve(R).force(mid) < load ? low : high) = mid;
  }
  return low;
}

std::string number(double value)
{
  char text[32];
  snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

// ---------------------------------------------------------------------------------------------
// rest: the overlap carries the weight

double rest_height(const std::string &wall, const std::string &boundary, double z)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, z}}, at_wall("fix wall all wall/levelset " + wall + quiet, boundary));
  sim.run("fix nve all nve/sphere\nfix g all gravity 400 vector 0 0 -1\nrun 5000");
  EXPECT_LT(largest(gather(sim, "v")), 1e-9);
  EXPECT_EQ(sim.value("f_wall[7]"), 1.0);
  EXPECT_NEAR(sim.value("f_wall[3]") / (-400.0 * mass), 1.0, 1e-6) << "weight on the wall";
  return gather(sim, "x")[2];
}

TEST(Wall, sphere_rests_where_the_wall_carries_its_weight)
{
  const double overlap = overlap_under(400.0 * mass);
  ASSERT_GT(overlap, 1.1 * material.wall().delta_eq());
  EXPECT_NEAR(0.5 - rest_height("plane z 0 NULL", "p p f", 0.49), overlap, 1e-7);
  // walls of radius 3: R is the geometric mean of those along the axis and around it
  const double in = overlap_under(400.0 * mass, 0.5 / std::sqrt(1.0 - 0.5 / 3.0));
  const double out = overlap_under(400.0 * mass, 0.5 / std::sqrt(1.0 + 0.5 / 3.0));
  EXPECT_NEAR(1.5 - rest_height("cylinder x 4 4 3 inside", "p f f", 1.49), in, 1e-7);
  EXPECT_NEAR(5.5 - rest_height("cylinder y 4 2 3 outside", "p p f", 5.49), out, 1e-7);
}

TEST(Wall, plane_scene)
{
  Simulation sim;
  Scene scene = at_wall("fix wall all wall/levelset plane y 0 NULL" + quiet, "p f p");
  scene.before = "dimension 2";
  scene.box = "0 8 0 8 -0.5 0.5";
  build(sim, {{4.0, 0.49, 0.0}}, scene);
  sim.run("fix nve all nve/sphere\nfix g all gravity 400 vector 0 -1 0\nfix flat all "
          "enforce2d\nrun 5000");
  EXPECT_NEAR(0.5 - gather(sim, "x")[1], overlap_under(400.0 * mass), 1e-7);
  EXPECT_EQ(gather(sim, "x")[0], 4.0);
}

TEST(Wall, corner_holds_two_contacts)
{
  Simulation sim;
  build(sim, {{0.49, 4.0, 0.49}},
        at_wall("fix a all wall/levelset plane x 0 NULL" + quiet +
                    "\nfix b all wall/levelset plane z 0 NULL" + quiet,
                "f p f"));
  sim.run("fix nve all nve/sphere\nfix g all gravity 400 vector -3 0 -4\nrun 5000");
  EXPECT_NEAR(0.5 - gather(sim, "x")[0], overlap_under(240.0 * mass), 1e-7);
  EXPECT_NEAR(0.5 - gather(sim, "x")[2], overlap_under(320.0 * mass), 1e-7);
  EXPECT_NEAR(sim.value("f_a[1]") / (-240.0 * mass), 1.0, 1e-6);
  EXPECT_NEAR(sim.value("f_b[3]") / (-320.0 * mass), 1.0, 1e-6);
}

TEST(Wall, slit_holds_two_contacts)
{
  Simulation sim;    // symmetric: forces of both sides cancel
  build(sim, {{4.0, 4.0, 4.0}}, at_wall("fix a all wall/levelset plane z 3.51 4.49" + quiet));
  sim.run("run 0");
  EXPECT_EQ(sim.value("f_a[7]"), 2.0);
  EXPECT_LT(largest(gather(sim, "f")), 1e-9);
  // twice the virial of one contact, each force times its arm
  sim.run("fix_modify a virial yes\ncompute p all pressure NULL fix\nrun 0");
  EXPECT_NEAR(sim.value("c_p[3]*vol") / (2.0 * 0.49 * material.wall().force(0.01)), 1.0, 1e-6);
}

TEST(Wall, is_a_sphere_of_huge_radius)
{
  auto force = [](const std::vector<Sphere> &spheres, const Scene &scene) {
    Simulation sim;
    build(sim, spheres, scene);
    sim.run("run 0");
    return gather(sim, "f")[2];
  };
  Scene scene;
  scene.box = "-600 600 -600 600 -600 1800";
  scene.style = none;
  const double pair = force({{0.0, 0.0, 0.49}, {0.0, 0.0, -500.0, 1000.0}}, scene);
  const double wall =
      force({{4.0, 4.0, 0.49}}, at_wall("fix wall all wall/levelset plane z 0 NULL" + jkr));
  EXPECT_NEAR(wall / material.wall().force(0.01), 1.0, 1e-9);
  EXPECT_NEAR(pair / wall, 1.0, 2e-3);
  EXPECT_NEAR(pair / material.pair(1.0, 1000.0).force(0.01), 1.0, 1e-8);
}

// ---------------------------------------------------------------------------------------------
// C13, B2.7: the rolling spring carries a load below the threshold without creep

struct Pushed {
  double early, late, speed;    // displacement after the ramp, and at the end
};

Pushed pushed(double share)
{
  const auto curve = material.wall();
  const double arm = 0.5 - curve.delta_eq(), crit = 4.0 * curve.F_C() * 0.01 * 0.5 / arm;
  Simulation sim;
  build(sim, {{4.0, 4.0, arm}},
        at_wall("fix wall all wall/levelset plane z 0 NULL" + quiet +
                "sliding 0.5 rolling 0.01 0.5"));
  sim.run("variable F equal " + number(share * crit) +
          "*ramp(0,1)\nfix nve all nve/sphere\n"
          "fix push all addforce v_F 0 0\nthermo 1000000\nrun 20000\nunfix push\n"
          "fix push all addforce " +
          number(share * crit) + " 0 0\nrun 10000");
  Pushed result;
  result.early = gather(sim, "x")[0] - 4.0;
  sim.run("run 70000");
  result.late = gather(sim, "x")[0] - 4.0;
  result.speed = std::fabs(gather(sim, "v")[0]) + std::fabs(gather(sim, "omega")[1]);
  return result;
}

TEST(Wall, rolling_spring_carries_half_its_limit_without_creep)
{
  const auto curve = material.wall();
  const double arm = 0.5 - curve.delta_eq();
  const Pushed half = pushed(0.5), near = pushed(0.95);
  // M = F arm = 4 F_C xi; the centre moves by arm xi / r and by the sliding spring, F / k_T
  const double force = 0.5 * 4.0 * curve.F_C() * 0.01 * 0.5 / arm;
  const double xi = force * arm / (4.0 * curve.F_C());
  const double offset = arm * xi / 0.5 + force / (8.0 * material.G_eff() * curve.a0());
  EXPECT_NEAR(half.early / offset, 1.0, 0.01);
  EXPECT_LT(std::fabs(half.late - half.early), 1e-6 * 0.5);
  EXPECT_LT(half.speed, 1e-9);
  EXPECT_NEAR(near.early / (1.9 * offset), 1.0, 0.01);
  EXPECT_LT(std::fabs(near.late - near.early), 1e-6 * 0.5);
}

TEST(Wall, sphere_rolls_above_the_limit)
{
  // Force minus limit moves mass and rotary inertia without slip: a = excess / (m + I/r^2)
  const auto curve = material.wall();
  const double arm = 0.5 - curve.delta_eq(), crit = 4.0 * curve.F_C() * 0.01 * 0.5 / arm;
  Simulation sim;
  build(sim, {{4.0, 4.0, arm}},
        at_wall("fix wall all wall/levelset plane z 0 NULL" + quiet +
                "sliding 0.5 rolling 0.01 0.5"));
  sim.run("fix nve all nve/sphere\nfix push all addforce " + number(2.0 * crit) + " 0 0\nrun 4000");
  const double v0 = gather(sim, "v")[0];
  sim.run("run 4000");
  const double v1 = gather(sim, "v")[0], acceleration = (v1 - v0) / (4000 * dt);
  EXPECT_NEAR(acceleration / (crit / (mass * (1.0 + 0.4 * 0.25 / (arm * arm)))), 1.0, 0.01);
  EXPECT_NEAR(gather(sim, "omega")[1] * arm / v1, 1.0, 0.01);
}

// ---------------------------------------------------------------------------------------------
// impacts

// speed after an impact with v, 0 if it sticks
double rebound(const std::string &law, double v, double t = 1.0)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.505}}, at_wall("fix wall all wall/levelset plane z 0 NULL" + law));
  set_motion(sim, 1, {0.0, 0.0, -v}, {0.0, 0.0, 0.0});
  sim.run("timestep " + number(dt / 4) + "\nfix nve all nve/sphere\nrun " +
          std::to_string(static_cast<int>(t / dt)));
  return sim.value("f_wall[7]") == 0.0 ? gather(sim, "v")[2] : 0.0;
}

TEST(Wall, restitution_of_tsuji_is_exact)
{
  for (const double e : {0.9, 0.5, 0.2})
    for (const double v : {1.0, 3.0})
      EXPECT_NEAR(rebound(" jkr 1.0e6 0.25 0 damping tsuji " + number(e), v, 0.3) / (e * v), 1.0,
                  0.005);
}

TEST(Wall, sticking_velocity_is_that_of_jkr)
{
  // B2.2: V_s = 1.8402 [(w/R)^5 / (rho^3 E^2)]^(1/6), w = 2 gamma, R = r
  const double E = material.E_eff();
  const double V_s = 1.8402 * std::pow(std::pow(200.0 / 0.5, 5) / (E * E), 1.0 / 6.0);
  EXPECT_EQ(rebound(jkr, 0.98 * V_s), 0.0);
  EXPECT_GT(rebound(jkr, 1.02 * V_s), 0.0);
  EXPECT_NEAR(rebound(jkr, 1.5 * V_s) / (1.5 * V_s), std::sqrt(1.0 - 1.0 / 2.25), 0.005);
  // break at the force maximum gives up half of it: 0.462 instead of 0.9355 F_C delta_C
  EXPECT_NEAR(rebound(jkr + "break force", 1.5 * V_s) / (1.5 * V_s),
              std::sqrt(1.0 - 0.462025 / 0.935503 / 2.25), 0.005);
}

TEST(Wall, contacts_begun_and_ended_are_counted)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.505}}, at_wall("fix wall all wall/levelset plane z 0 NULL" + jkr));
  set_motion(sim, 1, {0.0, 0.0, -8.0}, {0.0, 0.0, 0.0});
  sim.run("fix nve all nve/sphere\nrun 20");
  const std::vector<double> in = {sim.value("f_wall[7]"), sim.value("f_wall[8]"),
                                  sim.value("f_wall[9]")};
  EXPECT_EQ(in, (std::vector<double>{1.0, 1.0, 0.0}));
  sim.run("run 4000");
  const std::vector<double> out = {sim.value("f_wall[7]"), sim.value("f_wall[8]"),
                                   sim.value("f_wall[9]")};
  EXPECT_EQ(out, (std::vector<double>{0.0, 1.0, 1.0}));
}

TEST(Wall, energy_of_an_elastic_bounce_is_kept)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.505}},
        at_wall("fix wall all wall/levelset plane z 0 NULL jkr 1.0e6 0.25 0\nfix_modify wall "
                "energy yes"));
  sim.run("compute ke all ke\nthermo_modify norm no");
  set_motion(sim, 1, {0.0, 0.0, -3.0}, {0.0, 0.0, 0.0});
  sim.run("fix nve all nve/sphere\nrun 0");
  const double start = 0.5 * mass * 9.0;
  double most = 0.0;
  for (int n = 0; n < 40; n++) {
    sim.run("run 10");
    most = std::max(most, sim.value("pe"));
    EXPECT_NEAR(sim.value("pe+c_ke") / start, 1.0, 1e-4);
  }
  EXPECT_GT(most, 0.9 * start);    // it was in contact
}

TEST(Wall, centre_behind_the_wall_is_an_error)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 1.0}},
        at_wall("fix wall all wall/levelset plane z 0 NULL" + jkr, "p p m"));
  set_motion(sim, 1, {0.0, 0.0, -2000.0}, {0.0, 0.0, 0.0});
  const std::string text = sim.error_of("fix nve all nve/sphere\nrun 1000");
  EXPECT_NE(text.find("the centre of atom 1"), std::string::npos) << text;
}

// Fix evaporate deletes the first atom before the wall, defined after it, has stored its contacts:
// necks must not be lost.
TEST(Wall, stands_beside_a_fix_that_deletes_atoms)
{
  Simulation sim;
  Scene scene = at_wall("", "p p f");
  scene.before = "atom_modify sort 0 0";
  build(sim, {{6.0, 6.0, 6.0}, {2.0, 2.0, 0.49}, {5.0, 5.0, 0.49}}, scene);
  const std::string refusal =
      sim.error_of("group out id 1\nregion up block 0 8 0 8 1 8\nfix ev out evaporate 3 1 up 4321\n"
                   "fix wall all wall/levelset plane z 0 NULL" +
                   jkr +
                   "\nrun 0\n"
                   "displace_atoms all move 0 0 0.012 units box\nrun 10");
  if (refusal.empty())
    EXPECT_EQ(sim.value("f_wall[7]"), 2.0);
  else
    EXPECT_NE(refusal.find("evaporate"), std::string::npos) << refusal;
}

// ---------------------------------------------------------------------------------------------
// loads on the wall, on all ranks

const std::string rough = "fix wall all wall/levelset plane z 0 NULL" + jkr + all_friction;

void load_wall_springs(Simulation &sim)
{
  load_springs(sim, 64, {0.03, -0.05, 0.0}, {0.2, 0.1, 0.3}, {-0.1, 0.4, 0.2});
  sim.run("run 1");
}

TEST(RanksWall, loads_balance_those_on_the_particles)
{
  for (const std::string &wall :
       {rough, "fix wall all wall/levelset cylinder x 4 4 3.99 inside" + jkr + all_friction}) {
    Simulation sim;
    const bool plane = wall == rough;
    Scene scene = at_wall(wall, plane ? "p p f" : "p f f");
    const double z = plane ? 0.48 : 0.485;
    build(sim, {{1.0, plane ? 2.0 : 4.0, z}, {6.0, plane ? 7.0 : 4.1, 0.49}}, scene);
    load_wall_springs(sim);
    const State s = state_of(sim);
    ASSERT_GT(largest(s.torque), 0.1);
    for (int c = 0; c < 3; c++) {
      const int a = (c + 1) % 3, b = (c + 2) % 3;
      double force = 0.0, torque = 0.0;
      for (int i = 0; i < 6; i += 3) {
        force += s.f[i + c];
        torque += s.x[i + a] * s.f[i + b] - s.x[i + b] * s.f[i + a] + s.torque[i + c];
      }
      EXPECT_NEAR(sim.value("f_wall[" + std::to_string(1 + c) + "]") + force, 0.0, 1e-10);
      EXPECT_NEAR(sim.value("f_wall[" + std::to_string(4 + c) + "]") + torque, 0.0, 1e-9);
    }
    EXPECT_EQ(sim.value("f_wall[7]"), 2.0);
  }
}

// A wall contact on a journey, against the same journey without exchange and periodic wrap. Without
// a limit of friction the sliding spring grows all the way.
TEST(RanksWall, springs_travel_along_the_wall)
{
  auto loads = [](const std::string &friction, const std::string &neighbors,
                  const std::string &before) {
    Simulation sim;
    Scene scene = at_wall("fix wall all wall/levelset plane z 0 NULL" + jkr + friction);
    scene.before = before;
    build(sim, {{1.0, 2.0, 0.48}, {6.0, 7.0, 0.49}}, scene);
    sim.run(neighbors);
    load_wall_springs(sim);
    sim.run("velocity all set 64 -32 0\nfix mv all move linear 64 -32 0 units box\nrun 2200");
    return state_of(sim);
  };
  const std::string never = "neighbor 2.0 bin\nneigh_modify delay 1000000 every 1000000 check no";
  const std::string often = "neighbor 0.125 bin\nneigh_modify delay 0 every 1 check yes";
  for (const std::string &friction : {all_friction, std::string("sliding 1e9")}) {
    const State twin = loads(friction, never, "");
    ASSERT_GT(largest(twin.torque), 0.1);
    for (const char *before : {"", "atom_modify sort 5 1.0"}) {
      SCOPED_TRACE(friction + " " + before);
      expect_same_loads(loads(friction, often, before), twin, 1e-12);
    }
    if (friction == all_friction) continue;
    const double length = 64.0 * 2200 * dt;
    // sphere 2 was loaded by its spin: omega x r, r = (0, 0, -0.49)
    const double slip = -0.49 * 0.4 * 64 * dt;
    EXPECT_NEAR(twin.f[3] / (-8.0 * material.G_eff() * material.wall().a(0.01) * (length + slip)),
                1.0, 1e-7);
  }
}

}    // namespace
