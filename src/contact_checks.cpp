#include "contact_checks.h"

#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_deform.h"
#include "fix_nve_sphere.h"
#include "group.h"
#include "input.h"
#include "modify.h"
#include "neighbor.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

namespace LAMMPS_NS {

void check_overlap(LAMMPS *lmp, const std::string &who, const apf::WetContact &wet, double R,
                   double smaller_radius)
{
  constexpr double much = much_overlap, too_much = 10.0 * much;
  const apf::ContactModel &model = wet.dry;
  const double ratio = apf::overlap_at_rest(wet, R) / smaller_radius;
  if (!std::isfinite(ratio))
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "{}: the overlap of particles at rest is {} of the smaller radius, {:.3g}: "
                    "diameters are far too small or too large for this law",
                    who, ratio, smaller_radius);
  if (ratio <= much) return;
  // overlap / r ~ (gamma/E)^(2/3), as ~ (sigma/E)^(2/3), and gamma ~ f^(2/5) where the stiffness is
  // scaled by f; sigma stays, for which a smaller f would do
  const double f = model.stiffness_scale;
  const std::string cure = f < 1.0
      ? fmt::format("scale_stiffness {:.3g} makes it {}", f * std::pow(ratio / much, 2.5), much)
      : fmt::format(
            "a Young's modulus E {:.3g} times as large (effective modulus {:.3g}) makes it {}",
            std::pow(ratio / much, 1.5), model.surface.E * std::pow(ratio / much, 1.5), much);
  const std::string message = fmt::format(
      "{}: particles at rest overlap by {:.3g} of the smaller radius; {}", who, ratio, cure);
  if (!(ratio <= too_much))
    lmp->error->all(FLERR, Error::NOLASTLINE, "{}; above {} the contact law has no meaning",
                    message, too_much);
  if (lmp->comm->me == 0) lmp->error->warning(FLERR, message);
}

void check_units(LAMMPS *lmp, const std::string &who)
{
  const std::string units = lmp->update->unit_style;
  for (const char *known : {"lj", "si", "cgs", "micro", "nano"})
    if (units == known) return;
  lmp->error->all(FLERR, Error::NOLASTLINE, "{} requires units lj, si, cgs, micro or nano, got {}",
                  who, units);
}

void check_direction(LAMMPS *lmp, const std::string &who)
{
  const double step = lmp->update->dt;
  if (!(step >= 0.0))
    lmp->error->all(FLERR, Error::NOLASTLINE, "{}: timestep must be >= 0, got {}", who, step);
}

void check_list_age(LAMMPS *lmp, const std::string &who)
{
  const Neighbor *lists = lmp->neighbor;
  const bool kept = std::max(lists->every, lists->delay) > 1;
  if (lmp->comm->me != 0 || (!kept && !lists->build_once)) return;
  lmp->error->warning(
      FLERR,
      "{}: with neigh_modify delay {} every {} check {}{} the neighbor list may be built too late, "
      "and particles meet or pass through each other unseen; use neigh_modify delay 0 every 1 "
      "check "
      "yes{}",
      who, lists->delay, lists->every, lists->dist_check ? "yes" : "no",
      lists->build_once ? " once yes" : "", lists->build_once ? " once no" : "");
}

bool has_rigid_bodies(LAMMPS *lmp)
{
  // of its own: that of get_fix_list() is made anew, while fix dt/reset may go through it
  const auto fixes = lmp->modify->get_fix_by_style(".*");
  return std::any_of(fixes.begin(), fixes.end(), [](const Fix *fix) {
    return fix->rigid_flag != 0;
  });
}

namespace {
  // what fix deform does along each axis shows in a protected array only
  struct Deforming : FixDeform {
    static bool without_length(FixDeform *fix, int axis)
    {
      const int style = (fix->*(&Deforming::set))[axis].style;
      const bool by_box_keyword = fix->dimflag[axis] && style == NONE;    // of fix deform/pressure
      return style == VOLUME || style == PRESSURE || style == PMEAN || by_box_keyword;
    }
  };
}    // namespace

