// Impacts that steps are too long for, C4 of the list of hard cases, under velocity Verlet and
// stock r-RESPA: none is missed in steps that follow impacts, and in others an error comes before
// a force has acted. As for fix nve/sphere/mts, see test_mts_look_ahead.cpp.

#include "impacts.h"

#include <array>
#include <memory>
#include <random>

namespace {

enum Body { PAIR, PLANE, ROD };
const char *const names[] = {"from all sides", "on a plane", "on a rod"};

// Impacts up to 0.99 of the way past each other, at unit speed. The force acts along the line
// between the middles, or along the normal, so that an impact leaves the speed as it is and turns
// it.
struct Impacts {
  Body body;
  std::vector<double> x, v, turn;    // turn: a part of what rigid bodies would do
  int side;                          // cells of 9 in a row

  Impacts(Body body, int n, int seed) :
      body(body), side(static_cast<int>(std::ceil(std::cbrt(n)))), random(seed)
  {
    for (int k = 0; k < n; k++) {
      const double b = 0.99 * std::sqrt(uniform(random)), head_on = std::sqrt(1.0 - b * b);
      turn.push_back(0.1 * 2.0 * head_on);
      if (body == PAIR)
        add_pair(k, b);
      else
        add_at_wall(b, head_on);
    }
  }

  // ... in a simulation of its own
  std::unique_ptr<Simulation> scene(const std::string &law) const
  {
    Scene scene;
    scene.style = pair_of(law);
    if (body == PAIR) {
      const std::string width = "0 " + std::to_string(9 * side) + " ";
      scene.box = width + width + width;
    } else {
      scene.boundary = body == ROD ? "p f f" : "p p f";
      scene.box = "0 4000 -8 8 -8 8";
      scene.style += "neigh_modify exclude type 1 1\nfix wall all wall/levelset " +
          std::string(body == ROD ? "cylinder x 0 0 1 outside" : "plane z -4 NULL") + law + "\n";
    }
    auto sim = std::make_unique<Simulation>();
    build(*sim, {}, scene);
    add_spheres(*sim, x, v);
    return sim;
  }

  int size() const { return static_cast<int>(turn.size()); }
  double change2(const std::vector<double> &after, int k) const
  {
    return square(relative(after, k), relative(v, k));
  }
  double energy(const std::vector<double> &after, int k) const
  {
    return square(relative(after, k), {});
  }
  int missed_or_wrong(const std::vector<double> &after) const
  {
    int bad = 0;
    for (int k = 0; k < size(); k++)
      bad += std::sqrt(change2(after, k)) < turn[k] || std::fabs(energy(after, k) - 1.0) > 0.01;
    return bad;
  }
  int touched(const std::vector<double> &after) const    // by a force
  {
    int some = 0;
    for (int k = 0; k < size(); k++) some += change2(after, k) > 0.0;
    return some;
  }

 private:
  std::mt19937 random;
  std::normal_distribution<double> gauss;
  std::uniform_real_distribution<double> uniform;

  void add_pair(int k, double b)
  {
    double e[3], t[3], e2 = 0.0, t2 = 0.0, et = 0.0;
    for (int c = 0; c < 3; c++) e[c] = gauss(random), t[c] = gauss(random);
    for (int c = 0; c < 3; c++) e2 += e[c] * e[c], et += e[c] * t[c];
    for (int c = 0; c < 3; c++) t[c] -= et / e2 * e[c];
    for (int c = 0; c < 3; c++) t2 += t[c] * t[c];
    const double far = 1.5 + 3.0 * uniform(random);
    const int cell[3] = {k % side, k / side % side, k / side / side};
    for (const double sign : {-0.5, 0.5})
      for (int c = 0; c < 3; c++) {
        x.push_back(9.0 * (cell[c] + 0.5) +
                    sign * (far * e[c] / std::sqrt(e2) + b * t[c] / std::sqrt(t2)));
        v.push_back(-sign * e[c] / std::sqrt(e2));
      }
  }
  // a rod of radius 1 along x, or the plane z = -4
  void add_at_wall(double b, double head_on)
  {
    const double far = 0.3 + 2.0 * uniform(random), turned = 2.0 * pi * uniform(random);
    const double c = std::cos(turned), s = std::sin(turned), along = 4000.0 * uniform(random);
    if (body == ROD) {
      const double D = 1.5, back = D * head_on + far;
      x.insert(x.end(), {along, -back * c - D * b * s, -back * s + D * b * c});
      v.insert(v.end(), {0.0, c, s});
    } else {
      x.insert(x.end(), {along, 16.0 * uniform(random) - 8.0, -3.5 + far * head_on});
      v.insert(v.end(), {b * c, b * s, -head_on});
    }
  }

