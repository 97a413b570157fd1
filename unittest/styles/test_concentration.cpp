// fix flow/concentration and the feedback of fix flow/force. Facts: volumes and momentum are
// conserved, closed form of one cloud, a uniform crowd, the same on any number of ranks.

#include "concentration_scene.h"
#include "criterion.h"
#include "fuzz/child.h"

#include <array>

TEST(Concentration, one_cloud_is_a_gaussian)
{
  // mean over a cell of V exp(-r^2/R^2)/(pi^3/2 R^3), here at the corner of eight cells of 0.25
  const double R = 0.8, h = 0.25;
  Simulation sim;
  sim.run(one("5.0 5.0 5.0") + "fix c all flow/concentration 40 40 40 cloud 0.8\n");
  const auto c = dumped(sim, "f_c:grid:data", scratch_file("cloud"));
  ASSERT_EQ(c.size(), 64000u);
  const double V = pi / 6.0 * 0.064;
  for (int cell : {20, 21, 25, 30}) {
    auto mean = [&](double a) {
      return 0.5 * (std::erf((a + h) / R) - std::erf(a / R)) / h;
    };
    const double expected = V * mean((cell - 20) * h) * mean(0.0) * mean(0.0);
    EXPECT_NEAR(c[(20 * 40 + 20) * 40 + cell] / V, expected / V, 1e-7);
    EXPECT_NEAR(c[(20 * 40 + 20) * 40 + 39 - cell] / V, expected / V, 1e-7);
  }
  // second moment R^2/2 along x, and h^2/12 for the cells
  double moment = 0.0;
  for (int k = 0; k < 64000; k++) {
    const double x = (k % 40 + 0.5) * h - 5.0;
    moment += c[k] * h * h * h / V * x * x;
  }
  EXPECT_NEAR(moment, 0.5 * R * R + h * h / 12.0, 1e-5);
  std::filesystem::remove(scratch_file("cloud"));
}

TEST(Concentration, a_lattice_of_particles_is_uniform)
{
  Simulation sim;
  sim.run("units lj\natom_style sphere\nlattice sc 1.0\nregion box block 0 10 0 10 0 10\n"
          "create_box 1 box\ncreate_atoms 1 box\nset type 1 diameter 0.5 density 1\n"
          "pair_style zero 1.0 nocoeff\npair_coeff * *\nneighbor 0.4 bin\nfix move all nve/sphere\n"
          "fix c all flow/concentration 20 20 20 cloud 1.2\nrun 0\n");
  // the first harmonic of the lattice is left with exp(-pi^2 R^2 / a^2) = 7e-7
  EXPECT_NEAR(sim.value("f_c[2]") / (pi / 6.0 * 0.125), 1.0, 1e-5);
  EXPECT_NEAR(sim.value("f_c[1]") / (1000.0 * pi / 6.0 * 0.125), 1.0, 1e-12);
}

TEST(RanksConcentration, holds_the_volume_of_all_particles)
{
  for (const std::string &boundary :
       {std::string("p p p"), std::string("f p p"), std::string("f f f")}) {
    Simulation sim;
    sim.run(crowd(boundary) +
            "fix c all flow/concentration 20 16 9 cloud 0.6\n"
            "velocity all create 1.0 99 loop geom\nrun 0\n");
    EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12) << boundary;
    if (boundary != "p p p") continue;
    sim.run("run 50\n");
    EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12) << "after particles moved";
    sim.run("comm_style tiled\nbalance 1.0 rcb\nrun 20\n");
    EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12) << "after rcb";
  }
}

