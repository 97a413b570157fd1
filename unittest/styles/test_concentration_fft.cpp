// fix flow/concentration by convolution. Facts: it agrees with the direct sum and with closed
// forms, by walls, in the plane and where clouds are wider than the box.

#include "concentration_scene.h"

#include "comm.h"

#include <array>

// largest difference of two grids' cells, and the largest value of the second
static std::array<double, 2> compare(Simulation &sim, const std::string &a, const std::string &b)
{
  const auto one = dumped(sim, "f_" + a + ":grid:data", scratch_file(a));
  const auto two = dumped(sim, "f_" + b + ":grid:data", scratch_file(b));
  EXPECT_EQ(one.size(), two.size());
  EXPECT_GT(one.size(), 0u);
  double worst = 0.0, peak = 0.0;
  for (size_t k = 0; k < one.size(); k++) {
    worst = std::max(worst, std::fabs(one[k] - two[k]));
    peak = std::max(peak, two[k]);
  }
  if (sim.lammps()->comm->me == 0) {
    std::filesystem::remove(scratch_file(a));
    std::filesystem::remove(scratch_file(b));
  }
  return {worst, peak};
}

#ifdef APF_FFTW

// by both methods, which differ by a little, but do differ
static void expect_alike(Simulation &sim, const std::string &what)
{
  sim.run("run 0\n");
  EXPECT_NEAR(sim.value("f_fft[1]") / volume(sim), 1.0, 1e-12) << what;
  const auto [worst, peak] = compare(sim, "fft", "direct");
  EXPECT_LT(worst, 1e-6 * peak) << what;
  EXPECT_GT(worst, 1e-13 * peak) << what;
}

TEST(RanksConcentration, convolution_agrees_with_the_direct_sum)
{
  for (const std::string &boundary :
       {std::string("p p p"), std::string("p f p"), std::string("f f f")}) {
    Simulation sim;
    sim.run(crowd(boundary) +
            "fix fft all flow/concentration 40 30 24 cloud 0.75 method fft\n"
            "fix direct all flow/concentration 40 30 24 cloud 0.75 method direct\n"
            "velocity all create 1.0 99 loop geom\n");
    expect_alike(sim, boundary);
    if (boundary != "p p p") continue;
    sim.run("run 50\n");
    expect_alike(sim, "after particles moved");
    sim.run("comm_style tiled\nbalance 1.0 rcb\nrun 20\n");
    expect_alike(sim, "after rcb");
  }
}

TEST(RanksConcentration, convolution_returns_what_would_fall_in_walls)
{
  Simulation sim;
  std::string scene = crowd("p f p");
  const std::string none = "pair_style zero 0.5 nocoeff\npair_coeff * *";
  scene.replace(scene.find(none), none.size(),
                "pair_style granular/adhesive\npair_coeff * * jkr 1e4 0.3 0");
  sim.run(scene +
          "fix wall all wall/levelset cylinder x 4 3 2.9 inside jkr 1e4 0.3 0\n"
          "region outer cylinder x 4 3 2.8 INF INF side out\ndelete_atoms region outer "
          "compress yes\nfix fft all flow/concentration 40 32 24 cloud 0.75 method fft\n"
          "fix direct all flow/concentration 40 32 24 cloud 0.75 method direct\n");
  expect_alike(sim, "cylinder");
}

TEST(RanksConcentration, convolution_in_the_plane)
{
  for (const std::string &boundary : {std::string("p p p"), std::string("f p p")}) {
    Simulation sim;
    sim.run("units lj\ndimension 2\natom_style sphere\ncomm_modify vel yes\nboundary " + boundary +
            "\nregion box block 0 10 0 8 -0.5 0.5\ncreate_box 1 box\n"
            "create_atoms 1 random 100 4711 box\nset type 1 diameter 0.2 density 1\n"
            "pair_style zero 0.5 nocoeff\npair_coeff * *\nneighbor 0.4 bin\n"
            "fix move all nve/sphere\nfix flat all enforce2d\n"
            "fix fft all flow/concentration 40 30 1 cloud 0.75 method fft\n"
            "fix direct all flow/concentration 40 30 1 cloud 0.75 method direct\nrun 0\n");
    EXPECT_NEAR(sim.value("f_fft[1]") / (100.0 * pi / 6.0 * 0.04), 1.0, 1e-12) << boundary;
    const auto [worst, peak] = compare(sim, "fft", "direct");
    EXPECT_LT(worst, 1e-6 * peak) << boundary;
    EXPECT_GT(worst, 1e-13 * peak) << boundary;
  }
}

