// LAMMPS's per-atom vectors as the contiguous arrays that they are: without a load of the pointer
// of each atom's row, which in large scenes is a fifth of what a pass over all atoms reads.

#ifndef APF_ATOM_ROWS_H
#define APF_ATOM_ROWS_H

namespace LAMMPS_NS {

// [n][3]; null without atoms
inline double (*rows_of(double **a))[3]
{
#ifdef __clang_analyzer__
  return reinterpret_cast<double(*)[3]>(a[0]);    // it takes loops over atoms for loops without
#endif
  return a ? reinterpret_cast<double(*)[3]>(a[0]) : nullptr;
}

}    // namespace LAMMPS_NS

#endif
