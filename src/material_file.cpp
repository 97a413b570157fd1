#include "material_file.h"

#include "flow/regular_file.h"

#include "comm.h"
#include "fmt/format.h"
#include "lammps.h"
#include "platform.h"
#include "text_file_reader.h"
#include "tokenizer.h"
#include "update.h"
#include "utils.h"

#include <mpi.h>

#include <cmath>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <unordered_map>
#include <vector>

using namespace LAMMPS_NS;

namespace apf {
namespace {

  // What 1 Pa and 1 J/m^2 are in the units of the simulation. With M, L, T the units of mass,
  // length and time, the unit of pressure is M/(L T^2) and that of energy per area is M/T^2.
  //
  //          M [kg]          L [m]        T [s]       pressure   energy/area
  //   si     1               1            1           1 Pa       1 J/m^2
  //   cgs    1e-3 (g)        1e-2 (cm)    1           0.1 Pa     1e-3 J/m^2   dyn/cm^2, erg/cm^2
  //   micro  1e-15 (pg)      1e-6 (um)    1e-6 (us)   1e3 Pa     1e-3 J/m^2
  //   nano   1e-21 (ag)      1e-9 (nm)    1e-9 (ns)   1e6 Pa     1e-3 J/m^2
  struct Units {
    const char *style;
    double pascal;          // 1 Pa                                          [pressure]
    double joule_per_m2;    // 1 J/m^2                                       [energy/length^2]
  };
  constexpr Units known_units[] = {
      {"si", 1.0, 1.0}, {"cgs", 10.0, 1.0e3}, {"micro", 1.0e-3, 1.0e3}, {"nano", 1.0e-6, 1.0e3}};

  constexpr std::uintmax_t most_bytes = 1000000;    // of a file, some ten thousand materials

  struct Entry {
    std::string name;
    Material material;
  };

  // What is wrong, and which of the words FILE NAME is to blame. Thrown on rank 0 only and turned
  // into an error of all ranks in read_material().
  struct Fault : std::runtime_error {
    enum Word { FILE_WORD, NAME_WORD } word;
    Fault(const std::string &text, Word _word = FILE_WORD) : std::runtime_error(text), word(_word)
    {
    }
  };

  double number(const std::string &word, const char *quantity, const std::string &place)
  {
    double value = HUGE_VAL;
    try {
      value = ValueTokenizer(word).next_double();
    } catch (TokenizerException &) {
      // reported below together with numbers too large for a double
    }
    if (!std::isfinite(value))
      throw Fault(fmt::format("{}: {} '{}' is not a number", place, quantity, word));
    return value;
  }

  Entry parse(const std::vector<std::string> &words, int line, const std::string &path)
  {
    const std::string place = fmt::format("material file {} line {}", path, line);
    if (words.size() != 4)
      throw Fault(
          fmt::format("{}: expected 4 words, NAME E nu gamma, got {} (comments begin with #)",
                      place, words.size()));

    const Material material{number(words[1], "Young's modulus E", place),
                            number(words[2], "Poisson's ratio nu", place),
                            number(words[3], "surface energy gamma", place)};
    if (material.E <= 0.0)
      throw Fault(fmt::format("{}: Young's modulus E must be > 0 Pa, got {}", place, words[1]));
    if (material.nu <= -1.0 || material.nu > 0.5)
      throw Fault(
          fmt::format("{}: Poisson's ratio nu must be > -1 and <= 0.5, got {}", place, words[2]));
    if (material.gamma < 0.0)
      throw Fault(
          fmt::format("{}: surface energy gamma must be >= 0 J/m^2, got {}", place, words[3]));
    return {words[0], material};
  }

  // Where LAMMPS looks for potentials. get_potential_file_path() would open whatever is there.
  std::string find_file(const std::string &file)
  {
    std::vector<std::string> places = {file};
    const std::string name = platform::path_basename(file);
    for (const auto &folder : platform::list_pathenv("LAMMPS_POTENTIALS"))
      if (!name.empty()) places.push_back(platform::path_join(folder, name));
    for (const auto &path : places) {
      const std::string why = why_not_a_file(path);
      if (!why.empty()) throw Fault(fmt::format("material file {} {}", path, why));
      if (!platform::file_is_readable(path)) continue;
      std::error_code none;
      const auto bytes = std::filesystem::file_size(path, none);
      if (!none && bytes > most_bytes)
        throw Fault(fmt::format("material file {} must be at most {} bytes long, got {}", path,
                                most_bytes, bytes));
      return path;
    }
    const char *folders = getenv("LAMMPS_POTENTIALS");
    throw Fault(fmt::format("cannot read material file {}: it is neither in the current folder nor "
                            "in LAMMPS_POTENTIALS ({})",
                            file, folders ? folders : "not set"));
  }

