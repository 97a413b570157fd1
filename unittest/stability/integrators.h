// The three ways in which contacts are stepped, for scenes that are the same under each.

#ifndef APF_TEST_INTEGRATORS_H
#define APF_TEST_INTEGRATORS_H

#include "criterion.h"
#include "scenes.h"

#include <cstdlib>

struct Integrator {
  std::string name;
  int inner;    // collision steps in a particle step

  // collision steps of length `step`
  std::string commands(double step) const
  {
    if (name == "mts") return mts(inner, step);
    return "fix nve all nve/sphere\ntimestep " + digits(inner * step) +
        (name == "respa" ? "\nrun_style respa 2 " + std::to_string(inner) + " pair 1\n" : "\n");
  }
  // at least n collision steps
  std::string run(int n) const { return "run " + std::to_string((n + inner - 1) / inner) + "\n"; }
  std::string of(const std::string &criterion) const
  {
    std::string text = criterion;
    return text.replace(text.find('*'), 1, name);
  }
};
inline const std::vector<Integrator> integrators = {{"verlet", 1}, {"respa", 10}, {"mts", 10}};

// long runs for the table of the documentation, tools/cases --long; short ones for CI
inline int count(int in_short, int in_long)
{
  return std::getenv("APF_LONG") ? in_long : in_short;
}

// Undamped contact of two bodies: 1/T is about the frequency of the normal mode at rest, and an
// impact at some V_s lasts less than 20 T.
struct Scale {
  double T, V_s;

  Scale(const JkrCurve &curve, double m) :
      T(std::sqrt(m * curve.delta_C() / curve.F_C())),
      V_s(std::sqrt(2.0 * 0.935503 * curve.F_C() * curve.delta_C() / m))
  {
  }
};

#endif
