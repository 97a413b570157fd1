// What pair granular/adhesive tells other commands (parts, energies, virial), against closed forms
// written out here, and how it works beside commands that change particles.

#include "scenes.h"

namespace {

const Material material;
const std::vector<std::string> both = {"on", "off"};
constexpr double alpha = 0.4, overlap = 0.01, t = 64 * dt;

std::string number(double value)
{
  char text[32];
  snprintf(text, sizeof(text), "%.17g", value);
  return text;
}

// along x, springs loaded, the first moving towards the second
void build_loaded(Simulation &sim, const std::string &newton, double x = 3.0)
{
  Scene scene;
  scene.newton = newton;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + jkr + "damping alpha 0.4" +
      all_friction + "\n";
  build(sim, {{x, 3.0, 3.0}, {x + 1.0 - overlap, 3.0, 3.0}}, scene);
  load_springs(sim, 64, {0.0, 0.05, 0.0}, {0.1, 0.0, 0.4}, {-0.1, 0.0, -0.4});
  set_motion(sim, 1, {0.25, 0.0, 0.0}, {0.0, 0.0, 0.0});
}

struct Expected {
  double a = material.pair().a(overlap), elastic = material.pair().force(overlap);
  double damping = alpha * std::sqrt(pi / 12.0 * 4.0 / 3.0 * material.E_eff() * a) * 0.25;
  double k_T = 8.0 * material.G_eff() * a, sliding = k_T * 0.05 * t;
  double k_roll = material.pair().rolling(overlap), xi = 0.25 * 0.8 * t, rolling = k_roll * xi;
  double twisting = 0.5 * k_T * a * a * 0.2 * t;
};

// force of JKR integrated over the overlap
double work(const JkrCurve &curve, double from, double to)
{
  const int n = 2000;
  double sum = 0.0;
  for (int k = 0; k <= n; k++)
    sum += (k == 0 || k == n ? 1.0 : (k % 2 ? 4.0 : 2.0)) * curve.force(from + k * (to - from) / n);
  return sum * (to - from) / (3.0 * n);
}

// rows of a local compute of all ranks, added up
std::vector<double> sum_of_local(Simulation &sim, const std::string &id, int columns)
{
  auto *lmp = sim.lammps();
  std::vector<double> sum(columns, 0.0);
  const int type = columns > 1 ? LMP_TYPE_ARRAY : LMP_TYPE_VECTOR;
  void *data = lammps_extract_compute(lmp, id.c_str(), LMP_STYLE_LOCAL, type);
  const int rows =
      *static_cast<int *>(lammps_extract_compute(lmp, id.c_str(), LMP_STYLE_LOCAL, LMP_SIZE_ROWS));
  for (int r = 0; r < rows; r++)
    for (int c = 0; c < columns; c++)
      sum[c] += columns > 1 ? static_cast<double **>(data)[r][c] : static_cast<double *>(data)[r];
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), columns, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return sum;
}

TEST(RanksPairOutput, pair_local_gives_each_part)
{
  const Expected is;
  for (const auto &newton : both)
    for (const double x : {3.0, 7.5}) {    // inside, and across the periodic boundary
      Simulation sim;
      build_loaded(sim, newton, x);
      sim.run("compute id all property/local patom1\n"
              "compute c all pair/local dist force p1 p2 p3 p4 p5 p6 p7 p8 p9 p10 p11\nrun 0");
      const auto row = sum_of_local(sim, "c", 13);
      auto part = [&](int n) {
        return row[1 + n];
      };
      SCOPED_TRACE(newton);
      EXPECT_NEAR(row[0], 1.0 - overlap, 1e-12);
      EXPECT_NEAR(row[1] / (is.elastic + is.damping), 1.0, 1e-9);
      EXPECT_NEAR(part(1) / overlap, 1.0, 1e-9);
      EXPECT_NEAR(part(2) / is.a, 1.0, 1e-9);
      EXPECT_NEAR(part(3) / is.elastic, 1.0, 1e-9);
      EXPECT_NEAR(part(4) / is.damping, 1.0, 1e-9);
      // of tangential parts: those on the first atom
      const double sign = sum_of_local(sim, "id", 1)[0] == 1.0 ? 1.0 : -1.0;
      EXPECT_NEAR(part(6) / (-sign * is.sliding), 1.0, 1e-9);
      EXPECT_NEAR(part(10) / (-sign * is.rolling), 1.0, 1e-9);
      EXPECT_NEAR(part(11) / is.twisting, -1.0, 1e-9);
      for (int zero : {5, 7, 8, 9}) EXPECT_NEAR(part(zero), 0.0, 1e-6) << "part " << zero;
    }
}

