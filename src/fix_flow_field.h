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
#include "flow/grid_flow.h"
#include "run_guard.h"

#include <memory>
#include <string>

namespace LAMMPS_NS {

class FixFlowField : public Fix {
 public:
  FixFlowField(class LAMMPS *, int, char **);
  ~FixFlowField() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_pre_force(int) override;
  void setup_pre_force_respa(int, int) override;
  void pre_force(int) override;
  void pre_force_respa(int, int, int) override;
  double compute_vector(int) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  double memory_usage() override;

  double density;      // of the fluid                                 [mass/length^3]
  double viscosity;    // dynamic                                      [pressure time]

  // What will be sampled; all ranks call it, in init() of who samples. acts: on particles, which
  // some fix must do, or a warning follows.
  void require(apf::Detail, bool acts = true);

  // Fluid at a block of points, as it is at the current step.
  void sample(const apf::PointBlock &points, apf::Detail detail, apf::FluidBlock &out) const
  {
    if (grid) {
      if (!gridded.sample(points, detail, out) && !clamp) outside(points);
      return;
    }
    apf::sample(flow, points, detail, out);
    if (varies && detail == apf::Detail::GRADIENT) apf::sample_velocity(change, points, out.rate);
  }

  // whether the flow changes in time
  bool unsteady() const { return varies; }

  // Signed distance to the walls, > 0 in the fluid, where the flow knows it; sample() gives it too.
  bool has_distance() const;
  void distance(const apf::PointBlock &points, apf::Lanes &out) const;

 private:
  static constexpr const char *command = "Fix flow/field";

  // a number, or an equal-style variable that is evaluated each fluid step
  struct Speed {
    double value = 0.0;
    double rate = 0.0;    // d/dt, over the last fluid step
    std::string variable;
    int index = -1;
  };

  RunGuard guard;
  apf::FlowField flow, change;             // and du/dt: the flow whose speeds are the rates
  std::unique_ptr<class FlowGrid> grid;    // where the flow is that of a file,
  apf::GridFlow gridded;                   // as it is now
  bool clamp = false;                      // outside the grid its border goes on
  Speed speed[3];                          // umax | rate | the three components of uniform flow
  bool varies;
  bool taken = false;     // somebody will sample the flow in this run
  bool warned = false;    // that nobody does
  bool begins = false;    // nothing has been evaluated in this run yet
  static constexpr bigint never = -1000000000;
  bigint evaluated;       // time step of the variables' values
  double evaluated_at;    // and their time; not a number if there are none yet
  int every = 1;          // time steps of a fluid step

  // fix_flow_field_input.cpp
  int parse_kind(int narg, char **arg);
  int parse_channel(char **arg);
  int parse_pipe(char **arg);
  int parse_uniform(char **arg);
  int parse_shear(char **arg);
  void parse_file(int narg, char **arg);
  int parse_property(int iarg, int narg, char **arg);
  int axis(char **arg, int iarg);
  Speed parse_speed(int iarg, char **arg, const char *what);

  double time() const;
  void find_variables();
  void evaluate();
  void evaluate_variables();
  void set_speed(apf::FlowField &, double Speed::*) const;
  [[noreturn]] void outside(const apf::PointBlock &points) const;
  std::string border_left(const double *x) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
