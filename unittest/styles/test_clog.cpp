// The detector of a clog in in.nozzle: fix halt ends the run when nothing has left for 20 D/U, and
// only then. Who has left is counted here without it, by particles that a restart file has and the
// next one has not.

#include "scenes.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <set>

namespace {

constexpr int window = 2000;    // steps in 20 D/U

struct Saved {
  LAMMPS_NS::bigint step = 0;
  std::set<LAMMPS_NS::tagint> particles;
};

Saved read(const std::string &file)
{
  Simulation sim;
  sim.run("read_restart " + file);
  const auto *atom = sim.lammps()->atom;
  return {sim.lammps()->update->ntimestep, {atom->tag, atom->tag + atom->nlocal}};
}

struct End {
  Saved last, before;    // at the end, and a window earlier
  bool halted = false;
  std::string said;    // "clogged" or "open"

  size_t left() const
  {
    size_t n = 0;
    for (const auto tag : before.particles) n += !last.particles.count(tag);
    return n;
  }
};

// in.nozzle with a short channel before the contraction, up to t D/U
End nozzle(const std::string &name, int t, const std::vector<std::string> &words)
{
  const auto out = scratch_file(name);
  std::filesystem::create_directory(out);
  const std::string folder = APF_EXAMPLES "/nozzle";
  std::vector<std::string> all = {"-var", "dir",     out,    "-var", "flow", folder,
                                  "-var", "picture", "1000", "-var", "t",    std::to_string(t)};
  all.insert(all.end(), words.begin(), words.end());
  End end;
  {
    Simulation sim(all);
    sim.run("include " + folder + "/in.nozzle\nlog none\n");
    end.said = static_cast<const char *>(lammps_extract_variable(sim.lammps(), "end", nullptr));
  }
  for (const auto &file : std::filesystem::directory_iterator(out)) {
    const auto path = file.path().string();
    if (file.path().extension() == ".log") {
      std::ifstream log(path);
      const std::string text{std::istreambuf_iterator<char>(log), {}};
      end.halted = text.find("Fix halt condition for fix-id clog met") != text.npos;
    }
    if (file.path().extension() == ".end") end.last = read(path);
    if (path.find(".restart.a") != path.npos || path.find(".restart.b") != path.npos) {
      const auto saved = read(path);
      if (end.before.step == 0 || saved.step < end.before.step) end.before = saved;
    }
  }
  std::filesystem::remove_all(out);
  return end;
}

}    // namespace

TEST(Clog, ends_the_run_when_nothing_leaves)
{
  const auto end = nozzle("clogs", 400, {"-var", "phi", "125"});
  EXPECT_TRUE(end.halted);
  EXPECT_EQ(end.said, "clogged");
  EXPECT_LT(end.last.step, 400 * 100);
  EXPECT_EQ(end.last.step, end.before.step + window);
  EXPECT_GT(end.before.particles.size(), 100u);
  EXPECT_EQ(end.left(), 0u);
}

TEST(Clog, does_not_end_a_run_that_flows)
{
  const auto end = nozzle("flows", 100, {"-var", "phi", "0.001", "-var", "wall", "no"});
  EXPECT_FALSE(end.halted);
  EXPECT_EQ(end.said, "open");
  EXPECT_EQ(end.last.step, 100 * 100);
  EXPECT_EQ(end.last.step, end.before.step + window);
  // c0 D U times 20 D/U by pi/4 d^2 enter in a window, and as many leave, but for swings
  EXPECT_NEAR(end.left(), 127.0, 64.0);
}
