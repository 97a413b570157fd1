#include "flow_feedback.h"

using namespace LAMMPS_NS;

FlowFeedback::FlowFeedback(LAMMPS *lmp, Fix *owner, const std::array<int, 3> &cells) :
    grid(lmp, owner, cells, 3)
{
  set_up();
}

bool FlowFeedback::add(const double *x, const apf::Vec3 &force)
{
  return grid.interpolate(x, [&](double *to, double weight) {
    const double share = -weight / grid.cell_volume;
    to[0] += share * force.x;
    to[1] += share * force.y;
    to[2] += share * force.z;
  });
}

apf::Vec3 FlowFeedback::sum()
{
  apf::Vec3 total{0.0, 0.0, 0.0};
  grid.for_own([&](const double *b) {
    total = total + grid.cell_volume * apf::Vec3{b[0], b[1], b[2]};
  });
  return total;
}
