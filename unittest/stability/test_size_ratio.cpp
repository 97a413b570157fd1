// Spheres 100 and 1000 times as large as others, C8 of the list of hard cases, under velocity
// Verlet, stock r-RESPA and fix nve/sphere/mts: contacts with a wall in all but the radius.

#include "integrators.h"

namespace {

// C8: a small sphere and one 100 and 1000 times as large. e of a wall with R = r/(1 + 1/ratio); an
// oblique impact with friction keeps the angular momentum.
TEST(SizeRatio, impacts_are_those_on_a_wall)
{
  for (const double ratio : {100.0, 1000.0})
    for (const auto &integrator : integrators)
      for (const bool oblique : {false, true}) {
        const double d = 1.0 / ratio, m = pi / 6.0 * d * d * d / (1.0 + d * d * d);
        const JkrCurve small{0.5 * d / (1.0 + d), 1e4, 1.0 * d};
        const Scale unit(small, m);
        const double V = 2.0 * unit.V_s, gap = V * 2.0 * unit.T;
        Scene scene;
        scene.box = "-4 4 -4 4 -4 4";    // places near 0 are rounded less, and so are arms
        scene.style = pair_of(" jkr " + digits(2e4 * (1.0 - 0.0625)) + " 0.25 " + digits(1.0 * d) +
                              (oblique ? " sliding 0.3" : ""));
        Simulation sim;
        build(sim, {{0.0, 0.0, 0.0}, {0.5 * (1.0 + d) + gap, 0.0, 0.0, d}}, scene);
        set_motion(sim, 2, {-V, oblique ? 0.7 * V : 0.0, 0.0}, {0.0, 0.0, 0.0});
        auto angular = [&] {    // about the middle of the large one at the start, of all
          const auto x = gather(sim, "x"), v = gather(sim, "v"), w = gather(sim, "omega");
          const double mass[] = {pi / 6.0, pi / 6.0 * d * d * d}, size[] = {1.0, d};
          double L = 0.0;
          for (int n : {0, 1})
            L += mass[n] * (x[3 * n] * v[3 * n + 1] - x[3 * n + 1] * v[3 * n]) +
                0.1 * mass[n] * size[n] * size[n] * w[3 * n + 2];
          return L;
        };
        sim.run("neighbor " + digits(20.0 * gap) + " bin\n" + integrator.commands(0.02 * unit.T) +
                "run 0");
        const double L = angular();
        sim.run(integrator.run(1500));
        const auto v = gather(sim, "v");
        if (oblique) {
          EXPECT_GT(std::fabs(gather(sim, "omega")[5]) * d / V, 0.1);
          expect_criterion(
              integrator.of("C8 *: angular momentum lost at a size ratio of 100, 1000"),
              std::fabs(angular() - L) / (0.5 * pi / 6.0 * d * d * d * V), 0.0, 1e-12);
        } else {
          expect_criterion(
              integrator.of("C8 *: e at a size ratio of 100, 1000 over that of a wall"),
              (v[3] - v[0]) / V / std::sqrt(0.75), 0.999, 1.001);
        }
      }
}

// The last sphere, held at overlaps with what touches it at x
struct Held {
  double force;         // at the overlap that is asked for, > 0 repels
  double rest;          // the overlap without force
  double radius, a0;    // of the contact, at these; of a pair only

