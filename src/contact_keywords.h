// The words that name a contact law, the same after pair_coeff I J and in fix wall/levelset:
//   jkr E nu gamma [keyword values] | material FILE NAME [keyword values]
// Liquid bridges:
//   bridge l sigma theta mu [hmin]  form contact|film  capillary maugis|willett  tangential yes|no
//   wet_gamma x A_i A_j A_f  inventory f [even|origin]

#ifndef APF_CONTACT_KEYWORDS_H
#define APF_CONTACT_KEYWORDS_H

#include "contact/bridge.h"
#include "contact/contact_model.h"

#include <string>

namespace LAMMPS_NS {
class LAMMPS;

struct ContactCoeff {
  apf::Material material{};     // of both bodies
  apf::ContactModel model{};    // its surface is interface(material, material)

  apf::BridgeModel bridge{};    // liquid between the two; model.surface is that in the liquid

  // Two materials that no script line joins: surfaces by eq (16) and Berthelot; damping, friction,
  // rolling angle and its damping by geometric mean, as the numbers of the liquid but for the
  // contact angle, of whose cosine the mean is taken; a sub-model acts if both have it.
  static ContactCoeff mixed(const ContactCoeff &i, const ContactCoeff &j);

  // false for numbers that no words give: a restart file is damaged
  bool sound() const;

  // the words again, for data files
  std::string words() const;
};

// all keywords, for errors
constexpr const char *contact_keywords =
    "damping, sliding, twisting, rolling, break, scale_stiffness, bridge, form, capillary, "
    "tangential, wet_gamma, inventory";

bool is_contact_keyword(const char *word);

// Parses arg[iarg..narg) up to the first word it does not know, which iarg then points at.
//   command    names the command in errors, as in "Pair granular/adhesive"
//   offset     added to an argument's index in errors: words of the input line before arg[0]
ContactCoeff parse_contact(LAMMPS *lmp, const char *command, int narg, char **arg, int &iarg,
                           int offset);

}    // namespace LAMMPS_NS

#endif
