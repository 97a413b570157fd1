// A sphere that adheres to a wall under a load below and above the limits of friction, C13 and C14
// of the list of hard cases, under velocity Verlet, stock r-RESPA and fix nve/sphere/mts. The loads
// are those of a fluid, or a force; under r-RESPA they act on the outer level.

#include "integrators.h"

#include <algorithm>

namespace {

const Material material;
const JkrCurve curve = material.wall();
const double mass = pi / 6.0, inertia = 0.1 * mass;    // of a sphere of diameter and density 1
const double r = 0.5, arm = r - curve.delta_eq(), theta = 0.02, mu = 0.3;
// So thin that its drag damps nothing, and so fast that it loads the sphere all the same
const double viscosity = 1e-8;
const std::string fluid = " density 1e-9 viscosity " + digits(viscosity) + "\n";

// One way to load the sphere: a part of the limit is given by commands with a variable share.
struct Load {
  std::string law, commands;    // of the contact; v_share of the limit
  double limit;                 // force or torque that the contact can bear
  std::string bears;            // what it bears, by outputs of the wall, > 0 along the load
  double jump;                  // how much this changes at most in a collision step of reversal
  double inertia;               // what moves beyond the limit

  double acceleration_above(double share) const { return (share - 1.0) * limit / inertia; }
};

// Shear along the wall, u = G z: drag 3 pi eta d G arm at the middle and torque pi eta d^3 G/2,
// which the rolling spring bears up to M = 4 F_C (a/a0)^1.5 theta r.
double moment_of_shear(double rate)
{
  return pi * viscosity * rate * (3.0 * arm * arm + 0.5);
}
Load rolling(const std::string &damping)
{
  const double limit = curve.rolling(curve.delta_eq()) * theta * r;
  return {"sliding 0.3 rolling " + digits(theta) + " " + damping,
          "variable rate equal v_share*" + digits(limit / moment_of_shear(1.0)) +
              "\nfix air all flow/field shear x z v_rate 0" + fluid +
              "fix load all flow/force air drag stokes torque yes\n",
          // torque on the wall about the origin, less that of the force at the foot point
          limit, "(f_wall[5]+x[1]*f_wall[3])", 0.015, inertia + mass * arm * arm};
}
// A force at the middle, up to mu |F_e + 2 F_C|; the rolling spring is far from its limit.
Load sliding()
{
  const double limit = mu * 2.0 * curve.F_C();
  return {"sliding " + digits(mu) + " rolling 1.0 0.5",
          "variable F equal v_share*" + digits(limit) + "\nfix load all addforce v_F 0 0\n",
          limit,
          "f_wall[1]",
          0.07,
          mass};
}
// A vortex about the normal at the sphere, up to (2/3) a mu |F_e + 2 F_C|
Load twisting()
{
  const double limit = 4.0 / 3.0 * mu * curve.a0() * curve.F_C();
  return {"sliding " + digits(mu) + " twisting yes rolling " + digits(theta) + " 0.5",
          "variable rate equal -v_share*" + digits(limit / (0.5 * pi * viscosity)) +
              "\nfix air all flow/field shear x y v_rate 4" + fluid +
              "fix load all flow/force air drag stokes torque yes\n",
          limit,
          "f_wall[6]",
          0.025,
          inertia};
}

class Loaded {
 public:
  Simulation sim;
  const Integrator integrator;

