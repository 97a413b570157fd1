// Fix wall/levelset file: what a grid cannot hold is refused, with what would do; zones and
// pictures.

#include "criterion.h"
#include "grid_scene.h"

#include "fix.h"

#include <fstream>

TEST(WallGridFile, coarse_grids_are_refused_and_the_advice_holds)
{
  std::string text;
  {
    GridScene scene(2, 0.4, {{"distance", circle}}, {{6.6, 4.0, 0.0}}, jkr + "resolution 1e-4");
    text = scene.sim.error_of("run 0");
  }
  const auto found = text.find("use a spacing of ");
  ASSERT_NE(found, std::string::npos) << text;
  const double advice = std::stod(text.substr(found + 17));
  EXPECT_LT(advice, 0.4);
  EXPECT_GT(advice, 0.02);
  // the next spacing that divides the box
  const double spacing = 8.0 / std::ceil(8.0 / advice);
  GridScene scene(2, spacing, {{"distance", circle}}, {{6.6, 4.0, 0.0}}, jkr + "resolution 1e-4");
  EXPECT_EQ(scene.sim.error_of("run 0"), "");
  // and what is accepted is as exact as it says
  const double delta_C = material.wall().delta_C();
  double worst = 0.0;
  for (int n = 0; n < 40; n++) {
    const double angle = 0.1 * n, r = 2.49;
    scene.sim.run(at(4.0 + r * std::cos(angle), 4.0 + r * std::sin(angle)) + "run 0 post no");
    const auto f = gather(scene.sim, "f");
    const auto curve = material.curve(0.5 / std::sqrt(1.25));
    const double slope = (curve.force(0.01 + 1e-6) - curve.force(0.01 - 1e-6)) / 2e-6;
    const double size = f[0] * std::cos(angle) + f[1] * std::sin(angle);
    worst = std::max(worst, std::fabs((size - curve.force(0.01)) / slope));
  }
  // R is a mean over the wall, known less exactly than the distance
  expect_criterion("C16 law: error of the distance on a grid that is not refused, resolution 1e-4, "
                   "of delta_C",
                   worst / delta_C, 0.0, 3e-4);
}

// The box is empty at first: what an inlet will insert into the wall's group decides.
TEST(WallGridFile, grids_are_checked_for_particles_to_come)
{
  // smallest: diameter of what is inserted into a group; of the error that the wall asks for
  const auto asked_for = [](double smallest, const std::string &group) {
    GridScene scene(2, 0.4, {{"distance", circle}}, {}, jkr + "resolution 1e-4");
    scene.sim.run("group other type 1\nfix air all flow/field uniform 1 0 0 density 1 viscosity 1\n"
                  "fix in " +
                  group + " inlet/flow x 0.0 air number 1 every 100 diameter uniform " +
                  digits(smallest) +
                  " 1.5 density 1 type 1 seed 7 outlet x 7.5\nfix nve all nve/sphere");
    const std::string text = scene.sim.error_of("run 0");
    const auto found = text.find("may touch, and ");
    return found == std::string::npos ? 0.0 : std::stod(text.substr(found + 15));
  };
  for (const double d : {0.8, 1.4})
    EXPECT_NEAR(asked_for(d, "all") / (1e-4 * material.wall(d).delta_C()), 1.0, 5e-3);
  EXPECT_NEAR(asked_for(0.8, "other") / (1e-4 * material.wall(0.8).delta_C()), 1.0, 5e-3);
}

