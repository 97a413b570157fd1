// Wrong input of fix flow/field and fix flow/force: messages name what is wrong.

#include "flow_scene.h"

TEST(FlowInput, errors_name_what_is_wrong)
{
  const std::string field = "fix flow all flow/field uniform 1 0 0 density 1 viscosity 1\n";
  const std::string force = field + "fix drag all flow/force flow ";
  const struct {
    std::string input, message;
  } table[] = {
      {"fix f all flow/field", "missing argument"},
      {"fix f all flow/field whirl 1", "channel, pipe, uniform, shear or file, got whirl"},
      {"fix f all flow/field channel x y 0 1", "fix flow/field channel command: missing argument"},
      {"fix f all flow/field channel x x 0 1 1 density 1 viscosity 1",
       "wall axis must differ from flow axis x"},
      {"fix f all flow/field channel a y 0 1 1 density 1 viscosity 1",
       "axis must be x, y or z, got a"},
      {"fix f all flow/field channel x y 1 0 1 density 1 viscosity 1",
       "upper wall must be > lower wall 1, got 0"},
      {"fix f all flow/field channel x y 0 one 1 density 1 viscosity 1",
       "channel upper wall must be a number, got one"},
      {"fix f all flow/field pipe z 0 0 0 1 density 1 viscosity 1", "radius must be > 0, got 0"},
      {"fix f all flow/field pipe z 0 0 -2 1 density 1 viscosity 1", "radius must be > 0, got -2"},
      {"fix f all flow/field pipe z 0 0", "fix flow/field pipe command: missing argument"},
      {"fix f all flow/field uniform 1 0", "fix flow/field uniform command: missing argument"},
      {"fix f all flow/field uniform 1 0 u density 1 viscosity 1",
       "uniform velocity must be a number, got u"},
      {"fix f all flow/field shear x x 1 0 density 1 viscosity 1",
       "gradient axis must differ from flow axis x"},
      {"fix f all flow/field shear x y 1", "fix flow/field shear command: missing argument"},
      {"fix f all flow/field uniform 1 0 0 viscosity 1", "requires keyword density"},
      {"fix f all flow/field uniform 1 0 0 density 1", "requires keyword viscosity"},
      {"fix f all flow/field uniform 1 0 0 density 0 viscosity 1", "density must be > 0, got 0"},
      {"fix f all flow/field uniform 1 0 0 density 1 viscosity -1",
       "viscosity must be > 0, got -1"},
      {"fix f all flow/field uniform 1 0 0 density 1 viscosity",
       "fix flow/field viscosity command: missing argument"},
      {"fix f all flow/field uniform 1 0 0 density 1 loop yes",
       "keyword must be density or viscosity, got loop"},
      {"fix f all flow/field uniform v_no 0 0 density 1 viscosity 1\nrun 0",
       "variable no does not exist"},
      {"variable a atom x\nfix f all flow/field uniform v_a 0 0 density 1 viscosity 1\nrun 0",
       "variable a must be of style equal"},
      {"fix drag all flow/force", "missing argument"},
      {"fix drag all flow/force none drag stokes", "field fix none does not exist"},
      {"fix drag all flow/force move drag stokes",
       "field fix move must be of style flow/field, got nve/sphere"},
      {force, "requires keyword drag"},
      {force + "drag", "fix flow/force drag command: missing argument"},
      {force + "drag oseen", "drag must be stokes, schiller or difelice, got oseen"},
      {force + "drag difelice", "drag difelice requires keyword concentration"},
      {force + "drag stokes torque", "fix flow/force torque command: missing argument"},
      {force + "drag stokes torque maybe", "torque must be yes or no, got maybe"},
      {force + "drag stokes gravity 0 0", "fix flow/force gravity command: missing argument"},
      {force + "drag stokes gravity 0 0 down", "gravity must be a number, got down"},
      {force + "drag stokes feedback yes", "feedback yes takes the grid of fix flow/concentration"},
      {force + "drag stokes wake yes", "or feedback, got wake"},
      {force + "drag stokes\nunfix flow\nrun 0", "field fix flow does not exist"},
      {force + "drag stokes\nunfix move\nset type 1 diameter 0\nrun 0",
       "radius > 0, got 1 of radius 0"},
  };
  for (const auto &row : table) {
    Simulation sim;
    sim.run(one_sphere);
    const std::string error = sim.error_of(row.input);
    EXPECT_NE(error.find(row.message), std::string::npos) << row.input << "\ngave: " << error;
  }
}

