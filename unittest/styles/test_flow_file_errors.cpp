// fix flow/field file: what is wrong with a file or a box, or was hardly meant, is said.

#include "flow_file.h"
#include "fuzz/child.h"

#include <sys/stat.h>

TEST(FlowFile, errors_name_what_is_wrong)
{
  const TemporaryFile good("apf_good"), bad("apf_bad"), small("apf_small"), flat("apf_flat"),
      half("apf_half"), short_wall("apf_short_wall"), no_fluid("apf_no_fluid"), huge("apf_huge");
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
  huge.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, [](const double *x, double, double *u) {
      u[0] = x[1] == 5.0 ? -1e308 : 1.0;
    });
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
      {file + huge.path + fluid,
       "array velocity is -1e+308 at node (0 1 0), position (0 5 0): must be within +-1e+100",
       huge.path},
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

// A pipe to which nobody writes is not waited for.
TEST(FlowFile, what_is_not_a_regular_file_is_refused)
{
  const TemporaryFile pipe("apf_pipe");
  ASSERT_EQ(mkfifo(pipe.path.c_str(), 0600), 0);
  Simulation sim;
  sim.run(spheres);
  for (const std::string begin : {"fix f all flow/field file ", "fix f all wall/levelset file "}) {
    const std::string end = begin.find("wall") == std::string::npos ? fluid : " jkr 1e6 0.3 0";
    const auto said = [&](const std::string &path) {
      const auto ended = fuzz::in_child(
          [&](int out) {
            const auto text = sim.error_of(begin + path + end);
            return write(out, text.data(), text.size()) < 0;
          },
          1, RLIM_INFINITY);
      return ended.death + ended.text;
    };
    for (const std::string &path : {pipe.path, std::string("/dev/zero")})
      EXPECT_NE(said(path).find(" file " + path + ": is not a regular file"), std::string::npos)
          << begin << path << ": " << said(path);
    const auto folder = std::filesystem::temp_directory_path().string();
    EXPECT_NE(said(folder).find(" file " + folder + ": is a folder, not a file"), std::string::npos)
        << begin << said(folder);
  }
}

// One warning names a flow that nothing takes, whatever the number of runs; forces and the
// concentration between the walls of a file take one, an inlet alone does not.
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
      EXPECT_NE(line.find("Fix flow/field air: no fix makes this flow act on particles"),
                std::string::npos);
    EXPECT_EQ(warnings(flow, "fix drag all flow/force air drag stokes\n").size(), 0U) << flow;
  }
  EXPECT_EQ(warnings(file, inlet).size(), 1U) << "what enters flies on without drag";
  EXPECT_EQ(warnings(file, inlet + "fix drag all flow/force air drag stokes\n").size(), 0U);
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

// ... and beyond a fixed border of the box, to which no grid has to reach.
TEST(FlowFile, leaving_the_box_names_border_and_outlet)
{
  const TemporaryFile file("apf_left");
  file.write({3, 3, 3}, {0, 0, 0}, {5, 5, 5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, parabola);
  });
  const auto error = [&](const std::string &boundary, const std::string &place) {
    Simulation sim;
    return sim.error_of(spheres + "change_box all boundary " + boundary +
                        "\nfix flow all flow/field file " + file.path + fluid +
                        "fix drag all flow/force flow drag stokes\ntimestep 1e-3\nset atom 2 " +
                        place + "\nrun 1\n");
  };
  const std::string outlet = "keyword outlet of fix inlet/flow deletes and counts particles";
  for (const auto &[place, border] : {std::array<std::string, 2>{"x 9.99 vx 60", "x = 10"},
                                      std::array<std::string, 2>{"x 0.01 vx -60", "x = 0"}}) {
    const auto text = error("f p p", place);
    EXPECT_NE(text.find("has left the box at its fixed border " + border), std::string::npos)
        << text;
    EXPECT_NE(text.find(outlet), std::string::npos) << text;
  }
  for (const char *boundary : {"m p p", "s p p"})
    EXPECT_EQ(error(boundary, "x 9.99 vx 60").find("fixed border"), std::string::npos);
}