TEST(RanksConcentration, a_cloud_of_which_most_is_in_a_wall_is_as_direct)
{
  // in a corner of the box behind a gap of 0.4: erf(0.2) ((1 + erf(0.2))/2)^2 = 0.083 of the cloud
  Simulation sim;
  std::string scene = one("0.2 0.2 0.2", "f f f");
  const std::string none = "pair_style zero 0.5 nocoeff\npair_coeff * *";
  scene.replace(scene.find(none), none.size(),
                "pair_style granular/adhesive\npair_coeff * * jkr 1e4 0.3 0");
  sim.run(scene +
          "fix gap all wall/levelset plane x NULL 0.4 jkr 1e4 0.3 0\n"
          "fix fft all flow/concentration 50 50 50 cloud 1.0 method fft\n"
          "fix direct all flow/concentration 50 50 50 cloud 1.0 method direct\nrun 0\n");
  EXPECT_NEAR(sim.value("f_fft[1]") / volume(sim), 1.0, 1e-12);
  const auto [worst, peak] = compare(sim, "fft", "direct");
  EXPECT_LT(worst, 1e-14 * peak);
}

TEST(Concentration, the_cheaper_method_is_chosen)
{
  for (int n : {1, 1000}) {
    const std::string expected = n == 1 ? "direct" : "fft", grid = "flow/concentration 40 32 24";
    Simulation sim;
    // margins make the convolution dearer
    sim.run(crowd(n == 1 ? "f f f" : "p p p", n) + "fix auto all " + grid +
            " cloud 0.75\nfix other all " + grid + " cloud 0.75 method " + expected + "\nrun 0\n");
    EXPECT_EQ(compare(sim, "auto", "other")[0], 0.0) << expected;
  }
}

TEST(RanksConcentration, clouds_wider_than_the_box_meet_their_images)
{
  // R = 3 in a periodic length of 10: along an axis the mean over a cell is a sum over images
  const double R = 3.0, h = 0.5, V = pi / 6.0 * 0.064, at[3] = {2.3, 9.9, 4.75};
  const auto mean = [&](double a) {
    double sum = 0.0;
    for (int k = -3; k <= 3; k++)
      sum += 0.5 * (std::erf((a + h + 10.0 * k) / R) - std::erf((a + 10.0 * k) / R)) / h;
    return sum;
  };
  for (const std::string method : {"fft", "auto"}) {
    Simulation sim;
    sim.run(one("2.3 9.9 4.75") + "fix c all flow/concentration 20 20 20 cloud 3 method " + method);
    const auto c = dumped(sim, "f_c:grid:data", scratch_file("wide"));
    ASSERT_EQ(c.size(), 8000u);
    double largest = 0.0;
    for (double value : c) largest = std::max(largest, value);
    for (int k = 0; k < 8000; k++) {
      const double exact =
          V * mean(k % 20 * h - at[0]) * mean(k / 20 % 20 * h - at[1]) * mean(k / 400 * h - at[2]);
      EXPECT_NEAR(c[k], exact, 1e-6 * largest) << k;
    }
    EXPECT_NEAR(sim.value("f_c[1]") / V, 1.0, 1e-12);
    if (sim.lammps()->comm->me == 0) std::filesystem::remove(scratch_file("wide"));
  }
}

TEST(Concentration, wide_clouds_behind_walls_are_refused)
{
  Simulation sim;
  std::string scene = one("0.2 0.2 0.2", "f f p");
  const std::string none = "pair_style zero 0.5 nocoeff\npair_coeff * *";
  scene.replace(scene.find(none), none.size(),
                "pair_style granular/adhesive\npair_coeff * * jkr 1e4 0.3 0");
  const auto error = sim.error_of(scene +
                                  "fix gap all wall/levelset plane x NULL 0.4 jkr 1e4 0.3 0\n"
                                  "fix c all flow/concentration 20 20 20 cloud 3\nrun 0\n");
  EXPECT_NE(error.find("less than 0.1 of the cloud of a particle at 0.2 0.2 0.2"),
            std::string::npos)
      << error;
}

TEST(RanksConcentration, convolution_gives_no_negative_cells)
{
  Simulation sim;
  sim.run(crowd("p f p", 3) + "fix c all flow/concentration 40 30 24 cloud 0.75 method fft\n");
  const auto c = dumped(sim, "f_c:grid:data", scratch_file("sign"));
  ASSERT_EQ(c.size(), 40u * 30 * 24);
  int empty = 0;
  for (double value : c) {
    EXPECT_GE(value, 0.0);
    empty += value == 0.0;
  }
  EXPECT_GT(empty, 1000) << "there were some";
  EXPECT_NEAR(sim.value("f_c[1]") / volume(sim), 1.0, 1e-12);
  if (sim.lammps()->comm->me == 0) std::filesystem::remove(scratch_file("sign"));
}

#else

TEST(Concentration, without_fftw_clouds_are_added_up)
{
  const std::string grid = "flow/concentration 40 32 24 cloud 0.75 method ";
  Simulation sim;
  sim.run(crowd("p p p", 1000) + "fix auto all " + grid + "auto\nfix other all " + grid +
          "direct\nrun 0\n");
  EXPECT_EQ(compare(sim, "auto", "other")[0], 0.0);
  EXPECT_NE(sim.error_of("fix c all " + grid + "fft")
                .find("method fft needs APF built with FFTW for MPI"),
            std::string::npos);
  EXPECT_NE(sim.error_of("fix c all flow/concentration 20 20 20 cloud 3").find("must be <="),
            std::string::npos);
}

#endif
