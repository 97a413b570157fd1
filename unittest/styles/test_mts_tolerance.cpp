// collision tolerance T: the number of collision steps follows each contact's speed,
// omega dt <= min(0.8, sqrt(8 T max(1, 2 F_C delta_C / (m v^2)))), and the error follows T.

#include "scenes.h"

namespace {

const Material material;
const JkrCurve curve = material.pair();
const double mass = pi / 6.0, m = 0.5 * mass;    // d = 1, density 1; effective mass
const double slow2 = 2.0 * curve.F_C() * curve.delta_C() / m;
const double sticking_speed = std::sqrt(0.935503 * slow2);

// The normal force and what is added: the stiffest mode is sqrt(6/5 E a0 / m) at rest.
std::string normal_only(const std::string &more = "")
{
  return "pair_style granular/adhesive\npair_coeff * *" + jkr + more + "\nneighbor 2.5 bin\n";
}

// two spheres
void place(Simulation &sim, double distance, double speed, const std::string &how, double step)
{
  Scene scene;
  scene.style = normal_only();
  build(sim, {{3.0, 4.0, 4.0}, {3.0 + distance, 4.0, 4.0}}, scene);
  char line[200];
  snprintf(line, sizeof(line), "timestep %.17g\nset atom 1 vx %.17g\nset atom 2 vx %.17g\n", step,
           0.5 * speed, -0.5 * speed);
  sim.run(line + ("fix move all nve/sphere/mts collision " + how + "\n"));
}

double steps_at(double overlap, double speed, double tolerance, double step)
{
  Simulation sim;
  place(sim, 1.0 - overlap, speed, "tolerance " + std::to_string(tolerance), step);
  sim.run("run 1");
  return sim.value("f_move[1]");
}

// restitution of a head-on impact without damping: sqrt(1 - (V_s/V)^2)
double restitution(double speed, double gap, const std::string &how)
{
  Simulation sim;
  place(sim, 1.0 + gap, speed, how, 0.01 / speed);
  sim.run("run 40");
  EXPECT_EQ(sim.value("f_move[5]"), 0.0) << "found late";
  return (sim.value("vx[2]") - sim.value("vx[1]")) / speed;
}

// over speeds and phases of the time grid, also with a touch or an end in the last collision step
// of a particle step, after which steps are of another length
struct Errors {
  double mean, worst;    // root of the mean square
};

Errors errors_of_restitution(const std::string &how)
{
  double sum = 0.0, worst = 0.0;
  const int phases = 24;
  for (const double ratio : {1.5, 2.0, 3.0, 4.7})
    for (int n = 0; n < phases; n++) {
      const double error =
          restitution(ratio * sticking_speed, 0.01 + 0.01 * (n + 0.1) / phases, how) -
          std::sqrt(1.0 - 1.0 / (ratio * ratio));
      sum += error * error;
      worst = std::max(worst, std::fabs(error));
    }
  const Errors errors = {std::sqrt(sum / (4.0 * phases)), worst};
  printf("%s: error of e %.5f in the mean, %.5f at most\n", how.c_str(), errors.mean, errors.worst);
  return errors;
}

// deeper contacts are stiffer. Hertz: (1/2) m v^2 = (8/15) E sqrt(R) overlap^(5/2)
double stiffer(double v)
{
  const double deepest =
      std::pow(15.0 * m * v * v / (16.0 * material.E_eff() * std::sqrt(0.25)), 0.4);
  return std::pow(std::max(deepest / curve.delta_eq(), 1.0), 0.25);
}

const double frequency = std::sqrt(1.2 * material.E_eff() * curve.a0() / m);

}    // namespace

TEST(MtsTolerance, contact_at_rest_takes_the_largest_stable_step)
{
  const double step = 20.0 / frequency;
  EXPECT_EQ(steps_at(curve.delta_eq(), 0.0, 0.001, step), std::ceil(20.0 / 0.8));
  EXPECT_EQ(steps_at(curve.delta_eq(), 0.0, 0.05, step), std::ceil(20.0 / 0.8));
}

