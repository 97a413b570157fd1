// The damped impact of two bodies, from the first touch to the end of the neck, by Runge and Kutta.

#ifndef APF_TEST_DAMPED_IMPACT_H
#define APF_TEST_DAMPED_IMPACT_H

#include "scenes.h"

// e at the speed V, 0 where the bodies stay together; tau: of the drag of a fluid at rest
inline double damped_restitution(const JkrCurve &curve, double m_eff, double alpha, double V,
                                 double tau = INFINITY)
{
  const double h = std::sqrt(m_eff * curve.delta_C() / curve.F_C()) / 500.0;
  auto slope = [&](double delta, double w) {
    const double eta = alpha * std::sqrt(m_eff * 4.0 / 3.0 * curve.E * curve.a(delta));
    return -(curve.force(delta) + eta * w) / m_eff - w / tau;
  };
  double delta = 0.0, w = V;
  for (bool returns = false; delta > -curve.delta_C();) {
    const double a1 = slope(delta, w), w2 = w + 0.5 * h * a1;
    const double a2 = slope(delta + 0.5 * h * w, w2), w3 = w + 0.5 * h * a2;
    const double a3 = slope(delta + 0.5 * h * w2, w3), w4 = w + h * a3;
    const double a4 = slope(delta + h * w3, w4);
    delta += h / 6.0 * (w + 2.0 * w2 + 2.0 * w3 + w4);
    w += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
    if (returns && w > 0.0) return 0.0;
    returns = w < 0.0;
  }
  return -w / V;
}

#endif