TEST(FlowInput, errors_of_plane_simulations)
{
  const std::string plane = "units lj\ndimension 2\natom_style sphere\n"
                            "region box block 0 1 0 1 -0.5 0.5\ncreate_box 1 box\n";
  const std::string fluid = " density 1 viscosity 1\n";
  const struct {
    std::string input, message;
  } table[] = {
      {"fix f all flow/field channel x z 0 1 1" + fluid, "x or y in a 2d simulation, got z"},
      {"fix f all flow/field shear z y 1 0" + fluid, "x or y in a 2d simulation, got z"},
      {"fix f all flow/field pipe x 0 0 1 1" + fluid, "pipe requires a 3d simulation"},
      {"fix f all flow/field uniform 0 0 1" + fluid, "z velocity must be 0 in a 2d simulation"},
      {"fix f all flow/field uniform 1 0 0" + fluid +
           "fix d all flow/force f drag stokes gravity 0 0 -1",
       "gravity along z must be 0 in a 2d simulation, got -1"},
  };
  for (const auto &row : table) {
    Simulation sim;
    sim.run(plane);
    const std::string error = sim.error_of(row.input);
    EXPECT_NE(error.find(row.message), std::string::npos) << row.input << "\ngave: " << error;
  }
}

TEST(FlowInput, errors_of_units_and_atom_style)
{
  const std::string box = "region box block 0 1 0 1 0 1\ncreate_box 1 box\n";
  const std::string flow = "fix f all flow/field uniform 1 0 0 density 1 viscosity 1\n"
                           "fix d all flow/force f drag stokes\nrun 0\n";
  auto error = [&](const std::string &start) {
    Simulation sim;
    return sim.error_of(start + box + flow);
  };
  EXPECT_NE(error("atom_style atomic\n").find("Fix flow/force needs atom style sphere"),
            std::string::npos);
  EXPECT_NE(error("units real\natom_style sphere\n")
                .find("Fix flow/force requires units lj, si, cgs, micro or nano, got real"),
            std::string::npos);
}

// A ratio of densities of more than 1e5: which of the two is absurd, decides what may be wrong.
TEST(FlowInput, densities_that_cannot_be)
{
  const auto log = [](const std::string &set, const std::string &fluid) {
    Simulation sim;
    sim.run("units si\natom_style sphere\nregion box block 0 2e-4 0 2e-4 0 2e-4\n"
            "create_box 1 box\ncreate_atoms 1 single 1e-4 1e-4 1e-4\n"
            "pair_style zero 1e-5\npair_coeff * *\nneighbor 1e-5 bin\n"
            "set group all " +
            set + "\nfix nve all nve/sphere\n");
    return log_of(sim,
                  "fix air all flow/field uniform 1 0 0 " + fluid +
                      "\nfix drag all flow/force air drag stokes\ntimestep 1e-6\nrun 0\n");
  };
  const auto has = [](const std::string &text, const std::string &words) {
    return text.find(words) != std::string::npos;
  };
  const std::string air = "density 1.2 viscosity 2e-5", right = "diameter 1e-5 density 2600";
  const std::string first = "set diameter before density", fluid = "are its density and viscosity";
  EXPECT_FALSE(has(log(right, air), "particles have a density"));
  EXPECT_FALSE(has(log("diameter 1e-5 density 22600", air), "particles have a density"));
  const std::string swapped = log(right, "density 2e-5 viscosity 1.2");
  EXPECT_TRUE(has(swapped,
                  "Fix flow/force drag: particles have a density of up to 2.6e+03, "
                  "1.3e+08 times that of the fluid, 2e-05, of fix air; " +
                      fluid))
      << swapped;
  EXPECT_FALSE(has(swapped, first));
  // the mass of a sphere of diameter 1: 1e15 times that of one of 1e-5
  const std::string late = log("density 2600 diameter 1e-5", air);
  EXPECT_TRUE(has(late,
                  "a density of up to 2.6e+18, 2.17e+18 times that of the fluid, 1.2, of fix "
                  "air; " +
                      first))
      << late;
  EXPECT_FALSE(has(late, fluid));
}
