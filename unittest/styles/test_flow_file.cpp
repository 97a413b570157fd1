// fix flow/field file through LAMMPS. Facts: a file that holds an analytic flow acts as that flow,
// whatever the number of ranks; what is wrong with a file or a box is said.

#include "fix.h"
#include "nodes.h"
#include "scenes.h"
#include "temporary_file.h"

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace {

const std::string spheres = R"(
units lj
atom_style sphere
atom_modify map array sort 0 0
boundary p f p
region box block 0 10 0 10 0 10
create_box 1 box
create_atoms 1 single 2 1 5
create_atoms 1 single 5 5 5
create_atoms 1 single 7 8.7 2
set type 1 diameter 0.5 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
timestep 0.01
)";
const std::string fluid = " density 0.5 viscosity $(1/18)\n";

constexpr double pi_over_5 = 3.14159265358979323846 / 5.0;

// 4 U s (1 - s) with U = 2 and s = y/10
void parabola(const double *x, double, double *u)
{
  u[0] = 8.0 * x[1] / 10.0 * (1.0 - x[1] / 10.0);
}

}    // namespace

TEST(FlowFile, channel_from_a_file_acts_as_the_analytic_one)
{
  const TemporaryFile file("apf_channel");
  file.write({3, 41, 3}, {0, 0, 0}, {5, 0.25, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  double x[2][6];
  for (int k = 0; k < 2; k++) {
    Simulation sim;
    sim.run(spheres + "fix flow all flow/field " +
            (k ? "file " + file.path : "channel x y 0 10 2") + fluid +
            "fix drag all flow/force flow drag stokes torque yes\nrun 200\n");
    for (int i = 0; i < 3; i++) {
      x[k][i] = sim.value("x[" + std::to_string(i + 1) + "]");
      x[k][3 + i] = sim.lammps()->atom->omega[i][2];
    }
  }
  // trilinear between nodes 0.25 apart: below h^2 |u''|/8 = 0.00125
  for (int i = 0; i < 3; i++) {
    EXPECT_NEAR(x[1][i], x[0][i], 2e-3);
    EXPECT_GT(std::fabs(x[0][i] - (i == 0 ? 2 : i == 1 ? 5 : 7)), 0.1) << "it moved";
    EXPECT_NEAR(x[1][3 + i], x[0][3 + i], 1e-6);
  }
}

namespace {

// u = c t along x everywhere: frames at t = 0, 1 and 3 of a series that is linear up to 1
void write_series(const TemporaryFile &file)
{
  file.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.steps({0.0, 1.0, 3.0});
    w.field("velocity", 3,
            [](const double *, double t, double *u) {
              u[0] = t < 2.0 ? 2.0 * t : 1.0;
            },
            {0.0, 1.0, 3.0});
  });
}
// velocity of the fluid at a time, as the file has it
double series(double t)
{
  return t < 1.0 ? 2.0 * t : 2.0 - 0.5 * (t - 1.0);
}

// spheres that follow the fluid within a step of it
const std::string light = " density 0.5 viscosity 1e4\n";

}    // namespace

TEST(FlowFile, series_is_followed_in_time)
{
  const TemporaryFile file("apf_series");
  write_series(file);
  Simulation sim;
  sim.run(spheres + "fix flow all flow/field file " + file.path + light +
          "fix drag all flow/force flow drag stokes\nrun 40\n");
  for (int n = 0; n < 5; n++) {    // the velocity at the end of a step is that a half step ago
    const double t = 0.4 + 0.5 * n;
    EXPECT_NEAR(sim.value("f_flow[6]"), t, 1e-12);
    EXPECT_NEAR(sim.value("vx[2]"), series(t), 0.011) << "t = " << t;
    EXPECT_EQ(sim.value("vy[2]"), 0.0);
    sim.run("run 50\n");
  }
  const auto error = sim.error_of("run 200\n");
  EXPECT_NE(error.find("lasts from 0 to 3, the simulation is at time 3.01"), std::string::npos)
      << error;
}

