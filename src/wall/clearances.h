// How far particles are from the surfaces of a wall at least, as the last look at each tells: a
// distance changes by no more than its steepest slopes times the way along the axes. So a particle
// that touches nothing costs a few subtractions in a step, however many surfaces there are, until
// it has come so far that it may touch one.

#ifndef APF_CLEARANCES_H
#define APF_CLEARANCES_H

#include "surface.h"

#include <limits>
#include <vector>

namespace apf {

class Clearances {
 public:
  void include(const Surface &surface)
  {
    const auto of_one = surface.steepness();
    for (int c = 0; c < 3; c++) steepest[c] = std::max(steepest[c], of_one[c]);
  }

  void resize(int particles)
  {
    if (particles > static_cast<int>(looks.size())) looks.resize(particles);
  }
  void forget_all() { std::fill(looks.begin(), looks.end(), Look()); }
  void forget(int i) { looks[i] = Look(); }
  // distance: of the nearest surface, or less                                        [length]
  void note(int i, const double *x, double distance) { looks[i] = {{x[0], x[1], x[2]}, distance}; }

  // bound of the distance of particle i, which is at x now; far below 0 if it was not looked at
  double at_least(int i, const double *x) const
  {
    const Look &last = looks[i];
    double way = 0.0;
    for (int c = 0; c < 3; c++) way += steepest[c] * std::fabs(x[c] - last.x[c]);
    return last.distance - way;
  }

  double memory_usage() const { return looks.capacity() * sizeof(Look); }

 private:
  struct Look {
    double x[3] = {0.0, 0.0, 0.0};
    double distance = -std::numeric_limits<double>::max();
  };
  std::vector<Look> looks;
  GridDistance::PerAxis steepest{};
};

}    // namespace apf

#endif
