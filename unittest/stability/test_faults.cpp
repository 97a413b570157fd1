// Scenes at the edge of sense: none or one particle, ranks without any, a step of 0, a ratio of
// sizes of 1000, particles that get lost. A result that is right, or an error that says why there
// is none.

#include "criterion.h"
#include "scenes.h"
#include "temporary_file.h"

namespace {

const std::string wall = "fix wall all wall/levelset plane x 0 NULL" + jkr + all_friction + "\n";
const std::string everything = wall +
    "fix air all flow/field shear x y 1.0 0.0 density 1e-3 viscosity 1e-3\n"
    "fix drag all flow/force air drag stokes torque yes\n"
    "compute clumps all aggregate/contact\n"
    "thermo_style custom step ke f_wall[7] c_clumps[1] c_clumps[2]\n";

// fix nve/sphere and fix nve/sphere/mts
const std::vector<std::string> integrators = {"fix nve all nve/sphere\n", mts(10)};

Scene beside_a_wall()
{
  Scene scene;
  scene.boundary = "f p p";
  return scene;
}

TEST(RanksFaults, no_particles)
{
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {}, beside_a_wall());
    sim.run(everything + integrator + "run 5");
    EXPECT_EQ(sim.value("f_wall[7]"), 0.0);
    EXPECT_EQ(sim.value("c_clumps[2]"), 0.0);
  }
}

// on more than one rank the others have none; the sphere relaxes towards the speed of the fluid to
// second order in the step, dt/tau = 1e-6 and 1e-5
TEST(RanksFaults, one_particle)
{
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{3.0, 4.0, 4.0}}, beside_a_wall());
    sim.run(everything + integrator + "run 10");
    const double t = 10.0 * sim.lammps()->update->dt, tau = pi / 6.0 / (3.0 * pi * 1e-3);
    EXPECT_NEAR(gather(sim, "v")[0] / (4.0 * -std::expm1(-t / tau)), 1.0, 1e-6);
  }
}

TEST(RanksFaults, step_of_zero_moves_nothing)
{
  for (const std::string integrator :
       {"fix nve all nve/sphere\n", "fix nve all nve/sphere/mts collision 10\n",
        "fix nve all nve/sphere/mts collision auto\n"}) {
    Simulation sim;
    build(sim, {{0.495, 4.0, 4.0}, {1.48, 4.1, 4.0}}, beside_a_wall());
    set_motion(sim, 2, {1.0, 2.0, 3.0}, {3.0, 2.0, 1.0});
    sim.run(everything + integrator + "timestep 0.0\nrun 0");
    const auto before = state_of(sim);
    sim.run("run 5");
    const auto after = state_of(sim);
    expect_same(after, before, 1e-15);
  }
}

// a large and a small sphere, held at an overlap: the force of a wall with R = r/(1 + 1/ratio)
TEST(RanksFaults, size_ratio_of_a_thousand)
{
  for (const double ratio : {100.0, 1000.0}) {
    const double d = 1.0 / ratio, overlap = 0.005 * d;
    const JkrCurve curve = Material().pair(1.0, d);
    Scene scene;
    scene.style = "pair_style granular/adhesive\npair_coeff * * jkr 1.0e9 0.25 100.0\n";
    const JkrCurve stiff{curve.R, 1e3 * curve.E, curve.gamma};
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.0 + 0.5 * (1.0 + d) - overlap, 4.0, 4.0, d}}, scene);
    sim.run("fix nve all nve/sphere\ntimestep 1e-9\nrun 0");
    expect_criterion("C8 verlet: force at a size ratio of 100, 1000 over that of the wall",
                     -gather(sim, "f")[0] / stiff.force(overlap), 0.999, 1.001);
  }
}

TEST(RanksFaults, lost_particles_are_named_by_lammps)
{
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{7.0, 4.0, 4.0}}, beside_a_wall());
    set_motion(sim, 1, {1e4, 0.0, 0.0}, {0.0, 0.0, 0.0});
    EXPECT_NE(sim.error_of(wall + integrator + "thermo 1\nrun 100").find("Lost atoms"),
              std::string::npos);
  }
}

// A box of 1.5 with a cut-off of more: a sphere sees its own images, and does not touch them. In
// one of 0.99 it touches them on all sides, with no force.
TEST(RanksFaults, box_smaller_than_the_cutoff)
{
  for (const double size : {1.5, 0.99})
    for (const auto &integrator : integrators) {
      Scene scene;
      const std::string range = "0 " + digits(size) + " ";
      scene.box = range + range + range;
      scene.processors = "1 1 *";
      Simulation sim;
      build(sim, {{0.5, 0.5, 0.5}}, scene);
      EXPECT_EQ(sim.error_of("neighbor 2.0 bin\n" + integrator + "run 20"), "") << size;
      EXPECT_LT(largest(gather(sim, "f")), 1e-9);
      EXPECT_NEAR(gather(sim, "x")[0], 0.5, 1e-12);
    }
}

