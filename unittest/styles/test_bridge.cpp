// Liquid bridges through LAMMPS: collisions, hysteresis, capture, rebuilds, ranks, restart, and the
// liquid that particles own.

#include "criterion.h"
#include "scenes.h"

#include <functional>

namespace {

const std::string elastic = "jkr 1.0e7 0.25 0.0 ";

std::string granular(const std::string &law)
{
  return "pair_style granular/adhesive\npair_coeff * *" + std::string(" ") + law + "\n";
}

// Bridge of two equal spheres of diameter and density 1, computed here from the report's formulas.
struct Liquid {
  double l = 0.01, sigma = 50.0, theta = 20.0, mu = 0.0, hmin = 1.0e-3;
  double R = 0.25, m = pi / 12.0;

  std::string words() const
  {
    return "bridge " + digits(l) + " " + digits(sigma) + " " + digits(theta) + " " + digits(mu) +
        " " + digits(hmin) + " ";
  }
  double V() const { return l * pi / 6.0; }
  double angle() const { return theta * pi / 180.0; }
  double H(double h) const
  {
    h = std::max(h, hmin * R);
    return 1.0 - 1.0 / std::sqrt(1.0 + V() / (pi * R * h * h));
  }
  double pull(double h) const { return 4.0 * pi * R * sigma * std::cos(angle()) * H(h); }
  double rupture(double Ca = 0.0) const
  {
    return (1.0 + 0.5 * angle()) * (1.0 + std::sqrt(Ca)) * std::cbrt(V());
  }
  double k() const { return 6.0 * pi * mu * R * R; }
  // of f over [a, b], a > 0
  static double integral(double a, double b, const std::function<double(double)> &f)
  {
    const int n = 20000;
    double sum = 0.0;
    for (int q = 0; q < n; q++) {
      const double h0 = a * std::pow(b / a, double(q) / n);
      const double h1 = a * std::pow(b / a, double(q + 1) / n);
      sum += (h1 - h0) * f(std::sqrt(h0 * h1));
    }
    return sum;
  }
  double work() const    // from contact to rupture at rest
  {
    const double h = hmin * R;
    return h * pull(0.0) + integral(h, rupture(), [this](double x) {
             return pull(x);
           });
  }
  double viscous_momentum(double from, double to) const
  {
    return k() * integral(from, to, [this](double x) {
             return H(x) * H(x) / x;
           });
  }
};

// Head-on collision at the speed v; returns the speed of separation, < 0 while they are bound.
double rebound(const std::string &law, double v, double gap, const std::string &integrate,
               double reach, int steps)
{
  Simulation sim;
  Scene scene;
  scene.style = granular(law);
  build(sim, {{4.0 - 0.5 * (1.0 + gap), 4.0, 4.0}, {4.0 + 0.5 * (1.0 + gap), 4.0, 4.0}}, scene);
  set_motion(sim, 1, {0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  set_motion(sim, 2, {-0.5 * v, 0.0, 0.0}, {0.0, 0.0, 0.0});
  sim.run("neighbor 1.0 bin\n" + integrate + "run " + std::to_string(steps));
  if (sim.value("x[2]-x[1]") < 1.0 + reach) return -1.0;
  return sim.value("vx[2]-vx[1]");
}

std::string verlet(double step)
{
  return "fix nve all nve/sphere\ntimestep " + digits(step) + "\n";
}

// column of compute b for an atom that this rank owns
double of_atom(Simulation &sim, int id, int column)
{
  auto **rows = static_cast<double **>(
      lammps_extract_compute(sim.lammps(), "b", LMP_STYLE_ATOM, LMP_TYPE_ARRAY));
  return rows[sim.lammps()->atom->map(id)][column - 1];
}

TEST(BridgeStyle, force_and_rupture_on_a_pair_that_is_pulled)
{
  Liquid water;
  water.mu = 0.7;
  for (const bool wall : {false, true}) {
    Simulation sim;
    Scene scene;
    water.R = wall ? 0.5 : 0.25;
    scene.boundary = "f p p";
    scene.style = granular(elastic + (wall ? "" : water.words()));
    if (wall)
      scene.style += "fix w all wall/levelset plane x 0 NULL " + elastic + water.words() + "\n";
    // a pair at x = 4, or the sphere alone at the wall
    std::vector<Sphere> spheres = {{wall ? 0.4999 : 4.9999, 4.0, 4.0}, {4.0, 4.0, 4.0}};
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

// ---- ranks, rebuilds, restart

const std::string sticky = "jkr 1.0e6 0.25 20.0 damping alpha 0.3 sliding 0.3 rolling 0.02 "
                           "bridge 0.02 40.0 10 0.3 0.01 tangential yes ";

// a lump of wet spheres, some touching, some bridged, some apart, and a bullet
const std::vector<Sphere> lump = {{0.0, 0.0, 0.0},    {0.995, 0.0, 0.0}, {0.49, 0.86, 0.0},
                                  {0.49, 0.29, 0.81}, {-0.7, -0.7, 0.0}, {2.1, 0.7, 0.3, 0.5}};

struct Trip {
  std::string law = sticky, integrate, commands, newton = "on", processors = "* * *";
  std::vector<double> from = {4.0, 4.0, 4.0}, v = {0.0, 0.0, 0.0};
  int steps = 100;
  bool restart = false;
};

State travelled(const Trip &trip)
{
  auto spheres = lump;
  for (auto &sphere : spheres) {
    sphere.x = snap(sphere.x) + trip.from[0];
    sphere.y = snap(sphere.y) + trip.from[1];
    sphere.z = snap(sphere.z) + trip.from[2];
  }
  Scene scene;
  scene.newton = trip.newton;
  scene.processors = trip.processors;
  scene.style = granular(trip.law);
  const int n = static_cast<int>(lump.size());
  const std::string rest = "neighbor 0.6 bin\n" + trip.commands + trip.integrate;
  const std::string file = scratch_file("lump.restart");
  State state;
  {
    Simulation sim;
    build(sim, spheres, scene);
    for (int a = 0; a < n; a++) {
      const double s = a == n - 1 ? -25.0 : 2.0 * (a % 3) - 1.0;
      set_motion(sim, a + 1, {trip.v[0] + s, trip.v[1] - 0.7 * s, trip.v[2] + 0.3 * s},
                 {2.0 - a, 0.5 * a, 1.0});
    }
    sim.run(rest + "run " + std::to_string(trip.restart ? trip.steps / 2 : trip.steps));
    if (trip.restart) sim.run("write_restart " + file);
    state = state_of(sim);
  }
  if (trip.restart) {
    Simulation sim;
    sim.run("newton " + trip.newton + "\nprocessors " + trip.processors +
            "\natom_modify map array\nread_restart " + file + "\ncomm_modify vel yes\n" + rest +
            "run " + std::to_string(trip.steps - trip.steps / 2));
    std::remove(file.c_str());
    state = state_of(sim);
  }
  for (int a = n - 1; a >= 0; a--)
    for (int c = 0; c < 3; c++) {
      const double d = state.x[3 * a + c] - state.x[c];
      state.x[3 * a + c] = d - 8.0 * std::round(d / 8.0);
      state.v[3 * a + c] -= trip.v[c];
    }
  return state;
}

const State &reference()
{
  Trip trip;
  trip.integrate = verlet(dt);
  trip.steps = 1600;
  static const State state = travelled(trip);
  return state;
}

TEST(RanksBridge, lump_is_the_same_under_mts_and_on_all_ranks)
{
  for (const std::string newton : {"on", "off"})
    for (const std::vector<double> &from :
         std::vector<std::vector<double>>{{4.0, 4.0, 4.0}, {7.875, 7.75, 0.125}}) {
      Trip trip;
      trip.newton = newton;
      trip.from = from;
      trip.integrate = mts(16);
      SCOPED_TRACE(newton + digits(from[0]));
      expect_same(travelled(trip), reference(), 1e-9);
    }
}

TEST(RanksBridge, lump_travels_with_rebuilds_at_every_step)
{
  const std::string n = std::to_string(number_of_ranks());
  for (const std::string newton : {"on", "off"})
    for (const std::string &processors : {n + " 1 1", "1 1 " + n}) {
      Trip trip;
      trip.newton = newton;
      trip.processors = processors;
      trip.integrate = mts(16);
      trip.v = {48.0, -32.0, 64.0};
      trip.commands = "neigh_modify delay 0 every 1 check no\natom_modify sort 7 1.0\n";
      SCOPED_TRACE(newton + processors);
      expect_same(travelled(trip), reference(), 1e-7);
    }
}

TEST(RanksBridge, lump_under_respa_equals_verlet)
{
  Trip trip;
  trip.integrate = verlet(16.0 * dt) + "run_style respa 2 16 pair 1\n";
  expect_same(travelled(trip), reference(), 1e-9);
}

TEST(RanksBridge, restart_goes_on)
{
  for (const bool sub_steps : {false, true}) {
    Trip trip;
    trip.integrate = sub_steps ? mts(16) : verlet(dt);
    trip.steps = sub_steps ? 100 : 1600;
    trip.restart = true;
    expect_same(travelled(trip), reference(), 1e-9);
  }
}

// ---- liquid that particles own

// A dense suspension in shear between two walls: bridges form and rupture all the time.
std::string sheared(const std::string &liquid, const std::string &film, int side)
{
  const std::string law = "jkr 1.0e5 0.25 1.0 damping alpha 0.5 sliding 0.3 bridge 0.02 5.0 0 0.05 "
                          "0.01 " +
      liquid;
  const std::string n = std::to_string(side);
  return "units lj\natom_style sphere\natom_modify map array\ncomm_modify vel yes\n"
         "boundary p p f\nnewton on\nlattice sc 0.7\nregion box block 0 " +
      n + " 0 " + n + " 0 " + n +
      "\ncreate_box 1 box\ncreate_atoms 1 box\ndisplace_atoms all move 0 0 0.45 units lattice\n"
      "set group all diameter 1.0 density 1.0\nvelocity all create 30.0 4711 loop geom\n"
      "neighbor 0.4 bin\npair_style granular/adhesive\npair_coeff * * " +
      law + "\nvariable top equal zhi\nfix w all wall/levelset plane z 0 $(v_top) " + law + film +
      "\n";
}
const std::string shearing =
    "fix nve all nve/sphere\nfix s all addforce v_fx 0 0\ntimestep 0.0005\n";
const std::string measuring = "variable fx atom 20*(z-zhi/2)\ncompute agg all aggregate/contact\n"
                              "compute sum all reduce sum c_agg[6]\nthermo_style custom step c_sum "
                              "f_w[12]\nthermo 1000\n";

TEST(RanksBridge, liquid_is_conserved_in_shear_and_through_a_restart)
{
  struct {
    std::string split;
    double film;    // on the walls; -1: they give nothing
    int side = 5, steps = 300;
  } cases[] = {{"inventory 0.3", -1.0},
               {"inventory 0.3 origin", -1.0},
               {"inventory 1.0 form film", -1.0},
               {"inventory 0.3", 0.01},
               {"inventory 1.0 origin form film", 0.002},
               {"inventory 0.3", 0.01, 22, 60}};    // 10,648 particles
  for (const auto &[split, thickness, side, steps] : cases) {
    const std::string film = thickness < 0.0 ? "" : " film " + digits(thickness);
    const double area = 2.0 * std::pow(side * std::cbrt(1.0 / 0.7), 2);
    const double all = side * side * side * 0.02 * pi / 6.0 + std::max(0.0, thickness) * area;
    const std::string file = scratch_file("liquid.restart");
    double bridges = 0.0, before = 0.0;
    {
      Simulation sim;
      sim.run(sheared(split, film, side) + measuring + shearing + "run " + std::to_string(steps) +
              "\nwrite_restart " + file);
      before = sim.value("c_sum + f_w[12]");
      sim.run("compute bonds all reduce sum c_agg[5]\nrun 0 post no");
      bridges = sim.value("c_bonds");
      EXPECT_GT(bridges, 30.0);
      EXPECT_NEAR(before / all, 1.0, 1e-12);
    }
    Simulation sim;
    sim.run("atom_modify map array\nread_restart " + file +
            "\ncomm_modify vel yes\nneighbor 0.4 bin\n"
            "variable top equal zhi\nfix w all wall/levelset plane z 0 $(v_top) jkr 1.0e5 0.25 1.0 "
            "damping alpha 0.5 sliding 0.3 bridge 0.02 5.0 0 0.05 0.01 " +
            split + film + "\n" + measuring + shearing +
            "compute bonds all reduce sum c_agg[5]\nrun 0 post no");
    EXPECT_EQ(sim.value("c_bonds"), bridges);
    sim.run("run " + std::to_string(steps));
    expect_criterion("C22 verlet: change of all liquid",
                     sim.value("c_sum + f_w[12]") / before - 1.0, -1e-12, 1e-12);
    sim.run("compute least all reduce min c_agg[6]\nrun 0 post no");
    EXPECT_GE(sim.value("c_least"), 0.0);
    std::remove(file.c_str());
  }
}

// A bridge takes a share of both; at rupture each gets half.
TEST(BridgeStyle, liquid_moves_from_the_wet_to_the_dry)
{
  Liquid water;
  for (const bool even : {true, false}) {
    Simulation sim;
    Scene scene;
    scene.types = 2;
    scene.type = {1, 2};
    Liquid less = water;
    less.l = 0.001;
    const std::string rest = std::string("inventory 0.5 ") + (even ? "even" : "origin") + "\n";
    scene.style = "pair_style granular/adhesive\npair_coeff 1 1 " + elastic + water.words() + rest +
        "pair_coeff 2 2 " + elastic + less.words() + rest + "pair_coeff 1 2 " + elastic +
        water.words() + rest;
    build(sim, {{3.0, 4.0, 4.0}, {3.9999, 4.0, 4.0}}, scene);
    sim.run("compute b all aggregate/contact\nrun 0");
    const double a = 0.01 * pi / 6.0, b = 0.001 * pi / 6.0;
    EXPECT_NEAR(of_atom(sim, 1, 6) / a, 1.0, 1e-12);
    Liquid both = water;
    both.l = 0.5 * (0.01 + 0.001);
    sim.run("set atom 2 x 4.05\nrun 0");
    EXPECT_NEAR(sim.value("fx[1]") / both.pull(0.05), 1.0, 1e-10);
    sim.run("set atom 2 x 4.5\nrun 0\nrun 1");
    EXPECT_EQ(of_atom(sim, 1, 5), 0.0);
    EXPECT_NEAR(of_atom(sim, 1, 6) / (even ? 0.5 * a + 0.25 * (a + b) : a), 1.0, 1e-12);
    EXPECT_NEAR(of_atom(sim, 2, 6) / (even ? 0.5 * b + 0.25 * (a + b) : b), 1.0, 1e-12);
  }
}

// A wall with a film gives the share of what lies under the particle, pi r^2 of it.
TEST(BridgeStyle, film_of_a_wall_gives_and_takes)
{
  const Liquid water;
  const double f = 0.5, thickness = 0.01, own = water.l * pi / 6.0;
  const double given = f * thickness * pi * 0.25, taken = f * own, wall = thickness * 64.0;
  for (const bool even : {true, false}) {
    Simulation sim;
    Scene scene;
    scene.boundary = "f p p";
    const std::string law = elastic + water.words() + "inventory 0.5 " + (even ? "even" : "origin");
    scene.style = granular(law) + "fix w all wall/levelset plane x 0 NULL " + law + " film 0.01\n";
    build(sim, {{0.4999, 4.0, 4.0}, {4.0, 6.0, 4.0}}, scene);
    sim.run("timestep 1.0e-13\ncompute b all aggregate/contact\nrun 0");
    EXPECT_NEAR(sim.value("f_w[11]") / (given + taken), 1.0, 1e-12) << "in the bridge";
    EXPECT_NEAR(sim.value("f_w[12]") / wall, 1.0, 1e-12);
    EXPECT_NEAR(sim.value("f_w[1][16]") / (wall - given), 1.0, 1e-12) << "on the zone";
    EXPECT_NEAR(of_atom(sim, 1, 6) / own, 1.0, 1e-12);
    sim.run("set atom 1 x 1.5\nrun 0 post no\nrun 1 post no");
    const double back = even ? 0.5 * (given + taken) : given;
    EXPECT_EQ(sim.value("f_w[10]"), 0.0);
    EXPECT_NEAR(sim.value("f_w[12]") / (wall - given + back), 1.0, 1e-12);
    EXPECT_NEAR(of_atom(sim, 1, 6) / (own - taken + (given + taken - back)), 1.0, 1e-12);
    EXPECT_GT(std::fabs(taken - given), 0.1 * given) << "else a swap would not show";
  }
  Simulation sim;
  Scene scene;
  scene.boundary = "f p p";
  build(sim, {{2.0, 4.0, 4.0}}, scene);
  const std::string fix = "fix v all wall/levelset plane x 0 NULL " + elastic + water.words();
  EXPECT_NE(sim.error_of(fix + "film 0.01").find("needs a law with keyword inventory"),
            std::string::npos);
  EXPECT_NE(sim.error_of(fix + "inventory 0.5 film -1").find("must be >= 0, got -1"),
            std::string::npos);
}

// film 0 gives back what the wall has got; a film that begins after a restart comes on top of it.
TEST(BridgeStyle, film_begins_dry_or_after_a_restart)
{
  const Liquid water;
  const std::string file = scratch_file("film.restart");
  const std::string law = elastic + water.words() + "inventory 0.5 even";
  const std::string wall = "fix w all wall/levelset plane x 0 NULL " + law;
  const double own = water.l * pi / 6.0, got = 0.25 * own;
  for (const bool film : {false, true}) {
    Simulation sim;
    Scene scene;
    scene.boundary = "f p p";
    scene.style = granular(law) + wall + (film ? " film 0\n" : "\n");
    build(sim, {{0.4999, 4.0, 4.0}}, scene);
    sim.run("timestep 1.0e-13\nrun 0\nset atom 1 x 1.5\nrun 0 post no\nrun 1 post no");
    EXPECT_NEAR(sim.value("f_w[12]") / got, 1.0, 1e-12);
    if (!film) sim.run("write_restart " + file);
    sim.run("set atom 1 x 0.4999\nrun 0 post no");
    const double given = film ? 0.5 * got / 64.0 * pi * 0.25 : 0.0;
    EXPECT_NEAR(sim.value("f_w[11]") / (0.5 * (own - got) + given), 1.0, 1e-12);
    EXPECT_NEAR(sim.value("f_w[1][16]") / (got - given), 1.0, 1e-12);
  }
  Simulation sim;
  sim.run("atom_modify map array\nread_restart " + file + "\ncomm_modify vel yes\n" + wall +
          " film 0.01\nrun 0");
  EXPECT_NEAR(sim.value("f_w[12]") / (got + 0.64), 1.0, 1e-12);
  std::remove(file.c_str());
}

}    // namespace
