// Coefficients of pair style granular/adhesive in restart and data files.

#include "pair_granular_adhesive.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "restart_state.h"

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::write_restart(FILE *fp)
{
  RestartMark mark;
  mark.count = sizeof(ContactCoeff);
  fwrite(&mark, sizeof(mark), 1, fp);
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      fwrite(&setflag[i][j], sizeof(int), 1, fp);
      if (setflag[i][j]) fwrite(&coefficients[i][j], sizeof(ContactCoeff), 1, fp);
    }
}

void PairGranularAdhesive::read_restart(FILE *fp)
{
  RestartMark mark;
  if (comm->me == 0) utils::sfread(FLERR, &mark, sizeof(mark), 1, fp, nullptr, error);
  MPI_Bcast(&mark, sizeof(mark), MPI_BYTE, 0, world);
  if (!mark.known() || mark.count != sizeof(ContactCoeff))
    error->all(FLERR, Error::NOLASTLINE,
               "Pair granular/adhesive: its part of the restart file cannot be used: another "
               "version of APF wrote it");
  if (!allocated) allocate();
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++) {
      auto &coeff = coefficients[i][j];
      if (comm->me == 0) utils::sfread(FLERR, &setflag[i][j], sizeof(int), 1, fp, nullptr, error);
      MPI_Bcast(&setflag[i][j], 1, MPI_INT, 0, world);
      if (setflag[i][j] != 0 && setflag[i][j] != 1) refuse_damaged(i, j);
      if (!setflag[i][j]) continue;
      if (comm->me == 0) utils::sfread(FLERR, &coeff, sizeof(coeff), 1, fp, nullptr, error);
      MPI_Bcast(&coeff, sizeof(coeff), MPI_BYTE, 0, world);
      if (!coeff.sound()) refuse_damaged(i, j);
      coefficients[j][i] = coeff;
    }
}

void PairGranularAdhesive::refuse_damaged(int i, int j)
{
  error->all(FLERR, Error::NOLASTLINE,
             "Pair granular/adhesive: its part of the restart file cannot be used: it is damaged, "
             "coefficients of types {} {} are none that pair_coeff gives; use another file",
             i, j);
}

/* ---------------------------------------------------------------------- */

void PairGranularAdhesive::write_data(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    utils::print(fp, "{} {}\n", i, coefficients[i][i].words());
}

// A line can name one material only. Mixed pairs come back by mixing again; where the script named
// a pair of unlike types, that line is written.
void PairGranularAdhesive::write_data_all(FILE *fp)
{
  for (int i = 1; i <= atom->ntypes; i++)
    for (int j = i; j <= atom->ntypes; j++)
      if (setflag[i][j]) utils::print(fp, "{} {} {}\n", i, j, coefficients[i][j].words());
}
