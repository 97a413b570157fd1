#include "slab_transform.h"

#include <algorithm>

#ifdef APF_FFTW
#include <fftw3-mpi.h>
#endif

using namespace LAMMPS_NS;

#ifdef APF_FFTW

bool SlabTransform::available()
{
  return true;
}

// Plans are estimated, not measured: a measured one may differ from run to run, and its last bits
// with it. In space waves stay divided along the second axis, which saves two exchanges.
SlabTransform::SlabTransform(MPI_Comm world, const std::array<int, 3> &_n) :
    n(_n), pitch(2 * (static_cast<size_t>(_n[2]) / 2 + 1))
{
  fftw_mpi_init();
  const bool flat = n[1] == 1;
  const ptrdiff_t half = n[2] / 2 + 1;
  ptrdiff_t planes, plane, lines, line;
  size_t needed;
  if (flat) {
    needed = fftw_mpi_local_size_2d(n[0], half, world, &planes, &plane);
    lines = planes;
    line = plane;
  } else {
    needed =
        fftw_mpi_local_size_3d_transposed(n[0], n[1], half, world, &planes, &plane, &lines, &line);
  }
  first = static_cast<int>(plane);
  count = static_cast<int>(planes);
  first_wave = static_cast<int>(line);
  waves = static_cast<int>(lines);
  size = 2 * needed;
  data = fftw_alloc_real(size);
  auto *spectrum = reinterpret_cast<fftw_complex *>(data);
  if (flat) {
    forward = fftw_mpi_plan_dft_r2c_2d(n[0], n[2], data, spectrum, world, FFTW_ESTIMATE);
    backward = fftw_mpi_plan_dft_c2r_2d(n[0], n[2], spectrum, data, world, FFTW_ESTIMATE);
  } else {
    forward = fftw_mpi_plan_dft_r2c_3d(n[0], n[1], n[2], data, spectrum, world,
                                       FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_OUT);
    backward = fftw_mpi_plan_dft_c2r_3d(n[0], n[1], n[2], spectrum, data, world,
                                        FFTW_ESTIMATE | FFTW_MPI_TRANSPOSED_IN);
  }
}

SlabTransform::~SlabTransform()
{
  fftw_destroy_plan(static_cast<fftw_plan>(forward));
  fftw_destroy_plan(static_cast<fftw_plan>(backward));
  fftw_free(data);
}

void SlabTransform::filter(const std::array<std::vector<double>, 3> &factors)
{
  const bool flat = n[1] == 1;
  const int divided = flat ? 0 : 1, whole = flat ? 1 : 0;
  fftw_execute(static_cast<fftw_plan>(forward));
  double *wave = data;
  for (int i = first_wave; i < first_wave + waves; i++)
    for (int j = 0; j < n[whole]; j++) {
      const double factor = factors[divided][i] * factors[whole][j];
      for (size_t k = 0; k < pitch / 2; k++) {
        *wave++ *= factor * factors[2][k];
        *wave++ *= factor * factors[2][k];
      }
    }
  fftw_execute(static_cast<fftw_plan>(backward));
}

#else

bool SlabTransform::available()
{
  return false;
}

SlabTransform::SlabTransform(MPI_Comm, const std::array<int, 3> &_n) : n(_n), pitch(0) {}
SlabTransform::~SlabTransform() = default;
void SlabTransform::filter(const std::array<std::vector<double>, 3> &) {}

#endif

void SlabTransform::clear()
{
  std::fill_n(data, size, 0.0);
}
