// The liquid that particles and walls own.

#include "integrators.h"
#include "wet_spheres.h"

#include "contact/bridge_list.h"

#include "force.h"
#include "pair.h"

#include <set>

namespace {

// A dense suspension in shear between two walls: bridges form and rupture all the time.
std::string sheared(const std::string &liquid, const std::string &film, int side)
{
  const std::string law = "jkr 1.0e5 0.25 1.0 damping alpha 0.5 sliding 0.3 bridge 0.02 5.0 0 0.05 "
                          "0.01 " +
      liquid;
  const std::string n = std::to_string(side);
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
         "boundary p p f\nnewton on\nlattice sc 0.7\nregion box block 0 " +
      n + " 0 " + n + " 0 " + n +
      "\ncreate_box 1 box\ncreate_atoms 1 box\ndisplace_atoms all move 0 0 0.45 units lattice\n"
      "set group all diameter 1.0 density 1.0\nvelocity all create 30.0 4711 loop geom\n"
      "neighbor 0.4 bin\npair_style granular/adhesive\npair_coeff * * " +
      law + "\nvariable top equal zhi\nfix w all wall/levelset plane z 0 $(v_top) " + law + film +
      "\n";
}
std::string shearing(const Integrator &by)
{
  return "fix s all addforce v_fx 0 0\n" + by.commands(0.0005);
}
const std::string measuring = "variable fx atom 20*(z-zhi/2)\ncompute agg all aggregate/contact\n"
                              "compute sum all reduce sum c_agg[6]\nthermo_style custom step c_sum "
                              "f_w[12]\nthermo 1000\n";

// pairs of atom IDs that bridges join, of all ranks
std::set<long> bridged(Simulation &sim)
{
  auto *lammps = sim.lammps();
  int dim;
  const auto *list =
      static_cast<apf::BridgeList *>(lammps->force->pair->extract("bridge_list", dim));
  std::vector<long> mine;
  for (int k = 0; k < list->size(); k++) {
    const long a = lammps->atom->tag[list->i[k]], b = lammps->atom->tag[list->j[k]];
    mine.push_back(std::min(a, b) * 100000 + std::max(a, b));
  }
  int n = static_cast<int>(mine.size()), ranks;
  MPI_Comm_size(lammps->world, &ranks);
  std::vector<int> counts(ranks), first(ranks + 1, 0);
  MPI_Allgather(&n, 1, MPI_INT, counts.data(), 1, MPI_INT, lammps->world);
  for (int k = 0; k < ranks; k++) first[k + 1] = first[k] + counts[k];
  std::vector<long> all(first[ranks]);
  MPI_Allgatherv(mine.data(), n, MPI_LONG, all.data(), counts.data(), first.data(), MPI_LONG,
                 lammps->world);
  return {all.begin(), all.end()};
}

int ruptured(const std::set<long> &before, const std::set<long> &after)
{
  int n = 0;
  for (const long pair : before) n += after.count(pair) == 0;
  return n;
}

// The first one rank fewer than there are, the others wait.
class FewerRanks {
 public:
  FewerRanks()
  {
    const int ranks = number_of_ranks();
    int me;
    MPI_Comm_rank(MPI_COMM_WORLD, &me);
    take_part = me < std::max(1, ranks - 1);
    MPI_Comm_split(MPI_COMM_WORLD, take_part, me, &comm);
  }
  ~FewerRanks()
  {
    MPI_Comm_free(&comm);
    MPI_Barrier(MPI_COMM_WORLD);
  }
  bool take_part;
  MPI_Comm comm;
};

}    // namespace

