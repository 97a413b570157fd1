#ifndef LMP_FIX_CONTACTS_H
#define LMP_FIX_CONTACTS_H

#include "fix.h"

#include "atom_order.h"
#include "contact/contact_law.h"
#include "contact/islands.h"
#include "contact/jump.h"
#include "contact_store.h"
#include "run_guard.h"
#include "timestep/look_ahead.h"
#include "used_velocity.h"

#include <string>

namespace LAMMPS_NS {

// Common part of the fixes that own contacts (of particles with each other, or with walls): keeps
// histories and velocities with their atoms while these are exchanged, sorted, inserted, deleted or
// written to restart files. A derived class puts its contacts into `store` when asked, and finds
// them there again after the neighbour list was built.

class FixContacts : public Fix {
 public:
  FixContacts(class LAMMPS *, int, char **);
  ~FixContacts() override;
  int setmask() override;
  void init() override;
  void setup(int) override
  {
    guard.prepared();
    begins = false;
  }
  void pre_exchange() override;
  void min_pre_exchange() override { pre_exchange(); }
  void post_neighbor() override { order.note(atom); }
  void setup_post_neighbor() override { post_neighbor(); }
  void min_post_neighbor() override { post_neighbor(); }
  void initial_integrate(int) override;
  void post_run() override;
  void write_restart(FILE *) override;
  void restart(char *) override;

  void grow_arrays(int) override;
  void copy_arrays(int, int, int) override;
  void set_arrays(int) override;
  int pack_exchange(int, double *) override;
  int unpack_exchange(int, double *) override;
  int pack_restart(int, double *) override;
  void unpack_restart(int, int) override;
  int size_restart(int) override;
  int maxsize_restart() override;
  double memory_usage() override;

  static std::vector<FixContacts *> all_of(class Modify *);
  // Whether atoms have the numbers by which contacts know them: between runs commands may give them
  // others. Collective.
  static bool lists_hold(class LAMMPS *);
  void require_lists();    // an error where a run goes on without; collective

  bigint changes_so_far() const { return changes; }    // contacts made and ended
  void count_into(double *counts) { add_counts(counts); }

  // ---- sub-steps of a particle step, for fix nve/sphere/mts
  virtual bool slides() const = 0;    // has friction, which turns spin into speed
  // velocities of walls that particles here may touch within that time
  virtual void include_walls(apf::VelocityRange &, double /*time*/) const {}
  // the largest speed that contacts may bring about
  virtual void find_fastest(apf::LookAhead &) = 0;
  // bodies that touch or approach become active; the pairs that this brings about are remembered
  virtual void find_approaching(apf::LookAhead &) = 0;
  // the same for bodies that an active one may strike; returns whether there were such
  virtual bool find_near(apf::LookAhead &) = 0;
  virtual void find_stiffest(apf::Stiffest &) = 0;    // of those that touch or may touch
  // forces of all contacts onto the rows of the particles, which stand half a sub-step before the
  // positions; contacts are made and ended
  virtual void sub_step(const apf::ContactTimes &) = 0;
  // bodies whose contacts cannot take their sub-steps apart from the others
  virtual void pin(apf::Islands &) const {}
  // bridges formed since liquid was settled last get no more of it than there was
  virtual void settle_bridges() {}
  virtual double contacts_here() const = 0;      // of this rank; shared ones count by halves
  bigint late_so_far() const { return late; }    // unforeseen, or deeper than a step can bring them
  bool has_due() const { return !due.empty(); }
  std::vector<double> due_loads();    // [local and ghost atoms][3], those of owners; collective

 protected:
  ContactStore store;
  UsedVelocity velocities;

  // Part of the last loads that comes of contacts just made or ended. It is kept with the atoms
  // from run to run, since nothing else shows it there.
  std::vector<apf::DueLoad> due;
  void recall_due(const apf::ContactTimes &);    // of the forces that are to be computed
  // loads that other ranks have put on atoms of this one are added; [local and ghost atoms][3]
  virtual void collect_due(std::vector<double> &) {}

  void contacts_change()    // what the store holds is no longer the latest
  {
    stored = false;
    store.release();
  }
  void count_anew() { changes++; }    // a contact was made or has ended

  void register_with_atoms();    // last act of a derived class's constructor

  virtual void before_storing() {}    // collective
  virtual void store_contacts() = 0;
  virtual void add_counts(double *counts) = 0;          // contacts of each local and ghost atom
  virtual bool stores_alone() const { return true; }    // without communication
  virtual int level() const = 0;                        // of r-RESPA, on which the contacts act

  // numbers of the fix itself in restart files; called on all ranks
  virtual std::vector<double> global_state() const { return {}; }
  virtual void set_global_state(class RestartState &) {}

  // Takes the velocities for the forces of this step; returns the times that the kernel needs.
  // Collective at the first step of a run.
  const apf::ContactTimes &take_velocities();
  const apf::ContactTimes &times() const { return taken; }
  apf::ContactTimes last_times() const;    // to look at the same forces again
  double step_of_level() const;            // time between two force computations
  bool step_is_given() const;              // by the script, not chosen to suit the contacts

  // whether a body here takes part in the collision steps, where its contacts are looked for
  bool steps(int i) const;
  // takes note of a first touch that was not foreseen: of bodies that do not take part in collision
  // steps, or deeper than the approach can have brought it in one
  void note_touch(const apf::Approach &, double radius_sum, const apf::StiffestMode &,
                  bool foreseen);
  // Whether steps of a given length have to follow what happens between two looks: in a run, but
  // for its first forces, where no collision steps are taken and no fix nve/limit holds particles
  // back.
  bool follows_given_steps() const;
  // ... why they do not follow a contact that has just been made, with what would; nothing if they
  // do
  std::string fault_of_touch(const apf::Approach &, const apf::ContactList &, int k,
                             double step) const;
  // a step without drag that is as long for this contact
  double step_without_drag(const apf::ContactList &, int k, double step) const;
  // ", or fix nve/sphere/mts", where it can be used
  std::string or_collision_steps() const;
  // the timestep of the script that follows impacts at that speed
  double following_timestep(const apf::StiffestMode &, double speed) const;

  RunGuard guard;
  std::vector<const class FixFlowForce *> drags;
  bool limited = false;                  // by fix nve/limit
  std::vector<FixContacts *> keepers;    // all fixes that own contacts, this one included
  bigint changes = 0;                    // contacts made and ended so far

 private:
  const class FixNVESphereMTS *sub_stepper = nullptr;    // integrates contacts, or none does
  bigint late = 0;
  bool registered = false;
  AtomOrder order;
  AtomSizes sizes;              // when the last run ended
  AtomPlaces places;            // ...
  bool begins = false;          // the next step may be the first of a run without setup
  std::string name() const;     // for errors
  void require_unchanged();     // an error where a command has changed atoms or the box; collective
  bool comes_first() const;     // of keepers, and nothing has moved before it in a step
  bool run_ended = false;       // and no forces were computed since
  bool stored = true;           // no forces since contacts were stored
  apf::ContactTimes taken{};    // of the last forces

  int unpack(int i, const double *buf);
  virtual void share_velocities() {}    // with ghosts, where these have contacts
};

}    // namespace LAMMPS_NS

#endif