TEST(MtsTolerance, faster_contacts_take_finer_steps)
{
  const double step = 20.0 / frequency;
  for (const double v2 : {0.05, 0.2, 0.7}) {    // (v / slow)^2
    const double kappa = std::min(0.8, std::sqrt(8.0 * 0.002 / v2));
    EXPECT_EQ(steps_at(curve.delta_eq(), std::sqrt(v2 * slow2), 0.002, step),
              std::ceil(20.0 * stiffer(std::sqrt(v2 * slow2)) / kappa))
        << "v^2 = " << v2;
  }
}

TEST(MtsTolerance, impact_faster_than_adhesion_depends_on_tolerance_and_compression)
{
  const double step = 20.0 / frequency, v = 6.0 * std::sqrt(slow2);
  ASSERT_GT(stiffer(v), 1.2);
  EXPECT_EQ(steps_at(curve.delta_eq(), v, 0.01, step),
            std::ceil(20.0 * stiffer(v) / std::sqrt(0.08)));
}

// A pair that nears each other, but not within the step as it flies, may yet be struck: it takes
// stable steps, and fine ones in the step in which it touches.
TEST(MtsTolerance, approach_takes_fine_steps_when_it_will_touch)
{
  const double v = 3.0 * std::sqrt(slow2), step = 20.0 / frequency;
  for (const double steps : {1.7, 1.3, 0.7, 0.3}) {    // to touch
    const double kappa = steps > 1.0 ? 0.8 : std::sqrt(0.08);
    EXPECT_EQ(steps_at(-steps * v * step, v, 0.01, step), std::ceil(20.0 * stiffer(v) / kappa))
        << steps;
  }
}

// Forces bring together what rests: as fast as they make it, and with first touch if they can.
TEST(MtsTolerance, what_forces_bring_together_takes_fine_steps)
{
  const double step = 20.0 / frequency, gained = std::sqrt(0.2 * slow2);    // of the approach
  for (const double part : {0.9, 1.5}) {    // of what is allowed for
    Simulation sim;
    place(sim, 1.0 + part * gained * step, 0.0, "tolerance 0.002", step);
    sim.run("variable push atom " + digits(mass * gained / step) +
            "*(3-2*id)\nfix push all addforce v_push 0 0\nrun 0\nrun 1 pre no");
    const double kappa = std::sqrt(8.0 * 0.002 / (part < 1.0 ? 0.2 + 0.607082 : 0.2));
    EXPECT_EQ(sim.value("f_move[1]"), std::ceil(20.0 / kappa)) << part;
  }
}

// The first strikes the second, and this the third within the same step, which may be much smaller,
// so that this contact is the stiffer one. e^2 = 1 - (V_s/v)^2 of each, free of our code.
TEST(MtsTolerance, what_is_struck_is_held_to_the_tolerance)
{
  for (const double d : {1.0, 0.2})
    for (const double ratio : {1.6, 2.0, 4.7}) {
      const JkrCurve small{0.5 * d / (1.0 + d), curve.E, curve.gamma};
      const double m3 = mass * d * d * d, m23 = mass * m3 / (mass + m3);
      const double V_s = std::sqrt(2.0 * 0.935503 * small.F_C() * small.delta_C() / m23);
      const double v = ratio * std::max(V_s, sticking_speed);
      auto leaves = [](double speed, double sticking, double share) {
        return share * (speed + std::sqrt(speed * speed - sticking * sticking));
      };
      const double exact = leaves(leaves(v, sticking_speed, 0.5), V_s, mass / (mass + m3));
      for (int n = 0; n < 8; n++) {
        Scene scene;
        scene.style = normal_only();
        const double first = 3.0, second = first + 1.005 + 0.1 * n / 8.0;
        Simulation sim;
        build(sim, {{first, 4.0, 4.0}, {second, 4.0, 4.0}, {second + 0.7 + 0.5 * d, 4.0, 4.0, d}},
              scene);
        char line[200];
        snprintf(line, sizeof(line), "timestep %.17g\nset atom 1 vx %.17g\n", 0.4 / v, v);
        sim.run(line + std::string("fix move all nve/sphere/mts collision tolerance 0.01\nrun 2"));
        EXPECT_EQ(sim.value("f_move[5]"), 0.0) << "found late";
        EXPECT_NEAR(sim.value("vx[3]") / exact, 1.0, 0.001) << d << " " << ratio << " phase " << n;
      }
    }
}

