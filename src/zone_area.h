// Areas of the zones of a surface.

#ifndef APF_ZONE_AREA_H
#define APF_ZONE_AREA_H

#include "wall_grid.h"

#include "wall/surface.h"

#include <functional>
#include <vector>

namespace LAMMPS_NS {
class Domain;

// Adds the area of the surface within the box to that of each zone; in two dimensions its length.
//   whole        zone of the whole surface, or -1 if it has several
//   zone_at(x)   number of the zone of a point of the surface
void add_zone_areas(const apf::Surface &surface, Domain *domain, int whole,
                    const std::function<int(const double *)> &zone_at, std::vector<double> &areas);

// The same for a surface in facets, each of which is in the zone of its middle.
void add_zone_areas(const std::vector<WallGrid::Facet> &facets, Domain *domain,
                    const std::function<int(const double *)> &zone_at, std::vector<double> &areas);

}    // namespace LAMMPS_NS

#endif
