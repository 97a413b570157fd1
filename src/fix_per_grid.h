// What LAMMPS asks of a fix with per-grid data, answered by CellGrid. Commands read f_ID:grid:data.

#ifndef APF_FIX_PER_GRID_H
#define APF_FIX_PER_GRID_H

#include "cell_grid.h"
#include "fix.h"

#include <string>

namespace LAMMPS_NS {

class FixPerGrid : public Fix {
 public:
  using Fix::Fix;

  int get_grid_by_name(const std::string &name, int &dim) override
  {
    const CellGrid *grid = grid_of(0);
    if (!grid || name != "grid") return -1;
    dim = grid->dimension();
    return 0;
  }
  void *get_grid_by_index(int index) override
  {
    return index == 0 ? grid_of(0)->lammps_grid() : nullptr;
  }
  int get_griddata_by_name(int igrid, const std::string &name, int &ncol) override
  {
    if (igrid != 0 || name != "data") return -1;
    ncol = grid_of(0)->columns > 1 ? grid_of(0)->columns : 0;
    return 0;
  }
  void *get_griddata_by_index(int index) override
  {
    return index == 0 ? grid_of(0)->lammps_data() : nullptr;
  }

  void pack_forward_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->pack(static_cast<double *>(buf), n, list);
  }
  void unpack_forward_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->unpack_set(static_cast<double *>(buf), n, list);
  }
  void pack_reverse_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->pack(static_cast<double *>(buf), n, list);
  }
  void unpack_reverse_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->unpack_add(static_cast<double *>(buf), n, list);
  }

  void pack_remap_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->pack_before(static_cast<double *>(buf), n, list);
  }
  void unpack_remap_grid(int which, void *buf, int n, int *list) override
  {
    grid_of(which)->unpack_set(static_cast<double *>(buf), n, list);
  }

 protected:
  // 0: the grid that others read, null if there is none; other numbers as for CellGrid
  virtual CellGrid *grid_of(int which) = 0;
};

}    // namespace LAMMPS_NS

#endif
