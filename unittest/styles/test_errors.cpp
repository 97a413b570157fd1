// Wrong input for pair_style and pair_coeff granular/adhesive and fix wall/levelset: messages name
// command, argument, value and range. What the pages call an error or a warning is one here.

#include "simulation.h"

#include "gtest/gtest.h"

#include <unistd.h>

#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

struct Row {
  std::string input;
  std::vector<std::string> words;    // that the message must contain
};

// two spheres apart, of types 1 and 2, in a box that is periodic in x and z
const std::string particles = R"(
units lj
atom_style sphere
comm_modify vel yes
boundary p f p
region box block 0 10 0 10 0 10
create_box 2 box
create_atoms 1 single 3 5 5
create_atoms 2 single 6 5 5
set group all diameter 1.0 density 1.0
fix move all nve/sphere
timestep 1e-5
)";
const std::string style = "pair_style granular/adhesive\n";
const std::string hertz = "pair_coeff * * jkr 1e6 0.3 0\n";

void expect_words(const std::string &text, const Row &row)
{
  EXPECT_NE(text, "") << "no message from: " << row.input;
  for (const auto &word : row.words)
    EXPECT_NE(text.find(word), std::string::npos)
        << "no '" << word << "' in: " << text << "\nfrom: " << row.input;
}

void expect_errors(const std::string &scene, const std::vector<Row> &table)
{
  for (const auto &row : table) {
    Simulation sim;
    sim.run(scene);
    expect_words(sim.error_of(row.input), row);
  }
}

// What commands print, up to their error if there is one.
std::string log_of(const std::string &commands)
{
  const auto path =
      std::filesystem::temp_directory_path() / ("apf_errors_" + std::to_string(getpid()) + ".log");
  {
    Simulation sim;
    sim.error_of("log " + path.string() + "\n" + commands);
  }
  std::ifstream file(path);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  std::filesystem::remove(path);
  return text;
}

// the number that stands before `word` in text
double number_before(const std::string &text, const std::string &word)
{
  const auto end = text.find(word);
  if (end == std::string::npos) return 0.0;
  return std::stod(text.substr(text.rfind(' ', end - 1) + 1));
}

