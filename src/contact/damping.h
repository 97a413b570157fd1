// Normal damping force eta v with eta = alpha sqrt(m (4/3) E a), IIHR Report 459, eqs (22), (23);
// m is the effective mass m_i m_j / (m_i + m_j).

#ifndef APF_DAMPING_H
#define APF_DAMPING_H

#include "vector.h"

namespace apf {

// alpha that gives Hertz's contact the coefficient of restitution e in (0,1], at every speed, mass
// and stiffness: exact for contact from overlap 0 to overlap 0 (Antypov and Elliott,
// doi:10.1209/0295-5075/94/50004). The sixth-order polynomial often used instead presumes the mass
// of one of two equal particles and is sqrt(2) too small with the effective mass.
inline double damping_from_restitution(double e)
{
  const double log_e = std::log(e);
  return -std::sqrt(5.0) * log_e / std::sqrt(pi * pi + log_e * log_e);
}

}    // namespace apf

#endif