void check_box_rates(LAMMPS *lmp, const std::string &who)
{
  for (const auto &fix : lmp->modify->get_fix_list()) {
    auto *deform = dynamic_cast<FixDeform *>(fix);
    if (!deform || deform->remapflag != Domain::V_REMAP) continue;
    for (int axis = 0; axis < 3; axis++)
      if (lmp->domain->periodicity[axis] && Deforming::without_length(deform, axis))
        lmp->error->all(FLERR, Error::NOLASTLINE,
                        "{}: fix {} {} with remap v gives images across the border in {} a wrong "
                        "velocity, since LAMMPS takes the strain rate of styles volume and "
                        "pressure for the speed of the box: use remap x, or a style with a rate, "
                        "such as erate or variable",
                        who, fix->id, fix->style, "xyz"[axis]);
  }
}

void TimestepCheck::changed(LAMMPS *lmp, double dt)
{
  if (!told && mode.frequency * dt > apf::largest_stable_kappa) begin(lmp, who, mode, dt);
}

void TimestepCheck::begin(LAMMPS *lmp, const std::string &of, const apf::StiffestMode &stiffest,
                          double dt)
{
  who = of;
  mode = stiffest;
  const double kappa = mode.frequency * dt;
  if (!std::isfinite(mode.frequency))
    lmp->error->all(FLERR, Error::NOLASTLINE,
                    "{}: the frequency of a contact is {}: masses are far too small for this law",
                    who, mode.frequency);
  told = kappa > apf::largest_stable_kappa;
  if (kappa <= apf::accurate_kappa || lmp->comm->me != 0) return;
  if (lmp->update->whichflag == 2) return;    // a minimiser has no step
  const char *running = lmp->input->command;
  if (running && strcmp(running, "rerun") == 0) return;    // frames are read, no step is taken
  const double n = std::round(lmp->update->dt / dt), good = apf::accurate_kappa / mode.frequency;
  const bool sub_steps = !lmp->modify->get_fix_by_style("^nve/sphere/mts").empty();
  if (kappa <= apf::largest_stable_kappa) {
    if (!sub_steps)    // its summary tells
      utils::logmesg(lmp,
                     "{}: omega dt = {:.3g} of the {} mode of a contact at rest; timestep {:.3g} "
                     "gives {}\n",
                     who, kappa, mode.name(), lmp->update->dt * good / dt, apf::accurate_kappa);
    return;
  }
  const std::string what = sub_steps ? fmt::format("collision step {:.4g}, timestep / {},", dt, n)
                                     : fmt::format("timestep {:.4g}", dt);
  const std::string cure = sub_steps
      ? fmt::format("collision {} gives {} at rest, impacts need more; collision auto chooses",
                    std::ceil(lmp->update->dt / good), apf::accurate_kappa)
      : fmt::format("{:.3g} gives {}{}", good, apf::accurate_kappa,
                    has_rigid_bodies(lmp) ? "" : "; or use fix nve/sphere/mts");
  lmp->error->warning(FLERR,
                      "{}: {} is too large for the {} mode of a contact, omega dt = {:.3g}; above "
                      "{} dense packings are unstable; {}",
                      who, what, mode.name(), kappa, apf::largest_stable_kappa, cure);
}

namespace {
  // keyword disc of fix nve/sphere shows in a protected number only
  struct Discs : FixNVESphere {
    static bool are_meant_by(Fix *fix)
    {
      auto *sphere = dynamic_cast<FixNVESphere *>(fix);
      return sphere && sphere->*(&Discs::inertia) == 0.5;
    }
  };

  // whether a fix acts on what one that inserts puts into its own group and into all
  bool acts_on_inserted(const LAMMPS *lmp, const Fix *fix, const Fix *inserts)
  {
    return fix->igroup == 0 || fix->igroup == inserts->igroup || lmp->group->dynamic[fix->igroup];
  }
}    // namespace

