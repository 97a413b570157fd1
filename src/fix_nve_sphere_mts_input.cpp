// What fix nve/sphere/mts takes from the script, and what it cannot work with.

#include "fix_nve_sphere_mts.h"

#include "atom.h"
#include "comm.h"
#include "error.h"
#include "fix_contact_history.h"
#include "fix_flow_force.h"
#include "force.h"
#include "given_once.h"
#include "modify.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixNVESphereMTS::FixNVESphereMTS(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), foresight(lmp, this, command)
{
  check_spheres(lmp, command, 2);
  time_integrate = 1;
  force_reneighbor = 1;
  next_reneighbor = -1;
  vector_flag = 1;
  size_vector = 6;
  global_freq = 1;
  extvector = 0;
  restart_global = 1;
  create_attribute = 1;
  maxexchange = 7;
  comm_forward = ParticleLookAhead::forward_size;
  comm_reverse = ParticleLookAhead::reverse_size;

  auto missing = [&](const std::string &word) {
    utils::missing_cmd_args(FLERR, "fix nve/sphere/mts " + word, error);
  };
  if (narg < 4) missing("collision");
  if (strcmp(arg[3], "collision") != 0)
    error->all(FLERR, 3, "{} begins with keyword collision, got {}", command, arg[3]);
  if (narg < 5) missing("collision");
  const std::string how = arg[4];
  int iarg = 5;
  if (how == "tolerance") {
    if (narg < 6) missing("collision tolerance");
    rule.tolerance = utils::numeric(FLERR, arg[iarg], false, lmp);
    if (!(rule.tolerance > 0.0 && rule.tolerance <= 0.08))
      error->all(FLERR, iarg, "{} collision tolerance must be in (0, 0.08], got {}", command,
                 arg[iarg]);
    iarg++;
  } else if (how != "auto") {
    fixed_steps = utils::is_integer(how) ? utils::inumeric(FLERR, arg[4], false, lmp) : 0;
    if (fixed_steps < 1 || fixed_steps > too_many)
      error->all(FLERR, 4,
                 "{} collision must be auto, tolerance T or a number of steps from 1 to {}, got {}",
                 command, too_many, arg[4]);
  }
  GivenOnce given(lmp, command);
  for (; iarg < narg; iarg += 2) {
    const std::string word = arg[iarg];
    given.add(word, iarg);
    if (word != "safety" && word != "fluid" && word != "lookahead")
      error->all(FLERR, iarg, "{} keyword must be safety, fluid or lookahead, got {}", command,
                 word);
    if (iarg + 1 == narg) missing(word);
    const char *value = arg[iarg + 1];
    if (word == "safety") {
      rule.kappa = utils::numeric(FLERR, value, false, lmp);
      if (!(rule.kappa > 0.0 && rule.kappa <= apf::largest_stable_kappa))
        error->all(FLERR, iarg + 1, "{} safety must be in (0, {}], got {}", command,
                   apf::largest_stable_kappa, value);
      if (how != "auto")
        error->all(FLERR, iarg, "{} safety goes with collision auto only, got collision {}",
                   command, how);
    } else if (word == "fluid") {
      fluid_every = utils::inumeric(FLERR, value, false, lmp);
      if (fluid_every < 1)
        error->all(FLERR, iarg + 1, "{} fluid must be >= 1, got {}", command, value);
    } else {
      foresight.on = utils::logical(FLERR, value, false, lmp);
    }
  }
  if (fixed_steps) n_collision = fixed_steps;

  FixNVESphereMTS::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::init()
{
  auto refuse = [&](const std::string &what, const std::string &why) {
    error->all(FLERR, Error::NOLASTLINE, "{} cannot work with {}: {}", command, what, why);
  };
  if (utils::strmatch(update->integrate_style, "^respa"))
    refuse("run_style " + std::string(update->integrate_style),
           "it sub-steps contacts by itself; use run_style verlet");
  if (update->whichflag == 2)
    refuse("minimize", "minimisers move particles without steps in time; unfix it first");
  for (const auto &fix : modify->get_fix_list())
    if (fix->time_integrate && fix != this)
      refuse(fmt::format("fix {} {}", fix->id, fix->style),
             fmt::format("its particles would stand still in collision steps; unfix {} or fix {}. "
                         "Particles outside the group of fix {} do not move",
                         fix->id, id, id));

  const auto histories = modify->get_fix_by_style("^contact/history");
  if (histories.size() != 1)
    error->all(FLERR, Error::NOLASTLINE, "{} needs one pair style granular/adhesive, got {}",
               command, histories.size());
  history = dynamic_cast<FixContactHistory *>(histories[0]);
  if (force->pair_match("^hybrid/scaled", 0))
    refuse("pair_style hybrid/scaled", "collision steps take contact forces unscaled");
  keepers.clear();
  fluids.clear();
  for (const auto &fix : modify->get_fix_list()) {
    if (auto *keeper = dynamic_cast<FixContacts *>(fix)) keepers.push_back(keeper);
    if (auto *fluid = dynamic_cast<FixFlowForce *>(fix)) fluids.push_back(fluid);
  }
  // the pair style computes first: its velocities and forces serve walls as well
  std::stable_partition(keepers.begin(), keepers.end(), [this](const FixContacts *keeper) {
    return keeper == history;
  });

  foresight.init(history, keepers);

  for (const auto &fix : modify->get_fix_list())
    if (comm->me == 0 &&
        (utils::strmatch(fix->style, "^setforce") || utils::strmatch(fix->style, "^aveforce")))
      error->warning(FLERR,
                     "{} {}: fix {} {} does not hold particles against their contacts; use fix "
                     "freeze, or leave them out of the group of fix {}",
                     command, id, fix->id, fix->style, id);

  const auto freezes = modify->get_fix_by_style("^freeze");
  freeze_group_bit = freezes.empty() ? 0 : freezes[0]->groupbit;
  if (!fixed_steps && n_collision == 1)
    n_collision = std::max(1,
                           static_cast<int>(std::ceil(
                               update->dt * history->stiffest_possible().frequency / rule.kappa)));
}
