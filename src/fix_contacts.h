#ifndef LMP_FIX_CONTACTS_H
#define LMP_FIX_CONTACTS_H

#include "fix.h"

#include "contact_store.h"
#include "synchronous_velocity.h"

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
  void post_integrate_respa(int, int) override;
  void pre_exchange() override;
  void min_pre_exchange() override { pre_exchange(); }
  void setup_post_neighbor() override { post_neighbor(); }
  void min_post_neighbor() override { post_neighbor(); }
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

 protected:
  ContactStore store;
  SynchronousVelocity velocities;
  bool outer_kick = false;    // an outer level of r-RESPA has kicked since the last forces

  virtual void store_contacts() = 0;
  virtual int level() const = 0;    // of r-RESPA, on which the contacts act

  // numbers of the fix itself in restart files; called on all ranks
  virtual std::vector<double> global_state() const { return {}; }
  virtual void set_global_state(const double *) {}

  // contacts of local atom i, with particles and walls, when the neighbour list was last built
  int stored_contacts(int i) const;

  void synchronize();              // velocities of local atoms at the time of the positions
  double step_of_level() const;    // time between two force computations

 private:
  std::vector<const FixContacts *> keepers;    // all fixes that own contacts, this one included
};

}    // namespace LAMMPS_NS

#endif
