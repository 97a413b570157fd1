// C24 of the list of hard cases, fluid that has no slip, no vorticity or ends, under velocity
// Verlet, stock r-RESPA and fix nve/sphere/mts.

#include "integrators.h"
#include "temporary_file.h"

#include <algorithm>

namespace {

// Lift is 0 where nothing slips or nothing turns, and all forces are numbers: v = u in shear, slip
// in a uniform fluid, and neither. Where the sphere leads in shear it is Saffman's.
TEST(Cases, degenerate_fluid_gives_no_lift)
{
  const double G = 0.5, viscosity = 0.3, density = 0.2;
  const std::string shear = "shear x y " + digits(G) + " 2.0", at_rest = "uniform 1 0 0";
  struct Trial {
    std::string field, drag;
    double v;    // u = 1
    double lift;
  };
  // -1.615 rho_f d^2 sqrt(nu / |om|) (v - u) x om, om = -G e_z
  const double saffman = -1.615 * density * std::sqrt(viscosity / density / G) * 0.5 * G;
  std::vector<Trial> trials;
  for (const std::string drag : {"stokes", "schiller", "difelice concentration 0.5"})
    for (const auto &[field, v, lift] : {std::tuple{shear, 1.0, 0.0},
                                         {at_rest, 1.5, 0.0},
                                         {at_rest, 1.0, 0.0},
                                         {shear, 1.5, saffman}})
      trials.push_back({field, drag, v, lift});
  for (const auto &integrator : integrators)
    for (const auto &[field, drag, v, lift] : trials) {
      Simulation sim;
      build(sim, {{4.0, 4.0, 4.0}});
      set_motion(sim, 1, {v, 0.0, 0.0}, {0.0, 0.0, 0.0});
      sim.run("neighbor 1.0 bin\nfix air all flow/field " + field + " density " + digits(density) +
              " viscosity " + digits(viscosity) + "\nfix drag all flow/force air drag " + drag +
              " torque yes lift saffman magnus yes\n" +
              integrator.commands(lift != 0.0 ? 1e-6 : 1e-3) + "run 0");
      if (lift != 0.0) {
        EXPECT_NEAR(sim.value("f_drag[8]") / lift, 1.0, 1e-3);
        continue;
      }
      double most = 0.0, other = 0.0;
      for (int n = 0; n < 20; n++) {
        sim.run(integrator.run(10));
        most = std::max(
            most,
            std::hypot(sim.value("f_drag[7]"), sim.value("f_drag[8]"), sim.value("f_drag[9]")));
        for (const auto &array : {gather(sim, "f"), gather(sim, "torque"), gather(sim, "v")})
          for (const double value : array)
            if (!std::isfinite(value)) other += 1.0;
      }
      expect_criterion(integrator.of("C24 *: largest lift without slip or without vorticity"), most,
                       0.0, 0.0);
      expect_criterion(integrator.of("C24 *: forces, torques and speeds there that are not finite"),
                       other, 0.0, 0.0);
    }
}

// A sphere flies out of the grid of its fluid: an error, in the step in which it is seen outside
TEST(Cases, degenerate_fluid_ends_at_its_grid)
{
  const TemporaryFile file("apf_end");
  file.write({3, 3, 3}, {0, 0, 0}, {4, 4, 2.5}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, [](const double *, double, double *u) {
      u[2] = 1.0;
    });
  });
  for (const auto &integrator : integrators)
    for (const bool clamped : {false, true}) {
      Simulation sim;
      Scene scene;
      scene.boundary = "p p s";
      build(sim, {{4.0, 4.0, 1.0}, {4.0, 4.0, 4.9704}}, scene);
      set_motion(sim, 2, {0.0, 0.0, 1.0}, {0.0, 0.0, 0.0});
      const double step = 1e-3;
      const std::string error =
          sim.error_of("neighbor 1.0 bin\nfix air all flow/field file " + file.path +
                       (clamped ? " outside clamp" : "") + " density 1e-3 viscosity 1\n" +
                       "fix drag all flow/force air drag stokes\n" + integrator.commands(step) +
                       integrator.run(100));
      if (clamped) {
        EXPECT_EQ(error, "");
        continue;
      }
      for (const std::string word :
           {"Fix flow/field air: atom 2 at (4", "is outside the grid", "z = 0 to 5"})
        EXPECT_NE(error.find(word), std::string::npos) << word << " not in " << error;
      expect_criterion(integrator.of("C24 *: way out of the grid at which a run ends, of a step's"),
                       (sim.lammps()->atom->x[1][2] - 5.0) / (integrator.inner * step), 0.0, 1.0);
    }
}

}    // namespace
