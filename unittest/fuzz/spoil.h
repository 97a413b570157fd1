// Right commands spoilt by words that nobody should write: replaced, dropped, doubled, cut, absurd.

#ifndef APF_FUZZ_SPOIL_H
#define APF_FUZZ_SPOIL_H

#include <algorithm>
#include <cstddef>
#include <random>
#include <sstream>
#include <string>
#include <vector>

namespace fuzz {

using Words = std::vector<std::string>;

inline Words split(const std::string &line)
{
  std::istringstream input(line);
  Words words;
  for (std::string word; input >> word;) words.push_back(word);
  return words;
}

inline std::string join(const Words &words)
{
  std::string line;
  for (const auto &word : words) line += (line.empty() ? "" : " ") + word;
  return line;
}

// One word in the place of another one; not one if more was done to the command.
struct Change {
  bool is_one = false;
  std::size_t at = 0;
  std::string was, is;
};

class Mutator {
 public:
  // words of right commands are used in others, too
  Mutator(unsigned seed, const std::vector<std::string> &commands) : random(seed)
  {
    for (const auto &command : commands)
      for (const auto &word : split(command)) dictionary.push_back(word);
    std::sort(dictionary.begin(), dictionary.end());
    dictionary.erase(std::unique(dictionary.begin(), dictionary.end()), dictionary.end());
  }

  // `keep` words at the beginning say which command it is
  std::string mutate(const std::string &command, std::size_t keep, Change *change = nullptr)
  {
    const Words right = split(command);
    Words words = right;
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
    std::string line = join(words);
    if (change) *change = difference(right, split(line));
    return line;
  }

 private:
  std::mt19937 random;
  Words dictionary;

  static Change difference(const Words &right, const Words &words)
  {
    Change change;
    if (words.size() != right.size()) return change;
    int changes = 0;
    for (std::size_t k = 0; k < words.size(); k++) {
      if (words[k] == right[k]) continue;
      changes++;
      change = {true, k, right[k], words[k]};
    }
    change.is_one = changes == 1;
    return change;
  }

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

}    // namespace fuzz

#endif
