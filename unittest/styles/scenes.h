// Scenes that the tests of contacts share: a few spheres in a box, springs loaded to known lengths,
// and JKR's curve solved by bisection, independent of the code under test.

#ifndef APF_TEST_SCENES_H
#define APF_TEST_SCENES_H

#include "simulation.h"

#include "gtest/gtest.h"

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

constexpr double pi = 3.14159265358979323846;

// JKR of report eqs (38)-(41); E and gamma as in the report: effective modulus, energy per surface.
struct JkrCurve {
  double R, E, gamma;

  double F_C() const { return 3.0 * pi * gamma * R; }
  double a0() const { return std::cbrt(9.0 * pi * gamma * R * R / E); }
  double delta_C() const { return a0() * a0() / (2.0 * std::cbrt(6.0) * R); }
  double delta_eq() const { return a0() * a0() / (3.0 * R); }
  // contact radius at an overlap, stable branch
  double a(double delta) const
  {
    if (gamma == 0.0) return std::sqrt(R * delta);
    double low = std::pow(6.0, -2.0 / 3.0), high = 100.0;
    for (int n = 0; n < 200; n++) {
      const double h = 0.5 * (low + high);
      const double d = std::cbrt(6.0) * (2.0 * h * h - 4.0 / 3.0 * std::sqrt(h));
      (d < delta / delta_C() ? low : high) = h;
    }
    return 0.5 * (low + high) * a0();
  }
  double force(double delta) const    // > 0 repels
  {
    if (gamma == 0.0) return 4.0 / 3.0 * E * std::sqrt(R) * std::pow(delta, 1.5);
    const double h = a(delta) / a0();
    return 4.0 * F_C() * (h * h * h - std::pow(h, 1.5));
  }
  // rolling stiffness 4 F_C (a/a0)^(3/2), eq (44)
  double rolling(double delta) const { return 4.0 * F_C() * std::pow(a(delta) / a0(), 1.5); }
};

// The material of most scenes: jkr 1e6 0.25 100 in units lj. delta_eq is 1.3 % of r for d = 1.
struct Material {
  double E = 1.0e6, nu = 0.25, gamma = 100.0;

  double E_eff() const { return 0.5 * E / (1.0 - nu * nu); }
  double G_eff() const { return 0.5 * E / (2.0 * (1.0 + nu)) / (2.0 - nu); }
  JkrCurve curve(double R) const { return {R, E_eff(), gamma}; }
  JkrCurve pair(double d1 = 1.0, double d2 = 1.0) const { return curve(0.5 * d1 * d2 / (d1 + d2)); }
  JkrCurve wall(double d = 1.0) const { return curve(0.5 * d); }
};
inline const std::string jkr = " jkr 1.0e6 0.25 100.0 ";
inline const std::string all_friction = " sliding 0.3 twisting yes rolling 0.02 ";
inline std::string pair_of(const std::string &law)    // law: words that begin with a space
{
  return "pair_style granular/adhesive\npair_coeff * *" + law + "\n";
}
inline const std::string adhesive = pair_of(jkr + all_friction);

constexpr double dt = 1.0 / 16384.0;    // a power of two: positions of moving scenes are exact
inline double snap(double x)
{
  return std::round(x * 1073741824.0) / 1073741824.0;
}

