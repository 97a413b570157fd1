// Flows from files on 1, 2 and 4 ranks, and on nodes of a few ranks each.

#include "flow_file.h"
#include "nodes.h"

#include "fix.h"

namespace {

constexpr int n_spheres = 60;

// one after another, so that they have the same IDs on any number of ranks
std::string many()
{
  std::string text = "units lj\natom_style sphere\natom_modify map array sort 0 0\n"
                     "boundary p m p\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\n";
  for (int i = 0; i < n_spheres; i++) {
    text += "create_atoms 1 single";
    for (const double step : {0.618, 0.755, 0.57})
      text += " " + std::to_string(0.1 + 9.8 * std::fmod((i + 1) * step, 1.0));
    text += "\n";
  }
  return text +
      "set type 1 diameter 0.1 density 1.0\npair_style zero 1.0 nocoeff\n"
      "pair_coeff * *\nfix move all nve/sphere\ntimestep 0.01\n"
      "neigh_modify delay 0 every 1\n";
}

void expect_forces_of_one_rank()
{
  const TemporaryFile file("apf_ranks");
  const std::vector<double> times = {0.0, 0.1, 0.2, 0.3};
  file.write({9, 17, 11}, {0, 0, 0}, {1.25, 0.625, 1}, [&](VtkhdfWriter &w) {
    w.steps(times);
    w.field(
        "velocity", 3,
        [](const double *x, double t, double *u) {
          u[0] = std::sin(0.4 * pi * x[0]) + t;
          u[1] = std::cos(x[1] * (1.0 + t));
          u[2] = 0.1 * std::sin(0.4 * pi * x[2]);
        },
        times);
    w.field("distance", 1, [](const double *x, double, double *s) {
      s[0] = std::min(x[1] - 0.3, 9.6 - x[1]);
    });
  });
  const std::string commands = many() + "fix flow all flow/field file " + file.path +
      " loop yes outside clamp" + fluid +
      "fix drag all flow/force flow drag stokes torque yes\nrun 47\n";
  // the same on this rank alone
  std::vector<double> alone;
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(commands);
    for (int tag = 1; tag <= n_spheres; tag++) {
      const int i = sim.lammps()->atom->map(tag);
      for (int c = 0; c < 3; c++) {
        alone.push_back(sim.lammps()->atom->x[i][c]);
        alone.push_back(sim.lammps()->atom->omega[i][c]);
      }
    }
  }
  Simulation sim;
  sim.run(commands);
  int compared = 0;
  const auto *atom = sim.lammps()->atom;
  for (int i = 0; i < atom->nlocal; i++)
    for (int c = 0; c < 3; c++, compared++) {
      EXPECT_EQ(atom->x[i][c], alone[6 * (atom->tag[i] - 1) + 2 * c]);
      EXPECT_EQ(atom->omega[i][c], alone[6 * (atom->tag[i] - 1) + 2 * c + 1]);
    }
  MPI_Allreduce(MPI_IN_PLACE, &compared, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(compared, 3 * n_spheres);
}

// bytes that all ranks hold of a grid of 20^3 nodes
double bytes_of_a_grid()
{
  const TemporaryFile file("apf_memory");
  file.write({20, 20, 20}, {0, 0, 0}, {1, 1, 1}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  Simulation sim;
  sim.run(many() + "fix flow all flow/field file " + file.path + fluid +
          "fix drag all flow/force flow drag stokes\nrun 0\n");
  double bytes = sim.lammps()->modify->get_fix_by_id("flow")->memory_usage();
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return bytes;
}

}    // namespace

TEST(RanksFlowFile, forces_do_not_depend_on_ranks)
{
  expect_forces_of_one_rank();
}

TEST(RanksFlowFile, forces_do_not_depend_on_nodes)
{
  for (const int ranks : {1, 2, 3}) {
    const SmallNodes nodes(ranks);
    expect_forces_of_one_rank();
  }
}

TEST(RanksFlowFile, a_node_has_one_copy)
{
  EXPECT_NEAR(bytes_of_a_grid(), 20 * 20 * 20 * 32, 64) << "four doubles a node";
}

TEST(RanksFlowFile, every_node_has_a_copy)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (const int of_a_node : {1, 2, 3}) {
    const SmallNodes nodes(of_a_node);
    const int copies = (ranks + of_a_node - 1) / of_a_node;
    EXPECT_NEAR(bytes_of_a_grid(), copies * 20 * 20 * 20 * 32, 64 * copies) << of_a_node;
  }
}

// Each node reads the file from where it finds it, as a disk of its own.
TEST(RanksFlowFile, nodes_with_other_files_are_refused)
{
  int me, ranks;
  MPI_Comm_rank(MPI_COMM_WORLD, &me);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const SmallNodes nodes(1);
  struct Contents {
    double spacing, end, speed;
    bool distance;
  };
  const auto error_where_the_last_node_has = [&](const Contents &last) {
    const auto write = [](const TemporaryFile &file, const Contents &what) {
      file.write({3, 3, 3}, {0, 0, 0}, {what.spacing, 5, 5}, [&](VtkhdfWriter &w) {
        const std::vector<double> times = {0.0, 0.1, what.end};
        w.steps(times);
        w.field(
            "velocity", 3,
            [&](const double *x, double t, double *u) {
              u[0] = x[0] == 0.0 && t == what.end ? what.speed : 1.0;
            },
            times);
        if (what.distance)
          w.field("distance", 1, [](const double *x, double, double *s) {
            s[0] = x[1] + 1.0;
          });
      });
    };
    const TemporaryFile first("apf_first_node"), other("apf_last_node");
    write(first, {5, 0.3, 1.0, true});
    write(other, last);
    Simulation sim;
    return sim.error_of(many() + "fix flow all flow/field file " +
                        (me == ranks - 1 ? other : first).path + " outside clamp" + fluid +
                        "fix drag all flow/force flow drag stokes\nrun 25");
  };
  EXPECT_EQ(error_where_the_last_node_has({5, 0.3, 1.0, true}), "");
  if (ranks == 1) return;
  for (const Contents &last : {Contents{6, 0.3, 1.0, true}, Contents{5, 0.35, 1.0, true},
                               Contents{5, 0.3, 1.5, true}, Contents{5, 0.3, 1.0, false}}) {
    const auto error = error_where_the_last_node_has(last);
    EXPECT_NE(error.find("the nodes of this machine have different files of this name"),
              std::string::npos)
        << error;
  }
}

TEST(RanksFlowFile, errors_of_files_are_those_of_all_ranks)
{
  Simulation sim;
  sim.run(many());
  const auto error = sim.error_of("fix f all flow/field file none.vtkhdf" + fluid);
  EXPECT_NE(error.find("none.vtkhdf: cannot be opened"), std::string::npos) << error;
}
