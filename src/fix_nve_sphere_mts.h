// Time integration of spheres with contacts sub-stepped.

#ifdef FIX_CLASS
// clang-format off
FixStyle(nve/sphere/mts,FixNVESphereMTS);
// clang-format on
#else

#ifndef LMP_FIX_NVE_SPHERE_MTS_H
#define LMP_FIX_NVE_SPHERE_MTS_H

#include "fix.h"

#include "contact/islands.h"
#include "contact/stiffness.h"
#include "particle_look_ahead.h"
#include "run_guard.h"
#include "timestep/sub_step.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// LAMMPS's timestep is the particle step. Particles that touch, or may touch within it, take part
// in collision steps, all inside initial_integrate(); the forces of the last one are those that
// LAMMPS computes as ever, so that other commands see contacts, forces and velocities as they are
// at the end of the step.

class FixNVESphereMTS : public Fix {
 public:
  FixNVESphereMTS(class LAMMPS *, int, char **);
  ~FixNVESphereMTS() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void setup_post_neighbor() override { post_neighbor(); }
  void post_neighbor() override;
  void setup_pre_neighbor() override { pre_neighbor(); }
  void pre_neighbor() override;
  void setup_pre_exchange() override { pre_exchange(); }
  void pre_exchange() override;
  void initial_integrate(int) override;
  void final_integrate() override;
  void post_run() override;
  double compute_vector(int) override;
  void *extract(const char *, int &) override;
  double memory_usage() override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  void write_restart(FILE *) override;
  void restart(char *) override;
  int pack_forward_comm(int n, int *list, double *buf, int, int *) override
  {
    return foresight.pack_forward(n, list, buf);
  }
  void unpack_forward_comm(int n, int first, double *buf) override
  {
    foresight.unpack_forward(n, first, buf);
  }
  int pack_reverse_comm(int n, int first, double *buf) override
  {
    return foresight.pack_reverse(n, first, buf);
  }
  void unpack_reverse_comm(int n, int *list, double *buf) override
  {
    foresight.unpack_reverse(n, list, buf);
  }

  // time between two force computations of contacts, and of the kicks that atom i gets
  double collision_step() const;
  double step_of(int i) const;
  bool steps(int i) const { return activity[i] != apf::FREE; }    // in the last particle step
  // no more than what a contact may get; one that nobody foresaw has not been asked
  double largest_step(const apf::StiffestMode &) const;
  int fixed_number() const { return fixed_steps; }    // of collision steps; 0: chosen in each step

 private:
  static constexpr const char *command = "Fix nve/sphere/mts";
  static constexpr int too_many = 1000000;    // collision steps of a particle step

  // as the script has it
  int fixed_steps = 0;    // collision steps of a particle step; 0 = from the stiffest mode
  apf::StepRule rule;     // else: how fine it must be
  int fluid_every = 1;    // particle steps of a fluid step

  RunGuard guard;
  int n_collision = 1;           // collision steps of the present particle step
  std::vector<char> activity;    // of all atoms here: was sub-stepped in the last particle step
  std::vector<std::array<double, 6>> slow_before;    // accelerations that it began with
  ParticleLookAhead foresight;
  apf::Islands islands;    // of the present particle step, where there are several tiles
  class FixContactHistory *history = nullptr;
  std::vector<class FixContacts *> keepers;
  std::vector<class FixFlowForce *> fluids;
  int freeze_group_bit = 0;
  std::vector<imageint> image_before;    // where fix deform moves the box: before atoms are wrapped
  double tilts_before[3] = {};

  struct Totals {    // of a run, for the summary
    bigint particle_steps = 0, collision_steps = 0, atoms = 0, active = 0, late_before = 0,
           changes_before = 0;
    int fewest = 0, most = 0;
    double kappa = 0.0;         // largest omega times collision step
    double finest = 0.0;        // largest 1/step that was asked for, or would be
    const char *mode = "no";    // of the contact it comes from
  } run_totals;
  bigint all_collision_steps = 0, late_before_restart = 0;
  bigint active_now = 0, atoms_now = 0;    // sub-stepped and all, of the last particle step
  int substep_ghosts = 0;                  // see extract()
  double kappa_now = 0.0;
  double slow_largest = 0.0;    // acceleration of sub-stepped atoms here [velocity/time]

  void parse(int, char **);
  void go_with_box();
  void begin_totals();
  void find_slow_largest();
  void choose_steps();
  [[noreturn]] void refuse_steps(double n, const apf::Stiffest &here);    // too many; collective
  void fit_due();
  apf::Slow slow_of(int i, bool all = false) const;
  double contact_share(int i) const;
  void kick_atom(int i, double time);
  struct FreeMotion;
  void kick_free(const FreeMotion &, int i, double load_time);
  void end_slow_kicks();
  void sub_step_active();
  template <class Row> void sub_step_active();
  template <class Row>
  std::vector<apf::Kick<Row>> begin_steps(const std::vector<int> &moving, Row *rows);
  apf::ByTile form_tiles(std::vector<int> &moving, const std::vector<int> &held);
  void drift_free();
  bigint late_contacts() const;
  bigint total(bigint (FixContacts::*count)() const) const;
  double accurate_steps() const;
  std::string finest_step() const;
};

}    // namespace LAMMPS_NS

#endif
#endif
