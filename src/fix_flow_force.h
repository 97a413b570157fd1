// Forces and torques of a fluid on particles.

#ifdef FIX_CLASS
// clang-format off
FixStyle(flow/force,FixFlowForce);
// clang-format on
#else

#ifndef LMP_FIX_FLOW_FORCE_H
#define LMP_FIX_FLOW_FORCE_H

#include "fix.h"

#include "contact/vector.h"
#include "timestep/sub_step.h"

#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixFlowForce : public Fix {
 public:
  FixFlowForce(class LAMMPS *, int, char **);
  ~FixFlowForce() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  void post_force_respa(int, int, int) override;
  double compute_vector(int) override;
  double memory_usage() override;

  // Takes the last drag and torque on local atom i out of its acceleration, and puts the rates and
  // velocities of relaxation there instead.
  void relax(int i, apf::Slow &) const;

 private:
  enum class Drag { NONE, STOKES, SCHILLER };

  std::string field_id;
  class FixFlowField *field;
  Drag drag;
  bool torque;
  apf::Vec3 gravity;    // acceleration, without buoyancy               [length/time^2]

  int ilevel_respa;
  const class FixNVESphereMTS *sub_stepper = nullptr;
  double share;    // part of a step for which the forces act: half of it at setup
  int nmax;
  std::vector<apf::Vec3> velocity, vorticity;    // of the fluid at the particles
  struct Relaxation {                            // what relax() adds
    apf::Vec3 a{}, alpha{};
    double rate = 0.0, spin_rate = 0.0;
  };
  std::vector<Relaxation> relaxations;    // of local atoms, where contacts are sub-stepped
  double total[6], total_all[6];          // drag 3, gravity 3, over the group
  bool summed;

  int parse_drag(int iarg, int narg, char **arg);
  int parse_torque(int iarg, int narg, char **arg);
  int parse_gravity(int iarg, int narg, char **arg);
  class FixFlowField *find_field(int iarg);
  void check_particles();
  double step() const;
  void gather();
  template <class Law, bool SPIN> void add_forces();
  void tally(int i, const apf::Vec3 &force);
};

}    // namespace LAMMPS_NS

#endif
#endif
