// run pre no after commands that made, replaced or took away what styles know of each other, or
// changed the box or the atoms.

#include "scenes.h"

namespace {

const char *const asks = "use run without pre no";

// Two dusty spheres in a moving fluid near a wall, with all styles that know of each other.
void dusty(Simulation &sim, const std::string &integrator)
{
  Scene scene = beside_a_wall();
  scene.style += "fix air all flow/field uniform 0 0.1 0 density 1 viscosity 1\n"
                 "fix fog all flow/concentration 8 8 8 cloud 0.9\n"
                 "fix drag all flow/force air drag difelice concentration fog\n"
                 "fix in all inlet/flow y 1 air number 1 every 1000 diameter 1 density 1 type 1 "
                 "seed 1\n";
  build(sim, {{0.499, 4.0, 4.0}, {1.497, 4.0, 4.0}}, scene);
  // thermo asks for none of them: LAMMPS's own would look at fixes that are gone
  sim.run(integrator + "thermo_style custom step\nrun 5\nrun 5 pre no\n");
}

const std::string by_mts = mts(4), by_verlet = "fix nve all nve/sphere\n";

TEST(RunGuard, a_run_without_setup_refuses_what_it_does_not_know)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string &change :
         {integrator, std::string("unfix drag"), std::string("unfix air"), std::string("unfix in"),
          std::string("unfix fog"),
          std::string("fix air all flow/field uniform 0 0.2 0 density 1 viscosity 1"),
          std::string("fix drag all flow/force air drag schiller"),
          std::string("fix dragged all flow/force air drag stokes"),
          std::string("fix fog all flow/concentration 4 4 4 cloud 0.9"),
          "fix floor all wall/levelset cylinder z 2 2 1 outside" + jkr,
          std::string("pair_style none"), adhesive, "pair_style none\n" + adhesive,
          "pair_coeff * *" + jkr}) {
      SCOPED_TRACE(integrator + change);
      // LAMMPS itself asks the pair style that is gone, but for collision steps, which come before
      if (change == "pair_style none" && integrator == by_verlet) continue;
      Simulation sim;
      dusty(sim, integrator);
      sim.run(change);
      const std::string said = sim.error_of("run 5 pre no");
      EXPECT_NE(said.find(asks), said.npos) << said;
    }
}

TEST(RunGuard, a_wall_that_is_gone_or_new_is_refused)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change : {"unfix w", "replace"}) {
      SCOPED_TRACE(change);
      Scene scene;
      scene.boundary = "f p p";
      scene.style = adhesive + "fix w all wall/levelset plane x 0 NULL" + jkr + "\n";
      Simulation sim;
      build(sim, {{0.499, 4.0, 4.0}, {1.497, 4.0, 4.0}}, scene);
      sim.run(integrator + "thermo_style custom step\nrun 5");
      sim.run(change == "replace" ? "fix w all wall/levelset plane x 0 NULL" + jkr : change);
      const std::string said = sim.error_of("run 5 pre no");
      EXPECT_NE(said.find("fix w was made, replaced or taken away"), said.npos) << said;
      EXPECT_NE(said.find(asks), said.npos) << said;
    }
}

// radii and laws of contacts are found where a run is set up
TEST(RunGuard, changed_diameters_masses_and_types_are_refused)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change : {"set atom 2 diameter 1.001", "set atom 2 density 1.1",
                                     "set atom 1 mass 0.6", "set atom 1 type 2"}) {
      SCOPED_TRACE(integrator + change);
      Scene scene = beside_a_wall();
      scene.types = 2;
      Simulation sim;
      build(sim, {{0.499, 4.0, 4.0}, {1.497, 4.0, 4.0}}, scene);
      sim.run(integrator + "thermo_style custom step\nrun 5\nrun 5 pre no");
      const std::string said = sim.error_of(change + "\nrun 5 pre no");
      EXPECT_NE(said.find("has changed diameters, masses or types"), said.npos) << said;
      EXPECT_NE(said.find(asks), said.npos) << said;
      EXPECT_EQ(sim.error_of("run 5\nrun 5 pre no"), "");
    }
}

