// apf_advise: its table for the channel of IIHR Report 459, section III.A, against the closed forms
// of JKR in report units, and what it says of bad scenes.

#include "scenes.h"

#include <fstream>

namespace {

constexpr double d = 1.0e-5, rho = 2600.0, U = 0.5, L = 1.0e-3, lambda = 1.0e4, nu = 0.3;

std::string channel(double phi)
{
  const double E = 2.0 * (1.0 - nu * nu) * lambda * rho * U * U, gamma = phi * rho * U * U * d / 2;
  const std::string law = " jkr " + digits(E) + " 0.3 " + digits(gamma) + " sliding 0.3 ";
  return "units si\natom_style sphere\ncomm_modify vel yes\natom_modify map array\n"
         "region box block 0 2e-3 -5e-4 5e-4 0 1e-3\nboundary f f p\nneighbor 1e-5 bin\n"
         "create_box 1 box\ncreate_atoms 1 single 1e-3 0.0 5e-4\n"
         "create_atoms 1 single 1.5e-3 2.5e-4 5e-4\n"
         "set group all diameter 1e-5 density 2600\npair_style granular/adhesive\npair_coeff * *" +
      law + "\nfix walls all wall/levelset plane y -5e-4 5e-4" + law +
      "\nfix air all flow/field channel x y -5e-4 5e-4 0.5 density 1.2 viscosity 2e-5\n"
      "fix drag all flow/force air drag stokes\ntimestep 2e-6\n"
      "fix move all nve/sphere/mts collision auto\n";
}

// what the command prints
std::string advice(Simulation &sim, const std::string &words = "")
{
  const auto file = scratch_file("advice");
  sim.run("log " + file + "\napf_advise " + words + "\nlog none");
  std::ifstream log(file);
  std::string text((std::istreambuf_iterator<char>(log)), {});
  std::filesystem::remove(file);
  return text;
}

// the numbers that follow a text, words among them left out
std::vector<double> after(const std::string &text, const std::string &start)
{
  std::vector<double> numbers;
  const auto at = text.find(start);
  if (at == std::string::npos) return numbers;
  std::istringstream line(text.substr(at + start.size(), text.find('\n', at) - at - start.size()));
  for (std::string word; line >> word;) {
    char *end;
    const double number = std::strtod(word.c_str(), &end);
    if (end != word.c_str() && (*end == '\0' || *end == ',')) numbers.push_back(number);
  }
  return numbers;
}

enum Column { A0, DELTA_C, REST, IMPACT, V_S, F_C, PHI, LAMBDA, OMEGA, F3_STEP, STEP, COLUMNS };

}    // namespace

