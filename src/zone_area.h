// Areas of the zones of a wall.

#ifndef APF_ZONE_AREA_H
#define APF_ZONE_AREA_H

#include "wall_grid.h"

#include "wall/surface.h"
#include "wall/wall_pose.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
class Domain;

// Adds the area of a surface within the box to that of each zone; in two dimensions its length.
//   pose         where the wall is
//   whole        zone of the whole surface, or -1 if it has several
//   zone_at(x)   number of the zone of a point of the surface
void add_zone_areas(const apf::Surface &surface, const apf::WallPose &pose, Domain *domain,
                    int whole, const std::function<int(const double *)> &zone_at,
                    std::vector<double> &areas);

// The same for a piece of a wall from a file, whose facets count.
void add_zone_areas(const WallGrid &grid, int piece, const apf::WallPose &pose, Domain *domain,
                    const std::function<int(const double *)> &zone_at, std::vector<double> &areas);

}    // namespace LAMMPS_NS

#endif
