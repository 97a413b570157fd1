// Distances to walls from shapes against closed forms.

#include "program.h"
#include "walls.h"

#include <fstream>

using namespace flowgrid;

TEST(Walls, circle)
{
  const Folder folder;
  const auto run = flowgrid_with("--shape 'c: disc(0.1,0.2, 1)' " + (folder / "c.vtkhdf") +
                                 " --spacing 0.05 --bounds -2 2 -2 2 0 0 --planar 0");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "c.vtkhdf");
  for (const char *name : {"distance", "distance_c"}) {
    const int count = d.expect(name, 0.199, 1e-13, [](const Point &x) {
      return std::hypot(x[0] - 0.1, x[1] - 0.2) - 1.0;
    });
    EXPECT_NEAR(count, 2 * pi * 0.398 / 0.0025, 30);
    // marched: to second order
    d.expect(name, 0.6, 2e-3, [](const Point &x) {
      return std::hypot(x[0] - 0.1, x[1] - 0.2) - 1.0;
    });
    EXPECT_EQ(surface_error(folder / "c.vtkhdf", name), 0.0);
  }
}

TEST(Walls, oblique_plane)
{
  const Folder folder;
  const auto run = flowgrid_with("--shape 'p: plane(0.1,0,0, 1,2,3)' " + (folder / "p.vtkhdf") +
                                 " --spacing 0.1 0.12 0.09 --bounds -1 1 -1 1 -1 1 --exact 0.5");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "p.vtkhdf");
  EXPECT_GT(d.expect("distance_p", 0.5, 1e-12,
                     [](const Point &x) {
                       return (x[0] - 0.1 + 2 * x[1] + 3 * x[2]) / std::sqrt(14.0);
                     }),
            2000);
}

TEST(Walls, duct_is_cut_along_its_edges)
{
  const Folder folder;
  const auto run =
      flowgrid_with("--shape 'duct: inside(box(0,0,-9, 1,2,9))' " + (folder / "d.vtkhdf") +
                    " --spacing 0.1 --bounds -0.3 1.3 -0.3 2.3 0 1");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "d.vtkhdf");
  int seen[4] = {};
  for (const char *name :
       {"distance_duct", "distance_duct_2", "distance_duct_3", "distance_duct_4"}) {
    // each is the distance to one plane, also beyond the edges
    const auto plane = [](int n, const Point &x) {
      return n == 0 ? x[0] : n == 1 ? 1.0 - x[0] : n == 2 ? x[1] : 2.0 - x[1];
    };
    for (int n = 0; n < 4; n++) {
      double worst = 0.0;
      d.for_near(name, 0.25, [&](const Point &x, double value) {
        worst = std::max(worst, std::fabs(value - plane(n, x)));
      });
      seen[n] += worst < 1e-12;
    }
  }
  for (const int count : seen) EXPECT_EQ(count, 1);
  EXPECT_FALSE(d.file.has("distance_duct_5"));
  d.for_near("distance", 0.35, [](const Point &x, double value) {
    if (x[0] > 0 && x[0] < 1 && x[1] > 0 && x[1] < 2)
      EXPECT_NEAR(value, std::min({x[0], 1.0 - x[0], x[1], 2.0 - x[1]}), 1e-12);
  });
}

TEST(Walls, convex_edges_are_round_and_stay_in_one_piece)
{
  const Folder folder;
  write_stl(folder / "cube.stl", cube());
  for (const std::string &words : {std::string("--shape 'cube: box(0,0,0, 1,1,1)' "),
                                   "--wall-surface " + (folder / "cube.stl") + " "}) {
    const auto run = flowgrid_with(words + (folder / "b.vtkhdf") +
                                   " --spacing 0.1 --bounds -0.5 1.5 -0.5 1.5 -0.5 1.5");
    ASSERT_EQ(run.status, 0) << run.text;
    EXPECT_NE(run.text.find("1 piece(s) in 1 array(s)"), std::string::npos) << run.text;
    const Distances d(folder / "b.vtkhdf");
    EXPECT_GT(d.expect("distance_cube", 0.39, 1e-12, outside_cube), 4000);
  }
}