TEST(WallGridFile, kinks_where_particles_touch_are_refused)
{
  const auto corner = [](const double *x) {
    return std::min(x[0] - 1.0, x[1] - 1.0);
  };
  {
    GridScene scene(2, 0.1, {{"distance", corner}}, {{3.0, 3.0, 0.0}}, jkr);
    const std::string text = scene.sim.error_of("run 0");
    EXPECT_NE(text.find("is not a smooth distance at"), std::string::npos) << text;
    EXPECT_NE(text.find("an array for each side"), std::string::npos) << text;
  }
  {    // a gap narrower than the particle
    const auto slit = [](const double *x) {
      return 0.45 - std::fabs(x[0] - 4.0);
    };
    GridScene scene(2, 0.1, {{"distance", slit}}, {{4.0, 3.0, 0.0}}, jkr);
    EXPECT_NE(scene.sim.error_of("run 0").find("wall"), std::string::npos);
  }
  {    // not a distance at all
    const auto twice = [](const double *x) {
      return 2.0 * x[1];
    };
    GridScene scene(2, 0.1, {{"distance", twice}}, {{4.0, 3.0, 0.0}}, jkr);
    EXPECT_NE(scene.sim.error_of("run 0").find("is not a smooth distance"), std::string::npos);
  }
}

// No node of theirs is where particles touch, but there is a wall.
TEST(WallGridFile, walls_whose_distances_have_another_scale_are_refused)
{
  using Shapes = std::map<std::string, Shape>;
  const auto error_of = [](const Shapes &shapes) {
    GridScene scene(2, 0.4, shapes, {{4.0, 4.0, 0.0}}, jkr);
    return scene.sim.error_of("run 0");
  };
  const auto times = [](double factor, const Shape &shape) {
    return [=](const double *x) {
      return factor * shape(x);
    };
  };
  const std::string no_node = "array distance has no node within 0.5 to 0.5 of the wall",
                    sign = "although its sign changes at (";
  for (const double height : {1.0, 0.0})
    for (const double factor : {1e-300, 1e-2, 10.0, 1e98}) {
      const auto text = error_of({{"distance", times(factor, plane(0, 1, 0, height))}});
      EXPECT_NE(text.find(no_node), std::string::npos) << factor << text;
      EXPECT_NE(text.find(sign), std::string::npos) << factor << text;
    }
  const auto step = [](const double *x) {
    return x[1] > 1.0 ? 10.0 : -10.0;
  };
  EXPECT_NE(error_of({{"distance", step}}).find(sign), std::string::npos);
  const auto lid = [](const double *x) {
    return 8.0 - x[1];
  };
  for (const double factor : {1e-2, 1e2}) {
    const auto text = error_of({{"distance_floor", times(factor, plane(0, 1, 0, 0.0))},
                                {"distance_lid", times(factor, lid)}});
    EXPECT_NE(text.find(sign), std::string::npos) << factor << text;
  }
}

// Walls that are outside of the box, or where no particle fits: a warning.
TEST(WallGridFile, walls_that_no_particle_touches_give_a_warning)
{
  {
    GridScene scene(2, 0.1, {{"distance", plane(0, 1, 0, -5.0)}}, {{4.0, 4.0, 0.0}}, jkr);
    EXPECT_NE(log_of(scene.sim, "run 0\n").find("WARNING: Fix wall/levelset file"),
              std::string::npos);
  }
  // a slot of 0.15, with its bottom, in which the sphere is not
  const auto left = [](const double *x) {
    return x[0] - 3.9;
  };
  const auto right = [](const double *x) {
    return 4.05 - x[0];
  };
  for (const Shape &bottom : {plane(0, 1, 0, 1.0), plane(0, 1, 0, 7.9)}) {
    GridScene scene(
        2, 0.1, {{"distance_bottom", bottom}, {"distance_left", left}, {"distance_right", right}},
        {{4.0, 4.0, 0.0}}, jkr);
    EXPECT_EQ(scene.sim.error_of("run 0").find("has no node within"), std::string::npos);
  }
}

// Behind the wall in the beginning or, sent there, in the course of a run.
TEST(WallGridFile, errors_of_places_name_the_file)
{
  for (const bool later : {false, true}) {
    GridScene scene(2, 0.1, {{"distance", plane(0, 1, 0, 2.0)}}, {{4.0, later ? 4.0 : 1.0, 0.0}},
                    jkr);
    const auto text =
        scene.sim.error_of(later ? "fix nve all nve/sphere\nvelocity all set 0 -1e5 0\n"
                                   "timestep 3e-5\nneigh_modify delay 0 every 1 check no\nrun 5"
                                 : "run 0");
    EXPECT_NE(text.find("behind the wall"), std::string::npos) << text;
    EXPECT_NE(text.find(" of file " + scene.file.path), std::string::npos) << text;
  }
}

