// A fluid's velocity field, density and viscosity, for the fixes that act on particles.

#ifdef FIX_CLASS
// clang-format off
FixStyle(flow/field,FixFlowField);
// clang-format on
#else

#ifndef LMP_FIX_FLOW_FIELD_H
#define LMP_FIX_FLOW_FIELD_H

#include "fix.h"

#include "flow/flow_field.h"

#include <string>

namespace LAMMPS_NS {

class FixFlowField : public Fix {
 public:
  FixFlowField(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup_pre_force(int) override;
  void setup_pre_force_respa(int, int) override;
  void pre_force(int) override;
  void pre_force_respa(int, int, int) override;
  double compute_vector(int) override;

  double density;      // of the fluid                                 [mass/length^3]
  double viscosity;    // dynamic                                      [pressure time]

  // Fluid at a block of points, as it is at the current step.
  void sample(const apf::PointBlock &points, apf::Detail detail, apf::FluidBlock &out) const
  {
    apf::sample(flow, points, detail, out);
  }

 private:
  // a number, or an equal-style variable that is evaluated each step
  struct Speed {
    double value = 0.0;
    std::string variable;
    int index = -1;
  };

  apf::FlowField flow;
  Speed speed[3];    // umax | rate | the three components of uniform flow
  bool varies;
  bigint evaluated;    // time step of the variables' values

  int parse_kind(int narg, char **arg);
  int parse_channel(char **arg);
  int parse_pipe(char **arg);
  int parse_uniform(char **arg);
  int parse_shear(char **arg);
  int axis(const char *word, int iarg);
  Speed parse_speed(const char *word);
  void evaluate();
  void set_speed();
};

}    // namespace LAMMPS_NS

#endif
#endif