TEST(RanksConcentration, walls_return_what_would_fall_outside)
{
  Simulation sim;
  std::string scene = crowd("f p p");
  const std::string none = "pair_style zero 0.5 nocoeff\npair_coeff * *";
  scene.replace(scene.find(none), none.size(),
                "pair_style granular/adhesive\npair_coeff * * jkr 1e4 0.3 0");
  sim.run(scene +
          "fix wall all wall/levelset cylinder x 4 3 3.9 inside jkr 1e4 0.3 0\n"
          "region outer cylinder x 4 3 3.5 INF INF side out\ndelete_atoms region outer "
          "compress yes\nfix c all flow/concentration 20 16 12 cloud 0.6\nrun 0\n");
  ASSERT_GT(sim.value("atoms"), 50.0);
  EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12);
  const auto c = dumped(sim, "f_c:grid:data", scratch_file("walls"));
  int outside = 0;
  for (size_t k = 0; k < c.size(); k++) {
    const double y = (k / 20 % 16 + 0.5) * 0.5 - 4.0, z = (k / 320 + 0.5) * 0.5 - 3.0;
    if (y * y + z * z < 3.9 * 3.9) continue;
    outside++;
    EXPECT_EQ(c[k], 0.0);
  }
  EXPECT_GT(outside, 100);
  if (number_of_ranks() == 1) std::filesystem::remove(scratch_file("walls"));
}

TEST(RanksConcentration, does_not_depend_on_ranks)
{
  const std::string scene = crowd("p f p") +
      "fix c all flow/concentration 20 16 12 cloud 0.5 every 5\n"
      "velocity all create 1.0 99 loop geom\n"
      "fix air all flow/field uniform 0.1 0 0 density 1 viscosity 1\n"
      "fix drag all flow/force air drag difelice concentration c\n";
  std::vector<double> alone;
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(scene + "run 37\n");
    for (int tag = 1; tag <= 200; tag++) {
      const double *x = sim.lammps()->atom->x[sim.lammps()->atom->map(tag)];
      alone.insert(alone.end(), x, x + 3);
    }
  }
  Simulation sim;
  sim.run(scene + "run 37\n");
  EXPECT_LT(difference(gather(sim, "x"), alone), 1e-12);
}

TEST(Concentration, a_restart_goes_on_as_the_run_would_have)
{
  const std::string file = scratch_file("restart");
  const std::string fixes = "fix c all flow/concentration 20 16 12 cloud 0.5 every 5\n"
                            "fix air all flow/field uniform 0.1 0 0 density 1 viscosity 1\n"
                            "fix drag all flow/force air drag difelice concentration c\n";
  std::vector<double> straight;
  double largest = 0.0;
  {
    Simulation sim;
    sim.run(crowd("p f p") + fixes + "velocity all create 1.0 99 loop geom\nrun 20\n" +
            "write_restart " + file + "\nrun 17\n");
    straight = gather(sim, "x");
    largest = sim.value("f_c[2]");
  }
  Simulation sim;
  sim.run("read_restart " + file +
          "\ncomm_modify vel yes\npair_style zero 0.5 nocoeff\npair_coeff * *\n"
          "fix move all nve/sphere\n" +
          fixes + "run 17\n");
  EXPECT_LT(difference(gather(sim, "x"), straight), 1e-12);
  EXPECT_NEAR(sim.value("f_c[2]") / largest, 1.0, 1e-12);
  EXPECT_GT(largest, 0.01);
  std::filesystem::remove(file);
}

TEST(Concentration, in_the_plane_a_particle_counts_in_a_slab_of_its_own_thickness)
{
  Simulation sim;
  sim.run("units lj\ndimension 2\natom_style sphere\nlattice sq 1.0\n"
          "region box block 0 10 0 10 -0.5 0.5\ncreate_box 1 box\ncreate_atoms 1 box\n"
          "set type 1 diameter 0.5 density 1\npair_style zero 1.0 nocoeff\npair_coeff * *\n"
          "neighbor 0.4 bin\nfix move all nve/sphere\nfix flat all enforce2d\n"
          "fix c all flow/concentration 20 20 1 cloud 1.2\nrun 0\n");
  EXPECT_NEAR(sim.value("f_c[2]") / (pi / 6.0 * 0.25), 1.0, 1e-5);
}