  // at_rest: steps, in the first half of which the load rises
  Loaded(const Integrator &by, const Load &load, double share, int at_rest,
         const std::string &damping, const std::string &more = "") :
      integrator(by)
  {
    const std::string law = jkr + damping + load.law + " ";
    Scene scene;
    scene.boundary = "p p f";
    scene.style = "pair_style granular/adhesive\npair_coeff * *" + law +
        "\nfix wall all wall/levelset plane z 0 NULL" + law + "\n";
    build(sim, {{4.0, 4.0, arm}}, scene);
    sim.run("variable share equal " + digits(share) + "*ramp(0,1)\n" + load.commands +
            integrator.commands(dt) + more +
            "compute w all property/atom omegax omegay omegaz\nvariable w2 equal C_w[1][2]^2\n"
            "variable x equal x[1]\nvariable turn equal C_w[1][3]\nthermo 1000000\n" +
            integrator.run(at_rest / 2));
    set_share(share);
    run(at_rest / 2);
  }
  void set_share(double share) { sim.run("variable share equal " + digits(share)); }
  void run(int steps) { sim.run(integrator.run(steps)); }
  double x() { return gather(sim, "x")[0]; }
  double spin(int axis) { return gather(sim, "omega")[axis]; }
};

struct Trial {
  Integrator integrator;
  std::string name, more;
};
// the three, and r-RESPA with the load on its inner level
std::vector<Trial> trials()
{
  std::vector<Trial> all;
  for (const auto &integrator : integrators) all.push_back({integrator, integrator.name, ""});
  all.push_back({integrators[1], "respa, load on the inner level", "fix_modify load respa 1\n"});
  return all;
}

// C13
constexpr int at_rest = 10000;
// U is that of phi = gamma / (rho U^2 r) = 15.
const double U = std::sqrt(material.gamma / (15.0 * r));

// the way that the sphere has rolled: by the angle that stretches the spring, and the sliding
// spring
double offset(double share, double limit)
{
  const double M = share * limit, rate = M / moment_of_shear(1.0);
  const double slide =
      3.0 * pi * viscosity * rate * arm / (8.0 * material.G_eff() * curve.a(curve.delta_eq()));
  return arm * M / (curve.rolling(curve.delta_eq()) * r) + slide;
}

const std::string million = ", in 1e6 steps";

void rest_damped(const Trial &trial)
{
  const auto &[integrator, name, more] = trial;
  const auto load = rolling("1");
  Loaded held(integrator, load, 0.5, at_rest, "damping tsuji 0.2 ", more);
  const std::string of = "C13 " + name + ": ";
  const double x = held.x();
  expect_criterion(of + "offset over M/(4 F_C)", (x - 4.0) / offset(0.5, load.limit), 0.99, 1.01);
  const std::string n = std::to_string(100000 / integrator.inner);
  held.sim.run("fix mean all ave/time 1 " + n + " " + n + " v_w2\n");
  held.run(1000000 - at_rest);
  expect_criterion(of + "creep after 1e4 steps at half the rolling limit, of r" + million,
                   std::fabs(held.x() - x) / r, 0.0, 1e-6);
  const double rms = std::sqrt(held.sim.value("f_mean"));
  const std::string what = of + "rms of the spin at last, of U/d" + million;
  if (name != "respa") {
    expect_criterion(what, rms / U, 0.0, 1e-9);
    return;
  }
  expect_unmet(what, rms / U, 0.0, 1e-9, 1e-3,
               "loads of the outer level are kicks, which shake the contact as long as they act");
  const double kick = 0.5 * load.limit / load.inertia * integrator.inner * dt;
  expect_criterion(of + "rms of the spin at last, of what the fluid gives in a step" + million,
                   rms / kick, 0.0, 0.2);
}

TEST(WallRest, damped_at_half_the_rolling_limit_by_verlet)
{
  rest_damped(trials()[0]);
}
TEST(WallRest, damped_at_half_the_rolling_limit_by_respa)
{
  rest_damped(trials()[1]);
}
TEST(WallRest, damped_at_half_the_rolling_limit_by_mts)
{
  rest_damped(trials()[2]);
}
TEST(WallRest, damped_at_half_the_rolling_limit_on_the_inner_level)
{
  rest_damped(trials()[3]);
}

// Without any damping the sphere swings about the same place for ever, as a spring does: by no more
// than in the beginning, and nowhere else.
void rest_undamped(const Integrator &integrator)
{
  const auto load = rolling("0");
  Loaded held(integrator, load, 0.5, at_rest, "damping none ");
  const int window = 250000;
  const std::string n = std::to_string(window / integrator.inner);
  held.sim.run("fix mean all ave/time 1 " + n + " " + n + " v_w2 v_x\n");
  held.run(2 * window - at_rest);
  const double w2 = held.sim.value("f_mean[1]"), x = held.sim.value("f_mean[2]");
  EXPECT_GT(std::sqrt(w2) / U, 1e-6) << "it swings";
  held.run(2 * window);
  expect_criterion(
      integrator.of("C13 *: rms of the undamped spin, last quarter over the second" + million),
      std::sqrt(held.sim.value("f_mean[1]") / w2), 0.9, 1.01);
  expect_criterion(integrator.of("C13 *: creep of the undamped middle, of r" + million),
                   std::fabs(held.sim.value("f_mean[2]") - x) / r, 0.0, 1e-6);
  expect_criterion(integrator.of("C13 *: undamped middle over M/(4 F_C)" + million),
                   (x - 4.0) / offset(0.5, load.limit), 0.99, 1.01);
}

TEST(WallRest, undamped_at_half_the_rolling_limit_by_verlet)
{
  rest_undamped(integrators[0]);
}
TEST(WallRest, undamped_at_half_the_rolling_limit_by_respa)
{
  rest_undamped(integrators[1]);
}
TEST(WallRest, undamped_at_half_the_rolling_limit_by_mts)
{
  rest_undamped(integrators[2]);
}

// C14
constexpr int slowly = 40000;
const std::string damped = "damping tsuji 0.2 ";

// Largest change of what the contact bears in one step, of the limit, while a sphere in steady slip
// is unloaded and loaded the other way.
double jump_at_reversal(Loaded &slips, const Load &load)
{
  slips.sim.run("variable bears equal " + load.bears + "\nfix log all vector 1 v_bears\nthermo 1");
  double most = 0.0;
  int seen = 0;
  for (const double share : {0.0, -0.99, 0.5}) {
    slips.set_share(share);
    slips.run(4000);
    const int n = 4000 / slips.integrator.inner;
    for (int k = std::max(seen, 1); k < seen + n; k++)
      most = std::max(most,
                      std::fabs(slips.sim.value("f_log[" + std::to_string(k + 1) + "]-f_log[" +
                                                std::to_string(k) + "]")));
    seen += n;
  }
  return most / load.limit;
}

// Angle in 10,000 steps under r-RESPA, from the spins in its inner steps: it is velocity Verlet
// with a load that is given N-fold in every Nth step, and its spin in these is the same.
double creep_in_inner_steps(const Integrator &respa, const Load &load, double share)
{
  const std::string N = std::to_string(respa.inner), rate = " equal -v_share*";
  Load kicks = load;
  kicks.commands.replace(kicks.commands.find(rate), rate.size(),
                         rate + N + "*(step%" + N + "==0)*");
  double spin = 0.0;
  {
    Loaded levels(respa, load, share, slowly, damped);
    levels.run(10000);
    spin = levels.spin(2);
    EXPECT_GT(std::fabs(spin), 1e-6) << "it is shaken";
  }
  Loaded kicked(integrators[0], kicks, share, slowly, damped);
  kicked.sim.run("fix mean all ave/time 1 10000 10000 v_turn\n");
  kicked.run(10000);
  EXPECT_NEAR(kicked.spin(2) / spin, 1.0, 1e-6);
  return std::fabs(kicked.sim.value("f_mean")) * 10000 * dt;
}

void threshold(const std::string &mode, const Load &load)
{
  // axis of what moves in slip: the middle or the spin
  const bool turns = mode != "sliding";
  const int axis = mode == "rolling" ? 1 : mode == "twisting" ? 2 : 0;
  const std::string of = " of the " + mode + " limit";
  for (const auto &[integrator, name, more] : trials()) {
    // way [r] or angle in 10,000 steps
    auto creep = [&, &integrator = integrator, &more = more](double share) {
      Loaded below(integrator, load, share, slowly, damped, more);
      const double x = below.x();
      const std::string n = std::to_string(10000 / integrator.inner);
      below.sim.run("fix mean all ave/time 1 " + n + " " + n + " v_turn\n");
      below.run(10000);
      return mode == "twisting" ? std::fabs(below.sim.value("f_mean")) * 10000 * dt
                                : std::fabs(below.x() - x) / r;
    };
    const std::string c14 = "C14 " + name + ": ", what = c14 + "creep at 99 %" + of + ", of r";
    if (name != "respa")
      expect_criterion(what, creep(0.99), 0.0, 1e-6);
    else if (mode == "twisting")
      expect_criterion(what, creep_in_inner_steps(integrator, load, 0.99), 0.0, 1e-6);
    else {
      expect_unmet(what, creep(0.99), 0.0, 1e-6, 3.0,
                   "kicks of the outer level load springs and dashpots beyond the limit");
      const int held = mode == "rolling" ? 98 : 89;
      expect_criterion(c14 + "creep at " + std::to_string(held) + " %" + of + ", of r",
                       creep(0.01 * held), 0.0, 1e-6);
    }
    Loaded slips(integrator, load, 1.01, slowly, damped, more);
    const auto speed = [&] {
      return gather(slips.sim, turns ? "omega" : "v")[axis];
    };
    const double before = speed();
    slips.run(2000);
    EXPECT_GT(speed(), 0.0);
    expect_criterion(c14 + "acceleration at 101 %" + of + " over that of the excess",
                     (speed() - before) / (2000 * dt) / load.acceleration_above(1.01), 0.99, 1.01);
    expect_criterion(c14 + "what is borne in slip, over the limit of " + mode + ", less 1",
                     slips.sim.value(load.bears) / load.limit - 1.0, -1e-6, 1e-6);
    // in a particle step of ten collision steps it changes by up to ten times as much
    expect_criterion(c14 + "largest change of that in a step of reversal, " + mode,
                     jump_at_reversal(slips, load), 0.0,
                     (integrator.inner > 1 ? 6.0 : 1.0) * load.jump);
  }
}

TEST(WallRest, rolling_threshold)
{
  threshold("rolling", rolling("0.5"));
}
TEST(WallRest, sliding_threshold)
{
  threshold("sliding", sliding());
}
TEST(WallRest, twisting_threshold)
{
  threshold("twisting", twisting());
}

}    // namespace
