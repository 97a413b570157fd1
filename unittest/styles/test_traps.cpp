// Scripts that would run to their end with wrong physics: what is wrong is told before the run, and
// the script that is right is not told.

#include "scenes.h"

#include "gtest/gtest.h"

namespace {

bool has(const std::string &text, const std::string &words)
{
  return text.find(words) != std::string::npos;
}

// dust of 1 um in air, whose relaxation time is rho d^2/(18 mu) = 8.02e-6 s
const std::string dust = R"(
units si
atom_style sphere
atom_modify map array
comm_modify vel yes
neighbor 1e-5 bin
region box block 0 2e-4 0 2e-4 0 2e-4
create_box 1 box
create_atoms 1 single 1e-4 1e-4 1e-4
set group all diameter 1e-6 density 2600
pair_style granular/adhesive
pair_coeff * * jkr 1e7 0.3 0.02
fix air all flow/field uniform 0 0 0 density 1.2 viscosity 1.8e-5
)";
constexpr double tau = 2600.0 * 1e-12 / (18.0 * 1.8e-5);
const std::string drag = "fix drag all flow/force air drag stokes\n";

}    // namespace

// Stokes's terminal velocity is g tau; under a force that the drag does not know of it is 1/phi
// times as large, with phi(z) = (1 - exp(-z))/z and z = h/tau.
TEST(Traps, forces_of_fixes_after_the_drag)
{
  const std::string words = "Fix flow/force drag stands before ";
  const auto settles = [&](const std::string &fixes, double h, std::string &log) {
    Simulation sim;
    sim.run(dust + fixes + "timestep " + digits(h) + "\n");
    log = log_of(sim, "run 100\n");
    return -sim.value("vz[1]") / (9.81 * tau);
  };
  const std::string weight = "fix g all gravity 9.81 vector 0 0 -1\n";
  for (const std::string move :
       {"fix move all nve/sphere\n", "fix move all nve/sphere/mts collision auto\n"}) {
    SCOPED_TRACE(move);
    std::string log;
    const double h = 1e-4, z = h / tau;
    EXPECT_NEAR(settles(drag + weight + move, h, log), z / (1.0 - std::exp(-z)), 1e-9);
    EXPECT_TRUE(has(log, words + "fix g gravity")) << log;
    EXPECT_TRUE(has(log, "up to 12.5 times the relaxation time")) << log;
    EXPECT_EQ(log.find(words), log.rfind(words)) << "once in a run";
    EXPECT_NEAR(settles(weight + drag + move, h, log), 1.0, 1e-9);
    EXPECT_FALSE(has(log, words)) << log;
    settles(drag + weight + move, 0.09 * tau, log);
    EXPECT_FALSE(has(log, words)) << "5 % are not told" << log;
    settles(drag + weight + move, 0.11 * tau, log);
    EXPECT_TRUE(has(log, words)) << log;
  }
}

// All that apply forces are named, none that sets or measures them, nor one of other particles.
TEST(Traps, which_fixes_apply_forces)
{
  const std::string walls = "change_box all boundary p f p\n"
                            "fix floor all wall/levelset plane y 0 NULL jkr 1e7 0.3 0.02\n";
  const auto log = [](const std::string &fixes) {
    Simulation sim;
    sim.run(dust + fixes + "timestep 1e-4\n");
    return log_of(sim, "run 0\n");
  };
  const std::string verlet = "fix move all nve/sphere\n",
                    mts = "fix move all nve/sphere/mts collision auto\n";
  const std::string text = log(drag + walls + "fix push all addforce 0 0 1e-15\n" +
                               "fix pull all spring/self 1e-9\n" + verlet);
  EXPECT_TRUE(has(text,
                  "stands before fix floor wall/levelset, fix push addforce, fix pull "
                  "spring/self: the timestep"))
      << text;
  for (const std::string &fixes :
       {drag + "fix hold all setforce NULL NULL 0\nfix keep all store/force\nfix ice all freeze\n" +
            "fix mean all ave/atom 1 1 1 fx\nfix line all lineforce 1 0 0\n" + verlet,
        drag + "group none empty\nfix g none gravity 9.81 vector 0 0 -1\n" + verlet,
        drag + walls + mts}) {
    EXPECT_FALSE(has(log(fixes), "stands before")) << fixes;
  }
}

