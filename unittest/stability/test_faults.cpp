// Scenes at the edge of sense: none or one particle, ranks without any, a step of 0, a ratio of
// sizes of 1000, particles that get lost. A result that is right, or an error that says why there
// is none.

#include "criterion.h"
#include "scenes.h"

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

// LAMMPS adds images for boxes that are smaller than the cut-off: a sphere touches its own image
TEST(RanksFaults, box_smaller_than_the_cutoff)
{
  Scene scene;
  scene.box = "0 1.5 0 1.5 0 1.5";
  scene.processors = "1 1 *";
  Simulation sim;
  build(sim, {{0.5, 0.5, 0.5}}, scene);
  const std::string error = sim.error_of("neighbor 2.0 bin\nfix nve all nve/sphere\nrun 2");
  if (error.empty()) {
    EXPECT_EQ(largest(gather(sim, "f")), 0.0);
  } else {
    EXPECT_NE(error.find("too far"), std::string::npos) << error;
  }
}

}    // namespace
