// Restart files that are damaged or of another version, and disks that are full.

#include "scenes.h"
#include "temporary_file.h"

#include <cctype>
#include <csignal>
#include <cstring>
#include <fstream>
#include <set>

#include <sys/resource.h>

namespace {

const std::string wall = "fix wall all wall/levelset plane x 0 NULL" + jkr + all_friction + "\n";
const std::string wet = jkr + all_friction + " bridge 0.01 5.0 20 1e-3 form film inventory 0.5 ";

std::string bytes_of(double number)
{
  return {reinterpret_cast<const char *>(&number), sizeof(number)};
}

// Every style with state marks its part of a restart file with the number of its format and the
// count of its numbers. A part of another format, or of another length, is refused with the name of
// the style that it belongs to, and nothing of the file is printed.
class Restart {
 public:
  Restart()
  {
    Simulation sim;
    Scene scene = beside_a_wall();
    scene.style = pair_of(wet);
    build(sim, {{0.495, 4.0, 4.0}, {1.485, 4.0, 4.0}, {5.0, 5.0, 5.0}}, scene);
    sim.run(styles() + "run 3\nwrite_restart " + file.path);
    bytes = contents();
    for (size_t at = bytes.find("APF"); at != std::string::npos; at = bytes.find("APF", at + 1))
      marks.push_back(at);
  }
  // what LAMMPS says of the file after a change at a mark
  std::string with(size_t mark, const std::string &other) const
  {
    std::string changed = bytes;
    changed.replace(mark, other.size(), other);
    return read(changed);
  }
  std::string read(const std::string &changed) const
  {
    std::ofstream(file.path, std::ios::binary) << changed;
    Simulation sim;
    sim.run("comm_modify vel yes");
    std::string error = sim.error_of("read_restart " + file.path);
    if (error.empty()) error = sim.error_of(styles() + "run 0");
    return error;
  }
  std::string with_number(size_t at, double number) const { return with(at, bytes_of(number)); }
  double number(size_t at) const
  {
    double value;
    std::memcpy(&value, &bytes[at], sizeof(value));
    return value;
  }
  // where the first number of a style's part stands, and how many bytes there are
  size_t part_of(const std::string &style, unsigned *size = nullptr) const
  {
    for (const size_t mark : marks) {
      if (with(mark, "APF\x7f").find(style) == std::string::npos) continue;
      if (size) std::memcpy(size, &bytes[mark + 4], sizeof(*size));
      return mark + 8;
    }
    ADD_FAILURE() << style;
    return 0;
  }
  // a count of numbers as it stands in a mark
  std::string count(size_t mark, int more) const
  {
    unsigned n;
    std::memcpy(&n, &bytes[mark + 4], sizeof(n));
    n += more;
    return {reinterpret_cast<const char *>(&n), sizeof(n)};
  }
  std::vector<size_t> marks;
  std::string bytes;

  // what LAMMPS says of the file and commands after it; STYLES: all fixes as they were
  std::string log_with(std::string commands) const
  {
    const auto at = commands.find("STYLES");
    if (at != std::string::npos) commands.replace(at, 6, styles());
    std::ofstream(file.path, std::ios::binary) << bytes;
    Simulation sim;
    sim.run("comm_modify vel yes\nread_restart " + file.path);
    return log_of(sim, commands + "\n");
  }

 private:
  TemporaryFile file{"apf_foreign", ".restart"};

