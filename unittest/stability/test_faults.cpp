// Scenes at the edge of sense: none or one particle, ranks without any, a step of 0, a ratio of
// sizes of 1000, particles that get lost. A result that is right, or an error that says why there
// is none.

#include "criterion.h"
#include "fuzz/child.h"
#include "scenes.h"
#include "temporary_file.h"

#include <array>
#include <fstream>
#include <iostream>

namespace {

const std::string wall = "fix wall all wall/levelset plane x 0 NULL" + jkr + all_friction + "\n";
// with an inlet through which no whole sphere comes in any of these tests
std::string everything_with(const std::string &keywords)    // of fix flow/force
{
  return wall +
      "fix air all flow/field shear x y 1.0 0.0 density 1e-3 viscosity 1e-3\n"
      "fix in all inlet/flow x 4.0 air concentration 1e-6 diameter 1.0 density 1.0 type 1 seed 7\n"
      "fix c all flow/concentration 8 8 8 cloud 1.0 method direct\n"
      "fix drag all flow/force air drag stokes torque yes concentration c feedback yes " +
      keywords +
      "\ncompute clumps all aggregate/contact\n"
      "thermo_style custom step ke f_wall[7] f_in[1] f_c[1] f_drag[25] c_clumps[1] c_clumps[2]\n";
}
const std::string everything = everything_with("");

const std::vector<std::string> integrators = {
    "fix nve all nve/sphere\n", "fix nve all nve/sphere\nrun_style respa 2 10 pair 1\n", mts(10),
    "fix nve all nve/sphere/mts collision auto\n",
    "fix nve all nve/sphere/mts collision tolerance 0.01\n"};

TEST(RanksFaults, no_particles)
{
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {}, beside_a_wall());
    sim.run(everything + integrator + "run 5");
    for (const char *none :
         {"f_wall[7]", "f_in[1]", "f_c[1]", "f_c[2]", "f_drag[25]", "c_clumps[2]"})
      EXPECT_EQ(sim.value(none), 0.0) << none << " " << integrator;
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
    EXPECT_NEAR(gather(sim, "v")[0] / (4.0 * -std::expm1(-t / tau)), 1.0, 1e-6) << integrator;
    EXPECT_NEAR(sim.value("f_c[1]"), pi / 6.0, 1e-12) << "volume of its cloud";
    EXPECT_NEAR(sim.value("f_drag[25]/f_drag[1]"), -1.0, 1e-12) << "force on the fluid";
    EXPECT_EQ(sim.value("f_in[1]"), 0.0);
  }
}

