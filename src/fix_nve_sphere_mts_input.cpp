// What fix nve/sphere/mts takes from the script, and what it cannot work with.

#include "fix_nve_sphere_mts.h"

#include "argument_reader.h"
#include "atom.h"
#include "comm.h"
#include "domain.h"
#include "error.h"
#include "fix_contact_history.h"
#include "fix_flow_force.h"
#include "force.h"
#include "given_once.h"
#include "lost_state.h"
#include "modify.h"
#include "particle_checks.h"
#include "update.h"

#include <algorithm>
#include <cmath>
#include <cstring>

using namespace LAMMPS_NS;

/* ---------------------------------------------------------------------- */

FixNVESphereMTS::FixNVESphereMTS(LAMMPS *lmp, int narg, char **arg) :
    Fix(lmp, narg, arg), guard(lmp), foresight(lmp, this, command)
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

  parse(narg, arg);
  if (fixed_steps) n_collision = fixed_steps;

  FixNVESphereMTS::grow_arrays(atom->nmax);
  atom->add_callback(Atom::GROW);
}

/* ---------------------------------------------------------------------- */

void FixNVESphereMTS::parse(int narg, char **arg)
{
  const ArgumentReader reader(lmp, command, arg);
  GivenOnce given(lmp, command);
  auto need = [&](int words, const std::string &word) {
    if (narg < words) utils::missing_cmd_args(FLERR, "fix nve/sphere/mts " + word, error);
  };
  need(4, "collision");
  if (strcmp(arg[3], "collision") != 0)
    error->all(FLERR, 3, "{} begins with keyword collision, got {}", command, arg[3]);
  given.add(arg[3], 3);
  need(5, "collision");
  const std::string how = arg[4];
  int iarg = 5;
  if (how == "tolerance") {
    need(6, "collision tolerance");
    rule.tolerance = reader.number(iarg++, "collision tolerance", Range::above(0.0, 0.08));
  } else if (how != "auto") {
    const double n = utils::is_integer(how) ? std::strtod(arg[4], nullptr) : 0.0;
    if (n < 1.0 || n > too_many)
      error->all(FLERR, 4,
                 "{} collision must be auto, tolerance T or a number of steps from 1 to {}, got {}",
                 command, too_many, how);
    fixed_steps = static_cast<int>(n);
  }
  for (; iarg < narg; iarg += 2) {
    const std::string word = arg[iarg];
    given.add(word, iarg);
    if (word != "safety" && word != "fluid" && word != "lookahead")
      error->all(FLERR, iarg, "{} keyword must be safety, fluid or lookahead, got {}", command,
                 word);
    need(iarg + 2, word);
    if (word == "safety") {
      rule.kappa = reader.number(iarg + 1, word, Range::above(0.0, apf::largest_stable_kappa));
      if (how != "auto")
        error->all(FLERR, iarg, "{} safety goes with collision auto only, got collision {}",
                   command, how);
    } else if (word == "fluid") {
      fluid_every = reader.integer(iarg + 1, word, Range::from(1));
    } else {
      foresight.on = reader.yes(iarg + 1, word);
    }
  }
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

  const auto freezes = modify->get_fix_by_style("^freeze");
  freeze_group_bit = freezes.empty() ? 0 : freezes[0]->groupbit;
  foresight.init(history, keepers, freeze_group_bit);
  foresight.box_every = 0;
  for (const auto &fix : modify->get_fix_list())
    if (domain->deform_vremap && utils::strmatch(fix->style, "^deform"))
      foresight.box_every = fix->nevery;
  for (const auto &fix : modify->get_fix_list()) {
    const bool deforms = utils::strmatch(fix->style, "^deform");
    if (!(fix->box_change & (BOX_CHANGE_SIZE | BOX_CHANGE_SHAPE)) ||
        (deforms && domain->deform_vremap) || comm->me != 0)
      continue;
    error->warning(FLERR,
                   "{} {}: fix {} {} moves particles or their images between two steps, which "
                   "look-ahead does not see, so that contacts are found late; use {}",
                   command, id, fix->id, fix->style,
                   deforms ? "remap v" : "fix deform with remap v");
  }
  LostState::warn(lmp, this, "its counts begin at 0, and the run does not go on to the last bit");
  // a restart file does not tell what was sub-stepped, and a run begins as it does from there
  std::fill(activity.begin(), activity.end(), apf::FREE);

  for (const auto &fix : modify->get_fix_list())
    if (comm->me == 0 &&
        (utils::strmatch(fix->style, "^setforce") || utils::strmatch(fix->style, "^aveforce")))
      error->warning(FLERR,
                     "{} {}: fix {} {} does not hold particles against their contacts; use fix "
                     "freeze, or leave them out of the group of fix {}",
                     command, id, fix->id, fix->style, id);
  for (const auto &fix : modify->get_fix_by_style("^wall/gran"))
    if (comm->me == 0)
      error->warning(FLERR,
                     "{} {}: contacts with fix {} {} take no collision steps and may need a much "
                     "smaller timestep; fix wall/levelset has contacts that do",
                     command, id, fix->id, fix->style);

  if (!fixed_steps && n_collision == 1) {
    const double n = std::ceil(update->dt * history->stiffest_possible().frequency / rule.kappa);
    n_collision = std::max(1, static_cast<int>(n < too_many ? n : too_many));
  }
}
