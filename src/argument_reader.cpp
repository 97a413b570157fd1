#include "argument_reader.h"

#include "error.h"
#include "fmt/format.h"
#include "utils.h"

#include <cstdlib>
#include <limits>

using namespace LAMMPS_NS;

std::string Range::words() const
{
  if (std::isinf(low)) return std::isinf(high) ? "" : fmt::format("<= {}", high);
  if (std::isinf(high)) return fmt::format("{} {}", with_low ? ">=" : ">", low);
  return fmt::format("in {}{}, {}]", with_low ? '[' : '(', low, high);
}

/* ---------------------------------------------------------------------- */

double ArgumentReader::number(int iarg, const std::string &name, const Range &range) const
{
  constexpr double largest = 1.0e30;    // products of a few numbers are finite yet
  if (!utils::is_double(arg[iarg])) refuse(iarg, name, "a number " + range.words());
  return in_range(iarg, name, range, largest);
}

int ArgumentReader::integer(int iarg, const std::string &name, const Range &range) const
{
  if (!utils::is_integer(arg[iarg])) refuse(iarg, name, "an integer " + range.words());
  return static_cast<int>(in_range(iarg, name, range, std::numeric_limits<int>::max()));
}

double ArgumentReader::in_range(int iarg, const std::string &name, const Range &range,
                                double largest) const
{
  constexpr double smallest = 1.0e-100;    // quotients are finite yet
  const double value = std::strtod(arg[iarg], nullptr);
  if (!range.holds(value)) refuse(iarg, name, range.words());
  if (value != 0.0 && std::fabs(value) < smallest)
    refuse(iarg, name,
           fmt::format("{}at least {} in size", range.holds(0.0) ? "0 or " : "", smallest));
  if (value > largest) refuse(iarg, name, fmt::format("<= {}", largest));
  if (value < -largest) refuse(iarg, name, fmt::format(">= {}", -largest));
  return value;
}

int ArgumentReader::choice(int iarg, const std::string &name,
                           std::initializer_list<const char *> words) const
{
  std::string all;
  int n = 0;
  for (const char *word : words) {
    if (word == std::string(arg[iarg])) return n;
    const bool last = ++n == static_cast<int>(words.size());
    all += (all.empty() ? "" : last ? " or " : ", ") + std::string(word);
  }
  refuse(iarg, name, all);
}

void ArgumentReader::refuse(int iarg, const std::string &name, const std::string &demand) const
{
  error->all(FLERR, offset + iarg, "{} {} must be {}, got {}", command, name, utils::trim(demand),
             arg[iarg]);
}
