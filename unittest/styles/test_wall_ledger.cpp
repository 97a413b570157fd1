// Fix wall/levelset: zones and what the array says about each, in scenes that can be counted by
// hand; areas of zones against geometry.

#include "scenes.h"

namespace {

enum {
  FORCE = 1,
  TORQUE = 4,
  CONTACTS = 7,
  ATTACHED,
  DEPOSITED,
  CAPTURED,
  DETACHED,
  MASS,
  AREA,
  MASS_PER_AREA,
  THICKNESS
};

const double mass = pi / 6.0;    // of a sphere of diameter and density 1
const std::string quiet = jkr + "damping tsuji 0.1 ";
const std::string floor_law = "fix wall all wall/levelset plane z 0 NULL" + quiet;
const std::string slit_law = "fix wall all wall/levelset plane z 0 8" + quiet;

Scene at_wall(const std::string &wall, const std::string &boundary = "p p f")
{
  Scene scene;
  scene.boundary = boundary;
  scene.style = "pair_style granular/adhesive\npair_coeff * *" + quiet + "\n" + wall + "\n";
  return scene;
}

double entry(Simulation &sim, int row, int column, const std::string &of = "f_wall")
{
  return sim.value(of + "[" + std::to_string(row) + "][" + std::to_string(column) + "]");
}

using Counts = std::vector<int>;
// contacts, particles that touch, in aggregates that touch, captured, detached
Counts counts(Simulation &sim, int row)
{
  Counts all;
  for (int c = CONTACTS; c <= DETACHED; c++)
    all.push_back(static_cast<int>(std::lround(entry(sim, row, c))));
  return all;
}

const std::string halves = "region left block -1 4 -1 9 -1 9\nregion right block 4 9 -1 9 -1 9\n";

// ---------------------------------------------------------------------------------------------
// loads

// One sphere rests on the floor, one hangs from the ceiling by adhesion.
TEST(RanksLedger, each_plane_carries_the_weight_of_its_sphere)
{
  Simulation sim;
  build(sim, {{1.0, 2.0, 0.49}, {6.0, 5.0, 7.51}}, at_wall(slit_law));
  sim.run("fix nve all nve/sphere\nfix g all gravity 400 vector 0 0 -1\nrun 5000");
  const double weight = 400.0 * mass;
  const double at[2][2] = {{1.0, 2.0}, {6.0, 5.0}};
  for (const int row : {1, 2}) {
    EXPECT_NEAR(entry(sim, row, FORCE + 2) / -weight, 1.0, 1e-6);
    EXPECT_NEAR(entry(sim, row, TORQUE) / (-at[row - 1][1] * weight), 1.0, 1e-6);
    EXPECT_NEAR(entry(sim, row, TORQUE + 1) / (at[row - 1][0] * weight), 1.0, 1e-6);
    EXPECT_EQ(counts(sim, row), (Counts{1, 1, 1, 1, 0}));
    EXPECT_NEAR(entry(sim, row, MASS), mass, 1e-12);
    EXPECT_NEAR(entry(sim, row, AREA), 64.0, 1e-9);
    EXPECT_NEAR(entry(sim, row, MASS_PER_AREA), mass / 64.0, 1e-12);
  }
  EXPECT_NEAR(entry(sim, 3, FORCE + 2) / (-2.0 * weight), 1.0, 1e-6);
  EXPECT_EQ(counts(sim, 3), (Counts{2, 2, 2, 2, 0}));
  EXPECT_NEAR(entry(sim, 3, AREA), 128.0, 1e-9);
  EXPECT_NEAR(entry(sim, 3, THICKNESS), 2.0 * mass / 128.0, 1e-12);
}

// Zones share every load, also that which is due from one run to the next, in collision steps too.
TEST(RanksLedger, zones_add_up_to_the_vector)
{
  for (const std::string &integrate : {std::string("fix nve all nve/sphere\n"), mts(8)}) {
    Simulation sim;
    std::vector<Sphere> spheres;
    for (int n = 0; n < 9; n++)
      spheres.push_back({0.9 + 1.3 * (n % 3), 0.8 + 2.1 * (n / 3), 0.505 + 0.01 * n});
    build(sim, spheres, at_wall(halves + floor_law + all_friction + " zone a left zone b right"));
    sim.run("velocity all set 3 1 -4\n" + integrate + "run 150\nrun 150\nrun 1");
    double largest_force = 0.0;
    for (int c = 1; c <= 6; c++) {
      const double total = sim.value("f_wall[" + std::to_string(c) + "]");
      double sum = 0.0;
      for (const int row : {1, 2, 3}) sum += entry(sim, row, c);
      EXPECT_NEAR(sum, total, 1e-10 * (1.0 + std::fabs(total))) << c;
      EXPECT_EQ(entry(sim, 4, c), total) << c;
      largest_force = std::max(largest_force, std::fabs(total));
    }
    EXPECT_GT(largest_force, 1.0);
    EXPECT_EQ(entry(sim, 4, CONTACTS), sim.value("f_wall[7]"));
    EXPECT_EQ(entry(sim, 4, CAPTURED), sim.value("f_wall[8]"));    // one plane: one contact each
    EXPECT_EQ(entry(sim, 4, DETACHED), sim.value("f_wall[9]"));
    EXPECT_GT(entry(sim, 4, CAPTURED), 4.0);
    EXPECT_EQ(entry(sim, 4, CAPTURED) - entry(sim, 4, DETACHED), entry(sim, 4, ATTACHED));
  }
}

// ---------------------------------------------------------------------------------------------
// aggregates

// An arch of five that stands on both zones, a single sphere, a pair that is free.
const std::vector<Sphere> arch = {{2.6, 4.0, 0.49},  {2.6, 4.0, 1.45},  {3.56, 4.0, 1.45},
                                  {4.52, 4.0, 1.45}, {4.52, 4.0, 0.49}, {1.0, 7.0, 0.49},
                                  {6.0, 1.0, 3.0},   {6.0, 1.96, 3.0}};

TEST(RanksLedger, aggregate_on_two_zones_counts_in_both_and_once_in_all)
{
  for (const char *newton : {"on", "off"}) {
    Simulation sim;
    Scene scene = at_wall(halves + floor_law + "zone a left zone b right");
    scene.newton = newton;
    build(sim, arch, scene);
    sim.run("run 0");
    EXPECT_EQ(counts(sim, 1), (Counts{2, 2, 6, 2, 0}));
    EXPECT_EQ(counts(sim, 2), (Counts{1, 1, 5, 1, 0}));
    EXPECT_EQ(counts(sim, 3), (Counts{0, 0, 0, 0, 0})) << "rest";
    EXPECT_EQ(counts(sim, 4), (Counts{3, 3, 6, 3, 0}));
    EXPECT_NEAR(entry(sim, 1, MASS), 6.0 * mass, 1e-12);
    EXPECT_NEAR(entry(sim, 2, MASS), 5.0 * mass, 1e-12);
    EXPECT_NEAR(entry(sim, 4, MASS), 6.0 * mass, 1e-12);
    EXPECT_NEAR(entry(sim, 1, AREA), 32.0, 1e-9);
    EXPECT_NEAR(entry(sim, 4, AREA), 64.0, 1e-9);
    EXPECT_NEAR(entry(sim, 2, THICKNESS), 5.0 * mass / 32.0, 1e-9);
    EXPECT_NEAR(entry(sim, 4, THICKNESS), 6.0 * mass / 64.0, 1e-9);
  }
}

// With another pair style nothing is known of contacts between particles.
TEST(Ledger, other_pair_styles_have_no_aggregates)
{
  Simulation sim;
  Scene scene = at_wall("");
  scene.style = "pair_style zero 2\npair_coeff * *\n" + floor_law + "\n";
  build(sim, arch, scene);
  sim.run("run 0");
  EXPECT_EQ(counts(sim, 1), (Counts{3, 3, 3, 3, 0}));
}

// ---------------------------------------------------------------------------------------------
// captured and detached

TEST(RanksLedger, impact_and_rebound)
{
  for (const std::string &integrate : {std::string("fix nve all nve/sphere\n"), mts(8)}) {
    Simulation sim;
    build(sim, {{1.0, 4.0, 0.505}, {6.0, 4.0, 0.505}},
          at_wall(halves + "fix wall all wall/levelset plane z 0 NULL" + jkr +
                  "zone a left zone b right"));
    set_motion(sim, 1, {0.0, 0.0, -8.0}, {0.0, 0.0, 0.0});    // comes back
    set_motion(sim, 2, {0.0, 0.0, -1.0}, {0.0, 0.0, 0.0});    // stays
    sim.run(integrate + "run 8");
    sim.run("run 2000");
    EXPECT_EQ(counts(sim, 1), (Counts{0, 0, 0, 1, 1}));
    EXPECT_EQ(counts(sim, 2), (Counts{1, 1, 1, 1, 0}));
    EXPECT_EQ(counts(sim, 4), (Counts{1, 1, 1, 2, 1}));
  }
}

// A sphere without adhesion fits into a slit, then lets go of the upper plane only.
TEST(Ledger, particle_with_two_contacts_is_one_particle)
{
  const std::string slit = "fix wall all wall/levelset plane z 0 0.995 jkr 1e6 0.25 0 ";
  for (const std::string &zones : {std::string(""), halves}) {
    Simulation sim;
    build(sim, {{2.0, 4.0, 0.4975}}, at_wall(zones + slit + (zones.empty() ? "" : "zone a left")));
    sim.run("fix mv all move linear 0 0 -0.512 units box\nrun 1");
    const int all = 3;    // after lo and hi, or a and rest
    EXPECT_EQ(counts(sim, 1), zones.empty() ? (Counts{1, 1, 1, 1, 0}) : (Counts{2, 1, 1, 1, 0}));
    EXPECT_EQ(counts(sim, all), (Counts{2, 1, 1, 1, 0}));
    sim.run("run 127");    // down by 0.004
    EXPECT_EQ(counts(sim, 1), (Counts{1, 1, 1, 1, 0}));
    EXPECT_EQ(counts(sim, 2), zones.empty() ? (Counts{0, 0, 0, 1, 1}) : (Counts{0, 0, 0, 0, 0}));
    EXPECT_EQ(counts(sim, all), (Counts{1, 1, 1, 1, 0}));
    EXPECT_EQ(sim.value("f_wall[9]"), 1.0);
  }
}

// What crosses from zone to zone takes contact and load along; it is neither captured nor detached
// by that. Lifted off in the second zone it has left that one.
TEST(RanksLedger, particle_crosses_from_zone_to_zone)
{
  Simulation sim;
  build(sim, {{3.5, 4.0, 0.49}}, at_wall(halves + floor_law + "zone a left zone b right"));
  sim.run("fix mv all move linear 64 0 0 units box\nrun 64");    // by 0.25
  EXPECT_EQ(counts(sim, 1), (Counts{1, 1, 1, 1, 0}));
  const double force = entry(sim, 1, FORCE + 2);
  EXPECT_GT(std::fabs(force), 10.0);
  EXPECT_EQ(entry(sim, 2, FORCE + 2), 0.0);
  sim.run("run 192");
  EXPECT_EQ(counts(sim, 1), (Counts{0, 0, 0, 1, 0}));
  EXPECT_EQ(counts(sim, 2), (Counts{1, 1, 1, 0, 0}));
  EXPECT_NEAR(entry(sim, 2, FORCE + 2) / force, 1.0, 1e-6);
  EXPECT_EQ(entry(sim, 1, FORCE + 2), 0.0);
  sim.run("unfix mv\nfix mv all move linear 0 0 16 units box\nrun 128");
  EXPECT_EQ(counts(sim, 1), (Counts{0, 0, 0, 1, 0}));
  EXPECT_EQ(counts(sim, 2), (Counts{0, 0, 0, 0, 1}));
  EXPECT_EQ(counts(sim, 4), (Counts{0, 0, 0, 1, 1}));
}

// A particle beyond a periodic face, not exchanged yet, is in the zone at the other end.
TEST(RanksLedger, zones_are_those_of_the_periodic_image)
{
  Simulation sim;
  build(sim, {{0.05, 4.0, 0.49}}, at_wall(halves + floor_law + "zone a left zone b right"));
  sim.run("neighbor 2.0 bin\nneigh_modify delay 1000000 every 1000000 check no\n"
          "fix mv all move linear -64 0 0 units box\nrun 25");
  ASSERT_LT(sim.value("x[1]"), 0.0);
  EXPECT_EQ(counts(sim, 2), (Counts{1, 1, 1, 0, 0}));
}

TEST(RanksLedger, first_zone_that_matches_counts_and_regions_may_move)
{
  Simulation sim;
  build(sim, {{1.0, 4.0, 0.49}, {6.0, 4.0, 0.49}},
        at_wall("variable along equal 64*step*dt\n"
                "region spot cylinder z 3 4 1 -1 1 move v_along NULL NULL\n"
                "region half block -1 9 -1 4.5 -1 9\n" +
                floor_law + "zone spot spot zone half half zone all lo"));
  sim.run("run 0");
  EXPECT_EQ(counts(sim, 1)[0], 0);
  EXPECT_EQ(counts(sim, 2)[0], 2);
  sim.run("run 768");    // by 3
  EXPECT_EQ(counts(sim, 1), (Counts{1, 1, 1, 0, 0}));
  EXPECT_EQ(counts(sim, 2), (Counts{1, 1, 1, 2, 0}));
  EXPECT_NEAR(entry(sim, 1, AREA), pi, 1e-4);
  EXPECT_NEAR(entry(sim, 2, AREA), 36.0 - pi / 2 - (std::asin(0.5) + 0.25 * std::sqrt(3.0)), 1e-3);
  EXPECT_NEAR(entry(sim, 5, AREA), 64.0, 1e-9);
}

// ---------------------------------------------------------------------------------------------
// areas

struct Area {
  std::string boundary, regions, wall;
  std::vector<double> areas;    // of zones, rest and all
};

TEST(Ledger, areas_are_those_of_geometry)
{
  const double cap = 2.0 * std::acos(0.5) * 2.0;    // arc of a circle of radius 2 beyond 1
  const std::vector<Area> table = {
      {"p p f",
       "region a block 1 3.3 2 2.9 -1 1\n",
       "plane z 0 8" + jkr + "zone a a zone top hi",
       {2.3 * 0.9, 64.0, 64.0 - 2.3 * 0.9, 128.0}},
      {"f f p",
       "region a block -1 9 4 9 -1 9\n",
       "cylinder z 4 4 4 inside" + jkr + "zone a a",
       {32.0 * pi, 32.0 * pi, 64.0 * pi}},
      {"f f p",
       "region a block 6 9 -1 9 -1 3\n",
       "cylinder z 5 4 2 outside" + jkr + "zone a a",
       {3.0 * cap, 32.0 * pi - 3.0 * cap, 32.0 * pi}},
      {"p p f", "", "cylinder x 0 4 2 outside" + jkr, {16.0 * pi, 16.0 * pi}},    // half of it
  };
  for (const auto &row : table) {
    SCOPED_TRACE(row.wall);
    Simulation sim;
    build(sim, {{1.0, 5.0, 4.0}},
          at_wall(row.regions + "fix wall all wall/levelset " + row.wall, row.boundary));
    sim.run("run 0");
    for (size_t n = 0; n < row.areas.size(); n++)
      EXPECT_NEAR(entry(sim, static_cast<int>(n) + 1, AREA) / row.areas[n], 1.0, 2e-5) << n;
  }
}

// Regions stay where they are while the wall moves; the box cuts a plane that has turned.
TEST(Ledger, areas_of_moving_walls_are_those_of_where_they_are)
{
  const double arc = 2.0 * std::acos(0.25) * 2.0;    // of a circle of radius 2 beyond 0.5
  const std::string part = "region a block 6 9 -1 9 -1 9\n";
  const std::vector<Area> table = {
      // after the time 1
      {"f f p",
       part,
       "cylinder z 4 4 2 outside" + jkr + "zone a a move linear 1.5 0 0",
       {8.0 * arc, 32.0 * pi - 8.0 * arc, 32.0 * pi}},
      {"f f p",
       part,
       "cylinder z 5.5 4 2 outside" + jkr + "zone a a move rotate 5.5 4 0 0 0 3",
       {8.0 * arc, 32.0 * pi - 8.0 * arc, 32.0 * pi}},
      {"p p f",
       "region a block 6 9 -1 9 -1 3\n",
       "plane z 0 NULL" + jkr + "zone a a move linear 0.3 0.2 4",
       {0.0, 64.0, 64.0}},
      {"f f f",
       part,    // by 45 degrees about an axis through the middle of the box
       "plane z 3 NULL" + jkr + "zone a a move rotate 4 4 4 0 " + digits(0.25 * pi) + " 0",
       {8.0 * std::sqrt(2.0) * (2.0 - std::sqrt(2.0)),
        8.0 * (8.0 * std::sqrt(2.0) - 2.0 - std::sqrt(2.0) * (2.0 - std::sqrt(2.0))),
        8.0 * (8.0 * std::sqrt(2.0) - 2.0)}},
  };
  for (const auto &row : table) {
    SCOPED_TRACE(row.wall);
    Simulation sim;
    build(sim, {{1.0, 5.0, 7.0}},
          at_wall(row.regions + "fix wall all wall/levelset " + row.wall, row.boundary));
    sim.run("timestep 0.01\nrun 100");
    for (size_t n = 0; n < row.areas.size(); n++)
      EXPECT_NEAR(entry(sim, static_cast<int>(n) + 1, AREA), row.areas[n],
                  2e-5 * (1.0 + row.areas[n]))
          << n;
  }
}

// In the plane areas are lengths, and a sphere counts in a slab as thick as itself: pi d^2 / 6.
TEST(RanksLedger, deposit_in_the_plane)
{
  Simulation sim;
  Scene scene =
      at_wall("region a block 1 3.5 -1 9 -1 1\nfix wall all wall/levelset plane y 0 NULL" + quiet +
                  "zone a a",
              "p f p");
  scene.before = "dimension 2";
  scene.box = "0 8 0 8 -0.5 0.5";
  build(sim, {{2.0, 0.49, 0.0}, {2.0, 1.195, 0.0, 0.5 - 0.05}, {6.0, 0.245, 0.0, 0.5}}, scene);
  sim.run("run 0");
  const double big = pi / 6.0, small = pi / 6.0 * 0.45 * 0.45, other = pi / 6.0 * 0.25;
  EXPECT_EQ(counts(sim, 1), (Counts{1, 1, 2, 1, 0}));
  EXPECT_NEAR(entry(sim, 1, AREA), 2.5, 1e-9);
  EXPECT_NEAR(entry(sim, 1, THICKNESS), (big + small) / 2.5, 1e-9);
  EXPECT_NEAR(entry(sim, 1, MASS_PER_AREA), (big + small) / 2.5, 1e-9);    // density 1
  EXPECT_NEAR(entry(sim, 1, MASS), big + small * 0.45, 1e-9);
  EXPECT_NEAR(entry(sim, 3, AREA), 8.0, 1e-9);
  EXPECT_NEAR(entry(sim, 3, THICKNESS), (big + small + other) / 8.0, 1e-9);
}

TEST(Ledger, area_follows_the_box)
{
  Simulation sim;
  build(sim, {{4.0, 4.0, 0.49}}, at_wall(floor_law));
  sim.run("run 0");
  EXPECT_NEAR(entry(sim, 1, AREA), 64.0, 1e-9);
  sim.run("change_box all x final 0 10\nrun 0");
  EXPECT_NEAR(entry(sim, 1, AREA), 80.0, 1e-9);
}

// ---------------------------------------------------------------------------------------------
// restart

TEST(RanksLedger, restart_goes_on_counting)
{
  const std::string file = scratch_file("ledger.restart");
  const std::string wall = halves + "fix wall all wall/levelset plane z 0 NULL" + jkr;
  std::vector<double> whole;
  auto rows = [](Simulation &sim) {
    std::vector<double> all;
    for (int row = 1; row <= 4; row++)
      for (int c = 1; c <= THICKNESS; c++) all.push_back(entry(sim, row, c));
    return all;
  };
  {
    Simulation sim;
    build(sim, {{1.0, 4.0, 0.505}, {6.0, 4.0, 0.505}, {1.0, 1.0, 0.7}},
          at_wall(wall + "zone a left zone b right"));
    set_motion(sim, 1, {0.0, 0.0, -8.0}, {0.0, 0.0, 0.0});
    set_motion(sim, 2, {0.0, 0.0, -1.0}, {0.0, 0.0, 0.0});
    set_motion(sim, 3, {0.0, 0.0, -4.0}, {0.0, 0.0, 0.0});
    sim.run("fix nve all nve/sphere\nrun 300\nwrite_restart " + file);
    ASSERT_EQ(counts(sim, 4), (Counts{1, 1, 1, 2, 1}));
    sim.run("run 1000");
    whole = rows(sim);
    ASSERT_EQ(entry(sim, 1, CAPTURED), 2.0);
  }
  {
    Simulation sim;
    sim.run("comm_modify vel yes\nread_restart " + file +
            "\npair_style granular/adhesive\npair_coeff * *" + quiet + "\n" + wall +
            "zone a left zone b right\nfix nve all nve/sphere\n");
    sim.run("run 1000");
    const auto again = rows(sim);
    for (size_t n = 0; n < whole.size(); n++)
      EXPECT_NEAR(again[n], whole[n], 1e-9 * std::max(1.0, std::fabs(whole[n]))) << n;
  }
  {
    Simulation sim;
    const std::string text = sim.error_of("comm_modify vel yes\nread_restart " + file + "\n" +
                                          wall + "zone a left zone c right");
    EXPECT_NE(
        text.find("zones in the restart file are a b rest (surfaces: lo), those of the command "
                  "are a c rest (surfaces: lo)"),
        std::string::npos)
        << text;
  }
  {
    Simulation sim;
    const std::string text = sim.error_of(
        "comm_modify vel yes\nread_restart " + file + "\n" + halves +
        "fix wall all wall/levelset cylinder z 5 5 4 inside" + quiet + " zone a left zone b right");
    EXPECT_NE(text.find("command are a b rest (surfaces: cylinder)"), std::string::npos) << text;
  }
  if (int rank = -1; MPI_Comm_rank(MPI_COMM_WORLD, &rank), rank == 0) std::filesystem::remove(file);
}

// Names of zones stand in the file one letter a number. What is no letter is not printed, whatever
// it would do to a terminal or to what comes after it; right letters of other names are.
TEST(Ledger, damaged_names_in_a_restart_file_are_not_printed)
{
  const std::string file = scratch_file("names.restart"),
                    wall = halves + "fix wall all wall/levelset plane z 0 NULL" + jkr +
      "zone zoneA left\n",
                    begin = "zone";
  std::string bytes;
  {
    Simulation sim;
    build(sim, {{1.0, 4.0, 0.7}}, at_wall(wall));
    sim.run("fix nve all nve/sphere\nrun 0\nwrite_restart " + file);
    std::ifstream in(file, std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  std::string name;
  for (const double letter : begin)
    name.append(reinterpret_cast<const char *>(&letter), sizeof(letter));
  const size_t at = bytes.find(name);
  ASSERT_NE(at, std::string::npos);
  ASSERT_EQ(bytes.find(name, at + 1), std::string::npos);
  const auto error_with = [&](double letter) {
    std::string changed = bytes;
    changed.replace(at + name.size(), sizeof(letter), reinterpret_cast<const char *>(&letter),
                    sizeof(letter));
    std::ofstream(file, std::ios::binary) << changed;
    Simulation sim;
    return sim.error_of("comm_modify vel yes\nread_restart " + file + "\n" + wall);
  };
  EXPECT_EQ(error_with('A'), "");
  for (const double letter :
       {0.0, 27.0, 31.0, 127.0, 155.0, 1e300, -1e300, HUGE_VAL, std::nan("")}) {
    const auto error = error_with(letter);
    EXPECT_NE(error.find("Fix wall/levelset wall: its part of the restart file cannot be used: it "
                         "is damaged"),
              std::string::npos)
        << letter << error;
    EXPECT_EQ(error.find(begin), std::string::npos) << letter << error;
  }
  EXPECT_NE(error_with('~').find("the zones in the restart file are zone~ rest"),
            std::string::npos);
  std::filesystem::remove(file);
}

}    // namespace
