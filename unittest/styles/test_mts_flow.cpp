// fix nve/sphere/mts with fix flow/force: particles that walls hold, roll and slide in shear flow.

#include "scenes.h"

namespace {

const double mass = pi / 6.0;    // of a sphere of diameter and density 1
const Material material;

Scene at_floor(const std::string &law)
{
  Scene scene;
  scene.boundary = "p p f";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n" +
      "fix wall all wall/levelset plane z 0 NULL" + law + "\n";
  return scene;
}

std::string fluid(const std::string &kind, double viscosity, const std::string &more = "")
{
  return "fix air all flow/field " + kind + " density 0.001 viscosity " + digits(viscosity) +
      "\nfix drag all flow/force air drag stokes " + more + "\n";
}

// The fluid pulls a held particle with 3 pi mu d u, however long the step is for the free one:
// tau = d^2 rho / (18 mu), steps of 0.1, 1 and 20 tau.
TEST(MtsFlow, held_particle_bears_the_full_drag)
{
  const double u = 1e-3, step = 64 * dt;
  for (const double ratio : {0.1, 1.0, 20.0}) {
    const double mu = ratio / (18.0 * step), force = 3.0 * pi * mu * u;
    Simulation sim;
    build(sim, {{4.0, 4.0, 0.5 - material.wall().delta_eq()}},
          at_floor(jkr + "damping tsuji 0.1 sliding 0.5 rolling 0.02 0.5"));
    sim.run(fluid("uniform " + digits(u) + " 0 0", mu) + mts(64) + "run 3600");
    EXPECT_LT(std::fabs(gather(sim, "v")[0]), 1e-6 * u) << ratio;
    EXPECT_NEAR(sim.value("f_wall[1]") / force, 1.0, 1e-4) << ratio;
    EXPECT_NEAR(sim.value("f_drag[1]") / force, 1.0, 1e-4) << ratio;
  }
}

// ... and stays where it is: at a quarter of the rolling limit an outer force makes nothing slip.
TEST(MtsFlow, held_particle_does_not_creep)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.4911}},
        at_floor(jkr + "damping tsuji 0.1 sliding 0.5 rolling 0.01 0.5"));
  sim.run("fix push all addforce 4.5 0 0\n" + mts(40) + "run 400");
  const double early = gather(sim, "x")[0];
  sim.run("run 400");
  EXPECT_LT(std::fabs(gather(sim, "x")[0] - early), 1e-7);
  EXPECT_GT(early, 4.0 + 1e-4);    // it hangs on its springs
}

// A free particle relaxes as exp(-t/tau) beside one that is held, with velocity Verlet's error.
TEST(RanksMtsFlow, free_particle_relaxes_beside_a_held_one)
{
  const double step = 64 * dt, tau = 4.0 * step;
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.5 - material.wall().delta_eq()}, {4.0, 4.0, 4.0}},
        at_floor(jkr + "damping tsuji 0.1 sliding 0.5 rolling 0.02 0.5"));
  sim.run(fluid("uniform 1e-3 0 0", 1.0 / (18.0 * tau)) + mts(64) + "run 12");
  EXPECT_NEAR(gather(sim, "v")[3] / (1e-3 * (1.0 - std::exp(-3.0))), 1.0, 1e-3);
  EXPECT_EQ(sim.value("f_nve[2]"), 0.5);
}

// The integrator is set up before the fluid's forces where it is defined before them.
TEST(MtsFlow, order_of_integrator_and_fluid_does_not_matter)
{
  const double d_eq = material.wall().delta_eq();
  const std::string air = fluid("shear x z 5 0", 0.5, "torque yes added_mass yes");
  auto end = [&](const std::string &fixes) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 0.5 - d_eq}, {4.0, 4.0, 4.0}},
          at_floor(jkr + "damping tsuji 0.1 sliding 0.5 rolling 0.02 0.5"));
    sim.run(fixes + "run 20\nrun 20");
    return state_of(sim);
  };
  const State after = end(air + mts(16)), before = end(mts(16) + air);
  EXPECT_EQ(before.x, after.x);
  EXPECT_EQ(before.v, after.v);
  EXPECT_GT(after.v[3], 1.0) << "the fluid has carried the free sphere along";
}

// ---------------------------------------------------------------------------------------------
// shear flow u = G z along the wall: below friction's limits the sphere rolls, above it slides too

struct Drive {
  std::string friction;
  double viscosity = 2.0, z = 0.5 - material.wall().delta_eq(), fall = 0.0;
};

State driven(const Drive &drive, const std::string &integrate, int steps)
{
  Simulation sim;
  build(sim, {{2.0, 4.0, drive.z}}, at_floor(jkr + "damping tsuji 0.5 " + drive.friction));
  set_motion(sim, 1, {0.0, 0.0, -drive.fall}, {0.0, 0.0, 0.0});
  sim.run("neighbor 1.0 bin\n" + fluid("shear x z 200 0", drive.viscosity, "torque yes") +
          integrate + "run " + std::to_string(steps));
  return state_of(sim);
}

const std::string verlet = "fix nve all nve/sphere\n";
const std::string respa =
    verlet + "run_style respa 2 16 pair 1\ntimestep " + digits(16 * dt) + "\n";

TEST(MtsFlow, sphere_in_shear_moves_as_with_verlet)
{
  const double arm = 0.5 - material.wall().delta_eq();
  for (const auto &[friction, least, most] : std::vector<std::tuple<std::string, double, double>>{
           {"sliding 5.0", 0.9999, 1.0001},
           {"sliding 0.1", 1.5, 2.0},
           {"sliding 0.5 rolling 0.0005 0.5", 1.0, 1.2}}) {
    SCOPED_TRACE(friction);
    const State fine = driven({friction}, verlet, 6400), levels = driven({friction}, mts(16), 400);
    EXPECT_LT(difference(levels.x, fine.x), 1e-10);
    EXPECT_LT(difference(levels.v, fine.v), 1e-10);
    EXPECT_LT(difference(levels.omega, fine.omega), 1e-10);
    EXPECT_LT(difference(driven({friction}, respa, 400).x, fine.x), 0.02);
    const double slip = levels.v[0] / (levels.omega[1] * arm);    // 1 without
    EXPECT_GT(slip, least);
    EXPECT_LT(slip, most);
  }
}

// The fluid's velocity is that of the particle step's begin: of first order where the sphere falls
// through the shear and lands.
TEST(RanksMtsFlow, landing_tends_to_verlet_as_steps_shrink)
{
  Drive drive{"sliding 0.3", 0.5, 1.5, 20.0};
  const State fine = driven(drive, "timestep " + digits(0.25 * dt) + "\n" + verlet, 4 * 2400);
  auto error = [&](int n) {
    return difference(driven(drive, mts(4 * n, 0.25 * dt), 2400 / n).x, fine.x);
  };
  EXPECT_LT(error(32), 3e-3);
  EXPECT_NEAR(error(32) / error(8), 10.0, 6.0);    // first to second order
}

}    // namespace