// An empty box that an inlet fills: its particles decide.
TEST(Traps, forces_on_particles_to_come)
{
  Simulation sim;
  sim.run(dust +
          "delete_atoms group all compress no\nfix wind all flow/field uniform 0 1 0 density 1.2 "
          "viscosity 1.8e-5\n"
          "fix in all inlet/flow y 1e-5 wind number 1 diameter 1e-6 density 2600 type 1 seed 1\n" +
          drag + "fix g all gravity 9.81 vector 0 0 -1\nfix move all nve/sphere\ntimestep 1e-4\n");
  EXPECT_TRUE(has(log_of(sim, "run 0\n"), "fix g gravity: the timestep is up to 12.5 times"));
}

// The random force is a function of the step: run after run from step 0 it would be the same.
TEST(Traps, steps_of_brownian_motion_begin_anew)
{
  const std::string noise = "fix drag all flow/force air drag stokes brownian 293 4711\n",
                    steps = "timestep 1e-4\nrun 3\n", again = "reset_timestep 0\n";
  const auto error = [&](const std::string &commands) {
    Simulation sim;
    return sim.error_of(dust + "fix move all nve/sphere\n" + commands);
  };
  EXPECT_TRUE(has(error(noise + steps + again),
                  "Cannot reset timestep with time-dependent fix flow/force defined"));
  EXPECT_EQ(error(drag + steps + again + steps), "");
  EXPECT_EQ(error(drag + steps + "unfix drag\n" + again + noise + steps), "");
}

TEST(Traps, groups_that_are_empty)
{
  const std::string wall = " wall/levelset plane y 0 NULL jkr 1e7 0.3 0.02\n",
                    empty = "group dust empty\n", all = "group dust type 1\n";
  const auto log = [&](const std::string &group, const std::string &more = "") {
    Simulation sim;
    sim.run(dust + "change_box all boundary p f p\n" + group + "fix floor dust" + wall +
            "fix drag dust flow/force air drag stokes\nfix move all nve/sphere\n" + more +
            "timestep 1e-8\n");
    return log_of(sim, "run 0\n");
  };
  const std::string inlet = " inlet/flow y 1e-5 wind number 1 diameter 1e-6 density 2600 type 1 "
                            "seed 1\nfix force all flow/force wind drag stokes\n",
                    wind = "fix wind all flow/field uniform 0 1 0 density 1.2 viscosity 1.8e-5\n";
  for (const std::string &group : {empty, empty + wind + "fix in all" + inlet}) {
    const auto text = log(group);
    for (const std::string begin : {"Fix wall/levelset floor touches", "Fix flow/force drag moves"})
      EXPECT_TRUE(has(text, begin + " nothing: its group dust is empty; a group gets the")) << text;
  }
  for (const std::string &group :
       {all, empty + wind + "fix in dust" + inlet, std::string("group dust dynamic all every 1\n")})
    EXPECT_FALSE(has(log(group), "is empty")) << group;
}

TEST(Traps, box_made_periodic_across_a_plane)
{
  const auto error = [](const std::string &boundary) {
    Simulation sim;
    return sim.error_of(dust +
                        "change_box all boundary p f f\nfix floor all wall/levelset plane y 0 NULL "
                        "jkr 1e7 0.3 0.02\nfix move all nve/sphere\ntimestep 1e-8\nrun 0\n"
                        "change_box all boundary " +
                        boundary + "\nrun 0\n");
  };
  EXPECT_TRUE(has(error("p p p"),
                  "Fix wall/levelset floor: plane needs a box that is not periodic "
                  "in y"));
  EXPECT_EQ(error("p f p"), "");
}

