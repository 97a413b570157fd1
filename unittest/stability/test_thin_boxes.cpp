// Boxes so thin along a periodic axis that the neighbour list holds several images of a pair, while
// one of them at most can touch: springs and bridges are those of a box in which there is one
// image. Where two touch at once there is an error.

#include "scenes.h"

#include <array>

namespace {

// A chain of three spheres that turns, slides and rolls while it flies through the thin direction
// eight times; a fourth one meets it.
struct Flight {
  double thickness, skin;
  std::string law, integrator;
  std::string newton = "on";

  void start(Simulation &sim) const
  {
    Scene scene;
    scene.newton = newton;
    scene.processors = "* * 1";
    scene.box = "0 8 0 8 0 " + digits(thickness);
    scene.style = pair_of(law);
    build(sim, {{3.0, 4.0, 0.5}, {3.75, 4.0, 1.125}, {4.5, 4.0, 0.5}, {6.5, 4.25, 0.75}}, scene);
    const std::vector<std::array<double, 6>> motions = {{32, 0, 150, 0, 60, 20},
                                                        {32, 0, 150, 0, 20, 0},
                                                        {32, 0, 150, 30, -40, 0},
                                                        {0, 0, 150, 0, 0, 0}};
    for (int n = 0; n < 4; n++)
      set_motion(sim, n + 1, {motions[n][0], motions[n][1], motions[n][2]},
                 {motions[n][3], motions[n][4], motions[n][5]});
    sim.run("neighbor " + digits(skin) + " bin\n" + integrator +
            "compute agg all aggregate/contact\ncompute liquid all reduce sum c_agg[6]\n"
            "thermo_style custom step c_liquid c_agg[1]\n");
  }
};

struct Outcome {
  std::vector<double> motion, loads;
  double liquid_before, liquid, stuck;    // particles in aggregates
};

Outcome outcome_of(const Flight &flight, const std::string &run)
{
  Simulation sim;
  flight.start(sim);
  sim.run("run 0 post no");
  const double before = sim.value("c_liquid");
  sim.run(run);
  Outcome outcome{gather(sim, "v"), gather(sim, "f"), before, sim.value("c_liquid"),
                  sim.value("c_agg[1]")};
  for (const char *name : {"omega", "torque"}) {
    auto &to = name[0] == 'o' ? outcome.motion : outcome.loads;
    const auto more = gather(sim, name);
    to.insert(to.end(), more.begin(), more.end());
  }
  return outcome;
}

// collision steps: 2048 of 2^-15, in which the chain flies 9.4 diameters
const std::vector<std::array<std::string, 2>> integrators = {
    {"fix nve all nve/sphere\ntimestep 3.0517578125e-5\n", "run 2048"},
    {"fix nve all nve/sphere\ntimestep 1.220703125e-4\nrun_style respa 2 4 pair 1\n", "run 512"},
    {mts(4, 3.0517578125e-5), "run 512"}};

const std::string dry = jkr + "damping tsuji 0.1" + all_friction;
const std::string liquid = jkr +
    "damping tsuji 0.1 sliding 0.3 rolling 0.02 bridge 0.02 40.0 10 "
    "0.01 tangential yes inventory 0.3";

void expect_flight_of_a_thick_box(const std::string &law, double thickness)
{
  for (const auto &[integrator, run] : integrators)
    for (const std::string newton : {"on", "off"}) {
      if (law == liquid && newton == "off") continue;    // an inventory needs it
      SCOPED_TRACE(integrator + newton);
      const auto thick = outcome_of({8.0, 0.5, law, integrator, newton}, run);
      EXPECT_EQ(thick.stuck, 4.0) << "the fourth one has met the others";
      for (const double skin : {0.5, 2.0, 4.0}) {
        const auto thin = outcome_of({thickness, skin, law, integrator, newton}, run);
        EXPECT_EQ(thin.stuck, 4.0);
        EXPECT_LT(difference(thin.motion, thick.motion), 1e-8) << "skin " << skin;
        EXPECT_LT(difference(thin.loads, thick.loads), 1e-6) << "skin " << skin;
        EXPECT_NEAR(thin.liquid, thin.liquid_before, 1e-12 * thick.liquid_before);
        EXPECT_NEAR(thin.liquid, thick.liquid, 1e-12 * thick.liquid);
      }
    }
}

}    // namespace

TEST(RanksThinBoxes, springs_are_those_of_a_thick_box)
{
  for (const double thickness : {2.125, 3.0}) expect_flight_of_a_thick_box(dry, thickness);
}

TEST(RanksThinBoxes, bridges_are_those_of_a_thick_box)
{
  expect_flight_of_a_thick_box(liquid, 3.0);
}

