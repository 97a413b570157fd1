// Commands of APF with words that nobody should write, each in a child process of its own; it must
// be refused by a message that says what is wrong, or run two steps that give numbers. Where one
// word took the place of another, the message must hold it, and the keyword that it belongs to.
// Crashes, hangs, huge allocations and mute refusals are failures. Particles that fly away from
// forces that are numbers are counted apart: LAMMPS says that it lost them, which says nothing of
// the command.
//
// Half of the commands that name a file of a wall or a flow are right, but the numbers in the file
// are not: then the message must name the file.
//
//   fuzz_commands NUMBER [SEED] [TEXT]    TEXT: only commands with it; prints all messages

#include "child.h"
#include "commands.h"
#include "input_folder.h"
#include "simulation.h"
#include "spoil.h"
#include "spoilt_grids.h"

#include "comm.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <set>

namespace {

using fuzz::Outcome;

const std::string not_finite = "accepted, and a particle's numbers are not finite";

std::string not_a_number(Simulation &sim)
{
  const auto *atom = sim.lammps()->atom;
  for (int i = 0; i < atom->nlocal; i++)
    for (const double *three :
         {atom->x[i], atom->v[i], atom->f[i], atom->omega[i], atom->torque[i]})
      for (int c = 0; c < 3; c++)
        if (!std::isfinite(three[c])) return not_finite;
  return {};
}

const std::string flew_away = "particles are lost", in_run = "in the run: ";

Outcome outcome_of(Simulation &sim, const std::string &command, const std::string &after)
{
  try {
    std::string error = sim.error_of(command + "\n" + after);
    if (!error.empty()) return {Outcome::REFUSED, error};
    for (const char *run : {"run 0 post no", "run 2 post no"}) {
      error = sim.error_of(run);
      for (const char *flight : {"Lost atoms", "Non-numeric atom coords", "Non-numeric pressure"})
        if (error.find(flight) != std::string::npos) return {Outcome::ACCEPTED, flew_away};
      if (!error.empty()) return {Outcome::REFUSED, in_run + error};
      error = not_a_number(sim);
      if (!error.empty()) return {Outcome::FAILED, error};
    }
    return {Outcome::ACCEPTED, ""};
  } catch (std::exception &exception) {
    return {Outcome::FAILED, std::string("exception ") + exception.what()};
  }
}

Outcome try_command(Simulation &sim, const std::string &command, const std::string &after)
{
  const auto work = [&](int out) {
    const auto outcome = outcome_of(sim, command, after);
    const std::string report = std::to_string(outcome.kind) + outcome.text.substr(0, 4000);
    return write(out, report.data(), report.size()) > 0 ? 0 : 1;
  };
  const auto ended = fuzz::in_child(work, 20, rlim_t(4) << 30);
  if (!ended.death.empty()) return {Outcome::FAILED, ended.death};
  if (ended.text.empty()) return {Outcome::FAILED, "exit without a word"};
  return {static_cast<Outcome::Kind>(ended.text[0] - '0'), ended.text.substr(1)};
}

std::string lower(std::string text)
{
  for (auto &c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

// keywords and choices of the right commands
const std::set<std::string> &keywords()
{
  static const std::set<std::string> all = [] {
    std::set<std::string> found;
    for (const auto &one : fuzz::commands) {
      const auto words = fuzz::split(one.command);
      for (std::size_t k = one.keep; k < words.size(); k++)
        if (std::isalpha(static_cast<unsigned char>(words[k][0])) && words[k].size() > 2)
          found.insert(lower(words[k]));
    }
    return found;
  }();
  return all;
}

// A word of a message without the marks around it.
std::string bare(std::string word)
{
  while (!word.empty() && std::strchr("'\":;,()[]", word.back())) word.pop_back();
  while (!word.empty() && std::strchr("'\"([", word.front())) word.erase(0, 1);
  return word;
}

// What is wrong stands behind the name of the style: a word of the command or a keyword, what
// something must be, that words are missing or something is not there. Words that any sentence may
// have do not count, unless they are pointed at.
bool says_what_is_wrong(const std::string &message, const std::string &command)
{
  std::string reason = lower(message.substr(0, message.find('\n')));
  reason.resize(std::min(reason.size(), reason.rfind(" (src/")));
  for (const std::string name : fuzz::names)
    // at the beginning: elsewhere it may be a word of the command
    if (const auto at = reason.find(name); at < in_run.size() + std::strlen("error: X")) {
      reason.erase(at, name.size());
      break;
    }
  for (const char *fact : {"missing", "does not exist", "out of bounds", "takes no arguments",
                           "coeffs are not set", "overlap by", "pair style  in", "cannot be opened",
                           "without a pair style", "unmatched double quote"})
    if (reason.find(fact) != std::string::npos) return true;

  auto words = fuzz::split(lower(command));
  for (auto &word : words) word = bare(word);
  static const std::set<std::string> common = {"all",  "compute", "error", "file",  "fix",
                                               "none", "number",  "pair",  "style", "the"};
  const auto named = [&](const std::string &word) {
    return keywords().count(word) || std::find(words.begin() + 1, words.end(), word) != words.end();
  };
  std::string before;    // the word before, with what stands behind it
  for (const auto &whole : fuzz::split(reason)) {
    const std::string word = bare(whole);
    const bool after_a_word = !before.empty() && before != "error:" && before != ":";
    const bool pointed_at = before == "got" || before == "keyword" || before == "style" ||
        whole.front() == '\'' || whole.back() == ':' || (after_a_word && before.back() == ':');
    if (whole != "error:" && (named(word) || named(whole)) &&
        (pointed_at || (word.size() > 2 && !common.count(word))))
      return true;
    if (whole == "''" || (word == "must" && after_a_word)) return true;    // what must be
    before = whole;
  }
  return before == "got" || before == "keyword";    // an empty word
}

// A message holds a word as it is, or as a number that is equal in the digits that are printed.
bool holds(const std::string &message, const std::string &word)
{
  if (bare(word).empty() || (word.size() > 2 && message.find(word) != std::string::npos))
    return true;
  char *end;
  const double value = std::strtod(word.c_str(), &end);
  const bool is_number = !*end;
  for (const auto &one : fuzz::split(message)) {
    const auto printed = bare(one);
    if (one == word || printed == bare(word)) return true;
    const double other = std::strtod(printed.c_str(), &end);
    if (printed.empty() || *end || !is_number) continue;
    if (other == value || std::fabs(other - value) <= 1e-3 * std::fabs(value)) return true;
  }
  return false;
}

// The keyword that a word of a command belongs to, and the one before, of which this may be a
// choice: the two nearest. None for what comes before all keywords.
std::vector<std::string> keywords_of(const std::string &command, std::size_t at, std::size_t keep)
{
  const auto words = fuzz::split(command);
  static const std::set<std::string> values = {"yes", "no", "NULL", "air", "cloud"};
  std::vector<std::string> found;
  while (at-- > keep && found.size() < 2)
    if (words[at].size() > 2 && std::isalpha(static_cast<unsigned char>(words[at][0])) &&
        !values.count(words[at]) && words[at].compare(0, 2, "v_") != 0 &&
        words[at].compare(0, 9, "distance_") != 0 && words[at].find('.') == std::string::npos)
      found.push_back(lower(words[at]));
  return found;
}

// A word that is right by itself may make a later one wrong, as a count of those that follow.
bool blames_a_later_word(const std::string &text, const std::string &command, std::size_t at)
{
  const auto words = fuzz::split(lower(command));
  std::string before;
  for (const auto &one : fuzz::split(text)) {
    const auto word = bare(one);
    if ((before == "got" || before == "keyword") &&
        std::find(words.begin() + at + 1, words.end(), word) != words.end())
      return true;
    before = one;
  }
  return false;
}

// What a refusal of a command that differs from a right one in one word must hold: that word or,
// if it is in the place of a keyword, this one, which may be what is missing now; and the keyword
// that it belongs to, or what its values are called. Empty if it does.
std::string lacks(const std::string &message, const std::string &right, std::size_t keep,
                  const fuzz::Change &change)
{
  const std::string text = lower(message.substr(0, message.find('\n')));
  // LAMMPS reads the words of fix_modify and ranges of types
  if (right.compare(0, 11, "fix_modify ") == 0) return {};
  if (blames_a_later_word(text, right, change.at)) return {};
  for (const char *fact : {"missing argument", "out of bounds", "without a pair style"})
    if (text.find(fact) != std::string::npos) return {};
  const bool is_keyword = keywords().count(lower(change.was)) > 0;
  if (!holds(text, lower(change.is)) && !(is_keyword && holds(text, lower(change.was))))
    return "the word '" + change.is + "'";
  // where an optional number became a keyword
  if (text.find("keyword " + lower(change.is) + " is given twice") != std::string::npos) return {};
  const auto belongs_to = keywords_of(right, change.at, keep);
  if (is_keyword || belongs_to.empty()) return {};
  for (const auto &keyword : belongs_to) {
    if (text.find(keyword) != std::string::npos) return {};
    for (const auto &value : fuzz::called)
      if (keyword == value.keyword && text.find(value.as) != std::string::npos) return {};
  }
  return "the keyword '" + belongs_to.front() + "'";
}

// that the rules above can refuse
void check_rule()
{
  const std::string command = "fix wall all wall/levelset plane y 0 8 jkr 1e6 0.3 10 sliding -1";
  for (const char *mute : {"ERROR: Fix wall/levelset: error (src/a.cpp:1)",
                           "ERROR: Fix wall/levelset must be > 0 (src/a.cpp:1)",
                           "ERROR: Fix wall/levelset: must be > 0 (src/a.cpp:1)",
                           "ERROR: Lost atoms: original 4 current 3 (src/thermo.cpp:496)",
                           "ERROR: Pair granular/adhesive: all is wrong", "ERROR: 8 1 y x"})
    fuzz::require(!says_what_is_wrong(mute, command), mute);
  for (const char *right :
       {"ERROR: Fix wall/levelset sliding mu must be >= 0, got -1 (src/a.cpp:1)",
        "ERROR: Unknown compute pair keyword 8 (src/compute_pair.cpp:1)",
        "ERROR: Illegal fix wall/levelset sliding command: missing argument(s) (src/a.cpp:1)",
        "ERROR: Unrecognized fix style 'y' (src/modify.cpp:1)", "ERROR: Unknown keyword: 1e6"})
    fuzz::require(says_what_is_wrong(right, command), right);

  const fuzz::Change sliding = {true, 12, "0.3", "-1"}, E = {true, 8, "1e6", "1e31"},
                     keyword = {true, 11, "sliding", "rolling"};
  const std::string good = "fix wall all wall/levelset plane y 0 8 1e6 0.3 10 sliding 0.3";
  const auto complaint = [&](const std::string &message, const fuzz::Change &change) {
    return lacks(message, good, 4, change);
  };
  for (const char *mute : {"ERROR: Fix wall/levelset sliding mu must be >= 0",
                           "ERROR: Fix wall/levelset mu must be >= 0, got -1"})
    fuzz::require(!complaint(mute, sliding).empty(), mute);
  const char *right = "ERROR: Fix wall/levelset sliding mu must be >= 0, got -1";
  fuzz::require(complaint(right, sliding).empty(), right);
  right = "ERROR: Fix wall/levelset plane must be <= 1e+30, got 10000000000000000000000000000000";
  fuzz::require(complaint(right, E).empty(), right);
  right = "ERROR: Fix wall/levelset keyword jkr is given twice";
  fuzz::require(complaint(right, {true, 12, "0.3", "jkr"}).empty(), right);
  right = "ERROR: Fix wall/levelset requires keyword sliding";
  fuzz::require(complaint(right, keyword).empty(), right);
}

// What is done about a file with wrong numbers: particles may be lost in a flow that is too fast.
Outcome try_spoilt(Simulation &sim, const fuzz::SpoiltGrids::Spoilt &spoilt)
{
  const std::string forces = "fix drag all flow/force air drag stokes torque yes lift saffman "
                             "magnus yes added_mass yes pressure yes";
  auto outcome = try_command(sim, spoilt.command, spoilt.is_wall ? "" : forces);
  if (outcome.kind == Outcome::REFUSED && outcome.text.find("spoilt.vtkhdf") == std::string::npos)
    return {Outcome::FAILED, "does not name the file: " + outcome.text};
  if (outcome.kind == Outcome::ACCEPTED && spoilt.wrong)
    return {Outcome::FAILED, "should be refused, " + outcome.text};
  if (outcome.kind == Outcome::ACCEPTED && spoilt.is_wall && !outcome.text.empty())
    return {Outcome::FAILED, "at a wall " + outcome.text};
  return outcome;
}

double largest_number(const std::string &command)
{
  double largest = 0.0;
  for (const auto &word : fuzz::split(command))
    largest = std::max(largest, std::fabs(std::strtod(word.c_str(), nullptr)));
  return largest;    // what is no number counts by its beginning
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
  check_rule();
  const fuzz::InputFolder folder;
  folder.enter();
  fuzz::write_grids();
  std::vector<std::string> all;
  for (const auto &one : fuzz::commands) all.push_back(one.command);
  fuzz::Mutator mutator(seed, all);
  fuzz::SpoiltGrids spoiler(seed);
  int lost = 0, count[3] = {};
  std::map<std::string, int> messages;
  const int each = std::max<int>(1, number / std::size(fuzz::commands));
  for (const auto &one : fuzz::commands) {
    if (one.command.find(only) == std::string::npos) continue;
    Simulation sim;
    sim.run(fuzz::scene + one.before);
    for (int n = 0; n <= each; n++) {
      fuzz::Change change;
      const bool in_file = n % 2 && fuzz::SpoiltGrids::can(one.command);
      fuzz::SpoiltGrids::Spoilt spoilt;
      if (in_file) spoilt = spoiler.write(one.command);
      const std::string command = in_file ? spoilt.command + "  # file: " + spoilt.what
          : n                             ? mutator.mutate(one.command, one.keep, &change)
                                          : one.command;
      if (largest_number(command) > one.most) continue;
      Outcome outcome = in_file ? try_spoilt(sim, spoilt) : try_command(sim, command, one.after);
      if (n == 0 && (outcome.kind != Outcome::ACCEPTED || !outcome.text.empty()))
        outcome = {Outcome::FAILED, "should be right: " + outcome.text};
      else if (outcome.kind == Outcome::REFUSED && one.ours && !in_file) {
        if (!says_what_is_wrong(outcome.text, command))
          outcome = {Outcome::FAILED, "does not say what is wrong: " + outcome.text};
        else if (change.is_one && outcome.text.compare(0, in_run.size(), in_run) != 0)
          if (const auto what = lacks(outcome.text, one.command, one.keep, change); !what.empty())
            outcome = {Outcome::FAILED, "does not hold " + what + ": " + outcome.text};
      }
      // LAMMPS takes any step and skin; those up to the right one must give numbers
      if (!one.ours && largest_number(command) > largest_number(one.command) &&
          outcome.text.compare(0, not_finite.size(), not_finite) == 0)
        outcome = {Outcome::ACCEPTED, flew_away};
      count[outcome.kind]++;
      lost += outcome.kind == Outcome::ACCEPTED && outcome.text == flew_away;
      if (outcome.kind == Outcome::REFUSED) messages[kind_of(outcome.text)]++;
      if (outcome.kind == Outcome::FAILED)
        printf("FAILED %s\n  %s\n", command.substr(0, 400).c_str(), outcome.text.c_str());
    }
  }
  if (!only.empty())
    for (const auto &message : messages) printf("%6d %s\n", message.second, message.first.c_str());
  printf("%d commands: %d accepted (%d lose particles), %d refused with %d kinds of messages, "
         "%d failures (seed %u)\n",
         count[0] + count[1] + count[2], count[Outcome::ACCEPTED], lost, count[Outcome::REFUSED],
         static_cast<int>(messages.size()), count[Outcome::FAILED], seed);
  MPI_Finalize();
  return count[Outcome::FAILED] ? 1 : 0;
}