// Particles have a radius of 5e-7, the box is 2e-4 wide.
TEST(Traps, cylinders_at_periodic_borders)
{
  const auto log = [](const std::string &boundary, const std::string &cylinder) {
    Simulation sim;
    sim.run(dust + "change_box all boundary " + boundary + "\nfix w all wall/levelset cylinder " +
            cylinder + "\nfix move all nve/sphere\ntimestep 1e-8\n");
    return log_of(sim, "run 0\n");
  };
  const std::string law = " jkr 1e7 0.3 0.02", fiber = " 2e-5 outside" + law,
                    within = "comes within a particle's radius of the periodic border ",
                    around = "around the fluid reaches the periodic border ", period = "periodic";
  EXPECT_TRUE(has(log("p p p", "z 1e-6 1e-4" + fiber), "the cylinder " + within + "x = 0, beyond"));
  EXPECT_TRUE(has(log("p p p", "z 2e-5 1.8e-4" + fiber), within + "x = 0, y = 0.0002, beyond"));
  EXPECT_TRUE(has(log("f p p", "x 2.04e-5 1.2e-4" + fiber), within + "y = 0, beyond"));
  EXPECT_FALSE(has(log("p p p", "z 2.06e-5 1.2e-4" + fiber), period));
  EXPECT_FALSE(has(log("f p p", "z 1e-6 1.2e-4" + fiber), period));
  EXPECT_FALSE(has(log("f f p", "z 1e-6 1e-6" + fiber), period));

  const std::string pipe = "z 1e-4 1e-4 ", inside = " inside" + law;
  EXPECT_TRUE(has(log("p p p", pipe + "1.2e-4" + inside),
                  around + "x = 0, x = 0.0002, y = 0, y = 0.0002, through which"));
  EXPECT_TRUE(has(log("p f p", pipe + "1e-4" + inside), around + "x = 0, x = 0.0002, through"));
  EXPECT_FALSE(has(log("p p p", pipe + "9.9e-5" + inside), period));
  EXPECT_FALSE(has(log("f f p", pipe + "1.2e-4" + inside), period));

  // where it has moved to by the time of the run
  Simulation sim;
  sim.run(dust + "fix w all wall/levelset cylinder z 3e-5 1.2e-4" + fiber +
          " move linear -1 0 0\nfix move all nve/sphere\ntimestep 1e-7\n");
  EXPECT_FALSE(has(log_of(sim, "run 100\n"), period));
  EXPECT_TRUE(has(log_of(sim, "run 0\n"), within + "x = 0, beyond"));
}

TEST(Traps, inlets_of_one_seed)
{
  const auto enter = [](const std::string &seed, std::string &log) {
    Simulation sim;
    const std::string words =
        " air number 1 diameter 1e-6 density 2600 type 1 window 5e-6 1.9e-4 5e-6 1.9e-4 seed ";
    sim.run(dust +
            "delete_atoms group all compress no\nunfix air\n"
            "fix air all flow/field uniform 1 0 0 density 1.2 viscosity 1.8e-5\n"
            "fix one all inlet/flow x 5e-5" +
            words + "1\nfix two all inlet/flow x 1e-4" + words + seed +
            "\nfix move all nve/sphere\ntimestep 1e-9\n");
    log = log_of(sim, "run 1\n");
    const auto x = gather(sim, "x");
    return x.size() == 6 && x[1] == x[4] && x[2] == x[5];
  };
  const std::string words = "Fix inlet/flow two and fix one have the same seed 1: ";
  std::string log;
  EXPECT_TRUE(enter("1", log)) << "no copies";
  EXPECT_TRUE(has(log, words)) << log;
  EXPECT_EQ(log.find("the same seed"), log.rfind("the same seed")) << "once in a run";
  EXPECT_FALSE(enter("2", log));
  EXPECT_FALSE(has(log, "the same seed")) << log;
}