// A flow file is read once: what happens to it later does not matter to the run
TEST(RanksFaults, flow_file_replaced_in_mid_run)
{
  const auto steady = [](double speed) {
    return [speed](VtkhdfWriter &w) {
      w.field("velocity", 3, [speed](const double *, double, double *u) {
        u[0] = speed;
      });
    };
  };
  TemporaryFile file("apf_replaced");
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, steady(2.0));
  Scene scene;
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  sim.run("fix air all flow/field file " + file.path +
          " density 1e-3 viscosity 1e4\n"
          "fix drag all flow/force air drag stokes\nfix nve all nve/sphere\nrun 10");
  EXPECT_NEAR(gather(sim, "v")[0], 2.0, 1e-6);
  MPI_Barrier(MPI_COMM_WORLD);
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, steady(5.0));
  sim.run("run 10");
  EXPECT_NEAR(gather(sim, "v")[0], 2.0, 1e-6) << "replaced";
  MPI_Barrier(MPI_COMM_WORLD);
  if (TemporaryFile::rank() == 0) std::filesystem::resize_file(file.path, 100);
  MPI_Barrier(MPI_COMM_WORLD);
  sim.run("run 10");
  EXPECT_NEAR(gather(sim, "v")[0], 2.0, 1e-6) << "truncated";
  // and a truncated one is refused
  const auto said =
      sim.error_of("fix other all flow/field file " + file.path + " density 1e-3 viscosity 1e4");
  EXPECT_NE(said.find(file.path), std::string::npos) << said;
}

// The third frame of a series is read when it is due; the file is another by then
TEST(RanksFaults, series_changed_in_mid_run)
{
  const std::vector<double> times = {0.0, 0.1, 0.2, 0.3};
  const auto series = [&](double speed) {
    return [&times, speed](VtkhdfWriter &w) {
      w.steps(times);
      w.field(
          "velocity", 3,
          [speed](const double *, double, double *u) {
            u[0] = speed;
          },
          times);
    };
  };
  TemporaryFile file("apf_series");
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, series(2.0));
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  sim.run("fix air all flow/field file " + file.path +
          " density 1e-3 viscosity 1e4\ntimestep 0.01\n"
          "fix drag all flow/force air drag stokes\nfix nve all nve/sphere\nrun 5");
  MPI_Barrier(MPI_COMM_WORLD);
  if (TemporaryFile::rank() == 0)
    std::filesystem::last_write_time(file.path, std::filesystem::file_time_type::clock::now());
  MPI_Barrier(MPI_COMM_WORLD);
  const auto said = sim.error_of("run 20");
  EXPECT_NE(said.find("was changed after it had been opened"), std::string::npos) << said;
}

TEST(RanksFaults, nan_in_a_field_is_refused)
{
  TemporaryFile file("apf_nan");
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, [](const double *x, double, double *u) {
      u[0] = x[0] > 7.0 && x[1] > 7.0 && x[2] > 7.0 ? std::nan("") : 1.0;
    });
  });
  Scene scene;
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  const std::string error =
      sim.error_of("fix air all flow/field file " + file.path + " density 1e-3 viscosity 1\nrun 0");
  EXPECT_NE(error.find("velocity"), std::string::npos) << error;
  EXPECT_NE(error.find(file.path), std::string::npos) << error;
}

TEST(RanksFaults, absurd_parameters_are_named)
{
  Scene scene;
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  for (const std::string law :
       {"jkr -1 0.25 1", "jkr 1e6 0.9 1", "jkr 1e6 0.25 -1", "jkr nan 0.25 1",
        "jkr 1e6 0.25 1 sliding -0.1", "jkr 1e6 0.25 1 damping tsuji 2"})
    EXPECT_NE(sim.error_of("pair_coeff * * " + law).find("granular/adhesive"), std::string::npos)
        << law;
}

// A device that is full: the restart ends with an error that names the file
TEST(Faults, restart_to_a_full_disk_is_an_error)
{
  if (!std::filesystem::exists("/dev/full")) GTEST_SKIP() << "no /dev/full";
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  sim.run("fix nve all nve/sphere\nrun 0");
  EXPECT_NE(sim.error_of("write_restart /dev/full"), "");
}

}    // namespace