TEST(Concentration, hinders_settling)
{
  // a lattice of equal concentration: all settle with (1 - c)^3.7 of the free velocity
  Simulation sim;
  sim.run("units lj\natom_style sphere\nlattice sc 1.0\nregion box block 0 10 0 10 0 10\n"
          "create_box 1 box\ncreate_atoms 1 box\nset type 1 diameter 0.6 density 2\n"
          "pair_style zero 1.0 nocoeff\npair_coeff * *\nneighbor 0.4 bin\nfix move all nve/sphere\n"
          "fix air all flow/field uniform 0 0 0 density 1 viscosity 100\n"
          "fix c all flow/concentration 20 20 20 cloud 1.2\n"
          "fix drag all flow/force air drag difelice concentration c gravity 0 0 -1\n"
          "timestep 0.1\nrun 30\n");
  const double c = pi / 6.0 * 0.216, free = c * 1.0 / (3.0 * pi * 100.0 * 0.6);
  EXPECT_NEAR(-gather(sim, "v")[2] / free, std::pow(1.0 - c, 3.7), 1e-4);
}

// C24: clouds of a hundred spheres at one place add up to more than the whole volume. Drag is that
// of c = 0.64, the largest there is, 0.36^-3.7 of that of a sphere alone, and nothing where nothing
// slips.
const double dense_drag = 3.0 * pi * 1e4 * 0.4 * std::pow(0.36, -3.7);    // over the slip

TEST(Concentration, clouds_that_overlap_leave_drag_finite)
{
  Simulation sim;
  sim.run("units lj\natom_style sphere\natom_modify map array\nboundary p p p\n"
          "region box block 0 10 0 10 0 10\nregion heap sphere 5 5 5 0.1\ncreate_box 1 box\n"
          "create_atoms 1 random 100 4711 heap\nset type 1 diameter 0.4 density 1\n"
          "pair_style zero 0.5 nocoeff\npair_coeff * *\nneighbor 0.4 bin\nfix move all nve/sphere\n"
          "fix air all flow/field uniform 1 2 0 density 1 viscosity 1e4\n"
          "fix c all flow/concentration 40 40 40 cloud 0.8\n"
          "fix drag all flow/force air drag difelice concentration c torque yes lift saffman "
          "magnus yes\ntimestep 1e-12\nrun 0\n");
  EXPECT_GT(sim.value("f_c[2]"), 1.0) << "of the volume";
  const auto f = gather(sim, "f");
  for (size_t i = 0; i < f.size(); i += 3) {
    expect_criterion("C24 styles: drag in clouds of c > 1 over that at c = 0.64", f[i] / dense_drag,
                     0.999, 1.001);
    EXPECT_NEAR(f[i + 1] / f[i], 2.0, 1e-9);
    EXPECT_EQ(f[i + 2], 0.0) << "no lift";
  }
  sim.run("velocity all set 1 2 0\nrun 0\n");
  expect_criterion("C24 styles: largest force without slip in clouds of c > 1",
                   largest(gather(sim, "f")), 0.0, 0.0);
  EXPECT_EQ(largest(gather(sim, "torque")), 0.0);
}

