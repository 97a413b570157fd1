// pair_coeff I J material FILE NAME as the user sees it: conversion of units by forces, and errors.

#include "fuzz/child.h"
#include "simulation.h"

#include "gtest/gtest.h"

#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

namespace {

const std::string header = "# DATE: 2026-11-22 UNITS: si CITATION: none\n";

// A material file in the temporary folder while the object lives; the same for all ranks.
class MaterialFile {
 public:
  explicit MaterialFile(const std::string &text)
  {
    int pid = static_cast<int>(getpid());
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    MPI_Bcast(&pid, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path = std::filesystem::temp_directory_path() / ("apf_" + std::to_string(pid) + ".adhesive");
    if (me == 0) std::ofstream(path) << text;
    MPI_Barrier(MPI_COMM_WORLD);
  }
  ~MaterialFile()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (me == 0) std::filesystem::remove(path);
  }
  MaterialFile(const MaterialFile &) = delete;
  MaterialFile &operator=(const MaterialFile &) = delete;

  std::string name() const { return path.string(); }

 private:
  int me = 0;
  std::filesystem::path path;
};

// What one unit of a LAMMPS units style is in si, from its mass, length and time.
struct Units {
  std::string style;
  double mass, length, time;    // [kg], [m], [s]

  double pressure() const { return mass / (length * time * time); }
  double energy_per_area() const { return mass / (time * time); }
  double force() const { return mass * length / (time * time); }
  double density() const { return mass / (length * length * length); }
};
const std::vector<Units> all_units = {{"si", 1.0, 1.0, 1.0},
                                      {"cgs", 1.0e-3, 1.0e-2, 1.0},
                                      {"micro", 1.0e-15, 1.0e-6, 1.0e-6},
                                      {"nano", 1.0e-21, 1.0e-9, 1.0e-9}};

std::string digits(double value)
{
  std::ostringstream text;
  text.precision(std::numeric_limits<double>::max_digits10);
  text << value;
  return text.str();
}

constexpr double diameter = 2.0e-6;    // of both particles [m]

// two equal particles at rest on the x axis with a given overlap [m], up to the pair_coeff command
std::string two_particles(const Units &units, double overlap)
{
  const double d = diameter / units.length;
  return "units " + units.style + "\natom_style sphere\natom_modify map array\n" +
      "comm_modify vel yes\nneighbor " + digits(0.1 * d) + " bin\n" + "region box block " +
      digits(-4.0 * d) + " " + digits(4.0 * d) + " " + digits(-4.0 * d) + " " + digits(4.0 * d) +
      " " + digits(-4.0 * d) + " " + digits(4.0 * d) + "\ncreate_box 1 box\n" +
      "create_atoms 1 single 0 0 0\ncreate_atoms 1 single " + digits(d - overlap / units.length) +
      " 0 0\nset group all diameter " + digits(d) + " density " + digits(2200.0 / units.density()) +
      "\npair_style granular/adhesive\n";
}

// force that pushes the particles apart, in N
double force_apart(const Units &units, double overlap, const std::string &material)
{
  Simulation simulation;
  simulation.run(two_particles(units, overlap) + "pair_coeff 1 1 " + material + "\nrun 0\n");
  return simulation.value("fx[2]") * units.force();
}

// JKR at overlap 0 pulls with 8/9 of the pull-off force 3 pi gamma R, whatever the stiffness
double pull_at_touch(double gamma)
{
  const double R = 0.25 * diameter;
  return -8.0 / 9.0 * 3.0 * std::acos(-1.0) * gamma * R;
}
constexpr double touch =
    1.0e-15;    // an overlap that is sure to be contact; shifts the force by 1e-5

// the error of pair_coeff with material NAME from a file with this text
std::string error_with(const std::string &text, const std::string &name = "a")
{
  MaterialFile file(text);
  Simulation simulation;
  simulation.run(two_particles(all_units[0], 0.0));
  return simulation.error_of("pair_coeff 1 1 material " + file.name() + " " + name);
}

void expect_words(const std::string &text, const std::vector<std::string> &words)
{
  for (const auto &word : words)
    EXPECT_NE(text.find(word), std::string::npos) << "no '" << word << "' in: " << text;
}

}    // namespace