TEST(RanksPairOutput, energies_by_part)
{
  const Expected is;
  const auto curve = material.pair();
  for (const auto &newton : both) {
    Simulation sim;
    build_loaded(sim, newton);
    sim.run("compute e all pair granular/adhesive\nthermo_style custom step pe "
            "c_e[*]\nthermo_modify norm no\nrun 0");
    // zero at the virtual state a = 0: U(equilibrium) = -1.453696 F_C delta_C, table A5
    const double U =
        -1.453696 * curve.F_C() * curve.delta_C() + work(curve, curve.delta_eq(), overlap);
    const std::vector<double> parts = {U, 0.5 * is.k_T * 0.0025 * t * t,
                                       0.5 * is.k_roll * is.xi * is.xi / 0.25,
                                       0.5 * is.twisting * 0.2 * t};
    double sum = 0.0;
    for (int n = 0; n < 4; n++) {
      EXPECT_NEAR(sim.value("c_e[" + std::to_string(n + 1) + "]") / parts[n], 1.0, 1e-5)
          << newton << n;
      sum += parts[n];
    }
    EXPECT_NEAR(sim.value("pe") / sum, 1.0, 1e-5);
  }
}

// virial of a doublet: W_ab = d_a f_b, d from the second to the first, f on the first
TEST(RanksPairOutput, virial_and_stress_are_distance_times_force)
{
  for (const auto &newton : both)
    for (const double x : {3.0, 7.5}) {
      Simulation sim;
      build_loaded(sim, newton, x);
      sim.run("compute p all pressure NULL pair\ncompute w all stress/atom NULL pair\n"
              "compute s all reduce sum c_w[*]\ncompute one all reduce max c_w[1]\n"
              "thermo_style custom step c_p c_p[*] c_s[*] c_one\nrun 0");
      const auto f = gather(sim, "f");
      const double xx = -(1.0 - overlap) * f[0], xy = -(1.0 - overlap) * f[1];
      ASSERT_GT(std::fabs(xy), 0.1);
      EXPECT_NEAR(sim.value("c_p[1]*vol") / xx, 1.0, 1e-9);
      EXPECT_NEAR(sim.value("c_p[4]*vol") / xy, 1.0, 1e-9);
      EXPECT_NEAR(sim.value("c_s[1]") / -xx, 1.0, 1e-9);
      EXPECT_NEAR(sim.value("c_s[4]") / -xy, 1.0, 1e-9);
      EXPECT_NEAR(sim.value("c_one") / (-0.5 * xx), 1.0, 1e-9) << "half to each";
      EXPECT_NEAR(sim.value("c_p[3]*vol"), 0.0, 1e-9);
    }
}

TEST(RanksPairOutput, group_group_is_the_normal_force)
{
  const Expected is;
  for (const auto &newton : both) {
    Simulation sim;
    build_loaded(sim, newton);
    sim.run("group a id 1\ngroup b id 2\ncompute g a group/group b\nthermo_style custom step "
            "c_g[*]\nrun 0");
    EXPECT_NEAR(sim.value("c_g[1]") / -(is.elastic + is.damping), 1.0, 1e-9) << newton;
  }
}

// ---------------------------------------------------------------------------------------------
// energy ledger

TEST(PairOutput, elastic_collision_keeps_energy)
{
  Simulation sim;
  Scene scene;
  scene.style = "pair_style granular/adhesive\npair_coeff * * jkr 1e6 0.25 0\n";
  build(sim, {{3.0, 3.0, 3.0}, {3.9, 3.45, 3.0}}, scene);
  set_motion(sim, 1, {3.0, 0.0, 0.0}, {0.0, 0.0, 5.0});
  sim.run("fix nve all nve/sphere\ncompute ke all ke\nthermo_modify norm no\nrun 0");
  const double start = 0.5 * pi / 6.0 * 9.0;
  double most = 0.0;
  for (int n = 0; n < 60; n++) {
    sim.run("run 10");
    most = std::max(most, sim.value("pe"));
    EXPECT_NEAR(sim.value("pe+c_ke") / start, 1.0, 1e-4);
  }
  EXPECT_GT(most, 0.2 * start);
}

