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

// Every style with state marks its part of a restart file with the number of its format and the
// count of its numbers. A part of another format, or of another length, is refused with the name of
// the style that it belongs to, and nothing of the file is printed.
class Restart {
 public:
  Restart()
  {
    Simulation sim;
    build(sim, {{0.495, 4.0, 4.0}, {1.485, 4.0, 4.0}, {5.0, 5.0, 5.0}}, beside_a_wall());
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
    if (error.empty()) error = sim.error_of("pair_coeff * *" + jkr + "\n" + styles() + "run 0");
    return error;
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

 private:
  TemporaryFile file{"apf_foreign", ".restart"};

  std::string contents() const
  {
    std::ifstream in(file.path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  static std::string styles()
  {
    return wall +
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
  EXPECT_EQ(restart.read(restart.bytes), "");
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

TEST(Faults, restart_to_a_full_device_is_an_error)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  sim.run("fix nve all nve/sphere\nrun 0");
  EXPECT_NE(sim.error_of("write_restart /dev/full"), "");
}

}    // namespace