TEST(RanksBridge, liquid_is_conserved_in_shear_and_through_a_restart_on_fewer_ranks)
{
  const Integrator &verlet = integrators[0], respa{"respa", 4}, sub_steps{"mts", 4};
  struct {
    std::string split;
    double film;    // on the walls; -1: they give nothing
    std::vector<Integrator> by;
    int side = 5, steps = 300;
  } cases[] = {{"inventory 0.3", -1.0, {verlet, respa, sub_steps}},
               {"inventory 0.3 origin", -1.0, {verlet}},
               {"inventory 1.0 form film", -1.0, {verlet}},
               {"inventory 0.3", 0.01, {verlet, respa, sub_steps}},
               {"inventory 1.0 origin form film", 0.002, {verlet}},
               {"inventory 0.3", 0.01, {verlet}, 22, 120}};    // 10,648 particles
  for (const auto &[split, thickness, by, side, steps] : cases)
    for (const auto &integrator : by) {
      const std::string film = thickness < 0.0 ? "" : " film " + digits(thickness);
      const double area = 2.0 * std::pow(side * std::cbrt(1.0 / 0.7), 2);
      const double all = side * side * side * 0.02 * pi / 6.0 + std::max(0.0, thickness) * area;
      const std::string file = scratch_file("liquid.restart");
      double bridges = 0.0, before = 0.0;
      std::set<long> pairs;
      const std::string half = integrator.run(steps / 2);
      SCOPED_TRACE(split + " " + integrator.name);
      {
        Simulation sim;
        sim.run(sheared(split, film, side) + measuring + shearing(integrator) + half);
        const auto first_pairs = bridged(sim);
        sim.run(half);
        pairs = bridged(sim);
        EXPECT_GT(ruptured(first_pairs, pairs), 0);
        sim.run("write_restart " + file);
        before = sim.value("c_sum + f_w[12]");
        sim.run("compute bonds all reduce sum c_agg[5]\nrun 0 post no");
        bridges = sim.value("c_bonds");
        EXPECT_GT(bridges, 30.0);
        EXPECT_NEAR(before / all, 1.0, 1e-12);
      }
      const FewerRanks fewer;
      if (!fewer.take_part) continue;
      Simulation sim({}, fewer.comm);
      sim.run(
          "atom_modify map array\nread_restart " + file +
          "\ncomm_modify vel yes\nneighbor 0.4 bin\n"
          "variable top equal zhi\nfix w all wall/levelset plane z 0 $(v_top) jkr 1.0e5 0.25 1.0 "
          "damping alpha 0.5 sliding 0.3 bridge 0.02 5.0 0 0.05 0.01 " +
          split + film + "\n" + measuring + shearing(integrator) +
          "compute bonds all reduce sum c_agg[5]\nrun 0 post no");
      EXPECT_EQ(sim.value("c_bonds"), bridges);
      EXPECT_EQ(bridged(sim), pairs);
      sim.run(integrator.run(steps));
      EXPECT_GT(ruptured(pairs, bridged(sim)), 0);
      expect_criterion(
          integrator.of("C22 *: liquid of all bodies over that in the beginning, less 1"),
          std::fabs(sim.value("c_sum + f_w[12]") / all - 1.0), 0.0, 1e-12);
      sim.run("compute least all reduce min c_agg[6]\nrun 0 post no");
      EXPECT_GE(sim.value("c_least"), 0.0);
      std::remove(file.c_str());
    }
}