// The contact law is the same behind both commands: rows of `law` follow it, command begins errors.
std::vector<Row> law_errors(const std::string &line, const std::string &command)
{
  const std::string missing = ": missing argument";
  std::vector<Row> table = {
      {"", {"missing argument"}},
      {"jkr", {command, "Young's modulus E is missing; it must be > 0"}},
      {"jkr 1e6", {command, "Poisson's ratio nu is missing; it must be in (-1, 0.5]"}},
      {"jkr 1e6 0.3", {command, "surface energy gamma is missing; it must be >= 0"}},
      {"material", {command + " material" + missing}},
      {"material materials.adhesive", {command + " material" + missing}},
      {"hertz 1e6 0.3 0", {command, "jkr or material", "got hertz"}},
      {"jkr 0 0.3 0", {command, "Young's modulus E must be > 0, got 0"}},
      {"jkr -1 0.3 0", {command, "Young's modulus E must be > 0, got -1"}},
      {"jkr E 0.3 0", {"must be a number", "got E"}},
      {"jkr nan 0.3 0", {"must be a number", "got nan"}},
      {"jkr 1e6 -1 0", {command, "Poisson's ratio nu must be in (-1, 0.5], got -1"}},
      {"jkr 1e6 0.51 0", {command, "Poisson's ratio nu must be in (-1, 0.5], got 0.51"}},
      {"jkr 1e6 0.3 -0.1", {command, "surface energy gamma must be >= 0, got -0.1"}},
      {"jkr 1e6 0.3 sliding 0.3", {"must be a number", "got sliding"}},
  };
  const std::vector<Row> keywords = {
      {"0.5", {command, "keyword 0.5 is unknown", "damping, sliding, twisting, rolling, break"}},
      {"cohesion 3", {command, "keyword cohesion is unknown", "scale_stiffness"}},
      {"damping", {command + " damping" + missing}},
      {"damping viscous 1", {command, "damping must be tsuji, alpha or none"}},
      {"damping tsuji", {command, "damping tsuji restitution is missing; it must be in (0, 1]"}},
      {"damping tsuji 0", {command, "tsuji restitution must be in (0, 1], got 0"}},
      {"damping tsuji -0.5", {command, "tsuji restitution must be in (0, 1], got -0.5"}},
      {"damping tsuji 1.01", {command, "tsuji restitution must be in (0, 1], got 1.01"}},
      {"damping tsuji e", {"must be a number", "got e"}},
      {"damping alpha", {command, "damping alpha is missing; it must be >= 0"}},
      {"damping alpha -0.1", {command, "damping alpha must be >= 0, got -0.1"}},
      {"damping alpha sliding 0.3", {"must be a number", "got sliding"}},
      {"damping none 0", {command, "keyword 0 is unknown"}},
      {"sliding", {command, "sliding mu is missing; it must be >= 0"}},
      {"sliding -0.3", {command, "sliding mu must be >= 0, got -0.3"}},
      {"sliding yes", {"must be a number", "got yes"}},
      {"sliding 0.3 twisting", {command + " twisting" + missing}},
      {"sliding 0.3 twisting maybe", {command, "twisting must be yes or no"}},
      {"twisting yes", {command, "twisting yes needs sliding mu > 0"}},
      {"sliding 0 twisting yes", {command, "twisting yes needs sliding mu > 0"}},
      {"rolling", {command, "rolling theta_crit is missing; it must be in [0, 1]"}},
      {"rolling -0.01", {command, "rolling theta_crit must be in [0, 1], got -0.01"}},
      {"rolling 1.01", {command, "rolling theta_crit must be in [0, 1], got 1.01"}},
      {"rolling 0.01 -0.1", {command, "rolling zeta must be >= 0, got -0.1"}},
      {"rolling 0.01 much", {command, "keyword much is unknown"}},
      {"rolling no", {"must be a number", "got no"}},
      {"break", {command + " break" + missing}},
      {"break energy", {command, "break must be displacement, force or touch"}},
      {"scale_stiffness", {command, "scale_stiffness is missing; it must be in (0, 1]"}},
      {"scale_stiffness 0", {command, "scale_stiffness must be in (0, 1], got 0"}},
      {"scale_stiffness -1", {command, "scale_stiffness must be in (0, 1], got -1"}},
      {"scale_stiffness 1.5", {command, "scale_stiffness must be in (0, 1], got 1.5"}},
      {"scale_stiffness half", {"must be a number", "got half"}},
      {"bridge", {command, "bridge volume ratio l is missing; it must be in (0, 1]"}},
      {"bridge 0.01 0.07 0", {command, "bridge viscosity mu is missing; it must be >= 0"}},
      {"bridge 0 0.07 0 1e-3", {command, "volume ratio l must be in (0, 1], got 0"}},
      {"bridge 0.01 0 0 1e-3", {command, "surface tension sigma must be > 0, got 0"}},
      {"bridge 0.01 0.07 90 1e-3", {command, "contact angle theta must be in [0, 89], got 90"}},
      {"bridge 0.01 0.07 0 -1", {command, "viscosity mu must be >= 0, got -1"}},
      {"bridge 0.01 0.07 0 1e-3 0", {command, "hmin over R must be in [1e-12, 1], got 0"}},
      {"form drop", {command, "form must be contact or film, got drop"}},
      {"form film", {command, "need keyword bridge"}},
      {"tangential yes", {command, "need keyword bridge"}},
      {"bridge 0.01 0.07 0 1e-3 capillary exact", {command, "capillary must be maugis or willett"}},
      {"bridge 0.1 0.07 0 1e-3 capillary willett", {command, "bridge l must be <= 0.02387"}},
      {"bridge 0.01 0.07 60 1e-3 capillary willett", {command, "bridge theta must be <= 50"}},
      {"bridge 0.01 0.07 0 1e-3 inventory 1.1", {command, "inventory share must be in (0, 1]"}},
      {"bridge 0.01 0.07 0 1e-3 wet_gamma 1 6 1 3", {command, "A_f = 3 lies between"}},
      {"bridge 0.01 0.07 0 1e-3 wet_gamma 1 1 1 5", {command, "A_f must be in [0", "= 4], got 5"}},
      {"bridge 0.01 0.07 0 1e-3 wet_gamma 0.5 1 1 0", {"x_ratio must be >= 1, got 0.5"}},

  };
  for (const auto &row : keywords) table.push_back({"jkr 1e6 0.3 0.01 " + row.input, row.words});
  table.push_back({"jkr 1e6 0.3 0 rolling 0.01", {command, "rolling needs adhesion", "gamma > 0"}});
  for (auto &row : table) row.input = line + " " + row.input;
  return table;
}

}    // namespace