// A bridge pulls together, within the step, what would not touch as it flies.
TEST(MtsTolerance, what_a_bridge_pulls_together_takes_fine_steps)
{
  const double v = 2.0 * sticking_speed;
  auto rebound = [&](const std::string &how) {
    Simulation sim;
    Scene scene;
    scene.style = normal_only(" bridge 0.3 100 0 0 form film");
    build(sim, {{3.0, 4.0, 4.0}, {4.0805, 4.0, 4.0}}, scene);
    char line[200];
    snprintf(line, sizeof(line), "timestep %.17g\nset atom 1 vx %.17g\nset atom 2 vx %.17g\n",
             0.08 / v, 0.5 * v, -0.5 * v);
    sim.run(line + ("fix move all nve/sphere/mts collision " + how + "\nrun 2"));
    return (sim.value("vx[2]") - sim.value("vx[1]")) / v;
  };
  const double fine = rebound("auto safety 0.01");
  EXPECT_NEAR(rebound("tolerance 0.001"), fine, 0.001);
  EXPECT_NEAR(rebound("tolerance 0.01"), fine, 0.01);
}

// e^2 is the energy that is left: its error is T at most, that of e in the mean of phases less
TEST(MtsTolerance, error_of_restitution_falls_with_the_tolerance)
{
  const struct {
    std::string T;
    double mean, worst;
  } table[] = {{"0.05", 0.02, 0.05}, {"0.01", 0.0045, 0.01}, {"0.0005", 0.00015, 0.00035}};
  for (const auto &[T, mean, worst] : table) {
    const auto errors = errors_of_restitution("tolerance " + T);
    EXPECT_LT(errors.mean, mean) << T;
    EXPECT_GT(errors.mean, mean / 9.0) << T;
    EXPECT_LT(errors.worst, worst) << T;
  }
}

TEST(MtsTolerance, error_of_restitution_falls_with_the_step)
{
  const auto coarse = errors_of_restitution("auto"),
             fine = errors_of_restitution("auto safety 0.1");
  EXPECT_LT(coarse.worst, 0.014);
  EXPECT_LT(fine.worst, 0.0006);
  EXPECT_GT(coarse.mean / fine.mean, 6.0);
  EXPECT_LT(coarse.mean / fine.mean, 50.0);
}

// At rest a contact of this pair is stable with 6 steps, and in such an impact it is not; nor is it
// told where the pair flies past.
TEST(MtsTolerance, too_few_steps_for_an_impact_are_told_at_the_end)
{
  const double v = 6.0 * sticking_speed, step = 10.0 / frequency;
  const struct {
    int steps;
    double aside;
  } table[] = {{6, 0.0}, {13, 0.0}, {6, 1.01}};
  for (const auto &[steps, aside] : table) {
    Simulation sim;
    place(sim, 1.0 + 0.5 * v * step, v, std::to_string(steps), step);
    sim.run("set atom 2 y " + digits(4.0 + aside));
    const double kappa = 10.0 * stiffer(v) / steps;
    const auto text = log_of(sim, "run 2\n");
    const auto at = text.find("a contact gains energy; use collision ");
    EXPECT_EQ(at != std::string::npos, kappa > 2.0 && aside == 0.0) << text;
    if (at != std::string::npos) {
      EXPECT_NEAR(std::stod(text.substr(at + 38)), steps * kappa / 0.3, 1.5) << text;
    }
  }
}

TEST(MtsTolerance, wrong_words_are_named)
{
  Simulation sim;
  place(sim, 2.0, 0.0, "1", dt);
  sim.run("unfix move");
  EXPECT_NE(sim.error_of("fix move all nve/sphere/mts collision tolerance 0.1").find("(0, 0.08]"),
            std::string::npos);
  EXPECT_NE(sim.error_of("fix move all nve/sphere/mts collision tolerance").find("missing"),
            std::string::npos);
}
