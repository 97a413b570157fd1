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

// Partners are remembered by their ID: where the box is thinner along a periodic axis than twice
// the range of the neighbour list, that may hold two images of one.
class NearestImages {
 public:
  explicit NearestImages(const Domain *domain) : domain(domain)
  {
    // distances of opposite faces: inverse lengths of the rows of the inverse matrix
    const double *inv = domain->h_inv;
    const double width[3] = {1.0 / std::hypot(inv[0], inv[5], inv[4]),
                             1.0 / std::hypot(inv[1], inv[3]), 1.0 / inv[2]};
    for (int k = 0; k < 3; k++)
      if (domain->periodicity[k] && (k < 2 || domain->dimension == 3))
        thinnest = std::fmin(thinnest, width[k]);
  }

  double width() const { return thinnest; }    // of the box along a periodic axis; or infinite

  // whether all other images of a point at d[3] are at least `factor` times as far
  bool nearest(const double *d, double factor) const
  {
    const double d2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2];
    if ((1.0 + factor) * std::sqrt(d2) < thinnest) return true;
    int most[3];
    for (int k = 0; k < 3; k++) most[k] = domain->periodicity[k];
    for (int a = -most[0]; a <= most[0]; a++)
      for (int b = -most[1]; b <= most[1]; b++)
        for (int c = -most[2]; c <= most[2]; c++) {
          if (a == 0 && b == 0 && c == 0) continue;
          const double n[3] = {double(a), double(b), double(c)};
          double other[3], other2 = 0.0;
          sum_of_box_vectors(n, domain->h, other);
          for (int k = 0; k < 3; k++) other2 += (d[k] + other[k]) * (d[k] + other[k]);
          if (other2 < factor * factor * d2) return false;
        }
    return true;
  }
  bool nearest(const double *from, const double *to) const
  {
    constexpr double but_for_rounding = 1.0 - 1e-12;
    const double d[3] = {to[0] - from[0], to[1] - from[1], to[2] - from[2]};
    return nearest(d, but_for_rounding);
  }

 private:
  const Domain *domain;
  double thinnest = INFINITY;
};

}    // namespace LAMMPS_NS

#endif