  using Vector = std::array<double, 3>;
  Vector relative(const std::vector<double> &of, int k) const
  {
    if (body != PAIR) return {of[3 * k], of[3 * k + 1], of[3 * k + 2]};
    Vector u;
    for (int c = 0; c < 3; c++) u[c] = of[6 * k + c] - of[6 * k + 3 + c];
    return u;
  }
  static double square(const Vector &a, const Vector &b)
  {
    double sum = 0.0;
    for (int c = 0; c < 3; c++) sum += (a[c] - b[c]) * (a[c] - b[c]);
    return sum;
  }
};

// what ends a run whose steps are too long; a plane has its own words for what is behind it
bool is_of_a_step(const std::string &error)
{
  for (const char *words : {"meet at a speed of", "and the wall meet at", "fly through each other",
                            "flew through", "move by", "is outside the fluid"})
    if (error.find(words) != std::string::npos) return true;
  return false;
}

// skins that the speeds of particle steps nearly fill: in all directions they differ by up to 1.7
TEST(Tunnelling, no_impact_is_missed_in_steps_that_follow_it)
{
  for (const std::string name : {"verlet", "respa"})
    for (const Body body : {PAIR, PLANE, ROD}) {
      const Impact impact(1e3, body != PAIR, 0.0);
      const int n = body == PAIR ? count(5000, 100000) : count(2000, 20000);
      const Impacts impacts(body, n, 4);
      auto sim = impacts.scene(impact.law());
      const Steps steps(name, 1.0, impact.duration / 50.0);
      sim->run(steps.commands(body == PAIR ? 1.75 : 3.5) + steps.run(6));
      expect_criterion("C4 " + name + ": missed of " + std::to_string(n) + " impacts " +
                           names[body] + ", steps of 1/50 of an impact (0.003 d/U)",
                       impacts.missed_or_wrong(gather(*sim, "v")), 0.0, 0.0);
    }
}

// Steps of more than d/2 and of much more than an impact, with lists that reach far and not: each
// impact by itself ends the run before its force, or its absence, has changed anything.
TEST(Tunnelling, impacts_too_fast_for_the_step_are_an_error)
{
  for (const std::string name : {"verlet", "respa"})
    for (const Body body : {PAIR, PLANE, ROD}) {
      const Impact impact(1e3, body != PAIR, 0.0);
      const int n = count(12, 400);
      int unseen = 0, spoilt = 0;
      for (const double step : {0.6, 1.0, 1.7, 3.4})
        for (int k = 0; k < n; k++) {
          const Impacts one(body, 1, k);
          auto sim = one.scene(impact.law());
          const Steps steps(name, name == "verlet" ? step : 2.0 * step, step);
          const double skin = name == "verlet" && k % 2 ? 0.3 : 2.1 * steps.particle;
          const auto said = sim->error_of(steps.commands(skin) +
                                          steps.run(static_cast<int>(6.0 / steps.particle) + 1));
          unseen += !is_of_a_step(said);
          spoilt += one.touched(gather(*sim, "v"));
        }
      const std::string which = "C4 " + name + ": of " + std::to_string(4 * n) + " impacts " +
          names[body] + " in steps of 0.6, 1, 1.7 and 3.4 d/U, ";
      expect_criterion(which + "without an error", unseen, 0.0, 0.0);
      expect_criterion(which + "changed before it", spoilt, 0.0, 0.0);
    }
}

// the names, the speed and the step that does
TEST(Tunnelling, errors_name_who_how_fast_and_what_would_do)
{
  const Impact impact(1e3, false, 0.0), at_wall(1e3, true, 0.0);
  Scene scene;
  scene.boundary = "f p p";
  scene.style = pair_of(impact.law()) + "fix wall all wall/levelset plane x 0 NULL" + at_wall.law();
  const auto said = [&](double v, double step, double gap) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}, {4.0 + gap, 4.0, 4.0}}, scene);
    set_motion(sim, 1, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
    return sim.error_of(Steps("verlet", step, step).commands(0.5) + "run 20");
  };
  const double T = impact.duration;    // at speed 1
  EXPECT_EQ(said(1.0, 0.49 * T, 0.01), "");
  for (const auto &[v, step] : {std::pair(1.0, 0.51 * T), std::pair(-4.0, 0.325)}) {
    const auto text = said(v, step, 0.01);
    const bool wall = v < 0.0;
    char words[4][80];
    snprintf(words[0], 80, "meet at a speed of %.3g", std::fabs(v));
    const double lasts = (wall ? at_wall.duration : T) * std::pow(std::fabs(v), -0.2);
    snprintf(words[1], 80, "for %.3g by their stiffness, too short for steps of %.3g", lasts, step);
    snprintf(words[2], 80, "use timestep %.2g or smaller", lasts / 20.0);
    snprintf(words[3], 80, wall ? "atom 1 and the wall" : "particles 1 and 2");
    for (const char *word : words) EXPECT_NE(text.find(word), std::string::npos) << text << word;
  }
}