// The wall has moved by 1e-5 when the file is written; its force on the sphere tells where it is.
TEST(Traps, wall_of_a_restart_that_has_lost_its_motion)
{
  const std::string file = scratch_file("restart"), begin = dust.substr(0, dust.find("fix air")),
                    wall = "fix w all wall/levelset plane x 8.952e-5 NULL jkr 1e7 0.3 0.02",
                    to_right = " move linear 1 0 0";
  const auto write = [&](const std::string &how) {
    Simulation sim;
    sim.run(begin + "change_box all boundary f p p\n" + wall + how +
            "\ntimestep 5e-9\nrun 2000\nwrite_restart " + file + "\n");
  };
  const auto read = [&](const std::string &how, std::string &log) {
    Simulation sim;
    sim.run("atom_modify map array\ncomm_modify vel yes\nread_restart " + file + "\n" +
            "neighbor 1e-5 bin\n");
    log = log_of(sim, wall + how + "\ntimestep 1e-9\nrun 0\n");
    return sim.value("f_w[7]");
  };
  const std::string words = "WARNING: Fix wall/levelset w: the wall of the restart file moves";
  std::string log;
  write(to_right);
  EXPECT_EQ(read("", log), 0.0) << "contact with a wall that should be 1.03e-5 away";
  EXPECT_TRUE(has(log, words)) << log;
  for (const std::string &how : {to_right, std::string(" move linear 0 0 0")}) {
    EXPECT_EQ(read(how, log), 1.0) << "no contact where the wall was" << how;
    EXPECT_FALSE(has(log, words)) << log;
  }
  write("");
  read("", log);
  EXPECT_FALSE(has(log, words)) << log;
  std::filesystem::remove(file);
}

// Diameters that fix adapt changes within a run are refused; between runs spheres that grow touch,
// and their force is JKR's for the radius that they have.
TEST(Traps, diameters_that_change_within_a_run)
{
  const std::string scene = "units lj\natom_style sphere 1\natom_modify map array\n"
                            "comm_modify vel yes\nboundary p f p\n"
                            "region box block 0 8 0 8 0 8\ncreate_box 1 box\n"
                            "create_atoms 1 single 3 4 4\ncreate_atoms 1 single 4.02 4 4\n"
                            "set group all diameter 1 density 1\ntimestep " +
      digits(dt) + "\nfix move all nve/sphere\n";
  const std::string none = "pair_style zero 1.2 nocoeff\npair_coeff * *\n",
                    wall = "fix w all wall/levelset plane y 0 NULL" + jkr + "\n",
                    grows = "variable d equal 1\nfix grow all adapt 1 atom diameter v_d\n";
  const auto error = [&](const std::string &commands) {
    Simulation sim;
    return sim.error_of(scene + commands + "run 1\n");
  };
  const std::string words = ": fix grow adapt changes diameters within a run";
  EXPECT_TRUE(has(error(adhesive + grows), "Pair granular/adhesive" + words));
  EXPECT_TRUE(has(error(none + wall + grows), "Fix wall/levelset w" + words));
  for (const std::string &right :
       {none + grows, adhesive + wall, adhesive + grows + "unfix grow\n"})
    EXPECT_EQ(error(right), "") << right;

  Simulation sim;
  sim.run(scene + adhesive + "unfix move\nrun 0\n");
  EXPECT_EQ(sim.value("fx[1]"), 0.0);
  for (const double d : {1.03, 1.035}) {    // the second one finds a contact
    sim.run("set group all diameter " + digits(d) + "\nrun 0\n");
    const double force = Material().pair(d, d).force(d - 1.02);
    EXPECT_NEAR(-sim.value("fx[1]") / force, 1.0, 1e-9) << d;
  }
}

// A box that is made triclinic after the command.
TEST(Traps, boxes_that_are_tilted_later)
{
  const auto error = [](const std::string &fix) {
    Simulation sim;
    sim.run(dust + "fix move all nve/sphere\ntimestep 1e-6\n" + fix);
    EXPECT_EQ(sim.error_of("run 0\n"), "") << fix;
    return sim.error_of("change_box all triclinic\nrun 0\n");
  };
  const std::string cells = "fix c all flow/concentration 16 16 16 cloud 2e-5\n";
  EXPECT_TRUE(has(error(cells), "Fix flow/concentration needs an orthogonal box"));
  EXPECT_TRUE(has(error("fix wind all flow/field uniform 1 0 0 density 1 viscosity 1\nfix in all "
                        "inlet/flow x 0 wind number 1 diameter 1e-6 density 1 type 1 "
                        "seed 7\n"),
                  "Fix inlet/flow needs an orthogonal box"));
  EXPECT_TRUE(has(error("fix drag all flow/force air drag stokes feedback 4 4 4\n"),
                  "Fix flow/force feedback needs an orthogonal box"));
  EXPECT_EQ(error("fix drag all flow/force air drag stokes\n"), "");
}

