// What scripts do between runs: atoms deleted, moved and renumbered, walls and regions taken away,
// outputs asked for before and after.

#include "scenes.h"
#include "temporary_file.h"

#include "atom.h"
#include "update.h"

#include <array>
#include <cmath>
#include <cstdio>

namespace {

void expect_error(Simulation &sim, const std::string &command, const std::string &words)
{
  const std::string said = sim.error_of(command);
  EXPECT_NE(said.find(words), said.npos) << command << ": " << said;
}

// Spheres that touch across the box's borders in x and y and lie on a wall.
void pile(Simulation &sim, const std::string &integrator)
{
  Scene scene;
  scene.boundary = "p p f";
  scene.style = adhesive +
      "region part block 0 4 0 8 0 8\nregion right block 4 8 0 8 0 8\n"
      "fix w all wall/levelset plane z 0 8" +
      jkr + "zone part part\n";
  build(sim, {}, scene);
  std::vector<double> x;
  for (int n = 0; n < 128; n++)
    x.insert(x.end(), {0.5 + 0.999 * (n % 8), 0.5 + 0.999 * (n / 8 % 8), 0.499 + 0.998 * (n / 64)});
  add_spheres(sim, x, std::vector<double>(x.size(), 0.0));
  // thermo asks for none of them, since values of a step are kept
  sim.run(integrator + "compute agg all aggregate/contact\ncompute dep all wall/deposit w\n" +
          "thermo_style custom step\nrun 10");
}

const std::string by_mts = mts(4), by_verlet = "fix nve all nve/sphere\n";

TEST(BetweenRuns, outputs_after_atoms_have_moved_ask_for_run_0)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change :
         {"displace_atoms all move 0 0 0.01", "delete_atoms region right",
          "delete_atoms region right compress no", "delete_atoms group all", "reset_atoms id",
          "create_atoms 1 single 4 4 5 units box\nset group all diameter 1 density 1"}) {
      SCOPED_TRACE(change);
      Simulation sim;
      pile(sim, integrator);
      sim.run(change);
      expect_error(sim, "write_dump all custom /dev/null id c_agg[1]", "use run 0 first");
      for (const std::string output : {"c_agg[3]", "c_dep[1]", "f_w[1][9]", "f_w[2][13]", "f_w"})
        expect_error(sim, "print $(" + output + ")", "use run 0 first");
      sim.run("run 0");
      const bool some = change != "delete_atoms group all";
      EXPECT_EQ(sim.value("c_agg[3]") > 1.0, some);
      EXPECT_EQ(sim.value("c_dep[1]") > 0.0, some && change.find("displace") != 0);
    }
}

// Rerun takes no steps, and initialises fixes at each frame.
TEST(BetweenRuns, rerun_says_nothing_of_the_timestep)
{
  const TemporaryFile file("apf_frames", ".dump");
  Simulation sim;
  pile(sim, by_verlet);
  sim.run("write_dump all custom " + file.path + " id x y z\nunfix nve\ntimestep 1");
  const std::string words = " is too large for the ";
  EXPECT_NE(log_of(sim, "run 0\n").find(words), std::string::npos);
  const std::string log = log_of(sim, "rerun " + file.path + " dump x y z\n");
  EXPECT_EQ(log.find(words), std::string::npos) << log;
  EXPECT_NE(log_of(sim, "run 0\n").find(words), std::string::npos);
}

TEST(BetweenRuns, what_was_taken_away_is_named)
{
  for (const std::string &integrator : {by_mts, by_verlet}) {
    Simulation sim;
    pile(sim, integrator);
    const double steps = integrator == by_mts ? 1.0 : 0.0;
    const auto contacts = [&] {
      return steps > 0.0 ? sim.value("f_nve[3]") : 0.0;
    };
    const double all = contacts(), at_wall = sim.value("f_w[7]");
    EXPECT_EQ(at_wall, 64.0);
    sim.run("region part delete");
    expect_error(sim, "print $(f_w[1][9])", "region part of zone part does not exist any more");
    sim.run("unfix w");
    EXPECT_EQ(contacts(), all - steps * at_wall);
    expect_error(sim, "print $(c_dep[1])", "needs the ID of a fix wall/levelset, got w");
    sim.run("uncompute dep\npair_style none");
    EXPECT_EQ(contacts(), 0.0);
    expect_error(sim, "print $(c_agg[3])", "needs a pair style that keeps contacts");
  }
}

