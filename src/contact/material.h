// What a user says of a material, and how two of them meet.

#ifndef APF_MATERIAL_H
#define APF_MATERIAL_H

#include "jkr.h"

namespace apf {

struct Material {
  double E;        // Young's modulus                                   [pressure]
  double nu;       // Poisson's ratio                                   [-]
  double gamma;    // surface energy, per surface                       [energy/length^2]

  double shear_modulus() const { return E / (2.0 * (1.0 + nu)); }
};

// Two materials in contact, eq (16): 1/E = sum (1-nu^2)/E_k, 1/G = sum (2-nu)/G_k.
// The surface energy is the geometric mean (Berthelot), so the work of adhesion 2 gamma is
// 2 sqrt(gamma_i gamma_j).
struct Interface {
  double E;        // effective Young's modulus                         [pressure]
  double G;        // effective shear modulus                           [pressure]
  double gamma;    // surface energy per surface                        [energy/length^2]
};

inline Interface interface(const Material &i, const Material &j)
{
  return {1.0 / ((1.0 - i.nu * i.nu) / i.E + (1.0 - j.nu * j.nu) / j.E),
          1.0 / ((2.0 - i.nu) / i.shear_modulus() + (2.0 - j.nu) / j.shear_modulus()),
          std::sqrt(i.gamma * j.gamma)};
}

}    // namespace apf

#endif
