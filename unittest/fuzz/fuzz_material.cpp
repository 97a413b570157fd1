// libFuzzer: bytes as a material file, read through LAMMPS. A file is refused by an error that
// names it, or gives a material within the ranges of the page. Built and run by unittest/fuzz/run.

#include "require.h"

#include "material_file.h"
#include "simulation.h"

#include <cmath>

#include <unistd.h>

namespace {

Simulation &simulation()
{
  static Simulation *sim = nullptr;
  if (!sim) {
    MPI_Init(nullptr, nullptr);
    sim = new Simulation;
    sim->run("units si");
  }
  return *sim;
}

}    // namespace

extern "C" int LLVMFuzzerTestOneInput(const unsigned char *data, std::size_t size)
{
  static const std::string path = "/dev/shm/apf-fuzz-" + std::to_string(getpid()) + ".adhesive";
  FILE *file = std::fopen(path.c_str(), "wb");
  fuzz::require(file && std::fwrite(data, 1, size, file) == size, "room for the input");
  std::fclose(file);
  bool right = false;
  try {
    const auto got = apf::read_material(simulation().lammps(), path, "silica", "Fuzz");
    fuzz::require(got.E > 0.0 && got.nu > -1.0 && got.nu <= 0.5 && got.gamma >= 0.0 &&
                      std::isfinite(got.E) && std::isfinite(got.gamma),
                  "a material is within its ranges");
    right = true;
  } catch (LAMMPS_NS::LAMMPSException &error) {
    fuzz::require_reason(error.what(), {"Fuzz: material file /dev/shm", "Fuzz: material silica"});
  }
  fuzz::tally.count(right);
  std::remove(path.c_str());
  return 0;
}