TEST(FlowFile, series_in_a_loop_begins_again)
{
  const TemporaryFile file("apf_loop");
  write_series(file);
  Simulation sim;
  sim.run(spheres + "fix flow all flow/field file " + file.path + " loop yes" + light +
          "fix drag all flow/force flow drag stokes\nrun 650\n");
  EXPECT_NEAR(sim.value("f_flow[6]"), 0.5, 1e-9);
  EXPECT_NEAR(sim.value("vx[2]"), series(0.5), 0.011);
  sim.run("reset_timestep 0 time -1\nrun 0\n");
  EXPECT_NEAR(sim.value("f_flow[6]"), 2.0, 1e-9);
}

TEST(FlowFile, restart_in_mid_series_goes_on_exactly)
{
  const TemporaryFile file("apf_restart"), restart("apf_restart_of_lammps");
  write_series(file);
  const std::string fixes = "fix flow all flow/field file " + file.path + fluid +
      "fix drag all flow/force flow drag stokes\n";
  double straight[2][3];
  {
    Simulation sim;
    sim.run(spheres + fixes + "run 130\nwrite_restart " + restart.path + "\nrun 130\n");
    for (int i = 0; i < 3; i++) straight[0][i] = sim.lammps()->atom->x[i][0];
  }
  Simulation sim;
  sim.run("read_restart " + restart.path +
          "\npair_style zero 1.0 nocoeff\npair_coeff * *\nfix move all nve/sphere\n" + fixes +
          "run 130\n");
  for (int i = 0; i < 3; i++) EXPECT_EQ(sim.lammps()->atom->x[i][0], straight[0][i]);
}

TEST(FlowFile, speed_from_a_variable_has_a_rate)
{
  const TemporaryFile restart("apf_rate_restart");
  const std::string flow = "variable u equal sin(3*step*dt)\n"
                           "fix flow all flow/field channel x y 0 10 v_u" +
      fluid;
  Simulation sim;
  sim.run(spheres + flow + "run 0\n");
  EXPECT_EQ(sim.value("f_flow[7]"), 0.0) << "nothing is known before the first step";
  sim.run("run 50\n");
  const double rate = (std::sin(1.5) - std::sin(3 * 0.49)) / 0.01;
  EXPECT_NEAR(sim.value("f_flow[7]"), rate, 1e-10);
  EXPECT_NEAR(rate, 3.0 * std::cos(1.5 - 0.015), 1e-3);
  sim.run("run 0\n");
  EXPECT_NEAR(sim.value("f_flow[7]"), rate, 1e-10) << "a new run forgets nothing";
  sim.run("write_restart " + restart.path + "\nclear\nread_restart " + restart.path +
          "\npair_style zero 1.0 nocoeff\npair_coeff * *\nfix move all nve/sphere\n" + flow +
          "run 0\n");
  EXPECT_NEAR(sim.value("f_flow[7]"), rate, 1e-10) << "nor does a restart";
}

TEST(FlowFile, fluid_step_of_the_integrator_is_that_of_variables)
{
  Simulation sim;
  sim.run(spheres);
  sim.run("unfix move\npair_style granular/adhesive\npair_coeff * * jkr 1e3 0.3 0\n"
          "comm_modify vel yes\nneighbor 2 bin\n"
          "fix move all nve/sphere/mts collision 2 fluid 10\n"
          "variable u equal step\n"
          "fix flow all flow/field uniform v_u 0 0" +
          fluid + "run 17\n");
  EXPECT_EQ(sim.value("f_flow[1]"), 10.0);
  EXPECT_NEAR(sim.value("f_flow[7]"), 10.0 / 0.1, 1e-9);
  sim.run("run 4\n");
  EXPECT_EQ(sim.value("f_flow[1]"), 20.0);
}

TEST(FlowFile, leaving_the_grid_is_an_error_or_clamped)
{
  const TemporaryFile file("apf_outside");
  file.write({3, 3, 3}, {0, 0, 0}, {5, 5, 2.5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, [](const double *x, double, double *u) {
      u[0] = 1.0 + x[1];
    });
  });
  const std::string shrunk = spheres + "change_box all boundary p f s\n";
  const std::string field = "fix flow all flow/field file " + file.path + fluid;
  const std::string forces = "fix drag all flow/force flow drag stokes\nset atom 2 z 6.5\nrun 1\n";
  {
    Simulation sim;
    const auto error = sim.error_of(shrunk + field + forces);
    for (const std::string word : {"Fix flow/field flow: atom 2 at (5", "6.5) is outside the grid",
                                   "z = 0 to 5", "outside clamp"})
      EXPECT_NE(error.find(word), std::string::npos) << word << " not in " << error;
  }
  Simulation sim;
  sim.run(spheres + "fix flow all flow/field file " + file.path + " outside clamp" + light +
          forces);
  EXPECT_NEAR(sim.value("vx[2]"), 6.0, 1e-3);
}

