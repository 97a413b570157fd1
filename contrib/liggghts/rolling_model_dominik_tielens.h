// LIGGGHTS rolling model `dominik_tielens`: rolling resistance of an adhesive contact
// (doi:10.1080/01418619508243800), a part of model jkr (normal_model_jkr.h), which does the work.
// Here is its history.

#ifdef ROLLING_MODEL
ROLLING_MODEL(ROLLING_DOMINIK_TIELENS, dominik_tielens, 20)
#else
#ifndef ROLLING_MODEL_DOMINIK_TIELENS_H_
#define ROLLING_MODEL_DOMINIK_TIELENS_H_

#include "adhesive_contact.h"
#include "contact_models.h"
#include "error.h"
#include "rolling_model_base.h"

namespace LIGGGHTS {
namespace ContactModels {

  template <> class RollingModel<ROLLING_DOMINIK_TIELENS> : public RollingModelBase {
   public:
    RollingModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *models) :
        RollingModelBase(lmp, setup, models)
    {
      if (models->get_history_offset(apf::history::contact) < 0)
        error->all(FLERR, "rolling_friction dominik_tielens needs model jkr");
      const int offset = apf::add_vector(setup, "dominik_tielens_rolling", "0");
      models->add_history_offset(apf::history::rolling, offset);
    }

    void registerSettings(Settings &) {}
    void postSettings(IContactHistorySetup *, ContactModelBase *) {}
    void connectToProperties(PropertyRegistry &) {}
    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void surfacesIntersect(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
  };

}    // namespace ContactModels
}    // namespace LIGGGHTS

#endif
#endif
