// fix flow/field file through LAMMPS. Facts: a file that holds an analytic flow acts as that flow,
// in time, beyond periodic borders and next to walls.

#include "flow_file.h"

#include <cstdlib>

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
  const std::string scene = "pair_style granular/adhesive\npair_coeff * * jkr 1e3 0.3 0\n"
                            "comm_modify vel yes\nneighbor 2 bin\n"
                            "fix move all nve/sphere/mts collision 2 fluid 10\n"
                            "variable u equal step\n"
                            "fix flow all flow/field uniform v_u 0 0" +
      fluid;
  sim.run("unfix move\n" + scene + "run 17\n");
  EXPECT_EQ(sim.value("f_flow[1]"), 10.0);
  EXPECT_NEAR(sim.value("f_flow[7]"), 10.0 / 0.1, 1e-9);
  // a run that begins, or is resumed, within a fluid step has its values until the next one
  const TemporaryFile half("apf_half");
  sim.run("write_restart " + half.path + "\nrun 0\n");
  EXPECT_EQ(sim.value("f_flow[1]"), 10.0);
  sim.run("run 4\n");
  EXPECT_EQ(sim.value("f_flow[1]"), 20.0);
  Simulation resumed;
  resumed.run("read_restart " + half.path + "\n" + scene + "run 2\n");
  EXPECT_EQ(resumed.value("f_flow[1]"), 10.0);
  EXPECT_NEAR(resumed.value("f_flow[7]"), 10.0 / 0.1, 1e-9);
  resumed.run("run 2\n");
  EXPECT_EQ(resumed.value("f_flow[1]"), 20.0);
  // where one begins a new variable counts at once
  resumed.run("run 9\nvariable u equal 7\nrun 0\n");
  EXPECT_EQ(resumed.value("f_flow[1]"), 7.0);
}

TEST(FlowFile, periodic_grids_with_and_without_their_last_layer)
{
  const TemporaryFile with("apf_with"), without("apf_without"), other("apf_other");
  const auto wave = [](const double *x, double, double *u) {
    u[0] = 1.0;
    u[1] = std::sin(0.4 * pi * (x[0] + x[2]));
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