// ... of pairs that are on the far side of each other a step later, and of those that no list shows
TEST(Tunnelling, passages_between_two_positions_are_an_error)
{
  const auto said = [&](double v, double gap, double across, double skin) {
    Simulation sim;
    Scene scene;
    scene.box = "0 40 0 40 0 8";
    scene.style = pair_of(Impact(1e3, false, 0.0).law());
    build(sim, {{5.0, 4.0, 4.0}, {6.0 + gap, 4.0 + across, 4.0}}, scene);
    set_motion(sim, 1, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
    return sim.error_of(Steps("verlet", 1.0, 1.0).commands(skin) + "run 3");
  };
  for (const auto &[text, words] :
       {std::pair(said(3.2, 1.0, 0.0, 1.1), "particles 1 and 2 flew through each other unseen"),
        std::pair(said(0.6, 1.0, 0.97, 1.1), "particles 1 and 2 may fly through each other unseen"),
        std::pair(said(5.0, 1.5, 0.0, 0.5),
                  "move by 5 against each other in a step of 1, farther "
                  "than the 2.24 within which a neighbor skin of 0.5")})
    EXPECT_NE(text.find(words), std::string::npos) << text;
  // those that do not meet, and those that move by less than half their distance of touch
  EXPECT_EQ(said(0.6, 1.0, 1.01, 1.1), "");
  EXPECT_EQ(said(0.49, 1.6, 0.97, 1.1), "");
}

// Lists that a script keeps for too long hide pairs from integrators that do not have them built
// themselves: one of two like spheres that collide head-on is to stop, and flies on.
TEST(Tunnelling, lists_that_are_kept_for_too_long_are_warned_of)
{
  const auto warnings = [](const std::string &integrator, const std::string &options, bool meets) {
    SCOPED_TRACE(integrator + options);
    Scene scene;
    scene.style = pair_of(jkr);
    Simulation sim;
    build(sim, {{2.0, 4.0, 4.0}, {6.0, 4.0, 4.0}}, scene);
    set_motion(sim, 1, {100.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("neighbor 0.5 bin\ntimestep " + digits(dt) + "\n" + integrator + "\n" +
            (options.empty() ? "" : "neigh_modify " + options));
    const double step = sim.lammps()->update->dt;
    const auto log = log_of(sim, "run " + std::to_string(std::lround(900 * dt / step)) + "\n");
    EXPECT_NEAR(gather(sim, "v")[0], meets ? 0.0 : 100.0, 1.0);
    int count = 0;
    const std::string words = "WARNING: Pair granular/adhesive: with neigh_modify ";
    for (size_t at = 0; (at = log.find(words, at)) != log.npos; at++) count++;
    const std::string cure = "use neigh_modify delay 0 every 1 check yes";
    EXPECT_EQ(log.find(cure) != log.npos, count > 0) << log;
    return count;
  };
  const std::string verlet = "fix nve all nve/sphere", respa = "\nrun_style respa 2 4 pair 1";
  for (const std::string options : {"", "delay 0 every 1 check yes", "check no", "delay 1"})
    EXPECT_EQ(warnings(verlet, options, true), 0);
  for (const std::string options :
       {"delay 1000", "every 1000 check no", "every 1000 delay 1000", "once yes"})
    EXPECT_EQ(warnings(verlet, options, false), 1);
  EXPECT_EQ(warnings(verlet, "delay 10", true), 1);
  for (const std::string &integrator : {mts(4), verlet + respa})
    EXPECT_EQ(warnings(integrator, "delay 1000 every 1000", true), 0);
}

// what is inserted into others within a run: its contact has no speed that it came with
TEST(Tunnelling, particles_inserted_into_others_are_an_error)
{
  for (const bool apart : {true, false}) {
    Scene scene;
    scene.style = pair_of(Impact(1e3, false, 0.0).law());
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}}, scene);
    const auto said =
        sim.error_of("region there block 4 4.2 4 4.2 " + std::string(apart ? "6 6.2" : "4.2 4.4") +
                     "\nfix add all deposit 1 1 5 4711 region there\nfix nve all nve/sphere\n"
                     "neigh_modify delay 0\ntimestep 1e-3\nrun 20");
    if (apart)
      EXPECT_EQ(said, "");
    else
      EXPECT_NE(said.find("inside each other in a step of 0.001, not by their velocities"),
                std::string::npos)
          << said;
  }
}

