// Cases of the report: scripts of examples/, for a short time, end with the word that they passed.

#include "scenes.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace {

std::string verdict(const std::string &name, const std::string &script,
                    std::vector<std::string> words)
{
  const auto out = scratch_file(name + "_" + script);
  std::filesystem::create_directory(out);
  const std::string folder = APF_EXAMPLES "/" + name;
  for (const std::string word : {"-var", "dir", out.c_str(), "-var", "flow", folder.c_str()})
    words.push_back(word);
  Simulation sim(words);
  sim.run("include " + folder + "/in." + script + "\nlog none\n");
  const std::string said =
      static_cast<const char *>(lammps_extract_variable(sim.lammps(), "verdict", nullptr));
  std::filesystem::remove_all(out);
  return said;
}

}    // namespace

TEST(Examples, pipe)
{
  EXPECT_EQ(verdict("pipe", "pipe", {"-var", "t", "1"}), "pass");
  EXPECT_EQ(verdict("pipe", "pipe", {"-var", "t", "0.5", "-var", "phi", "30"}), "pass");
}

TEST(Examples, fiber)
{
  EXPECT_EQ(verdict("fiber", "fiber", {"-var", "t", "10"}), "pass");
  EXPECT_EQ(verdict("fiber", "clean", {}), "pass");
}

TEST(Examples, nozzle)
{
  EXPECT_EQ(verdict("nozzle", "nozzle", {"-var", "t", "10"}), "pass");
  EXPECT_EQ(verdict("nozzle", "nozzle", {"-var", "t", "10", "-var", "wall", "no"}), "pass");
}

TEST(Examples, radiator)
{
  EXPECT_EQ(verdict("radiator", "radiator", {"-var", "t", "3"}), "pass");
  EXPECT_EQ(verdict("radiator", "radiator", {"-var", "t", "3", "-var", "wet", "yes"}), "pass");
}

TEST(Examples, duct)
{
  EXPECT_EQ(verdict("duct", "duct", {}), "pass");
}

TEST(Examples, humid_channel)
{
  EXPECT_EQ(verdict("channel", "channel.humid", {"-var", "t", "1"}), "pass");
}

TEST(Examples, wetpair)
{
  EXPECT_EQ(verdict("wetpair", "wetpair", {}), "pass");
}
