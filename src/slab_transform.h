// A real grid in slabs of planes, one slab a rank, and FFTW's parallel transforms of it.

#ifndef LMP_SLAB_TRANSFORM_H
#define LMP_SLAB_TRANSFORM_H

#include <mpi.h>

#include <array>
#include <cstddef>
#include <vector>

namespace LAMMPS_NS {

class SlabTransform {
 public:
  static bool available();    // built with FFTW

  // n: cells along the planes' normal, along the lines of a plane and within a line; with one
  // line a plane the transform is two-dimensional. Collective.
  SlabTransform(MPI_Comm world, const std::array<int, 3> &n);
  ~SlabTransform();
  SlabTransform(const SlabTransform &) = delete;
  SlabTransform &operator=(const SlabTransform &) = delete;

  const std::array<int, 3> n;
  int first = 0, count = 0;    // planes of this rank
  double *line(int plane, int l) const
  {
    return data + (static_cast<size_t>(plane - first) * n[1] + l) * pitch;
  }
  void clear();
  size_t memory() const { return size; }    // numbers

  // Multiplies each wave by the product of the factors of its three numbers, and by the number of
  // cells, which FFTW does not divide by. Collective.
  void filter(const std::array<std::vector<double>, 3> &factors);

 private:
  double *data = nullptr;
  size_t size = 0, pitch;
  int first_wave = 0, waves = 0;    // along the axis that waves are divided by
  void *forward = nullptr, *backward = nullptr;
};

}    // namespace LAMMPS_NS

#endif