TEST(FlowFile, errors_name_what_is_wrong)
{
  const TemporaryFile good("apf_good"), bad("apf_bad"), small("apf_small"), flat("apf_flat"),
      half("apf_half"), short_wall("apf_short_wall"), no_fluid("apf_no_fluid");
  good.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  bad.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("speed", 3, parabola);
  });
  small.write({3, 3, 3}, {0, 0, 0}, {5, 4.9, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  flat.write({3, 3, 1}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  // extents of another grid, which would not cover the box: the array is what the error is about
  half.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
    w.integers("WholeExtent", {0, 1, 0, 2, 0, 2});
  });
  no_fluid.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
    w.array("distance", {3, 3, 3}, std::vector<double>(27, -1.0));
  });
  short_wall.write({3, 3, 2}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
    w.array("distance", {2, 3, 4}, std::vector<double>(24, 1.0));
  });
  const std::string file = "fix f all flow/field file ";
  const struct {
    std::string input, message, word;
  } table[] = {
      {"fix f all flow/field file", "fix flow/field file command: missing argument", ""},
      {file + "none.vtkhdf" + fluid, "none.vtkhdf: cannot be opened", "none.vtkhdf"},
      {file + bad.path + fluid, "has no point array velocity; it has speed", bad.path},
      {file + small.path + fluid,
       "the grid spans 0 to 9.8 along y and does not cover the box, 0 to 10", small.path},
      {file + half.path + fluid,
       "array velocity must have shape [3][3][2][3] (z, y, x, component) as WholeExtent says, got "
       "[3][3][3][3]",
       half.path},
      {file + short_wall.path + fluid,
       "array distance must have shape [2][3][3] (z, y, x) as WholeExtent says, got [2][3][4]",
       short_wall.path},
      {file + no_fluid.path + fluid, "array distance is > 0 nowhere", no_fluid.path},
      {file + flat.path + fluid, "3d simulations need 2 or more nodes along z, got 1", flat.path},
      {file + good.path + " density 1", "requires keyword viscosity", ""},
      {file + good.path + " loop", "fix flow/field loop command: missing argument", ""},
      {file + good.path + " loop maybe" + fluid, "loop must be yes or no, got maybe", "maybe"},
      {file + good.path + " outside stop" + fluid, "outside must be clamp or error, got stop",
       "stop"},
      {file + good.path + " wall smooth" + fluid, "wall must be reconstruct or plain, got smooth",
       "smooth"},
      {file + good.path + " speed 3" + fluid,
       "keyword must be density, viscosity, loop, outside or wall, got speed", "speed"},
      {file + good.path + " density 0", "density must be > 0, got 0", "0"},
      {"change_box all triclinic\n" + file + good.path + fluid, "requires an orthogonal box",
       good.path},
      {file + good.path + fluid + "change_box all x final 0 9\nrun 0",
       "the box must keep its length and boundaries along x", ""},
      {file + good.path + fluid + "fix d all deform 1 x scale 1.1\nrun 0",
       "the box must keep its length and boundaries along x", ""},
      {"fix f all flow/field uniform 1 0 0 loop yes" + fluid,
       "keyword must be density or viscosity, got loop", "loop"},
  };
  for (const auto &row : table) {
    Simulation sim;
    sim.run(spheres);
    const std::string error = sim.error_of(row.input);
    EXPECT_NE(error.find(row.message), std::string::npos) << row.input << "\ngave: " << error;
    if (row.word.empty()) continue;    // the word is underlined
    EXPECT_NE(error.find(" " + std::string(row.word.size(), '^')), std::string::npos)
        << row.input << "\ngave: " << error;
  }
}