TEST(WallGridFile, numbers_that_are_no_distances_are_refused)
{
  const auto error_of = [](const Shape &shape) {
    try {
      const GridScene scene(2, 0.4, {{"distance", shape}}, {{4.0, 4.0, 0.0}}, jkr);
    } catch (const std::runtime_error &error) {
      return std::string(error.what());
    }
    return std::string();
  };
  for (const double size : {1.7e308, 1e307, 1e160}) {
    const auto text = error_of([size](const double *x) {
      return x[1] > 1.0 ? size : -size;
    });
    for (const char *word : {"Fix wall/levelset file /", "array distance is -1", "at node (0 0 0)",
                             "must be within +-1e+100"})
      EXPECT_NE(text.find(word), std::string::npos) << text;
  }
  for (const double same : {0.0, -5.0})
    EXPECT_NE(error_of([same](const double *) {
                return same;
              }).find("array distance is > 0 nowhere: it must be so in the fluid"),
              std::string::npos);
}

// Behind another side, where no particle comes, a side need not be a distance.
TEST(WallGridFile, what_lies_behind_other_sides_does_not_count)
{
  for (const double break_at : {0.9, 1.6}) {
    const auto floor = [break_at](const double *x) {
      return x[0] > break_at ? x[1] - 1.0 : 3.0 * (x[1] - 1.0);
    };
    GridScene scene(2, 0.1, {{"distance_floor", floor}, {"distance_side", plane(1, 0, 0, 1.0)}},
                    {{3.0, 3.0, 0.0}}, jkr);
    const std::string text = scene.sim.error_of("run 0");
    if (break_at < 1.0)
      EXPECT_EQ(text, "");
    else
      EXPECT_NE(text.find("array distance_floor is not a smooth distance"), std::string::npos);
  }
}

// Nodes may be far apart along an axis along which nothing changes. What a spacing is good for, and
// the one that would do, are those of the other axes.
TEST(WallGridFile, spacings_may_differ)
{
  const auto error_of = [](double h, const Shape &shape, const std::string &law) {
    TemporaryFile file("apf_wall_layers");
    const int n = static_cast<int>(std::lround(8.0 / h)) + 1;
    file.write({n, n, 3}, {0, 0, 0}, {h, h, 4.0}, [&](VtkhdfWriter &w) {
      w.field("distance", 1, [&](const double *x, double, double *phi) {
        *phi = shape(x);
      });
    });
    Scene scene;
    scene.boundary = "f f p";
    scene.style = none + "fix wall all wall/levelset file " + file.path + law + "\n";
    Simulation sim;
    build(sim, {{6.6, 4.0, 4.0}}, scene);
    return sim.error_of("run 0");
  };
  EXPECT_EQ(error_of(0.1, circle, jkr), "");
  const std::string coarse = error_of(0.4, circle, jkr + "resolution 1e-4");
  EXPECT_NE(coarse.find("instead of 0.4,"), std::string::npos) << coarse;
  EXPECT_EQ(error_of(0.1, outside_quadrant, jkr), "");
  const std::string edge = error_of(0.5, outside_quadrant, jkr);
  EXPECT_NE(edge.find("edges a spacing below a third of a radius"), std::string::npos) << edge;
}

