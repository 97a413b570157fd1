// Contacts so soft, or so sticky, that particles at rest sink into each other: C7 of the list of
// hard cases. What is warned of and what is refused is found here by bisection of E.

#include "criterion.h"
#include "scenes.h"

#include "force.h"
#include "pair.h"

namespace {

constexpr double radius = 0.5, gamma_of_all = 1.0;

// E at which the overlap at rest, a0^2/(3 R), is that part of the radius, with nu = 0 for both
// bodies
double young(bool wall, double overlap)
{
  const double R = wall ? radius : 0.5 * radius, a0 = std::sqrt(3.0 * R * radius * overlap);
  return 2.0 * 9.0 * pi * gamma_of_all * R * R / (a0 * a0 * a0);
}

// what the start of a run says of it
std::string said(bool wall, double overlap)
{
  const std::string law = " jkr " + digits(young(wall, overlap)) + " 0 " + digits(gamma_of_all);
  Scene scene;
  scene.boundary = "p p f";
  scene.style = "pair_style granular/adhesive\npair_coeff * *" +
      (wall ? std::string(" jkr 1e9 0 0\nfix wall all wall/levelset plane z 0 NULL") : "") + law +
      "\n";
  Simulation sim;
  build(sim, {{4.0, 4.0, 4.0}}, scene);
  try {
    return log_of(sim, "timestep 1e-6\nrun 0\n");
  } catch (const std::runtime_error &error) {
    std::filesystem::remove(scratch_file("log"));
    return error.what();
  }
}

// the overlap from which on those words are said, between two where they are and are not
double limit(bool wall, const std::string &words, double low, double high)
{
  EXPECT_EQ(said(wall, low).find(words), std::string::npos) << low;
  EXPECT_NE(said(wall, high).find(words), std::string::npos) << high;
  for (int n = 0; n < 10; n++) {
    const double half = 0.5 * (low + high);
    (said(wall, half).find(words) == std::string::npos ? low : high) = half;
  }
  return 0.5 * (low + high);
}

TEST(OverlapLimits, are_told_before_the_first_step)
{
  for (const bool wall : {false, true}) {
    const std::string of = wall ? "of a wall" : "of a pair";
    expect_criterion("C7 styles: overlap at rest that is warned of, over r, " + of,
                     limit(wall, "particles at rest overlap by", 0.03, 0.07), 0.0495, 0.0505);
    expect_criterion("C7 styles: overlap at rest that is refused, over r, " + of,
                     limit(wall, "above 0.5 the contact law has no meaning", 0.3, 0.7), 0.495,
                     0.505);
  }
}

// pairs are seen to the end of the neck, whatever the skin
TEST(OverlapLimits, cutoff_reaches_to_the_end_of_the_neck)
{
  const Material material;
  for (const double d : {1.0, 0.1}) {
    Simulation sim;
    build(sim, {{4.0, 4.0, 4.0}, {6.0, 4.0, 4.0, d}});
    sim.run("neighbor 0 bin\nrun 0");
    const double cutoff = std::sqrt(sim.lammps()->force->pair->cutsq[1][1]);
    // of two of the largest
    expect_criterion("C7 styles: cut-off over r_i + r_j + delta_C",
                     cutoff / (1.0 + material.pair().delta_C()), 1.0 - 1e-12, 1.001);
  }
}

}    // namespace
