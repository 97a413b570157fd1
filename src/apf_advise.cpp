#include "apf_advise.h"

#include "argument_reader.h"
#include "atom.h"
#include "box_images.h"
#include "comm.h"
#include "contact_checks.h"
#include "error.h"
#include "fix_flow_field.h"
#include "fix_flow_force.h"
#include "fix_nve_sphere_mts.h"
#include "fix_wall_levelset.h"
#include "force.h"
#include "given_once.h"
#include "math_extra.h"
#include "modify.h"
#include "neighbor.h"
#include "pair_granular_adhesive.h"
#include "type_sizes.h"
#include "update.h"

#include <algorithm>
#include <cmath>

using namespace LAMMPS_NS;

void APFAdvise::command(int narg, char **arg)
{
  if (!domain->box_exist) error->all(FLERR, "Command apf_advise needs a simulation box");
  parse(narg, arg);
  auto *pair = dynamic_cast<PairGranularAdhesive *>(force->pair_match("granular/adhesive", 1));
  if (!pair) error->all(FLERR, "Command apf_advise needs pair style granular/adhesive");
  lmp->init();

  FixFlowField *field = nullptr;
  for (const auto &fix : modify->get_fix_list())
    if (auto *found = dynamic_cast<FixFlowField *>(fix)) field = found;
  if (field) {
    field->require(apf::Detail::VORTICITY, false);
    field->setup_pre_force(0);
  }
  find_sizes();
  find_motion(field);
  find_length();
  scene.step = update->dt;

  say(fmt::format("APF advice: speed U = {:.6g}{}, length L = {:.6g}{}, timestep {:.6g}", scene.U,
                  speed_given ? "" : " (largest at the particles)", scene.L,
                  length_given ? "" : " (shortest box edge)", scene.step));
  advise_contacts(pair);
  advise_steps();
  if (field) advise_fluid(field);
  for (const auto &cure : cures) say("  change: " + cure);
  if (cures.empty()) say("  nothing to change");
}

void APFAdvise::parse(int narg, char **arg)
{
  const ArgumentReader reader(lmp, "Command apf_advise", arg);
  GivenOnce given(lmp, "Command apf_advise");
  for (int iarg = 0; iarg < narg; iarg += 2) {
    const std::string word = arg[iarg];
    given.add(word, iarg);
    if (word != "speed" && word != "length")
      error->all(FLERR, iarg, "Command apf_advise keyword must be speed or length, got {}", word);
    if (iarg + 1 == narg) utils::missing_cmd_args(FLERR, "apf_advise " + word, error);
    const double value = reader.number(iarg + 1, word, Range::above(0.0));
    (word == "speed" ? scene.U : scene.L) = value;
    (word == "speed" ? speed_given : length_given) = true;
  }
}

/* ----------------------------------------------------------------------
   the scene
------------------------------------------------------------------------- */

// The largest particle of a type is taken to be as dense as its smallest.
void APFAdvise::find_sizes()
{
  const auto found = TypeSizes::find(lmp, "Command apf_advise");
  for (int type = 1; type <= atom->ntypes; type++) {
    const double least = found.radius_min[type], most = found.radius_max[type];
    if (found.mass_min[type] == 0.0) continue;
    const Size smallest{type, least, found.mass_min[type]};
    sizes.push_back(smallest);
    if (most > least)
      sizes.push_back({type, most, smallest.density() * apf::sphere::volume(2.0 * most)});
  }
  if (sizes.empty())
    error->all(FLERR,
               "Command apf_advise needs particles, or a fix inlet/flow that will insert some");
}

// velocities of its images across those faces of the box that it is near
void APFAdvise::include_images(int i, apf::VelocityRange &images) const
{
  double at[3];
  domain->x2lamda(atom->x[i], at);
  for (int c = 0; c < 3; c++) {
    const double near = (2.0 * atom->radius[i] + neighbor->skin) / domain->prd[c];
    double n[3] = {}, rate[3];
    n[c] = 1.0;
    sum_of_box_vectors(n, domain->h_rate, rate);
    for (const double sign : {1.0, -1.0}) {
      if (!domain->periodicity[c] || (sign > 0.0 ? at[c] : 1.0 - at[c]) > near) continue;
      double v[3];
      for (int k = 0; k < 3; k++) v[k] = atom->v[i][k] + sign * rate[k];
      images.include(v);
    }
  }
}

