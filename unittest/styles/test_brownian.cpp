// Brownian motion through LAMMPS. Facts: Einstein's diffusion and equipartition at any time step,
// in the plane, with added mass and slip; seeds are independent.

#include "flow_scene.h"

#include "comm.h"

namespace {

// n spheres that do not see each other, mass 1, at kT = 0.5 in a fluid with tau = 1
struct Cloud {
  bool planar = false;
  double fluid_density = 1e-3;
  std::string keywords;    // of fix flow/force, beyond drag, torque and brownian
};
std::string cloud(int n, const Cloud &with = Cloud())
{
  return std::string("units lj\natom_style sphere\natom_modify map array\n"
                     "comm_modify vel yes\n") +
      (with.planar ? "dimension 2\nregion box block 0 100 0 100 -0.5 0.5\n"
                   : "region box block 0 100 0 100 0 100\n") +
      "create_box 1 box\ncreate_atoms 1 random " + std::to_string(n) +
      " 99 box\nset type 1 diameter 1.0 density $(6/PI)\n" +
      (with.planar ? "set type 1 z 0.0\n" : "") +
      "pair_style zero 0.1 nocoeff\npair_coeff * *\nneighbor 2.0 bin\nfix move all nve/sphere\n"
      "fix air all flow/field uniform 0 0 0" +
      properties(with.fluid_density, 1.0 / (3.0 * pi)) +
      "fix drag all flow/force air drag stokes torque yes brownian 0.5 4711 " + with.keywords +
      "\n";
}

// phi(z) of relaxation.h
double mean_decay(double z)
{
  return -std::expm1(-z) / z;
}
// <x^2>/2D after n steps of length h from rest, relaxation time tau. Velocities of mid-steps are
// v' = e v' + (1 - e) B/k, e = exp(-h/tau), with a half step at the start; each B counts in all
// steps that follow. For short ones t - 2 tau (1 - e^n) + tau/2 (1 - e^2n), t = n h.
double wandered(int n, double h, double tau)
{
  const double e = std::exp(-h / tau);
  const double first = (1.0 - std::sqrt(e)) * (1.0 - std::pow(e, n)) / (1.0 - e);
  double sum = first * first;
  for (int m = 1; m < n; m++) sum += (1.0 - std::pow(e, m)) * (1.0 - std::pow(e, m));
  return h * sum;
}

// Mean of the squares of a component and its standard deviation, of n normal numbers, over what is
// expected: 1 +- sqrt(2/n)
void expect_mean_square(const std::vector<double> &values, int component, double expected)
{
  double sum = 0.0;
  for (size_t i = component; i < values.size(); i += 3) sum += values[i] * values[i];
  const double n = values.size() / 3.0;
  EXPECT_NEAR(sum / (n * expected), 1.0, 4.0 * std::sqrt(2.0 / n)) << "component " << component;
}

const std::string squares = "compute where all msd com no\nthermo_style custom step c_where[4]\n";

// Motion from rest in steps of length h of spheres whose inertia and mobilities are some times
// those of Stokes's law in a light fluid.
void expect_walk(const Cloud &with, double h, double time, double inertia, double mobility,
                 double mobility_of_spin)
{
  const int n = 8000, steps = static_cast<int>(time / h);
  const double tau = inertia * mobility, tau_of_spin = 0.3 * mobility_of_spin;
  Simulation sim;
  sim.run(cloud(n, with) + squares + timestep(h) + "run " + std::to_string(steps) + "\n");
  const auto v = gather(sim, "v"), omega = gather(sim, "omega");
  for (int c = 0; c < 3; c++) {
    expect_mean_square(v, c, 0.5 / inertia * mean_decay(h / tau));
    expect_mean_square(omega, c, 0.5 / 0.1 * mean_decay(h / tau_of_spin));
  }
  EXPECT_NEAR(sim.value("c_where[4]") / (3.0 * mobility * wandered(steps, h, tau)), 1.0,
              4.0 * std::sqrt(2.0 / (3.0 * n)) + 0.002);
}

}    // namespace

TEST(Brownian, diffusion_is_einsteins_at_any_time_step)
{
  // from rest: <x^2> = 2 D [t - 2 tau (1 - e) + tau/2 (1 - e^2)] in each direction, D = kT/k = 1/2
  struct Case {
    double step;
    int steps;
  };
  for (const auto &one : {Case{0.02, 1000}, Case{1.0, 100}, Case{100.0, 50}}) {
    Simulation sim;
    sim.run(cloud(6000) +
            "compute msd all msd\ncompute where all msd com no\nthermo_style custom "
            "step c_msd[4]\n" +
            timestep(one.step) + "run " + std::to_string(one.steps) + "\n");
    const double t = one.step * one.steps, e = std::exp(-t);
    const double expected = t - 2.0 * (1.0 - e) + 0.5 * (1.0 - e * e);
    const double sigma = std::sqrt(2.0 / 6000.0);    // of a mean of squares in one direction
    for (int c = 1; c <= 3; c++)
      EXPECT_NEAR(sim.value("c_msd[" + std::to_string(c) + "]") / expected, 1.0,
                  4.0 * sigma + 0.002)
          << "dt/tau = " << one.step << ", direction " << c;
  }
}