// Hertz between equal spheres of radius r: R = r/2, E* = E/(2 (1 - nu^2)), F = 4/3 E* sqrt(R) d^1.5
TEST(MaterialFile, elastic_force_is_the_same_in_all_units)
{
  const double E = 73.0e9, nu = 0.17, overlap = 10.0e-9;
  const double hertz =
      4.0 / 3.0 * E / (2.0 * (1.0 - nu * nu)) * std::sqrt(0.25 * diameter) * std::pow(overlap, 1.5);
  MaterialFile file(header + "glass 73e9 0.17 0 # no adhesion\n");
  for (const auto &units : all_units) {
    const double force = force_apart(units, overlap, "material " + file.name() + " glass");
    EXPECT_NEAR(force / hertz, 1.0, 1.0e-9) << units.style;
  }
}

TEST(MaterialFile, adhesive_force_is_the_same_in_all_units)
{
  MaterialFile file(header + "glass 73e9 0.17 0.025\n");
  for (const auto &units : all_units) {
    const double force = force_apart(units, touch, "material " + file.name() + " glass");
    EXPECT_NEAR(force / pull_at_touch(0.025), 1.0, 1.0e-4) << units.style;
  }
}

TEST(MaterialFile, gives_the_force_of_jkr_with_the_same_numbers)
{
  const double E = 3.3e9, nu = 0.35, gamma = 0.032, overlap = 2.0e-9;
  MaterialFile file(header + "ps 3.3e9 0.35 0.032\n");
  for (const auto &units : all_units) {
    const double force = force_apart(units, overlap, "material " + file.name() + " ps");
    const double same = force_apart(units, overlap,
                                    "jkr " + digits(E / units.pressure()) + " " + digits(nu) + " " +
                                        digits(gamma / units.energy_per_area()));
    EXPECT_NE(force, 0.0) << units.style;
    EXPECT_NEAR(force / same, 1.0, 1.0e-12) << units.style;
  }
}

// found through LAMMPS_POTENTIALS, with the surface energies of the table in the manual
TEST(MaterialFile, shipped_materials_pull_with_their_surface_energy)
{
  const std::vector<std::pair<std::string, double>> shipped = {
      {"silica", 0.020},      {"silica-vacuum", 0.20}, {"soda-lime-glass", 0.0425},
      {"polystyrene", 0.032}, {"alumina", 0.074},      {"steel", 0.040},
      {"sandstone", 0.028}};
  for (const auto &[name, gamma] : shipped) {
    const double force = force_apart(all_units[0], touch, "material materials.adhesive " + name);
    EXPECT_NEAR(force / pull_at_touch(gamma), 1.0, 1.0e-3) << name;
  }
}

TEST(MaterialFile, comments_blank_lines_and_dos_line_ends_are_skipped)
{
  EXPECT_EQ(error_with(header + "\r\n# a 1 2 3\r\na 1e9 0.3 0.01 # said twice: a 1 1 1\r\n"), "");
}

TEST(MaterialFile, limits_of_the_ranges_are_allowed)
{
  EXPECT_EQ(error_with(header + "a 1e9 0.5 0\n"), "");
  EXPECT_EQ(error_with(header + "a 1e9 -0.99 0\n"), "");
}

TEST(MaterialFile, error_names_a_missing_file)
{
  Simulation simulation;
  simulation.run(two_particles(all_units[0], 0.0));
  expect_words(simulation.error_of("pair_coeff 1 1 material no_such.adhesive a"),
               {"Pair granular/adhesive", "no_such.adhesive", "LAMMPS_POTENTIALS"});
}

// In children that are ended if they wait, or read on and on.
TEST(MaterialFile, error_for_what_is_not_a_regular_file)
{
  namespace fs = std::filesystem;
  const auto folder =
      fs::temp_directory_path() / ("apf_material_" + std::to_string(getpid())) / "of_pipes";
  const auto pipe = folder / "pipe.adhesive", large = folder / "large.adhesive";
  fs::create_directories(folder);
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  std::ofstream(large) << header + "glass 73e9 0.17 0.025\n";
  fs::resize_file(large, 1000001);
  const std::string regular = " is not a regular file";
  const std::vector<std::array<std::string, 2>> table = {
      {pipe, regular},
      {"pipe.adhesive", regular},    // of LAMMPS_POTENTIALS
      {"/dev/zero", regular},
      {folder, " is a folder, not a file"},
      {large, " must be at most 1000000 bytes long, got 1000001"}};
  setenv("LAMMPS_POTENTIALS", folder.c_str(), 1);
  Simulation simulation;
  simulation.run(two_particles(all_units[0], 0.0));
  for (const auto &command :
       {"pair_coeff * * material ",
        "fix wall all wall/levelset cylinder z 0 7e-6 1e-6 outside material "})
    for (const auto &[file, why] : table) {
      const auto ended = fuzz::in_child(
          [&, name = file](int out) {
            const auto text = simulation.error_of(command + name + " glass");
            return write(out, text.data(), text.size()) < 0;
          },
          1, RLIM_INFINITY);
      EXPECT_EQ(ended.death, "") << command << file;
      expect_words(ended.text, {": material file ", fs::path(file).filename(), why});
    }
  fs::remove_all(folder.parent_path());
}