// With lengths in r, phi and lambda alone fix a contact (physics of the report, section III.A):
//   a0/r = (9 pi phi/lambda)^(1/3) at a wall, (9 pi phi/(4 lambda))^(1/3) of a pair,
//   rest overlap = (a0/r)^2/3 or 2/3 (a0/r)^2, F_C = 3 pi phi rho U^2 r^2 (R/r),
//   V_s = (2 0.935503 F_C delta_C/m)^(1/2)
TEST(Advise, channel_of_the_report)
{
  struct {
    double phi, speed;    // V_s/U as the report's numbers give it, to three digits
  } const cases[] = {{1.5, 0.190}, {15.0, 1.30}, {50.0, 3.53}, {150.0, 8.82}};
  for (const auto &one : cases) {
    SCOPED_TRACE(one.phi);
    Simulation sim;
    sim.run(channel(one.phi));
    const std::string text = advice(sim);
    const double r = d / 2, mass = pi / 6 * rho * d * d * d;
    for (const bool wall : {false, true}) {
      const auto row = after(text, wall ? "1 walls d 1e-05" : "1 1 d 1e-05 1e-05");
      ASSERT_EQ(row.size(), COLUMNS) << text;
      const double a0 = std::cbrt(9.0 * pi * one.phi / lambda / (wall ? 1.0 : 4.0));
      const double rest = (wall ? 1.0 : 2.0) * a0 * a0 / 3.0;
      const double neck = rest / 1.2114137;    // 2 6^(1/3)/3
      const double pull = 3.0 * pi * one.phi * rho * U * U * r * r * (wall ? 1.0 : 0.5);
      const double stick = std::sqrt(2.0 * 0.935503 * pull * neck * r / (wall ? mass : 0.5 * mass));
      EXPECT_NEAR(row[A0] / r / a0, 1.0, 1.0e-3);
      EXPECT_NEAR(row[DELTA_C] / r / neck, 1.0, 1.0e-3);
      EXPECT_NEAR(row[REST] / rest, 1.0, 1.0e-3);
      EXPECT_NEAR(row[F_C] / pull, 1.0, 1.0e-3);
      EXPECT_NEAR(row[V_S] / stick, 1.0, 1.0e-3);
      EXPECT_NEAR(row[PHI] / one.phi, 1.0, 1.0e-3);
      EXPECT_NEAR(row[LAMBDA] / lambda, 1.0, 1.0e-3);
      // Dt_C = f3 d (rho^2/(E^2 U))^(1/5) = 0.1 d/U lambda^(-2/5)
      EXPECT_NEAR(row[F3_STEP] / (0.1 * d / U * std::pow(lambda, -0.4)), 1.0, 1.0e-3);
      if (!wall) { EXPECT_NEAR(row[V_S] / U / one.speed, 1.0, 5.0e-3); }
      // Springs of sliding, 8 G a0 (7/2)/m, G/E = (1 - nu)/(2 - nu): omega = 2.19 times the normal
      // one, (6/5 E a0/m)^(1/2), of nu = 0.3
      const double E = lambda * rho * U * U, m = wall ? mass : 0.5 * mass;
      EXPECT_NEAR(row[OMEGA] / std::sqrt(1.2 * E * a0 * r / m) /
                      std::sqrt(3.5 * 8.0 / 1.2 * 0.7 / 1.7 / 2.0),
                  1.0, 2.0e-3);
      // omega step = 0.3 at rest; an impact at U compresses by (15 m U^2/(16 E R^(1/2)))^(2/5), and
      // stiffness grows at most as the root of the overlap
      const double R = wall ? r : 0.5 * r;
      const double impact = std::pow(15.0 * m * U * U / (16.0 * E * std::sqrt(R)), 0.4) / r;
      EXPECT_NEAR(row[IMPACT] / impact, 1.0, 1.0e-3);
      const double deeper = std::max(1.0, impact / rest);
      EXPECT_NEAR(row[STEP] * row[OMEGA] * std::pow(deeper, 0.25) / 0.3, 1.0, 2.0e-3);
    }
    // f1 L/U, f2 d/U, and their ratio f1 L/(f2 d) = 10
    const auto steps = after(text, "steps: fluid f1 L/U");
    ASSERT_GE(steps.size(), 2u);
    EXPECT_NEAR(steps[0] / (0.01 * L / U), 1.0, 1.0e-3);
    EXPECT_NEAR(steps[1] / (0.1 * d / U), 1.0, 1.0e-3);
  }
}

// tau_p = rho d^2/(18 mu) = 0.722 ms, St = 0.361; slip U where the air is fastest: Re_p = 0.3;
// vorticity at L/4 from the middle 2 U/L: Re_G = 0.006; Re = 30
TEST(Advise, fluid_of_the_channel)
{
  Simulation sim;
  sim.run(channel(15.0));
  const std::string text = advice(sim);
  const auto row = after(text, "fluid: type 1 d 1e-05 tau_p");
  ASSERT_EQ(row.size(), 5u) << text;
  EXPECT_NEAR(row[0], 7.2222e-4, 1.0e-6);
  EXPECT_NEAR(row[1], 0.36111, 1.0e-3);
  EXPECT_NEAR(row[2], 2.0e-6 / 7.2222e-4, 1.0e-5);
  EXPECT_NEAR(row[3], 0.3, 1.0e-3);
  EXPECT_NEAR(row[4], 0.006, 1.0e-5);
  EXPECT_NEAR(after(text, "rho_f U L/mu").at(0), 30.0, 0.1);
}

// Keywords replace what the scene shows, and the numbers follow: phi as 1/U^2, f1 L/U.
TEST(Advise, keywords)
{
  Simulation sim;
  sim.run(channel(15.0));
  const std::string text = advice(sim, "speed 1.0 length 4e-3");
  EXPECT_NEAR(after(text, "1 1 d 1e-05 1e-05").at(PHI), 15.0 / 4.0, 1.0e-2);
  EXPECT_NEAR(after(text, "steps: fluid f1 L/U").at(0), 4.0e-5, 1.0e-8);
}

TEST(Advise, says_what_to_change)
{
  Simulation sim;
  sim.run(channel(150.0));    // overlaps at rest are 15 % of the radius
  EXPECT_NE(advice(sim).find("change: contact 1 1"), std::string::npos);
  sim.run("timestep 2e-5");    // ten times the report's particle step
  const std::string text = advice(sim);
  EXPECT_NE(text.find("change: timestep 2e-06 or less"), std::string::npos) << text;
  EXPECT_NE(text.find("change: neighbor"), std::string::npos) << text;
}