  Held(const Integrator &integrator, const std::vector<Sphere> &others, double diameter, double x,
       double overlap, const std::string &law, const std::string &wall)
  {
    Simulation sim;
    Scene scene;
    scene.box = "-4 4 -4 4 -4 4";
    scene.boundary = "f f f";
    scene.style = pair_of(law) + wall;
    auto spheres = others;
    spheres.push_back({x, 0.0, 0.0, diameter});
    build(sim, spheres, scene);
    sim.run("compute a all pair/local p2\ncompute most all reduce max c_a inputs local\n"
            "thermo_style custom step c_most\n" +
            integrator.commands(1e-9));
    const std::string id = std::to_string(spheres.size());
    auto force_at = [&](double depth) {
      sim.run("set atom " + id + " x " + digits(x + 0.5 * diameter - depth) + "\nrun 0 post no");
      return sim.value("fx[" + id + "]");
    };
    force = force_at(overlap);
    radius = sim.value("c_most");
    double low = 0.0, high = 0.05 * diameter;
    for (int n = 0; n < 50; n++) {
      rest = 0.5 * (low + high);
      (force_at(rest) < 0.0 ? low : high) = rest;
    }
    a0 = sim.value("c_most");
  }
};

// A large and a small sphere against a wall that holds a sphere of the radius r/(1 + 1/ratio).
// A wall does not tell its contact radius: JKR's is a0^2 = 3 R (overlap at rest).
TEST(SizeRatio, is_a_wall)
{
  for (const double ratio : {100.0, 1000.0})
    for (const auto &integrator : integrators) {
      const double d = 1.0 / ratio, like = d / (1.0 + d), R = 0.5 * like, overlap = 0.005 * d;
      const std::string law = " jkr 1.0e9 0.25 100.0", sizes = " at a size ratio of 100, 1000";
      const Held pair(integrator, {{0.0, 0.0, 0.0}}, d, 0.5, overlap, law, ""),
          wall(integrator, {}, like, 0.0, overlap, law,
               "fix wall all wall/levelset plane x 0 NULL" + law);
      expect_criterion(integrator.of("C8 *: force" + sizes + " over that of fix wall/levelset"),
                       pair.force / wall.force, 0.999, 1.001);
      expect_criterion(
          integrator.of("C8 *: overlap at rest" + sizes + " over that of fix wall/levelset"),
          pair.rest / wall.rest, 0.999, 1.001);
      expect_criterion(
          integrator.of("C8 *: contact radius at rest" + sizes + " over that of fix wall/levelset"),
          pair.a0 / std::sqrt(3.0 * R * wall.rest), 0.999, 1.001);
      const JkrCurve curve{R, 1e3 * Material().E_eff(), 100.0};
      expect_criterion(
          integrator.of("C8 *: contact radius at rest" + sizes + " over (9 pi gamma R^2/E)^(1/3)"),
          pair.a0 / curve.a0(), 0.999, 1.001);
      expect_criterion(
          integrator.of("C8 *: contact radius at an overlap" + sizes + " over that of the law"),
          pair.radius / curve.a(overlap), 0.999, 1.001);
    }
}

// The scene of arXiv:2410.14798: a sphere of 10 um sits in a wedge of 10 degrees between two frozen
// ones, `ratio` times as large, and is shaken across it below the friction limit: it must stay.
// Returns how far it creeps [r].
double creep(const Integrator &integrator, double ratio)
{
  const double r = 1e-5, R = ratio * r, D = R + r - 2e-8, angle = 5.0 * pi / 180.0;
  const std::string x = digits(-D * std::sin(angle)), y = digits(D * std::cos(angle));
  const std::string box = digits(-3.0 * D) + " " + digits(3.0 * D) + " ";
  Simulation sim;
  sim.run("units si\natom_style sphere\natom_modify map array sort 0 0\ncomm_modify vel yes\n"
          "boundary f f f\nneighbor 1e-6 bin\nneigh_modify exclude type 2 2\nregion b block " +
          box + box + box + "\ncreate_box 2 b\ncreate_atoms 1 single 0 0 0\n" +
          "create_atoms 2 single " + x + " " + y + " 0\ncreate_atoms 2 single " + x + " -" + y +
          " 0\nset type 1 diameter 2e-5 density 2600\nset type 2 diameter " + digits(2.0 * R) +
          " density 2600\ngroup big type 2\ngroup small type 1\npair_style granular/adhesive\n"
          "pair_coeff * * jkr 1e7 0.3 0 damping tsuji 0.3 sliding 0.5 twisting yes\n"
          "fix hold big freeze\nvariable k equal 2e-8*sin(step*dt*2e5)\n"
          "fix shake small addforce 0 v_k 0\n" +
          integrator.commands(1e-8) + integrator.run(20000));
  const double before = sim.value("x[1]");
  sim.run(integrator.run(40000));
  return (sim.value("x[1]") - before) / r;
}

TEST(SizeRatio, static_friction_holds_a_small_particle)
{
  for (const double ratio : {1.0, 3.0, 10.0, 100.0, 1000.0})
    for (const auto &integrator : integrators)
      expect_criterion(integrator.of("C8 *: creep of a small sphere between two large ones, of r"),
                       std::fabs(creep(integrator, ratio)), 0.0, 1e-4);
}

}    // namespace
