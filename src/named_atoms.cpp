#include "named_atoms.h"

#include "fmt/format.h"

#include <algorithm>

using namespace LAMMPS_NS;

void NamedAtoms::gather(MPI_Comm world)
{
  const bigint mine = here.size();
  MPI_Allreduce(&mine, &all, 1, MPI_LMP_BIGINT, MPI_SUM, world);
  if (all == 0) return;
  std::sort(here.begin(), here.end());
  here.resize(most, {-1.0, 0});    // what fills up is sorted behind all atoms
  int ranks;
  MPI_Comm_size(world, &ranks);
  worst.resize(most * ranks);
  MPI_Allgather(here.data(), most * sizeof(Named), MPI_BYTE, worst.data(), most * sizeof(Named),
                MPI_BYTE, world);
  std::sort(worst.begin(), worst.end());
  worst.resize(std::min<bigint>(all, most));
}

std::string NamedAtoms::ids() const
{
  std::string text;
  for (const auto &atom : worst) text += fmt::format("{}{}", text.empty() ? "" : ", ", atom.id);
  return all > most ? fmt::format("{} and {} more", text, all - most) : text;
}