TEST(RanksFaults, step_of_zero_moves_nothing)
{
  for (const auto &integrator : integrators) {
    Simulation sim;
    build(sim, {{0.495, 4.0, 4.0}, {1.48, 4.1, 4.0}}, beside_a_wall());
    set_motion(sim, 2, {1.0, 2.0, 3.0}, {3.0, 2.0, 1.0});
    sim.run(everything_with("brownian 0.5 4711") + integrator + "timestep 0.0\nrun 0");
    auto before = state_of(sim);
    sim.run("run 1");    // before it r-RESPA shows forces of its outer level alone
    before.f = gather(sim, "f");
    before.torque = gather(sim, "torque");
    sim.run("run 5");
    const auto after = state_of(sim);
    SCOPED_TRACE(integrator);
    expect_same(after, before, 1e-15);
    EXPECT_EQ(sim.value("f_in[1]"), 0.0);
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

TEST(RanksFaults, lost_particles_end_the_run)
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
// smaller ones it would (ThinBoxes).
TEST(RanksFaults, box_smaller_than_the_cutoff)
{
  for (const auto &integrator : integrators) {
    Scene scene;
    scene.box = "0 1.5 0 1.5 0 1.5";
    scene.processors = "1 1 *";
    Simulation sim;
    build(sim, {{0.5, 0.5, 0.5}}, scene);
    EXPECT_EQ(sim.error_of("neighbor 2.0 bin\n" + integrator + "run 20"), "");
    EXPECT_EQ(largest(gather(sim, "f")), 0.0);
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
  const TemporaryFile other("apf_replacing");
  other.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, steady(5.0));
  if (TemporaryFile::rank() == 0)
    std::filesystem::copy_file(other.path, file.path,
                               std::filesystem::copy_options::overwrite_existing);
  MPI_Barrier(MPI_COMM_WORLD);
  sim.run("run 10");
  EXPECT_NEAR(gather(sim, "v")[0], 2.0, 1e-6) << "written anew";
  if (TemporaryFile::rank() == 0) std::filesystem::rename(other.path, file.path);
  MPI_Barrier(MPI_COMM_WORLD);
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

// The third frame of a series is read when it is due; the file is another by then, or cut off. None
// of what is there now becomes a velocity.
TEST(RanksFaults, series_changed_in_mid_run)
{
  namespace fs = std::filesystem;
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
  const std::string touched = "touched", half = "half of it", empty = "empty",
                    written = "written anew", renamed = "another by its name",
                    set_back = "written anew, its time set back", linked = "a link more",
                    guarded = "other permissions";
  for (const auto &change : {touched, half, empty, written, renamed, set_back, linked, guarded}) {
    const TemporaryFile file("apf_series"), other("apf_other_series");
    file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, series(2.0));
    other.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, series(5.0));
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}});
    sim.run("fix air all flow/field file " + file.path +
            " density 1e-3 viscosity 1e4\ntimestep 0.01\n"
            "fix drag all flow/force air drag stokes\nfix nve all nve/sphere\nrun 5");
    MPI_Barrier(MPI_COMM_WORLD);
    if (TemporaryFile::rank() == 0) {
      if (change == touched)
        fs::last_write_time(file.path, fs::file_time_type::clock::now());
      else if (change == half || change == empty)
        fs::resize_file(file.path, change == half ? fs::file_size(file.path) / 2 : 0);
      else if (change == linked)
        fs::create_hard_link(file.path, other.path + ".link");
      else if (change == guarded)
        fs::permissions(file.path, fs::perms::owner_write, fs::perm_options::remove);
      else if (change == written || change == set_back) {
        const auto before = fs::last_write_time(file.path);
        fs::copy_file(other.path, file.path, fs::copy_options::overwrite_existing);
        if (change == set_back) fs::last_write_time(file.path, before);
      } else
        fs::rename(other.path, file.path);
    }
    MPI_Barrier(MPI_COMM_WORLD);
    const auto said = sim.error_of("run 20");
    if (change == linked || change == guarded) {    // the numbers are what they were
      if (TemporaryFile::rank() == 0) fs::remove(other.path + ".link");
      EXPECT_EQ(said, "") << change;
      continue;
    }
    EXPECT_NE(said.find(file.path), std::string::npos) << change << ": " << said;
    EXPECT_NE(said.find("was changed after it had been opened"), std::string::npos)
        << change << ": " << said;
    EXPECT_NEAR(gather(sim, "v")[0], 2.0, 1e-6) << change;
  }
}

// What LAMMPS says, in a process of its own, of a flow whose file has these bytes from `place` on.
fuzz::Ended said_of_damaged(const TemporaryFile &file, std::streamoff place,
                            const std::string &bytes)
{
  {
    std::fstream damaged(file.path, std::ios::binary | std::ios::in | std::ios::out);
    damaged.seekp(place);
    damaged << bytes;
  }
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}});
  const auto work = [&](int out) {
    dup2(out, 2);
    std::cerr << sim.error_of("fix air all flow/field file " + file.path +
                              " density 1e-3 viscosity 1");
    return 0;
  };
  return fuzz::in_child(work, 60, RLIM_INFINITY);
}

void write_flow(const TemporaryFile &file, bool variable_text)
{
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, [&](VtkhdfWriter &w) {
    w.text("Type", "ImageData", variable_text);
    w.field("velocity", 3, [](const double *, double, double *u) {
      u[0] = 1.0;
    });
  });
}

// HDF5 1.10 follows the address of a list of names to nowhere. It may crash, but not without a line
// that names the file.
TEST(Faults, file_at_which_hdf5_crashes_is_named)
{
  const TemporaryFile file("apf_crash");
  write_flow(file, false);
  // addresses of the tree and of the names of the root
  const auto ended = said_of_damaged(file, 0x78, std::string(16, '\xff'));
  EXPECT_NE(ended.text.find("Fix flow/field file " + file.path + ": "), std::string::npos)
      << ended.death << ended.text;
}