void APFAdvise::find_motion(FixFlowField *field)
{
  double fastest = 0.0;
  apf::VelocityRange range, images;
  for (int i = 0; i < atom->nlocal; i++) {
    fastest = std::max(fastest, MathExtra::len3(atom->v[i]));
    range.include(atom->v[i]);
    if (domain->deform_vremap) include_images(i, images);
  }
  double wall_speed = 0.0;
  for (const auto &fix : modify->get_fix_list())
    if (const auto *wall = dynamic_cast<FixWallLevelset *>(fix)) {
      wall->include_walls(range, update->dt);
      wall_speed = std::max(wall_speed, wall->linear_speed());
      if (wall->varies())
        say(fmt::format("APF advice does not know how fast fix {} moves: its variables count "
                        "when a run has begun; keyword speed gives a speed to expect",
                        wall->id));
    }
  MPI_Allreduce(MPI_IN_PLACE, &fastest, 1, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, range.most, 6, MPI_DOUBLE, MPI_MAX, world);
  MPI_Allreduce(MPI_IN_PLACE, images.most, 6, MPI_DOUBLE, MPI_MAX, world);
  if (!speed_given) {
    scene.U = std::max(fastest, wall_speed);
    if (field) scene.U = std::max(scene.U, fluid_at_particles(field).speed);
  }
  double heaviest = 0.0, lightest = sizes[0].mass;
  for (const auto &size : sizes) {
    heaviest = std::max(heaviest, size.mass);
    lightest = std::min(lightest, size.mass);
  }
  scene.amplify = apf::amplification(heaviest, lightest);
  // what is at rest may come to move so, and by a wall that moves twice as fast as it
  scene.spread = std::max({range.spread(images), scene.U, 2.0 * wall_speed});
  if (scene.U == 0.0)
    error->all(FLERR,
               "Command apf_advise finds nothing that moves, no particle, fluid at one, or wall: "
               "add keyword speed with the speed to expect");
}

APFAdvise::Fluid APFAdvise::fluid_at_particles(FixFlowField *field) const
{
  double most[3] = {};
  apf::PointBlock points;
  apf::FluidBlock fluid;
  for (int i = 0; i < atom->nlocal; i++) {
    points.n = 1;
    points.set(0, atom->x[i]);
    field->sample(points, apf::Detail::VORTICITY, fluid);
    double u[3], slip[3], spin[3];
    for (int c = 0; c < 3; c++) {
      u[c] = fluid.velocity[c][0];
      slip[c] = atom->v[i][c] - u[c];
      spin[c] = fluid.vorticity[c][0];
    }
    most[0] = std::max(most[0], MathExtra::len3(u));
    most[1] = std::max(most[1], MathExtra::len3(slip));
    most[2] = std::max(most[2], MathExtra::len3(spin));
  }
  MPI_Allreduce(MPI_IN_PLACE, most, 3, MPI_DOUBLE, MPI_MAX, world);
  return {most[0], most[1], most[2]};
}

void APFAdvise::find_length()
{
  if (length_given) return;
  scene.L = std::min(domain->prd[0], domain->prd[1]);
  if (domain->dimension == 3) scene.L = std::min(scene.L, domain->prd[2]);
}

/* ----------------------------------------------------------------------
   contacts
------------------------------------------------------------------------- */

