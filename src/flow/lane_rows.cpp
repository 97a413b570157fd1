// Compiled once per instruction set (CMakeLists.txt); APF_ISA names the namespace of this copy.

#include "lane_rows.h"

#include "transpose.h"

#ifndef APF_ISA
#define APF_ISA baseline
#endif

namespace apf::APF_ISA {

namespace {

  // compilers make vector code of these two
  void take(const double *__restrict rows, int n, Lanes *__restrict to)
  {
    for (int l = 0; l < n; l++)
      for (int c = 0; c < 3; c++) to[c][l] = rows[3 * l + c];
  }

  void add(const Lanes *__restrict from, int n, double *__restrict rows)
  {
    for (int l = 0; l < n; l++)
      for (int c = 0; c < 3; c++) rows[3 * l + c] += from[c][l];
  }

  // Four by four; the last four columns of a row may have been written before.
  void put(const Lanes *const *from, int width, int n, double *rows)
  {
    int l = 0;
    for (; l + 4 <= n; l += 4)
      for (int c = 0; c < width; c += 4) {
        const int first = c + 4 <= width ? c : width - 4;
        Quad part[4];
        for (int k = 0; k < 4; k++) part[k] = load<Quad>(*from[first + k] + l);
        transpose(part);
        for (int k = 0; k < 4; k++)
          std::memcpy(rows + (l + k) * width + first, &part[k], sizeof(Quad));
      }
    for (; l < n; l++)
      for (int c = 0; c < width; c++) rows[l * width + c] = (*from[c])[l];
  }

  void add_up(const Lanes &a, int n, double *__restrict parts)
  {
    const int whole = n - n % sum_parts;
    for (int l = 0; l < whole; l += sum_parts)
      for (int k = 0; k < sum_parts; k++) parts[k] += a[l + k];
    for (int l = whole; l < n; l++) parts[l - whole] += a[l];
  }

}    // namespace

extern const LaneRows lane_row_functions = {take, add, put, add_up};

}    // namespace apf::APF_ISA
