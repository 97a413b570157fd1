// Commands of APF with words that nobody should write: replaced, dropped, doubled, cut, absurd.
// Each is tried in a child process of its own; it must be refused by a message that says what is
// wrong, or run two steps that give numbers. Crashes, hangs, huge allocations and mute refusals
// are failures.
//
//   fuzz_commands NUMBER [SEED] [TEXT] TEXT: only commands with it; prints all messages

#include "commands.h"
#include "simulation.h"

#include "comm.h"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <random>

namespace {

using Words = std::vector<std::string>;

Words split(const std::string &line)
{
  std::istringstream input(line);
  Words words;
  for (std::string word; input >> word;) words.push_back(word);
  return words;
}

std::string join(const Words &words)
{
  std::string line;
  for (const auto &word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

// ---------------------------------------------------------------------- mutations

class Mutator {
 public:
  explicit Mutator(unsigned seed) : random(seed)
  {
    for (const auto &one : fuzz::commands)
      for (const auto &word : split(one.command)) dictionary.push_back(word);
    std::sort(dictionary.begin(), dictionary.end());
    dictionary.erase(std::unique(dictionary.begin(), dictionary.end()), dictionary.end());
  }

  // `keep` words at the beginning say which command it is
  std::string mutate(const std::string &command, std::size_t keep)
  {
    Words words = split(command);
    for (std::size_t n = below(3) ? 1 : 2 + below(2); n > 0; n--) {
      const std::size_t at = keep + below(words.size() - std::min(keep, words.size()) + 1);
      if (at >= words.size()) {
        words.push_back(any_word());
        continue;
      }
      switch (below(8)) {
        case 0:
          words.erase(words.begin() + at);
          break;
        case 1:
          words.insert(words.begin() + at, any_word());
          break;
        case 2:
          words.insert(words.begin() + at, words[at]);
          break;
        case 3:
          std::swap(words[at], words[keep + below(words.size() - keep)]);
          break;
        case 4:
          words[at] = damaged(words[at]);
          break;
        case 5:
          if (below(3) == 0) words.resize(at);
          break;
        default:
          words[at] = any_word();
      }
    }
    return join(words);
  }

 private:
  std::mt19937 random;
  Words dictionary;

  std::size_t below(std::size_t n) { return random() % n; }

  std::string any_word()
  {
    static const Words absurd = {"nan",
                                 "inf",
                                 "-inf",
                                 "1e308",
                                 "-1e308",
                                 "1e-308",
                                 "1e400",
                                 "0",
                                 "-0.0",
                                 "-1",
                                 "1",
                                 "2",
                                 "1e-5",
                                 "0.5",
                                 "1e10",
                                 "1000000",
                                 "2147483647",
                                 "2147483648",
                                 "-2147483648",
                                 "9223372036854775807",
                                 "99999999999999999999",
                                 "NULL",
                                 "\"\"",
                                 "v_none",
                                 "v_zero",
                                 "c_none",
                                 "f_none",
                                 "%s%n%d",
                                 "{}",
                                 "{0}",
                                 "*",
                                 "1*2",
                                 "/",
                                 ".",
                                 "../none",
                                 "yes",
                                 "no"};
    switch (below(20)) {
      case 0:
        return std::string(300, 'x');
      case 1:
        return std::to_string(static_cast<int>(random()));
      case 2:
      case 3:
      case 4:
      case 5:
      case 6:
        return dictionary[below(dictionary.size())];
      default:
        return absurd[below(absurd.size())];
    }
  }

  std::string damaged(std::string word)
  {
    const std::size_t at = below(word.size());
    const char other = "0123456789-+.eExyz*_/ "[below(21)];
    if (below(2))
      word[at] = other;
    else
      word.insert(at, 1, other);
    return word;
  }
};

// ---------------------------------------------------------------------- one input

struct Outcome {
  enum Kind { ACCEPTED, REFUSED, FAILED } kind;
  std::string text;
};

constexpr char accepted = 'a', refused = 'r', failed = 'f';

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

[[noreturn]] void try_in_child(Simulation &sim, const std::string &command, int out)
{
  const rlimit memory = {rlim_t(4) << 30, rlim_t(4) << 30};
  setrlimit(RLIMIT_AS, &memory);
  alarm(20);
  std::string report;
  try {
    std::string error = sim.error_of(command);
    if (error.empty()) error = sim.error_of("run 2 post no");
    if (!error.empty())
      report = refused + error;
    else {
      const std::string bad = not_a_number(sim);
      report = bad.empty() ? std::string(1, accepted) : failed + bad;
    }
  } catch (std::exception &exception) {
    report = failed + std::string("exception ") + exception.what();
  }
  report.resize(std::min<std::size_t>(report.size(), 4000));
  const auto written = write(out, report.data(), report.size());
  _exit(written > 0 ? 0 : 1);
}

Outcome try_command(Simulation &sim, const std::string &command)
{
  int ends[2];
  if (pipe(ends) != 0) return {Outcome::FAILED, "no pipe"};
  const pid_t child = fork();
  if (child == 0) {
    close(ends[0]);
    try_in_child(sim, command, ends[1]);
  }
  close(ends[1]);
  std::string report;
  char part[4096];
  for (ssize_t n; (n = read(ends[0], part, sizeof(part))) > 0;) report.append(part, n);
  close(ends[0]);
  int status;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status))
    return {Outcome::FAILED,
            WTERMSIG(status) == SIGALRM ? "hang: over 20 s"
                                        : std::string("crash: ") + strsignal(WTERMSIG(status))};
  if (report.empty()) return {Outcome::FAILED, "exit without a word"};
  const std::string text = report.substr(1);
  if (report[0] == failed) return {Outcome::FAILED, text};
  return {report[0] == accepted ? Outcome::ACCEPTED : Outcome::REFUSED, text};
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
  for (const auto &word : split(line))
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
  Mutator mutator(seed);
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