// Numbers of spheres and changes at which a weak hash takes other sizes for those of before.
TEST(RunGuard, diameters_of_many_are_told_apart)
{
  for (const int n : {1024, 1631}) {
    Scene scene;
    scene.boundary = "f f f";
    scene.box = "0 40 0 40 0 40";
    Simulation sim;
    build(sim, {}, scene);
    std::vector<double> x;
    for (int k = 0; k < n; k++)
      x.insert(x.end(), {2.0 + 2.5 * (k % 14), 2.0 + 2.5 * (k / 14 % 14), 2.0 + 2.5 * (k / 196)});
    add_spheres(sim, x, std::vector<double>(x.size(), 0.0));
    sim.run(by_verlet + "thermo_style custom step\nrun 1");
    const std::string said = sim.error_of("set group all diameter 2 density 1\nrun 1 pre no");
    EXPECT_NE(said.find("has changed diameters, masses or types"), said.npos) << n << said;
  }
}

// lists, images and grids are those of the box in which a run was set up
TEST(RunGuard, a_box_that_a_command_changed_is_refused)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change :
         {"y final 0 10", "z delta 0 -0.5 remap", "boundary f f p", "triclinic"}) {
      SCOPED_TRACE(integrator + change);
      Simulation sim;
      dusty(sim, integrator);
      const std::string said = sim.error_of("change_box all " + change + "\nrun 5 pre no");
      EXPECT_NE(said.find("the box was changed since the last run"), said.npos) << said;
      EXPECT_NE(said.find(asks), said.npos) << said;
      if (change == "triclinic") continue;    // a concentration needs an orthogonal box
      EXPECT_EQ(sim.error_of("run 5\nrun 5 pre no"), "");
    }
  // a run of no steps finds nothing anew, and so it is without contacts
  for (const std::string &style : {adhesive, std::string()}) {
    Scene scene;
    scene.style = style +
        "fix air all flow/field uniform 0 0.1 0 density 1 viscosity 1\n"
        "fix drag all flow/force air drag stokes\n";
    Simulation sim;
    build(sim, {{2.0, 4.0, 4.0}, {2.998, 4.0, 4.0}}, scene);
    sim.run(by_verlet + "run 5\nchange_box all y final 0 10\nrun 0 pre no");
    const std::string said = sim.error_of("run 5 pre no");
    EXPECT_NE(said.find("the box was changed since the last run"), said.npos) << said;
  }
}

// but not one that a fix or a border that shrinks changes within a run
TEST(RanksRunGuard, a_box_that_a_run_changed_is_taken)
{
  const std::string by_nph = "fix nve all nph/sphere iso 1 1 1\n", box = "lx+2*ly+4*lz+8*xy",
                    deform = "fix d all deform ", shrinks = "shrinks", nothing = "nothing",
                    go = "run 150 start 0 stop 600 pre ";
  const std::vector<std::pair<std::string, std::string>> scenes = {
      {by_mts, nothing},
      {by_mts, shrinks},
      {by_mts, deform + "1 y erate 2 remap v"},
      {by_verlet, shrinks},
      {by_verlet, deform + "1 y erate 2 remap v"},
      {by_verlet, deform + "3 xy erate 1 remap v"},
      {by_verlet, "fix p all press/berendsen iso 1 1 1 modulus 1000"},
      {by_nph, nothing}};
  for (const auto &[integrator, moves] : scenes) {
    SCOPED_TRACE(integrator + moves);
    Scene scene;
    scene.boundary = moves == shrinks ? "p s s" : "p p p";
    if (moves.find("xy") != moves.npos) scene.style += "change_box all triclinic\n";
    Simulation sim;
    build(sim, {{7.5, 4.0, 4.0}, {8.498, 4.0, 4.0}, {2.0, 2.0, 2.0}, {6.0, 6.0, 6.0}}, scene);
    for (int id = 1; id <= 4; id++) set_motion(sim, id, {8.0, 4.0, id * 8.0}, {0.0, 0.0, 0.0});
    if (moves.find("fix") == 0) sim.run(moves);
    sim.run(integrator + "thermo_style custom step lx xy press\nneighbor 0.2 bin\n" + go + "yes");
    const double before = sim.value(box);
    EXPECT_EQ(sim.error_of(go + "no\nvelocity all set 0 1 0\n" + go + "no"), "");
    EXPECT_EQ(sim.value(box) != before, moves != nothing || integrator == by_nph);
    const std::string said = sim.error_of("change_box all y delta 0 0.5\n" + go + "no");
    EXPECT_NE(said.find("the box was changed since the last run"), said.npos) << said;
  }
}