TEST(Walls, rim_of_a_hole_and_the_floor_below_a_post)
{
  const Folder folder;
  auto run =
      flowgrid_with("--shape 'h: difference(box(-9,-9,-9, 9,9,0), cylinder(0,0,-8, 0,0,1, 0.5))' " +
                    (folder / "h.vtkhdf") + " --spacing 0.1 --bounds -1 1 -1 1 -0.5 0.8");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances hole(folder / "h.vtkhdf");
  hole.expect("distance_h", 0.39, 1e-12, [](const Point &x) {
    const double r = std::hypot(x[0], x[1]);
    if (x[2] <= 0.0) return r < 0.5 ? 0.5 - r : std::max(x[2], 0.5 - r);
    return r < 0.5 ? std::hypot(0.5 - r, x[2]) : x[2];
  });

  // the post goes on below the floor, the floor below the post
  run = flowgrid_with("--shape 'floor: plane(0,0,0, 0,0,1)' "
                      "--shape 'post: cylinder(0,0,0, 0,0,5, 0.5)' " +
                      (folder / "p.vtkhdf") + " --spacing 0.1 --bounds -1 1 -1 1 -0.3 1");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances post(folder / "p.vtkhdf");
  EXPECT_GT(post.expect("distance_post", 0.2, 1e-12,
                        [](const Point &x) {
                          return std::hypot(x[0], x[1]) - 0.5;
                        }),
            500);
  post.expect("distance_floor", 0.2, 1e-12, [](const Point &x) {
    return x[2];
  });
}

TEST(Walls, step_of_a_polygon_has_two_pieces)
{
  const Folder folder;
  const auto run =
      flowgrid_with("--shape 'step: polygon(-9,-9, 9,-9, 9,0, 0,0, 0,1, -9,1)' " +
                    (folder / "s.vtkhdf") + " --spacing 0.1 --bounds -2 3 -0.4 3 0 0 --planar 0");
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances d(folder / "s.vtkhdf");
  d.expect("distance_step", 0.39, 1e-13, [](const Point &x) {
    return x[1];
  });
  d.expect("distance_step_2", 0.39, 1e-13, [](const Point &x) {
    if (x[0] > 0.0 && x[1] > 1.0) return std::hypot(x[0], x[1] - 1.0);
    return std::max(x[0], x[1] - 1.0);
  });
}

TEST(Walls, narrow_places_are_named)
{
  const Folder folder;
  const std::string words = "--shape 'low: plane(0,0,0, 0,1,0)' --shape 'high: "
                            "plane(0,0.5,0, 0,-1,0)' " +
      (folder / "n.vtkhdf") + " --spacing 0.05 --bounds 0 1 0 0.5 0 0 --planar 0 --particle ";
  EXPECT_NE(flowgrid_with(words + "0.6").text.find("a gap is narrower than a particle: 0.5"),
            std::string::npos);
  EXPECT_EQ(flowgrid_with(words + "0.4").text.find("narrower"), std::string::npos);
}

// A bar with round ends, whose discs touch its faces: one piece wherever the nodes are.
TEST(Walls, faces_that_touch_smoothly_are_one_piece)
{
  const Folder folder;
  const std::string path = folder / "bar.vtkhdf";
  for (const std::string spacing : {"0.3", "0.2", "0.15", "0.07", "0.031"}) {
    const auto run =
        flowgrid_with(path +
                      " --bounds 0 3 0 2.4 0 0 --planar 0 --exact 0.3 --shape \"bar: union("
                      "rectangle(1,1, 2,1.4), disc(1,1.2, 0.2), disc(2,1.2, 0.2))\" --spacing " +
                      spacing);
    ASSERT_EQ(run.status, 0) << run.text;
    EXPECT_NE(run.text.find("1 piece(s) in 1 array(s)"), std::string::npos) << run.text;
    const Distances file(path);
    const int count = file.expect("distance_bar", 0.29, 1e-14, [](const Point &x) {
      const double along = std::max({1.0 - x[0], x[0] - 2.0, 0.0});
      return std::hypot(along, x[1] - 1.2) - 0.2;
    });
    EXPECT_GT(count, 10);
  }
}

// A disc across a periodic border, given once: distances to the nearest copy, and the same at both
// ends. A bar that ends at the border has no end there.
TEST(Walls, periodic_walls_go_on_at_the_other_end)
{
  const Folder folder;
  const std::string path = folder / "periodic.vtkhdf";
  const std::string words = path +
      " --spacing 0.1 --bounds 0 4 0 3 0 0 --planar 0 --band 12 "
      "--shape \"post: disc(0.3,1.5, 0.5)\" "
      "--shape \"bar: rectangle(0,-1, 4,0.2)\" --periodic x";
  const auto run = flowgrid_with(words);
  ASSERT_EQ(run.status, 0) << run.text;
  const Distances file(path);
  const auto post = [](const Point &x) {
    double least = 1e300;
    for (const double at : {-3.7, 0.3, 4.3})
      least = std::min(least, std::hypot(x[0] - at, x[1] - 1.5) - 0.5);
    return least;
  };
  EXPECT_GT(file.expect("distance_post", 0.39, 1e-14, post), 100);
  EXPECT_GT(file.expect("distance_post", 1.0, 0.03, post), 400);    // by fast marching
  EXPECT_GT(file.expect("distance_bar", 0.39, 1e-14,
                        [](const Point &x) {
                          return x[1] - 0.2;
                        }),
            200);
  for (const std::string array : {"distance", "distance_post", "distance_bar"}) {
    const auto values = file.file.read(array, 1, 0, 1);
    for (int j = 0; j < 31; j++) EXPECT_EQ(values[41 * j], values[41 * j + 40]) << array;
  }
  EXPECT_NE(run.text.find("distance_bar: bar at x = 0 to 4 y = 0.2\n"), std::string::npos)
      << run.text;
}