// A text of variable length is in a heap of the file, where HDF5 1.10 goes from object to object.
// If one that is free says that it has no length, it stays there: 20 s of the processor.
TEST(Faults, file_at_which_hdf5_reads_without_an_end_is_named)
{
  const TemporaryFile file("apf_hang");
  write_flow(file, true);
  {
    Simulation sim;    // as it was written it is right
    build(sim, {{4.0, 4.0, 4.0}});
    sim.run("fix air all flow/field file " + file.path + " density 1e-3 viscosity 1");
  }
  std::ifstream written(file.path, std::ios::binary);
  const std::string all{std::istreambuf_iterator<char>(written), {}};
  const auto heap = all.find("GCOL"), text = all.find("ImageData", heap);
  ASSERT_NE(text, std::string::npos);
  // behind the text, filled up to 16 bytes, there is the free rest of the heap: 0, 0, 0, its length
  const auto ended = said_of_damaged(file, text + 16 + 8, std::string(8, '\0'));
  EXPECT_NE(ended.text.find("Fix flow/field file " + file.path +
                            ": HDF5 works on this file for far longer than its size is worth"),
            std::string::npos)
      << ended.death << ended.text;
  EXPECT_EQ(ended.status, 1) << ended.death;
}

// In one corner, of a velocity or a distance, or in the last frame of a series.
TEST(RanksFaults, nan_in_a_field_is_refused)
{
  const auto in_corner = [](const double *x) {
    return x[0] > 7.0 && x[1] > 7.0 && x[2] > 7.0;
  };
  const std::string flow = "flow/field file ", fluid = " density 1e-3 viscosity 1";
  for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL})
    for (const std::string what : {"velocity", "distance", "velocity in the last frame"}) {
      SCOPED_TRACE(what);
      const bool wall = what == "distance", late = what.size() > 10;
      const TemporaryFile file("apf_nan");
      file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 4}, [&](VtkhdfWriter &w) {
        std::vector<double> times;
        if (late) times = {0.0, 1.0, 2.0};
        if (late) w.steps(times);
        w.field(
            wall ? "distance" : "velocity", wall ? 1 : 3,
            [&](const double *x, double t, double *u) {
              u[0] = in_corner(x) && (!late || t == 2.0) ? bad : wall ? x[2] - 1.0 : 1.0;
            },
            times);
      });
      Simulation sim;
      build(sim, {{4.0, 4.0, 4.0}});
      const std::string error =
          sim.error_of("fix a all " +
                       (wall ? "wall/levelset file " + file.path + jkr : flow + file.path + fluid) +
                       "\nfix nve all nve/sphere\ntimestep 1\nrun 3");
      EXPECT_NE(error.find(what.substr(0, 8)), std::string::npos) << error;
      EXPECT_NE(error.find(file.path), std::string::npos) << error;
    }
}

TEST(RanksFaults, absurd_parameters_are_named)
{
  Scene scene;
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  const std::vector<std::array<std::string, 2>> table = {
      {"jkr -1 0.25 1", "Young's modulus E must be > 0, got -1"},
      {"jkr 1e6 0.9 1", "Poisson's ratio nu must be in (-1, 0.5], got 0.9"},
      {"jkr 1e6 0.25 -1", "surface energy gamma must be >= 0, got -1"},
      {"jkr nan 0.25 1", "Young's modulus E must be a number > 0, got nan"},
      {"jkr 1e6 0.25 1 sliding -0.1", "sliding mu must be >= 0, got -0.1"},
      {"jkr 1e6 0.25 1 damping tsuji 2", "damping tsuji restitution must be in (0, 1], got 2"},
  };
  for (const auto &[law, why] : table) {
    const auto error = sim.error_of("pair_coeff * * " + law);
    EXPECT_NE(error.find("Pair granular/adhesive " + why), std::string::npos) << law << error;
  }
}

}    // namespace
