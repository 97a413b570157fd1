// Where in a command the error of it points.

#ifndef APF_TEST_POINTS_AT_H
#define APF_TEST_POINTS_AT_H

#include <string>

// whether the error, which shows the command and underlines a word of it, does so at its last
// `word`
inline bool points_at_last(const std::string &error, const std::string &word)
{
  const size_t mark = error.find('^');
  if (mark == std::string::npos) return false;
  const size_t below = error.rfind('\n', mark) + 1, line = error.rfind('\n', below - 2) + 1;
  return error.substr(line, below - line).rfind(word) == mark - below;
}

#endif
