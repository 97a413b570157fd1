// Liquid bridges through LAMMPS: forces, collisions, hysteresis, capture, units, output.

#include "criterion.h"
#include "wet_spheres.h"

namespace {

TEST(BridgeStyle, force_and_rupture_on_a_pair_that_is_pulled)
{
  Liquid water;
  water.mu = 0.7;
  const std::pair<bool, bool> scenes[] = {
      {false, false}, {true, false}, {false, true}, {true, true}};
  for (const auto &[wall, planar] : scenes) {
    SCOPED_TRACE(testing::Message() << wall << planar);
    Simulation sim;
    Scene scene;
    water.R = wall ? 0.5 : 0.25;
    const double z = planar ? 0.0 : 4.0;
    if (planar) {    // spheres there, too: the same forces
      scene.before = "dimension 2";
      scene.box = "0 8 0 8 -0.5 0.5";
    }
    scene.boundary = "f p p";
    scene.style = granular(elastic + (wall ? "" : water.words()));
    if (wall)
      scene.style += "fix w all wall/levelset plane x 0 NULL " + elastic + water.words() + "\n";
    // a pair at x = 4, or the sphere alone at the wall
    std::vector<Sphere> spheres = {{wall ? 0.4999 : 4.9999, 4.0, z}, {4.0, 4.0, z}};
    if (wall) spheres[1].y = 6.0;
    build(sim, spheres, scene);
    sim.run("timestep 1.0e-13\ncompute b all aggregate/contact\nrun 0");
    const double origin = wall ? 0.5 : 5.0;
    double last = 0.0;
    for (const double h : {0.01, 0.05, 0.1, 0.15, 0.99 * water.rupture()}) {
      sim.run("set atom 1 x " + digits(origin + h) + "\nrun 0 post no");
      EXPECT_NEAR(sim.value("fx[1]") / -water.pull(h), 1.0, 1e-10) << wall << h;
      EXPECT_EQ(of_atom(sim, 1, 5), 1.0);
      EXPECT_EQ(of_atom(sim, 1, 4), 1.0) << "a bond";
      EXPECT_NEAR(of_atom(sim, 1, 6) / water.V(), wall ? 1.0 : 0.5, 1e-12);
      last = h;
    }
    // the viscous part of a bridge that opens, and its larger reach
    const double speed = 0.01 * water.sigma / water.mu;    // Ca = 0.01
    sim.run("set atom 1 vx " + digits(speed) + "\ntimestep 1.0e-9\nrun 0 post no");
    const double viscous = water.k() * std::pow(water.H(last), 2) / last * speed;
    EXPECT_NEAR(sim.value("fx[1]") / -(water.pull(last) + viscous), 1.0, 1e-6);
    if (wall) {    // by parts, on the wall
      EXPECT_NEAR(sim.value("f_w[13]") / water.pull(last), 1.0, 1e-10) << "capillary";
      EXPECT_NEAR(sim.value("f_w[16]") / viscous, 1.0, 1e-6) << "viscous";
      EXPECT_NEAR(sim.value("f_w[19]") / -water.work(last), 1.0, 1e-5) << "energy";
      EXPECT_NEAR(sim.value("f_w") / sim.value("f_w[19]"), 1.0, 1e-12) << "nothing else";
      EXPECT_EQ(sim.value("f_w[14]"), 0.0);
    }
    sim.run("set atom 1 x " + digits(origin + 0.999 * water.rupture(0.01)) + "\nrun 0 post no");
    EXPECT_LT(sim.value("fx[1]"), -0.1);
    sim.run("set atom 1 x " + digits(origin + 1.001 * water.rupture(0.01)) + "\nrun 0 post no");
    EXPECT_EQ(sim.value("fx[1]"), 0.0);
    EXPECT_EQ(of_atom(sim, 1, 5), 0.0);
    sim.run("set atom 1 x " + digits(origin + 0.01) + "\nrun 0 post no");
    EXPECT_EQ(sim.value("fx[1]"), 0.0) << "forms by contact only";
  }
}

// A bridge forms at contact and ruptures far out: what a collision loses is the work in between.
TEST(BridgeStyle, collision_loses_the_work_of_its_hysteresis)
{
  const Liquid water;
  const double lost = water.work();
  for (const double ratio : {1.05, 1.5, 3.0}) {
    const double v = std::sqrt(2.0 * lost / water.m) * ratio;
    const double out = std::sqrt(v * v - 2.0 * lost / water.m);
    const int steps = static_cast<int>(1.0 / out / 4.0e-4);
    for (const double gap : {0.011, 0.0173}) {
      const std::string law = elastic + water.words();
      expect_criterion("C22 verlet: speed after the work of a bridge, over the law",
                       rebound(law, v, gap, verlet(2.0e-5), 0.5, 20 * steps) / out, 0.99, 1.01);
      expect_criterion(
          "C22 respa: speed after the work of a bridge, over the law",
          rebound(law, v, gap, verlet(4.0e-4) + "run_style respa 2 20 pair 1\n", 0.5, steps) / out,
          0.99, 1.01);
      expect_criterion("C22 mts: speed after the work of a bridge, over the law",
                       rebound(law, v, gap, mts(20, 2.0e-5, "lookahead yes"), 0.5, steps) / out,
                       0.99, 1.01);
    }
  }
  const double v = std::sqrt(2.0 * lost / water.m) * 0.97;
  EXPECT_LT(rebound(elastic + water.words(), v, 0.011, verlet(2.0e-5), 0.5, 60000), 0.0)
      << "captured";
}

// Where films make the bridge before the solids touch, the cycle loses the work from there on only.
TEST(BridgeStyle, collision_of_films_loses_the_work_beyond_their_touch)
{
  Liquid water;
  water.l = 0.06;
  const std::string law = elastic + water.words() + "form film";
  const double lost = water.work(water.film_gap());
  EXPECT_LT(lost, 0.9 * water.work()) << "else the two would not differ";
  for (const double ratio : {1.05, 1.5}) {
    const double v = std::sqrt(2.0 * lost / water.m) * ratio;
    const double out = std::sqrt(v * v - 2.0 * lost / water.m);
    const int steps = static_cast<int>(1.0 / out / 4.0e-4);
    EXPECT_NEAR(rebound(law, v, 0.0513, verlet(2.0e-5), 0.5, 20 * steps) / out, 1.0, 0.01)
        << "verlet";
    EXPECT_NEAR(rebound(law, v, 0.0513, mts(20, 2.0e-5, "lookahead yes"), 0.5, steps) / out, 1.0,
                0.01)
        << "mts";
  }
  const double v = std::sqrt(2.0 * lost / water.m) * 0.97;
  EXPECT_LT(rebound(law, v, 0.0513, verlet(2.0e-5), 0.5, 60000), 0.0) << "captured";
}

// Davis and Ennis: viscosity captures up to a speed that grows with the logarithm of film thickness
// over least gap. The law here: in from the films' touch to h_min, out again to rupture.
TEST(BridgeStyle, capture_threshold_grows_with_the_logarithm)
{
  for (const double hmin : {0.04, 0.01}) {
    Liquid oil;
    oil.l = 0.06;
    oil.sigma = 1.0e-6;
    oil.theta = 0.0;
    oil.mu = 2.0;
    oil.hmin = hmin;
    const double film = 2.0 * 0.5 * (std::cbrt(1.0 + oil.l) - 1.0), least = hmin * oil.R;
    const double out = 1.3162277660 * oil.rupture();    // Ca is beyond the fit
    const double momentum = oil.viscous_momentum(least, film) + oil.viscous_momentum(least, out);
    // h_min to contact and the contact itself, as little as E makes it
    const double c = oil.k() / least * std::pow(oil.H(least), 2);
    const std::string stiff = "jkr 1.0e13 0.25 0.0 form film ";
    const double v = (momentum + 2.0 * c * least) / oil.m;
    const std::string sub = "fix nve all nve/sphere/mts collision auto safety 0.2\ntimestep " +
        digits(0.002 / v) + "\n";
    EXPECT_LT(rebound(stiff + oil.words(), 0.97 * v, film + 0.02, sub, out, 12000), 0.0) << hmin;
    const double faster = rebound(stiff + oil.words(), 1.05 * v, film + 0.02, sub, out, 12000);
    EXPECT_GT(faster, 0.02 * v) << hmin;
    EXPECT_LT(faster, 0.08 * v) << hmin;
  }
}

// the same scene in other units of length, mass and time
TEST(BridgeStyle, units_do_not_matter)
{
  auto speed_after = [](const std::string &units, double length, double mass, double time) {
    const double stress = mass / (length * time * time);
    auto in = [](double value, double unit) {
      return " " + digits(value / unit);
    };
    Simulation sim;
    const double d = 2.0e-6;
    sim.run("units " + units +
            "\natom_style sphere\natom_modify map array\ncomm_modify vel yes\nregion box block" +
            in(0, length) + in(8 * d, length) + in(0, length) + in(8 * d, length) + in(0, length) +
            in(8 * d, length) + "\ncreate_box 1 box\ncreate_atoms 1 single" + in(3 * d, length) +
            in(4 * d, length) + in(4 * d, length) + "\ncreate_atoms 1 single" +
            in(4.005 * d, length) + in(4.1 * d, length) + in(4 * d, length) +
            "\nset group all diameter" + in(d, length) + " density" +
            in(2000.0, mass / (length * length * length)) + "\nset atom 1 vx" +
            in(2.0, length / time) + "\nneighbor" + in(0.5 * d, length) + " bin\ntimestep" +
            in(1.0e-11, time) + "\npair_style granular/adhesive\npair_coeff * * jkr" +
            in(1.0e9, stress) + " 0.3" + in(0.01, mass / (time * time)) + " bridge 0.02" +
            in(0.07, mass / (time * time)) + " 10" + in(1.0e-3, stress * time) +
            " capillary willett tangential yes form film sliding 0.3\nfix nve all nve/sphere\n"
            "run 20000");
    return std::vector<double>{sim.value("vx[1]") * length / time,
                               sim.value("vy[2]") * length / time};
  };
  const auto si = speed_after("si", 1.0, 1.0, 1.0);
  const auto micro = speed_after("micro", 1.0e-6, 1.0e-15, 1.0e-6);
  const auto lj = speed_after("lj", 2.0e-6, 1.6e-14, 1.0e-7);
  EXPECT_GT(std::fabs(si[0] - 2.0), 0.1);
  for (int c = 0; c < 2; c++) {
    EXPECT_NEAR(micro[c] / si[c], 1.0, 1e-7);
    EXPECT_NEAR(lj[c] / si[c], 1.0, 1e-7);
  }
}

TEST(BridgeStyle, parts_are_told_by_pair_local_and_compute_pair)
{
  Liquid water;
  water.mu = 0.5;
  Simulation sim;
  Scene scene;
  scene.style = granular(elastic + water.words() + "tangential yes");
  build(sim, {{3.0, 4.0, 4.0}, {3.9999, 4.0, 4.0}}, scene);
  sim.run("run 0\nset atom 2 x 4.05\nset atom 2 vx 0.3 vy 0.2\ntimestep 1.0e-9\n"
          "compute l all pair/local dist force eng p12 p13 p14 p15 p16 p17\n"
          "compute n all reduce sum c_l[1] c_l[2] c_l[3] c_l[4] c_l[5] c_l[6] c_l[7] c_l[8] c_l[9] "
          "inputs local\ncompute e all pair granular/adhesive\n"
          "thermo_style custom step c_n[1] c_e c_e[5]\nrun 0");
  const double h = 0.05, resistance = water.k() * std::pow(water.H(h), 2) / h;
  EXPECT_NEAR(sim.value("c_n[4]") / water.pull(h), 1.0, 1e-10) << "capillary";
  EXPECT_NEAR(sim.value("c_n[5]") / (-0.3 * resistance), 1.0, 1e-6) << "viscous, attracts";
  const double slip = 6.0 * pi * water.mu * water.R * (8.0 / 15.0 * std::log(water.R / h) + 0.9588);
  EXPECT_NEAR(std::fabs(sim.value("c_n[7]")) / (0.2 * slip), 1.0, 1e-6) << "tangential";
  EXPECT_NEAR(sim.value("c_n[9]") / water.V(), 1.0, 1e-12);
  EXPECT_NEAR(sim.value("c_n[2]") / -(water.pull(h) + 0.3 * resistance), 1.0, 1e-6);
  const double energy = -Liquid::integral(h, water.rupture(), [&](double x) {
    return water.pull(x);
  });
  EXPECT_NEAR(sim.value("c_e[5]") / energy, 1.0, 1e-5);
  EXPECT_NEAR(sim.value("c_n[3]") / energy, 1.0, 1e-5);
}

}    // namespace