TEST(BetweenRuns, a_run_without_setup_needs_the_lists_of_the_last_one)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change :
         {"displace_atoms all move 0.4 0.3 0", "delete_atoms group one"}) {
      Simulation sim;
      pile(sim, integrator);
      // else the first step builds lists anew
      sim.run("neigh_modify every 1000 delay 1000\nrun 0\nrun 5 pre no\ngroup one id 1\nvelocity "
              "all set 0.1 0.1 0\nrun 5 pre no\n" +
              change);
      expect_error(sim, "run 5 pre no", "use run without pre no");
      sim.run("run 5\nrun 5 pre no");
    }
}

TEST(BetweenRuns, an_inlet_has_let_in_nothing_before_its_first_run)
{
  Simulation sim;
  Scene scene;
  scene.boundary = "f p p";
  build(sim, {}, scene);
  sim.run("fix air all flow/field uniform 1 0 0 density 1 viscosity 1\n"
          "fix in all inlet/flow x 1 air number 1 every 10 diameter 1 density 1 type 1 seed 1");
  for (int n = 1; n <= 10; n++) EXPECT_EQ(sim.value("f_in[" + std::to_string(n) + "]"), 0.0) << n;
}

// A new particle that gets the ID of a deleted one is not in its contacts.
TEST(BetweenRuns, contacts_of_deleted_particles_do_not_come_back)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const bool deleted : {false, true}) {
      Simulation sim;
      build(sim, {{4.0, 4.0, 4.0}, {4.995, 4.0, 4.0}, {4.0, 4.0, 6.0}});
      sim.run(integrator +
              "compute agg all aggregate/contact\nthermo_style custom step c_agg[1]\n"
              "run 2");
      EXPECT_EQ(sim.value("c_agg[1]"), 2.0);
      // within reach of the neck, but not of first touch
      if (deleted)
        sim.run("group two id 2\ndelete_atoms group two compress no\n"
                "create_atoms 1 single 5.0005 4 4\nset atom 2 diameter 1 density 1");
      else
        sim.run("set atom 2 x 5.0005");
      sim.run("velocity all set 0 0 0\nrun 0");
      EXPECT_EQ(sim.value("c_agg[1]"), deleted ? 0.0 : 2.0);
    }
}

TEST(BetweenRuns, particles_at_one_place_or_without_numbers_are_refused)
{
  for (const std::string &integrator : {by_mts, by_verlet}) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.0, 4.0, 4.0}, {1.0, 1.0, 1.0}});
    sim.run(integrator);
    expect_error(sim, "run 1", "pairs of particles at one place, between which no direction is: 1");
  }
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}, {1.0, 1.0, 1.0}});
  sim.run(by_mts + "run 1\nset atom 2 vx 1e200");
  expect_error(sim, "run 1", "is no finite number for 1 particles (IDs 2)");
}

