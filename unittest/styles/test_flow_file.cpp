// fix flow/field file through LAMMPS. Facts: a file that holds an analytic flow acts as that flow,
// whatever the number of ranks; what is wrong with a file or a box is said.

#include "simulation.h"
#include "vtkhdf_writer.h"

#include "gtest/gtest.h"

#include <cmath>
#include <filesystem>

namespace {

// a file in the temporary folder, the same on all ranks, removed at the end
class TemporaryFile {
 public:
  explicit TemporaryFile(const std::string &name)
  {
    int id = static_cast<int>(getpid());
    MPI_Bcast(&id, 1, MPI_INT, 0, MPI_COMM_WORLD);
    path =
        (std::filesystem::temp_directory_path() / (name + std::to_string(id) + ".vtkhdf")).string();
  }
  ~TemporaryFile()
  {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank() == 0) std::filesystem::remove(path);
  }
  // written by one rank
  void write(VtkhdfWriter::Counts n, VtkhdfWriter::Triple origin, VtkhdfWriter::Triple spacing,
             const std::function<void(VtkhdfWriter &)> &content) const
  {
    if (rank() == 0) {
      VtkhdfWriter writer(path, n, origin, spacing);
      content(writer);
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  static int rank()
  {
    int me;
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    return me;
  }

  std::string path;
};

const std::string spheres = R"(
units lj
atom_style sphere
atom_modify map array sort 0 0
boundary p f p
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 2 1 5
create_atoms 1 single 5 5 5
create_atoms 1 single 7 8.7 2
set type 1 diameter 0.5 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
timestep 0.01
)";
const std::string fluid = " density 0.5 viscosity $(1/18)\n";

// 4 U s (1 - s) with U = 2 and s = y/10
void parabola(const double *x, double, double *u)
{
  u[0] = 8.0 * x[1] / 10.0 * (1.0 - x[1] / 10.0);
}

}    // namespace

TEST(FlowFile, channel_from_a_file_acts_as_the_analytic_one)
{
  const TemporaryFile file("apf_channel");
  file.write({3, 41, 3}, {0, 0, 0}, {5, 0.25, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  double x[2][6];
  for (int k = 0; k < 2; k++) {
    Simulation sim;
    sim.run(spheres + "fix flow all flow/field " +
            (k ? "file " + file.path : "channel x y 0 10 2") + fluid +
            "fix drag all flow/force flow drag stokes torque yes\nrun 200\n");
    for (int i = 0; i < 3; i++) {
      x[k][i] = sim.value("x[" + std::to_string(i + 1) + "]");
      x[k][3 + i] = sim.lammps()->atom->omega[i][2];
    }
  }
  // trilinear between nodes 0.25 apart: below h^2 |u''|/8 = 0.00125
  for (int i = 0; i < 3; i++) {
    EXPECT_NEAR(x[1][i], x[0][i], 2e-3);
    EXPECT_GT(std::fabs(x[0][i] - (i == 0 ? 2 : i == 1 ? 5 : 7)), 0.1) << "it moved";
    EXPECT_NEAR(x[1][3 + i], x[0][3 + i], 1e-6);
  }
}
