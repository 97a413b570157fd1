// Code that is built for several instruction sets is chosen for the processor it runs on: one
// binary is fast everywhere. A build is a struct with a name, "baseline", "avx2" or "avx512", and
// functions.

#ifndef APF_INSTRUCTION_SET_H
#define APF_INSTRUCTION_SET_H

#include <string>
#include <vector>

namespace apf {

// whether this processor has the instruction set
bool can_run(const std::string &name);

// The best one, or the one that the environment variable APF_ISA names.
const std::string &chosen_instruction_set();

// those that this processor can run, in the order given
template <class Build> std::vector<Build> runnable(const std::vector<Build> &builds)
{
  std::vector<Build> list;
  for (const auto &build : builds)
    if (can_run(build.name)) list.push_back(build);
  return list;
}

template <class Build> const Build &chosen(const std::vector<Build> &builds)
{
  for (const auto &build : builds)
    if (build.name == chosen_instruction_set()) return build;
  return builds.front();
}

}    // namespace apf

#endif
