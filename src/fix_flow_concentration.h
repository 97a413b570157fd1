// Concentration of particles: their volumes smeared out to Gaussian clouds, on a grid.

#ifdef FIX_CLASS
// clang-format off
FixStyle(flow/concentration,FixFlowConcentration);
// clang-format on
#else

#ifndef LMP_FIX_FLOW_CONCENTRATION_H
#define LMP_FIX_FLOW_CONCENTRATION_H

#include "cloud_convolution.h"
#include "cloud_sum.h"
#include "fix_per_grid.h"
#include "run_guard.h"

#include "flow/fluid_block.h"

#include <memory>
#include <string>
#include <vector>

namespace LAMMPS_NS {

class FixFlowConcentration : public FixPerGrid {
 public:
  FixFlowConcentration(class LAMMPS *, int, char **);
  int setmask() override;
  void init() override;
  void setup(int) override { guard.prepared(); }
  void setup_pre_force(int) override;
  void setup_pre_force_respa(int, int) override;
  void pre_force(int) override;
  void pre_force_respa(int, int, int) override;
  void reset_grid() override;
  double compute_vector(int) override;
  double memory_usage() override;

  // volume of particles per volume at points of this rank's part of the box, >= 0
  void sample(const apf::PointBlock &points, apf::Lanes &concentration) const;
  const std::array<int, 3> &cells() const { return grid.n; }

 private:
  RunGuard guard;
  CellGrid grid;          // concentration                                                 [-]
  CellGrid open;          // 1 where there is fluid, else 0; used if `walled`
  double radius = 0.0;    // R of a cloud                                            [length]
  int every = 0;          // time steps between updates; 0 = fluid steps
  enum class Method { AUTO, DIRECT, FFT } method = Method::AUTO;
  bool walled = false;                 // some cells hold no fluid
  bool closed = false;                 // that, or the box is not periodic
  bool wide = false;                   // a cloud overlaps its own periodic images
  bool warned = false;                 // of a cloud that is small against the cells
  std::unique_ptr<CloudSum> direct;    // both made when they are needed
  std::unique_ptr<CloudConvolution> convolution;
  std::vector<int> members;    // particles whose clouds are to be added

  std::array<int, 3> parse_cells(int narg, char **arg);
  void parse(int narg, char **arg);
  void set_up(bool keep = false);
  bool box_changes() const;
  void check_wide(int axis);
  void mark_fluid();
  CellGrid *grid_of(int which) override { return which ? &direct->grid : &grid; }
  void renew();
  double volume(int i) const;
  double widest_cell() const;
  bool can_convolve() const;
  bool by_convolution() const;
  void convolve();
  void add_up();
  [[noreturn]] void complain_far(const double *x) const;
  [[noreturn]] void complain_walled(const double *x, double least) const;
};

}    // namespace LAMMPS_NS

#endif
#endif