// A body of spheres of 10 and 5 um under its weight: the balance with the drag does not know of
// what holds it together. Exactly weight over the sum of drags; far beyond tau the mean of tau by
// mass takes the place of mass over drag, 33/27 = 1.222 of it.
TEST(Traps, rigid_bodies_in_a_fluid)
{
  const double large = 2600.0 * 1e-10 / (18.0 * 1.8e-5);
  std::string log;
  const auto settles = [&](double h) {
    Simulation sim;
    sim.run(
        "units si\natom_style hybrid sphere molecular\natom_modify map array\n"
        "comm_modify vel yes cutoff 1e-4\nneighbor 1e-5 bin\n"
        "region box block -1e-4 1e-4 -1e-4 1e-4 -1e-4 1e-4\ncreate_box 1 box\n"
        "create_atoms 1 single 0 0 0\ncreate_atoms 1 single 0 7.5e-6 0\nset group all mol 1\n"
        "set atom 1 diameter 1e-5 density 2600\nset atom 2 diameter 5e-6 density 2600\n"
        "pair_style zero 1e-5 nocoeff\npair_coeff * *\nneigh_modify exclude molecule/intra all\n"
        "fix air all flow/field uniform 0 0 0 density 1e-6 viscosity 1.8e-5\n"
        "fix drag all flow/force air drag stokes torque yes gravity 0 -1e-4 0\n"
        "fix body all rigid single torque 1 off off off\nthermo_style custom step\ntimestep " +
        digits(h * large) + "\n");
    log = log_of(sim, "run " + std::to_string(static_cast<int>(std::ceil(20.0 / h))) + "\n");
    return -sim.value("vcm(all,y)") / (1e-4 * large * 9.0 / (8.0 * 1.5));
  };
  const std::string words = "particles of fix body rigid, whose bonds take no part";
  EXPECT_NEAR(settles(0.01), 1.0, 0.004);    // 0.04 of tau of the smaller one
  EXPECT_FALSE(has(log, words)) << log;
  EXPECT_NEAR(settles(100.0), 33.0 / 27.0, 1e-2);
  EXPECT_TRUE(has(log, words)) << log;
}

// LAMMPS clears the forces of the included group alone.
TEST(Traps, forces_that_are_not_cleared)
{
  const std::string scene = "atom_modify first some\nneigh_modify include some\ntimestep 1e-6\nfix "
                            "move some nve/sphere\n";
  const auto error = [&](const std::string &fix) {
    Simulation sim;
    sim.run(dust +
            "create_atoms 1 single 1.5e-4 1e-4 1e-4\nset group all diameter 1e-6 density "
            "2600\nchange_box all boundary p f p\ngroup some id 1\ngroup none empty\n" +
            scene);
    return sim.error_of(fix + "run 1\n");
  };
  const std::string words =
      ": the particles of its group all must be in some, the group of neigh_modify include";
  const std::string wall = " wall/levelset plane y 0 NULL jkr 1e7 0.3 0.02\n";
  EXPECT_TRUE(has(error(drag), "Fix flow/force drag" + words));
  EXPECT_TRUE(has(error("fix w all" + wall), "Fix wall/levelset w" + words));
  for (const std::string group : {"some", "none"})
    EXPECT_EQ(error("fix drag " + group + " flow/force air drag stokes\nfix w " + group + wall),
              "");
}

// A minimiser has no step, and particles of rigid bodies have no fix nve/sphere/mts.
TEST(Traps, advice_that_cannot_be_taken)
{
  const std::string too_large = "is too large for the", mts = "use fix nve/sphere/mts";
  const auto log = [](const std::string &commands) {
    Simulation sim;
    sim.run(dust +
            "create_atoms 1 single 1e-4 1.5e-4 1e-4\nset group all diameter 1e-6 density "
            "2600\nthermo_style custom step\ntimestep 1e-6\n");
    return log_of(sim, commands);
  };
  const std::string usual = log("fix move all nve/sphere\nrun 0\n"),
                    rigid = log("fix body all rigid group 1 all\nrun 0\n"),
                    still = log("minimize 0 0 1 1\n");
  EXPECT_TRUE(has(usual, too_large) && has(usual, mts)) << usual;
  EXPECT_TRUE(has(rigid, too_large) && !has(rigid, mts)) << rigid;
  EXPECT_FALSE(has(still, too_large)) << still;
}