TEST(MaterialFile, error_lists_the_materials_of_the_file)
{
  expect_words(error_with(header + "copper 1e9 0.3 0\ntin 1e9 0.3 0\n", "gold"),
               {"gold", "copper, tin", ".adhesive"});
  expect_words(error_with(header, "gold"), {"gold", "no materials"});
}

TEST(MaterialFile, error_names_line_value_and_range)
{
  expect_words(error_with(header + "\na 0 0.3 0\n"),
               {".adhesive line 3", "Young's", "> 0", "got 0"});
  expect_words(error_with(header + "a -1e9 0.3 0\n"), {"line 2", "Young's", "> 0", "got -1e9"});
  expect_words(error_with(header + "a 1e9 0.51 0\n"),
               {"line 2", "Poisson's", "<= 0.5", "got 0.51"});
  expect_words(error_with(header + "a 1e9 -1 0\n"), {"line 2", "Poisson's", "> -1", "got -1"});
  expect_words(error_with(header + "a 1e9 0.3 -0.1\n"), {"line 2", "gamma", ">= 0", "got -0.1"});
}

TEST(MaterialFile, error_names_a_bad_number)
{
  for (const std::string word : {"1e9x", "nan", "inf", "1e999", "GPa", "{}"})
    expect_words(error_with(header + "a " + word + " 0.3 0\n"),
                 {"line 2", "Young's", "'" + word + "'", "not a number"});
}

TEST(MaterialFile, error_for_missing_and_surplus_words)
{
  expect_words(error_with(header + "a 1e9 0.3\n"), {"line 2", "NAME E nu gamma", "got 3"});
  expect_words(error_with(header + "a 1e9 0.3 0 2200\n"), {"line 2", "NAME E nu gamma", "got 5"});
}

// also in a line that was not asked for: the file is read whole
TEST(MaterialFile, error_for_a_material_given_twice)
{
  expect_words(error_with(header + "a 1e9 0.3 0\nb 1e9 0.3 0\nb 2e9 0.3 0\n"),
               {"line 4", "material b", "line 3"});
}

TEST(MaterialFile, error_for_other_units_in_the_file)
{
  expect_words(error_with("# DATE: 2026-11-22 UNITS: metal\na 1e9 0.3 0\n"),
               {"line 1", "UNITS: si", "UNITS: metal"});
  expect_words(error_with("a 1e9 0.3 0\n"), {"line 1", "UNITS: si"});
}

TEST(MaterialFile, error_for_units_that_cannot_be_converted)
{
  MaterialFile file(header + "a 1e9 0.3 0\n");
  for (const std::string style : {"lj", "real", "metal", "electron"}) {
    Simulation simulation;
    simulation.run(two_particles({style, 1.0, 1.0, 1.0}, 0.0));
    expect_words(simulation.error_of("pair_coeff 1 1 material " + file.name() + " a"),
                 {"units " + style, "si, cgs, micro or nano", "jkr E nu gamma"});
  }
}

// Every rank gets the material, or every rank gets the error: a rank left behind would hang here.
TEST(RanksMaterialFile, all_ranks_agree)
{
  MaterialFile file(header + "a 1e9 0.3 0\n");
  const std::string command = "pair_coeff 1 1 material " + file.name() + " ";
  Simulation simulation;
  simulation.run(two_particles(all_units[0], 10.0e-9));
  expect_words(simulation.error_of(command + "gold"), {"gold", "has a"});
  simulation.run(command + "a\nrun 0\n");
  const double hertz = 4.0 / 3.0 * 1.0e9 / (2.0 * (1.0 - 0.09)) * std::sqrt(0.25 * diameter) *
      std::pow(10.0e-9, 1.5);
  EXPECT_NEAR(simulation.value("fx[2]") / hertz, 1.0, 1.0e-9);
}