// Clouds narrower than their spheres: c > 1 without contacts. In steps of a tenth of the time of
// relaxation, and in ones far longer.
TEST(Concentration, spheres_in_clouds_too_narrow_move_as_drag_says)
{
  const double tau = pi / 6.0 * 0.064 / dense_drag;
  const std::pair<std::string, std::string> integrators[] = {
      {"verlet", "fix move all nve/sphere\n"},
      {"respa", "fix move all nve/sphere\nrun_style respa 2 4 pair 1\n"},
      {"mts", "fix move all nve/sphere/mts collision 4\n"}};
  for (const auto &[name, commands] : integrators)
    for (const auto &[of_tau, steps] : {std::pair(0.1, 20), std::pair(1e6, 4)}) {
      Simulation sim;
      sim.run("units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
              "boundary p p p\nregion box block 0 2 0 2 0 2\ncreate_box 1 box\n"
              "create_atoms 1 single 0.5 0.6 0.7\ncreate_atoms 1 single 1.5 1.4 1.6\n"
              "set type 1 diameter 0.4 density 1\n" +
              pair_of(jkr) +
              "neighbor 0.4 bin\nfix air all flow/field uniform 1 2 0 density 1 viscosity 1e4\n"
              "fix c all flow/concentration 40 40 40 cloud 0.16\n"
              "fix drag all flow/force air drag difelice concentration c torque yes lift saffman "
              "magnus yes\n" +
              commands + "timestep " + digits(of_tau * tau) + "\nrun " + std::to_string(steps));
      EXPECT_GT(sim.value("f_c[2]"), 1.0) << "of the volume";
      const auto v = gather(sim, "v");
      double differ = 0.0;
      for (size_t i = 0; i < v.size(); i += 3)
        differ = std::max({differ, std::fabs(v[i] + std::expm1(-steps * of_tau)),
                           std::fabs(v[i + 1] - 2.0 * v[i]), std::fabs(v[i + 2])});
      expect_criterion("C24 " + name + ": error of velocities after " + std::to_string(steps) +
                           " steps of " + (of_tau < 1.0 ? "0.1" : "1e6") +
                           " tau in clouds of c > 1, of the flow's",
                       differ, 0.0, 1e-3);
    }
}

TEST(Concentration, other_commands_read_the_grid)
{
  Simulation sim;
  sim.run(crowd("p p p") +
          "fix c all flow/concentration 10 8 6 cloud 0.6\n"
          "fix mean all ave/grid 1 1 1 10 8 6 f_c:grid:data\nrun 10\n");
  const auto c = dumped(sim, "f_mean:grid:data", scratch_file("mean"));
  double sum = 0.0;
  for (double value : c) sum += value;
  EXPECT_EQ(c.size(), 480u);
  EXPECT_NEAR(sum / volume(sim), 1.0, 1e-9);
  std::filesystem::remove(scratch_file("mean"));
}

TEST(RanksFeedback, what_particles_get_the_fluid_loses)
{
  for (const std::string &boundary : {std::string("p p p"), std::string("f p f")}) {
    Simulation sim;
    sim.run(crowd(boundary) +
            "velocity all create 1e-4 99 loop geom\n"
            "fix air all flow/field shear y x 0.5 0 density 0.3 viscosity 1\n"
            "fix drag all flow/force air drag schiller torque yes gravity 0 0 -1 lift saffman "
            "added_mass yes pressure yes feedback 10 8 6\nrun 23\n");
    double largest = 0.0;
    for (int c = 0; c < 3; c++) {
      const auto at = [&](int k) {
        return sim.value("f_drag[" + std::to_string(k + c) + "]");
      };
      // all that was added to particles, less their weight, and the force on the grid: nothing
      EXPECT_NEAR(at(22) - at(4) + at(25), 0.0, 1e-12 * std::fabs(at(1))) << boundary;
      largest = std::max(largest, std::fabs(at(25)));
    }
    EXPECT_GT(largest, 0.1);
  }
}

TEST(Feedback, force_is_shared_among_the_nodes_around)
{
  // at a quarter between two centres: 3/4 and 1/4 along x; on a centre along y and z
  Simulation sim;
  sim.run(one("4.75 4.5 4.5") +
          "fix hold all setforce 0 0 0\n"
          "fix air all flow/field uniform 1 0 0 density 1 viscosity 1\n"
          "fix drag all flow/force air drag stokes feedback 10 10 10\n"
          "timestep 1e-9\n");
  const auto b = dumped(sim, "f_drag:grid:data[1]", scratch_file("nodes"));
  ASSERT_EQ(b.size(), 1000u);
  const double force = 3.0 * pi * 0.4;
  EXPECT_NEAR(b[(4 * 10 + 4) * 10 + 4] / force, -0.75, 1e-6);
  EXPECT_NEAR(b[(4 * 10 + 4) * 10 + 5] / force, -0.25, 1e-6);
  double rest = 0.0;
  for (double value : b) rest += std::fabs(value);
  EXPECT_NEAR(rest / force, 1.0, 1e-6);
  std::filesystem::remove(scratch_file("nodes"));
}