// Sound runs do not get it: a damped crowd that collides and sticks, with steps of 0.3 and of the
// 0.8 that are stable, and pairs that graze each other.
TEST(Tunnelling, sound_steps_are_no_error)
{
  for (const double omega_dt : {0.3, 0.8})
    for (const double gamma : {0.0, 100.0}) {
      Scene scene;
      scene.box = "0 9 0 9 0 9";
      scene.style = pair_of(" jkr 1e6 0.25 " + digits(gamma) + " damping tsuji 0.6 sliding 0.3" +
                            (gamma > 0.0 ? " rolling 0.02" : ""));
      Simulation sim;
      build(sim, {}, scene);
      std::mt19937 random(7);
      std::normal_distribution<double> gauss;
      std::vector<double> x, v;
      for (int k = 0; k < 343; k++)
        for (const int c : {k % 7, k / 7 % 7, k / 49}) {
          x.push_back(0.6 + 1.28 * c);
          v.push_back(2.0 * gauss(random));
        }
      add_spheres(sim, x, v);
      const Material material{1e6, 0.25, gamma};
      const auto curve = material.pair();
      const double m = pi / 12.0, a = gamma > 0.0 ? curve.a0() : 0.1 * curve.R;
      const double omega = std::sqrt((gamma > 0.0 ? 1.2 : 2.0) * curve.E * a / m);
      sim.run("fix nve all nve/sphere\ntimestep " + digits(omega_dt / omega) +
              "\nneigh_modify delay 0\ncompute n all contact/atom\ncompute all all reduce sum c_n\n"
              "run 1500\nvariable contacts equal c_all\nrun 0");
      EXPECT_GT(sim.value("v_contacts"), gamma > 0.0 ? 300.0 : -1.0);
    }
}

TEST(Tunnelling, grazing_is_no_error)
{
  const Impact impact(1e3, false, 0.0);
  for (const double step : {0.02, 0.05, 0.1}) {
    Scene scene;
    scene.box = "0 12 0 44 0 8";
    scene.style = pair_of(impact.law());
    Simulation sim;
    build(sim, {}, scene);
    std::vector<double> x, v;
    for (int k = 0; k < 20; k++)    // by the cosine of b/D = 1 - 1e-2 to 1 - 1e-12
      for (const double sign : {-0.5, 0.5}) {
        x.insert(
            x.end(),
            {6.0 + 3.0 * sign, 2.0 + 2.1 * k + sign * (1.0 - std::pow(10.0, -2.0 - 0.5 * k)), 4.0});
        v.insert(v.end(), {-0.5 * sign, 0.0, 0.0});
      }
    add_spheres(sim, x, v);
    sim.run(Steps("verlet", step, step).commands(0.5) + "run " +
            std::to_string(static_cast<int>(8.0 / step)));
  }
}