TEST(Brownian, energy_is_that_of_equipartition)
{
  // at steps <v^2> = kT phi(z), z = dt/tau, phi = (1 - exp(-z))/z; spins have z/0.3
  for (double z : {0.02, 0.5, 2.0}) {
    Simulation sim;
    sim.run(cloud(8000) +
            "compute kin all ke\ncompute rot all erotate/sphere\nthermo_style custom "
            "step c_kin c_rot\n" +
            timestep(z) + "run " + std::to_string(static_cast<int>(6.0 / z) + 3) + "\n");
    const double one = 1.5 * 0.5 * 8000.0, sigma = std::sqrt(2.0 / (3.0 * 8000.0));
    EXPECT_NEAR(sim.value("c_kin") / (one * mean_decay(z)), 1.0, 4.0 * sigma) << z;
    EXPECT_NEAR(sim.value("c_rot") / (one * mean_decay(z / 0.3)), 1.0, 4.0 * sigma) << z;
  }
}

TEST(Brownian, in_the_plane_nothing_leaves_it)
{
  // 4 D t in two directions, kT/2 for each of the three motions that are left; long and short steps
  const int n = 8000;
  Cloud plane;
  plane.planar = true;
  for (const double z : {0.25, 2.0}) {
    Simulation sim;
    const int steps = static_cast<int>(40.0 / z);
    sim.run(cloud(n, plane) + squares + timestep(z) + "run " + std::to_string(steps) + "\n");
    EXPECT_NEAR(sim.value("c_where[4]") / (2.0 * wandered(steps, z, 1.0)), 1.0,
                4.0 * std::sqrt(1.0 / n) + 0.002);
    EXPECT_EQ(sim.value("c_where[3]"), 0.0);
    const auto v = gather(sim, "v"), omega = gather(sim, "omega");
    for (int c = 0; c < 2; c++) expect_mean_square(v, c, 0.5 * mean_decay(z));
    expect_mean_square(omega, 2, 0.5 / 0.1 * mean_decay(z / 0.3));
    for (int i = 0; i < n; i++) {
      EXPECT_EQ(v[3 * i + 2], 0.0);
      EXPECT_EQ(omega[3 * i], 0.0);
      EXPECT_EQ(omega[3 * i + 1], 0.0);
    }
  }
}

TEST(Brownian, with_added_mass_the_mass_of_equipartition_is_the_effective_one)
{
  // (m + m_f/2) v' = -k v + B with <B B> = 2 kT k: <v^2> = kT/(m + m_f/2) per direction, as for a
  // sphere in an incompressible fluid (R. Zwanzig, M. Bixon, J. Fluid Mech. 69, 21, 1975); it
  // diffuses with kT/k, whatever its mass, and spins without added mass. Here m_f = m.
  Cloud heavy;
  heavy.fluid_density = 6.0 / pi;
  heavy.keywords = "added_mass yes";
  for (const double h : {0.3, 3.0}) expect_walk(heavy, h, 60.0, 1.5, 1.0, 1.0);
}

TEST(Brownian, slip_slows_relaxation_and_leaves_equipartition)
{
  // Kn = 2 lambda/d = 1: resistances over 1 + 1.257 + 0.4 exp(-1.1) and 1 + 3 1.257; a sphere
  // diffuses faster by the former, and short steps have kT/2 in each of six motions
  const double C = 2.257 + 0.4 * std::exp(-1.1), C_spin = 1.0 + 3.0 * 1.257;
  Cloud gas;
  gas.keywords = "cunningham 0.5";
  for (const double h : {0.1, 1.0, 6.0}) expect_walk(gas, h, 40.0, 1.0, C, C_spin);
}

TEST(Brownian, seeds_differ_and_nothing_drifts)
{
  std::vector<double> one, other;
  for (auto *x : {&one, &other}) {
    Simulation sim;
    std::string scene = cloud(4000);
    if (x == &other) scene.replace(scene.find("4711"), 4, "4712");
    sim.run(scene + timestep(1.0) + "run 30\n");
    *x = gather(sim, "v");
    for (int c = 0; c < 3; c++) {
      double mean = 0.0;
      for (size_t i = c; i < x->size(); i += 3) mean += (*x)[i] / 4000.0;
      EXPECT_NEAR(mean, 0.0, 4.0 * std::sqrt(0.5 / 4000.0));
    }
  }
  double correlation = 0.0;
  for (size_t i = 0; i < one.size(); i++) correlation += one[i] * other[i] / (0.5 * one.size());
  EXPECT_NEAR(correlation, 0.0, 4.0 / std::sqrt(12000.0));
}

TEST(RanksBrownian, the_same_motion_on_any_number_of_ranks_and_after_a_restart)
{
  const std::string more = timestep(0.3);
  std::vector<double> alone;
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(cloud(200) + more + "run 25\nrun 15\n");
    for (int tag = 1; tag <= 200; tag++) {
      const double *v = sim.lammps()->atom->v[sim.lammps()->atom->map(tag)];
      alone.insert(alone.end(), v, v + 3);
    }
  }
  const std::string file = scratch_file("brownian");
  {
    Simulation sim;
    sim.run(cloud(200) + more + "run 25\nwrite_restart " + file + "\nrun 15\n");
    EXPECT_LT(difference(gather(sim, "v"), alone), 1e-13);
  }
  Simulation sim;
  const std::string scene = cloud(200);
  sim.run("read_restart " + file + "\ncomm_modify vel yes\n" +
          scene.substr(scene.find("pair_style")) + more + "run 15\n");
  EXPECT_LT(difference(gather(sim, "v"), alone), 1e-13);
  MPI_Barrier(MPI_COMM_WORLD);
  if (sim.lammps()->comm->me == 0) std::filesystem::remove(file);
}
