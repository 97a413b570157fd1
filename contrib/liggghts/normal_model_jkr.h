// LIGGGHTS normal model `jkr`: elastic spheres that adhere, with the contact law of APF, see
// doc/src/liggghts.rst.
//
//   pair_style gran model jkr [tangential adhesive] [rolling_friction dominik_tielens]
//
// This model calls the law, once per contact and step. The tangential and the rolling model of this
// folder keep the history of their part and thereby say that it is wanted. A contact begins where
// the surfaces touch (surfacesIntersect) and lasts to an overlap of -delta_C: what LIGGGHTS calls
// surfacesClose for, up to the contact distance that is registered here.

#ifdef NORMAL_MODEL
NORMAL_MODEL(JKR_ADHESIVE, jkr, 20)
#else
#ifndef NORMAL_MODEL_JKR_H_
#define NORMAL_MODEL_JKR_H_

#include "adhesive_contact.h"
#include "atom.h"
#include "contact_models.h"
#include "error.h"
#include "force.h"
#include "global_properties.h"
#include "neighbor.h"
#include "normal_model_base.h"
#include "update.h"

#include <algorithm>
#include <vector>

namespace LIGGGHTS {
namespace ContactModels {

  template <> class NormalModel<JKR_ADHESIVE> : public NormalModelBase {
   public:
    NormalModel(LAMMPS *lmp, IContactHistorySetup *setup, ContactModelBase *all_models) :
        NormalModelBase(lmp, setup, all_models), models(all_models)
    {
      at_contact = setup->add_history_value("jkr_mass", "0");
      apf::add_vector(setup, "jkr_normal", "1");
      models->add_history_offset(apf::history::contact, at_contact);
    }

    void registerSettings(Settings &settings)
    {
      settings.registerOnOff("twisting", twisting, false);
      settings.registerDoubleSetting("rollingDamping", zeta, 0.0);
    }
    void postSettings(IContactHistorySetup *, ContactModelBase *) {}
    void beginPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    void endPass(SurfacesIntersectData &, ForceData &, ForceData &) {}
    double stressStrainExponent() { return 1.5; }

    void connectToProperties(PropertyRegistry &registry)
    {
      // the models that own these histories are constructed by now
      at_sliding = models->get_history_offset(apf::history::sliding);
      at_rolling = models->get_history_offset(apf::history::rolling);
      if (twisting && at_sliding < 0)
        error->all(FLERR, "model jkr: twisting on needs tangential adhesive");
      if (zeta != 0.0 && at_rolling < 0)
        error->all(FLERR, "model jkr: rollingDamping needs rolling_friction dominik_tielens");
      if (zeta < 0.0) error->all(FLERR, "model jkr: rollingDamping must be >= 0");
      if (force->cg_active()) error->cg(FLERR, "model jkr");

      read_laws(registry);
      register_reach(registry.min_radius());
    }

    void surfacesIntersect(SurfacesIntersectData &contact, ForceData &on_i, ForceData &on_j)
    {
      evaluate(contact, contact.meff, on_i, on_j);
    }

    void surfacesClose(SurfacesCloseData &contact, ForceData &on_i, ForceData &on_j)
    {
      const auto stored = history_of(contact);
      if (!stored.exists()) return;
      evaluate(contact, stored.contact[0], on_i, on_j);
      contact.has_force_update = true;
    }

   private:
    ContactModelBase *models;
    int at_contact, at_sliding = -1, at_rolling = -1;    // offsets of histories
    bool twisting;
    double zeta;    // damping of rolling, share of critical
    int types = 0;
    std::vector<apf::ContactModel> laws;    // of pairs of types
    apf::ContactKinds kinds;
    apf::ContactConstants constants;    // of the last contact

    int index(int itype, int jtype) const { return (itype - 1) * types + jtype - 1; }

    // Properties of materials by LIGGGHTS's names. Its surfaceEnergy is the work of adhesion of two
    // surfaces, as in its thornton_ning; our gamma is the energy of one.
    void read_laws(PropertyRegistry &registry)
    {
      const char *const me = "model jkr";
      registry.registerProperty("youngsModulus", &MODEL_PARAMS::createYoungsModulus);
      registry.registerProperty("poissonsRatio", &MODEL_PARAMS::createPoissonsRatio);
      registry.registerProperty("coeffRest", &MODEL_PARAMS::createCoeffRest);
      registry.registerProperty("surfaceEnergy", &MODEL_PARAMS::createSurfaceEnergy);
      registry.registerProperty("coeffFrict", &MODEL_PARAMS::createCoeffFrict);
      registry.registerProperty("criticalRollingAngle", &create_rolling_angle);
      const double *E = registry.getVectorProperty("youngsModulus", me)->data;
      const double *nu = registry.getVectorProperty("poissonsRatio", me)->data;
      auto of_pairs = [&](const char *name) {
        return registry.getMatrixProperty(name, me)->data;
      };
      const double *const *restitution = of_pairs("coeffRest");
      const double *const *adhesion = of_pairs("surfaceEnergy");
      const double *const *friction = at_sliding < 0 ? nullptr : of_pairs("coeffFrict");
      const double *const *angle = at_rolling < 0 ? nullptr : of_pairs("criticalRollingAngle");

      types = registry.max_type();
      laws.resize(types * types);
      for (int i = 1; i <= types; i++)
        for (int j = 1; j <= types; j++) {
          if (adhesion[i][j] < 0.0) error->all(FLERR, "model jkr: surfaceEnergy must be >= 0");
          const double gamma = 0.5 * adhesion[i][j];
          apf::ContactModel &model = laws[index(i, j)];
          model.surface = apf::interface({E[i], nu[i], gamma}, {E[j], nu[j], gamma});
          model.alpha = apf::damping_from_restitution(restitution[i][j]);
          model.mu = friction ? friction[i][j] : 0.0;
          model.twisting = twisting;
          model.theta_crit = angle ? angle[i][j] : 0.0;
          model.zeta = zeta;
        }
      kinds.forget();
    }

    static MatrixProperty *create_rolling_angle(PropertyRegistry &registry, const char *caller,
                                                bool sanity_checks)
    {
      return MODEL_PARAMS::createPerTypePairProperty(registry, "criticalRollingAngle", caller,
                                                     sanity_checks, 0.0, 1.0);
    }

    // Necks are longest, compared with the spheres, between the smallest ones. LIGGGHTS looks at
    // pairs to twice that length, so that a neck which ends within a step is seen to end.
    void register_reach(double radius)
    {
      const double R = models->is_wall() ? radius : 0.5 * radius;
      const double distance = models->is_wall() ? radius : 2.0 * radius;
      double neck = 0.0;
      for (const auto &model : laws) neck = std::max(neck, model.normal(R).pulloff_overlap());
      neighbor->register_contact_dist_factor(1.0 + 2.0 * neck / distance);
    }

    apf::StoredContact history_of(const SurfacesCloseData &contact) const
    {
      double *const all = contact.contact_history;
      double *const sliding = at_sliding < 0 ? nullptr : all + at_sliding;
      return {all + at_contact, sliding, twisting ? sliding + 3 : nullptr,
              at_rolling < 0 ? nullptr : all + at_rolling};
    }

    double inertia(int i) const { return 0.4 * atom->rmass[i] * atom->radius[i] * atom->radius[i]; }

    apf::ContactBodies bodies_of(const SurfacesCloseData &contact, double mass) const
    {
      const double I = inertia(contact.i);
      if (contact.is_wall) return apf::ContactBodies::wall(contact.radi, mass, I);
      const double J = inertia(contact.j);
      return apf::ContactBodies::pair(contact.radi, contact.radj, mass, I * J / (I + J));
    }

    apf::ContactInput<apf::Space> motion_of(const SurfacesCloseData &contact) const
    {
      using apf::vector_of;
      const apf::Vec3 spin_j = contact.is_wall ? apf::Vec3{0.0, 0.0, 0.0}
                                               : vector_of(atom->omega[contact.j]);
      return {-vector_of(contact.delta),
              vector_of(contact.v_i) - vector_of(contact.v_j),
              vector_of(atom->omega[contact.i]),
              spin_j,
              constants.crowd_mass,
              constants.crowd_roll};
    }

    void evaluate(SurfacesCloseData &contact, double mass, ForceData &on_i, ForceData &on_j)
    {
      const int number = index(contact.itype, contact.jtype);
      const int kind = kinds.find(number, laws[number], bodies_of(contact, mass));
      constants = {kinds.constants(kind), kinds[kind].crowd_mass, kinds[kind].crowd_roll};
      const auto stored = history_of(contact);
      auto memory = stored.load();
      // within a step of velocity Verlet velocities are half a step older than positions
      const double step = contact.shearupdate ? update->dt : 0.0;
      const apf::ContactTimes times{contact.computeflag ? step : 0.0, 0.5 * step, 0.0};
      const auto out = apf::law_of<>(stored, constants, motion_of(contact), times, memory);

      if (contact.computeflag) {
        const bool ended = out.overlap < constants.break_overlap;
        if (ended)
          stored.end();
        else
          stored.store(mass, times.advance > 0.0 ? memory : stored.load());
        // LIGGGHTS keeps the history of pairs with a flag; that of an ended contact is zeros
        if (contact.contact_flags) *contact.contact_flags |= CONTACT_NORMAL_MODEL;
      }
      apf::add(out.force, out.torque_i, on_i);
      apf::add(-out.force, out.torque_j, on_j);
    }
  };

}    // namespace ContactModels
}    // namespace LIGGGHTS

#endif
#endif