// fix dt/reset takes its largest step, just above or below omega h = 0.8 by JKR's closed form.
TEST(Traps, step_that_fix_dt_reset_makes_too_large)
{
  const std::string begin = dust.substr(0, dust.find("pair_style"));
  const double r = 5e-7, E = 0.5 * 1e7 / (1.0 - 0.3 * 0.3),
               m = 2600.0 * 4.0 / 3.0 * M_PI * r * r * r;
  const struct {
    std::string who, law;
    double R, m, E;
  } rows[] = {
      {"Pair granular/adhesive: timestep ", dust.substr(dust.find("pair_style")), r / 2, m / 2, E},
      {"Fix wall/levelset w: timestep ",
       "change_box all boundary p f p\npair_style zero 1e-6\npair_coeff * *\n"
       "fix w all wall/levelset plane y 0 NULL jkr 1e7 0.3 0.02\n",
       r, m, E}};
  for (const auto &row : rows)
    for (const std::string levels : {"", "run_style respa 2 4 bond 1 pair 1\n"})
      for (const double of_limit : {0.98, 1.02}) {
        SCOPED_TRACE(row.who + levels + std::to_string(of_limit));
        const double a0 = std::cbrt(9.0 * M_PI * 0.02 * row.R * row.R / row.E),
                     h = of_limit * 0.8 / std::sqrt(1.2 * row.E * a0 / row.m);
        const double outer = levels.empty() ? h : 4.0 * h;
        Simulation sim;
        sim.run(begin + row.law + levels + "fix move all nve/sphere\ntimestep 1e-10\n");
        EXPECT_FALSE(has(log_of(sim, "run 1\n"), row.who));
        const auto log =
            log_of(sim, "fix dtr all dt/reset 1 1e-10 " + digits(outer) + " 1\nrun 3\n");
        EXPECT_EQ(has(log, row.who), of_limit > 1.0) << log;
        EXPECT_EQ(log.find(row.who), log.rfind(row.who)) << "once" << log;
        // a step given by timestep is told of when the next run begins, and not before
        EXPECT_FALSE(has(log_of(sim, "unfix dtr\ntimestep 1\n"), row.who));
      }
}

// numbers so small or large that those of the contact are none
TEST(Traps, sizes_beyond_the_law)
{
  const auto said = [](const std::string &change) {
    Simulation sim;
    sim.run(dust + "unfix air\nset group all " + change +
            "\nneighbor 1e-6 bin\nfix move all nve/sphere\ntimestep 1e-10\n");
    return sim.error_of("run 1\n");
  };
  EXPECT_EQ(said("diameter 1e-6 density 2600"), "");
  for (const std::string d : {"1e-300", "1e300"})
    EXPECT_TRUE(has(said("diameter " + d), "diameters are far too small or too large for this law"))
        << said("diameter " + d);
  EXPECT_TRUE(has(said("density 1e-280"), "masses are far too small for this law"))
      << said("density 1e-280");
}

// springs are the only forces that a minimiser cannot take along
TEST(Traps, minimise_with_friction)
{
  const std::string words = "do not follow particles that a minimiser moves";
  for (const std::string friction :
       {"", " sliding 0.3", " rolling 0.02", " sliding 0.3 twisting yes"}) {
    std::string scene = dust;
    const std::string law = "jkr 1e7 0.3 0.02";
    scene.insert(scene.find(law) + law.size(), friction);
    Simulation sim;
    sim.run(scene + "unfix air\n");
    EXPECT_EQ(has(log_of(sim, "minimize 0 0 1 1\n"), words), !friction.empty()) << friction;
    EXPECT_FALSE(has(log_of(sim, "fix move all nve/sphere\nrun 0\n"), words)) << friction;
  }
}
