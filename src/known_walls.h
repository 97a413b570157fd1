// Walls whose distance APF can tell: those of fixes wall/levelset, and of flows from files.

#ifndef APF_KNOWN_WALLS_H
#define APF_KNOWN_WALLS_H

#include "fix_flow_field.h"
#include "fix_wall_levelset.h"
#include "modify.h"

#include <algorithm>
#include <limits>
#include <vector>

namespace LAMMPS_NS {

class KnownWalls {
 public:
  // all fixes wall/levelset, as they are defined now
  void find(Modify *modify)
  {
    walls.clear();
    fields.clear();
    for (const auto &fix : modify->get_fix_list())
      if (const auto *wall = dynamic_cast<FixWallLevelset *>(fix)) walls.push_back(wall);
  }
  void add(const FixFlowField *field)
  {
    if (field->has_distance()) fields.push_back(field);
  }

  // of the nearest wall, > 0 in the fluid                          [length]
  double distance(const double *x) const
  {
    double nearest = std::numeric_limits<double>::max();
    for (const auto *wall : walls) nearest = std::min(nearest, wall->distance(x));
    if (fields.empty()) return nearest;
    apf::PointBlock point;
    apf::Lanes of_flow;
    point.n = 1;
    point.set(0, x);
    for (const auto *field : fields) {
      field->distance(point, of_flow);
      nearest = std::min(nearest, of_flow[0]);
    }
    return nearest;
  }

 private:
  std::vector<const FixWallLevelset *> walls;
  std::vector<const FixFlowField *> fields;
};

}    // namespace LAMMPS_NS

#endif