// A bridge takes a share of both; at rupture each gets half.
TEST(BridgeStyle, liquid_moves_from_the_wet_to_the_dry)
{
  Liquid water;
  for (const bool even : {true, false}) {
    Simulation sim;
    Scene scene;
    scene.types = 2;
    scene.type = {1, 2};
    Liquid less = water;
    less.l = 0.001;
    const std::string rest = std::string("inventory 0.5 ") + (even ? "even" : "origin") + "\n";
    scene.style = "pair_style granular/adhesive\npair_coeff 1 1 " + elastic + water.words() + rest +
        "pair_coeff 2 2 " + elastic + less.words() + rest + "pair_coeff 1 2 " + elastic +
        water.words() + rest;
    build(sim, {{3.0, 4.0, 4.0}, {3.9999, 4.0, 4.0}}, scene);
    sim.run("compute b all aggregate/contact\nrun 0");
    const double a = 0.01 * pi / 6.0, b = 0.001 * pi / 6.0;
    EXPECT_NEAR(of_atom(sim, 1, 6) / a, 1.0, 1e-12);
    Liquid both = water;
    both.l = 0.5 * (0.01 + 0.001);
    sim.run("set atom 2 x 4.05\nrun 0");
    EXPECT_NEAR(sim.value("fx[1]") / both.pull(0.05), 1.0, 1e-10);
    sim.run("set atom 2 x 4.5\nrun 0\nrun 1");
    EXPECT_EQ(of_atom(sim, 1, 5), 0.0);
    EXPECT_NEAR(of_atom(sim, 1, 6) / (even ? 0.5 * a + 0.25 * (a + b) : a), 1.0, 1e-12);
    EXPECT_NEAR(of_atom(sim, 2, 6) / (even ? 0.5 * b + 0.25 * (a + b) : b), 1.0, 1e-12);
  }
}

// A wall with a film gives the share of what lies under the particle, pi r^2 of it.
TEST(BridgeStyle, film_of_a_wall_gives_and_takes)
{
  const Liquid water;
  const double f = 0.5, thickness = 0.01, own = water.l * pi / 6.0;
  const double given = f * thickness * pi * 0.25, taken = f * own, wall = thickness * 64.0;
  for (const bool even : {true, false}) {
    Simulation sim;
    Scene scene;
    scene.boundary = "f p p";
    const std::string law = elastic + water.words() + "inventory 0.5 " + (even ? "even" : "origin");
    scene.style = granular(law) + "fix w all wall/levelset plane x 0 NULL " + law + " film 0.01\n";
    build(sim, {{0.4999, 4.0, 4.0}, {4.0, 6.0, 4.0}}, scene);
    sim.run("timestep 1.0e-13\ncompute b all aggregate/contact\nrun 0");
    EXPECT_NEAR(sim.value("f_w[11]") / (given + taken), 1.0, 1e-12) << "in the bridge";
    EXPECT_NEAR(sim.value("f_w[12]") / wall, 1.0, 1e-12);
    EXPECT_NEAR(sim.value("f_w[1][16]") / (wall - given), 1.0, 1e-12) << "on the zone";
    EXPECT_NEAR(of_atom(sim, 1, 6) / own, 1.0, 1e-12);
    sim.run("set atom 1 x 1.5\nrun 0 post no\nrun 1 post no");
    const double back = even ? 0.5 * (given + taken) : given;
    EXPECT_EQ(sim.value("f_w[10]"), 0.0);
    EXPECT_NEAR(sim.value("f_w[12]") / (wall - given + back), 1.0, 1e-12);
    EXPECT_NEAR(of_atom(sim, 1, 6) / (own - taken + (given + taken - back)), 1.0, 1e-12);
    EXPECT_GT(std::fabs(taken - given), 0.1 * given) << "else a swap would not show";
  }
  Simulation sim;
  Scene scene;
  scene.boundary = "f p p";
  build(sim, {{2.0, 4.0, 4.0}}, scene);
  const std::string fix = "fix v all wall/levelset plane x 0 NULL " + elastic + water.words();
  EXPECT_NE(sim.error_of(fix + "film 0.01").find("needs a law with keyword inventory"),
            std::string::npos);
  EXPECT_NE(sim.error_of(fix + "inventory 0.5 film thick").find("film must be a number"),
            std::string::npos);
  for (const std::string thickness : {"-1", "8.1"})
    EXPECT_NE(sim.error_of(fix + "inventory 0.5 film " + thickness)
                  .find("longest side of the box, got " + thickness),
              std::string::npos);
}