// A crowd in which far images of pairs in contact are in the list, too: all skins give the same.
TEST(RanksThinBoxes, a_crowd_does_not_depend_on_the_skin)
{
  const auto crowd_with = [](double skin) {
    Scene scene;
    scene.processors = "* * 1";
    scene.box = "0 8 0 8 0 3";
    scene.style = pair_of(dry);
    Simulation sim;
    build(sim, {}, scene);
    std::vector<double> x, v;
    for (int n = 0; n < 49; n++) {
      const double phase = 0.7 * n;
      x.insert(x.end(), {0.6 + 1.12 * (n % 7), 0.6 + 1.12 * (n / 7), 1.5 + std::sin(3.0 * phase)});
      v.insert(v.end(), {20.0 * std::cos(phase), 20.0 * std::sin(phase), 15.0 * std::cos(n * n)});
    }
    add_spheres(sim, x, v);
    sim.run("neighbor " + digits(skin) +
            " bin\nneigh_modify delay 0 every 10 check no\n"
            "fix nve all nve/sphere/mts collision tolerance 0.01\ntimestep 3e-4\nrun 200");
    return std::array{gather(sim, "v"), gather(sim, "omega"), gather(sim, "torque")};
  };
  const auto narrow = crowd_with(0.25);
  for (const double skin : {1.0, 3.0}) {
    const auto wide = crowd_with(skin);
    for (size_t k = 0; k < narrow.size(); k++)
      EXPECT_LT(difference(wide[k], narrow[k]), 1e-7) << skin;
  }
}

// once the list is built anew, whose contacts are found again by ID
TEST(ThinBoxes, two_images_at_once_are_refused)
{
  const auto error_of = [](double thickness, const std::string &law, const std::string &newton,
                           const std::vector<Sphere> &spheres) {
    Scene scene;
    scene.newton = newton;
    scene.processors = "* * 1";
    scene.box = "0 8 0 8 0 " + digits(thickness);
    scene.style = pair_of(law);
    Simulation sim;
    build(sim, spheres, scene);
    return sim.error_of("fix nve all nve/sphere\ntimestep 1e-6\nneigh_modify delay 0 every 1 check "
                        "no\nrun 10");
  };
  const auto expect_refused = [](const std::string &said, const std::string &what) {
    EXPECT_NE(said.find("particle "), std::string::npos) << said;
    EXPECT_NE(said.find(what + " at about the same distance through two faces of the box"),
              std::string::npos)
        << said;
  };
  for (const std::string newton : {"on", "off"}) {
    for (const auto &law : {dry, std::string(jkr)}) {
      expect_refused(error_of(0.99, law, newton, {{3.0, 4.0, 0.5}}), "touches itself");
      const auto pair = error_of(1.5, law, newton, {{3.0, 4.0, 0.25}, {3.6, 4.0, 1.0}});
      expect_refused(
          pair, pair.find("particle 1 ") < pair.npos ? "touches particle 2" : "touches particle 1");
    }
    EXPECT_EQ(error_of(1.5, dry, newton, {{3.0, 4.0, 0.25}, {3.9, 4.0, 0.4}}), "") << "one of them";
    // elastic contacts have nothing to remember
    EXPECT_EQ(error_of(1.5, " jkr 1.0e6 0.25 0", newton, {{3.0, 4.0, 0.25}, {3.6, 4.0, 1.0}}), "");
    // a layer as thick as a sphere, which is no nearer to itself than to touch
    EXPECT_EQ(error_of(1.0, " jkr 1.0e6 0.25 0", newton, {{3.0, 4.0, 0.5}, {3.9, 4.0, 0.5}}), "");
    // films of 0.0033 each bridge a gap of 0.004 on either side
    const std::string films = jkr + "bridge 0.02 40.0 10 0.01 form film";
    const auto bridged = error_of(2.008, films, newton, {{3.0, 4.0, 0.25}, {3.0, 4.0, 1.254}});
    EXPECT_NE(bridged.find("has a liquid bridge with particle"), std::string::npos) << bridged;
    EXPECT_NE(bridged.find("thicker than two diameters and necks and bridges"), std::string::npos);
  }
}

// A neck or a bridge is drawn out until another image is as near: it never goes over to that.
TEST(ThinBoxes, joints_that_are_drawn_out_end_or_are_refused)
{
  const auto error_of = [](const std::string &law, double thickness, double speed) {
    Scene scene;
    scene.box = "0 8 0 8 0 " + digits(thickness);
    scene.style = pair_of(law);
    Simulation sim;
    build(sim, {{3.0, 4.0, 0.25}, {3.0, 4.0, 1.25}}, scene);
    sim.run("fix nve all nve/sphere\nfix hold all setforce 0 0 0\ntimestep 1e-5\n"
            "neigh_modify delay 0 every 1 check no\nrun 1 post no\nset atom 2 vz " +
            digits(speed));
    return sim.error_of("run 5000");
  };
  for (const auto &[law, thickness] :
       {std::pair{jkr, 2.0201}, std::pair{jkr + "bridge 0.02 40.0 10 0.01", 2.3}})
    EXPECT_NE(error_of(law, thickness, 5.0).find("at about the same distance through two faces"),
              std::string::npos)
        << thickness;
  EXPECT_EQ(error_of(jkr, 2.1, 5.0), "");
  EXPECT_EQ(error_of(jkr + "bridge 0.02 40.0 10 0.01", 3.0, 5.0), "");
}
