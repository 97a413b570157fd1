// fix nve/sphere/mts in a box that is sheared by fix deform: images move with their velocity
// between two particle steps, at the end of which LAMMPS moves the box.

#include "scenes.h"

namespace {

const std::string law = jkr + "damping tsuji 0.5 sliding 0.3 twisting yes rolling 0.02 ";
const Material material;

void build_sheared(Simulation &sim, const std::vector<Sphere> &spheres)
{
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
  build(sim, spheres, scene);
  sim.run("change_box all triclinic\nneighbor 0.8 bin\n");
}
const std::string shear = "fix flow all deform 1 xy erate 1.0 remap v\n";

// Two spheres that touch across the sheared boundary, at rest: their relative speed, less that of
// the box.
double shaking(const std::string &integrate, int every, const std::string &run)
{
  Simulation sim;
  const double half = 0.5 - 0.5 * material.pair().delta_eq();
  build_sheared(sim,
                {{4.0 + 0.6 * half, 0.8 * half, 4.0}, {4.0 - 0.6 * half, 8.0 - 0.8 * half, 4.0}});
  set_motion(sim, 1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {8.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run(shear + integrate +
          "variable w equal abs(vx[2]-vx[1]-8*round((vx[2]-vx[1])/8))\n"
          "fix log all vector " +
          std::to_string(every) + " v_w\n" + run);
  double most = 0.0;
  for (int n = 300; n < 400; n++)
    most = std::max(most, sim.value("f_log[" + std::to_string(n) + "]"));
  return most;
}

TEST(RanksMtsDeform, doublet_across_the_boundary_does_not_shake)
{
  const double verlet = shaking("fix nve all nve/sphere\n", 4, "run 1600");
  const double levels = shaking(mts(4), 1, "run 400");
  EXPECT_GT(levels, 0.0);
  EXPECT_LT(verlet, 1e-4);
  EXPECT_LT(levels, 2.5e-4);
}

TEST(RanksMtsDeform, gas_has_no_late_contact)
{
  std::vector<Sphere> spheres;
  for (int n = 0; n < 125; n++)
    spheres.push_back({1.6 * (n % 5) + 0.5, 1.6 * (n / 5 % 5) + 0.5, 1.6 * (n / 25) + 0.5});
  Simulation sim;
  build_sheared(sim, spheres);
  sim.run("velocity all create 9.0 4711 loop geom\n" + shear + mts(32) + "run 100");
  EXPECT_EQ(sim.value("f_nve[5]"), 0.0);
  EXPECT_GT(sim.value("f_nve[3]"), 5.0);
  EXPECT_EQ(lammps_get_natoms(sim.lammps()), 125.0);
}

}    // namespace