// One warning names a flow that nothing takes, whatever the number of runs; forces, inlets and
// the concentration between the walls of a file take one.
TEST(FlowFile, a_flow_that_nothing_takes_is_named_once)
{
  const TemporaryFile walls("apf_walls");
  walls.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
    w.field("distance", 1, [](const double *x, double, double *phi) {
      *phi = std::min(x[1], 10.0 - x[1]);
    });
  });
  const auto warnings = [](const std::string &flow, const std::string &others) {
    Simulation sim;
    sim.run(spheres);
    std::istringstream log(
        log_of(sim, "fix air all flow/field " + flow + fluid + others + "run 1\nrun 1\n"));
    std::vector<std::string> found;
    for (std::string line; std::getline(log, line);)
      if (line.find("WARNING: Fix flow/field") == 0) found.push_back(line);
    return found;
  };
  const std::string still = "uniform 0 0 0", file = "file " + walls.path,
                    cells = "fix c all flow/concentration 10 10 10 cloud 1.2\n",
                    inlet = "fix in all inlet/flow x 0 air number 1 every 100 diameter 0.5 "
                            "density 1 type 1 seed 7\n";
  for (const auto &flow : {still, file}) {
    const auto alone = warnings(flow, "");
    ASSERT_EQ(alone.size(), 1U) << flow;
    for (const auto &line : alone)
      EXPECT_NE(line.find("Fix flow/field air: no other fix takes this flow"), std::string::npos);
    EXPECT_EQ(warnings(flow, "fix drag all flow/force air drag stokes\n").size(), 0U) << flow;
  }
  EXPECT_EQ(warnings(file, inlet).size(), 0U);
  EXPECT_EQ(warnings(file, cells).size(), 0U);
  EXPECT_EQ(warnings(still, cells).size(), 1U);
  // forces of a first run do not count in the next one
  EXPECT_EQ(warnings(still, "fix drag all flow/force air drag stokes\nrun 1\nunfix drag\n").size(),
            1U);
}

TEST(FlowFile, what_was_hardly_meant_gives_a_warning)
{
  const TemporaryFile fits("apf_fits"), other_unit("apf_unit");
  const auto content = [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  };
  fits.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, content);
  other_unit.write({3, 3, 3}, {0, 0, 0}, {101, 5, 101}, content);
  const auto log = [](const std::string &words) {
    Simulation sim;
    sim.run(spheres);
    return log_of(sim, "fix air all flow/field file " + words + fluid);
  };
  EXPECT_EQ(log(fits.path).find("WARNING"), std::string::npos);
  EXPECT_NE(log(fits.path + " loop yes").find("the flow is steady, keyword loop has no effect"),
            std::string::npos);
  const auto text = log(other_unit.path);
  EXPECT_NE(text.find("the box is 10 long along x, a small part of a cell, 101"), std::string::npos)
      << text;
  EXPECT_EQ(text.find("WARNING"), text.rfind("WARNING"))
      << "once, of the first such axis: " << text;
}

TEST(FlowFile, periodic_grids_with_and_without_their_last_layer)
{
  const TemporaryFile with("apf_with"), without("apf_without"), other("apf_other");
  const auto wave = [](const double *x, double, double *u) {
    u[0] = 1.0;
    u[1] = std::sin(2.0 * pi_over_5 * (x[0] + x[2]));
  };
  for (const auto *file : {&with, &without, &other}) {
    const int n = file == &without ? 8 : 9;
    file->write({n, 3, n}, {0.7, 0, -3}, {1.25, 5, 1.25}, [&](VtkhdfWriter &w) {
      w.field("velocity", 3, [&](const double *x, double t, double *u) {
        if (file == &other && x[0] > 10.0)    // the last layer along x
          u[0] = 7.0;
        else
          wave(x, t, u);
      });
    });
  }
  const TemporaryFile log("apf_log");
  double y[3][3], x = 0.0;
  for (int k = 0; k < 3; k++) {
    Simulation sim;
    sim.run("log " + log.path + "\n" + spheres + "fix flow all flow/field file " +
            (k == 0       ? with
                 : k == 1 ? without
                          : other)
                .path +
            light + "fix drag all flow/force flow drag stokes torque yes\nrun 450\n");
    for (int i = 0; i < 3; i++) y[k][i] = sim.lammps()->atom->x[i][1];
    x = sim.value("x[3]");
    sim.run("log none\n");
    std::ifstream file(log.path);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    const std::string differ = "along periodic x differ by up to 6; the first one is taken";
    EXPECT_EQ(text.find(differ) != std::string::npos, k == 2);
    EXPECT_EQ(text.find(differ), text.rfind(differ)) << "once, though the vorticity is read later";
    EXPECT_EQ(text.find("periodic z differ"), std::string::npos);
  }
  EXPECT_NEAR(x, 1.5, 0.02) << "went through the boundary";
  for (int i = 0; i < 3; i++) {
    EXPECT_NEAR(y[1][i], y[0][i], 1e-10);
    EXPECT_EQ(y[2][i], y[0][i]);
    EXPECT_GT(std::fabs(y[0][i] - (i == 0 ? 1.0 : i == 1 ? 5.0 : 8.7)), 0.1);
  }
}