TEST(PairOutput, a_cycle_of_adhesion_costs_what_jkr_says)
{
  const auto curve = material.pair();
  double mean = 0.0;
  const int phases = 20;
  for (int n = 0; n < phases; n++) {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}, {4.002 + n * 1e-5, 3.0, 3.0}});
    const double v = 2.5 * std::sqrt(2.0 * 0.935503 * curve.F_C() * curve.delta_C() * 12.0 / pi);
    set_motion(sim, 1, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("timestep " + number(dt / 8) + "\nfix nve all nve/sphere\nrun 4000");
    const auto u = gather(sim, "v");
    EXPECT_GT(gather(sim, "x")[3] - gather(sim, "x")[0], 1.0 + curve.delta_C());
    mean += 0.5 * pi / 12.0 * (v * v - (u[3] - u[0]) * (u[3] - u[0])) / phases;
  }
  EXPECT_NEAR(mean / (curve.F_C() * curve.delta_C()), 0.935503, 0.01);
}

// ---------------------------------------------------------------------------------------------
// beside other commands

// The doublet is loaded by the style's own scene, then the commands; forces as without them?
State loaded(const std::string &commands, const std::vector<Sphere> &others = {},
             const Scene &scene = Scene())
{
  Simulation sim;
  std::vector<Sphere> spheres = {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}};
  spheres.insert(spheres.end(), others.begin(), others.end());
  build(sim, spheres, scene);
  load_springs(sim, 64, {0.0, 0.05, 0.0}, {0.1, 0.0, 0.4}, {-0.1, 0.0, -0.4});
  sim.run(commands + "\nrun 1");
  State state = state_of(sim);
  for (auto *a : {&state.f, &state.torque}) a->resize(6);
  return state;
}

TEST(RanksPairOutput, beside_commands_that_add_and_delete_particles)
{
  const State twin = loaded("");
  ASSERT_GT(largest(twin.torque), 0.1);
  const std::vector<Sphere> others = {{6.0, 6.0, 6.0}, {6.99, 6.0, 6.0}, {1.0, 6.0, 1.0}};
  expect_same_loads(
      loaded("group out id 3 4\ndelete_atoms group out compress no", {{6, 6, 6}, {6.99, 6, 6}}),
      twin, 1e-12);
  expect_same_loads(loaded("region up block 0 8 0 8 7 8\ngroup new empty\n"
                           "fix dep new deposit 5 1 10 777 region up units box\nrun 60",
                           others),
                    twin, 1e-12);
  expect_same_loads(
      loaded("create_atoms 1 single 1 1 1 units box\nset atom 3 diameter 1 density 1"), twin,
      1e-12);
  expect_same_loads(loaded("region all block 0 8 0 8 0 8\ngroup out id 3 4 5\n"
                           "fix ev out evaporate 1 1 all 4321\nrun 10\nunfix ev",
                           others),
                    twin, 1e-12);
}

// delete_atoms numbers the particles that stay anew unless told "compress no": springs must follow.
TEST(RanksPairOutput, beside_commands_that_number_particles_anew)
{
  const State twin = loaded("");
  Scene scene;
  scene.ids = {2, 3, 1};    // what is not the doublet has ID 1
  auto loads = [&](const std::string &commands) {
    Simulation sim;
    build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}, {6.0, 6.0, 6.0}}, scene);
    set_motion(sim, 2, {0.0, 0.05, 0.0}, {0.1, 0.0, 0.4});
    set_motion(sim, 3, {0.0, 0.0, 0.0}, {-0.1, 0.0, -0.4});
    sim.run("run 64\nset atom 2 vy 0 omega 0 0 0\nset atom 3 omega 0 0 0\n" + commands + "\nrun 1");
    return state_of(sim);
  };
  expect_same_loads(loads("group out id 1\ndelete_atoms group out"), twin, 1e-12);
}

TEST(RanksPairOutput, with_hybrid_styles)
{
  const State twin = loaded("");
  const std::string law = "granular/adhesive" + jkr + all_friction + "\n";
  Scene scene;
  scene.style =
      "pair_style hybrid/overlay granular/adhesive zero 2.0\npair_coeff * * zero\npair_coeff * * " +
      law;
  expect_same_loads(loaded("neigh_modify delay 0 every 1 check no\nrun 5", {}, scene), twin, 1e-12);
  scene.types = 2;
  scene.style = "pair_style hybrid granular/adhesive zero 2.0\npair_coeff 1 1 " + law +
      "pair_coeff * 2 zero\n";
  expect_same_loads(loaded("run 5", {}, scene), twin, 1e-12);
}

