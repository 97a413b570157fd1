// Wet spheres for the tests of liquid bridges, and the report's formulas for their bridges.

#ifndef APF_TEST_WET_SPHERES_H
#define APF_TEST_WET_SPHERES_H

#include "scenes.h"

#include <functional>

inline const std::string elastic = "jkr 1.0e7 0.25 0.0 ";

inline std::string granular(const std::string &law)
{
  return "pair_style granular/adhesive\npair_coeff * *" + std::string(" ") + law + "\n";
}

// Bridge of two equal spheres of diameter and density 1, computed here from the report's formulas.
struct Liquid {
  double l = 0.01, sigma = 50.0, theta = 20.0, mu = 0.0, hmin = 1.0e-3;
  double R = 0.25, m = pi / 12.0;

  std::string words() const
  {
    return "bridge " + digits(l) + " " + digits(sigma) + " " + digits(theta) + " " + digits(mu) +
        " " + digits(hmin) + " ";
  }
  double V() const { return l * pi / 6.0; }
  double angle() const { return theta * pi / 180.0; }
  double H(double h) const
  {
    h = std::max(h, hmin * R);
    return 1.0 - 1.0 / std::sqrt(1.0 + V() / (pi * R * h * h));
  }
  double pull(double h) const { return 4.0 * pi * R * sigma * std::cos(angle()) * H(h); }
  double rupture(double Ca = 0.0) const
  {
    return (1.0 + 0.5 * angle()) * (1.0 + std::sqrt(Ca)) * std::cbrt(V());
  }
  double k() const { return 6.0 * pi * mu * R * R; }
  // of f over [a, b], a > 0
  static double integral(double a, double b, const std::function<double(double)> &f)
  {
    const int n = 20000;
    double sum = 0.0;
    for (int q = 0; q < n; q++) {
      const double h0 = a * std::pow(b / a, double(q) / n);
      const double h1 = a * std::pow(b / a, double(q + 1) / n);
      sum += (h1 - h0) * f(std::sqrt(h0 * h1));
    }
    return sum;
  }
  double work() const    // from contact to rupture at rest
  {
    const double h = hmin * R;
    return h * pull(0.0) + work(h);
  }
  double work(double from) const    // from > h_min
  {
    return integral(from, rupture(), [this](double x) {
      return pull(x);
    });
  }
  double film_gap() const { return std::cbrt(1.0 + l) - 1.0; }    // where the films of both touch
  double viscous_momentum(double from, double to) const
  {
    return k() * integral(from, to, [this](double x) {
             return H(x) * H(x) / x;
           });
  }
};

// Head-on collision at the speed v; returns the speed of separation, < 0 while they are bound.
inline double rebound(const std::string &law, double v, double gap, const std::string &integrate,
                      double reach, int steps)
{
  Simulation sim;
  Scene scene;
  scene.style = granular(law);
  build(sim, {{4.0 - 0.5 * (1.0 + gap), 4.0, 4.0}, {4.0 + 0.5 * (1.0 + gap), 4.0, 4.0}}, scene);
  set_motion(sim, 1, {0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {-0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("neighbor 1.0 bin\n" + integrate + "run " + std::to_string(steps));
  if (sim.value("x[2]-x[1]") < 1.0 + reach) return -1.0;
  return sim.value("vx[2]-vx[1]");
}

inline std::string verlet(double step)
{
  return "fix nve all nve/sphere\ntimestep " + digits(step) + "\n";
}

// column of compute b for an atom that this rank owns
inline double of_atom(Simulation &sim, int id, int column)
{
  auto **rows = static_cast<double **>(
      lammps_extract_compute(sim.lammps(), "b", LMP_STYLE_ATOM, LMP_TYPE_ARRAY));
  return rows[sim.lammps()->atom->map(id)][column - 1];
}

#endif
