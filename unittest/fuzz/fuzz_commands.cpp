// Commands of APF with words that nobody should write, each in a child process of its own; it must
// be refused by a message that says what is wrong, or run two steps that give numbers. Crashes,
// hangs, huge allocations and mute refusals are failures.
//
//   fuzz_commands NUMBER [SEED] [TEXT]    TEXT: only commands with it; prints all messages

#include "child.h"
#include "commands.h"
#include "input_folder.h"
#include "simulation.h"
#include "spoil.h"

#include "comm.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <map>

namespace {

using fuzz::Outcome;

std::string not_a_number(Simulation &sim)
{
  const auto *atom = sim.lammps()->atom;
  for (int i = 0; i < atom->nlocal; i++)
    for (const double *three :
         {atom->x[i], atom->v[i], atom->f[i], atom->omega[i], atom->torque[i]})
      for (int c = 0; c < 3; c++)
        if (!std::isfinite(three[c])) return "accepted, and a particle's numbers are not finite";
  return {};
}

Outcome outcome_of(Simulation &sim, const std::string &command)
{
  try {
    std::string error = sim.error_of(command);
    if (error.empty()) error = sim.error_of("run 2 post no");
    if (!error.empty()) return {Outcome::REFUSED, error};
    const std::string bad = not_a_number(sim);
    return {bad.empty() ? Outcome::ACCEPTED : Outcome::FAILED, bad};
  } catch (std::exception &exception) {
    return {Outcome::FAILED, std::string("exception ") + exception.what()};
  }
}

Outcome try_command(Simulation &sim, const std::string &command)
{
  const auto work = [&](int out) {
    const auto outcome = outcome_of(sim, command);
    const std::string report = std::to_string(outcome.kind) + outcome.text.substr(0, 4000);
    return write(out, report.data(), report.size()) > 0 ? 0 : 1;
  };
  const auto ended = fuzz::in_child(work, 20, rlim_t(4) << 30);
  if (!ended.death.empty()) return {Outcome::FAILED, ended.death};
  if (ended.text.empty()) return {Outcome::FAILED, "exit without a word"};
  return {static_cast<Outcome::Kind>(ended.text[0] - '0'), ended.text.substr(1)};
}

// A refusal names the command or style, or a word of the command that LAMMPS itself refuses.
bool says_what_is_wrong(const std::string &message, const std::string &command)
{
  auto lower = [](std::string text) {
    for (auto &c : text) c = static_cast<char>(std::tolower(c));
    return text;
  };
  const std::string text = lower(message), line = lower(command);
  for (const char *name : fuzz::names)
    if (text.find(name) != std::string::npos) return true;
  for (const auto &word : fuzz::split(line))
    if (text.find("'" + word + "'") != std::string::npos ||
        text.find(" " + word) != std::string::npos)
      return true;
  return false;
}

// messages that differ in numbers and quoted words only are one
std::string kind_of(const std::string &message)
{
  std::string kind;
  for (const char c : message.substr(0, message.find('\n')))
    if (!std::isdigit(static_cast<unsigned char>(c)) || kind.empty() || kind.back() != '#')
      kind += std::isdigit(static_cast<unsigned char>(c)) ? '#' : c;
  return kind.substr(0, 160);
}

}    // namespace

int main(int argc, char **argv)
{
  MPI_Init(&argc, &argv);
  const int number = argc > 1 ? std::atoi(argv[1]) : 1000;
  const unsigned seed = argc > 2 ? std::atoi(argv[2]) : 1;
  const std::string only = argc > 3 ? argv[3] : "";
  const fuzz::InputFolder folder;
  folder.enter();
  fuzz::write_grids();
  std::vector<std::string> all;
  for (const auto &one : fuzz::commands) all.push_back(one.command);
  fuzz::Mutator mutator(seed, all);
  int tried = 0, count[3] = {};
  std::map<std::string, int> messages;
  const int each = std::max<int>(1, number / std::size(fuzz::commands));
  for (const auto &one : fuzz::commands) {
    if (one.command.find(only) == std::string::npos) continue;
    Simulation sim;
    sim.run(fuzz::scene + one.before);
    for (int n = 0; n <= each; n++, tried++) {
      const std::string command = n ? mutator.mutate(one.command, one.keep) : one.command;
      Outcome outcome = try_command(sim, command);
      if (n == 0 && outcome.kind != Outcome::ACCEPTED)
        outcome = {Outcome::FAILED, "should be right: " + outcome.text};
      else if (outcome.kind == Outcome::REFUSED && !says_what_is_wrong(outcome.text, command))
        outcome = {Outcome::FAILED, "does not say what is wrong: " + outcome.text};
      count[outcome.kind]++;
      if (outcome.kind == Outcome::REFUSED) messages[kind_of(outcome.text)]++;
      if (outcome.kind == Outcome::FAILED)
        printf("FAILED %s\n  %s\n", command.substr(0, 400).c_str(), outcome.text.c_str());
    }
  }
  if (!only.empty())
    for (const auto &message : messages) printf("%6d %s\n", message.second, message.first.c_str());
  printf("%d commands: %d accepted, %d refused with %d kinds of messages, %d failures (seed %u)\n",
         tried, count[Outcome::ACCEPTED], count[Outcome::REFUSED], int(messages.size()),
         count[Outcome::FAILED], seed);
  MPI_Finalize();
  return count[Outcome::FAILED] ? 1 : 0;
}
