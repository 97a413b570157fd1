// Particles and what a grid of cells holds of them, for the tests of fix flow/concentration.

#ifndef APF_TEST_CONCENTRATION_SCENE_H
#define APF_TEST_CONCENTRATION_SCENE_H

#include "scenes.h"

// n particles of two sizes at random in a box 10 x 8 x 6
inline std::string crowd(const std::string &boundary, int n = 200)
{
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\nboundary " +
      boundary +
      "\nregion box block 0 10 0 8 0 6\nregion in block 0.1 9.9 0.1 7.9 0.1 5.9\n"
      "create_box 1 box\ncreate_atoms 1 random " +
      std::to_string(n) +
      " 4711 in\nreset_atoms id sort yes\nset group all diameter 0.2 density 1\nset atom 1*50 "
      "diameter 0.3\n"
      "pair_style zero 0.5 nocoeff\npair_coeff * *\nneighbor 0.4 bin\nfix move all nve/sphere\n"
      "timestep 0.01\n";
}
inline double volume(Simulation &sim)
{
  double sum = 0.0;
  const auto *atom = sim.lammps()->atom;
  for (int i = 0; i < atom->nlocal; i++) sum += 4.0 / 3.0 * pi * std::pow(atom->radius[i], 3);
  double all;
  MPI_Allreduce(&sum, &all, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return all;
}

// one particle of diameter 0.4 at (x, y, z) in a periodic cube of 10
inline std::string one(const std::string &x, const std::string &boundary = "p p p")
{
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\nboundary " +
      boundary + "\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\ncreate_atoms 1 single " + x +
      "\nset type 1 diameter 0.4 density 1\npair_style zero 0.5 nocoeff\npair_coeff * *\n"
      "neighbor 0.4 bin\nfix move all nve/sphere\ntimestep 0.01\n";
}

// value of a cell, counted from 0, of per-grid data in a file of dump grid
inline std::vector<double> dumped(Simulation &sim, const std::string &what, const std::string &file)
{
  sim.run("dump grid all grid 1 " + file + " " + what +
          "\ndump_modify grid sort id format float %.17g\nrun 0\nundump grid\n");
  MPI_Barrier(sim.lammps()->world);    // one rank has written it
  std::vector<double> values;
  FILE *in = fopen(file.c_str(), "r");
  char line[256];
  bool data = false;
  while (in && fgets(line, sizeof(line), in)) {
    if (data) values.push_back(std::atof(line));
    if (std::string(line).find("ITEM: GRID CELLS") == 0) data = true;
  }
  if (in) fclose(in);
  MPI_Barrier(sim.lammps()->world);
  return values;
}

#endif
