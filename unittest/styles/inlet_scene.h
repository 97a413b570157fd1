// A box that particles enter through a plane, for the tests of fix inlet/flow.

#ifndef APF_TEST_INLET_SCENE_H
#define APF_TEST_INLET_SCENE_H

#include "scenes.h"

#include <algorithm>
#include <array>

// a box 20 x 10 x 10, closed along x, periodic across; particles that have entered move on
inline std::string box(const std::string &across = "p p", const std::string &more = "")
{
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\nboundary f " +
      across + "\nregion box block 0 20 0 10 0 10\ncreate_box 1 box\n" +
      "neighbor 0.3 bin\nneigh_modify every 1 delay 0 check yes\n"
      "pair_style granular/adhesive\n"
      "pair_coeff * * jkr 1e4 0.3 0.1 damping tsuji 0.5 sliding 0.3\n"
      "fix move all nve/sphere\ntimestep 0.01\n" +
      more;
}
inline const std::string unit_fluid = " density 1 viscosity 1\n";
inline const std::string uniform = "fix air all flow/field uniform 1 0 0" + unit_fluid;
inline const std::string particle = " diameter 0.5 density 2 type 1 seed 4711 ";

// all particles of all ranks by ID; IDs have holes where particles have left
struct Inside {
  std::vector<double> tag, x, v, omega, radius;
};
inline Inside inside(Simulation &sim)
{
  const auto *atom = sim.lammps()->atom;
  std::vector<double> mine;
  for (int i = 0; i < atom->nlocal; i++) {
    mine.push_back(static_cast<double>(atom->tag[i]));
    for (double **a : {atom->x, atom->v, atom->omega}) mine.insert(mine.end(), a[i], a[i] + 3);
    mine.push_back(atom->radius[i]);
  }
  int n = static_cast<int>(mine.size()), ranks;
  MPI_Comm_size(sim.lammps()->world, &ranks);
  std::vector<int> counts(ranks), starts(ranks, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, sim.lammps()->world);
  for (int r = 1; r < ranks; r++) starts[r] = starts[r - 1] + counts[r - 1];
  std::vector<std::array<double, 11>> all((starts.back() + counts.back()) / 11);
  MPI_Allgatherv(mine.data(), n, MPI_DOUBLE, all.data(), counts.data(), starts.data(), MPI_DOUBLE,
                 sim.lammps()->world);
  std::sort(all.begin(), all.end());
  Inside result;
  for (const auto &row : all) {
    result.tag.push_back(row[0]);
    result.x.insert(result.x.end(), &row[1], &row[4]);
    result.v.insert(result.v.end(), &row[4], &row[7]);
    result.omega.insert(result.omega.end(), &row[7], &row[10]);
    result.radius.push_back(row[10]);
  }
  return result;
}

inline double smallest_gap(Simulation &sim, const double *period)
{
  const auto all = inside(sim);
  const auto &x = all.x;
  const auto &radius = all.radius;
  double smallest = 1e30;
  for (size_t i = 0; i < radius.size(); i++)
    for (size_t j = 0; j < i; j++) {
      double d2 = 0.0;
      for (int c = 0; c < 3; c++) {
        double d = x[3 * i + c] - x[3 * j + c];
        if (period[c] > 0.0) d -= period[c] * std::round(d / period[c]);
        d2 += d * d;
      }
      smallest = std::min(smallest, std::sqrt(d2) - radius[i] - radius[j]);
    }
  return smallest;
}
inline const double periodic_yz[3] = {0.0, 10.0, 10.0};

#endif