// What laws divide by: told with the value, by whatever style is there, and the run goes on when it
// is mended.
TEST(BetweenRuns, sizes_and_masses_that_laws_cannot_take_are_refused)
{
  const std::string wall = "fix w all wall/levelset plane x 0 NULL" + jkr + "\n";
  const std::vector<std::pair<std::string, std::vector<std::string>>> changes = {
      {"diameter v_inf", {"needs radii that are finite numbers", "atom 1 has inf"}},
      {"diameter v_nan", {"needs radii that are finite numbers", "atom 1 has ", "nan"}},
      {"density v_inf", {"needs masses that are finite numbers", "atom 1 has inf"}},
      {"density v_nan", {"needs masses that are finite numbers", "atom 1 has ", "nan"}},
      {"mass 1e-310", {"needs masses", "as are their reciprocals; atom 1 has 1e-310"}},
      {"diameter 2e-310", {"needs radii", "as are their reciprocals; atom 1 has 1e-310"}}};
  for (const auto &[who, style, integrator] :
       {std::array<std::string, 3>{"Pair granular/adhesive", adhesive + wall, by_mts},
        {"Pair granular/adhesive", adhesive, by_verlet},
        {"Fix wall/levelset", wall, by_verlet},
        {"Fix flow/force",
         "fix air all flow/field uniform 0 0.1 0 density 1 viscosity 1\n"
         "fix drag all flow/force air drag stokes\n",
         by_verlet}})
    for (const auto &[change, words] : changes) {
      SCOPED_TRACE(who + change);
      Scene scene = beside_a_wall();
      scene.style = style;
      Simulation sim;
      build(sim, {{2.0, 4.0, 4.0}, {5.0, 4.0, 4.0}}, scene);
      sim.run(integrator + "variable inf atom exp(1000)\nvariable nan atom exp(1000)-exp(1000)\n" +
              "run 1\nset atom 1 " + change);
      const std::string said = sim.error_of("run 1");
      EXPECT_NE(said.find(who), said.npos) << said;
      for (const auto &word : words) EXPECT_NE(said.find(word), said.npos) << said;
      EXPECT_EQ(sim.error_of("set atom 1 diameter 1 density 1\nrun 1"), "");
    }
}

// Comparisons pass over them, and no list is built: what a command made is told before the run,
// what a force makes of them (inf - inf from step 4 on) in the 100th step, or at the end.
TEST(BetweenRuns, numbers_of_particles_that_are_not_finite)
{
  const std::string words = "is no finite number for 1 particles (IDs 2)",
                    nothing = "pair_style zero 1\npair_coeff * *\n",
                    push = "variable f equal exp(1000*(step>3))-exp(1000*(step>3))\n"
                           "group two id 2\nfix push two addforce 0 v_f 0\n";
  const std::vector<std::string> styles = {
      adhesive, nothing + "fix w all wall/levelset plane z 0 8" + jkr,
      nothing +
          "fix air all flow/field uniform 0 0 0 density 1 viscosity 1\n"
          "fix drag all flow/force air drag stokes\n"};
  for (const auto &integrator : {by_mts, by_verlet, by_verlet + "run_style respa 2 2\n"})
    for (const auto &style : styles) {
      if (integrator == by_mts && style != adhesive) continue;    // asks for the pair style
      SCOPED_TRACE(integrator + style);
      const auto begin = [&](Simulation &sim, const std::string &more) {
        Scene scene;
        scene.boundary = "p p f";
        scene.style = style;
        build(sim, {{4.0, 4.0, 4.0}, {1.0, 1.0, 1.0}}, scene);
        sim.run(integrator + more + "run 1");
      };
      for (const double nonsense : {double(NAN), double(INFINITY)})
        for (double **LAMMPS_NS::Atom::*of : {&LAMMPS_NS::Atom::v, &LAMMPS_NS::Atom::omega}) {
          Simulation sim;
          begin(sim, "");
          auto *atom = sim.lammps()->atom;
          (atom->*of)[atom->map(2)][1] = nonsense;
          expect_error(sim, "run 1", words);
        }
      for (const int steps : {20, 150}) {
        Simulation sim;
        begin(sim, push);
        expect_error(sim, "run " + std::to_string(steps), words);
        const auto found = sim.lammps()->update->ntimestep;
        EXPECT_EQ(found, integrator == by_mts ? 5 : std::min(steps + 1, 100));
      }
    }
}

TEST(BetweenRuns, pairs_that_begin_inside_each_other_are_warned_of)
{
  const std::string warning = "WARNING: Pair granular/adhesive: pairs that begin inside each other";
  for (const double distance : {0.7, 0.99, 1.02}) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {4.0 + distance, 4.0, 4.0}});
    const std::string said = log_of(sim, by_verlet + "run 1\n");
    EXPECT_EQ(said.find(warning) != said.npos, distance < 0.9) << distance << said;
    // no longer: it is a contact now
    EXPECT_EQ(log_of(sim, "run 1\n").find(warning), said.npos);
  }
}

}    // namespace