TEST(FlowFile, planar_files)
{
  const TemporaryFile one("apf_planar1"), three("apf_planar3");
  for (const auto *file : {&one, &three})
    file->write({3, 41, file == &one ? 1 : 3}, {0, 0, 0}, {5, 0.25, 1}, [](VtkhdfWriter &w) {
      w.field("velocity", 3, parabola);
    });
  const std::string plane = R"(
units lj
dimension 2
atom_style sphere
atom_modify map array
region box block 0 10 0 10 -0.5 0.5
boundary p f p
create_box 1 box
create_atoms 1 single 2 1 0
set type 1 diameter 0.5 density 1.0
pair_style zero 1.0 nocoeff
pair_coeff * *
fix move all nve/sphere
fix flat all enforce2d
)";
  Simulation sim;
  sim.run(plane);
  const auto error = sim.error_of("fix flow all flow/field file " + three.path + fluid);
  EXPECT_NE(error.find("1 or 2 layers of nodes along z, got 3"), std::string::npos) << error;
  sim.run("fix flow all flow/field file " + one.path + light +
          "fix drag all flow/force flow drag stokes torque yes\nrun 1\n");
  EXPECT_NEAR(sim.value("vx[1]"), 0.72, 1e-3);
  EXPECT_EQ(sim.value("vz[1]"), 0.0);
}

TEST(FlowFile, example_with_a_file_that_h5py_wrote)
{
  const TemporaryFile file("apf_h5py");
  const std::string folder = APF_EXAMPLES "/channel/";
  ASSERT_EQ(std::system((folder + "parabola.py " + file.path).c_str()), 0)
      << "needs Debian's python3-h5py";
  Simulation sim({"-var", "file", file.path});
  sim.run("include " + folder + "in.file\n");
  EXPECT_EQ(sim.value("v_ok"), 1.0);
  Simulation plain({"-var", "file", file.path, "-var", "wall", "plain"});
  plain.run("include " + folder + "in.file\n");
  EXPECT_EQ(plain.value("v_ok"), 0.0) << "walls lie between nodes";
}

TEST(FlowFile, next_to_a_wall_between_nodes)
{
  const TemporaryFile file("apf_wall");    // walls at 0 and 10, nodes at -0.3, 0.7, ..
  file.write({3, 12, 3}, {0, -0.3, 0}, {5, 1, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, [](const double *x, double t, double *u) {
      if (x[1] > 0.0 && x[1] < 10.0) parabola(x, t, u);
    });
    w.field("distance", 1, [](const double *x, double, double *s) {
      s[0] = std::min(x[1], 10.0 - x[1]);
    });
  });
  const double y = 0.05, exact = 0.8 * y * (1.0 - y / 10.0);
  double vx[2];
  for (int k = 0; k < 2; k++) {
    Simulation sim;
    sim.run(spheres + "set atom 1 y 0.05\nfix flow all flow/field file " + file.path +
            (k ? " wall plain" : " wall reconstruct") + light +
            "fix drag all flow/force flow drag stokes\nrun 1\n");
    vx[k] = sim.value("vx[1]");
  }
  const double between_nodes = 0.08 * 0.35 * 0.65;    // u''/2 times the distances to the nodes
  EXPECT_NEAR(vx[0], exact - between_nodes, 1e-6);
  EXPECT_NEAR(vx[1], 0.35 * 0.8 * 0.7 * 0.93, 1e-6) << "between 0 and the first node's";
  EXPECT_GT(vx[1], 4.0 * exact);
}

