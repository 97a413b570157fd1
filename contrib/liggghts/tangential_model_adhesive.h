// LIGGGHTS tangential model `adhesive`: sliding, and twisting where `twisting on` says so, of model
// jkr (normal_model_jkr.h), which does the work. Here is their history.

#ifdef TANGENTIAL_MODEL
TANGENTIAL_MODEL(TANGENTIAL_ADHESIVE, adhesive, 20)
#else
#ifndef TANGENTIAL_MODEL_ADHESIVE_H_
#define TANGENTIAL_MODEL_ADHESIVE_H_

#include "adhesive_contact.h"
#include "contact_models.h"
#include "error.h"
#include "tangential_model_base.h"

namespace LIGGGHTS {
namespace ContactModels {

  template <> class TangentialModel<TANGENTIAL_ADHESIVE> : public TangentialModelBase {
   public:
    TangentialModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *models) :
        TangentialModelBase(lmp, setup, models)
    {
      if (models->get_history_offset(apf::history::contact) < 0)
        error->all(FLERR, "tangential adhesive needs model jkr");
      const int offset = apf::add_vector(setup, "adhesive_sliding", "1");
      setup->add_history_value("adhesive_twisting", "0");
      models->add_history_offset(apf::history::sliding, offset);
    }

    void registerSettings(Settings &) {}
    void postSettings(IContactHistorySetup *, ContactModelBase *) {}
    void connectToProperties(PropertyRegistry &) {}
    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void surfacesIntersect(const SurfacesIntersectData &, ForceData &, ForceData &) {}
    void surfacesClose(SurfacesCloseData &, ForceData &, ForceData &) {}
  };

}    // namespace ContactModels
}    // namespace LIGGGHTS

#endif
#endif