TEST(Advise, steps_that_are_too_few_or_too_short_are_told)
{
  Simulation sim;
  sim.run(channel(50.0) + "unfix move\nfix move all nve/sphere/mts collision 3\n");
  const auto few = advice(sim, "speed 0.5");
  EXPECT_NEAR(after(few, "change: collision").at(0),
              std::ceil(after(few, "timestep / collision step").at(0)), 1.0)
      << few;
  sim.run("unfix move\nfix move all nve/sphere/mts collision auto\n");
  const auto right = advice(sim, "speed 0.5");
  for (const char *step : {"change: collision", "change: timestep"})
    EXPECT_EQ(right.find(step), std::string::npos) << right;
  sim.run("timestep 1e-8\n");    // for 2e-6
  EXPECT_NE(advice(sim, "speed 0.5").find("change: timestep up to 2e-06: "), std::string::npos);
}

// A nozzle that is still empty: what will be captured in it sees the fluid's speed.
TEST(Advise, reynolds_number_of_what_will_enter)
{
  Simulation sim;
  sim.run(channel(50.0) +
          "delete_atoms group all\nfix in all inlet/flow x 1e-4 air number 1 every "
          "100 diameter 1e-5 density 2600 type 1 seed 7\n");
  const auto text = advice(sim, "speed 20");
  EXPECT_NEAR(after(text, " Re_p").at(0), 20.0 * d * 1.2 / 2e-5, 1e-3) << text;
  EXPECT_NE(text.find("change: "), std::string::npos) << text;
  EXPECT_NE(text.find("drag stokes"), std::string::npos) << text;
}

// A row of masses from 8 to 1, each a little lighter, hands on sqrt(8) of the speed at most, more
// than one impact, (3 M - m)/(M + m).
TEST(Advise, skin_counts_what_light_particles_gain)
{
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * * jkr 2e6 0.25 0\n";
  Simulation sim;
  build(sim, {{1.0, 4.0, 4.0, 1.0}, {5.0, 4.0, 4.0, 2.0}}, scene);
  sim.run("fix nve all nve/sphere/mts collision auto\ntimestep 0.01\n");
  EXPECT_NEAR(after(advice(sim, "speed 0.5"), "neighbor skin").at(1),
              1.2 * (1.0 + std::sqrt(8.0)) * 0.5 * 0.01, 1e-5);
}

// Two timesteps of what arrives fastest, and a fifth more: a wall, or images of a sheared box.
TEST(Advise, skin_counts_walls_and_images_that_move)
{
  const double step = 0.01, speed = 3.0;
  const std::string law = " jkr 2e6 0.25 0 ";
  auto least_skin = [&](const std::string &words, double moving = 0.0) {
    Scene scene;
    scene.boundary = "f p p";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
    Simulation sim;
    build(sim, {{0.6, 4.0, 0.6}, {4.0, 4.0, 7.4}}, scene);
    set_motion(sim, 1, {0.0, -moving, 0.0}, {0.0, 0.0, 0.0});
    set_motion(sim, 2, {0.0, moving, 0.0}, {0.0, 0.0, 0.0});
    sim.run(words + "\nfix nve all nve/sphere/mts collision auto\ntimestep " + digits(step));
    return after(advice(sim, "speed 0.5"), "neighbor skin").at(1);
  };
  const std::string wall = "fix w all wall/levelset plane x 0 NULL" + law;
  EXPECT_NEAR(least_skin(wall), 2.4 * 0.5 * step, 1e-9);
  // which throws ahead what is at rest at twice its speed
  EXPECT_NEAR(least_skin(wall + "move linear " + digits(speed) + " 0 0"), 2.4 * 2.0 * speed * step,
              1e-9);
  const std::string shear = "change_box all triclinic\nfix flow all deform 1 yz erate ";
  for (const double sign : {1.0, -1.0}) {    // at rest, along with the box, against it
    SCOPED_TRACE(sign);
    const std::string rate = digits(sign * speed / 8.0) + " remap v";
    EXPECT_NEAR(least_skin(shear + rate), 2.4 * speed * step, 1e-9);
    EXPECT_NEAR(least_skin(shear + rate, sign * 1.5), 2.4 * speed * step, 1e-9);
    EXPECT_NEAR(least_skin(shear + rate, sign * -1.0), 2.4 * (speed + 2.0) * step, 1e-9);
  }
}

// A wall that moves is what moves in a scene at rest; one whose speed is not known yet is named.
TEST(Advise, piston_into_a_bed_at_rest)
{
  const std::string law = " jkr 2e6 0.25 0 ";
  Scene scene;
  scene.boundary = "f p p";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law +
      "\nfix w all wall/levelset plane x 0 NULL" + law + "move linear ";
  Simulation by_number, by_variable;
  Scene other = scene;
  scene.style += "3 0 0\n";
  other.style = "variable u equal 3\n" + other.style + "v_u 0 0\n";
  build(by_number, {{0.6, 4.0, 4.0}, {4.0, 4.0, 4.0}}, scene);
  build(by_variable, {{0.6, 4.0, 4.0}, {4.0, 4.0, 4.0}}, other);
  for (auto *sim : {&by_number, &by_variable})
    sim->run("fix nve all nve/sphere/mts collision auto\ntimestep 0.01");
  EXPECT_NE(advice(by_number).find("speed U = 3 (largest"), std::string::npos);
  EXPECT_NE(by_variable.error_of("apf_advise").find("finds nothing that moves"), std::string::npos);
  EXPECT_NE(advice(by_variable, "speed 3").find("how fast fix w moves"), std::string::npos);
}