  // PotentialFileReader is not used: it converts between metal and real only, refuses all other
  // UNITS that differ from the simulation's, and does not know line numbers.
  std::vector<Entry> read_file(const std::string &path)
  {
    const std::string units = utils::get_potential_units(path, "material");
    if (units != "si")
      throw Fault(fmt::format("material file {} line 1: must say UNITS: si, got {}", path,
                              units.empty() ? "no UNITS" : "UNITS: " + units));

    std::vector<Entry> entries;
    std::unordered_map<std::string, int> lines;    // of names
    std::ifstream input(path);
    std::string text;
    for (int line = 1; std::getline(input, text); line++) {
      const auto words = Tokenizer(text.substr(0, text.find('#'))).as_vector();
      if (words.empty()) continue;

      const Entry entry = parse(words, line, path);
      const auto [before, is_new] = lines.emplace(entry.name, line);
      if (!is_new)
        throw Fault(fmt::format("material file {} line {}: material {} is already in line {}", path,
                                line, entry.name, before->second));
      entries.push_back(entry);
    }
    return entries;
  }

  Material find_material(LAMMPS *lmp, const std::string &file, const std::string &name)
  {
    const std::string path = find_file(file);
    std::string names;
    for (const auto &entry : read_file(path)) {
      if (entry.name == name) {
        const std::string date = utils::get_potential_date(path, "material");
        if (!date.empty())
          utils::logmesg(lmp, "Reading material {} from file {} with DATE: {}\n", name, file, date);
        return entry.material;
      }
      names += (names.empty() ? "" : ", ") + entry.name;
    }
    throw Fault(fmt::format("material {} is not in file {}, which has {}", name, path,
                            names.empty() ? "no materials" : names),
                Fault::NAME_WORD);
  }

  const Units &simulation_units(LAMMPS *lmp, const char *caller, int iarg)
  {
    for (const auto &units : known_units)
      if (strcmp(lmp->update->unit_style, units.style) == 0) return units;
    lmp->error->all(
        FLERR, iarg,
        "{} cannot convert material files, which are in si units, to units {}: use units "
        "si, cgs, micro or nano, or give the numbers by jkr E nu gamma",
        caller, lmp->update->unit_style);
  }

}    // namespace

Material read_material(LAMMPS *lmp, const std::string &file, const std::string &name,
                       const char *caller, int iarg)
{
  const Units &units = simulation_units(lmp, caller, iarg);

  Material material{};
  std::string fault;
  int word = Fault::FILE_WORD;
  if (lmp->comm->me == 0) {
    try {
      material = find_material(lmp, file, name);
    } catch (Fault &error) {
      fault = error.what();
      word = error.word;
    } catch (FileReaderException &error) {
      fault = error.what();
    }
  }

  // error->one() would end an MPI run by MPI_Abort: tell all ranks instead, and all throw
  int about_fault[2] = {static_cast<int>(fault.size()), word};
  MPI_Bcast(about_fault, 2, MPI_INT, 0, lmp->world);
  if (about_fault[0] > 0) {
    fault.resize(about_fault[0]);
    MPI_Bcast(&fault[0], about_fault[0], MPI_CHAR, 0, lmp->world);
    const bool blame_name = about_fault[1] == Fault::NAME_WORD && iarg >= 0;
    lmp->error->all(FLERR, blame_name ? iarg + 1 : iarg, "{}: {}", caller, fault);
  }

  double values[3] = {material.E, material.nu, material.gamma};
  MPI_Bcast(values, 3, MPI_DOUBLE, 0, lmp->world);
  return {values[0] * units.pascal, values[1], values[2] * units.joule_per_m2};
}

}    // namespace apf