// Spheres of 1 um that fall through water on a plane in steps of nine times their relaxation time:
// drag and contact together are stable, omega dt of the contact alone is 2.9. They come to rest
// where the weight of each is held.
TEST(Tunnelling, steps_far_beyond_the_relaxation_time_are_no_error)
{
  for (const std::string style : {"",
                                  "run_style respa 2 2 pair 2\nfix_modify drag respa 2\n"
                                  "fix_modify w respa 2\n"}) {
    Simulation sim;
    sim.run("units si\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
            "boundary p p f\nregion box block 0 1e-5 0 1e-5 0 2e-5\ncreate_box 1 box\n"
            "create_atoms 1 single 3e-6 5e-6 5.2e-7\ncreate_atoms 1 single 7e-6 5e-6 5.4e-7\n"
            "create_atoms 1 single 7e-6 5e-6 1.57e-6\nset group all diameter 1e-6 density 2000\n"
            "pair_style granular/adhesive\npair_coeff * * jkr 1e5 0.25 1e-5 damping tsuji 0.5\n"
            "neighbor 5e-7 bin\nneigh_modify delay 0\n"
            "fix w all wall/levelset plane z 0 2e-5 jkr 1e5 0.25 1e-5\n"
            "fix air all flow/field uniform 0 0 0 density 1000 viscosity 1e-3\n"
            "fix drag all flow/force air drag stokes gravity 0 0 -9.81\nfix move all nve/sphere\n"
            "timestep 1e-6\nthermo_style custom step\n" +
            style + "run 250000");
    EXPECT_EQ(sim.value("f_w[7]"), 2.0) << "on the wall";
    EXPECT_LT(largest(gather(sim, "v")), 1e-9);
    const double buoyant = pi / 6.0 * 1e-18 * 1000.0 * 9.81;
    EXPECT_NEAR(-sim.value("f_w[3]") / (3.0 * buoyant), 1.0, 1e-6);
  }
}

// fix nve/limit takes overlapping spheres apart, as slowly as it says
TEST(Tunnelling, limited_motion_is_no_error)
{
  Scene scene;
  scene.style = pair_of(Impact(1e3, false, 0.0).law());
  Simulation sim;
  build(sim, {{3.0, 4.0, 4.0}, {3.7, 4.0, 4.0}, {5.0, 4.0, 4.0}}, scene);
  sim.run("fix lim all nve/limit 0.05\nneigh_modify delay 0\ntimestep 0.05\nrun 100");
  const auto x = gather(sim, "x");
  EXPECT_GT(x[3] - x[0], 0.99);
  EXPECT_GT(x[6] - x[3], 0.99);
}

// Across a large sheared box velocities differ more than a skin allows, those of neighbours do not.
TEST(Tunnelling, a_large_sheared_box_is_no_error)
{
  for (const bool gas : {false, true}) {
    Simulation sim;
    sim.run("newton on\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
            "region box prism 0 6 0 500 0 6 0 0 0\ncreate_box 1 box\n"
            "create_atoms 1 random 400 4711 box overlap 1.0 maxtry 2000\n"
            "set group all diameter 1 density 1\nvariable u atom 0.4*(y-250)\n"
            "variable random atom 200*(random(0,1,7)-0.5)\nvelocity all set v_" +
            std::string(gas ? "random" : "u") + " 0 0\n" +
            pair_of(" jkr 1e3 0.25 0 damping tsuji 0.9") +
            "neighbor 0.1 bin\nneigh_modify delay 0\nfix d all deform 1 xy erate 0.4 remap v\n"
            "fix nve all nve/sphere\ntimestep 5e-3\n");
    const auto said = sim.error_of("run 100");
    if (gas)
      EXPECT_NE(said.find("against each other in a step of 0.005"), std::string::npos) << said;
    else
      EXPECT_EQ(said, "");
  }
}

// a wall that moves over particles that fix freeze holds pushes nobody
TEST(Tunnelling, frozen_particles_at_a_fast_wall_are_no_error)
{
  Scene scene = beside_a_wall();
  scene.style = pair_of(Impact(1e3, false, 0.0).law());
  Simulation sim;
  build(sim, {{2.0, 4.0, 4.0}, {5.0, 4.0, 4.0}}, scene);
  sim.run("group held id 1\nfix nve all nve/sphere\nfix still held freeze\n"
          "fix w held wall/levelset plane x 0 NULL" +
          Impact(1e3, true, 0.0).law() + " move linear 25 0 0\ntimestep 0.01\n");
  EXPECT_EQ(sim.error_of("run 6"), "");
}

}    // namespace