TEST(PairErrors, contact_law)
{
  expect_errors(particles + style, law_errors("pair_coeff 1 1", "Pair granular/adhesive"));
}

TEST(PairErrors, style_and_types)
{
  expect_errors(particles,
                {{"pair_style granular/adhesive jkr", {"takes no arguments", "got jkr"}}});
  expect_errors(particles + style,
                {{"pair_coeff", {"missing argument"}},
                 {"pair_coeff 1", {"missing argument"}},
                 {"pair_coeff 1 1", {"missing argument"}},
                 {"pair_coeff 1 3 jkr 1e6 0.3 0", {"3", "out of bounds", "1-2"}},
                 {"pair_coeff 2 1*1 jkr 1e6 0.3 0", {"types 2 1*1", "no pair with I <= J"}},
                 {"run 0", {"pair coeffs are not set"}},
                 {"pair_coeff 1 1 jkr 1e6 0.3 0\nrun 0", {"pair coeffs are not set", "2      2"}},
                 {"pair_coeff 1 1 jkr 1e6 0.3 0.01 zone a", {"keyword zone is unknown"}}});
}

TEST(PairErrors, what_a_scene_lacks)
{
  expect_errors(particles + style + hertz,
                {{"comm_modify vel no\nrun 0", {"Pair granular/adhesive", "comm_modify vel yes"}},
                 {"special_bonds lj 0.5 1 1\nrun 0", {"special_bonds lj factors 0 or 1, got 0.5"}},
                 {"set type 2 diameter 0\nrun 0", {"radii > 0", "atom 2 has 0"}},
                 {"fix a all freeze\nfix b all freeze\nrun 0", {"one fix freeze, got 2"}}});

  const std::string box = "units lj\ncomm_modify vel yes\nregion b block 0 1 0 1 0 1\n";
  expect_errors(box + "atom_style atomic\ncreate_box 1 b\nmass 1 1\n" + style + hertz,
                {{"run 0", {"atom style sphere", "atomic"}}});
  expect_errors(box + "atom_style ellipsoid\ncreate_box 1 b\n" + style + hertz,
                {{"run 0", {"atom style sphere", "ellipsoid"}}});
  expect_errors(box + "atom_style sphere\natom_modify id no\ncreate_box 1 b\n" + style + hertz,
                {{"run 0", {"atom IDs", "atom_modify id no"}}});
}

TEST(PairErrors, fix_contact_history_is_internal)
{
  expect_errors(
      particles + style + hertz,
      {{"fix h all contact/history\nrun 0", {"internal", "pair style granular/adhesive"}}});
}

// R = 1/4, E = 50, delta_eq = a0^2/(3 R): 0.0619 r at gamma 0.1 and 0.597 r at gamma 3
TEST(PairErrors, overlap_above_half_the_radius_stops_the_run)
{
  expect_errors(particles + style,
                {{"pair_coeff * * jkr 100 0 3\nrun 0",
                  {"types 1 1", "overlap by 0.597", "E 41.3 times", "0.5"}}});
}

// Hertz's overlap under the pull of the liquid F = 4 pi R sigma: (3 F / (4 E R^1/2))^(2/3) = 0.6 r
TEST(PairErrors, overlap_by_the_pull_of_a_bridge_stops_the_run)
{
  const double F = std::pow(0.3, 1.5) * 4.0 * 50.0 * 0.5 / 3.0;
  expect_errors(
      particles + style,
      {{"pair_coeff * * jkr 100 0 0 bridge 0.01 " + std::to_string(F / M_PI) + " 0 0\nrun 0",
        {"types 1 1", "overlap by 0.6 ", "E 41.6 times", "0.5"}}});
}

TEST(PairWarnings, overlap_above_five_percent_and_its_cure)
{
  auto log = [](const std::string &E) {
    return log_of(particles + style + "pair_coeff * * jkr " + E + " 0 0.1\nrun 0");
  };
  const std::string text = log("100");
  expect_words(text, {"gamma 0.1", {"WARNING", "types 1 2", "overlap by 0.0619", "E 1.38 times"}});
  const double factor = number_before(text, " times as large");
  EXPECT_NEAR(factor, 1.377, 0.004);
  EXPECT_EQ(log(std::to_string(100.0 * 1.02 * factor)).find("WARNING"), std::string::npos);
  EXPECT_NE(log(std::to_string(100.0 * 0.98 * factor)).find("WARNING"), std::string::npos);
}

