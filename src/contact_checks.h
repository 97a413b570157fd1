// What a contact law demands of a scene, told before it runs.

#ifndef APF_CONTACT_CHECKS_H
#define APF_CONTACT_CHECKS_H

#include "contact/bridge.h"
#include "contact/stiffness.h"

#include <string>

namespace LAMMPS_NS {
class Fix;
class LAMMPS;

constexpr double much_overlap = 0.05;    // of the smaller radius: laws are made for small contacts

// Particles at rest that overlap by more than that, by their adhesion and the pull of a bridge:
// warning; by ten times as much: error.
//   who   begins the message, as in "Pair granular/adhesive types 1 2"
void check_overlap(LAMMPS *lmp, const std::string &who, const apf::WetContact &wet, double R,
                   double smaller_radius);

// An error in units where force is not mass times acceleration, or E no pressure.
void check_units(LAMMPS *lmp, const std::string &who);

// An error where time goes backwards: dashpots and sliders would drive what they damp.
void check_direction(LAMMPS *lmp, const std::string &who);

// Whether some fix holds particles together in bodies: fix nve/sphere/mts cannot move these.
bool has_rigid_bodies(LAMMPS *lmp);

// An error where fix deform with remap v gives images a wrong velocity: the rates that LAMMPS keeps
// of some of its styles lack the length of the box.
void check_box_rates(LAMMPS *lmp, const std::string &who);

// A warning where neigh_modify lets the neighbor list be older than one that shows all pairs that
// meet. For steps that do not have it built themselves.
void check_list_age(LAMMPS *lmp, const std::string &who);

// A warning where the step is too large for the stiffest mode, with the step that would do.
class TimestepCheck {
 public:
  void begin(LAMMPS *, const std::string &who, const apf::StiffestMode &, double dt);    // of a run
  void changed(LAMMPS *, double dt);    // within it, by fix dt/reset: one warning a run

 private:
  std::string who;
  apf::StiffestMode mode;
  bool told = true;
};

// Why a fix has no particles when a run begins, nor gets them from one that inserts: its group is
// empty. Nothing if it has some. Collective.
std::string why_idle(LAMMPS *lmp, const Fix *fix);
// A warning of it.
//   does   begins the message, as in "Fix wall/levelset floor touches"
void check_group(LAMMPS *lmp, const std::string &does, const Fix *fix);
// Warnings where what a fix inserts, into its group and into all, is moved by no integrator, or
// touched by no wall or moved by no fluid although there are such fixes: their groups are others.
void check_inserted(LAMMPS *lmp, const std::string &who, const Fix *inserts);

// What a user of granular particles forgets. Warnings: a skin many particles wide (the default of
// units si is 1 mm), particles wider than the box (the default diameter is 1), integrators that do
// not turn spheres or have an empty group. An error: discs. Collective.
//   diameter   of the largest particle
void check_scene(LAMMPS *lmp, const std::string &who, double diameter);

}    // namespace LAMMPS_NS

#endif
