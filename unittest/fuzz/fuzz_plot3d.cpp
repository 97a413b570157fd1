// libFuzzer: bytes as a PLOT3D grid in text, of which flowgrid finds the kind. Built and run by
// unittest/fuzz/run.

#include "require.h"

#include "plot3d_text.h"

#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  const int memory = memfd_create("input", 0);
  fuzz::require(write(memory, data, size) == static_cast<ssize_t>(size), "room for the input");
  const flowgrid::Plot3dText kind("/proc/self/fd/" + std::to_string(memory));
  fuzz::require(kind.text || !kind.known, "only text is known by its numbers");
  fuzz::tally.count(kind.known);
  close(memory);
  return 0;
}
