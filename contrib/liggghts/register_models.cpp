// Makes the combinations of our contact models known to LIGGGHTS, whose own are registered by its
// library.

#include "contact_models.h"
#include "fix_insert_stream.h"
#include "fix_wall_gran_base.h"
#include "granular_pair_style.h"
#include "granular_wall.h"
#include "pair_gran_base.h"

using namespace LIGGGHTS;
using namespace LIGGGHTS::ContactModels;

namespace {

template <int tangential, int rolling> void add()
{
  using Style = GranStyle<JKR_ADHESIVE, tangential, COHESION_OFF, rolling, SURFACE_DEFAULT>;
  using Pair = PairStyles::Granular<ContactModel<Style>>;
  using Wall = Walls::Granular<ContactModel<Style>>;
  PairStyles::Factory::instance().addStyle(
      "gran", Style::HASHCODE,
      [](LAMMPS *lmp, PairGran *parent, const int64_t hash) -> PairStyles::IGranularPairStyle * {
        return new Pair(lmp, parent, hash);
      });
  Walls::Factory::instance().addStyle(
      "gran", Style::HASHCODE,
      [](LAMMPS *lmp, FixWallGran *parent, const int64_t hash) -> Walls::IGranularWall * {
        return new Wall(lmp, parent, hash);
      });
}

const bool registered = [] {
  add<TANGENTIAL_OFF, ROLLING_OFF>();
  add<TANGENTIAL_OFF, ROLLING_DOMINIK_TIELENS>();
  add<TANGENTIAL_ADHESIVE, ROLLING_OFF>();
  add<TANGENTIAL_ADHESIVE, ROLLING_DOMINIK_TIELENS>();
  return true;
}();

}    // namespace