// each keyword makes its mode the stiffest where it should: the timestep that is named is quiet
TEST(PairWarnings, timestep_names_the_mode_and_one_that_does)
{
  const struct {
    std::string law, mode;
  } table[] = {{"jkr 1e4 0.3 0.01 rolling 0.01", "normal"},
               {"jkr 1e4 0.3 0.01 sliding 0.3", "tangential"},
               {"jkr 1e4 0.3 0", "normal"}};
  for (const auto &row : table) {
    auto log = [&row](const std::string &dt) {
      return log_of(particles + style + "pair_coeff * * " + row.law + "\ntimestep " + dt +
                    "\nrun 0");
    };
    const std::string text = log("10");
    expect_words(text,
                 {row.law,
                  {"WARNING: Pair granular/adhesive: timestep 10 is too large", row.mode + " mode",
                   "above 0.8"}});
    const double good = number_before(text, " gives 0.3");
    EXPECT_GT(good, 0.0) << text;
    EXPECT_EQ(log(std::to_string(good)).find("WARNING"), std::string::npos) << row.law;
    EXPECT_EQ(log(std::to_string(2.6 * good)).find("WARNING"), std::string::npos) << row.law;
    // between what is accurate and what is stable a line tells
    EXPECT_EQ(log(std::to_string(0.98 * good)).find("omega dt"), std::string::npos) << row.law;
    const auto rough = log(std::to_string(2.0 * good));
    expect_words(
        rough,
        {row.law, {"Pair granular/adhesive: omega dt = 0.", "of the " + row.mode + " mode"}});
    EXPECT_NEAR(number_before(rough, " gives 0.3") / good, 1.0, 0.01);
    EXPECT_NE(log(std::to_string(2.8 * good)).find("WARNING"), std::string::npos) << row.law;
  }
}

// JKR's numbers of spheres of diameter and density 1, and the frequencies of a contact at rest
struct AtRest {
  double R, m, r = 0.5;    // of the contact; of the smaller sphere

  double frequency(const std::string &mode, double E, double nu, double gamma) const
  {
    const double E_eff = 0.5 * E / (1.0 - nu * nu), G_eff = 0.25 * E / (1.0 + nu) / (2.0 - nu);
    const double a0 = std::cbrt(9.0 * M_PI * gamma * R * R / E_eff);
    if (mode == "normal") return std::sqrt(1.2 * E_eff * a0 / m);
    if (mode == "tangential") return std::sqrt(3.5 * 8.0 * G_eff * a0 / m);
    return std::sqrt(4.0 * 3.0 * M_PI * gamma * R * R / (0.4 * m * r * r));    // rolling
  }
};
const struct {
  std::string mode, law;
  double gamma;
} stiffest_modes[] = {{"normal", " rolling 0.02", 100.0},
                      {"tangential", " sliding 0.3", 100.0},
                      {"rolling", " rolling 0.02", 1.5e4}};

// A number of collision steps is too small where omega dt > 0.8, which is told with the numbers;
// the number that is named is quiet, and so are numbers that the fix chooses.
void expect_enough_collision_steps(const std::string &who, const AtRest &contact,
                                   const std::string &before)
{
  const int n = 10;
  for (const auto &[mode, law, gamma] : stiffest_modes) {
    SCOPED_TRACE(mode);
    const double omega = contact.frequency(mode, 1e6, 0.25, gamma);
    const auto log = [&, &mode = mode, &law = law, &gamma = gamma](double kappa,
                                                                   const std::string &how) {
      return log_of(before + " jkr 1e6 0.25 " + std::to_string(gamma) + law +
                    "\nunfix move\nfix move all nve/sphere/mts collision " + how + "\ntimestep " +
                    std::to_string(n * kappa / omega) + "\nrun 0");
    };
    const std::string words = "is too large for the";
    EXPECT_EQ(log(0.796, "10").find(words), std::string::npos);
    const std::string text = log(0.804, "10");
    expect_words(text,
                 {mode,
                  {"WARNING: " + who + ": collision step ", "timestep / 10, " + words,
                   mode + " mode of a contact, omega dt = 0.80", "collision 27 gives 0.3"}});
    EXPECT_NEAR(number_before(text, ", timestep / 10") * omega, 0.804, 0.002);
    for (const char *how : {"27", "13", "auto", "tolerance 0.01"})
      EXPECT_EQ(log(0.804, how).find(words), std::string::npos) << how;
  }
}