// film 0 gives back what the wall has got; a film that begins after a restart comes on top of it.
TEST(BridgeStyle, film_begins_dry_or_after_a_restart)
{
  const Liquid water;
  const std::string file = scratch_file("film.restart");
  const std::string law = elastic + water.words() + "inventory 0.5 even";
  const std::string wall = "fix w all wall/levelset plane x 0 NULL " + law;
  const double own = water.l * pi / 6.0, got = 0.25 * own;
  for (const bool film : {false, true}) {
    Simulation sim;
    Scene scene;
    scene.boundary = "f p p";
    scene.style = granular(law) + wall + (film ? " film 0\n" : "\n");
    build(sim, {{0.4999, 4.0, 4.0}}, scene);
    sim.run("timestep 1.0e-13\nrun 0\nset atom 1 x 1.5\nrun 0 post no\nrun 1 post no");
    EXPECT_NEAR(sim.value("f_w[12]") / got, 1.0, 1e-12);
    if (!film) sim.run("write_restart " + file);
    sim.run("set atom 1 x 0.4999\nrun 0 post no");
    const double given = film ? 0.5 * got / 64.0 * pi * 0.25 : 0.0;
    EXPECT_NEAR(sim.value("f_w[11]") / (0.5 * (own - got) + given), 1.0, 1e-12);
    EXPECT_NEAR(sim.value("f_w[1][16]") / (got - given), 1.0, 1e-12);
  }
  Simulation sim;
  sim.run("atom_modify map array\nread_restart " + file + "\ncomm_modify vel yes\n" + wall +
          " film 0.01\nrun 0");
  EXPECT_NEAR(sim.value("f_w[12]") / (got + 0.64), 1.0, 1e-12);
  std::remove(file.c_str());
}

// Two that a bridge alone joins, and one apart.
TEST(BridgeStyle, aggregates_know_the_atoms_of_bridges)
{
  const Liquid water;
  for (const std::string change : {"delete_atoms group one compress no", "set atom 2 x 4.06"}) {
    Simulation sim;
    Scene scene;
    scene.style = granular(elastic + water.words() + "inventory 0.5");
    build(sim, {{3.0, 4.0, 4.0}, {3.9999, 4.0, 4.0}, {6.0, 6.0, 6.0}}, scene);
    sim.run("group one id 1\ncompute b all aggregate/contact\ncompute one one aggregate/contact\n"
            "compute sum all reduce sum c_one[5] c_one[6]\n"
            "thermo_style custom step c_sum[1] c_sum[2]\n"
            "timestep 1.0e-13\nrun 0\nset atom 2 x 4.05\nrun 0");
    EXPECT_EQ(of_atom(sim, 1, 2), 2.0);
    EXPECT_EQ(sim.value("c_sum[1]"), 0.0) << "the other one is not in the group";
    EXPECT_NEAR(sim.value("c_sum[2]") / water.V(), 1.0, 1e-12) << "all liquid of the one";
    sim.run("run 0\n" + change);
    EXPECT_NE(sim.error_of("print $(c_b[3])").find("use run 0 first"), std::string::npos) << change;
    sim.run("run 0");
    EXPECT_EQ(of_atom(sim, 2, 2), change[0] == 'd' ? 1.0 : 2.0);
  }
}

// Two that a bridge joins, parted by a command: each has its own share again.
TEST(BridgeStyle, liquid_of_bridges_that_commands_end_goes_back)
{
  const Liquid water;
  const std::string dry = "pair_coeff * * " + elastic + "\n";
  for (const std::string &change :
       {std::string("set atom 2 x 5.5"), std::string("delete_atoms group one compress no"), dry}) {
    SCOPED_TRACE(change);
    Simulation sim;
    Scene scene;
    scene.style = granular(elastic + water.words() + "inventory 0.5");
    build(sim, {{3.0, 4.0, 4.0}, {3.9999, 4.0, 4.0}, {6.0, 6.0, 6.0}}, scene);
    sim.run("group one id 1\ncompute b all aggregate/contact\ncompute sum all reduce sum c_b[6]\n"
            "thermo_style custom step c_sum\ntimestep 1.0e-13\nrun 0");
    EXPECT_EQ(of_atom(sim, 2, 5), 1.0) << "bridges";
    EXPECT_NEAR(sim.value("c_sum") / water.V(), 3.0, 1e-12);
    sim.run(change + "\nrun 0");
    EXPECT_EQ(of_atom(sim, 2, 5), 0.0);
    EXPECT_NEAR(of_atom(sim, 2, 6) / water.V(), 1.0, 1e-12);
    EXPECT_NEAR(sim.value("c_sum") / water.V(), change[0] == 'd' ? 2.0 : 3.0, 1e-12);
  }
}