TEST(WallGridFile, files_that_do_not_fit_are_refused)
{
  const auto refused = [](const std::string &law, const std::string &array, const char *expected) {
    try {
      GridScene scene(2, 0.4, {{array, plane(0, 1, 0, 1.0)}}, {{3.0, 3.0, 0.0}}, law);
      ADD_FAILURE() << "accepted: " << law;
    } catch (const std::runtime_error &error) {
      EXPECT_NE(std::string(error.what()).find(expected), std::string::npos) << error.what();
    }
  };
  refused(jkr, "depth", "distance");
  refused(" array floor" + jkr, "distance", "floor");
  refused(jkr + "resolution 0", "distance", "resolution must be > 0, got 0");
  Simulation sim;
  Scene scene;
  scene.boundary = "f f f";
  scene.style = none;
  build(sim, {{3.0, 3.0, 3.0}}, scene);
  EXPECT_NE(
      sim.error_of("fix wall all wall/levelset file missing.vtkhdf" + jkr).find("missing.vtkhdf"),
      std::string::npos);
  EXPECT_NE(sim.error_of("fix wall all wall/levelset plane z 0 NULL" + jkr + "resolution 0.1")
                .find("for walls from a file"),
            std::string::npos);
}

// An extent that is not that of the arrays, and whose grid would not cover the box: the arrays are
// what the error is about.
TEST(WallGridFile, extents_of_another_grid_are_refused_as_such)
{
  const TemporaryFile file("apf_wall");
  file.write({9, 9, 9}, {0, 0, 0}, {1, 1, 1}, [](VtkhdfWriter &w) {
    for (const char *name : {"distance_floor", "distance_side"})
      w.field(name, 1, [](const double *x, double, double *phi) {
        *phi = x[1];
      });
    w.integers("WholeExtent", {0, 7, 0, 8, 0, 8});
  });
  Simulation sim;
  Scene scene;
  scene.boundary = "f f f";
  scene.style = none;
  build(sim, {{3.0, 3.0, 3.0}}, scene);
  for (const char *name : {"floor", "side"}) {
    const std::string words = file.path + " array distance_" + name;
    const std::string text = sim.error_of("fix wall all wall/levelset file " + words + jkr);
    EXPECT_NE(text.find(std::string("array distance_") + name +
                        " must have shape [9][9][8] (z, y, x) as WholeExtent says, got [9][9][9]"),
              std::string::npos)
        << text;
  }
}

// Each array is a zone, named after it, with the area of its surface.
TEST(WallGridFile, pieces_are_zones)
{
  const auto half_circle = [](double side) {
    return [side](const double *x) {    // two circles of radius 1
      return std::hypot(x[0] - (4.0 + 2.0 * side), x[1] - 4.0) - 1.0;
    };
  };
  GridScene scene(2, 0.1,
                  {{"distance_left", half_circle(-1.0)}, {"distance_right", half_circle(1.0)}},
                  {{0.51, 4.0, 0.0}, {2.0, 5.49, 0.0}, {6.0, 5.49, 0.0}}, jkr);
  scene.sim.run("run 0");
  EXPECT_EQ(scene.sim.value("f_wall[1][8]"), 2.0);    // attached
  EXPECT_EQ(scene.sim.value("f_wall[2][8]"), 1.0);
  EXPECT_EQ(scene.sim.value("f_wall[3][8]"), 3.0);
  for (int row : {1, 2})    // chords of a tenth: 1 - h^2/24 or better
    EXPECT_NEAR(scene.sim.value("f_wall[" + std::to_string(row) + "][13]") / (2.0 * pi), 1.0, 1e-3);
}

// All pieces are taken, whatever else is in the file, each once.
TEST(WallGridFile, pieces_among_many_arrays)
{
  std::map<std::string, Shape> arrays = {{"distance_left", plane(1, 0, 0, 0.5)},
                                         {"distance_right", plane(-1, 0, 0, -7.5)}};
  for (int k = 0; k < 60; k++) arrays["a" + std::to_string(k)] = circle;
  const std::string longest = "distance_" + std::string(200, 'z');
  arrays[longest] = plane(0, 1, 0, 0.5);
  GridScene scene(2, 0.4, arrays, {{0.99, 4.0, 0.0}, {7.01, 4.0, 0.0}, {4.0, 0.99, 0.0}}, jkr);
  scene.sim.run("run 0");
  for (const int row : {1, 2, 3})
    EXPECT_EQ(scene.sim.value("f_wall[" + std::to_string(row) + "][8]"), 1.0) << "attached";
}

