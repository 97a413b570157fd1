// libFuzzer: bytes as a VTKHDF file. Built and run by unittest/fuzz/run.

#include "read_vtkhdf.h"

#include <sys/mman.h>
#include <unistd.h>

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  const int memory = memfd_create("input", 0);
  fuzz::require(write(memory, data, size) == static_cast<ssize_t>(size), "room for the input");
  fuzz::read_vtkhdf("/proc/self/fd/" + std::to_string(memory));
  close(memory);
  return 0;
}