TEST(PairWarnings, collision_steps_too_few)
{
  expect_enough_collision_steps("Pair granular/adhesive", {0.25, M_PI / 12.0},
                                particles + style + "pair_coeff * *");
}

TEST(WallErrors, contact_law)
{
  expect_errors(particles, law_errors("fix w all wall/levelset plane y 0 10", "Fix wall/levelset"));
}

TEST(WallErrors, shape)
{
  const std::string law = " jkr 1e6 0.3 0", missing = "command: missing argument";
  std::vector<Row> table = {
      {"", {"fix wall/levelset " + missing}},
      {"plane", {"fix wall/levelset plane " + missing}},
      {"plane y", {"fix wall/levelset plane " + missing}},
      {"plane y 0", {"fix wall/levelset plane " + missing}},
      {"plane w 0 10" + law, {"plane dimension must be x, y or z, got w"}},
      {"plane x 0 10" + law, {"plane needs a box that is not periodic in x"}},
      {"plane y NULL NULL" + law, {"LO or HI, both are NULL"}},
      {"plane y 10 0" + law, {"LO must be < HI, got 10 and 0"}},
      {"plane y 5 5" + law, {"LO must be < HI, got 5 and 5"}},
      {"plane y lo 10" + law, {"plane must be a number, got lo"}},
      {"plane y 0 null" + law, {"plane must be a number, got null"}},
      {"cylinder", {"fix wall/levelset cylinder " + missing}},
      {"cylinder z 5", {"fix wall/levelset cylinder " + missing}},
      {"cylinder z 5 5", {"fix wall/levelset cylinder " + missing}},
      {"cylinder z 5 5 3", {"fix wall/levelset cylinder " + missing}},
      {"cylinder w 5 5 3 inside" + law, {"cylinder dimension must be x, y or z, got w"}},
      {"cylinder z 5 five 3 inside" + law, {"cylinder axis must be a number, got five"}},
      {"cylinder z 5 5 0 inside" + law, {"cylinder radius must be > 0, got 0"}},
      {"cylinder z 5 5 -1 inside" + law, {"cylinder radius must be > 0, got -1"}},
      {"cylinder z 5 5 3 within" + law, {"must be inside or outside, got within"}},
      {"file wall.vtkhdf" + law, {"file wall.vtkhdf: cannot be opened"}},
      {"sphere 5 5 5 3" + law, {"shape must be plane, cylinder or file, got sphere"}},
      {"plane y 0 10" + law + " zone inlet", {"fix wall/levelset zone " + missing}},
      {"plane y 0 10" + law + " zone rest lo", {"zone name rest is taken"}},
      {"plane y 0 10" + law + " zone total lo", {"zone name total is taken"}},
      {"plane y 0 10" + law + " zone a lo zone a hi", {"zone name a is given twice"}},
      {"plane y 0 10" + law + " zone a cylinder",
       {"zone a: cylinder is neither a surface of this wall nor a region", "surfaces are lo hi"}},
      {"plane y NULL 10" + law + " zone a lo", {"lo is neither", "surfaces are hi"}},
      {"cylinder z 5 5 3 inside" + law + " zone a lo", {"lo is neither", "surfaces are cylinder"}},
      {"plane y 0 10" + law + " zone a lo slide 0.3", {"keyword slide is unknown"}},
      {"plane y 0 10" + law + " zone a lo sliding 0.3",
       {"keyword sliding is one of the contact law", "before move, resolution, film and zone"}},
      {"plane y 0 10" + law + " move linear 1 0 0 bridge 0.01 1 0 1",
       {"keyword bridge is one of the contact law", "before move, resolution, film and zone"}},
  };
  for (auto &row : table) row.input = "fix w all wall/levelset " + row.input;
  expect_errors(particles, table);
}