TEST(Walls, periods_that_cannot_be_are_refused)
{
  const Folder folder;
  const std::string words = folder / "periodic.vtkhdf" +
      " --bounds 0 4 0 3 0 0 --planar 0 --shape \"post: disc(0.3,1.5, 0.5)\" --spacing ";
  const auto expect = [&](const std::string &more, const std::string &text) {
    const auto run = flowgrid_with(words + more);
    EXPECT_NE(run.status, 0);
    EXPECT_NE(run.text.find(text), std::string::npos) << run.text;
  };
  expect("0.11 --periodic y", "--periodic y needs a --spacing that divides");
  expect("0.1 --periodic w", "--periodic takes x, y, z, got w");
  expect("0.1 --periodic z", "--periodic z needs a grid in space");
  expect("0.1 --periodic x --shape \"p: plane(1,0,0, 1,1,0)\"",
         "a plane across a --periodic direction");
}

TEST(Walls, wrong_shapes_are_pointed_at)
{
  const Folder folder;
  const std::string rest = " " + (folder / "w.vtkhdf") + " --spacing 0.1 --bounds 0 1 0 1 0 1";
  struct Row {
    std::string words;
    int status;
    std::string message;
  };
  const Row rows[] = {
      {"--shape 'a: cone(0,0,0,1)'", 1, "there is no shape cone; there are box"},
      {"--shape 'a: sphere(0,0,0)'", 1, "sphere takes 4 numbers, got 3"},
      {"--shape 'a: sphere(0,0,0,-1)'", 1, "a radius must be > 0"},
      {"--shape 'a: sphere(0,0,0,1) b'", 1, "nothing may follow the shape"},
      {"--shape 'sphere(0,0,0,1)'", 1, "expected :"},
      {"--shape 'a: box(1,0,0, 0,1,1)'", 1, "must lie above the first along x"},
      {"--shape 'a: extrude(0,1, polygon(0,0, 1,1, 1,0, 0,1))'", 1, "crosses or touches itself"},
      {"--shape 'a: plane(0,0,0, 0,0,0)'", 1, "the normal of a plane must not be 0"},
      {"--shape 'a: sphere(9,9,9, 1)'", 1, "no face of a --shape lies in the grid"},
      {"--shape 'a: sphere(0,0,0,1)' --shape 'a: sphere(1,0,0,1)'", 1, "there are two shapes a"},
      {"--shape 'a: sphere(0,0,0,1)' --planar 0", 1, "in a plane grid shapes are of"},
      {"--wall-surface none.stl", 1, "none.stl: does not exist"},
      {"--shape 'a: sphere(0,0,0,1)' --particle 0", 2, "--particle must be > 0, got 0"},
      {"--shape 'a: sphere(0,0,0,1)' --band 1", 2, "--band must be 4 cells or more"},
  };
  for (const auto &row : rows) {
    const auto run = flowgrid_with(row.words + rest);
    EXPECT_EQ(run.status, row.status) << row.words << "\n" << run.text;
    EXPECT_NE(run.text.find(row.message), std::string::npos) << row.words << "\n" << run.text;
  }
}

// Walls come last, after a mapping that may take long; their words are looked at first.
TEST(Walls, wrong_words_are_told_before_the_mesh_is_read)
{
  const Folder folder;
  write_stl(folder / "cube.stl", cube());
  std::ofstream(folder / "cube.ply") << "";
  const std::string mesh = poiseuille + " " + (folder / "w.vtkhdf") + " --spacing 0.1 ";
  const std::pair<std::string, std::string> rows[] = {
      {"--shape 'a: cone(0,0,0,1)'", "--shape: there is no shape cone"},
      {"--shape 'a: disc(0,0, 1)' --shape 'a: disc(1,0, 1)'", "--shape: there are two shapes a"},
      {"--periodic x --shape 'a: plane(0,0,0, 1,1,0)'", "--shape: a plane across a --periodic"},
      {"--shape 'a-b: disc(0,0, 1)'", "--shape: expected :"},
      {"--wall-surface none.stl", "none.stl: does not exist"},
      {"--wall-surface " + (folder / "cube.ply"), (folder / "cube.ply") + ": a surface must be"},
      {"--wall-surface " + (folder / "cube.stl") + ":a-b", "names of walls take letters, digits"},
  };
  for (const auto &[words, message] : rows) {
    const auto run = flowgrid_with(mesh + words);
    EXPECT_EQ(run.status, 1) << words;
    EXPECT_EQ(run.text.find("flowgrid: " + message), 0u) << words << "\n" << run.text;
  }
}