std::string why_idle(LAMMPS *lmp, const Fix *fix)
{
  const int group = fix->igroup;
  std::string or_of_those;
  for (const char *inserts : {"^inlet/flow", "^deposit", "^pour"})
    for (const auto &other : lmp->modify->get_fix_by_style(inserts)) {
      if (acts_on_inserted(lmp, fix, other)) return {};
      or_of_those =
          fmt::format(", or this group to fix {} {}, which inserts", other->id, other->style);
    }
  if (lmp->group->dynamic[group] || lmp->group->count(group) > 0) return {};
  return fmt::format("its group {0} is empty; a group gets the particles that are there at its "
                     "command: give group {0} after them{1}",
                     lmp->group->names[group], or_of_those);
}

void check_inserted(LAMMPS *lmp, const std::string &who, const Fix *inserts)
{
  const auto warn_of = [&](const std::vector<Fix *> &fixes, const std::string &does) {
    if (fixes.empty()) return;
    for (const auto *fix : fixes)
      if (acts_on_inserted(lmp, fix, inserts)) return;
    lmp->error->warning(FLERR,
                        "{}: what enters joins group {}, and fix {} {} {} group {} only: give both "
                        "the same group",
                        who,
                        inserts->igroup == 0
                            ? "all"
                            : fmt::format("all and {}", lmp->group->names[inserts->igroup]),
                        fixes[0]->id, fixes[0]->style, does, lmp->group->names[fixes[0]->igroup]);
  };
  if (lmp->comm->me != 0) return;
  std::vector<Fix *> integrators;
  for (const auto &fix : lmp->modify->get_fix_list())
    if (fix->time_integrate) integrators.push_back(fix);
  warn_of(integrators, "moves");
  warn_of(lmp->modify->get_fix_by_style("^wall/levelset"), "touches");
  warn_of(lmp->modify->get_fix_by_style("^flow/force"), "acts on");
}

void check_group(LAMMPS *lmp, const std::string &does, const Fix *fix)
{
  const std::string reason = why_idle(lmp, fix);
  if (!reason.empty() && lmp->comm->me == 0)
    lmp->error->warning(FLERR, "{} nothing: {}", does, reason);
}

void check_scene(LAMMPS *lmp, const std::string &who, double diameter)
{
  std::vector<std::string> warnings;
  for (const auto &fix : lmp->modify->get_fix_list()) {
    if (!fix->time_integrate) continue;
    if (Discs::are_meant_by(fix))
      lmp->error->all(FLERR, Error::NOLASTLINE,
                      "{}: fix {} {} has keyword disc, but particles are spheres in 2d too, with "
                      "their moment of inertia; leave disc out",
                      who, fix->id, fix->style);
    if (utils::strmatch(fix->style, "^nve$"))
      warnings.push_back(fmt::format("{}: fix {} has style nve, which does not turn particles; "
                                     "friction and fluid torque need fix nve/sphere",
                                     who, fix->id));
    const std::string reason = why_idle(lmp, fix);
    if (!reason.empty())
      warnings.push_back(
          fmt::format("{}: fix {} {} moves nothing: {}", who, fix->id, fix->style, reason));
  }
  const double skin = lmp->neighbor->skin;
  const bool looks_ahead = !lmp->modify->get_fix_by_style("^nve/sphere/mts").empty();
  if (diameter > 0.0 && skin > 5.0 * diameter)
    warnings.push_back(fmt::format("{}: the neighbor skin of {:.3g} is {:.3g} diameters of the "
                                   "largest particle; neighbor {:.2g} bin would do",
                                   who, skin, skin / diameter,
                                   (looks_ahead ? 1.0 : 0.3) * diameter));
  const double *box = lmp->domain->prd;
  const double width =
      std::min(std::min(box[0], box[1]), lmp->domain->dimension == 2 ? box[0] : box[2]);
  if (diameter > width)
    warnings.push_back(fmt::format("{}: the largest particle has a diameter of {:.3g}, the box is "
                                   "{:.3g} wide; diameters are 1 where no set command gives them",
                                   who, diameter, width));
  if (lmp->comm->me == 0)
    for (const auto &text : warnings) lmp->error->warning(FLERR, text);
}

}    // namespace LAMMPS_NS