  std::string contents() const
  {
    std::ifstream in(file.path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string styles()
  {
    return "fix wall all wall/levelset plane x 0 NULL" + wet + "film 1e-3 move linear 0 0 0\n" +
        "variable speed equal 1.0+step\n"
        "fix air all flow/field uniform v_speed 0 0 density 1e-3 viscosity 1e-3\n"
        "fix in all inlet/flow x 2.0 air number 1 diameter 0.2 density 1 type 1 seed 7\n" +
        mts(10);
  }
};

void expect_refusal(const std::string &error, const std::string &why)
{
  EXPECT_NE(error.find("its part of the restart file cannot be used: " + why), std::string::npos)
      << error;
  for (const char c : error) EXPECT_TRUE(std::isprint(c) || std::isspace(c)) << error;
}

TEST(Faults, restart_of_another_version_is_refused)
{
  const Restart restart;
  ASSERT_EQ(restart.read(restart.bytes), "");
  std::set<std::string> named;
  for (const size_t mark : restart.marks) {
    const double old = 2.0;    // files without marks begin with a number
    for (const auto &other : {std::string("APF\x7f"), std::string(8, '\0'), std::string(8, '\xff'),
                              std::string(reinterpret_cast<const char *>(&old), sizeof(old))}) {
      const auto error = restart.with(mark, other);
      expect_refusal(error, "another version of APF wrote it");
      for (const char *style : {"Pair granular/adhesive", "Fix wall/levelset wall",
                                "Fix flow/field air", "Fix inlet/flow in", "Fix nve/sphere/mts "})
        if (error.find(style) != std::string::npos) named.insert(style);
    }
  }
  EXPECT_EQ(named.size(), 5u);
}

TEST(Faults, restart_with_fewer_or_more_numbers_is_refused)
{
  const Restart restart;
  int fixes = 0;
  for (const size_t mark : restart.marks) {
    const auto with = [&](int more) {
      return restart.with(mark + 4, restart.count(mark, more));
    };
    const auto fewer = with(-1), more = with(1);
    if (fewer.find("Pair") != std::string::npos) continue;    // its mark has the size of a record
    expect_refusal(fewer, "it is too short");
    expect_refusal(more, "it is too long");
    fixes++;
  }
  EXPECT_GE(fixes, 4);
  for (const double share : {0.3, 0.6, 0.9, 0.99})
    EXPECT_NE(restart.read(restart.bytes.substr(0, share * restart.bytes.size())), "") << share;
}

const double none = std::nan(""), inf = HUGE_VAL;

void expect_damage(const std::string &error, const std::string &style, const std::string &what)
{
  EXPECT_NE(error.find(style), std::string::npos) << what << ": " << error;
  expect_refusal(error, error.find("next particle") == std::string::npos ? "it is damaged" : "");
}

// numbers of the fixes' own parts that become counts, indices, choices, or parts of forces
TEST(Faults, restart_with_numbers_that_cannot_be_is_refused)
{
  const Restart restart;
  const struct {
    const char *style;
    std::vector<int> which;
    std::vector<double> bad;
  } table[] = {
      {"Fix nve/sphere/mts nve", {0}, {none, inf, -5.0, 0.0, 1e9, 1.5}},    // collision steps
      {"Fix nve/sphere/mts nve", {1, 2}, {none, -1.0, 0.5, 1e300}},
      {"Fix flow/field air", {0, 1, 2, 3, 4, 5}, {none, -inf}},    // speeds and rates
      {"Fix flow/field air", {6}, {none, inf}},                    // their time
      {"Fix flow/field air", {7}, {none, 0.5, 1e300}},             // ... and step
      {"Fix contact/history ", {0}, {none, inf, -1.0}},
      {"Fix wall/levelset wall", {0}, {none, -1.0}},
      {"Fix wall/levelset wall", {1, 2}, {none, -1.0, 0.5}},    // captured, detached
      {"Fix wall/levelset wall", {3}, {none, -1.0, 2.0}},       // it moves
      {"Fix wall/levelset wall", {4, 6, 16, 21}, {none, inf}},
      {"Fix wall/levelset wall", {7, 8, 11, 12, 15}, {none, 0.5}},    // its axes
      {"Fix inlet/flow in", {0}, {none, inf, -1.0}},                  // owed
      {"Fix inlet/flow in", {1}, {none, 0.0, -0.2, 0.3, 1e300}},      // diameter of the next
      {"Fix inlet/flow in", {2, 3, 8, 10}, {none, -1.0, 0.5, 1e300}},
      {"Fix inlet/flow in", {4, 5, 6, 7, 9}, {none, -1.0}},
      {"Fix inlet/flow in", {11, 60, 108, 111, 112, 113}, {none, -0.1, 1.0}},    // random numbers
      {"Fix inlet/flow in", {109, 110}, {none, 0.0, 98.0, 1e8, -1.0, 33.5}},
  };
  for (const auto &[style, which, bad] : table) {
    const size_t part = restart.part_of(style);
    for (const int k : which)
      for (const double number : bad)
        expect_damage(restart.with_number(part + 8 * k, number), style,
                      "number " + std::to_string(k) + " is " + digits(number));
  }
}

// All numbers of the coefficients, and of the moduli that follow from E = 1e6 and nu = 1/4
TEST(Faults, restart_with_coefficients_that_cannot_be_is_refused)
{
  const Restart restart;
  const char *pair = "Pair granular/adhesive: ";
  unsigned size = 0;
  const size_t part = restart.part_of(pair, &size), E = restart.bytes.find(bytes_of(1e6), part);
  ASSERT_EQ(E, part + sizeof(int));    // behind the flag whether there are any
  ASSERT_NEAR(restart.number(E + 32) / Material().G_eff(), 1.0, 1e-12);
  ASSERT_EQ(restart.number(E + 56), 0.3);    // sliding
  const std::string ones(8, '\xff');         // no number, no choice, neither yes nor no
  for (unsigned k = 0; k < size; k += 8)
    expect_damage(restart.with(E + k, ones), pair, "at byte " + std::to_string(k));
  for (const unsigned k : {0, 1, 2, 3, 4, 5, 6, 7})
    expect_damage(restart.with_number(E + 8 * k, -1.0), pair, "number " + std::to_string(k));
  expect_damage(restart.with(part, std::string("\x02\0\0\0", 4)), pair, "flag");
}

// What the first sphere has with another, and with the wall: a contact and a bridge each, and its
// liquid, which may be one that nobody has set yet.
TEST(Faults, restart_with_contacts_that_cannot_be_is_refused)
{
  const Restart restart;
  const double bridge = 0x1p20, liquid = 0x1p40;
  const struct {
    const char *style;
    double what, size;
  } table[] = {
      {"Fix contact/history ", 1.0 + bridge + liquid, 29.0},
      {"Fix wall/levelset wall", 1.0 + bridge, 28.0},
  };
  for (const auto &[style, what, size] : table) {
    const size_t count = restart.bytes.find(bytes_of(what)), part = count - 8 * 11;
    ASSERT_NE(count, std::string::npos) << style;
    ASSERT_EQ(restart.number(part), size) << style;
    const int n = static_cast<int>(size), of_liquid = size == 29.0 ? 13 : -1, formed = n - 1;
    for (int k = 2; k < n; k++)    // behind the size, and what is only compared
      for (const double bad : {none, inf, -inf}) {
        if ((k == of_liquid && std::isnan(bad)) || (k == formed && std::isinf(bad))) continue;
        expect_damage(restart.with_number(part + 8 * k, bad), style, std::to_string(k));
      }
    const auto unset = restart.with_number(part + 8 * std::max(of_liquid, 1), none);
    EXPECT_EQ(unset, "");
    for (const double bad : {0.0, -5.0, 1e9, size + 0.5, size - 1.0})
      EXPECT_NE(restart.with_number(part, bad).find("its part of the restart file cannot be used"),
                std::string::npos)
          << style << bad;
    // more contacts than were written, and a size that fits
    for (const double more : {1.0, 20.0, 1e6}) {
      std::string changed = restart.bytes;
      changed.replace(part, 8, bytes_of(size + 11.0 * more));
      changed.replace(count, 8, bytes_of(what + more));
      const auto error = restart.read(changed);
      EXPECT_NE(error.find("its part of the restart file cannot be used"), std::string::npos)
          << style << more << error;
    }
  }
}

// The disk is full once a file has so many bytes
class FullDisk {
 public:
  explicit FullDisk(rlim_t bytes)
  {
    getrlimit(RLIMIT_FSIZE, &before);
    const rlimit now = {bytes, before.rlim_max};
    setrlimit(RLIMIT_FSIZE, &now);
    answer = std::signal(SIGXFSZ, SIG_IGN);
  }
  ~FullDisk()
  {
    setrlimit(RLIMIT_FSIZE, &before);
    std::signal(SIGXFSZ, answer);
  }
  FullDisk(const FullDisk &) = delete;
  FullDisk &operator=(const FullDisk &) = delete;

 private:
  rlimit before{};
  void (*answer)(int);
};

// Restart files and dumps end the run with an error; the restart file before stays usable. LAMMPS
// does not see that the last 4096 bytes cannot be written: it looks before it closes the file.
TEST(Faults, full_disk)
{
  const TemporaryFile first("apf_first", ".restart"), second("apf_second", ".restart"),
      dump("apf_full", ".dump");
  const std::string neck = "pair_coeff * *" + jkr + "\nfix nve all nve/sphere\n";
  std::vector<double> x;
  {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.99, 4.0, 4.0}}, beside_a_wall());
    sim.run(wall + neck + "run 5\nwrite_restart " + first.path);
    x = gather(sim, "x");
    sim.run("run 5");
    for (const double share : {0.1, 0.5}) {
      const FullDisk full(static_cast<rlim_t>(share * std::filesystem::file_size(first.path)));
      EXPECT_NE(sim.error_of("write_restart " + second.path), "") << share;
    }
    const FullDisk full(2000);
    const auto said = sim.error_of("dump all all custom 1 " + dump.path + " id x y z\nrun 1000");
    EXPECT_NE(said.find("rror writing dump"), std::string::npos) << said;
  }
  Simulation sim;
  sim.run("comm_modify vel yes\nread_restart " + first.path);
  EXPECT_EQ(gather(sim, "x"), x);
  EXPECT_EQ(sim.error_of(wall + neck + "run 5"), "");
}

