// A regular grid of cells over the simulation box, shared out among ranks by LAMMPS's Grid2d or
// Grid3d, with ghost cells and one or more numbers a cell. Two dimensions are a layer of cells.

#ifndef APF_CELL_GRID_H
#define APF_CELL_GRID_H

#include <array>
#include <functional>
#include <memory>
#include <vector>

namespace LAMMPS_NS {
class Fix;
class Grid2d;
class Grid3d;
class LAMMPS;

class CellGrid {
 public:
  // owner: the fix whose functions pack_forward_grid() and so on call those below; which: what they
  // get to tell its grids from each other
  CellGrid(LAMMPS *lmp, Fix *owner, const std::array<int, 3> &cells, int columns, int which = 0);
  ~CellGrid();

  // Anew for the present box and its division among ranks; values are 0 then. reach: cells beyond
  // that of a particle that are read or written, the particle no more than half the neighbor skin
  // outside its rank's part of the box. Collective.
  void set_up(int reach);
  void share_anew(int reach);    // ... with the values of before; ghosts are 0

  const std::array<int, 3> n;         // cells of the whole grid
  const int columns;                  // numbers of a cell
  int lo[3] = {}, hi[3] = {};         // cells of this rank, both ends included
  int first[3] = {}, last[3] = {};    // and of those that it has, as its own or as ghosts
  double spacing[3] = {}, inverse_spacing[3] = {}, origin[3] = {};
  bool periodic[3] = {};
  double cell_volume = 0.0;    // in two dimensions area

  double *at(int x, int y, int z)
  {
    return &values[columns *
                   ((static_cast<size_t>(z - first[2]) * size[1] + (y - first[1])) * size[0] +
                    (x - first[0]))];
  }
  const double *at(int x, int y, int z) const { return const_cast<CellGrid *>(this)->at(x, y, z); }

  template <class Act> void for_own_cells(Act act) const    // act(x, y, z)
  {
    for (int z = lo[2]; z <= hi[2]; z++)
      for (int y = lo[1]; y <= hi[1]; y++)
        for (int x = lo[0]; x <= hi[0]; x++) act(x, y, z);
  }
  void for_own(const std::function<void(double *)> &act)    // act(values of a cell)
  {
    for_own_cells([&](int x, int y, int z) {
      act(at(x, y, z));
    });
  }

  void clear();
  void sum_ghosts();     // values of ghosts are added to those of their owners
  void fill_ghosts();    // ghosts get the values of their owners

  // Trilinear interpolation between centres of cells, in two dimensions bilinear: act(values of a
  // cell, its weight) for the cells around x. Beyond the centres at a border the outermost cells
  // count. False, and nothing is done, if x is beyond the cells of this rank.
  template <class Act> bool interpolate(const double *x, Act act)
  {
    int base[3];
    double weight[8];
    if (!trilinear(x, base, weight)) return false;
    for (int k = 0; k < (flat ? 4 : 8); k++)
      act(at(k & 1 ? next(0, base[0]) : base[0], k & 2 ? next(1, base[1]) : base[1],
             k & 4 ? next(2, base[2]) : base[2]),
          weight[k]);
    return true;
  }
  template <class Act> bool interpolate(const double *x, Act act) const
  {
    return const_cast<CellGrid *>(this)->interpolate(x, act);
  }

  // for the owner: what LAMMPS asks of a fix with per-grid data
  int dimension() const { return flat ? 2 : 3; }
  void *lammps_grid() const;
  void *lammps_data();    // [z][y][x] or, with several columns, [z][y][x][column]
  void pack(double *buf, int n, const int *list) const;
  void unpack_set(const double *buf, int n, const int *list);
  void unpack_add(const double *buf, int n, const int *list);
  void pack_before(double *buf, int n, const int *list) const;    // see share_anew()
  double memory_usage() const;

 private:
  LAMMPS *lmp;
  Fix *owner;
  int which;
  bool flat;
  int size[3] = {};
  std::unique_ptr<Grid2d> grid2d;
  std::unique_ptr<Grid3d> grid3d;
  std::vector<double> values, before, out, in;
  std::vector<double *> lines, cells;
  std::vector<double **> planes, cell_lines;
  std::vector<double ***> cell_planes;

  void check_size(int reach) const;
  void try_memory() const;
  void allocate(int reach);
  void point_to_values();
  // weights of cell base and the next along each axis
  bool trilinear(const double *x, int *base, double *weight) const;
  int next(int c, int cell) const { return n[c] > 1 || periodic[c] ? cell + 1 : cell; }
};

}    // namespace LAMMPS_NS

#endif