// ---- collection by a fiber (Kuwabara): which particles that come along hit it

namespace {

// the fiber has radius 1, solid fraction alpha, mean velocity 1 along x
// S. Kuwabara, J. Phys. Soc. Japan 14, 527 (1959), doi:10.1143/JPSJ.14.527
constexpr double alpha = 3.14159265358979323846 / 64.0;
const double Ku = -0.5 * std::log(alpha) - 0.75 + alpha - 0.25 * alpha * alpha;

void kuwabara(const double *x, double, double *u)
{
  const double r2 = x[0] * x[0] + x[1] * x[1];
  if (r2 < 1.0) return;
  const double f = std::log(r2) - 1.0 + alpha + (1.0 - 0.5 * alpha) / r2 - 0.5 * alpha * r2;
  const double f_r = 2.0 / r2 - 2.0 * (1.0 - 0.5 * alpha) / (r2 * r2) - alpha;
  u[0] = 0.5 / Ku * (f + x[1] * x[1] * f_r);
  u[1] = -0.5 / Ku * x[0] * x[1] * f_r;
}

constexpr double start = -4.0, interception = 0.05, touch = 1.0 + interception;

// stream function of that flow over y
double stream(double r2)
{
  return 0.5 / Ku * (std::log(r2) - 1.0 + alpha + (1.0 - 0.5 * alpha) / r2 - 0.5 * alpha * r2);
}

// smallest distance from the axis of a particle that starts at height y with the fluid's velocity,
// by Runge and Kutta's method of fourth order
double nearest(double y, double St)
{
  double s[4] = {start, y, 0.0, 0.0}, nearest = 10.0;
  kuwabara(s, 0.0, s + 2);
  const auto rate = [St](const double *a, double *d) {
    double u[3] = {};
    kuwabara(a, 0.0, u);
    for (int c = 0; c < 2; c++) {
      d[c] = a[2 + c];
      d[2 + c] = (u[c] - a[2 + c]) / St;
    }
  };
  const double h = 0.004;
  while (s[0] < 1.0) {
    double k[4][4], at[4];
    rate(s, k[0]);
    for (int m = 1; m < 4; m++) {
      for (int c = 0; c < 4; c++) at[c] = s[c] + (m < 3 ? 0.5 : 1.0) * h * k[m - 1][c];
      rate(at, k[m]);
    }
    for (int c = 0; c < 4; c++) s[c] += h / 6.0 * (k[0][c] + 2.0 * (k[1][c] + k[2][c]) + k[3][c]);
    nearest = std::min(nearest, std::hypot(s[0], s[1]));
    if (nearest < touch) break;
  }
  return nearest;
}

// height from which the fiber is just touched; without inertia on the streamline through (0, touch)
double limit(double St)
{
  double low = 0.0, high = 2.0;
  for (int n = 0; n < 40; n++) {
    const double y = 0.5 * (low + high);
    const bool touches = St > 0.0
        ? nearest(y, St) < touch
        : y * stream(start * start + y * y) < touch * stream(touch * touch);
    (touches ? low : high) = y;
  }
  return low;
}

// the same through LAMMPS in a gridded field, from a row of particles around the exact height
double gridded_limit(double St, double exact, double spacing)
{
  const TemporaryFile file("apf_fiber");
  const int nx = static_cast<int>(std::ceil(4.8 / spacing)) + 1;
  const int ny = static_cast<int>(std::ceil(1.9 / spacing)) + 1;
  file.write({nx, ny, 1}, {-4.23, -0.37, 0}, {spacing, spacing, 1}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, kuwabara);
    w.field("distance", 1, [](const double *x, double, double *s) {
      s[0] = std::hypot(x[0], x[1]) - 1.0;
    });
  });
  Simulation sim;
  sim.run("units lj\ndimension 2\natom_style sphere\natom_modify map array\n"
          "region box block -4.2 0.5 -0.3 1.5 -0.5 0.5\nboundary f f p\ncreate_box 1 box\n");
  constexpr int n = 21;
  const auto height = [=](double k) {
    return exact * (0.96 + 0.014 * k);
  };
  for (int k = 0; k < n; k++) {
    const double x[3] = {start, height(k), 0.0};
    double u[3] = {};
    kuwabara(x, 0.0, u);
    std::ostringstream text;
    text.precision(17);
    text << "create_atoms 1 single " << start << " " << height(k) << " 0\nset atom " << k + 1
         << " vx " << u[0] << " vy " << u[1] << "\n";
    sim.run(text.str());
  }
  std::ostringstream fluid;
  fluid.precision(17);
  fluid << " density 1e-3 viscosity " << 0.01 / (18.0 * std::max(St, 1e-6)) << "\ntimestep "
        << (St > 0.0 ? 0.01 : 0.002);
  sim.run("set type 1 diameter 0.1 density 1.0\npair_style zero 0.3 nocoeff\npair_coeff * *\n"
          "fix move all nve/sphere\nfix flat all enforce2d\nthermo_modify lost ignore\n"
          "fix flow all flow/field file " +
          file.path + " outside clamp" + fluid.str() +
          "\nfix drag all flow/force flow drag stokes\nrun 0\n");
  std::vector<double> closest(n, 10.0);
  const auto *atom = sim.lammps()->atom;
  for (bool upstream = true; upstream;) {
    sim.run("run 1 pre no post no\n");
    upstream = false;
    for (int i = 0; i < atom->nlocal; i++) {
      auto &r = closest[atom->tag[i] - 1];
      r = std::min(r, std::hypot(atom->x[i][0], atom->x[i][1]));
      upstream |= atom->x[i][0] < 0.2;
    }
  }
  for (int k = 1; k < n; k++) {    // heights ascend
    const double below = closest[k - 1] - touch, above = closest[k] - touch;
    if (below < 0.0 && above >= 0.0) return height(k - 1 - below / (above - below));
  }
  return 0.0;
}

}    // namespace

