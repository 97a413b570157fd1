// Zones of a wall and the account of each: loads, contacts, particles that stick, deposit.

#ifndef LMP_WALL_LEDGER_H
#define LMP_WALL_LEDGER_H

#include "pointers.h"

#include "wall_grid.h"

#include "wall/surface.h"
#include "wall/wall_pose.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace LAMMPS_NS {

using Marks = std::uint64_t;    // zones or surfaces, a bit each

struct WallTouch {    // a contact that is closed now, or a liquid bridge without one
  int i, surface, zone;
  bool dry;
};

// A zone is a surface of the wall, or the part of the wall in a region; where zones overlap the
// first one that was given counts. One row of the account is for the whole wall: number n_zones().
class WallLedger : protected Pointers {
 public:
  enum Column {
    FORCE,
    TORQUE = 3,
    CONTACTS = 6,
    ATTACHED,     // particles that touch
    DEPOSITED,    // ... or hang on a bridge, or are in an aggregate of such ones
    CAPTURED,
    DETACHED,
    MASS,
    AREA,
    MASS_PER_AREA,
    THICKNESS,    // volume per area
    LIQUID,       // on the zone
    N_COLUMNS
  };

  WallLedger(LAMMPS *lmp, const std::vector<apf::Surface> &surfaces, const apf::WallPose &pose) :
      Pointers(lmp), surfaces(surfaces), pose(pose)
  {
  }

  // zone NAME WHERE, with iarg at the word zone; iarg is left behind the last word.
  //   names   of the surfaces
  void parse(const char *command, const std::vector<std::string> &names, int narg, char **arg,
             int &iarg);
  // after the last zone: what is in none has a zone of its own; surfaces are zones if there is none
  //   grid   where the surfaces come from, if they do from a file
  void complete(const std::vector<std::string> &names, const WallGrid *grid);
  void init(const std::string &of_fix);
  void find_regions(const std::string &of_fix);    // that zones name; an error if one is gone
  void move_regions();    // to where they are in this step; called by all ranks

  int n_zones() const { return static_cast<int>(zones.size()); }
  int find(const std::string &name) const;    // number of a zone, -1 if there is none
  std::string names() const;
  int zone_of(int surface, const double *foot) const;
  // a number of zones as bits, the whole wall with them
  Marks mark(int zone) const { return Marks(1) << zone | Marks(1) << n_zones(); }

  // ---- of this rank
  void clear_loads() { loads.assign(zones.size(), {}); }
  std::array<double, 6> &load(int zone) { return loads[zone]; }    // force and torque
  std::array<double, 6> total_load() const;
  // A particle gets or loses a contact; the others that it has are in zones marked by `others`.
  void begin(int zone, Marks others) { count(begun, zone, others); }
  void end(int zone, Marks others) { count(ended, zone, others); }

  std::vector<double> liquid;    // on each zone: this rank's part, which may be < 0     [volume]
  double total_liquid() const;

  // ---- of all ranks, called by all
  // rows of all zones and of the whole wall, from the contacts of this rank
  void settle(const std::vector<WallTouch> &touches, class ComputeAggregateContact *aggregates);
  double entry(int row, int column) const { return account[row][column]; }
  double area(int row);                       // 0 if the box holds nothing of a zone
  double per_area(double amount, int row);    // ... and this too
  // thickness of the liquid on each zone
  std::vector<double> films();
  void begin_films(double thickness);    // unless they have begun, also before a restart

  // counts since the fix was defined, with the names of zones and surfaces, for restart files
  std::vector<double> state() const;
  void set_state(class RestartState &, const std::string &of_fix);

 private:
  static constexpr int most_zones = 63;    // bits of marks, less one for the whole wall
  struct Zone {
    std::string name;
    int surface;             // -1 if it is not one
    std::string region;      // ID
    class Region *inside;    // or nullptr
  };
  using Row = std::array<double, N_COLUMNS>;

  const std::vector<apf::Surface> &surfaces;
  const apf::WallPose &pose;
  const WallGrid *from_file = nullptr;
  std::string of_surfaces;    // their names
  std::vector<Zone> zones;
  std::vector<int> only_zone;    // of each surface; -1 if regions may divide it
  std::vector<std::array<double, 6>> loads;
  std::vector<double> begun, ended;    // particles; the last one is of the whole wall
  std::vector<Row> account;
  std::vector<double> areas;
  std::array<double, 9> measured_box{};    // for which areas are known
  bigint measured_step = -1;
  bool regions_move = false;
  bool has_films = false;

  void count(std::vector<double> &counts, int zone, Marks others);
  void find_only_zones();
  std::string places() const;    // in characters that can be printed
  void measure_areas();
};

}    // namespace LAMMPS_NS

#endif
