// Forces and torques of a fluid on particles.

#ifdef FIX_CLASS
// clang-format off
FixStyle(flow/force,FixFlowForce);
// clang-format on
#else

#ifndef LMP_FIX_FLOW_FORCE_H
#define LMP_FIX_FLOW_FORCE_H

#include "fix_per_grid.h"
#include "flow_feedback.h"
#include "run_guard.h"

#include "flow/fluid_forces.h"
#include "flow/lane_rows.h"
#include "timestep/sub_step.h"

#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixFlowForce : public FixPerGrid {
 public:
  FixFlowForce(class LAMMPS *, int, char **);
  ~FixFlowForce() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_force(int) override;
  void post_force_respa(int, int, int) override;
  void post_run() override;
  void reset_grid() override;

  double compute_vector(int) override;
  double memory_usage() override;

  const apf::FluidModel &fluid_model() const { return model; }

  // Takes the last drag and torque on local atom i out of its acceleration, and puts the rates and
  // velocities of relaxation there instead.
  void relax(int i, apf::Slow &) const;
  // part of any force on local atom i that moves it; the rest moves fluid with it (added mass)
  double share(int i) const;
  // How far a force that acts on particle i in steps of that length moves it in one, over how far
  // it would without this drag; 1 if the drag acts in other steps.
  double mobility(int i, double in_steps_of) const;

 private:
  static constexpr const char *command = "Fix flow/force";

  RunGuard guard;
  std::string field_id;
  class FixFlowField *field = nullptr;
  apf::FluidModel model;
  double concentration = -1.0;     // volume fraction of particles; < 0: none given
  std::string concentration_id;    // of the fix that knows it, or
  class FixFlowConcentration *cloud = nullptr;
  std::unique_ptr<FlowFeedback> feedback;
  std::vector<int> columns;    // forces of the per-atom array after drag and torque

  int ilevel_respa = 0;
  const class FixNVESphereMTS *sub_stepper = nullptr;
  double part = 1.0;    // of a step for which the forces act: half of it at setup
  bool warned = false;
  bool per_atom = true;    // forces are kept for output
  int nmax = 0;

  // a block of particles on its way through the forces
  struct Block {
    int atom[apf::block_width];    // their local indices, ascending
    bool together;                 // one after another
    apf::PointBlock points;
    apf::FluidBlock fluid;
    apf::ForceBlock forces;
  };
  std::unique_ptr<Block> block;
  apf::FluidForces fluid_forces;
  apf::LaneRows rows;
  std::vector<const apf::Lanes *> outputs;    // what the columns of the per-atom array are

  struct Relaxation {    // what relax() adds
    apf::Vec3 a{}, alpha{};
    double rate = 0.0, spin_rate = 0.0, share = 1.0;
  };
  std::vector<Relaxation> relaxations;    // of local atoms, where contacts are sub-stepped

  // sums over the group: of each force, of all that was added to f, of what the grid got
  static constexpr int n_sums = 3 * (apf::n_fluid_forces + 2);
  double parts[n_sums][apf::sum_parts], total_all[n_sums];    // each in parts
  bool summed = false;

  // fix_flow_force_input.cpp
  void parse(int narg, char **arg);
  int parse_drag(int iarg, int narg, char **arg);
  int parse_switch(int iarg, int narg, char **arg);
  int parse_lift(int iarg, int narg, char **arg);
  int parse_gravity(int iarg, int narg, char **arg);
  int parse_brownian(int iarg, int narg, char **arg);
  int parse_cunningham(int iarg, int narg, char **arg);
  int parse_concentration(int iarg, int narg, char **arg);
  int parse_feedback(int iarg, int narg, char **arg);
  class FixFlowConcentration *find_concentration(int iarg);
  class FixFlowField *find_field(int iarg);
  void check_particles();
  void warn_of_second_drag();
  bool adds_forces(class Fix *) const;
  void warn_of_later_forces();
  void check_other_fixes();
  bool shares_atoms(int bit) const;
  void warn_of_ranges();

  CellGrid *grid_of(int) override { return feedback ? &feedback->grid : nullptr; }
  void choose_outputs();
  void grow_output();
  double step() const;
  double stokes_rate(double d, double mass) const;    // 1/tau of a sphere                [1/time]
  void for_blocks(const std::function<void()> &act);

  // fix_flow_force_block.cpp
  int gather(int first, double whole, double sub);
  int choose(int first);
  void scatter();
  void take_rows(double **from, apf::Lanes (&to)[3]) const;
  void add_rows(const apf::Lanes (&from)[3], double **to) const;
  void put_rows(double **to) const;
  void add_up();
  void keep_relaxation();
  void react();
  void tally();
};

}    // namespace LAMMPS_NS

#endif
#endif
