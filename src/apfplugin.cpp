// The styles of APF, adhesive particle flow: registers them with LAMMPS, nothing else.

#include "lammpsplugin.h"

#include "comm.h"
#include "error.h"
#include "version.h"

#include "apf_advise.h"
#include "compute_aggregate_contact.h"
#include "compute_wall_deposit.h"
#include "fix_contact_history.h"
#include "fix_flow_concentration.h"
#include "fix_flow_field.h"
#include "fix_flow_force.h"
#include "fix_inlet_flow.h"
#include "fix_nve_sphere_mts.h"
#include "fix_wall_levelset.h"
#include "pair_granular_adhesive.h"

#include <cstring>

using namespace LAMMPS_NS;

namespace {

template <class Style> void *create(LAMMPS *lmp)
{
  return new Style(lmp);
}

template <class Style> void *create_with_words(LAMMPS *lmp, int narg, char **arg)
{
  return new Style(lmp, narg, arg);
}

}    // namespace

extern "C" __attribute__((visibility("default"))) void lammpsplugin_init(void *lmp, void *handle,
                                                                         void *regfunc)
{
  auto register_plugin = reinterpret_cast<lammpsplugin_regfunc>(regfunc);
  auto *lammps = static_cast<LAMMPS *>(lmp);
  if (strcmp(lammps->version, LAMMPS_VERSION) != 0 && lammps->comm->me == 0)
    lammps->error->warning(FLERR,
                           "APF " APF_VERSION " was compiled for LAMMPS " LAMMPS_VERSION
                           " and is loaded into LAMMPS {}: compile it for this version",
                           lammps->version);

  lammpsplugin_t plugin{};
  plugin.version = LAMMPS_VERSION;
  plugin.author = "APF developers";
  plugin.handle = handle;

  auto add = [&](const char *style, const char *name, const char *info) {
    plugin.style = style;
    plugin.name = name;
    plugin.info = info;
    register_plugin(&plugin, lmp);
  };
  auto creates = [&](void *(*creator)(LAMMPS *) ) {
    plugin.creator.v1 = reinterpret_cast<lammpsplugin_factory1 *>(creator);
  };
  auto creates_with_words = [&](void *(*creator)(LAMMPS *, int, char **) ) {
    plugin.creator.v2 = reinterpret_cast<lammpsplugin_factory2 *>(creator);
  };

  creates(&create<PairGranularAdhesive>);
  add("pair", "granular/adhesive", "JKR-adhesive granular contact, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixContactHistory>);
  add("fix", "contact/history", "keeps contacts of pair granular/adhesive, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixWallLevelset>);
  add("fix", "wall/levelset", "walls with adhesive contact, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixFlowField>);
  add("fix", "flow/field", "velocity field of the fluid, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixFlowConcentration>);
  add("fix", "flow/concentration", "concentration of particles on a grid, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixFlowForce>);
  add("fix", "flow/force", "forces of the fluid on particles, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixInletFlow>);
  add("fix", "inlet/flow", "particles enter with the fluid, APF " APF_VERSION);

  creates_with_words(&create_with_words<FixNVESphereMTS>);
  add("fix", "nve/sphere/mts", "integrates spheres, contacts in sub-steps, APF " APF_VERSION);

  creates_with_words(&create_with_words<ComputeAggregateContact>);
  add("compute", "aggregate/contact", "aggregates of touching particles, APF " APF_VERSION);

  creates_with_words(&create_with_words<ComputeWallDeposit>);
  add("compute", "wall/deposit", "what has settled on a wall, APF " APF_VERSION);

  creates(&create<APFAdvise>);
  add("command", "apf_advise", "judges time steps and ranges of a scene, APF " APF_VERSION);
}
