// Head-on impacts and the steps that follow them, for C3 and C4 of the list of hard cases.

#ifndef APF_TEST_IMPACTS_H
#define APF_TEST_IMPACTS_H

#include "integrators.h"

#include <algorithm>

// A head-on impact at unit speed of spheres of diameter and density 1, or of one with a wall,
// without damping: what the law makes of it, in leapfrog steps of its own.
struct Impact {
  JkrCurve curve;
  double m, sticking = 0.0;    // V_s
  double deepest = 0.0, until_deepest = 0.0, duration = 0.0;

  // lambda = E; the speed is so many times V_s, 0: no adhesion
  Impact(double lambda, bool at_wall, double ratio) :
      curve{at_wall ? 0.5 : 0.25, lambda, 0.0}, m(at_wall ? pi / 6.0 : pi / 12.0)
  {
    if (ratio > 0.0) {    // V_s goes with gamma^(5/6)
      curve.gamma = 1.0;
      sticking = 1.0 / ratio;
      curve.gamma = std::pow(sticking / Scale(curve, m).V_s, 1.2);
    }
    const double hertz = 2.9432751 * std::pow(15.0 * m / (16.0 * lambda * std::sqrt(curve.R)), 0.4),
                 h = hertz / 4000.0, end = ratio > 0.0 ? -curve.delta_C() : 0.0;
    double delta = 0.5 * h, w = 1.0;    // places are half a step ahead of velocities
    for (; delta > end; duration += h) {
      w -= h * curve.force(delta) / m;
      delta += h * w;
      if (w > 0.0) until_deepest += h;
      deepest = std::max(deepest, delta);
    }
  }
  bool at_wall() const { return curve.R == 0.5; }
  std::string law() const
  {
    return " jkr " + digits(2.0 * curve.E * (1.0 - 0.0625)) + " 0.25 " + digits(curve.gamma) + " ";
  }
  double energy_after() const { return 1.0 - sticking * sticking; }    // over that before
};

// Particle steps and the collision steps in each of them; under velocity Verlet there are only
// these.
struct Steps {
  Integrator integrator;
  double particle, collision;
  int each;

  Steps(const std::string &name, double particle, double finest) :
      particle(particle), each(static_cast<int>(std::ceil(particle / finest)))
  {
    collision = particle / each;
    integrator = {name, name == "verlet" ? 1 : each};
  }
  std::string commands(double skin) const
  {
    return integrator.commands(collision) + "neighbor " + digits(skin) +
        " bin\nneigh_modify delay 0 every 1\n";
  }
  std::string run(int particle_steps) const { return integrator.run(particle_steps * each); }
};

#endif