void APFAdvise::advise_contacts(PairGranularAdhesive *pair)
{
  say(fmt::format("  {:<26} {:>10} {:>10} {:>9} {:>9} {:>10} {:>10} {:>9} {:>9} {:>10} {:>10} "
                  "{:>10} {:>10}",
                  "contact", "a0", "delta_C", "rest/r", "impact/r", "V_s", "F_C", "phi", "lambda",
                  "omega", "mode", "f3 step", "step"));
  for (size_t i = 0; i < sizes.size(); i++)
    for (size_t j = i; j < sizes.size(); j++) {
      const Size &a = sizes[i], &b = sizes[j];
      const double inv_m = 1.0 / a.mass + 1.0 / b.mass, inv_I = 1.0 / a.moment() + 1.0 / b.moment();
      advise_contact(
          fmt::format("{} {} d {:.4g} {:.4g}", a.type, b.type, 2.0 * a.radius, 2.0 * b.radius),
          pair->coeff_of_types(a.type, b.type),
          apf::ContactBodies::pair(a.radius, b.radius, 1.0 / inv_m, 1.0 / inv_I),
          a.radius < b.radius ? a : b);
    }
  for (const auto &fix : modify->get_fix_list()) {
    const auto *wall = dynamic_cast<FixWallLevelset *>(fix);
    if (!wall) continue;
    for (const auto &size : sizes) {
      double last = 0.0;    // surfaces of one curvature are alike
      for (const auto &surface : wall->all_surfaces()) {
        const auto bodies = FixWallLevelset::bodies_at(surface, size.radius, size.mass);
        if (bodies.R == last) continue;
        last = bodies.R;
        advise_contact(fmt::format("{} {} d {:.4g}", size.type, wall->id, 2.0 * size.radius),
                       wall->contact_coeff(), bodies, size);
      }
    }
  }
}

void APFAdvise::advise_contact(const std::string &name, const ContactCoeff &coeff,
                               const apf::ContactBodies &bodies, const Size &smaller)
{
  const auto &model = coeff.model;
  const double r = smaller.radius, rho = smaller.density();
  const auto contact = apf::ContactScales::make({coeff.bridge, model}, bodies, r, scene.U);
  const double E = model.surface.E * model.stiffness_scale;
  say(fmt::format("  {:<26} {:>10.4g} {:>10.4g} {:>9.4g} {:>9.4g} {:>10.4g} {:>10.4g} {:>9.4g} "
                  "{:>9.4g} {:>10.4g} {:>10} {:>10.4g} {:>10.4g}",
                  name, contact.contact_radius, contact.neck_length, contact.rest_overlap / r,
                  contact.impact_overlap / r, contact.sticking_speed, contact.pulloff_force,
                  scene.adhesion(model.surface.gamma, rho, r), scene.stiffness(E, rho),
                  contact.rest.frequency, contact.rest.name(),
                  scene.collision_step(2.0 * r, rho, E), contact.collision_step));
  finest = finest > 0.0 ? std::min(finest, contact.collision_step) : contact.collision_step;
  if (std::max(contact.rest_overlap, contact.impact_overlap) > much_overlap * r)
    cures.push_back(fmt::format("contact {}: overlap is {:.3g} of the radius at rest and {:.3g} in "
                                "an impact at U; above {} take a larger E{}",
                                name, contact.rest_overlap / r, contact.impact_overlap / r,
                                much_overlap,
                                model.stiffness_scale < 1.0 ? " or scale_stiffness" : ""));
}

/* ----------------------------------------------------------------------
   time steps, neighbor skin
------------------------------------------------------------------------- */

