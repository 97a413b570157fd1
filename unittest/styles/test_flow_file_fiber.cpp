// Collection by a fiber in a flow from a file: which particles that come along hit it. Facts: the
// same in Kuwabara's flow itself, by Runge and Kutta's method or along its streamlines.

#include "scenes.h"
#include "temporary_file.h"

namespace {

// the fiber has radius 1, solid fraction alpha, mean velocity 1 along x
// S. Kuwabara, J. Phys. Soc. Japan 14, 527 (1959), doi:10.1143/JPSJ.14.527
constexpr double alpha = pi / 64.0;
const double Ku = -0.5 * std::log(alpha) - 0.75 + alpha - 0.25 * alpha * alpha;

void kuwabara(const double *x, double, double *u)
{
  const double r2 = x[0] * x[0] + x[1] * x[1];
  if (r2 < 1.0) return;
  const double f = std::log(r2) - 1.0 + alpha + (1.0 - 0.5 * alpha) / r2 - 0.5 * alpha * r2;
  const double f_r = 2.0 / r2 - 2.0 * (1.0 - 0.5 * alpha) / (r2 * r2) - alpha;
  u[0] = 0.5 / Ku * (f + x[1] * x[1] * f_r);
  u[1] = -0.5 / Ku * x[0] * x[1] * f_r;
}

constexpr double start = -4.0, interception = 0.05, touch = 1.0 + interception;

// stream function of that flow over y
double stream(double r2)
{
  return 0.5 / Ku * (std::log(r2) - 1.0 + alpha + (1.0 - 0.5 * alpha) / r2 - 0.5 * alpha * r2);
}

// smallest distance from the axis of a particle that starts at height y with the fluid's velocity,
// by Runge and Kutta's method of fourth order
double nearest(double y, double St)
{
  double s[4] = {start, y, 0.0, 0.0}, nearest = 10.0;
  kuwabara(s, 0.0, s + 2);
  const auto rate = [St](const double *a, double *d) {
    double u[3] = {};
    kuwabara(a, 0.0, u);
    for (int c = 0; c < 2; c++) {
      d[c] = a[2 + c];
      d[2 + c] = (u[c] - a[2 + c]) / St;
    }
  };
  const double h = 0.004;
  while (s[0] < 1.0) {
    double k[4][4], at[4];
    rate(s, k[0]);
    for (int m = 1; m < 4; m++) {
      for (int c = 0; c < 4; c++) at[c] = s[c] + (m < 3 ? 0.5 : 1.0) * h * k[m - 1][c];
      rate(at, k[m]);
    }
    for (int c = 0; c < 4; c++) s[c] += h / 6.0 * (k[0][c] + 2.0 * (k[1][c] + k[2][c]) + k[3][c]);
    nearest = std::min(nearest, std::hypot(s[0], s[1]));
    if (nearest < touch) break;
  }
  return nearest;
}

// height from which the fiber is just touched; without inertia on the streamline through (0, touch)
double limit(double St)
{
  double low = 0.0, high = 2.0;
  for (int n = 0; n < 40; n++) {
    const double y = 0.5 * (low + high);
    const bool touches = St > 0.0
        ? nearest(y, St) < touch
        : y * stream(start * start + y * y) < touch * stream(touch * touch);
    (touches ? low : high) = y;
  }
  return low;
}

// the same through LAMMPS in a gridded field, from a row of particles around the exact height
double gridded_limit(double St, double exact, double spacing)
{
  const TemporaryFile file("apf_fiber");
  const int nx = static_cast<int>(std::ceil(4.8 / spacing)) + 1;
  const int ny = static_cast<int>(std::ceil(1.9 / spacing)) + 1;
  file.write({nx, ny, 1}, {-4.23, -0.37, 0}, {spacing, spacing, 1}, [](VtkhdfWriter &w) {
    w.field("velocity", 3, kuwabara);
    w.field("distance", 1, [](const double *x, double, double *s) {
      s[0] = std::hypot(x[0], x[1]) - 1.0;
    });
  });
  Simulation sim;
  sim.run("units lj\ndimension 2\natom_style sphere\natom_modify map array\n"
          "region box block -4.2 0.5 -0.3 1.5 -0.5 0.5\nboundary f f p\ncreate_box 1 box\n");
  constexpr int n = 21;
  const auto height = [=](double k) {
    return exact * (0.96 + 0.014 * k);
  };
  for (int k = 0; k < n; k++) {
    const double x[3] = {start, height(k), 0.0};
    double u[3] = {};
    kuwabara(x, 0.0, u);
    std::ostringstream text;
    text.precision(17);
    text << "create_atoms 1 single " << start << " " << height(k) << " 0\nset atom " << k + 1
         << " vx " << u[0] << " vy " << u[1] << "\n";
    sim.run(text.str());
  }
  std::ostringstream fluid;
  fluid.precision(17);
  fluid << " density 1e-3 viscosity " << 0.01 / (18.0 * std::max(St, 1e-6)) << "\ntimestep "
        << (St > 0.0 ? 0.01 : 0.002);
  sim.run("set type 1 diameter 0.1 density 1.0\npair_style zero 0.3 nocoeff\npair_coeff * *\n"
          "fix move all nve/sphere\nfix flat all enforce2d\nthermo_modify lost ignore\n"
          "fix flow all flow/field file " +
          file.path + " outside clamp" + fluid.str() +
          "\nfix drag all flow/force flow drag stokes\nrun 0\n");
  std::vector<double> closest(n, 10.0);
  const auto *atom = sim.lammps()->atom;
  for (bool upstream = true; upstream;) {
    sim.run("run 1 pre no post no\n");
    upstream = false;
    for (int i = 0; i < atom->nlocal; i++) {
      auto &r = closest[atom->tag[i] - 1];
      r = std::min(r, std::hypot(atom->x[i][0], atom->x[i][1]));
      upstream |= atom->x[i][0] < 0.2;
    }
  }
  for (int k = 1; k < n; k++) {    // heights ascend
    const double below = closest[k - 1] - touch, above = closest[k] - touch;
    if (below < 0.0 && above >= 0.0) return height(k - 1 - below / (above - below));
  }
  return 0.0;
}

}    // namespace

TEST(FlowFile, fiber_collects_as_in_the_exact_flow)
{
  const struct {
    double St, spacing;    // the widest of three
  } table[] = {{0.0, 0.05}, {0.1, 0.05}, {0.3, 0.05}, {1.0, 0.05}, {2.0, 0.2}};
  for (const auto &row : table) {
    const double exact = limit(row.St);
    double error[3];
    for (int n = 0; n < 3; n++)
      error[n] = gridded_limit(row.St, exact, row.spacing / (1 << n)) / exact - 1.0;
    EXPECT_LT(std::fabs(error[2]), 0.015) << "St = " << row.St;
    EXPECT_NEAR(std::log2(error[0] / error[1]), 2.0, 0.2) << "St = " << row.St;
    EXPECT_NEAR(std::log2(error[1] / error[2]), 2.0, 0.3) << "St = " << row.St;
    if (row.St > 0.0) continue;
    // The velocity towards the wall is k s^2 at distance s. Linear between nodes it is on average
    // k h^2/6 too large: what passes at s comes from a streamline that much too high.
    for (int n = 1; n < 3; n++) {
      const double cells = interception / (row.spacing / (1 << n));
      EXPECT_NEAR(error[n], 1.0 / (6.0 * cells * cells), 0.0015);
    }
  }
}
