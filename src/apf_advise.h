// Command apf_advise: time steps, dimensionless numbers and ranges of the scene as it is.

#ifdef COMMAND_CLASS
// clang-format off
CommandStyle(apf_advise,APFAdvise);
// clang-format on
#else

#ifndef LMP_APF_ADVISE_H
#define LMP_APF_ADVISE_H

#include "command.h"

#include "contact_keywords.h"
#include "timestep/scales.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class APFAdvise : public Command {
 public:
  APFAdvise(class LAMMPS *lmp) : Command(lmp) {}
  void command(int, char **) override;

 private:
  // What particles of a type are like, of the smallest and the largest.
  struct Size {
    int type;
    double radius, mass;

    double density() const { return mass / apf::sphere::volume(2.0 * radius); }
    double moment() const { return apf::sphere::moment_of_inertia(mass, 2.0 * radius); }
  };
  struct Fluid {    // largest values at the particles
    double speed = 0.0, slip = 0.0, vorticity = 0.0;
  };

  apf::SceneScales scene{};
  bool speed_given = false, length_given = false;
  std::vector<Size> sizes;
  std::vector<std::string> cures;    // what to change
  double finest = 0.0;               // collision step of the stiffest contact

  void parse(int narg, char **arg);
  void find_sizes();
  void find_motion(class FixFlowField *);
  void include_images(int i, apf::VelocityRange &) const;
  Fluid fluid_at_particles(class FixFlowField *) const;
  void find_length();
  void advise_contacts(class PairGranularAdhesive *);
  void advise_contact(const std::string &name, const ContactCoeff &, const apf::ContactBodies &,
                      const Size &smaller);
  void advise_steps();
  void advise_fluid(class FixFlowField *);
  void advise_ranges(class FixFlowField *, const Fluid &, double d);
  void say(const std::string &line) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