// all digits of a number, for a command
inline std::string digits(double value)
{
  char text[32];
  snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

// particle steps of n collision steps, each as long as `step`
inline std::string mts(int n, double step = dt, const std::string &more = "")
{
  return "fix nve all nve/sphere/mts collision " + std::to_string(n) + " " + more + "\ntimestep " +
      digits(n * step) + "\n";
}

struct Sphere {
  double x, y, z, d = 1.0;
};

struct Scene {
  std::string newton = "on", processors = "* * *", boundary = "p p p";
  std::string box = "0 8 0 8 0 8";
  std::string before;              // commands before the box is made
  std::string style = adhesive;    // pair style, walls
  int types = 1;
  std::vector<int> ids, type;    // of the spheres; 1, 2, ... and 1
};

inline Scene beside_a_wall()
{
  Scene scene;
  scene.boundary = "f p p";
  return scene;
}

inline void build(Simulation &sim, const std::vector<Sphere> &spheres, const Scene &scene = Scene())
{
  sim.run("newton " + scene.newton + "\nprocessors " + scene.processors + "\n" + scene.before +
          "\nboundary " + scene.boundary +
          "\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
          "region box block " +
          scene.box + "\ncreate_box " + std::to_string(scene.types) + " box\ntimestep " +
          std::to_string(dt) + "\n");
  sim.lammps()->update->dt = dt;    // all digits
  std::vector<double> x;
  std::vector<int> ids = scene.ids, types = scene.type;
  for (int n = 0; n < static_cast<int>(spheres.size()); n++) {
    x.insert(x.end(), {spheres[n].x, spheres[n].y, spheres[n].z});
    if (scene.ids.empty()) ids.push_back(n + 1);
    if (scene.type.empty()) types.push_back(1);
  }
  lammps_create_atoms(sim.lammps(), static_cast<int>(spheres.size()), ids.data(), types.data(),
                      x.data(), nullptr, nullptr, 0);
  char line[128];
  for (int n = 0; n < static_cast<int>(spheres.size()); n++) {
    snprintf(line, sizeof(line), "set atom %d diameter %.16g density 1.0", ids[n], spheres[n].d);
    sim.run(line);
  }
  sim.run(scene.style);
}

// many spheres of diameter and density 1 in a scene built without, coordinates [spheres][3]
inline void add_spheres(Simulation &sim, const std::vector<double> &x, const std::vector<double> &v)
{
  const int n = static_cast<int>(x.size() / 3);
  std::vector<int> ids(n), types(n, 1);
  for (int k = 0; k < n; k++) ids[k] = k + 1;
  lammps_create_atoms(sim.lammps(), n, ids.data(), types.data(), x.data(), v.data(), nullptr, 0);
  sim.run("set group all diameter 1.0 density 1.0");
}

// per-atom values of all ranks by ID, `columns` a particle
inline std::vector<double> gather(Simulation &sim, const char *name, int columns = 3)
{
  std::vector<double> all(columns * static_cast<size_t>(lammps_get_natoms(sim.lammps())));
  lammps_gather(sim.lammps(), name, 1, columns, all.data());
  expect_finite(all.data(), all.size(), name);
  return all;
}

// One Simulation at a time: LAMMPS 4 Feb 2025 loads a plugin into the first of several only.
struct State {
  std::vector<double> x, v, omega, f, torque;
};
inline State state_of(Simulation &sim)
{
  return {gather(sim, "x"), gather(sim, "v"), gather(sim, "omega"), gather(sim, "f"),
          gather(sim, "torque")};
}

inline double largest(const std::vector<double> &a)
{
  double most = 0.0;
  for (double value : a) most = std::max(most, std::fabs(value));
  return most;
}
// largest difference over largest value; an empty or zero reference is no evidence and gives 1
inline double difference(const std::vector<double> &a, const std::vector<double> &b)
{
  if (a.size() != b.size() || largest(b) == 0.0) return 1.0;
  double most = 0.0;
  for (size_t n = 0; n < a.size(); n++) most = std::max(most, std::fabs(a[n] - b[n]));
  return most / largest(b);
}

inline void expect_same_loads(const State &a, const State &b, double tolerance)
{
  EXPECT_LT(difference(a.f, b.f), tolerance) << "forces";
  EXPECT_LT(difference(a.torque, b.torque), tolerance) << "torques";
}
inline void expect_same(const State &a, const State &b, double tolerance)
{
  EXPECT_LT(difference(a.x, b.x), tolerance) << "positions";
  EXPECT_LT(difference(a.v, b.v), tolerance) << "velocities";
  EXPECT_LT(difference(a.omega, b.omega), tolerance) << "angular velocities";
  expect_same_loads(a, b, tolerance);
}

inline void set_motion(Simulation &sim, int id, const std::vector<double> &v,
                       const std::vector<double> &omega)
{
  char line[256];
  snprintf(line, sizeof(line), "set atom %d vx %.17g vy %.17g vz %.17g omega %.17g %.17g %.17g", id,
           v[0], v[1], v[2], omega[0], omega[1], omega[2]);
  sim.run(line);
}

// No fix integrates yet: particles stay where they are while the velocities that they are given
// stretch the springs by velocity times time.
inline void load_springs(Simulation &sim, int steps, const std::vector<double> &v,
                         const std::vector<double> &omega1, const std::vector<double> &omega2)
{
  set_motion(sim, 1, v, omega1);
  set_motion(sim, 2, {0.0, 0.0, 0.0}, omega2);
  sim.run("run " + std::to_string(steps));
  set_motion(sim, 1, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
}

// a file that this test, on this number of ranks, has for itself
inline std::string scratch_file(const std::string &name)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const auto *test = testing::UnitTest::GetInstance()->current_test_info();
  return (std::filesystem::temp_directory_path() /
          ("apf-" + std::string(test->name()) + "-" + std::to_string(ranks) + "-" + name))
      .string();
}

// what LAMMPS writes to its log in these commands; on one rank
inline std::string log_of(Simulation &sim, const std::string &commands)
{
  const std::string file = scratch_file("log");
  sim.run("log " + file + "\n" + commands + "log none\n");
  std::ifstream in(file);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(file);
  return text;
}

inline int number_of_ranks()
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  return ranks;
}

#endif
