// libFuzzer: bytes as a VTKHDF file. Built and run by unittest/fuzz/run.

#include "input_folder.h"
#include "read_vtkhdf.h"

// A file with a name: one of memfd_create() has none, and HDF5 opens no file whose name it cannot
// resolve.
extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  static const fuzz::InputFolder folder;
  fuzz::tally.count(fuzz::read_vtkhdf(folder.write("input.vtkhdf", data, size)));
  return 0;
}
