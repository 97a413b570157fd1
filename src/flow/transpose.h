// Four numbers of each of four particles become four particles' of each number, and back.

#ifndef APF_TRANSPOSE_H
#define APF_TRANSPOSE_H

#include "../contact/pack.h"

namespace apf {

APF_INLINE void transpose(Quad (&a)[4])
{
  const Quad ab02 = __builtin_shufflevector(a[0], a[1], 0, 4, 2, 6);
  const Quad ab13 = __builtin_shufflevector(a[0], a[1], 1, 5, 3, 7);
  const Quad cd02 = __builtin_shufflevector(a[2], a[3], 0, 4, 2, 6);
  const Quad cd13 = __builtin_shufflevector(a[2], a[3], 1, 5, 3, 7);
  a[0] = __builtin_shufflevector(ab02, cd02, 0, 1, 4, 5);
  a[1] = __builtin_shufflevector(ab13, cd13, 0, 1, 4, 5);
  a[2] = __builtin_shufflevector(ab02, cd02, 2, 3, 6, 7);
  a[3] = __builtin_shufflevector(ab13, cd13, 2, 3, 6, 7);
}

}    // namespace apf

#endif