TEST(WallGridFile, names_that_are_no_words_are_refused)
{
  for (const std::string name : {"distance_left distance_left", "distance_\n", "distance_\xfc"})
    try {
      GridScene scene(2, 0.4, {{"distance_left", plane(1, 0, 0, 0.5)}, {name, circle}},
                      {{3.0, 3.0, 0.0}}, jkr);
      ADD_FAILURE() << "accepted: " << name;
    } catch (const std::runtime_error &error) {
      EXPECT_NE(std::string(error.what()).find("must be of ASCII without blanks, got \"" + name),
                std::string::npos)
          << error.what();
    }
}

// In pictures a sphere of twice the radius covers four times as many pixels, a circle twice as
// many.
TEST(WallGridFile, is_drawn_in_pictures)
{
  const std::string picture = scratch_file("picture.ppm");
  const auto red_pixels = [&](int dims, double radius) {
    const auto shape = [&](const double *x) {
      const double z = dims == 3 ? x[2] - 4.0 : 0.0;
      return std::sqrt((x[0] - 4.0) * (x[0] - 4.0) + (x[1] - 4.0) * (x[1] - 4.0) + z * z) - radius;
    };
    GridScene scene(dims, 0.2, {{"distance", shape}}, {{1.0, 1.0, dims == 3 ? 1.0 : 0.0}}, jkr);
    scene.sim.run("run 0\nwrite_dump all image " + picture +
                  " type diameter atom no box no 0 size 400 400 view 0 0 fix wall type " +
                  (dims == 3 ? "1" : "0.1") + " 0 modify backcolor black acolor 1 red");
    std::ifstream in(picture, std::ios::binary);
    std::string line;
    std::vector<std::string> head;    // P6, width and height, 255; comments between them
    while (head.size() < 3 && std::getline(in, line))
      if (line[0] != '#') head.push_back(line);
    std::vector<unsigned char> bytes(3 * 400 * 400);
    in.read(reinterpret_cast<char *>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    int count = 0;
    for (size_t p = 0; p < bytes.size(); p += 3) count += bytes[p] > 20 && bytes[p + 1] < 20;
    return count;
  };
  for (int dims : {2, 3}) {
    const double small = red_pixels(dims, 1.0), large = red_pixels(dims, 2.0);
    EXPECT_GT(small, 200.0);
    EXPECT_NEAR(large / small, dims == 3 ? 4.0 : 2.0, 0.15);
  }
  std::filesystem::remove(picture);
}

// A wall through nodes of the grid has no triangles without area, which LAMMPS would draw black.
TEST(WallGridFile, walls_through_nodes_are_drawn_in_triangles_with_area)
{
  GridScene scene(3, 0.5, {{"distance", plane(0, 1, 0, 2.0)}}, {{4.0, 4.0, 4.0}}, jkr);
  scene.sim.run("run 0");
  int *objects;
  double **values;
  auto *wall = scene.sim.lammps()->modify->get_fix_by_id("wall");
  const int n = wall->image(objects, values);
  double area = 0.0;
  for (int t = 0; t < n; t++) {    // type, three corners
    const double *p = values[t] + 1;
    double a[3], b[3];
    for (int c = 0; c < 3; c++) {
      a[c] = p[3 + c] - p[c];
      b[c] = p[6 + c] - p[c];
    }
    const double x = a[1] * b[2] - a[2] * b[1], y = a[2] * b[0] - a[0] * b[2],
                 z = a[0] * b[1] - a[1] * b[0];
    const double part = 0.5 * std::sqrt(x * x + y * y + z * z);
    EXPECT_GT(part, 1e-6);
    area += part;
  }
  EXPECT_NEAR(area, 64.0, 64.0 * 1e-5);
}