TEST(WallErrors, scene)
{
  const std::string law = " jkr 1e6 0.3 0\n", wall = "fix w all wall/levelset ";
  const std::string box = "units lj\nboundary f f f\nregion b block 0 1 0 1 0 1\n";
  expect_errors(box + "atom_style atomic\ncreate_box 1 b\n",
                {{wall + "plane y 0 NULL" + law, {"atom style sphere", "atomic"}}});
  const std::string plane = "units lj\ndimension 2\natom_style sphere\nboundary f f p\n"
                            "region b block 0 1 0 1 -0.5 0.5\ncreate_box 1 b\n";
  expect_errors(plane,
                {{wall + "cylinder x 0 0 1 inside" + law,
                  {"cylinder axis must be z in 2 dimensions, got x"}}});
  expect_errors("", {{wall + "plane y 0 NULL" + law, {"before simulation box"}}});
}

TEST(WallErrors, region_of_a_zone_is_deleted)
{
  expect_errors(particles + "pair_style zero 2\npair_coeff * *\n",
                {{"region a block 0 1 0 1 0 1\n"
                  "fix w all wall/levelset plane y 0 10 jkr 1e6 0.3 0 zone in a\n"
                  "region a delete\nrun 0",
                  {"Fix wall/levelset w", "region a of zone in does not exist any more"}}});
}

TEST(WallErrors, compute_wall_deposit)
{
  const std::string wall = "fix w all wall/levelset plane y 0 10 jkr 1e6 0.3 0\n",
                    deposit = "compute d all wall/deposit";
  expect_errors(particles + "pair_style zero 2\npair_coeff * *\n",
                {{deposit, {"compute wall/deposit command: missing argument"}},
                 {deposit + " w", {"needs the ID of a fix wall/levelset, got w"}},
                 {wall + deposit + " w zones lo", {"keyword zones is unknown; known is zone"}},
                 {wall + deposit + " w zone", {"missing argument"}},
                 {wall + deposit + " w zone lo hi", {"takes one zone, got also hi"}},
                 {wall + deposit + " w zone mid", {"fix w has no zone mid; its zones are lo hi"}},
                 {wall + deposit + " w\nunfix w\nrun 0", {"needs the ID of a fix", "got w"}},
                 {wall + deposit + " w\nunfix w\n" +
                      "fix w all wall/levelset plane y 0 NULL jkr 1e6 0.3 0\nrun 0",
                  {"fix w has other zones", "define it again"}}});
}

TEST(WallErrors, while_running)
{
  const std::string no_pair = "pair_style zero 2\npair_coeff * *\n",
                    wall = "fix w all wall/levelset ";
  expect_errors(
      particles + no_pair,
      {{wall + "plane y 0 10 jkr 100 0 5\nrun 0",
        {"Fix wall/levelset w", "overlap by 1.06", "E 97.3 times", "0.5"}},
       {wall + "plane y 6 NULL jkr 1e6 0.3 0\nrun 0",
        {"Fix wall/levelset w", "outside the fluid: 2 (IDs 1, 2), up to 1 behind the wall"}},
       {wall + "cylinder z 5 5 1 inside jkr 1e6 0.3 0\nrun 0",
        {"Fix wall/levelset w", "outside the fluid: 2 (IDs 1, 2), up to 1 behind"}},
       {wall + "plane y 0 10 jkr 1e-6 0.3 0\nset atom 1 y 9.6 vy 1\ntimestep 0.01\nrun 100",
        {"Fix wall/levelset w", "atom 1 passed the wall", "smaller timestep"}}});
}

// Particles that a script puts into a wall or behind it are named before the first step, the
// deepest first, whichever rank has them.
TEST(RanksWallErrors, particles_in_the_wall)
{
  std::string row = "region all block 0 10 0 10 0 10\n";
  for (int n = 1; n <= 7; n++)
    row += "create_atoms 1 single " + std::to_string(n) + " 0." + std::to_string(n) + " 2\n";
  row += "set group all diameter 1.0 density 1.0\npair_style zero 2\npair_coeff * *\n";
  const std::string wall = "fix w all wall/levelset plane y ", law = " NULL jkr 1e6 0.3 0\n";
  // atoms 3 to 9 stand at 0.1 to 0.7
  expect_errors(particles + row,
                {{wall + "0.75" + law + "run 0",
                  {"Fix wall/levelset w", "outside the fluid: 7 (IDs 3, 4, 5, 6, 7 and 2 more)",
                   "up to 0.65 behind the wall", "delete_atoms"}},
                 {wall + "0.25" + law + "minimize 0 0 1 1",
                  {"outside the fluid: 2 (IDs 3, 4), up to 0.15 behind"}}});
}