int count_of(const std::string &text, const std::string &words)
{
  int n = 0;
  for (size_t at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) n++;
  return n;
}

// The first command that prepares a run throws away the state of fixes that are not there: told by
// each that comes later under the same ID, once. One that is new on purpose is not told of.
TEST(Faults, state_that_a_command_has_thrown_away_is_told_of)
{
  const Restart restart;
  const std::string words = "the restart file had its state";
  for (const std::string command :
       {"run 0", "write_data /dev/null", "reset_atoms id", "delete_atoms overlap 0.1 all all"}) {
    const std::string log = restart.log_with(command + "\nSTYLES\nrun 0\nrun 0");
    SCOPED_TRACE(command + log);
    for (const char *fix :
         {"wall/levelset wall", "flow/field air", "inlet/flow in", "nve/sphere/mts nve"})
      EXPECT_EQ(count_of(log, std::string("WARNING: Fix ") + fix + ": " + words), 1) << fix;
    EXPECT_EQ(count_of(log, words), 4);
  }
  const std::string other = "fix other all wall/levelset plane x 0 NULL" + wet + "film 1e-3\n";
  for (const std::string &commands :
       {std::string("STYLES\nrun 0\nunfix wall\nrun 0\n") + wall + "run 0",
        "run 0\n" + other + "run 0", other + "run 0"})
    EXPECT_EQ(count_of(restart.log_with(commands), words), 0) << commands;
}

TEST(Faults, restart_to_a_full_device_is_an_error)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  sim.run("fix nve all nve/sphere\nrun 0");
  EXPECT_NE(sim.error_of("write_restart /dev/full"), "");
}

}    // namespace