TEST(FlowFile, fiber_collects_as_in_the_exact_flow)
{
  const struct {
    double St, spacing;    // the widest of three
  } table[] = {{0.0, 0.05}, {0.1, 0.05}, {0.3, 0.05}, {1.0, 0.05}, {2.0, 0.2}};
  for (const auto &row : table) {
    const double exact = limit(row.St);
    double error[3];
    for (int n = 0; n < 3; n++)
      error[n] = gridded_limit(row.St, exact, row.spacing / (1 << n)) / exact - 1.0;
    EXPECT_LT(std::fabs(error[2]), 0.015) << "St = " << row.St;
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.2) << "St = " << row.St;
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.3) << "St = " << row.St;
    if (row.St > 0.0) continue;
    // The velocity towards the wall is k s^2 at distance s. Linear between nodes it is on average
    // k h^2/6 too large: what passes at s comes from a streamline that much too high.
    for (int n = 1; n < 3; n++) {
      const double cells = interception / (row.spacing / (1 << n));
      EXPECT_NEAR(error[n], 1.0 / (6.0 * cells * cells), 0.0015);
    }
  }
}

// ---- on 1, 2 and 4 ranks

namespace {

constexpr int n_spheres = 60;

// one after another, so that they have the same IDs on any number of ranks
std::string many()
{
  std::string text = "units lj\natom_style sphere\natom_modify map array sort 0 0\n"
                     "boundary p m p\nregion box block 0 10 0 10 0 10\ncreate_box 1 box\n";
  for (int i = 0; i < n_spheres; i++) {
    text += "create_atoms 1 single";
    for (const double step : {0.618, 0.755, 0.57})
      text += " " + std::to_string(0.1 + 9.8 * std::fmod((i + 1) * step, 1.0));
    text += "\n";
  }
  return text +
      "set type 1 diameter 0.1 density 1.0\npair_style zero 1.0 nocoeff\n"
      "pair_coeff * *\nfix move all nve/sphere\ntimestep 0.01\n"
      "neigh_modify delay 0 every 1\n";
}

void expect_forces_of_one_rank()
{
  const TemporaryFile file("apf_ranks");
  const std::vector<double> times = {0.0, 0.1, 0.2, 0.3};
  file.write({9, 17, 11}, {0, 0, 0}, {1.25, 0.625, 1}, [&](VtkhdfWriter &w) {
    w.steps(times);
    w.field(
        "velocity", 3,
        [](const double *x, double t, double *u) {
          u[0] = std::sin(2.0 * pi_over_5 * x[0]) + t;
          u[1] = std::cos(x[1] * (1.0 + t));
          u[2] = 0.1 * std::sin(2.0 * pi_over_5 * x[2]);
        },
        times);
    w.field("distance", 1, [](const double *x, double, double *s) {
      s[0] = std::min(x[1] - 0.3, 9.6 - x[1]);
    });
  });
  const std::string commands = many() + "fix flow all flow/field file " + file.path +
      " loop yes outside clamp" + fluid +
      "fix drag all flow/force flow drag stokes torque yes\nrun 47\n";
  // the same on this rank alone
  std::vector<double> alone;
  {
    Simulation sim({}, MPI_COMM_SELF);
    sim.run(commands);
    for (int tag = 1; tag <= n_spheres; tag++) {
      const int i = sim.lammps()->atom->map(tag);
      for (int c = 0; c < 3; c++) {
        alone.push_back(sim.lammps()->atom->x[i][c]);
        alone.push_back(sim.lammps()->atom->omega[i][c]);
      }
    }
  }
  Simulation sim;
  sim.run(commands);
  int compared = 0;
  const auto *atom = sim.lammps()->atom;
  for (int i = 0; i < atom->nlocal; i++)
    for (int c = 0; c < 3; c++, compared++) {
      EXPECT_EQ(atom->x[i][c], alone[6 * (atom->tag[i] - 1) + 2 * c]);
      EXPECT_EQ(atom->omega[i][c], alone[6 * (atom->tag[i] - 1) + 2 * c + 1]);
    }
  MPI_Allreduce(MPI_IN_PLACE, &compared, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
  EXPECT_EQ(compared, 3 * n_spheres);
}

// bytes that all ranks hold of a grid of 20^3 nodes
double bytes_of_a_grid()
{
  const TemporaryFile file("apf_memory");
  file.write({20, 20, 20}, {0, 0, 0}, {1, 1, 1}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  Simulation sim;
  sim.run(many() + "fix flow all flow/field file " + file.path + fluid +
          "fix drag all flow/force flow drag stokes\nrun 0\n");
  double bytes = sim.lammps()->modify->get_fix_by_id("flow")->memory_usage();
  MPI_Allreduce(MPI_IN_PLACE, &bytes, 1, MPI_DOUBLE, MPI_SUM, MPI_COMM_WORLD);
  return bytes;
}

}    // namespace

TEST(RanksFlowFile, forces_do_not_depend_on_ranks)
{
  expect_forces_of_one_rank();
}

TEST(RanksFlowFile, forces_do_not_depend_on_nodes)
{
  for (const int ranks : {1, 2, 3}) {
    const SmallNodes nodes(ranks);
    expect_forces_of_one_rank();
  }
}

TEST(RanksFlowFile, a_node_has_one_copy)
{
  EXPECT_NEAR(bytes_of_a_grid(), 20 * 20 * 20 * 32, 64) << "four doubles a node";
}

TEST(RanksFlowFile, every_node_has_a_copy)
{
  int ranks;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (const int of_a_node : {1, 2, 3}) {
    const SmallNodes nodes(of_a_node);
    const int copies = (ranks + of_a_node - 1) / of_a_node;
    EXPECT_NEAR(bytes_of_a_grid(), copies * 20 * 20 * 20 * 32, 64 * copies) << of_a_node;
  }
}

TEST(RanksFlowFile, errors_of_files_are_those_of_all_ranks)
{
  Simulation sim;
  sim.run(many());
  const auto error = sim.error_of("fix f all flow/field file none.vtkhdf" + fluid);
  EXPECT_NE(error.find("none.vtkhdf: cannot be opened"), std::string::npos) << error;
}
