// Cases of the report: scripts of examples/, for a short time, end with the word that they passed.

#include "scenes.h"
#include "simulation.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <sstream>

namespace {

// last line of what the channel wrote after these runs, one after another
std::string channel(const std::string &name, const std::vector<std::vector<const char *>> &runs)
{
  const auto out = scratch_file(name);
  std::filesystem::create_directory(out);
  for (const auto &run : runs) {
    std::vector<std::string> words = {"-var", "dir", out, "-var", "picture", "100"};
    words.insert(words.end(), run.begin(), run.end());
    Simulation sim(words);
    sim.run("include " APF_EXAMPLES "/channel/in.channel\nlog none\n");
  }
  std::ifstream file(out + "/channel-phi50.aggregates");
  std::string line, last;
  while (std::getline(file, line)) last = line;
  std::filesystem::remove_all(out);
  return last;
}

// in.study of an example, from its folder
void study(const std::string &name, const std::vector<std::string> &words)
{
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(APF_EXAMPLES "/" + name);
  {
    Simulation sim(words);
    sim.run("include in.study\nlog none\n");
  }
  std::filesystem::current_path(here);
}

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
  std::string said =
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

TEST(Examples, channel_goes_on_from_its_restart_file)
{
  const auto whole = channel("channel_whole", {{"-var", "t", "0.4"}});
  const auto parts = channel("channel_parts",
                             {{"-var", "t", "0.3"}, {"-var", "t", "0.4", "-var", "resume", "end"}});
  // time, particles in aggregates, aggregates, size; at walls: rounding has not grown yet
  const auto counts = [](std::istringstream line) {
    std::string text, word;
    for (int k = 0; k < 8 && line >> word; k++) text += word + " ";
    return text;
  };
  EXPECT_EQ(counts(std::istringstream(whole)), counts(std::istringstream(parts)));
  EXPECT_EQ(whole.substr(0, 8), "400 0.4 ");
}

TEST(Examples, study_of_the_nozzle_walks_through_its_parameters)
{
  const auto out = scratch_file("nozzle_study");
  std::filesystem::create_directory(out);
  for (const std::string length : {"0.5", "0.50"})    // the same flow by two names
    for (const std::string kind : {".vtkhdf", "-walls.vtkhdf"})
      std::filesystem::create_symlink(APF_EXAMPLES "/nozzle/nozzle-0.5" + kind,
                                      out + "/nozzle-" + length + kind);
  study("nozzle",
        {"-var", "dir", out, "-var", "flow", out, "-var", "t", "0.1", "-var", "phis", "25", "50",
         "-var", "lengths", "0.5 0.50"});
  for (const char *length : {"0.5", "0.50"})
    for (const char *phi : {"25", "50"})
      EXPECT_TRUE(std::filesystem::exists(out + "/nozzle-" + length + "-phi" + phi +
                                          "-wall-yes.restart.end"))
          << length << " " << phi;
  std::filesystem::remove_all(out);
}

TEST(Examples, study_of_the_channel_walks_through_its_parameters)
{
  const auto out = scratch_file("channel_study");
  study("channel",
        {"-var", "folder", out, "-var", "t", "0.005", "-var", "Re", "10", "20", "-var", "lambdas",
         "1e3 1e4", "-var", "phis", "25 50"});
  for (const std::string Re : {"10", "20"})
    for (const std::string lambda : {"1e3", "1e4"})
      for (const std::string phi : {"25", "50"}) {
        const auto stem = out + "/Re" + Re + "-lambda" + lambda + "/channel-phi" + phi;
        EXPECT_TRUE(std::filesystem::exists(stem + ".restart.end")) << stem;
        std::ifstream log(stem + ".log");
        const std::string text((std::istreambuf_iterator<char>(log)), {});
        // rho U L / Re, and 2 (1 - nu^2) lambda rho_p U^2
        EXPECT_NE(text.find(Re == "10" ? "viscosity 6e-05\n" : "viscosity 3e-05\n"), text.npos);
        EXPECT_NE(text.find(lambda == "1e3" ? "jkr 1183000 0.3" : "jkr 11830000 0.3"), text.npos);
      }
  std::filesystem::remove_all(out);
}

TEST(Examples, humid_channel)
{
  EXPECT_EQ(verdict("channel", "channel.humid", {"-var", "t", "1"}), "pass");
}

TEST(Examples, wetpair)
{
  EXPECT_EQ(verdict("wetpair", "wetpair", {}), "pass");
}
