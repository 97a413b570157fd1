// Particles enter with the fluid through a plane, and leave through another.

#ifdef FIX_CLASS
// clang-format off
FixStyle(inlet/flow,FixInletFlow);
// clang-format on
#else

#ifndef LMP_FIX_INLET_FLOW_H
#define LMP_FIX_INLET_FLOW_H

#include "fix.h"
#include "known_walls.h"
#include "run_guard.h"

#include "flow/diameter_law.h"
#include "flow/inlet_flux.h"
#include "flow/sphere_grid.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

// Every rank draws the same numbers and knows all particles near the plane, so that all decide the
// same, whatever their number.

class FixInletFlow : public Fix {
 public:
  FixInletFlow(class LAMMPS *, int, char **);
  ~FixInletFlow() override;
  int setmask() override;
  void init() override;
  void setup(int) override;
  void post_integrate() override;
  void post_integrate_respa(int, int) override;
  void pre_exchange() override;
  void post_run() override;
  double compute_vector(int) override;
  void *extract(const char *, int &) override;
  void write_restart(FILE *) override;
  void restart(char *) override;

 private:
  static constexpr const char *command = "Fix inlet/flow";

  RunGuard guard;

  struct Particle {
    double x[3], radius;
    apf::Vec3 v, omega;
  };
  struct Outlet {
    int dim;
    double sign, position;
  };
  // what a restart goes on from; the same on all ranks
  struct State {
    double owed = 0.0;    // volume due and not entered yet; a number with keyword number
    double next = 0.0;    // diameter of the particle that enters next
    double inserted = 0.0, refused = 0.0, mass = 0.0, volume = 0.0;
    double asked = 0.0;      // volume
    double elapsed = 0.0;    // time
    double left = 0.0, left_mass = 0.0;
    double newest = 0.0;    // highest atom ID given
    double random[103] = {};
  };

  // as the script has it
  std::string field_id;
  int dim;
  double sign, position;
  double window[2][2];    // lo, hi along the two other axes; NAN where it is the box's
  double concentration = 0.0, number = 0.0;
  int every = 1, type = 0, attempts = 100, seed = 0;
  double density = 0.0, gap = 0.0;
  apf::DiameterLaw diameters = apf::OneDiameter{0.0};    // none yet
  std::vector<Outlet> outlets;

  State state;
  std::unique_ptr<class RanMars> random;
  class FixFlowField *field = nullptr;
  KnownWalls walls;
  std::vector<Fix *> keepers;    // of contacts
  apf::InletFlux inflow;
  bool refuses = false;      // the last insertion ended at a particle without a place
  double extracted = 0.0;    // for extract()

  void parse(int narg, char **arg);
  int parse_number(int iarg, int narg, char **arg);
  int parse_window(int iarg, int narg, char **arg);
  int parse_diameter(int iarg, int narg, char **arg);
  int parse_lognormal(int iarg, int narg, char **arg);
  int parse_list(int iarg, int narg, char **arg);
  int parse_outlet(int iarg, int narg, char **arg);
  int parse_axis(int iarg, char **arg, const char *what, double &direction);
  double positive(int iarg, char **arg, const char *what);
  void check_order(int iarg, char **arg, const char *law, double lo, double hi);
  void check_required() const;
  apf::InletPlane rectangle() const;
  void check_plane() const;
  void warn_of_equal_seeds();
  void measure();
  double uniform();
  double draw_diameter();
  double smallest() const;
  double largest() const;
  double size(double diameter) const;
  double share(double diameter) const;
  double mean_size() const;
  double travel() const;
  void remove_left();
  void insert();
  apf::SphereGrid near_plane();
  bool place(Particle &, const apf::SphereGrid &);
  bool fits(const double *entry, const Particle &) const;
  apf::Vec3 fluid_at(const double *x, apf::Vec3 *spin) const;
  bool is_mine(const double *x) const;
  void create(const Particle &, tagint id);
  void forget_ghosts();
  void renew_map();
};

}    // namespace LAMMPS_NS

#endif
#endif
