#ifdef FIX_CLASS
// clang-format off
FixStyle(wall/levelset,FixWallLevelset);
// clang-format on
#else

#ifndef LMP_FIX_WALL_LEVELSET_H
#define LMP_FIX_WALL_LEVELSET_H

#include "fix_contacts.h"

#include "contact/contact_kernel.h"
#include "contact_checks.h"
#include "contact_keywords.h"
#include "wall_bridges.h"
#include "wall_ledger.h"
#include "wall_motion.h"
#include "wall_surfaces.h"

#include "wall/clearances.h"

#include <memory>

namespace LAMMPS_NS {

class FixWallLevelset : public FixContacts {
 public:
  FixWallLevelset(class LAMMPS *, int, char **);
  ~FixWallLevelset() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void reset_dt() override;
  void min_setup(int) override;
  void post_force(int) override;
  void post_force_respa(int, int, int) override;
  void min_post_force(int) override;
  void post_neighbor() override;
  double compute_scalar() override;
  double compute_vector(int) override;
  double compute_array(int, int) override;
  void *extract(const char *, int &) override;
  int image(int *&, double **&) override;
  double memory_usage() override;

  bool slides() const override { return coefficient.model.sliding(); }
  void include_walls(apf::VelocityRange &, double time) const override;
  void find_fastest(apf::LookAhead &) override;
  void find_approaching(apf::LookAhead &) override;
  bool find_near(apf::LookAhead &) override;
  void sub_step(const apf::ContactTimes &) override;
  void pin(apf::Islands &) const override;
  double distance(const double *x) const;    // > 0 in the fluid; of the nearest surface
  double contacts_here() const override { return contacts.size(); }
  void find_stiffest(apf::Stiffest &) override;
  void settle_bridges() override;

  // ---- for apf_advise and the checks of a run's start: the contact of a sphere at one surface
  const std::vector<apf::Surface> &all_surfaces() const { return surfaces; }
  const ContactCoeff &contact_coeff() const { return coefficient; }
  double linear_speed() const { return motion.fastest(0.0); }    // of a wall that moves
  bool varies() const { return motion.varies(); }                // by variables
  static apf::ContactBodies bodies_at(const apf::Surface &, double radius, double mass);

  // ---- for compute wall/deposit
  WallLedger &zones() { return ledger; }
  std::vector<WallTouch> touches();
  double distance(const double *x, Marks of_surfaces) const;    // of the nearest of these
  double reach(Marks of_surfaces) const;                        // up to which it is known
  // of all particles; nullptr if the pair style keeps no contacts
  class ComputeAggregateContact *all_aggregates() { return aggregates.get(); }

 protected:
  void store_contacts() override;
  void before_storing() override;
  void add_counts(double *) override;
  int level() const override;
  std::vector<double> global_state() const override;
  void set_global_state(class RestartState &) override;

 private:
  static constexpr const char *command = "Fix wall/levelset";
  std::vector<apf::Surface> surfaces;
  std::unique_ptr<WallGrid> grid;    // where surfaces come from a file
  std::string of_file() const;       // for errors: its name, if there is one
  WallMotion motion;
  double resolution = 0.05;    // error of a gridded distance in units of delta_C
  TimestepCheck timestep;
  double overlap_at_rest = 0.0;    // of the smallest particle, in units of its radius
  double checked_for[4] = {};      // radii, error, reach of bridges that the grid is good for
  ContactCoeff coefficient;
  apf::KernelChoice choice;
  apf::ContactKernel kernel;

  // One contact = one particle at one surface. Rows 2k and 2k+1 of `rows` are a copy of the
  // particle and its foot point on the wall, a body without radius.
  apf::ContactList contacts;
  std::vector<int> surface_of;       // surface of each contact; its atom is contacts.source
  std::vector<double> turning_of;    // of each contact: how its normal turns, see ContactBodies
  std::vector<unsigned> touched;     // per atom: bit s set if it is in contact with surface s
  apf::Clearances clearances;        // per atom, of the surfaces that it does not touch
  apf::Bodies rows;
  struct Near {
    int i, surface;
  };
  std::vector<Near> near;    // particles that may touch within the present particle step
  struct Perhaps {
    int i, surface;
    double gap;
  };
  std::vector<Perhaps> perhaps;    // ... if another strikes them

  WallBridges bridges;
  bool wet = false;    // the wall has bridges
  friend class WallBridges;

  bool rebuild = true;
  class FixContactHistory *lender = nullptr;    // has the particles' rows already: pair's fix
  class Fix *rigid = nullptr;
  double captured = 0.0, detached = 0.0;            // contacts begun and ended, of this rank
  WallLedger ledger{lmp, surfaces, motion.pose};    // force and torque on zones of the wall
  static constexpr int n_loads = 12, n_bridge_loads = 7;
  std::vector<int> extensive;        // extlist
  double all_loads[n_loads] = {};    // the same over all ranks, contacts, begun, ended, bridges,
                                     // liquid
  double all_bridge_loads[n_bridge_loads] = {};    // capillary, viscous, energy
  bool loads_summed = false, bridge_loads_summed = false, settled = false;
  std::unique_ptr<ComputeAggregateContact> aggregates;
  std::vector<int> count_of_atom;    // for other styles: contacts of each atom
  std::unique_ptr<WallImage> drawn;

  double bridge_load(int n);
  apf::Bodies &particles();
  void find_again();
  void detect();
  void look_around(int i, const double *y);
  void check_passage(int i, double step);
  double step_now() const;    // of the last forces
  int frozen = 0;             // bits of groups that fix freeze holds
  void touch(int i, int surface, bool foreseen);
  const double *in_frame(const double *x, double *y) const;
  apf::Foot foot_of(int surface, const double *x, double *kappa = nullptr) const;
  bool farther(int surface, const double *x, double than) const;
  bool far_from_all(int i, double than) const;
  struct Nearest {
    int surface;
    double distance;
  };
  Nearest nearest(const double *x, Marks of_surfaces) const;
  void parse_keywords(const std::vector<std::string> &surface_names, int narg, char **arg,
                      int iarg);
  void check_particles();
  void check_places();
  void warn_of_same_walls();
  bool shares_atoms(const Fix *other) const;
  void check_lists();    // before contacts are told of; called by all ranks
  void check_borders(double largest);
  void warn_of_borders(const apf::Surface &cylinder, double largest);
  void check_reach(double smallest);
  void check_grid(double smallest, double largest);
  double speed_near(const double *x) const;          // of the wall, if it reached there
  double speed_of(int i, const apf::LookAhead &);    // of an atom, as LookAhead has it
  apf::Approach approach_of(int i, const apf::Foot &);
  void close(int i, int surface, const apf::ContactHistory &);
  apf::ContactBodies bodies_of(int i, int surface) const;
  apf::ContactBodies bodies_of(int i, int surface, const double *x) const;
  double crowding(int i) const;
  void share_masses();
  bigint shared_at[2] = {-1,
                         -1};    // changes here and counts of the lender when masses were shared
  void remove_ended(bool in_sub_step);
  int zone_of(int i, int surface);
  Marks zones_of(int i);
  void gather(bool follow = false);
  void turn_on(int k, double turning);
  void copy_rows(apf::Bodies &, int k, int i, int surface);
  void copy_rows(apf::Bodies &, int k, int i, const apf::Foot &);
  int add_forces(const apf::ContactTimes &, int made);
  void add_due();
  void return_loads(const apf::Bodies &, const std::vector<int> &atoms);
  void tally(const apf::Bodies &, const std::vector<int> &atoms, const std::vector<int> &surfaces);
};

}    // namespace LAMMPS_NS

#endif
#endif