TEST(RanksPairOutput, excluded_pairs_do_not_touch)
{
  Simulation sim;
  build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}, {3.0, 3.99, 3.0}});
  sim.run("group a id 1\ngroup b id 2\nneigh_modify exclude group a b\nrun 0");
  const auto f = gather(sim, "f");
  EXPECT_EQ(f[0], 0.0);
  EXPECT_NEAR(f[1] / -material.pair().force(0.01), 1.0, 1e-9);
}

TEST(RanksPairOutput, bonded_pairs_do_not_touch)
{
  Simulation bonded;
  bonded.run(
      "atom_style hybrid sphere bond\natom_modify map array\ncomm_modify vel yes\nspecial_bonds lj "
      "0 1 1\n"
      "region box block 0 8 0 8 0 8\ncreate_box 1 box bond/types 1 extra/bond/per/atom 2 "
      "extra/special/per/atom 4\ncreate_atoms 1 single 3 3 3\ncreate_atoms 1 single 3.99 3 3\n"
      "create_atoms 1 single 3 3.99 3\nset group all diameter 1 density 1\nbond_style "
      "zero\nbond_coeff *\n" +
      adhesive + "create_bonds single/bond 1 1 2 special yes\nrun 0");
  const auto g = gather(bonded, "f");
  EXPECT_EQ(g[0], 0.0);
  EXPECT_NEAR(g[1] / -material.pair().force(0.01), 1.0, 1e-9);
}

TEST(RanksPairOutput, write_data_keeps_acting)
{
  const std::string file = scratch_file("data");
  for (const char *pairs : {"ij", "ii"}) {
    const bool named = pairs[1] == 'j';
    Scene scene;
    scene.types = 2;
    scene.type = {1, 2};
    scene.style = "pair_style granular/adhesive\npair_coeff 1 1 jkr 1e6 0.25 100 damping tsuji 0.7 "
                  "sliding 0.2\n"
                  "pair_coeff 2 2 jkr 3e6 0.1 50 damping tsuji 0.3 sliding 0.4 rolling 0.02 0.1\n" +
        std::string(named ? "pair_coeff 1 2 jkr 2e6 0.3 40 damping alpha 0.5 sliding 0.25 twisting "
                            "yes break force "
                            "scale_stiffness 0.5\n"
                          : "");
    State before;
    {
      Simulation sim;
      build(sim, {{3.0, 3.0, 3.0}, {3.99, 3.0, 3.0}}, scene);
      set_motion(sim, 1, {0.4, 0.3, 0.0}, {1.0, 2.0, 0.5});
      set_motion(sim, 2, {0.0, 0.0, 0.2}, {-1.0, 0.0, 0.2});
      sim.run("run 0\nwrite_data " + file + " pair " + pairs + "\nrun 1");
      before = state_of(sim);
    }
    Simulation sim;
    sim.run("atom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
            "pair_style granular/adhesive\nread_data " +
            file + "\ntimestep " + number(dt) + "\nrun 1");
    SCOPED_TRACE(pairs);
    ASSERT_GT(largest(before.torque), 0.01);
    expect_same_loads(state_of(sim), before, 1e-8);
    std::remove(file.c_str());
  }
}

// Restitution says which effective mass a contact counts: a frozen sphere is as heavy as a wall, a
// sphere of a rigid body weighs what the body weighs.
TEST(RanksPairOutput, effective_mass_of_frozen_and_rigid)
{
  auto ratio = [](const std::string &commands, const std::vector<Sphere> &spheres) {
    Simulation sim;
    Scene scene;
    scene.style = "pair_style granular/adhesive\npair_coeff * * jkr 1e6 0.25 0 damping tsuji 0.5\n";
    build(sim, spheres, scene);
    set_motion(sim, 1, {2.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
    sim.run("group one id 1\ngroup rest subtract all one\nfix nve one nve/sphere\n" + commands +
            "\ntimestep " + number(dt / 4) + "\nrun 3000");
    const auto v = gather(sim, "v");
    return (v[3] - v[0]) / 2.0;
  };
  EXPECT_NEAR(ratio("fix still rest freeze", {{3, 3, 3}, {4.002, 3, 3}}), 0.5, 0.0025);
  EXPECT_NEAR(ratio("fix body rest rigid single", {{3, 3, 3}, {4.002, 3, 3}, {5.2, 3, 3}}), 0.5,
              0.0025);
}

}    // namespace