void APFAdvise::advise_steps()
{
  const auto smallest = std::min_element(sizes.begin(), sizes.end(), [](auto &a, auto &b) {
    return a.radius < b.radius;
  });
  const double particle = scene.particle_step(2.0 * smallest->radius);
  const double needed = std::ceil(scene.step / finest);
  say(fmt::format(
      "  steps: fluid f1 L/U {:.4g}, particle f2 d/U {:.4g}, collision {:.4g} (omega dt "
      "= {}); ratios {:.4g} {:.4g}",
      scene.fluid_step(), particle, finest, apf::accurate_kappa, scene.fluid_step() / particle,
      particle / finest));
  say(fmt::format("  timestep / collision step {:.4g}, neighbor skin {:.4g}, at least {:.4g}",
                  scene.step / finest, neighbor->skin, scene.least_skin()));

  const bool sub_steps = !modify->get_fix_by_style("^nve/sphere/mts").empty();
  if (!sub_steps && needed > 1.0)
    cures.push_back(has_rigid_bodies(lmp)
                        ? fmt::format("timestep {:.3g}", finest)
                        : fmt::format("timestep {:.3g}, or fix nve/sphere/mts with collision {}",
                                      finest, needed));
  constexpr double room = 1.1;    // the rule is one of thumb
  if (sub_steps && scene.step > room * particle)
    cures.push_back(fmt::format("timestep {:.3g} or less: a particle moves {:.3g} diameters in one",
                                particle, scene.step / particle * apf::report_f2));
  constexpr double much = 10.0;    // shorter than needed, as a timestep that was forgotten
  if (sub_steps && much * scene.step < particle)
    cures.push_back(
        fmt::format("timestep up to {:.3g}: a particle moves {:.3g} diameters in one, and {} are "
                    "short enough",
                    particle, scene.step / particle * apf::report_f2, apf::report_f2));
  for (const auto &fix : modify->get_fix_by_style("^nve/sphere/mts")) {
    const auto *mts = dynamic_cast<FixNVESphereMTS *>(fix);
    const int n = mts ? mts->fixed_number() : 0;
    if (n > 0 && n * finest * apf::largest_stable_kappa < scene.step * apf::accurate_kappa)
      cures.push_back(fmt::format("collision {:.0f} or more: {} gives omega dt = {:.3g}", needed, n,
                                  scene.step / (n * finest) * apf::accurate_kappa));
  }
  if (sub_steps && scene.least_skin() > neighbor->skin)
    cures.push_back(fmt::format("neighbor {:.4g} bin or larger: impacts are looked for two "
                                "timesteps ahead",
                                scene.least_skin()));
}

/* ----------------------------------------------------------------------
   fluid
------------------------------------------------------------------------- */

void APFAdvise::advise_fluid(FixFlowField *field)
{
  auto at = fluid_at_particles(field);
  // what will enter and be captured sees all of it
  if (speed_given) at.slip = std::max(at.slip, scene.U);
  double largest = 0.0;
  for (const auto &size : sizes) {
    const double d = 2.0 * size.radius;
    const double tau = apf::relaxation_time(size.mass, d, field->viscosity);
    largest = std::max(largest, d);
    say(fmt::format("  fluid: type {} d {:.4g} tau_p {:.4g} St {:.4g} timestep/tau_p {:.4g} Re_p "
                    "{:.4g} Re_G {:.4g}",
                    size.type, d, tau, scene.stokes_number(tau), scene.step / tau,
                    apf::particle_reynolds(at.slip, d, field->density, field->viscosity),
                    apf::gradient_reynolds(at.vorticity, d, field->density, field->viscosity)));
  }
  say(fmt::format("  fluid: Re = rho_f U L/mu {:.4g}",
                  scene.flow_reynolds(field->density, field->viscosity)));
  advise_ranges(field, at, largest);
}

void APFAdvise::advise_ranges(FixFlowField *field, const Fluid &at, double d)
{
  const double Re = apf::particle_reynolds(at.slip, d, field->density, field->viscosity);
  const double Re_G = apf::gradient_reynolds(at.vorticity, d, field->density, field->viscosity);
  say("  ranges: drag stokes Re_p < 1, schiller Re_p < 800; lift saffman Re_p < 1, Re_G < 1, "
      "Re_p < sqrt(Re_G)");
  for (const auto &fix : modify->get_fix_list()) {
    const auto *flow = dynamic_cast<FixFlowForce *>(fix);
    if (!flow) continue;
    const auto &model = flow->fluid_model();
    if (model.drag == apf::FluidModel::STOKES && Re > 1.0)
      cures.push_back(fmt::format("fix {}: drag schiller, Re_p is {:.3g}", fix->id, Re));
    if (model.drag == apf::FluidModel::SCHILLER && Re > 800.0)
      cures.push_back(fmt::format("fix {}: no drag law holds at Re_p {:.3g}", fix->id, Re));
    if (model.lift && (Re > 1.0 || Re_G > 1.0 || Re * Re > Re_G))
      cures.push_back(fmt::format("fix {}: lift saffman is out of its range, Re_p {:.3g}, Re_G "
                                  "{:.3g}",
                                  fix->id, Re, Re_G));
  }
}

void APFAdvise::say(const std::string &line) const
{
  if (comm->me == 0) utils::logmesg(lmp, line + "\n");
}
