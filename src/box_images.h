// Atoms and their periodic images, by numbers of box vectors that lie between them.

#ifndef APF_BOX_IMAGES_H
#define APF_BOX_IMAGES_H

#include "domain.h"

#include <cmath>

namespace LAMMPS_NS {

// how often an atom has been wrapped along each vector, by its flags
inline void wraps_of(imageint image, int *n)
{
  n[0] = static_cast<int>(image & IMGMASK) - IMGMAX;
  n[1] = static_cast<int>(image >> IMGBITS & IMGMASK) - IMGMAX;
  n[2] = static_cast<int>(image >> IMG2BITS) - IMGMAX;
}

// n[3]: box vectors from an atom to an image of it, as the box is now or was a few steps ago
inline void image_number(const Domain *domain, const double *atom, const double *image, double *n)
{
  double d[3];
  for (int c = 0; c < 3; c++) d[c] = image[c] - atom[c];
  n[2] = std::round(d[2] / domain->zprd);
  n[1] = std::round((d[1] - n[2] * domain->yz) / domain->yprd);
  n[0] = std::round((d[0] - n[2] * domain->xz - n[1] * domain->xy) / domain->xprd);
}

// sum[3] of n[3] box vectors: of Domain's h lengths, of its h_rate velocities
inline void sum_of_box_vectors(const double *n, const double *h, double *sum)
{
  sum[0] = n[0] * h[0] + n[1] * h[5] + n[2] * h[4];
  sum[1] = n[1] * h[1] + n[2] * h[3];
  sum[2] = n[2] * h[2];
}

}    // namespace LAMMPS_NS

#endif
