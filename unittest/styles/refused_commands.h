// A scene in which commands are refused, and where in a command its error points.

#ifndef APF_TEST_REFUSED_COMMANDS_H
#define APF_TEST_REFUSED_COMMANDS_H

#include <string>

inline const std::string sphere_in_air = R"(
units lj
atom_style sphere
comm_modify vel yes
boundary f p f
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 5 5 5
set group all diameter 1 density 1
fix air all flow/field uniform 1 0 0 density 1 viscosity 1
)";

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
