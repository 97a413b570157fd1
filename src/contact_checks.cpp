#include "contact_checks.h"

#include "comm.h"
#include "error.h"

#include <cmath>

namespace LAMMPS_NS {

void check_overlap(LAMMPS *lmp, const std::string &who, const apf::ContactModel &model, double R,
                   double smaller_radius)
{
  constexpr double much = 0.05, too_much = 0.5;
  if (!model.adhesive()) return;
  const double ratio = model.normal(R).equilibrium_overlap() / smaller_radius;
  if (ratio <= much) return;
  // overlap / r ~ (gamma/E)^(2/3)
  const std::string message = fmt::format("{}: at rest they overlap by {:.3g} of the smaller "
                                          "radius; a Young's modulus E {:.3g} times as "
                                          "large makes it {}",
                                          who, ratio, std::pow(ratio / much, 1.5), much);
  if (ratio > too_much)
    lmp->error->all(FLERR, Error::NOLASTLINE, "{}; above {} the contact law has no meaning",
                    message, too_much);
  if (lmp->comm->me == 0) lmp->error->warning(FLERR, message);
}

void check_timestep(LAMMPS *lmp, const std::string &who, const apf::StiffestMode &mode, double dt)
{
  const double kappa = mode.frequency * dt;
  if (kappa <= apf::largest_stable_kappa || lmp->comm->me != 0) return;
  lmp->error->warning(
      FLERR,
      "{}: timestep {:.4g} is too large for the {} mode of a contact, omega dt = {:.3g}; "
      "above {} dense packings are unstable; {:.3g} gives {}",
      who, dt, mode.name, kappa, apf::largest_stable_kappa, apf::accurate_kappa / mode.frequency,
      apf::accurate_kappa);
}

}    // namespace LAMMPS_NS
