// libFuzzer: bytes as a VTKHDF file. A file is refused by an error with a text, or read: then all
// of it is finite and as long as its grid says. Build with clang: unittest/fuzz/run

#include "flow/vtkhdf_file.h"

#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <sys/mman.h>
#include <unistd.h>

namespace {

void require(bool fact)
{
  if (!fact) std::abort();
}

void read_all(const std::string &path)
{
  const apf::VtkhdfFile file(path);
  const auto &grid = file.grid();
  const int frames = file.times().empty() ? 1 : static_cast<int>(file.times().size());
  for (const int frame : {0, frames - 1})
    for (const int components : {1, 3})
      for (const char *array : {"velocity", "pressure", "distance"}) {
        if (!file.has(array)) continue;
        try {
          const auto values = file.read(array, components, frame, grid.n[2]);
          require(values.size() == grid.nodes() * components);
          for (const double value : values) require(std::isfinite(value));
        } catch (std::runtime_error &error) {
          require(error.what()[0] != '\0');
        }
      }
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  const int memory = memfd_create("input", 0);
  require(write(memory, data, size) == static_cast<ssize_t>(size));
  try {
    read_all("/proc/self/fd/" + std::to_string(memory));
  } catch (std::runtime_error &error) {
    require(error.what()[0] != '\0');
  }
  close(memory);
  return 0;
}
