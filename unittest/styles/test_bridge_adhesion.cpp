// Liquid bridge and adhesive contact side by side: JKR with the surface energy that the liquid
// leaves, eqs (48) to (50), and the capillary force of (45) in contact.

#include "wet_spheres.h"

namespace {

// Hamaker constants of bodies and liquid; distance of closest approach in it over that in air
struct Interface {
  double x, Ai, Aj, Af;

  std::string words() const
  {
    return "wet_gamma " + digits(x) + " " + digits(Ai) + " " + digits(Aj) + " " + digits(Af) + " ";
  }
  // -(1/2) integral of p(x) = -A / (6 pi x^3) from the closest approach on, in u = 1/x
  static double energy(double A, double closest)
  {
    const int n = 2000;
    double sum = 0.0;
    for (int q = 0; q < n; q++) sum += (q + 0.5) / n;
    return 0.5 * A / (6.0 * pi) * sum / n / (closest * closest);
  }
  double share() const
  {
    const double dry = std::sqrt(Ai * Aj);
    const double wet = (std::sqrt(Ai) - std::sqrt(Af)) * (std::sqrt(Aj) - std::sqrt(Af));
    return energy(wet, x) / energy(dry, 1.0);
  }
};

// One sphere at another or at a wall, x = 0 where they touch, which both forces hold.
struct WetContact {
  bool wall;
  Liquid liquid;
  JkrCurve adhesion;

  WetContact(bool at_wall, double share) : wall(at_wall)
  {
    liquid.R = wall ? 0.5 : 0.25;
    Material material;
    material.gamma *= share;
    adhesion = material.curve(liquid.R);
  }
  double force(double overlap) const { return adhesion.force(overlap) - liquid.pull(-overlap); }
  double overlap_at_rest() const
  {
    double low = 0.0, high = 0.1;
    for (int n = 0; n < 80; n++)
      (force(0.5 * (low + high)) < 0.0 ? low : high) = 0.5 * (low + high);
    return low;
  }
  double touch() const { return wall ? 0.5 : 5.0; }
  void make(Simulation &sim, const std::string &more, double overlap) const
  {
    const std::string law = jkr + liquid.words() + more;
    Scene scene;
    scene.boundary = "f p p";
    scene.style = wall ? none + "fix w all wall/levelset plane x 0 NULL" + law + "\n"
                       : granular(law);
    std::vector<Sphere> spheres = {{touch() - overlap, 4.0, 4.0}};
    if (!wall) spheres.push_back({4.0, 4.0, 4.0});
    build(sim, spheres, scene);
  }
  static inline const std::string none =
      "pair_style granular/adhesive\npair_coeff * *" + jkr + "\n";
};

const Interface silica{1.0, 6.5, 6.5, 3.7}, unlike{1.3, 6.5, 4.0, 2.0},
    dissolved{1.0, 6.5, 6.5, 6.5};

TEST(BridgeAdhesion, force_is_that_of_jkr_in_the_liquid_and_of_the_bridge)
{
  for (const bool wall : {false, true})
    for (const auto &hamaker : {silica, unlike}) {
      SCOPED_TRACE(testing::Message() << wall << hamaker.x);
      const WetContact wet(wall, hamaker.share());
      Simulation sim;
      wet.make(sim, hamaker.words(), 1.0e-4);
      sim.run("timestep 1.0e-13\nrun 0");
      const double neck = wet.adhesion.delta_C();
      EXPECT_GT(0.8 * neck, wet.liquid.hmin * wet.liquid.R) << "H changes along the neck";
      for (const double overlap : {0.01, 0.002, 0.0, -0.4 * neck, -0.8 * neck}) {
        sim.run("set atom 1 x " + digits(wet.touch() - overlap) + "\nrun 0 post no");
        EXPECT_NEAR(sim.value("fx[1]") / wet.force(overlap), 1.0, 1e-6) << overlap;
      }
      // beyond the neck the bridge is alone
      sim.run("set atom 1 x " + digits(wet.touch() + 1.2 * neck) + "\nrun 0 post no");
      EXPECT_NEAR(sim.value("fx[1]") / -wet.liquid.pull(1.2 * neck), 1.0, 1e-9);
    }
}

TEST(BridgeAdhesion, rests_where_repulsion_balances_adhesion_and_bridge)
{
  for (const bool wall : {false, true})
    for (const auto &hamaker : {silica, dissolved}) {
      const WetContact wet(wall, hamaker.share());
      const double rest = wet.overlap_at_rest();
      EXPECT_GT(rest, 1.1 * wet.adhesion.delta_eq()) << "the bridge presses";
      Simulation sim;
      wet.make(sim, hamaker.words() + "damping tsuji 0.1", 0.8 * rest);
      sim.run("fix nve all nve/sphere\nrun 6000");
      const double overlap = wall ? 0.5 - sim.value("x[1]") : 1.0 - sim.value("x[1]-x[2]");
      EXPECT_NEAR(overlap / rest, 1.0, 1e-6) << wall << hamaker.Af;
    }
}

// A liquid with the Hamaker constant of the bodies leaves no adhesion, and files say so.
TEST(BridgeAdhesion, goes_through_data_and_restart_files)
{
  const std::string data = scratch_file("wet.data"), restart = scratch_file("wet.restart");
  for (const auto &hamaker : {silica, dissolved}) {
    const WetContact wet(false, hamaker.share());
    {
      Simulation sim;
      wet.make(sim, hamaker.words(), 0.005);
      sim.run("run 0\nwrite_data " + data + " pair ij\nwrite_restart " + restart);
    }
    std::ifstream in(data);
    const std::string text{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(text.find("inf"), std::string::npos) << text;
    for (const bool from_data : {true, false}) {
      Simulation sim;
      if (from_data)
        sim.run("atom_style sphere\natom_modify map array\ncomm_modify vel yes\nboundary f p p\n"
                "pair_style granular/adhesive\nread_data " +
                data + "\nrun 0");
      else
        sim.run("atom_modify map array\nread_restart " + restart + "\ncomm_modify vel yes\nrun 0");
      EXPECT_NEAR(sim.value("fx[1]") / wet.force(0.005), 1.0, 1e-6) << from_data << hamaker.Af;
    }
    std::remove(data.c_str());
    std::remove(restart.c_str());
  }
}

}    // namespace