TEST(ConcentrationErrors, name_what_is_wrong)
{
  const std::vector<std::array<std::string, 2>> rows = {
      {"fix c all flow/concentration 10 10", "missing argument"},
      {"fix c all flow/concentration 0 1 1 cloud 1", "must be >= 1, got 0"},
      {"fix c all flow/concentration 9 9 9 cloud 0", "cloud radius must be > 0, got 0"},
      {"fix c all flow/concentration 9 9 9 cloud 2", "cloud must be <= 1.25"},
      {"fix c all flow/concentration 9 9 9 every 0", "every must be >= 1, got 0"},
      {"fix c all flow/concentration 9 9 9 every 2", "requires keyword cloud"},
      {"fix c all flow/concentration 9 9 9 blob 2", "must be cloud, every or method, got blob"},
      {"fix c all flow/concentration 9 9 9 method dft", "must be auto, direct or fft, got dft"},
      {"fix c all flow/concentration 25 25 25 cloud 2 method direct", "cloud must be <= 1.25"},
#ifdef APF_FFTW
      {"fix c all flow/concentration 25 9 9 cloud 1 method fft",
       "of at least 2.6 widths of a cell along each axis, 2.889 for cells of 1.111 (25 9 9 of "
       "them), got 1"},
#endif
      {"fix d all flow/force air drag difelice concentration q", "fix q does not exist"},
      {"fix d all flow/force air drag difelice concentration air", "got flow/field"},
      {"fix d all flow/force air drag stokes feedback yes", "takes the grid of fix"},
      {"fix d all flow/force air drag stokes feedback maybe", "got maybe"},
      {"fix d all flow/force air drag stokes feedback 3 0 1", "must be >= 1, got 0"}};
  for (const auto &row : rows) {
    Simulation sim;
    sim.run(one("5 5 5") + "fix air all flow/field uniform 1 0 0 density 1 viscosity 1\n");
    const auto text = sim.error_of(row[0]);
    EXPECT_NE(text.find(row[1]), std::string::npos) << row[0] << ": " << text;
  }
}

#ifdef APF_FFTW
// 2 Gbytes are too few for LAMMPS's lists of cells alone, whose own error names no command.
TEST(ConcentrationErrors, grids_for_which_there_is_no_memory_are_named)
{
  if (!fuzz::memory_is_bounded) GTEST_SKIP() << "the sanitizer's own memory is larger";
  Simulation sim;
  sim.run(one("5 5 5"));
  const auto ended = fuzz::in_child(
      [&](int out) {
        const auto text = sim.error_of("fix c all flow/concentration 40 1000000 40 cloud 0.8 "
                                       "method fft");
        return write(out, text.data(), text.size()) < 0;
      },
      20, rlim_t(2) << 30);
  EXPECT_NE(ended.text.find("Fix c flow/concentration: no memory for a grid of 40 x 1000000 x 40 "
                            "cells"),
            std::string::npos)
      << ended.death << ended.text;
}
#endif

// Cells of 1. A cloud of 1e-9 is a point in one of them; the volume there is still right.
TEST(ConcentrationErrors, a_cloud_that_is_small_for_its_cells_gives_a_warning)
{
  const auto log = [](const std::string &radius) {
    Simulation sim;
    sim.run(one("5.5 5.5 5.5"));
    auto text = log_of(sim, "fix c all flow/concentration 10 10 10 cloud " + radius + "\nrun 0\n");
    EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12);
    return text;
  };
  const std::string warning = "WARNING: Fix flow/concentration c: cloud ";
  for (const std::string radius : {"1e-09", "0.249"})
    EXPECT_NE(log(radius).find(warning + radius + " is small for cells that are 1 wide"),
              std::string::npos)
        << log(radius);
  EXPECT_EQ(log("0.251").find(warning), std::string::npos);
}