TEST(Advise, has_nothing_to_change_in_a_good_scene)
{
  Simulation sim;
  sim.run(channel(1.5));    // U of particles that drift slowly: no deep impact
  EXPECT_NE(advice(sim, "speed 0.2").find("nothing to change"), std::string::npos);
}

// A strong bridge between soft particles: omega^2 = F / (L m) with F = 4 pi R sigma cos(theta) H at
// h_min, and the length over which it changes, L = (V / pi R)^(1/2). The pair style's own check of
// the step says so, too.
TEST(Advise, bridge_counts_where_it_is_the_stiffest)
{
  const double sigma = 20000.0, l = 0.0002, V = l * pi / 6.0;
  const std::string law = " jkr 2e6 0.25 0 bridge 0.0002 20000 20 0 ";
  Scene scene;
  scene.boundary = "f p p";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law +
      "\nfix w all wall/levelset plane x 0 NULL" + law + "\n";
  Simulation sim;
  build(sim, {{3.0, 4.0, 4.0}, {5.0, 4.0, 4.0}}, scene);
  sim.run("fix nve all nve/sphere\ntimestep 0.001");
  const std::string text = advice(sim, "speed 1.0");
  std::vector<double> omegas;
  for (const bool wall : {false, true}) {
    const double R = wall ? 0.5 : 0.25, m = wall ? pi / 6.0 : pi / 12.0, h = 1.0e-3 * R;
    const double H = 1.0 - 1.0 / std::sqrt(1.0 + V / (pi * R * h * h));
    const double force = 4.0 * pi * R * sigma * std::cos(pi / 9.0) * H;
    omegas.push_back(std::sqrt(force / (std::sqrt(V / (pi * R)) * m)));
    const auto row = after(text, wall ? "1 w d 1" : "1 1 d 1 1");
    ASSERT_EQ(row.size(), COLUMNS) << text;
    EXPECT_NEAR(row[OMEGA] / omegas.back(), 1.0, 1.0e-3);
    EXPECT_NEAR(row[STEP] * omegas.back() / 0.3, 1.0, 1.0e-3);
  }
  EXPECT_NE(text.find(" bridge "), std::string::npos);
  const std::string log = log_of(sim, "run 0\n");
  for (const double omega : omegas) {
    char number[64];
    snprintf(number, sizeof(number), "bridge mode of a contact, omega dt = %.3g;", omega * 0.001);
    EXPECT_NE(log.find(number), std::string::npos) << log;
  }
}

// particles announced by an inlet count
TEST(Advise, before_particles_enter)
{
  Simulation sim;
  sim.run(channel(15.0));
  sim.run("delete_atoms group all compress no");
  EXPECT_NE(sim.error_of("apf_advise speed 0.5").find("needs particles"), std::string::npos);
  sim.run("fix in all inlet/flow x 0.0 air concentration 0.001 diameter 2e-5 density 2600 type 1 "
          "seed 7");
  const std::string text = advice(sim, "speed 0.5");
  EXPECT_EQ(after(text, "1 1 d 2e-05 2e-05").size(), size_t(COLUMNS)) << text;
}

TEST(Advise, errors)
{
  Simulation sim;
  EXPECT_NE(sim.error_of("apf_advise").find("needs a simulation box"), std::string::npos);
  sim.run(channel(15.0));
  EXPECT_NE(sim.error_of("apf_advise pace 1").find("keyword must be speed or length, got pace"),
            std::string::npos);
  EXPECT_NE(sim.error_of("apf_advise speed -1").find("speed must be > 0, got -1"),
            std::string::npos);
}

// LAMMPS lists the command, and with it every style that the README names.
TEST(Advise, styles_are_listed)
{
  Simulation sim;
  const auto file = scratch_file("styles");
  sim.run("info styles all out overwrite " + file);
  std::ifstream list(file);
  const std::string text((std::istreambuf_iterator<char>(list)), {});
  std::filesystem::remove(file);
  for (const std::string style :
       {"apf_advise", "granular/adhesive", "wall/levelset", "flow/field", "flow/force",
        "flow/concentration", "inlet/flow", "nve/sphere/mts", "aggregate/contact", "wall/deposit"})
    EXPECT_NE(text.find(style), std::string::npos) << style;
}
