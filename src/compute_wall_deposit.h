// What has settled on a wall: height of every particle that sticks, longest dendrite, thickness.

#ifdef COMPUTE_CLASS
// clang-format off
ComputeStyle(wall/deposit,ComputeWallDeposit);
// clang-format on
#else

#ifndef LMP_COMPUTE_WALL_DEPOSIT_H
#define LMP_COMPUTE_WALL_DEPOSIT_H

#include "compute.h"

#include <array>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class ComputeWallDeposit : public Compute {
 public:
  ComputeWallDeposit(class LAMMPS *, int, char **);
  ~ComputeWallDeposit() override;
  void init() override;
  void compute_peratom() override;
  void compute_vector() override;
  void compute_array() override;
  double memory_usage() override;

 private:
  enum { PARTICLES, HEIGHT, THICKNESS, N_COLUMNS };
  using Row = std::array<double, N_COLUMNS>;

  std::string wall_id, zone;    // zone: of the vectors, empty for the whole wall
  class FixWallLevelset *wall = nullptr;
  int chosen = 0;    // row of the vectors
  int nmax = 0;
  bool warned = false;    // of heights beyond the band of a grid

  void find_wall(int iarg);
  void measure();
  void warn_beyond(double height);
  Row measure_row(int row, const std::vector<struct WallTouch> &touches);
};

}    // namespace LAMMPS_NS

#endif
#endif