// Of the radius 0.5: 0.1 is borne in silence, and so is twice what a particle at rest takes.
TEST(WallWarnings, particles_that_begin_inside_the_wall)
{
  const auto log = [](double y, const std::string &law) {
    return log_of(particles + "pair_style zero 2\npair_coeff * *\nset atom 1 y " +
                  std::to_string(y) + "\nfix w all wall/levelset plane y 0 NULL " + law +
                  "\nrun 0");
  };
  const std::string words = "begin inside the wall";
  EXPECT_EQ(log(0.455, "jkr 1e6 0.3 0").find(words), std::string::npos);
  expect_words(log(0.445, "jkr 1e6 0.3 0"),
               {"y 0.445", {words, ": 1 (IDs 1), up to 0.11 of their radius", "delete_atoms"}});
  const std::string soft = "jkr 100 0 0.1";    // overlap at rest 0.078
  EXPECT_EQ(log(0.5 - 0.5 * 0.15, soft).find(words), std::string::npos);
  expect_words(log(0.5 - 0.5 * 0.16, soft), {"y 0.42", {words, "up to 0.16 of their radius"}});
}

// delta_eq = 0.078 r at gamma 0.1: E must be (0.078/0.05)^1.5 = 1.95 times as large
TEST(WallWarnings, overlap_and_timestep)
{
  const std::string start = particles + "pair_style zero 2\npair_coeff * *\n";
  const std::string text =
      log_of(start + "fix w all wall/levelset plane y 0 10 jkr 100 0 0.1\ntimestep 1\nrun 0");
  expect_words(text,
               {"wall",
                {"WARNING: Fix wall/levelset w", "overlap by 0.078", "E 1.95 times",
                 "timestep 1 is too large for the normal mode"}});
  const double good = number_before(text, " gives 0.3");
  const std::string quiet = log_of(start + "fix w all wall/levelset plane y 0 10 jkr 200 0 0.1\n" +
                                   "timestep " + std::to_string(0.7 * good) + "\nrun 0");
  EXPECT_EQ(quiet.find("WARNING"), std::string::npos) << quiet;
}

// particles between which no contact is stiff
TEST(WallWarnings, collision_steps_too_few)
{
  expect_enough_collision_steps("Fix wall/levelset w", {0.5, M_PI / 6.0},
                                particles + style + "pair_coeff * * jkr 1e-3 0.3 0\n" +
                                    "fix w all wall/levelset plane y 0 10");
}

// What a user of granular particles forgets, told when the pair style looks at the scene.
TEST(SceneChecks, discs_empty_groups_and_particles_wider_than_the_box)
{
  const std::string pair = style + hertz;
  expect_errors("units lj\ndimension 2\natom_style sphere\ncomm_modify vel yes\n"
                "region box block 0 10 0 10 -0.5 0.5\ncreate_box 2 box\n"
                "create_atoms 1 single 5 5 0\nset group all diameter 1.0 density 1.0\n" +
                    pair,
                {{"fix flat all nve/sphere disc\nrun 0", {"fix flat nve/sphere", "keyword disc"}}});

  const std::string empty = particles + pair + "unfix move\ngroup none empty\n";
  for (const std::string integrator : {"nve/sphere", "nve/sphere/mts collision 2"})
    expect_words(
        log_of(empty + "fix idle none " + integrator + "\nrun 0"),
        {integrator, {"WARNING: Pair granular/adhesive: fix idle", "its group none is empty"}});
  const std::string filled = empty +
      "fix air all flow/field uniform 0 1 0 density 1 viscosity 1\n"
      "fix in none inlet/flow y 1 air number 1 diameter 1 density 1 type 1 seed 1\n";
  EXPECT_EQ(log_of(filled + "fix idle none nve/sphere\nrun 0").find("is empty"), std::string::npos);
  EXPECT_EQ(log_of(particles + pair + "run 0").find("WARNING: Pair"), std::string::npos);

  expect_words(log_of(particles + pair + "set atom 1 diameter 12\nrun 0"),
               {"diameter 12", {"the largest particle has a diameter of 12, the box is 10 wide"}});
}