TEST(BridgeStyle, liquid_is_counted_by_pairs_and_walls_or_by_neither)
{
  const Liquid water;
  const std::string wet = elastic + water.words(), counted = wet + "inventory 0.5 ";
  const auto error = [](const std::string &pair, const std::string &wall, const std::string &more) {
    Simulation sim;
    Scene scene;
    scene.boundary = "f p p";
    scene.style = granular(pair) + "fix w all wall/levelset plane x 0 NULL " + wall + "\n";
    build(sim, {{2.0, 4.0, 4.0}}, scene);
    return sim.error_of(more + "run 0");
  };
  EXPECT_EQ(error(wet, wet, ""), "");
  EXPECT_EQ(error(elastic, wet, ""), "");
  EXPECT_EQ(error(counted, elastic, ""), "") << "a wall without bridges";
  EXPECT_EQ(error(counted, counted, "run_style respa 2 4 pair 1\n"), "");
  EXPECT_NE(error(wet, counted, "").find("w keyword inventory needs a pair style"),
            std::string::npos);
  EXPECT_NE(error(counted, wet, "").find("w keyword bridge needs keyword inventory"),
            std::string::npos);
  EXPECT_NE(error(counted, counted, "fix_modify w respa 2\nrun_style respa 2 4 pair 1\n")
                .find("w keyword inventory needs the level"),
            std::string::npos);
}

// Films thicker than their bridge would hold: it forms where it would hold, at the rupture length
// at rest of the volume that it gets.
TEST(BridgeStyle, films_thicker_than_the_rupture_length_make_bridges)
{
  Liquid water;
  for (const bool wall : {true, false}) {
    // a wall's film of 0.2, of which a bridge takes 2 l pi d^3/6; a share of 1e-6 of the spheres'
    water.l = wall ? 0.001 : 0.01;
    water.R = wall ? 0.5 : 0.25;
    const std::string law =
        elastic + water.words() + "form film inventory " + (wall ? "0.5 " : "1e-6 ");
    const double films = wall ? 0.2 : water.film_gap();
    const double longest =
        (1.0 + 0.5 * water.angle()) * std::cbrt((wall ? 2.0 : 2.0e-6) * water.V());
    EXPECT_LT(longest, 0.8 * films);
    for (const bool sub_steps : {false, true}) {
      SCOPED_TRACE(testing::Message() << wall << sub_steps);
      Simulation sim;
      Scene scene;
      scene.boundary = "f p p";
      scene.style = granular(law);
      if (wall) scene.style += "fix w all wall/levelset plane x 0 NULL " + law + "film 0.2\n";
      // a sphere at the wall, or two
      std::vector<Sphere> spheres = {{(wall ? 0.5 : 5.0) + 1.1 * longest, 4.0, 4.0}};
      if (!wall) spheres.push_back({4.0, 4.0, 4.0});
      build(sim, spheres, scene);
      const double step = 0.05 * longest;    // 4 of them, and after the second one the bridge
      set_motion(sim, 1, {-1.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("compute b all aggregate/contact\n" +
              (sub_steps ? mts(8, step / 8.0) : verlet(step)) + "run 1\n");
      EXPECT_EQ(of_atom(sim, 1, 5), 0.0) << "at 1.05 of the rupture length";
      sim.run("run 2");
      EXPECT_EQ(of_atom(sim, 1, 5), 1.0) << "at 0.95 or less";
    }
  }
}