// forces are those of where atoms were
TEST(RunGuard, moved_atoms_are_refused)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change :
         {"set atom 2 x 1.4", "displace_atoms all move 0 1e-9 0",
          "displace_atoms all move 0 0.3 0\nvelocity all set 0 0 0\nrun 0 pre no"}) {
      SCOPED_TRACE(integrator + change);
      Simulation sim;
      build(sim, {{0.499, 4.0, 4.0}, {1.497, 4.0, 4.0}}, beside_a_wall());
      sim.run(integrator + "run 5\nrun 5 pre no\n" + change);
      const std::string said = sim.error_of("run 5 pre no");
      EXPECT_NE(said.find("has moved atoms"), said.npos) << said;
      EXPECT_NE(said.find(asks), said.npos) << said;
      EXPECT_EQ(sim.error_of("run 5\nrun 5 pre no"), "");
    }
}

// An integrator that was given before the contacts has moved atoms when these look at them.
TEST(RunGuard, an_integrator_before_the_pair_style_is_taken)
{
  for (const std::string &wall :
       {std::string(), "fix w all wall/levelset plane x 0 NULL" + jkr + "\n"}) {
    Scene scene;
    scene.boundary = "f p p";
    scene.style = by_verlet + adhesive + wall;
    Simulation sim;
    build(sim, {{0.499, 4.0, 4.0}, {1.497, 4.0, 4.0}}, scene);
    sim.run("velocity all set 0 1 0\nrun 5\nrun 5 pre no");
    EXPECT_EQ(sim.error_of("run 5 pre no"), "");
  }
}

// What others change, and does not go into what our styles know, is no reason to refuse.
TEST(RunGuard, other_commands_between_runs_are_taken)
{
  for (const std::string &integrator : {by_mts, by_verlet})
    for (const std::string change :
         {"fix out all print 1000 hello", "velocity all set 0.1 0 0", "compute ke all ke",
          "set atom 1 vx 0.1 omega 0 0 1", "run 0 pre no"}) {
      SCOPED_TRACE(change);
      Simulation sim;
      dusty(sim, integrator);
      EXPECT_EQ(sim.error_of(change + "\nrun 5 pre no"), "");
    }
}

// nor is what a minimiser makes for itself and takes away
TEST(RunGuard, runs_after_minimize_are_taken)
{
  Simulation sim;
  build(sim, {{2.0, 4.0, 4.0}, {2.999, 4.0, 4.0}});
  sim.run("fix nve all nve/sphere\nthermo_style custom step\nrun 1\nminimize 0 0 3 3");
  EXPECT_EQ(sim.error_of("run 5 pre no"), "");
}

// and what a variable is now counts, also one that was made anew; one that is gone is named
TEST(RunGuard, variables_are_looked_for_in_a_run_without_setup)
{
  Simulation sim;
  sim.run("variable u equal 0.1\nvariable w equal 0.0");
  Scene scene;
  scene.boundary = "f p p";
  scene.style = adhesive + "fix w all wall/levelset plane x 0 NULL" + jkr +
      "move linear 0 v_w 0\nfix air all flow/field uniform 0 v_u 0 density 1 viscosity 1\n"
      "fix drag all flow/force air drag stokes\n";
  build(sim, {{2.0, 4.0, 4.0}}, scene);
  sim.run(by_verlet +
          "thermo_style custom step\nrun 5\n"
          "variable u delete\nvariable other equal 7\nvariable u equal 0.3\nrun 5 pre no");
  EXPECT_EQ(sim.value("f_air[2]"), 0.3);
  EXPECT_NE(sim.error_of("variable w delete\nrun 5 pre no").find("variable w does not exist"),
            std::string::npos);
}

}    // namespace
